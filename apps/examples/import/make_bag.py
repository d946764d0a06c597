#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes bag.off: a filled geotextile bag of 0.6 m x 0.4 m x 0.2 m with the flaws of real exports.

Two sheets, top and bottom, meet in a seam. The flaws, all of them on purpose:
  - the sheets do not share the points of the seam: half of them are there twice, and the bottom's others are up to 0.4 um off,
    so only a weld (1 um) joins them;
  - the top has a hole, and one more facet is missing;
  - a patch of facets of the top faces the wrong side, and some facets elsewhere;
  - one facet has no area, one is there twice, one point is not used.

usage: python3 make_bag.py [bag.off]
"""
import random
import sys

HALF = (0.30, 0.20)  # m
HEIGHT = 0.10  # m, of either half
CELLS = (16, 12)
NOISE = 0.4e-6  # m
HOLE = (0.42, -0.12, 0.24)  # centre and radius, in halves of the sides
PATCH = (-0.42, 0.12, 0.40)
MISSING = (0.0, 0.55)
FLIPPED = 12  # single facets, besides the patch


def position(u, v, side):
    """Point of a sheet for u and v from -1 to 1; the seam is where one of them is at its end. The corners stand out like ears."""
    x = HALF[0] * u * (1.0 - 0.10 * (1.0 - v * v) * abs(u))
    y = HALF[1] * v * (1.0 - 0.10 * (1.0 - u * u) * abs(v))
    return x, y, side * HEIGHT * ((1.0 - u ** 4) * (1.0 - v ** 4)) ** 0.7


def make_sheet(side, first, rng):
    """Points, facets facing outward, and the middle of each facet in u and v."""
    points, facets, middles = [], [], []
    columns = CELLS[0] + 1
    uv = [(2.0 * i / CELLS[0] - 1.0, 2.0 * j / CELLS[1] - 1.0) for j in range(CELLS[1] + 1) for i in range(columns)]
    for u, v in uv:
        x = position(u, v, side)
        off = side < 0 and max(abs(u), abs(v)) == 1.0 and rng.random() < 0.5
        points.append(tuple(c + NOISE * rng.uniform(-0.5, 0.5) for c in x) if off else x)
    for j in range(CELLS[1]):
        for i in range(CELLS[0]):
            a, b, c, d = (columns * (j + dj) + i + di for di, dj in ((0, 0), (1, 0), (1, 1), (0, 1)))
            # Cut so that no facet has all three corners on the seam.
            rising = (2 * i < CELLS[0]) == (2 * j < CELLS[1])
            for facet in ([a, b, c], [a, c, d]) if rising else ([a, b, d], [b, c, d]):
                middles.append(tuple(sum(uv[k][axis] for k in facet) / 3.0 for axis in (0, 1)))
                facets.append([first + k for k in (facet if side > 0 else facet[::-1])])
    return points, facets, middles


def near(middle, circle):
    return (middle[0] - circle[0]) ** 2 + (middle[1] - circle[1]) ** 2 < circle[2] ** 2


def add_flaws(facets, middles, points, rng):
    """The facets of the top with holes, flipped, flat and double ones; may add points."""
    closest = min(range(len(facets)), key=lambda k: (middles[k][0] - MISSING[0]) ** 2 + (middles[k][1] - MISSING[1]) ** 2)
    kept = [k for k in range(len(facets)) if k != closest and not near(middles[k], HOLE)]
    flipped = [k for k in kept if near(middles[k], PATCH)]
    flipped += rng.sample([k for k in kept if k not in flipped], FLIPPED)
    broken = [facets[k][::-1] if k in flipped else facets[k] for k in kept]
    # Exactly collinear: on a grid of 1/1024 m the point between two others is exact.
    points += [(x / 1024.0, 0.0, 128.0 / 1024.0) for x in (0, 16, 8)] + [(1.0, 1.0, 1.0)]
    broken.append([len(points) - 4, len(points) - 3, len(points) - 2])
    broken.append(list(broken[100]))
    return broken


def main():
    rng = random.Random(3)
    points, top, middles = make_sheet(1, 0, rng)
    below, bottom, _ = make_sheet(-1, len(points), rng)
    points += below
    facets = add_flaws(top, middles, points, rng) + bottom
    with open(sys.argv[1] if len(sys.argv) > 1 else "bag.off", "w", newline="\n") as out:
        out.write(f"OFF\n{len(points)} {len(facets)} 0\n")
        for point in points:
            out.write("%.9g %.9g %.9g\n" % point)
        for facet in facets:
            out.write("3 %d %d %d\n" % tuple(facet))


if __name__ == "__main__":
    main()
