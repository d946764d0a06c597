# SPDX-License-Identifier: GPL-3.0-or-later
"""Says how strong samples were in triaxial tests, and whether that can be: python3 check.py RUN [RUN ...]

RUN is the folder of a run of triaxial_membrane.toml. Of several runs the densest has to dilate more, and to bear more, than the loosest.
Writes triaxial.csv into each folder: axial strain, deviator stress, volume strain. Ends 1 where something is out of its bounds.
"""
import math
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from results import Bounds, Frame, columns, frames, mean, report_of, runs_of_arguments, write  # noqa: E402

CELL = 25e3  # Pa, that the scenario says
HALF_THICKNESS = 1e-3  # m
SHEET = 300.0  # N/m
POISSON = 0.45


def nodes_around(points):
    """Nodes of a ring of the membrane as it was drawn: those of the first one are level."""
    return next(i for i, point in enumerate(points) if point[2] != points[0][2])


def rings(points, around):
    """(height, area inside of the membrane) of each ring of nodes, m and m2. What follows it in the file begins lower, with the lower platen."""
    result = []
    for begin in range(0, len(points), around):
        ring = points[begin : begin + around]
        double = sum(a[0] * b[1] - a[1] * b[0] for a, b in zip(ring, ring[1:] + ring[:1]))
        length = sum(math.dist(a, b) for a, b in zip(ring, ring[1:] + ring[:1]))
        height = sum(p[2] for p in ring) / around
        if result and height < result[-1][0]:
            break
        result.append((height, 0.5 * double - HALF_THICKNESS * length))
    return result


class Test:
    """The shear stage of a run, at the times of its frames."""

    def __init__(self, run):
        self.report = report_of(run)
        begin = self.report["stages"][0]["end_s"]
        force, core = columns(run / "reactions.csv"), columns(run / "measures" / "core.csv")
        times = force["time"]
        self.strain, self.volume, self.axial, self.radial, self.bulge, self.balance, self.inside = ([] for _ in range(7))
        first = None
        sheets = frames(run, "membranes")
        around = nodes_around(Frame(sheets[0][1]).points())
        for moment, file in sheets:
            rows = [i for i, t in enumerate(times) if abs(t - moment) < 2.5e-3]
            if moment < begin or not rows:
                continue
            of = lambda history, name: mean([history[name][i] for i in rows])
            section = rings(Frame(file).points(), around)
            height = section[-1][0] - section[0][0]
            volume = sum(0.5 * (a[1] + b[1]) * (b[0] - a[0]) for a, b in zip(section, section[1:]))
            share = [(z - section[0][0]) / height for z, _ in section]
            middle = mean([area for s, (_, area) in zip(share, section) if 0.3 < s < 0.7])
            near_ends = mean([area for s, (_, area) in zip(share, section) if 0.04 < min(s, 1 - s) < 0.15])
            first = first or (volume, height, middle, of(core, "porosity"), middle / near_ends)
            above = of(force, "upper platen.force_z")
            below = of(force, "lower platen.force_z")
            # The membrane bears some of it: a hoop of the sheet, whose radius grows.
            radius = math.sqrt(middle / math.pi)
            hoop = math.sqrt(middle / first[2]) - 1
            shortening = height / first[1] - 1
            tension = SHEET / (1 - POISSON**2) * (hoop + POISSON * shortening)
            self.strain.append(-shortening)
            self.volume.append(volume / first[0] - 1)
            self.axial.append(0.5 * (above - below) / middle)
            self.radial.append(CELL + max(0.0, tension) / radius)
            self.bulge.append(math.sqrt(middle / near_ends / first[4]))
            self.balance.append((above + below) / (0.5 * (above - below)))
            self.inside.append((-of(core, "stress_zz"), -0.5 * (of(core, "stress_xx") + of(core, "stress_yy"))))
        self.porosity = first[3]
        write(run / "triaxial.csv", ["axial strain (%)", "deviator stress (kPa)", "volume strain (%)"],
              [(100 * e, 1e-3 * (a - r), 100 * v) for e, a, r, v in zip(self.strain, self.axial, self.radial, self.volume)], digits=4)

    def smooth(self, i):
        """Ratio of stresses, over five frames."""
        rows = range(i - 2, i + 3)
        return sum(self.axial[k] for k in rows) / sum(self.radial[k] for k in rows)

    def dilation(self, i):
        """Slope of the volume over the strain, over 2 % of strain."""
        rows = [k for k, e in enumerate(self.strain) if abs(e - self.strain[i]) < 0.01]
        return (self.volume[rows[-1]] - self.volume[rows[0]]) / (self.strain[rows[-1]] - self.strain[rows[0]])


def friction_angle(ratio):
    """In degrees, of a ratio of principal stresses."""
    return math.degrees(math.asin((ratio - 1) / (ratio + 1)))


def check(test, bounds):
    inner = range(2, len(test.strain) - 2)
    peak = max(inner, key=test.smooth)
    test.peak = friction_angle(test.smooth(peak))
    late = [k for k in inner if test.strain[k] > 0.03]
    print(f"  porosity of the core {test.porosity:.3f}; largest deviator stress {1e-3 * max(a - r for a, r in zip(test.axial, test.radial)):.1f} kPa,"
          f" largest ratio at {100 * test.strain[peak]:.1f} % of strain; volume {100 * min(test.volume):.2f} %, at the end {100 * test.volume[-1]:+.2f} %")
    bounds.expect("peak friction angle (deg)", test.peak, 20, 45, "grains of tan 0.5")
    if test.dilation(peak) > 0:
        # Rowe (1962): the part of the strength that dilation does not explain. A loose sample collapses besides.
        without = friction_angle(test.smooth(peak) / (1 + test.dilation(peak)))
        bounds.expect("friction angle without dilation at the peak (deg)", without, 20, 30, "Rowe: near that of the grains, 26.6")
    bounds.expect("axial force below over above, beyond 1", mean([test.balance[k] for k in late]), -0.02, 0.02, "balance")
    bounds.expect("axial stress in the core over that of platens", mean([test.inside[k][0] / test.axial[k] for k in late]), 0.85, 1.15, "Love and Weber")
    bounds.expect("radial stress in the core over cell and membrane", mean([test.inside[k][1] / test.radial[k] for k in late]), 0.85, 1.15, "Love and Weber")
    bounds.expect("radius at half height over that near the ends", test.bulge[-1], 1.01, 1.15, "rough platens: it bulges")
    bounds.expect("grains through the membrane", test.report["pass_throughs"] + test.report["lost_grains"], 0, 0, "it holds")
    bounds.expect_sound(test.report)


def main():
    bounds, tests = Bounds(), []
    for run in runs_of_arguments(__doc__):
        print(run)
        tests.append(Test(run))
        check(tests[-1], bounds)
    tests.sort(key=lambda test: test.porosity)
    if len(tests) > 1:
        dense, loose = tests[0], tests[-1]
        print("densest and loosest")
        bounds.expect("porosity of the loose over that of the dense", loose.porosity / dense.porosity, 1.05, 1.4, "they differ")
        bounds.expect("volume of the dense at the end", dense.volume[-1], 0.01, 0.1, "it dilates")
        bounds.expect("volume of the loose at the end", loose.volume[-1], -0.1, 0.0, "it contracts")
        bounds.expect("peak of the dense beyond that of the loose (deg)", dense.peak - loose.peak, 1, 25, "density makes strength")
    sys.exit(0 if bounds.hold else 1)


if __name__ == "__main__":
    main()
