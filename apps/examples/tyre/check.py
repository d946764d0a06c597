# SPDX-License-Identifier: GPL-3.0-or-later
"""Says how a tyre bears and rolls, and whether that can be: python3 check.py RUN [RUN ...]

RUN is the folder of a run of tyre.toml. Ends 1 where something is out of its bounds.
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


def frame_before(run, moment):
    text = (run / "membranes.pvd").read_text()
    found = [(float(t), file) for t, file in re.findall(r'timestep="([^"]+)"[^>]*file="([^"]+)"', text)]
    return max(entry for entry in found if entry[0] <= moment + 1e-9)


class Bounds:
    def __init__(self):
        self.hold = True

    def expect(self, what, value, low, high, source):
        holds = low <= value <= high
        self.hold &= holds
        print(f"  {what:<50} {value:10.4g}  {low:.4g} to {high:.4g} ({source}){'' if holds else '  OUT OF BOUNDS'}")


def check(run, bounds):
    report = json.loads((run / "run.json").read_text())
    history, gas = columns(run / "reactions.csv"), columns(run / "pressures.csv")
    t, load = history["time"], [-f for f in history["floor.force_z"]]
    inflated, pressed = (stage["end_s"] for stage in report["stages"][:2])
    near = lambda moment, values, times=t: mean([v for u, v in zip(times, values) if moment - 5e-3 < u <= moment])

    states = [(p + OUTSIDE) * v for u, p, v in zip(gas["time"], gas["gas.pressure"], gas["gas.volume"]) if u > inflated]
    bounds.expect("largest change of p V", max(states) / min(states) - 1, 0, 1e-9, "gas as warm as before")

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

    angle = lambda i: math.atan2(history["front.position_z"][i] - history["back.position_z"][i],
                                 history["front.position_x"][i] - history["back.position_x"][i])
    turned = (angle(rolling[0]) - angle(rolling[-1])) % (2 * math.pi)
    way = history["axle.position_x"][rolling[-1]] - history["axle.position_x"][rolling[0]]
    free = near(inflated, history["top.position_z"]) - near(inflated, history["axle.position_z"]) + HALF_THICKNESS
    loaded = mean([history["axle.position_z"][i] for i in rolling])
    radius = way / max(turned, 1e-9)
    print(f"  radius {1e3 * free:.1f} mm free, {1e3 * loaded:.1f} mm loaded; it rolled {1e3 * way:.0f} mm in {math.degrees(turned):.1f} deg")
    bounds.expect("way over angle (mm)", 1e3 * radius, 1e3 * loaded, 1e3 * free, "no slip: between the loaded and the free radius")
    drag = mean([history["floor.force_x"][i] for i in rolling])
    bounds.expect("what the floor holds back, over the load", abs(drag) / (PRESS + WHEEL), 0, 0.03, "elastic, with a free axle")
    bounds.expect("grains through the tyre", report["pass_throughs"], 0, 0, "it holds")
    bounds.expect("energy closure", report["energy_closure"], 0, 0.01, "energy is kept")
    red = [entry["name"] for entry in report["certificate"] if entry["verdict"] != "green"]
    bounds.expect("red rows of the certificate", len(red), 0, 0, ", ".join(red) or "all green")


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    bounds = Bounds()
    for run in map(Path, sys.argv[1:]):
        print(run)
        check(run, bounds)
    sys.exit(0 if bounds.hold else 1)


main()
