# SPDX-License-Identifier: GPL-3.0-or-later
"""Says how a tyre bears and rolls, and whether that can be: python3 check.py RUN [RUN ...]

RUN is the folder of a run of tyre.toml or of soil.toml. Ends 1 where something is out of its bounds.
"""
import csv
import json
import math
import re
import struct
import sys
import zlib
from pathlib import Path

OUTSIDE = 101325.0  # Pa
HALF_THICKNESS = 5e-3  # m
PRESS, WHEEL = 1000.0, (5.0 + 3.93) * 9.81  # N, with its weight
GRAVEL = 2650.0  # kg/m3
TRACK, COLUMN = 0.04, 0.04  # m: half the width of the middle of the track, and length of a part of it
FRICTION = math.tan(math.radians(35))  # of rubber
TUBE = 0.16  # m, width of the tyre


def columns(path):
    """A history as {head without unit: values}."""
    with open(path, newline="") as file:
        rows = list(csv.reader(file))
    return {head.split(" (")[0]: [float(row[i]) for row in rows[1:]] for i, head in enumerate(rows[0])}


def mean(values):
    return sum(values) / len(values)


def frame_array(data, section, name, code):
    """Numbers of an array of a frame (VTK XML, raw blocks of zlib)."""
    found = re.search(rb"<" + section + rb">.*?Name=\"" + name + rb"\"[^>]*offset=\"(\d+)\"", data, re.S)
    begin = data.index(b"_", data.index(b'<AppendedData encoding="raw"')) + 1 + int(found.group(1))
    blocks = struct.unpack_from("<Q", data, begin)[0]
    sizes = struct.unpack_from(f"<{blocks}Q", data, begin + 24)
    begin, raw = begin + 24 + 8 * blocks, b""
    for size in sizes:
        raw += zlib.decompress(data[begin : begin + size])
        begin += size
    return struct.unpack(f"<{len(raw) // struct.calcsize(code)}{code}", raw)


def footprint(path):
    """Area (m2) of the facets that lie on the floor with all of their nodes, and of those with any."""
    data = path.read_bytes()
    numbers = frame_array(data, b"Points", b"Points", "d")
    points = [numbers[i : i + 3] for i in range(0, len(numbers), 3)]
    corners = frame_array(data, b"Polys", b"connectivity", "i")
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
    data = path.read_bytes()
    numbers, radii = frame_array(data, b"Points", b"Points", "d"), frame_array(data, b"PointData", b"radius", "f")
    return [(numbers[3 * i : 3 * i + 3], r) for i, r in enumerate(radii) if r < 0.02]


def momentum(path):
    """Of all grains but the axle along x, kg m/s."""
    data = path.read_bytes()
    velocity, radii = frame_array(data, b"PointData", b"velocity", "f"), frame_array(data, b"PointData", b"radius", "f")
    return GRAVEL * sum(4 / 3 * math.pi * r**3 * velocity[3 * i] for i, r in enumerate(radii) if r < 0.02)


def surface(grains):
    """Height (m) of the highest grain in each part of the track, by the number of the part along x."""
    top = {}
    for (x, y, z), r in grains:
        if abs(y) < TRACK:
            part = math.floor(x / COLUMN)
            top[part] = max(top.get(part, 0.0), z + r)
    return top


def frame_before(run, moment, kind="membranes"):
    text = (run / f"{kind}.pvd").read_text()
    found = [(float(t), file) for t, file in re.findall(r'timestep="([^"]+)"[^>]*file="([^"]+)"', text)]
    return max(entry for entry in found if entry[0] <= moment + 1e-9)


class Bounds:
    def __init__(self):
        self.hold = True

    def expect(self, what, value, low, high, source):
        holds = low <= value <= high
        self.hold &= holds
        print(f"  {what:<50} {value:10.4g}  {low:.4g} to {high:.4g} ({source}){'' if holds else '  OUT OF BOUNDS'}")


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
    bounds.expect("energy closure", report["energy_closure"], 0, 0.01, "energy is kept")
    red = [entry["name"] for entry in report["certificate"] if entry["verdict"] != "green"]
    bounds.expect("red rows of the certificate", len(red), 0, 0, ", ".join(red) or "all green")


def check(run, bounds):
    report = json.loads((run / "run.json").read_text())
    history, gas = columns(run / "reactions.csv"), columns(run / "pressures.csv")
    t, load = history["time"], [-f for f in history["floor.force_z"]]
    inflated, pressed = (stage["end_s"] for stage in report["stages"][:2])
    near = lambda moment, values, times=t: mean([v for u, v in zip(times, values) if moment - 5e-3 < u <= moment])

    check_gas(gas, inflated, bounds)

    # A limp sheet bears nothing: where it is flat the floor pushes back as the gas does.
    moment, file = frame_before(run, pressed)
    pressure = near(moment, gas["gas.pressure"], gas["time"])
    inner, outer = footprint(run / file)
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
    report = json.loads((run / "run.json").read_text())
    history, gas = columns(run / "reactions.csv"), columns(run / "pressures.csv")
    t = history["time"]
    inflated, rested, pressed, end = (stage["end_s"] for stage in report["stages"])
    before = [i for i, u in enumerate(t) if rested - 0.02 < u < rested]
    rolling = [i for i, u in enumerate(t) if u > pressed + 0.15]
    of = lambda name: mean([history[name][i] for i in rolling])
    check_gas(gas, inflated, bounds)

    # Walls are smooth: the floor bears all weight, and what the tyre pushes ahead goes to floor and walls.
    first, last = (grains_of(run / frame_before(run, moment, "grains")[1]) for moment in (rested, end))
    weight = GRAVEL * 9.81 * sum(4 / 3 * math.pi * r**3 for _, r in first)
    bounds.expect("floor over force, weight and gravel, while it rolls", -of("floor.force_z") / (PRESS + WHEEL + weight), 0.98, 1.02, "balance")
    bounds.expect("gravel on the tyre over force and weight", of("tread.force_z") / (PRESS + WHEEL), 0.97, 1.03, "balance")
    drag = -of("tread.force_x")
    begin, finish = (frame_before(run, moment, "grains") for moment in (pressed + 0.15, end))
    gained = (momentum(run / finish[1]) - momentum(run / begin[1])) / (finish[0] - begin[0])
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


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    bounds = Bounds()
    for run in map(Path, sys.argv[1:]):
        print(run)
        (check_soil if "tread.force_z" in columns(run / "reactions.csv") else check)(run, bounds)
    sys.exit(0 if bounds.hold else 1)


main()
