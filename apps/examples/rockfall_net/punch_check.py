# SPDX-License-Identifier: GPL-3.0-or-later
"""Says how a net panel was punched, and whether that can be: python3 punch_check.py RUN [RUN ...]

RUN is the folder of a run of punch_test.toml. Writes punch.csv (force over displacement) into it. Ends 1 where something is out of its
bounds.
"""
import math
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from results import Bounds, Frame, check_runs, columns, frame_before, mean, report_of, write  # noqa: E402

MINIMA = {"galvanized": 26.7e3, "PVC coated": 23.6e3}  # N, ASTM A975-97, mesh 8x10
CAP = 0.5  # m, radius of the rim of the cap
CONTACT = 5e-3  # m, how far from the sphere's surface a node lies that bears on it, at most


def check(run, bounds):
    report = report_of(run)
    history, energy = columns(run / "reactions.csv"), columns(run / "energy.csv")
    t, z = history["time"], history["cap.position_z"]
    way = [place - z[0] for place in z]
    force = [abs(f) for f in history["cap.force_z"]]
    rim = [abs(f) for f in history["rim.force_z"]]
    peak = max(range(len(force)), key=force.__getitem__)
    write(run / "punch.csv", ["displacement (m)", "force on the cap (N)", "force on the rim (N)"], zip(way, force, rim), digits=6)

    # Newton: slowly moved, the net hands all that the cap pushes with on to its rim.
    later = [i for i in range(peak) if force[i] > 0.5 * force[peak]]
    bounds.expect("force on the rim over that on the cap, half of the peak on", mean([rim[i] / force[i] for i in later]), 0.98, 1.02, "the net weighs 10 kg")
    work = sum(0.5 * (force[i] + force[i + 1]) * (way[i + 1] - way[i]) for i in range(peak))
    taken = [energy[name][min(range(len(energy["time"])), key=lambda i: abs(energy["time"][i] - t[peak]))] for name in ("bond_elastic", "bond_dissipated", "friction", "damping", "contact_elastic")]
    bounds.expect("force times way up to the peak over the energy of the net", work / sum(taken), 0.97, 1.03, "work goes into wires")
    points = [math.hypot(x, y) for x, y, _ in Frame(frame_before(run, "contacts", t[peak])[1]).vectors("CellData", "point")]
    bounds.expect("largest distance of a contact from the axis, near the peak (m)", max(points), 0.0, CAP, "the net leaves the cap before its rim")
    for coating, least in MINIMA.items():
        bounds.expect(f"peak force over the minimum of a {coating} net", force[peak] / least, 1.0, 4.0, "ASTM A975, mesh 8x10")
    bounds.expect("broken wires", report["counts"]["broken_bonds"], 1, 1e9, "it is punched until it tears")
    bounds.expect_energy(report)

    print(f"  it tears at {force[peak] / 1e3:.1f} kN, {1e3 * way[peak]:.0f} mm; work up to there {work / 1e3:.2f} kJ")
    for part in (0.25, 0.5, 0.75):
        at = next(i for i, f in enumerate(force) if f >= part * force[peak])
        print(f"  {100 * part:.0f} % of that after {1e3 * way[at]:.0f} mm")


check_runs(__doc__, check, Bounds(58))
