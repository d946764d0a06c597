# SPDX-License-Identifier: GPL-3.0-or-later
"""What results depend on that no input says: each threshold of contacts and of the chosen step, halved and doubled.

Copies the sources, builds the program with each value, runs the scenes beside this file, and prints a table: by how much, of the
energy that went through, each scene ends with other energies than with the value as it is. Takes minutes a threshold; not a part of CI.

Usage: python3 thresholds.py ROOT FOLDER [--only NAME ...]; FOLDER keeps the copy and its build for the next time
       python3 thresholds.py ROOT --check: only whether each is in the sources as it is here
"""

import argparse
import csv
import re
import shutil
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

SCENES = Path(__file__).resolve().parent / "scenes"
FORMS = ("kinetic", "contact_elastic", "bond_elastic", "sheet_elastic", "gravity", "friction", "damping")


@dataclass(frozen=True)
class Threshold:
    """A number in the sources, and the scenes that it may matter in."""

    file: str
    name: str
    value: float
    scenes: tuple
    halved: str = ""
    doubled: str = ""

    def values(self):
        """Half and twice of it, or what comes nearest to these where it has a range of its own."""
        number = int if isinstance(self.value, int) else float
        return self.halved or str(number(self.value / 2)), self.doubled or str(number(self.value * 2))


THRESHOLDS = (
    Threshold("contact/counting/wrap.hpp", "kTurn", 0.1, ("sink", "drape")),
    Threshold("contact/counting/cycle_weights.cpp", "kSharpness", 12, ("sink", "drape", "cover")),
    Threshold("contact/surface_surface/tilt_share.hpp", "kLargestTilt", 3e-4, ("stack", "drape")),
    # A cosine: half and twice the angle.
    Threshold("contact/surface_surface/facing_facets.hpp", "kCosineOfCrossing", 0.9, ("stack", "drape"), "0.974679", "0.62"),
    Threshold("contact/surface_surface/pair_terms.hpp", "kMostCycles", 64.0, ("cover",)),
    Threshold("contact/surface_surface/point_share.hpp", "kDepthOfCrossing", 2.0, ("cross",)),
    # Twice would give point contacts, for which both are the same, a kink.
    Threshold("contact/surface_surface/structure_patches.hpp", "kLeastOfOne", 0.5, ("drape", "cross"), doubled="0.9"),
    # Twice is above what is stable.
    Threshold("dynamics/stiffness/nodal_stiffness.hpp", "kSafety", 0.65, ("catch", "stack"), doubled="0.79"),
    # Growth in a look, 10 %.
    Threshold("dynamics/time_step/step_chooser.hpp", "kGrowth", 1.1, ("catch", "stack"), "1.05", "1.2"),
    Threshold("dynamics/time_step/step_chooser.hpp", "kLongestWay", 0.1, ("catch", "stack")),
    Threshold("dynamics/time_step/step_chooser.hpp", "kStepsOfChange", 2, ("catch", "sink")),
    Threshold("dynamics/time_step/step_chooser.cpp", "kLargestTurn", 1.0, ("spin",)),
    Threshold("dynamics/time_step/step_chooser.cpp", "kReleaseStep", 0.25, ("release",)),
    # kLargestTurnOfBar and kShortestBar follow from a bound that crushed_bars_test holds.
    Threshold("dynamics/time_step/motion_step.hpp", "kLargestMotion", 0.1, ("catch", "cross")),
    Threshold("dynamics/time_step/expected_contacts.hpp", "kExpectedOverlap", 0.02, ("catch", "bounce")),
    Threshold("dynamics/stiffness/spring_shares.cpp", "kLeast", 1e-3, ("catch", "sink")),
)


def run(*command):
    done = subprocess.run([str(part) for part in command], capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}\nended with {done.returncode}:\n{done.stdout}{done.stderr}")


class Copy:
    """Of the sources, to be changed and built."""

    def __init__(self, root, folder):
        self.sources = folder / "sources"
        self.build = folder / "build"
        self.runs = folder / "runs"
        if not self.sources.is_dir():
            self.sources.mkdir(parents=True)
            archive = subprocess.run(["git", "-C", root, "archive", "HEAD"], capture_output=True, check=True)
            subprocess.run(["tar", "-x", "-C", self.sources], input=archive.stdout, check=True)
            options = ("-DPLEKTON_BUILD_TESTS=OFF", "-DPLEKTON_BUILD_PYTHON=OFF", "-DPLEKTON_BUILD_DISTRIBUTED=OFF")
            run("cmake", "-S", self.sources, "--preset", "release", "-B", self.build, *options)
        self.program = self.build / "apps" / "plekton"

    def make(self):
        run("cmake", "--build", self.build, "--parallel", "2", "--target", "plekton")

    def ends_of(self, scenes):
        """By scene: the steps that a run takes, and energies (J) at its end over what went through."""
        ends = {}
        for scene in scenes:
            out = self.runs / scene
            shutil.rmtree(out, ignore_errors=True)
            run(self.program, "run", SCENES / f"{scene}.toml", "--out", out, "--quiet")
            with open(out / "energy.csv", encoding="utf-8", newline="") as table:
                rows = list(csv.DictReader(table))
            energies = [[float(row[f"{form} (J)"]) for form in FORMS] for row in rows]
            most = max(max(map(abs, row)) for row in energies)
            ends[scene] = [value / most for value in energies[-1]]
        return ends

    def with_value(self, threshold, value):
        """What comes of another value."""
        path = self.sources / threshold.file
        text = path.read_text(encoding="utf-8")
        changed, count = re.subn(rf"(\b{threshold.name} = )[^;]+;", rf"\g<1>{value};", text)
        if count != 1:
            sys.exit(f"{threshold.file}: {count} places say what {threshold.name} is; expected one")
        try:
            path.write_text(changed, encoding="utf-8")
            self.make()
            return self.ends_of(threshold.scenes)
        finally:
            path.write_text(text, encoding="utf-8")


def most_changed(before, after):
    """The form of energy that differs most, and by how much of all that went through."""
    changes = [abs(b - a) for a, b in zip(before, after, strict=True)]
    most = max(changes)
    return f"{100 * most:.2g} % ({FORMS[changes.index(most)]})" if most > 0.0 else "none"


def as_in_sources(root, threshold):
    """The value that the sources have; none if they do not say it once."""
    said = re.findall(rf"\b{threshold.name} = ([^;]+);", (root / threshold.file).read_text(encoding="utf-8"))
    factors = [float(part) for part in said[0].split("/")] if len(said) == 1 else []
    return factors[0] / factors[1] if len(factors) == 2 else next(iter(factors), None)


def check(root):
    wrong = [(of, as_in_sources(root, of)) for of in THRESHOLDS if as_in_sources(root, of) != of.value]
    for of, value in wrong:
        print(f"{of.file}: {of.name} is {value}; expected {of.value}, as here")
    return 1 if wrong else 0


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("root", type=Path)
    parser.add_argument("folder", type=Path, nargs="?")
    parser.add_argument("--only", nargs="*")
    parser.add_argument("--check", action="store_true")
    arguments = parser.parse_args()
    if arguments.check:
        sys.exit(check(arguments.root))
    if arguments.folder is None:
        parser.error("expected a folder for the copy and its build, or --check")
    copy = Copy(arguments.root.resolve(), arguments.folder.resolve())
    copy.make()
    as_is = copy.ends_of(sorted({scene for threshold in THRESHOLDS for scene in threshold.scenes}))
    print("| threshold | is | tried | scene: most that an energy changes |\n|---|---|---|---|", flush=True)
    for threshold in THRESHOLDS:
        if arguments.only and threshold.name not in arguments.only:
            continue
        for value in threshold.values():
            ends = copy.with_value(threshold, value)
            changes = ", ".join(f"{scene}: {most_changed(as_is[scene], ends[scene])}" for scene in threshold.scenes)
            print(f"| `{threshold.name}` | {threshold.value:g} | {value} | {changes} |", flush=True)


if __name__ == "__main__":
    main()
