#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes hammock.stl: a sagging sheet of 0.40 m x 0.40 m with the flaws of real exports.

The sheet hangs 0.10 m deep between a rim that rises to 0.02 m at its corners. Its nodes are moved a little in the plane, so
no two facets are alike, and the cells are cut in both directions at random. The flaws, all of them on purpose:
  - every facet has its own three points, as STL has it;
  - on one corner in five the point is up to 1e-7 m away from where it should be, so only a weld (1e-6 m) joins it;
  - 37 facets face the wrong side;
  - one facet has no area: its third corner lies on the line between the others, and nothing else uses it;
  - one facet is there twice.

usage: python3 make_hammock.py [hammock.stl]
"""
import math
import random
import sys

SIDE = 0.40  # m
SAG = 0.10  # m
CORNER_RISE = 0.02  # m
CELLS = 21
NOISE = 1e-7  # m
FLIPPED = 37
FLAT_EDGE = ((9, 9), (10, 9))


def height(x, y):
    """Sag in the middle, rim at 0, corners raised; x and y in m from the centre."""
    u, v = 2.0 * x / SIDE, 2.0 * y / SIDE
    sag = -SAG * math.cos(0.5 * math.pi * u) * math.cos(0.5 * math.pi * v)
    return sag + CORNER_RISE * (u * v) ** 2


def make_nodes(rng):
    nodes = {}
    step = SIDE / CELLS
    for j in range(CELLS + 1):
        for i in range(CELLS + 1):
            x, y = i * step - 0.5 * SIDE, j * step - 0.5 * SIDE
            if 0 < i < CELLS:
                x += 0.2 * step * rng.uniform(-1.0, 1.0)
            if 0 < j < CELLS:
                y += 0.2 * step * rng.uniform(-1.0, 1.0)
            nodes[i, j] = (x, y, height(x, y))
    for key in FLAT_EDGE:
        nodes[key] = tuple(round(1024.0 * p) / 1024.0 for p in nodes[key])
    return nodes


def make_facets(nodes, rng):
    facets = []
    for j in range(CELLS):
        for i in range(CELLS):
            a, b, c, d = (nodes[k] for k in ((i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)))
            facets += [[a, b, c], [a, c, d]] if rng.random() < 0.5 else [[a, b, d], [b, c, d]]
    return facets


def flat_facet(nodes):
    """A facet over an edge and its midpoint. The two nodes are on a grid of 1/1024 m, so the midpoint is exact."""
    a, b = nodes[FLAT_EDGE[0]], nodes[FLAT_EDGE[1]]
    return [a, b, tuple(0.5 * (p + q) for p, q in zip(a, b))]


def add_flaws(facets, nodes, rng):
    twice = list(facets[400])
    for k in rng.sample(range(len(facets)), FLIPPED):
        a, b, c = facets[k]
        facets[k] = [a, c, b]
    flat = flat_facet(nodes)
    facets.insert(200, flat)
    facets.append(twice)
    for facet in facets:
        for k in range(3):
            if facet[k] not in flat and rng.random() < 0.2:
                facet[k] = tuple(x + NOISE * rng.uniform(-1.0, 1.0) for x in facet[k])


def write_stl(path, facets):
    with open(path, "w", newline="\n") as out:
        out.write("solid hammock\n")
        for facet in facets:
            out.write("facet normal 0 0 0\nouter loop\n")
            for corner in facet:
                out.write("vertex %.12g %.12g %.12g\n" % corner)
            out.write("endloop\nendfacet\n")
        out.write("endsolid hammock\n")


def main():
    rng = random.Random(1)
    nodes = make_nodes(rng)
    facets = make_facets(nodes, rng)
    add_flaws(facets, nodes, rng)
    write_stl(sys.argv[1] if len(sys.argv) > 1 else "hammock.stl", facets)


if __name__ == "__main__":
    main()
