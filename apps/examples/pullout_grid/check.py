# SPDX-License-Identifier: GPL-3.0-or-later
"""Says how inclusions were pulled out, and whether that can be: python3 check.py RUN [RUN ...]

RUN is the folder of a run of pullout_grid.toml or pullout_membrane.toml, under any pressure. With some pressures it fits the line of
friction and adhesion. Ends 1 where something is out of its bounds.
"""
import csv
import json
import math
import sys
from pathlib import Path

SOIL = math.tan(math.radians(20))  # friction of the grains, and of them on the inclusion
PLAN = 54e-3 * 104e-3  # m2, of the bed
WIDTH, LENGTH = 50e-3, 99e-3  # m, of what of the inclusion is in the bed at first


def columns(path):
    """A history as {head without unit: values}."""
    with open(path, newline="") as file:
        rows = list(csv.reader(file))
    return {head.split(" (")[0]: [float(row[i]) for row in rows[1:]] for i, head in enumerate(rows[0])}


class PullOut:
    """Pull, pressure and way of the last stage of a run."""

    def __init__(self, run):
        report = json.loads((run / "run.json").read_text())
        history = columns(run / "reactions.csv")
        begin = report["stages"][-2]["end_s"]
        rows = [i for i, t in enumerate(history["time"]) if t > begin]
        of = lambda name: [history[name][i] for i in rows]
        self.kind = report["names"]["membranes"][0]
        self.closure = report["energy_closure"]
        self.way = [of("front edge.position_y")[0] - y for y in of("front edge.position_y")]
        self.back = of("back edge.position_y")[0] - of("back edge.position_y")[-1]
        self.force = [abs(f) for f in of("front edge.force_y")]
        # Half of the soil's weight, at the middle, is in the mean of both.
        self.pressure = [0.5 * (abs(a) + abs(b)) / PLAN for a, b in zip(of("lid.force_z"), of("floor.force_z"))]
        shares = [f / (2 * s * WIDTH * (LENGTH - u)) for f, s, u in zip(self.force, self.pressure, self.way)]
        later = [i for i, u in enumerate(self.way) if u > 0.5 * self.way[-1]]
        self.share = sum(shares[i] for i in later) / len(later)
        self.largest = max(shares)
        self.sigma = sum(self.pressure[i] for i in later) / len(later)


def fit(points):
    """Friction and adhesion of the straight line through (pressure, shear stress)."""
    mean_s, mean_t = (sum(p[k] for p in points) / len(points) for k in (0, 1))
    slope = sum((s - mean_s) * (t - mean_t) for s, t in points) / sum((s - mean_s) ** 2 for s, _ in points)
    return slope, mean_t - slope * mean_s


def main():
    holds = True

    def expect(what, value, low, high, source):
        nonlocal holds
        fits = low <= value <= high
        holds &= fits
        print(f"  {what:<44} {value:8.4g}  {low:.4g} to {high:.4g} ({source}){'' if fits else '  OUT OF BOUNDS'}")

    if len(sys.argv) < 2:
        sys.exit(__doc__)
    tests = {}
    for run in map(Path, sys.argv[1:]):
        test = PullOut(run)
        tests.setdefault(test.kind, []).append(test)
        print(f"{run}: {test.kind}, pressure {test.sigma / 1e3:.1f} kPa, pull {max(test.force):.1f} N, back edge moved {1e3 * test.back:.2f} of {1e3 * test.way[-1]:.2f} mm")
        if test.kind == "membrane":
            expect("pull over 2 sigma A, later half", test.share, 0.18, 0.364, "A22")
            expect("largest", test.largest, 0.0, SOIL * 1.02, "tan 20 deg: it slides")
        else:
            expect("pull over 2 sigma A, later half", test.share, 0.35, 0.65, "A22")
        expect("energy closure", test.closure, 0.0, 0.01, "energy is kept")
    for kind, runs in tests.items():
        runs.sort(key=lambda test: test.sigma)
        for a, b in zip(runs, runs[1:]):
            if 1.9 < b.sigma / a.sigma < 2.1:
                expect(f"{kind}: change from {a.sigma / 1e3:.0f} to {b.sigma / 1e3:.0f} kPa", b.share / a.share - 1, -0.15, 0.15, "Coulomb")
        if len(runs) > 2:
            slope, adhesion = fit([(test.sigma, test.share * test.sigma) for test in runs])
            print(f"  {kind}: {math.degrees(math.atan(slope)):.1f} deg and {adhesion / 1e3:.2f} kPa are its friction and adhesion")
    if len(tests) > 1:
        for grid in tests["grid"]:
            for membrane in tests["membrane"]:
                if abs(grid.sigma / membrane.sigma - 1) < 0.1:
                    expect(f"grid over membrane, {grid.sigma / 1e3:.0f} kPa", grid.share / membrane.share, 1.0, 4.0, "it interlocks")
    sys.exit(0 if holds else 1)


main()
