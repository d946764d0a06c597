# SPDX-License-Identifier: GPL-3.0-or-later
"""Says how a ball of gas lies on soil, and whether that can be: python3 check.py RUN [RUN ...]

RUN is the folder of a run of gas_sphere.toml. Ends 1 where something is out of its bounds.
"""
import math
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from results import Bounds, Frame, check_runs, columns, frames, mean, report_of  # noqa: E402

OUTSIDE = 101325.0  # Pa
PRESSURE, RADIUS = 3e3, 0.1  # Pa and m, of the ball before it touches
SHEET, POISSON = 5250.0, 0.3  # N/m
HALF_THICKNESS = 2e-3  # m
SPHERE, FACET, EDGE, NODE = 0, 3, 2, 1  # kinds in frames of contacts


def last_frame(run, series):
    return Frame(frames(run, series)[-1][1])


def on_plate(membranes, plate):
    """Areas (m2) of the facets that lie on the plate with all of their nodes, and of those with any; the mean edge (m) of all facets."""
    points, facets = membranes.points(), membranes.vectors("Polys", "connectivity")
    whole = partly = 0.0
    for facet in facets:
        a, b, c = (points[k] for k in facet)
        up = sum(p[2] > plate - HALF_THICKNESS - 1e-4 for p in (a, b, c))
        area = 0.5 * abs((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]))
        whole += area if up == 3 else 0.0
        partly += area if up > 0 else 0.0
    edges = [math.dist(points[f[i]], points[f[i - 1]]) for f in facets for i in range(3)]
    return whole, partly, mean(edges)


def on_soil(contacts):
    """Area (m2) and border (m) of the convex hull, seen from above, of where grains touch the ball."""
    kinds = list(zip(contacts.array("CellData", "kind_a"), contacts.array("CellData", "kind_b")))
    points = contacts.vectors("CellData", "point")
    touching = sorted(p[:2] for k, p in zip(kinds, points) if SPHERE in k and not {FACET, EDGE, NODE}.isdisjoint(k))

    def side(points):
        hull = []
        for p in points:
            while len(hull) > 1 and (hull[-1][0] - hull[-2][0]) * (p[1] - hull[-2][1]) <= (hull[-1][1] - hull[-2][1]) * (p[0] - hull[-2][0]):
                hull.pop()
            hull.append(p)
        return hull[:-1]

    hull = side(touching) + side(touching[::-1])
    pairs = list(zip(hull, hull[1:] + hull[:1]))
    return 0.5 * abs(sum(a[0] * b[1] - a[1] * b[0] for a, b in pairs)), sum(math.dist(a, b) for a, b in pairs), len(touching)


def breathing():
    """Kinetic energy (J) that the ball would come to if its sheet were without tension at first: a mass on springs of sheet and gas."""
    area, volume = 4 * math.pi * RADIUS**2, 4 / 3 * math.pi * RADIUS**3
    sheet = 8 * math.pi * SHEET / (1 - POISSON)
    gas = (OUTSIDE + PRESSURE) * area**2 / volume - 8 * math.pi * RADIUS * PRESSURE
    return (PRESSURE * area) ** 2 / (2 * (sheet + gas))


def check(run, bounds):
    report = report_of(run)
    force, gas, energy = columns(run / "reactions.csv"), columns(run / "pressures.csv"), columns(run / "energy.csv")
    stages = {stage["name"]: stage for stage in report["stages"]}
    begin, end = stages["hang"]["start_s"], stages["hang"]["end_s"]
    touched = [t for t, f in zip(force["time"], force["ball.force_z"]) if t > begin and f != 0]
    bounds.expect("time in which it hangs free (ms)", 1e3 * (touched[0] - begin), 8, math.inf, "it has not touched")

    free = [k for t, k in zip(energy["time"], energy["kinetic"]) if begin < t <= end]
    bounds.expect("kinetic energy then, over that without prestrain", max(free) / breathing(), 0, 0.01, f"of {breathing():.4f} J")
    then = [p for t, p in zip(gas["time"], gas["gas.pressure"]) if begin < t <= end]
    bounds.expect("least pressure then, over what was asked for", min(then) / PRESSURE, 0.97, 1.03, "it is at rest")
    bounds.expect("largest", max(then) / PRESSURE, 0.97, 1.03, "it is at rest")
    states = [(p + OUTSIDE) * v for t, p, v in zip(gas["time"], gas["gas.pressure"], gas["gas.volume"]) if t > begin]
    bounds.expect("largest change of p V", max(states) / min(states) - 1, 0, 1e-9, "gas as warm as before")

    # A limp sheet bears nothing: where it is flat, what it lies on pushes back as the gas does.
    late = [i for i, t in enumerate(force["time"]) if t > force["time"][-1] - 0.02]
    plate = mean([force["plate.force_z"][i] for i in late])
    soil = plate + mean([force["ball.force_z"][i] for i in late])
    pressure = mean([gas["gas.pressure"][i] for i in late])
    height = columns(run / "planes.csv")["plate.point_z"][-1]
    whole, partly, edge = on_plate(last_frame(run, "membranes"), height)
    bounds.expect("load of the plate over pressure (m2)", plate / pressure, whole, partly, "facets wholly, and partly, on it")
    area, border, count = on_soil(last_frame(run, "contacts"))
    bounds.expect("load of the soil over pressure (m2)", soil / pressure, area - 0.5 * edge * border, area + 0.5 * edge * border,
                  "hull of its contacts, half an edge off")
    weight = 4 * math.pi * RADIUS**2 * 0.5 * 9.81
    bounds.expect("load of the soil over that of plate and weight", soil / (plate + weight), 0.98, 1.02, "balance")
    print(f"  plate {plate:.1f} N, soil {soil:.1f} N in {count} contacts, under {pressure / 1e3:.2f} kPa")
    bounds.expect("grains through the ball", report["pass_throughs"] + report["lost_grains"], 0, 0, "it holds")
    bounds.expect_sound(report)


check_runs(__doc__, check, Bounds())
