# SPDX-License-Identifier: GPL-3.0-or-later
"""Says how a tube buckled, beside the theory of thin shells: python3 check.py RUN [RUN ...]

RUN is the folder of a run of buckling_tube.toml or continuum.toml, with these materials and sizes. Writes shortening.csv into it (force over
shortening, as shares of theory's). Ends 1 where something is out of its bounds.
"""
import math
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from results import Bounds, check_runs, columns, report_of, write  # noqa: E402

RADIUS, LENGTH, SIDE = 0.05, 0.09976, 2 * math.pi * 0.05 / 60  # m
MODULUS, POISSON = 1e8, 0.3
BEAM = 1e-3  # m, radius of the beams of the lattice
SHEET = 1e-3  # m, thickness of the sheet


def lattice():
    """Stiffness (N/m) and bending stiffness (N m) of a lattice of equilateral triangles of stout beams."""
    area, second = math.pi * BEAM**2, math.pi * BEAM**4 / 4
    along, across = MODULUS * area / SIDE, 12 * MODULUS * second / SIDE**3
    stretching = 2 * math.sqrt(3) * along * (1 + across / along) / (3 + across / along)
    torsion = MODULUS / 2 / (1 + POISSON) * 2 * second
    return stretching, math.sqrt(3) / 4 * (3 * MODULUS * second + torsion) / SIDE


def sheet():
    return MODULUS * SHEET, MODULUS * SHEET**3 / 12 / (1 - POISSON**2)


def check(run, bounds):
    energy, history = columns(run / "energy.csv"), columns(run / "reactions.csv")
    is_sheet = max(energy["sheet_elastic"]) > 0
    stretching, bending = sheet() if is_sheet else lattice()
    load = 4 * math.pi * math.sqrt(stretching * bending)
    stiffness = stretching * 2 * math.pi * RADIUS / LENGTH
    short = [history["upper ring.position_z"][0] - z for z in history["upper ring.position_z"]]
    push = [abs(f) for f in history["upper ring.force_z"]]
    below = [abs(f) for f in history["lower ring.force_z"]]
    first = [i for i, u in enumerate(short) if 0.1 < u * stiffness / load < 0.4]
    measured = sum(short[i] * push[i] for i in first) / sum(short[i] ** 2 for i in first)
    write(run / "shortening.csv", ["shortening over that at the load of theory", "force over that load"],
          [(u * stiffness / load, p / load) for u, p in zip(short, push)])
    print(f"  {'sheet' if is_sheet else 'lattice'}")
    bounds.expect("largest force over that of theory", max(push) / load, 0.90, 1.05, f"4 pi sqrt(C D) = {load:.1f} N, A18")
    bounds.expect("stiffness over that of theory", measured / stiffness, 1.00, 1.06, f"2 pi R C / H = {stiffness / 1e3:.1f} kN/m, A18")
    bounds.expect("force at the end over that of theory", push[-1] / load, 0.0, 0.7, "it has buckled")
    bounds.expect("largest difference of both rings, of that force", max(abs(a - b) for a, b in zip(push, below)) / load, 0.0, 0.05, "slow enough")
    bounds.expect_sound(report_of(run))


check_runs(__doc__, check, Bounds(48))
