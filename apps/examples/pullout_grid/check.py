# SPDX-License-Identifier: GPL-3.0-or-later
"""Says how inclusions were pulled out, and whether that can be: python3 check.py RUN [RUN ...]

RUN is the folder of a run of pullout_grid.toml or pullout_membrane.toml, under any pressure. With some pressures it fits the line of
friction and adhesion, of some beds under the same pressure it says mean and scatter. Writes forces.csv (the force along the inclusion),
displacements.csv (of grains, by height), shares.csv (F / (2 sigma A) over the way) and friction.csv (its mean) into each folder. Ends 1
where something is out of its bounds.
"""
import math
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from results import Bounds, Frame, columns, frames, mean, red_rows, report_of, runs_of_arguments, write  # noqa: E402

SOIL = math.tan(math.radians(20))  # friction of the grains, and of them on the inclusion
PLAN = 54e-3 * 104e-3  # m2, of the bed
WIDTH, LENGTH = 50e-3, 99e-3  # m, of what of the inclusion is in the bed at first
RADIUS = 1e-3  # m, of the bars
ACROSS = 6  # nodes in a row
BAND = 4e-3  # m, height of the bands whose grains are counted together
WEDGED = 0.25  # largest overlap over radius that README.md explains


class Inclusion:
    """Rows of nodes of the inclusion in a frame, from the front to the back, and the force in it between any two of them."""

    def __init__(self, path):
        frame = Frame(path)
        owner = frame.array("CellData", "membrane")
        lines, tension = frame.array("Lines", "connectivity"), frame.array("CellData", "tension")
        self.points, force = frame.vectors("Points", "Points"), frame.vectors("PointData", "force")
        bars = [(lines[2 * i], lines[2 * i + 1], tension[i]) for i in range(len(lines) // 2) if owner[i] == 0]
        nodes = sorted({node for bar in bars for node in bar[:2]})
        rows = [nodes[i : i + ACROSS] for i in range(0, len(nodes), ACROSS)]
        row_of = {node: k for k, row in enumerate(rows) for node in row}
        self.y, self.z = ([mean([self.points[i][axis] for i in row]) for row in rows] for axis in (1, 2))
        # Of what all bars between two rows carry, the part along the pull.
        self.tension = [0.0] * (len(rows) - 1)
        for a, b, f in bars:
            along = abs(self.points[b][1] - self.points[a][1]) / math.dist(self.points[a], self.points[b])
            for k in range(*sorted((row_of[a], row_of[b]))):
                self.tension[k] += f * along
        # What speeds up all that is behind.
        self.unbalanced = [sum(force[i][1] for row in rows[k + 1 :] for i in row) for k in range(len(rows) - 1)]

    def soil(self, path):
        """What grains hold back behind each gap between two rows, and what all others do: a bar hands a force on to its ends by the lever."""
        frame = Frame(path)
        kinds, groups = ([frame.array("CellData", what + side) for side in "ab"] for what in ("kind_", "group_"))
        point, normal, press, rub = (frame.vectors("CellData", name) for name in ("point", "normal", "normal_force", "tangential_force"))
        behind, others = [0.0] * len(self.tension), 0.0
        for i in range(len(point)):
            side = next((s for s in (0, 1) if 1 <= kinds[s][i] <= 3 and groups[s][i] == 0), None)
            if side is None:
                continue
            sign = 1 if side == 1 else -1  # forces are those on b, normals go from a to b
            force = sign * (press[i][1] + rub[i][1])
            others += 0.0 if kinds[1 - side][i] == 0 else force
            axis = point[i][1] + sign * RADIUS * normal[i][1]
            for k, (front, back) in enumerate(zip(self.y, self.y[1:])):
                behind[k] += force * min(1.0, max(0.0, (axis - front) / (back - front)))
        return behind, others


class PullOut:
    """Pull, pressure and way of the last stage of a run."""

    def __init__(self, run):
        self.report = report = report_of(run)
        history = columns(run / "reactions.csv")
        begin = report["stages"][-2]["end_s"]
        rows = [i for i, t in enumerate(history["time"]) if t > begin]
        of = lambda name: [history[name][i] for i in rows]
        self.kind = report["names"]["membranes"][0]
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
        write(run / "shares.csv", ["way of the front edge (mm)", "F / (2 sigma A)"], [(1e3 * u, share) for u, share in zip(self.way, shares)])
        write(run / "friction.csv", ["pressure (kPa)", "shear stress on either side (kPa)"], [(1e-3 * self.sigma, 1e-3 * self.share * self.sigma)])
        self.along(run, [(t, f) for t, f in zip(of("time"), of("front edge.force_y"))], history["time"][rows[later[0]]])
        self.heights(run, begin)

    def along(self, run, pull, since):
        """Mean force in the inclusion, from its bars and from the grains that touch it, over the later half of the way."""
        contacts = dict(frames(run, "contacts"))
        looks = []
        for t, path in frames(run, "membranes"):
            if t >= since:
                inclusion = Inclusion(path)
                soil, others = inclusion.soil(contacts[t])
                looks.append((inclusion, soil, others, abs(min(pull, key=lambda entry: abs(entry[0] - t))[1])))
        over = lambda values: [mean(column) for column in zip(*values)]
        self.pull = mean([look[3] for look in looks])
        self.tension = over([look[0].tension for look in looks])
        self.soil = over([[s - u for s, u in zip(look[1], look[0].unbalanced)] for look in looks])
        self.others = mean([look[2] for look in looks])
        y = over([look[0].y for look in looks])
        middles = [0.5 * (a + b) - y[0] for a, b in zip(y, y[1:])]
        write(run / "forces.csv", ["way from the front edge (mm)", "force in the bars (N)", "held by soil behind (N)", "pull (N)"],
              [(1e3 * middle, bars, soil, self.pull) for middle, bars, soil in zip(middles, self.tension, self.soil)])

    def heights(self, run, begin):
        """Mean way of grains along the pull by their height over the inclusion, from the beginning of the pull to its end."""
        series = {t: path for t, path in frames(run, "grains") if t >= begin - 1e-9}
        first, last = (Frame(series[t]) for t in (min(series), max(series)))
        middle = mean(Inclusion(dict(frames(run, "membranes"))[min(series)]).z[1:])
        bands = {}
        for a, b in zip(first.vectors("Points", "Points"), last.vectors("Points", "Points")):
            bands.setdefault(math.floor((a[2] - middle) / BAND), []).append(a[1] - b[1])
        bands = {band: ways for band, ways in sorted(bands.items()) if len(ways) >= 50}
        self.above = [mean(ways) for band, ways in bands.items() if band >= 0]
        self.below = [mean(ways) for band, ways in reversed(bands.items()) if band < 0]
        write(run / "displacements.csv", ["height over the inclusion (mm)", "mean way along the pull (mm)", "grains"],
              [(1e3 * (band + 0.5) * BAND, 1e3 * mean(ways), len(ways)) for band, ways in bands.items()])


def fit(points):
    """Friction and adhesion of the straight line through (pressure, shear stress)."""
    mean_s, mean_t = (mean([p[k] for p in points]) for k in (0, 1))
    slope = sum((s - mean_s) * (t - mean_t) for s, t in points) / sum((s - mean_s) ** 2 for s, _ in points)
    return slope, mean_t - slope * mean_s


def main():
    bounds = Bounds()
    expect = bounds.expect
    tests = {}
    for run in runs_of_arguments(__doc__):
        test = PullOut(run)
        tests.setdefault(test.kind, []).append(test)
        print(f"{run}: {test.kind}, pressure {test.sigma / 1e3:.1f} kPa, pull {max(test.force):.1f} N, back edge moved {1e3 * test.back:.2f} of {1e3 * test.way[-1]:.2f} mm")
        if test.kind == "membrane":
            expect("pull over 2 sigma A, later half", test.share, 0.18, 0.364, "A22")
            expect("largest", test.largest, 0.0, SOIL * 1.02, "tan 20 deg: it slides")
        else:
            expect("pull over 2 sigma A, later half", test.share, 0.35, 0.65, "A22")
        # Cut anywhere, the part behind is in balance; bars that bend carry a little across themselves.
        expect("force of bars against that of soil, over pull", max(abs(a - b) for a, b in zip(test.tension, test.soil)) / test.pull, 0.0, 0.005, "balance behind any cut")
        expect("force of what is no grain, over the pull", abs(test.others) / test.pull, 0.0, 0.01, "walls have no friction")
        expect("first bars over the pull", test.tension[0] / test.pull, 0.94, 1.005, "the edge itself bears at most half a bar's soil")
        steps = [a - b for a, b in zip(test.tension, [*test.tension[1:], 0.0])]
        expect("least fall of the force from row to row, over pull", min(steps) / test.pull, 0.0, 1.0, "soil holds back everywhere")
        expect("force half way along over the pull", test.tension[len(test.tension) // 2] / test.pull, 0.1, 0.5, "it gives: the front slides first")
        for side, ways in (("above", test.above), ("below", test.below)):
            expect(f"way of the grains right {side}, over that of the pull", ways[0] / test.way[-1], 0.0, 1.0, "dragged along")
            rises = [b - a for a, b in zip(ways, ways[1:])]
            expect("largest rise of it from band to band outwards", max(rises) / test.way[-1], -1.0, 0.02, "it fades")
        bounds.expect_energy(test.report)
        new = red_rows(test.report, {"largest_overlap_ratio": WEDGED})
        expect("red rows of the certificate", len(new), 0, 0, ", ".join(new) or f"but for overlaps up to {WEDGED:.0%}, see README.md")
    for kind, runs in tests.items():
        runs.sort(key=lambda test: test.sigma)
        for a, b in zip(runs, runs[1:]):
            if 1.9 < b.sigma / a.sigma < 2.1:
                expect(f"{kind}: change from {a.sigma / 1e3:.0f} to {b.sigma / 1e3:.0f} kPa", b.share / a.share - 1, -0.15, 0.15, "Coulomb")
        if len(runs) > 2 and runs[-1].sigma > 1.5 * runs[0].sigma:
            slope, adhesion = fit([(test.sigma, test.share * test.sigma) for test in runs])
            print(f"  {kind}: {math.degrees(math.atan(slope)):.1f} deg and {adhesion / 1e3:.2f} kPa are its friction and adhesion")
        while runs:
            same = [test for test in runs if test.sigma < 1.2 * runs[0].sigma]
            runs = runs[len(same) :]
            if len(same) > 1:
                shares = [test.share for test in same]
                scatter = math.sqrt(sum((share - mean(shares)) ** 2 for share in shares) / (len(shares) - 1))
                print(f"  {kind}, {mean([test.sigma for test in same]) / 1e3:.1f} kPa: {mean(shares):.3f}, with a standard deviation of {scatter:.3f}, in {len(same)} beds")
    if len(tests) > 1:
        for grid in tests["grid"]:
            for membrane in tests["membrane"]:
                if abs(grid.sigma / membrane.sigma - 1) < 0.1:
                    expect(f"grid over membrane, {grid.sigma / 1e3:.0f} kPa", grid.share / membrane.share, 1.0, 4.0, "it interlocks")
    sys.exit(0 if bounds.hold else 1)


main()
