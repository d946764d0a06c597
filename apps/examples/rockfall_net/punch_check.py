# SPDX-License-Identifier: GPL-3.0-or-later
"""Says how a net panel was punched, and whether that can be: python3 punch_check.py RUN [RUN ...]

RUN is the folder of a run of punch_test.toml. Writes punch.csv (force over displacement) into it. Ends 1 where something is out of its
bounds.
"""
import csv
import json
import math
import re
import struct
import sys
import zlib
from pathlib import Path

MINIMA = {"galvanized": 26.7e3, "PVC coated": 23.6e3}  # N, ASTM A975-97, mesh 8x10
CAP = 0.5  # m, radius of the rim of the cap
CONTACT = 5e-3  # m, how far from the sphere's surface a node lies that bears on it, at most


def columns(path):
    """A history as {head without unit: values}."""
    with open(path, newline="") as file:
        rows = list(csv.reader(file))
    return {head.split(" (")[0]: [float(row[i]) for row in rows[1:]] for i, head in enumerate(rows[0])}


class Frame:
    """Arrays of a frame (VTK XML, raw blocks of zlib)."""

    def __init__(self, path):
        self.data = path.read_bytes()
        self.begin = self.data.index(b"_", self.data.index(b'<AppendedData encoding="raw"')) + 1

    def vectors(self, section, name):
        pattern = rb"<" + section + rb">.*?type=\"(\w+)\" Name=\"" + name + rb"\"[^>]*offset=\"(\d+)\""
        found = re.search(pattern, self.data, re.S)
        begin = self.begin + int(found.group(2))
        blocks = struct.unpack_from("<Q", self.data, begin)[0]
        sizes = struct.unpack_from(f"<{blocks}Q", self.data, begin + 24)
        begin, raw = begin + 24 + 8 * blocks, b""
        for size in sizes:
            raw += zlib.decompress(self.data[begin : begin + size])
            begin += size
        code = {b"Float32": "f", b"Float64": "d"}[found.group(1)]
        numbers = struct.unpack(f"<{len(raw) // struct.calcsize(code)}{code}", raw)
        return [numbers[i : i + 3] for i in range(0, len(numbers), 3)]


def contacts_at(run, time):
    """Points of contact in the last frame up to a time."""
    series = re.findall(r'timestep="([^"]+)"[^>]*file="([^"]+)"', (run / "contacts.pvd").read_text())
    file = max((float(t), name) for t, name in series if float(t) <= time)[1]
    return Frame(run / file).vectors(b"CellData", b"point")


class Bounds:
    def __init__(self):
        self.hold = True

    def expect(self, what, value, low, high, source):
        holds = low <= value <= high
        self.hold &= holds
        print(f"  {what:<58} {value:10.4g}  {low:.4g} to {high:.4g} ({source}){'' if holds else '  OUT OF BOUNDS'}")


def mean(values):
    return sum(values) / len(values)


def check(run, bounds):
    report = json.loads((run / "run.json").read_text())
    history, energy = columns(run / "reactions.csv"), columns(run / "energy.csv")
    t, z = history["time"], history["cap.position_z"]
    way = [place - z[0] for place in z]
    force = [abs(f) for f in history["cap.force_z"]]
    rim = [abs(f) for f in history["rim.force_z"]]
    peak = max(range(len(force)), key=force.__getitem__)
    with open(run / "punch.csv", "w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(["displacement (m)", "force on the cap (N)", "force on the rim (N)"])
        writer.writerows([f"{value:.6g}" for value in row] for row in zip(way, force, rim))

    # Newton: slowly moved, the net hands all that the cap pushes with on to its rim.
    later = [i for i in range(peak) if force[i] > 0.5 * force[peak]]
    bounds.expect("force on the rim over that on the cap, half of the peak on", mean([rim[i] / force[i] for i in later]), 0.98, 1.02, "the net weighs 10 kg")
    work = sum(0.5 * (force[i] + force[i + 1]) * (way[i + 1] - way[i]) for i in range(peak))
    taken = [energy[name][min(range(len(energy["time"])), key=lambda i: abs(energy["time"][i] - t[peak]))] for name in ("bond_elastic", "bond_dissipated", "friction", "damping", "contact_elastic")]
    bounds.expect("force times way up to the peak over the energy of the net", work / sum(taken), 0.97, 1.03, "work goes into wires")
    points = [math.hypot(x, y) for x, y, _ in contacts_at(run, t[peak])]
    bounds.expect("largest distance of a contact from the axis, near the peak (m)", max(points), 0.0, CAP, "the net leaves the cap before its rim")
    for coating, least in MINIMA.items():
        bounds.expect(f"peak force over the minimum of a {coating} net", force[peak] / least, 1.0, 4.0, "ASTM A975, mesh 8x10")
    bounds.expect("broken wires", report["counts"]["broken_bonds"], 1, 1e9, "it is punched until it tears")
    bounds.expect("energy closure", report["energy_closure"], 0.0, 0.01, "energy is kept")

    print(f"  it tears at {force[peak] / 1e3:.1f} kN, {1e3 * way[peak]:.0f} mm; work up to there {work / 1e3:.2f} kJ")
    for part in (0.25, 0.5, 0.75):
        at = next(i for i, f in enumerate(force) if f >= part * force[peak])
        print(f"  {100 * part:.0f} % of that after {1e3 * way[at]:.0f} mm")


def main():
    bounds = Bounds()
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    for run in map(Path, sys.argv[1:]):
        print(run)
        check(run, bounds)
    sys.exit(0 if bounds.hold else 1)


main()
