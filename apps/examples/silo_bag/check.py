# SPDX-License-Identifier: GPL-3.0-or-later
"""Says what a bag bears and how it empties, and whether that can be: python3 check.py RUN [RUN ...]

RUN is the folder of a run of silo_bag.toml. Ends 1 where something is out of its bounds.
"""
import math
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from results import Bounds, Frame, check_runs, columns, frame_before, frames, mean, report_of  # noqa: E402

RADIUS, HALF_THICKNESS = 0.15, 4e-3  # m, of the bag
AROUND, ALONG = 24, 20  # cells of the bag
BAG = 2 * math.pi * RADIUS * 0.8 * 4.0  # kg
OUTLET, DIAMETER = 0.22, 0.041  # m; of the grains the mean
DENSITY, GRAVITY = 2650.0, 9.81
GRAINS, WALL = math.tan(math.radians(30)), math.tan(math.radians(20))  # friction
SHEET = 20e3  # N/m


def grains_of(path):
    """(height, mass) of each grain."""
    frame = Frame(path)
    radii = frame.array("PointData", "radius")
    return [(p[2], DENSITY * 4 / 3 * math.pi * r**3) for p, r in zip(frame.points(), radii)]


def wall_of(path):
    """(height, area, normal traction of contacts) of each facet of the bag, and the positions of all nodes."""
    frame = Frame(path)
    points, corners = frame.points(), frame.array("Polys", "connectivity")
    pressure, owner = frame.array("CellData", "contact_pressure"), frame.array("CellData", "membrane")
    others = len(pressure) - len(corners) // 3  # bars come before facets
    rows = []
    for k in range(len(corners) // 3):
        if owner[others + k] != 0:
            continue
        a, b, c = (points[i] for i in corners[3 * k : 3 * k + 3])
        u, v = [q - p for p, q in zip(a, b)], [q - p for p, q in zip(a, c)]
        normal = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
        rows.append((mean([a[2], b[2], c[2]]), 0.5 * math.hypot(*normal), pressure[others + k]))
    return rows, points


def check(run, bounds):
    report = report_of(run)
    opened = report["stages"][1]["end_s"]
    history = columns(run / "reactions.csv")
    grains = frames(run, "grains")
    full = max(entry for entry in grains if entry[0] < opened - 1e-9)
    contents = grains_of(full[1])
    facets, points = wall_of(frame_before(run, "membranes", full[0])[1])
    inner, top = RADIUS - HALF_THICKNESS, mean(sorted(z for z, _ in contents)[-20:])
    section = math.pi * inner**2
    mass = sum(m for _, m in contents)
    weight = mass * GRAVITY

    # What stands on the floor and what hangs in the hoops is all there is.
    rows = [i for i, t in enumerate(history["time"]) if opened - 0.05 < t < opened]
    of = lambda name: -mean([history[f"{name}.force_z"][i] for i in rows])
    below, hung = of("floor") + of("gate"), of("hoops")
    bounds.expect("floor, gate and hoops over all weight", (below + hung) / (weight + BAG * GRAVITY), 0.98, 1.02, "balance")

    # Janssen: walls bear a part, with friction of all that presses on them at most.
    bulk = mass / (section * top)
    active = (math.sqrt(1 + GRAINS**2) - GRAINS) ** 2  # tan^2 (45 deg - phi/2)
    least = lambda depth, k: bulk * GRAVITY * inner / (2 * WALL * k) * (1 - math.exp(-2 * WALL * k * depth / inner))
    bounds.expect("stress on the floor (kPa)", 1e-3 * below / section, 1e-3 * least(top, 1.0), 1e-3 * bulk * GRAVITY * top, "Janssen with K = 1, and all weight")
    for low, high in ((0.1, 0.2), (0.2, 0.3)):
        band = [(a, -p) for z, a, p in facets if low < z < high]
        pressure = sum(a * p for a, p in band) / sum(a for a, _ in band)
        depth = top - 0.5 * (low + high)
        bounds.expect(f"pressure on the bag from {low:g} to {high:g} m (kPa)", 1e-3 * pressure, 1e-3 * active * least(depth, 1.0), 1e-3 * bulk * GRAVITY * depth,
                      "active, with friction, and of a fluid")
        # Rings of nodes of the sheet, by how much they are longer: by p r / J.
        rings = [points[k * AROUND : (k + 1) * AROUND] for k in range(ALONG + 1)]
        rings = [ring for ring in rings if low < mean([p[2] for p in ring]) < high]
        around = mean([sum(math.dist(a, b) for a, b in zip(ring, ring[1:] + ring[:1])) for ring in rings])
        tension = SHEET * (around / (2 * AROUND * RADIUS * math.sin(math.pi / AROUND)) - 1)
        bounds.expect(f"tension around over p r, from {low:g} to {high:g} m", tension / (pressure * around / (2 * math.pi)), 0.8, 1.2, "a thin tube")
        print(f"    Janssen with active pressure: {1e-3 * active * least(depth, active):.2f} kPa; tension {tension:.0f} N/m")

    # How it runs out.
    out = [(t, sum(m for z, m in grains_of(file) if z < -0.03)) for t, file in grains if t > opened]
    flowing = [(t, m) for t, m in out if 0.1 * mass < m < 0.6 * mass]
    rate = (flowing[-1][1] - flowing[0][1]) / (flowing[-1][0] - flowing[0][0]) if len(flowing) > 1 else 0.0
    beverloo = 0.58 * bulk * math.sqrt(GRAVITY) * (OUTLET - 1.4 * DIAMETER) ** 2.5
    bounds.expect("kg/s through the outlet, over Beverloo", rate / beverloo, 0.7, 1.3, "C = 0.58, k = 1.4")
    print(f"  {rate:.1f} kg/s; {out[-1][1]:.1f} of {mass:.1f} kg have left the bag")
    bounds.expect("grains at the end over those put in", len(grains_of(grains[-1][1])) / len(contents), 1, 1, "none is lost")
    bounds.expect("what has left the bag, over all", out[-1][1] / mass, 0.75, 1, "but for what stays on the floor")
    gate = -mean(history["gate.force_z"][-40:]) / GRAVITY
    bounds.expect("the tray weighs, over what has left (end)", gate / out[-1][1], 0.85, 1.15, "balance, with blows of what falls")
    bounds.expect_sound(report)


check_runs(__doc__, check, Bounds(50))
