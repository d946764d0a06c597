# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes floor.off, a ring with the outlet in its middle: python3 make_floor.py, in this folder."""
import math
from pathlib import Path

SIDES, INNER, OUTER = 36, 115.0, 130.0  # mm; half its thickness comes on top

points = [(r * math.cos(2 * math.pi * i / SIDES), r * math.sin(2 * math.pi * i / SIDES), 0.0) for r in (INNER, OUTER) for i in range(SIDES)]
facets = []
for i in range(SIDES):
    j = (i + 1) % SIDES
    facets += [(i, SIDES + i, SIDES + j), (i, SIDES + j, j)]
lines = ["OFF", f"{len(points)} {len(facets)} 0"]
lines += [" ".join(f"{x:.5f}" for x in point) for point in points]
lines += [" ".join(map(str, (3, *facet))) for facet in facets]
Path("floor.off").write_text("\n".join(lines) + "\n")
