# SPDX-License-Identifier: GPL-3.0-or-later
"""Finds the parameters with which the runs of a study come nearest to what was measured, with OpenTURNS (Debian: python3-openturns):

    plekton study apps/examples/shear_test/calibration.toml
    /usr/bin/python3 apps/examples/shear_test/calibrate.py out/calibration/results.csv apps/examples/shear_test/measured.csv

A quadratic surface is fitted to each result as a function of the parameters (of their logarithms where they span more than a factor
of three), and the sum of ((surface - measured) / deviation)^2 is made least. The deviation is that of the measured value (its column, one
standard deviation of the mean) and that of the surface together, which is the scatter s of the runs around it times
sqrt(unknowns / runs). With two parameters a picture, calibration.svg, is drawn beside the table, with gnuplot.
"""
import csv
import math
import re
import shutil
import subprocess
import sys
from pathlib import Path

try:
    import openturns as ot
except ImportError:
    sys.exit("calibrate.py: OpenTURNS is not installed for this Python (Debian: python3-openturns, used by /usr/bin/python3)")


class Parameter:
    """A column of values such as "22.5 deg", seen as a coordinate from -1 to 1."""

    def __init__(self, name, texts):
        words = [re.match(r"\s*([-+0-9.eE]+)\s*(.*)", text) for text in texts]
        self.name = name
        self.unit = words[0][2]
        self.values = [float(word[1]) for word in words]
        self.is_log = min(self.values) > 0 and max(self.values) > 3 * min(self.values)
        seen = [self.scaled(value) for value in self.values]
        self.low, self.high = min(seen), max(seen)

    def scaled(self, value):
        return math.log(value) if self.is_log else value

    def coordinate(self, value):
        return 2 * (self.scaled(value) - self.low) / (self.high - self.low) - 1

    def value(self, coordinate):
        scaled = self.low + 0.5 * (coordinate + 1) * (self.high - self.low)
        return math.exp(scaled) if self.is_log else scaled

    def text(self, value):
        return f"{value:.4g} {self.unit}".strip()


def table(path):
    try:
        with open(path, newline="", encoding="utf-8") as file:
            return list(csv.DictReader(file))
    except OSError as error:
        sys.exit(f"calibrate.py: {path}: {error.strerror}; run the study first")


def read(results, measured):
    """Parameters, and measured rows, with the results of all complete runs."""
    runs = [row for row in table(results) if row["status"] == "complete"]
    wanted = table(measured)
    if len(runs) < 6:
        sys.exit(f"calibrate.py: {results} has {len(runs)} complete runs; a surface needs more")
    heads = list(runs[0])
    for row in wanted:
        if row["result"] not in heads:
            sys.exit(f'calibrate.py: {measured}: {results} has no column "{row["result"]}"; it has {", ".join(heads)}')
    # A seed makes another packing; it is nothing to be found.
    names = [head for head in heads if "." in head and not head.endswith(".seed") and len({run[head] for run in runs}) > 1]
    return [Parameter(name, [run[name] for run in runs]) for name in names], wanted, runs


def fit_one(points, values, unknowns):
    """A surface through values, the scatter of the values around it, and the standard deviation of the surface itself.

    Values further from it than four times what is usual (1.48 of the median) are left out, once: a packing that gave way.
    """
    used = list(range(len(points)))
    for attempt in range(2):
        algorithm = ot.QuadraticLeastSquares(ot.Sample([points[i] for i in used]), ot.Sample([[values[i]] for i in used]))
        algorithm.run()
        surface = algorithm.getMetaModel()
        rest = [values[i] - surface(points[i])[0] for i in used]
        usual = 1.48 * sorted(abs(r) for r in rest)[len(rest) // 2]
        kept = [i for i, r in zip(used, rest) if abs(r) <= 4 * usual]
        if attempt == 1 or len(kept) == len(used) or len(kept) < 2 * unknowns:
            break
        print(f"left out: {len(used) - len(kept)} of {len(used)} runs, far from all others")
        used = kept
    scatter = math.sqrt(sum(r * r for r in rest) / max(1, len(used) - unknowns))
    return surface, scatter, scatter * math.sqrt(unknowns / len(used))


def fit(parameters, wanted, runs):
    """For each result a surface, its scatter and its deviation, in three lists."""
    points = [[p.coordinate(p.values[i]) for p in parameters] for i in range(len(runs))]
    n = len(parameters)
    unknowns = (n + 1) * (n + 2) // 2
    return zip(*(fit_one(points, [float(run[row["result"]]) for run in runs], unknowns) for row in wanted))


def least(objective, n):
    """The point in the cube where the objective is least, from several starts."""
    problem = ot.OptimizationProblem(ot.PythonFunction(n, 1, lambda x: [objective(x)]))
    problem.setBounds(ot.Interval([-1.0] * n, [1.0] * n))
    starts = ot.LowDiscrepancyExperiment(ot.SobolSequence(), ot.ComposedDistribution([ot.Uniform(-0.9, 0.9)] * n), 16).generate()
    solver = ot.MultiStart(ot.Cobyla(), starts)
    solver.setProblem(problem)
    solver.run()
    return list(solver.getResult().getOptimalPoint())


def deviations(surfaces, weights, x):
    """Standard deviations of the coordinates, by the slopes of the surfaces: the diagonal of (J^T W J)^-1."""
    n = len(x)
    matrix = [[0.0] * n for _ in range(n)]
    for surface, weight in zip(surfaces, weights):
        gradient = surface.gradient(x)
        for i in range(n):
            for j in range(n):
                matrix[i][j] += weight * gradient[i, 0] * gradient[j, 0]
    try:
        columns = [ot.Matrix(matrix).solveLinearSystem(ot.Point([float(i == j) for j in range(n)])) for i in range(n)]
    except (RuntimeError, TypeError):
        return [math.inf] * n
    return [math.sqrt(max(0.0, column[i])) for i, column in enumerate(columns)]


def draw(parameters, objective, best, picture):
    """Misfit over two parameters, with the runs and the answer."""
    gnuplot = shutil.which("gnuplot")
    if gnuplot is None:
        print("no picture: gnuplot is not installed (Debian: gnuplot-nox)")
        return
    a, b = parameters
    lines = ["$misfit << END"]
    steps = [i / 30 - 1 for i in range(61)]
    for x in steps:
        lines += [f"{a.value(x):.6g} {b.value(y):.6g} {math.sqrt(objective([x, y])):.6g}" for y in steps] + [""]
    lines += ["END", "$runs << END"] + [f"{x:.6g} {y:.6g}" for x, y in zip(a.values, b.values)] + ["END", "$best << END"]
    lines += [f"{best[0]:.6g} {best[1]:.6g}", "END"]
    quoted = [f"{p.name} ({p.unit})".replace("'", "''") for p in parameters]
    lines += ["set terminal svg size 900,640 noenhanced font 'sans,12' background 'white'", "set output"]
    lines += [f"set {axis}label '{text}'" for axis, text in zip("xy", quoted)]
    lines += [f"set logscale {axis}" for axis, p in zip("xy", parameters) if p.is_log]
    lines += [f"set {axis}range [{min(p.values):.6g}:{max(p.values):.6g}]" for axis, p in zip("xy", parameters)]
    lines += ["set key outside below noenhanced", "set cblabel 'misfit, in standard deviations'", "set cbrange [0:*]",
              "set palette defined (0 '#08519c', 0.3 '#6baed6', 1 '#f7fbff')", "set view map",
              "splot $misfit using 1:2:3 with pm3d notitle, "
              "$runs using 1:2:(0) with points pointtype 7 pointsize 0.4 linecolor 'gray40' title 'runs', "
              "$best using 1:2:(0) with points pointtype 2 pointsize 1.6 linewidth 2 linecolor '#cb181d' title 'answer'"]
    drawn = subprocess.run([gnuplot, "-d", "-"], input="\n".join(lines) + "\n", capture_output=True, text=True, check=False)
    if drawn.returncode != 0 or not drawn.stdout:
        print("no picture: gnuplot:", drawn.stderr.strip().splitlines()[-1:] or "failed")
        return
    picture.write_text(drawn.stdout, encoding="utf-8")
    print(f"wrote {picture}")


def main():
    if len(sys.argv) != 3:
        sys.exit("usage: calibrate.py RESULTS.csv MEASURED.csv")
    parameters, wanted, runs = read(sys.argv[1], sys.argv[2])
    surfaces, scatters, errors = fit(parameters, wanted, runs)
    targets = [float(row["value"]) for row in wanted]
    weights = [1 / (float(row["deviation"]) ** 2 + e**2) for row, e in zip(wanted, errors)]

    def objective(x):
        return sum(w * (surface(x)[0] - t) ** 2 for surface, t, w in zip(surfaces, targets, weights))

    x = least(objective, len(parameters))
    best = [p.value(c) for p, c in zip(parameters, x)]
    print(f"{len(runs)} runs, {len(wanted)} measured values")
    for p, c, value, deviation in zip(parameters, x, best, deviations(surfaces, weights, x)):
        low, high = (p.value(max(-1.0, min(1.0, c + d))) for d in (-deviation, deviation))
        print(f"{p.name}: {p.text(value)} (one standard deviation: {p.text(low)} to {p.text(high)}"
              f"{'; at the end of its range, widen it' if abs(c) > 0.99 else ''})")
    for row, surface, scatter in zip(wanted, surfaces, scatters):
        print(f"{row['result']}: measured {float(row['value']):.4g}, there {surface(x)[0]:.4g}, single runs scatter by {scatter:.2g}")
    print("to see it: plekton run", Path(__file__).parent / "shear_test.toml",
          " ".join(f"--set {p.name}='{p.text(value)}'" for p, value in zip(parameters, best)))
    if len(parameters) == 2:
        draw(parameters, objective, best, Path(sys.argv[1]).parent / "calibration.svg")


main()
