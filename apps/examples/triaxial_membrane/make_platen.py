# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes platen.off, a disc: python3 make_platen.py, in this folder."""
import math
from pathlib import Path

SIDES = 24
INNER = 17.5  # mm, from the axis to its sides; with half the thickness 19.5 mm, clear of the membrane
BOTTOM, TOP = -8.0, -2.0  # mm; with half the thickness its upper face is at 0

radius = INNER / math.cos(math.pi / SIDES)
corners = [(radius * math.cos(2 * math.pi * i / SIDES), radius * math.sin(2 * math.pi * i / SIDES)) for i in range(SIDES)]
points = [(x, y, z) for z in (BOTTOM, TOP) for x, y in corners] + [(0.0, 0.0, BOTTOM), (0.0, 0.0, TOP)]
facets = []
for i in range(SIDES):
    j = (i + 1) % SIDES
    facets += [(i, j, SIDES + j), (i, SIDES + j, SIDES + i)]
    facets += [(2 * SIDES, j, i), (2 * SIDES + 1, SIDES + i, SIDES + j)]
lines = ["OFF", f"{len(points)} {len(facets)} 0"]
lines += [" ".join(f"{x:.6f}" for x in point) for point in points]
lines += [" ".join(map(str, (3, *facet))) for facet in facets]
Path("platen.off").write_text("\n".join(lines) + "\n")
