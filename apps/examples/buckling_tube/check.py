# SPDX-License-Identifier: GPL-3.0-or-later
"""Says how a tube buckled, beside the theory of thin shells: python3 check.py RUN [RUN ...]

RUN is the folder of a run of buckling_tube.toml or continuum.toml, with these materials and sizes. Writes shortening.csv into it (force over
shortening, as shares of theory's). Ends 1 where something is out of its bounds.
"""
import csv
import json
import math
import sys
from pathlib import Path

RADIUS, LENGTH, SIDE = 0.05, 0.09976, 2 * math.pi * 0.05 / 60  # m
MODULUS, POISSON = 1e8, 0.3
BEAM = 1e-3  # m, radius of the beams of the lattice
SHEET = 1e-3  # m, thickness of the sheet


def columns(path):
    """A history as {head without unit: values}."""
    with open(path, newline="") as file:
        rows = list(csv.reader(file))
    return {head.split(" (")[0]: [float(row[i]) for row in rows[1:]] for i, head in enumerate(rows[0])}


def lattice():
    """Stiffness (N/m) and bending stiffness (N m) of a lattice of equilateral triangles of stout beams."""
    area, second = math.pi * BEAM**2, math.pi * BEAM**4 / 4
    along, across = MODULUS * area / SIDE, 12 * MODULUS * second / SIDE**3
    stretching = 2 * math.sqrt(3) * along * (1 + across / along) / (3 + across / along)
    torsion = MODULUS / 2 / (1 + POISSON) * 2 * second
    return stretching, math.sqrt(3) / 4 * (3 * MODULUS * second + torsion) / SIDE


def sheet():
    return MODULUS * SHEET, MODULUS * SHEET**3 / 12 / (1 - POISSON**2)


def check(run):
    energy, history = columns(run / "energy.csv"), columns(run / "reactions.csv")
    report = json.loads((run / "run.json").read_text())
    red = [entry["name"] for entry in report["certificate"] if entry["verdict"] != "green"]
    is_sheet = max(energy["sheet_elastic"]) > 0
    stretching, bending = sheet() if is_sheet else lattice()
    load = 4 * math.pi * math.sqrt(stretching * bending)
    stiffness = stretching * 2 * math.pi * RADIUS / LENGTH
    short = [history["upper ring.position_z"][0] - z for z in history["upper ring.position_z"]]
    push = [abs(f) for f in history["upper ring.force_z"]]
    below = [abs(f) for f in history["lower ring.force_z"]]
    first = [i for i, u in enumerate(short) if 0.1 < u * stiffness / load < 0.4]
    measured = sum(short[i] * push[i] for i in first) / sum(short[i] ** 2 for i in first)
    with open(run / "shortening.csv", "w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(["shortening over that at the load of theory", "force over that load"])
        writer.writerows([f"{u * stiffness / load:.5g}", f"{p / load:.5g}"] for u, p in zip(short, push))
    values = [
        ("largest force over that of theory", max(push) / load, 0.90, 1.05, f"4 pi sqrt(C D) = {load:.1f} N, A18"),
        ("stiffness over that of theory", measured / stiffness, 1.00, 1.06, f"2 pi R C / H = {stiffness / 1e3:.1f} kN/m, A18"),
        ("force at the end over that of theory", push[-1] / load, 0.0, 0.7, "it has buckled"),
        ("largest difference of both rings, of that force", max(abs(a - b) for a, b in zip(push, below)) / load, 0.0, 0.05, "slow enough"),
        ("energy closure", report["energy_closure"], 0.0, 0.01, "energy is kept"),
        ("red rows of the certificate", len(red), 0, 0, ", ".join(red) or "all green"),
    ]
    print(f"{run}: {'sheet' if is_sheet else 'lattice'}")
    for what, value, low, high, source in values:
        print(f"  {what:<48} {value:8.4g}  {low:g} to {high:g} ({source}){'' if low <= value <= high else '  OUT OF BOUNDS'}")
    return all(low <= value <= high for _, value, low, high, _ in values)


if len(sys.argv) < 2:
    sys.exit(__doc__)
sys.exit(0 if all([check(Path(run)) for run in sys.argv[1:]]) else 1)
