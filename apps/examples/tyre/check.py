# SPDX-License-Identifier: GPL-3.0-or-later
"""Says how a tyre bears and rolls, and whether that can be: python3 check.py RUN [RUN ...]

RUN is the folder of a run of tyre.toml or of soil.toml. Ends 1 where something is out of its bounds.
"""
import math
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from results import Bounds, Frame, check_runs, columns, frame_before, mean, report_of  # noqa: E402

OUTSIDE = 101325.0  # Pa
HALF_THICKNESS = 5e-3  # m
PRESS, WHEEL = 1000.0, (5.0 + 3.93) * 9.81  # N, with its weight
GRAVEL = 2650.0  # kg/m3
TRACK, COLUMN = 0.04, 0.04  # m: half the width of the middle of the track, and length of a part of it
FRICTION = math.tan(math.radians(35))  # of rubber
TUBE = 0.16  # m, width of the tyre


def footprint(path):
    """Area (m2) of the facets that lie on the floor with all of their nodes, and of those with any."""
    frame = Frame(path)
    points, corners = frame.points(), frame.array("Polys", "connectivity")
    areas = [0.0, 0.0]
    for i in range(0, len(corners), 3):
        a, b, c = (points[k] for k in corners[i : i + 3])
        down = sum(p[2] < HALF_THICKNESS for p in (a, b, c))
        area = 0.5 * abs((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]))
        areas[0] += area if down == 3 else 0.0
        areas[1] += area if down > 0 else 0.0
    return areas


def grains_of(path):
    """Position (m) and radius (m) of each grain; the axle, which is the largest, is left out."""
    frame = Frame(path)
    return [(point, r) for point, r in zip(frame.points(), frame.array("PointData", "radius")) if r < 0.02]


def momentum(path):
    """Of all grains but the axle along x, kg m/s."""
    frame = Frame(path)
    velocities, radii = frame.vectors("PointData", "velocity"), frame.array("PointData", "radius")
    return GRAVEL * sum(4 / 3 * math.pi * r**3 * v[0] for v, r in zip(velocities, radii) if r < 0.02)


def surface(grains):
    """Height (m) of the highest grain in each part of the track, by the number of the part along x."""
    top = {}
    for (x, y, z), r in grains:
        if abs(y) < TRACK:
            part = math.floor(x / COLUMN)
            top[part] = max(top.get(part, 0.0), z + r)
    return top


def check_gas(gas, inflated, bounds):
    states = [(p + OUTSIDE) * v for u, p, v in zip(gas["time"], gas["gas.pressure"], gas["gas.volume"]) if u > inflated]
    bounds.expect("largest change of p V", max(states) / min(states) - 1, 0, 1e-9, "gas as warm as before")


def way_and_angle(history, rolling):
    """How far the axle has gone (m), and by what angle the tyre has turned, from the first to the last of these rows."""
    angle = lambda i: math.atan2(history["front.position_z"][i] - history["back.position_z"][i],
                                 history["front.position_x"][i] - history["back.position_x"][i])
    turned = (angle(rolling[0]) - angle(rolling[-1])) % (2 * math.pi)
    return history["axle.position_x"][rolling[-1]] - history["axle.position_x"][rolling[0]], turned


def check_run(report, bounds):
    bounds.expect("grains through the tyre", report["pass_throughs"], 0, 0, "it holds")
    bounds.expect_sound(report)


def check_floor(run, bounds):
    report = report_of(run)
    history, gas = columns(run / "reactions.csv"), columns(run / "pressures.csv")
    t, load = history["time"], [-f for f in history["floor.force_z"]]
    inflated, pressed = (stage["end_s"] for stage in report["stages"][:2])
    near = lambda moment, values, times=t: mean([v for u, v in zip(times, values) if moment - 5e-3 < u <= moment])

    check_gas(gas, inflated, bounds)

    # A limp sheet bears nothing: where it is flat the floor pushes back as the gas does.
    moment, file = frame_before(run, "membranes", pressed)
    pressure = near(moment, gas["gas.pressure"], gas["time"])
    inner, outer = footprint(file)
    area = near(moment, load) / pressure
    bounds.expect("load over pressure (m2), against its footprint", area, inner, outer, "facets wholly, and partly, on the floor")
    print(f"  the floor bears {near(moment, load):.0f} N under {pressure / 1e3:.2f} kPa")

    # Of vertical forces there are no others; the tyre swings a little.
    rolling = [i for i, u in enumerate(t) if u > pressed + 0.15]
    bounds.expect("mean load while it rolls, over force and weight", mean([load[i] for i in rolling]) / (PRESS + WHEEL), 0.97, 1.03, "balance")

    way, turned = way_and_angle(history, rolling)
    free = near(inflated, history["top.position_z"]) - near(inflated, history["axle.position_z"]) + HALF_THICKNESS
    loaded = mean([history["axle.position_z"][i] for i in rolling])
    radius = way / max(turned, 1e-9)
    print(f"  radius {1e3 * free:.1f} mm free, {1e3 * loaded:.1f} mm loaded; it rolled {1e3 * way:.0f} mm in {math.degrees(turned):.1f} deg")
    bounds.expect("way over angle (mm)", 1e3 * radius, 1e3 * loaded, 1e3 * free, "no slip: between the loaded and the free radius")
    drag = mean([history["floor.force_x"][i] for i in rolling])
    bounds.expect("what the floor holds back, over the load", abs(drag) / (PRESS + WHEEL), 0, 0.03, "elastic, with a free axle")
    check_run(report, bounds)


def check_soil(run, bounds):
    report = report_of(run)
    history, gas = columns(run / "reactions.csv"), columns(run / "pressures.csv")
    t = history["time"]
    inflated, rested, pressed, end = (stage["end_s"] for stage in report["stages"])
    before = [i for i, u in enumerate(t) if rested - 0.02 < u < rested]
    rolling = [i for i, u in enumerate(t) if u > pressed + 0.15]
    of = lambda name: mean([history[name][i] for i in rolling])
    check_gas(gas, inflated, bounds)

    # Walls are smooth: the floor bears all weight, and what the tyre pushes ahead goes to floor and walls.
    first, last = (grains_of(frame_before(run, "grains", moment)[1]) for moment in (rested, end))
    weight = GRAVEL * 9.81 * sum(4 / 3 * math.pi * r**3 for _, r in first)
    bounds.expect("floor over force, weight and gravel, while it rolls", -of("floor.force_z") / (PRESS + WHEEL + weight), 0.98, 1.02, "balance")
    bounds.expect("gravel on the tyre over force and weight", of("tread.force_z") / (PRESS + WHEEL), 0.97, 1.03, "balance")
    drag = -of("tread.force_x")
    begin, finish = (frame_before(run, "grains", moment) for moment in (pressed + 0.15, end))
    gained = (momentum(finish[1]) - momentum(begin[1])) / (finish[0] - begin[0])
    held = of("floor.force_x") + of("behind.force_x") + of("ahead.force_x") + gained
    bounds.expect("floor, walls and speed of gravel over the drag", held / drag, 0.95, 1.05, f"balance; {gained:.0f} N speed it up")

    # Where the tyre has been, against the same places before: its footprint has left the first part of its way.
    travelled = history["axle.position_x"][rolling[-1]]
    parts = [part for part in surface(first) if 0.1 < (part + 0.5) * COLUMN < travelled - 0.12]
    above, below = surface(first), surface(last)
    rut = mean([above[part] - below.get(part, 0.0) for part in parts])
    bed = mean(list(above.values()))
    bounds.expect("rut over the depth of the bed", rut / bed, 0.02, 0.9, "soil gives way")
    bounds.expect("drag over the load", drag / (PRESS + WHEEL), 0.03, FRICTION, "more than on a plane, 0.03 at most; no more than friction of rubber")
    pressure = mean([p for u, p in zip(gas["time"], gas["gas.pressure"]) if u > pressed + 0.15])
    print(f"  rut of {1e3 * rut:.1f} mm in a bed of {1e3 * bed:.0f} mm, gravel ahead up to {1e3 * max(below.values()):.0f} mm; drag {drag:.0f} N,"
          f" to press a rut as wide as the tube with {pressure / 1e3:.1f} kPa takes {pressure * TUBE * rut:.0f} J/m")

    way, turned = way_and_angle(history, rolling)
    free = mean([history["top.position_z"][i] - history["axle.position_z"][i] for i in before]) + HALF_THICKNESS
    bounds.expect("way over angle, over the free radius", way / max(turned, 1e-9) / free, 0.9, 2.0, "gravel alone turns it: it skids, by half at most")
    bounds.expect("grains that were lost", report["lost_grains"], 0, 0, "walls hold")
    check_run(report, bounds)


def check(run, bounds):
    (check_soil if "tread.force_z" in columns(run / "reactions.csv") else check_floor)(run, bounds)


check_runs(__doc__, check, Bounds(50))
