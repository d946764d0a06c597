# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes tyre.off, a torus about the y axis that faces outward: python3 make_tyre.py [CELLS_AROUND CELLS_ACROSS], in this folder."""
import math
import sys
from pathlib import Path

MIDDLE, TUBE = 250.0, 80.0  # mm, from the axis to the middle of the tube; radius of the tube


def main():
    around, across = map(int, sys.argv[1:3]) if len(sys.argv) > 2 else (72, 24)
    points, facets = [], []
    for i in range(around):
        turn = 2 * math.pi * i / around
        for j in range(across):
            angle = 2 * math.pi * j / across
            radius = MIDDLE + TUBE * math.cos(angle)
            points.append((radius * math.cos(turn), TUBE * math.sin(angle), radius * math.sin(turn)))
    for i in range(around):
        for j in range(across):
            a, b = i * across + j, i * across + (j + 1) % across
            c, d = (a + across) % len(points), (b + across) % len(points)
            facets += [(a, b, d), (a, d, c)] if (i + j) % 2 == 0 else [(a, b, c), (b, d, c)]
    lines = ["OFF", f"{len(points)} {len(facets)} 0"]
    lines += [" ".join(f"{x:.5f}" for x in point) for point in points]
    lines += [" ".join(map(str, (3, *facet))) for facet in facets]
    Path("tyre.off").write_text("\n".join(lines) + "\n")


main()
