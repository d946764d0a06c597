# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs an application of apps/examples and its check; then with wrong physics, which the check has to see.

Usage: python3 applications_test.py PROGRAM ROOT NAME

NAME is the folder, and where its check is not check.py, that one's name after a space: "rockfall_net punch_check".

Some are also run for a short while with 1 and 2 threads, which have to write the same bytes. With PLEKTON_APPLICATIONS=threads in the
environment that is all that is done, but with every scenario that the check is for, whole, with 1, 2 and 4 threads (no more are started
than there are processors), and each has a row in a table. It takes up to some minutes each.
"""

import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

COARSE_NET = [
    f"membranes.net.{setting}"
    for setting in (
        "shape.mesh_size=200 mm",
        "shape.twist_length=100 mm",
        "shape.wire_height=100 mm",
        "shape.meshes=[15, 15]",
        "thickness=8 mm",
        'wire=[["1.2 %", "6 kN"], ["5 %", "9.6 kN"], ["12 %", "10.6 kN"]]',
        'twist_wire=[["1.2 %", "12 kN"], ["4 %", "18 kN"], ["9 %", "20.4 kN"]]',
    )
]
"""Half as many wires across, each twice as strong: a few seconds instead of a minute."""

COARSE_PANEL = [
    f"membranes.net.{setting}"
    for setting in (
        "shape.mesh_size=160 mm",
        "shape.twist_length=80 mm",
        "shape.wire_height=60 mm",
        "shape.meshes=[19, 21]",
        "thickness=5.4 mm",
        'wire=[["0.19230769 %", "2862.8 N"], ["1.92 %", "3686.6 N"], ["5 %", "4384.8 N"], ["15 %", "5865.2 N"], ["35 %", "6479.6 N"]]',
        'twist_wire=[["0.19230769 %", "2115.2 N"], ["2 %", "3239.8 N"], ["6 %", "4333.4 N"], ["14 %", "4787.4 N"]]',
    )
]
"""Half as many wires across, each twice as strong."""

APPLICATIONS = {
    "pullout_grid": {
        "right": {"grid": ("pullout_grid", []), "membrane": ("../pullout_membrane/pullout_membrane", [])},
        "wrong": {
            "a membrane with more friction than was said": (
                "../pullout_membrane/pullout_membrane",
                ["stages.pull.materials.soil.friction_angle=40 deg", "stages.pull.materials.plastic.friction_angle=40 deg"],
            )
        },
    },
    "membrane_tour": {
        "right": {"tour": ("membrane_tour", [])},
        "wrong": {
            "a tenth more friction": ("membrane_tour", ["materials.ball.friction_angle=22 deg", "simulation.duration=2.5 s"]),
            "bars that are thinner than said": ("membrane_tour", ["membranes.net.thickness=9.9 mm", "simulation.duration=2.5 s"]),
        },
    },
    "buckling_tube": {
        "right": {"lattice": ("buckling_tube", []), "sheet": ("continuum", [])},
        "wrong": {"beams that are a tenth too thick": ("buckling_tube", ["membranes.tube.thickness=2.2 mm"])},
    },
    "shear_box": {
        "right": {"box": ("shear_box", [])},
        "wrong": {"sand that slips": ("shear_box", ["stages.confine.materials.sand.friction_angle=5 deg"])},
    },
    "rockfall_net": {
        "right": {"net": ("rockfall_net", COARSE_NET)},
        "wrong": {
            "numerical damping": ("rockfall_net", [*COARSE_NET, "simulation.damping=0.05"]),
            "a lighter boulder": ("rockfall_net", [*COARSE_NET, "materials.rock.density=2500 kg/m3"]),
            "brakes that hold more": (
                "rockfall_net",
                [*COARSE_NET, *(f"ties.{side}_brakes.brake.force=11 kN" for side in ("left", "right", "front", "back"))],
            ),
        },
    },
    "rockfall_net punch_check": {
        "right": {"panel": ("punch_test", COARSE_PANEL)},
        "wrong": {
            "wire that breaks at a third of its strain": (
                "punch_test",
                [*COARSE_PANEL, 'membranes.net.wire=[["0.19230769 %", "1431.4 N"], ["1.5 %", "1843.3 N"]]'],
            ),
        },
    },
    "triaxial_membrane": {
        "right": {
            "dense": ("triaxial_membrane", []),
            "loose": (
                "triaxial_membrane",
                ["grains.sand.porosity=0.52", "stages.confine.materials.sand.friction_angle=26.565 deg"],
            ),
        },
        "wrong": {
            "grains that slip": (
                "triaxial_membrane",
                ["stages.shear.materials.sand.friction_angle=5 deg", "stages.shear.end.displacement.distance=4 mm"],
            ),
            "more pressure than was said": (
                "triaxial_membrane",
                ["stages.confine.loads.cell.pressure=-32 kPa", "stages.shear.end.displacement.distance=4 mm"],
            ),
        },
    },
    "tyre": {
        "right": {"floor": ("tyre", []), "gravel": ("soil", [])},
        "wrong": {"a floor without friction": ("tyre", ["materials.rubber.friction_angle=0", "stages.roll.end.duration=0.3 s"])},
    },
    "silo_bag": {
        "right": {"bag": ("silo_bag", [])},
        "wrong": {
            "gravel that is lighter than said": ("silo_bag", ["materials.gravel.density=2300 kg/m3"]),
            "damping that bears weight": ("silo_bag", ["simulation.damp_gravity=false", "simulation.damping=0.5"]),
        },
    },
    "gas_sphere": {
        "right": {"ball": ("gas_sphere", [])},
        "wrong": {
            "a ball that has to breathe": ("gas_sphere", ["stages.hang.membranes.ball.prestrain=0", "stages.press.end.duration=0.1 s"]),
            "gas that grows warm": ("gas_sphere", ["stages.hang.loads.gas.gas.exponent=1.4", "stages.press.end.duration=0.1 s"]),
        },
    },
    "bouncing_sphere": {
        "right": {
            "wall": ("bouncing_sphere", []),
            "half the step": ("bouncing_sphere", ["simulation.time_step=2.5 us"]),
            "gas": ("gas", []),
            "incline": ("incline", []),
            "gas on the incline": ("gas_incline", []),
        },
        "wrong": {
            "a wall that takes energy": ("bouncing_sphere", ["simulation.damping=0.1"]),
            "gas that is kept at its temperature": ("gas", ["stages.inflate.loads.air.gas.exponent=1"]),
            "more friction than there is": ("incline", ["materials.plastic.friction_angle=30 deg"]),
            "an incline without friction": ("gas_incline", ["materials.leather.friction_angle=0"]),
        },
    },
}
"""For each the runs, scenario and what is set, that its check passes, and those that it must not pass."""


SHORT = {
    "pullout_grid": ("pullout_grid", [], ["--until", "level"]),
    "buckling_tube": ("continuum", ["simulation.duration=30 ms"], []),
}
"""What is run for a short while with 1 and 2 threads: scenario, what is set, options."""


def run(program, folder, scenario, settings, out, options=()):
    options = [*options, *(word for setting in settings for word in ("--set", setting))]
    command = [program, "run", folder / f"{scenario}.toml", "--out", out, "--quiet", *options]
    subprocess.run(command, check=True, stderr=subprocess.PIPE)
    return out


def check(folder, name, runs):
    script = folder / f"{(name.split() + ['check'])[1]}.py"
    done = subprocess.run([sys.executable, "-B", script, *runs], capture_output=True, text=True)
    return done.returncode, done.stdout + done.stderr


def files_of(folder):
    """Bytes of all files of a run that do not tell of its threads, by name, and the states in run.json."""
    files = {str(path.relative_to(folder)): path for path in sorted(folder.rglob("*")) if path.is_file()}
    report = json.loads(files.pop("run.json").read_text(encoding="utf-8"))
    scenario = files.pop("scenario-as-run.toml").read_text(encoding="utf-8").splitlines()
    contents = {name: path.read_bytes() for name, path in files.items()}
    contents["scenario-as-run.toml"] = [line for line in scenario if not line.startswith("# --set simulation.threads")]
    contents["run.json: states"] = report["states"]
    contents["run.json: stages"] = report.get("stages")
    return contents, report


def compare_threads(label, make, counts, work):
    """Makes a run with each number of threads; says how it went, and returns what differs from one thread."""
    differ, first, report = [], None, None
    for threads in counts:
        contents, told = files_of(make(Path(work, f"{label} {threads}"), ["--threads", str(threads)]))
        if first is None:
            first, report = contents, told
        names = [name for name in sorted(first.keys() | contents.keys()) if first.get(name) != contents.get(name)]
        if names:
            differ.append(f"{label}: {threads} threads differ from {counts[0]} in {len(names)} of {len(first)}: {', '.join(names[:5])}")
    red = [entry["name"] for entry in report["certificate"] if entry["verdict"] != "green"]
    print(
        f"| {label} | {report['timing']['wall_time_s']:.1f} s | {report['energy_closure']:.1e} | {', '.join(red) or 'none'} "
        f"| {'no' if differ else f'yes, {len(first)} files'}, {', '.join(map(str, counts))} threads |",
        flush=True,
    )
    return differ


def compare_all(program, folder, name, work):
    print("| run | wall time, 1 thread | energy closure | red rows | same bits |\n|---|---|---|---|---|")
    return [
        difference
        for label, what in APPLICATIONS[name]["right"].items()
        for difference in compare_threads(f"{name}, {label}", lambda out, options: run(program, folder, *what, out, options), (1, 2, 4), work)
    ]


def compare_short(program, folder, name, work):
    if name not in SHORT:
        return []
    scenario, settings, more = SHORT[name]
    return compare_threads(f"{name}, for a short while", lambda out, options: run(program, folder, scenario, settings, out, [*more, *options]), (1, 2), work)


def run_checks(program, folder, name, work):
    failures = []
    right = [run(program, folder, *what, Path(work, label)) for label, what in APPLICATIONS[name]["right"].items()]
    code, said = check(folder, name, right)
    print(said)
    if code != 0:
        failures.append(f"{name}: the check fails")
    for label, what in APPLICATIONS[name]["wrong"].items():
        code, said = check(folder, name, [run(program, folder, *what, Path(work, "wrong " + label))])
        if code != 1 or "OUT OF BOUNDS" not in said:
            failures.append(f"{name}: the check passes {label}\n{said}")
    return failures


def main():
    program, name = sys.argv[1], sys.argv[3]
    folder = Path(sys.argv[2], "apps/examples", name.split()[0])
    with tempfile.TemporaryDirectory() as work:
        if os.environ.get("PLEKTON_APPLICATIONS") == "threads":
            failures = compare_all(program, folder, name, work)
        else:
            failures = run_checks(program, folder, name, work) + compare_short(program, folder, name, work)
    print("\n".join(failures))
    sys.exit(1 if failures else 0)


main()
