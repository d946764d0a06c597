# SPDX-License-Identifier: GPL-3.0-or-later
"""Scenes s2 (spheres on a membrane), s3 (geogrid pulled through spheres), s4a and s4b (hollow spheres) in YADE.

Usage: yade -n -x -j1 yade_structures.py --scene s2 --warm-up N --steps N [--bed FILE] [--cells 32] [--verlet M]
"""

import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))

import yade_grid as grid
import yade_timing as timing
from to_lammps_data import read_bed
from yade import *  # noqa: F403  the functors are made when YADE starts
from yade import Vector3

MEMBRANE_RADIUS = 3e-4
"""m, half of the thickness."""
APERTURE, BAR_RADIUS, CLEAR_OF_WALLS, PULL_VELOCITY = 4e-3, 4e-4, 2e-3, 0.1
"""m, m, m, m/s; of the geogrid."""


def sphere_meetings():
    return [Ig2_Sphere_Sphere_ScGeom(), Ig2_Wall_Sphere_ScGeom()]


def sheet(side, cells):
    """Points and facets of a square sheet with its top at z = 0; the diagonals of neighbouring cells cross."""
    points = [(i * side / cells, j * side / cells, -MEMBRANE_RADIUS) for j in range(cells + 1) for i in range(cells + 1)]
    facets = []
    for j in range(cells):
        for i in range(cells):
            a = j * (cells + 1) + i
            b, c, d = a + 1, a + cells + 1, a + cells + 2
            facets += [(a, b, d), (a, d, c)] if (i + j) % 2 else [(a, b, c), (b, d, c)]
    return points, facets


def spheres_on_membrane(options):
    """s2; the membrane does not meet itself."""
    bed, cells = read_bed(options.bed), options.cells
    meetings = [*sphere_meetings(), Ig2_Sphere_PFacet_ScGridCoGeom()]
    collider = grid.add_engines(meetings, options.verlet, grid.ALL_STRUCTURES)
    points, facets = sheet(bed.width, cells)
    nodes = grid.add_membrane(points, facets, MEMBRANE_RADIUS, grid.SPHERES | grid.ALL_STRUCTURES)
    on_rim = [k for k in range(len(nodes)) if {k % (cells + 1), k // (cells + 1)} & {0, cells}]
    grid.hold([nodes[k] for k in on_rim])
    timing.add_spheres(bed, "grains")
    timing.add_walls(bed.width, bed.width, "grains")
    return len(bed.spheres) + len(facets), collider


def geogrid(side, height):
    """Points and bars of a square net of square apertures, two bars to a side, and its points of the largest x."""
    apertures = int((side - 2 * CLEAR_OF_WALLS) / APERTURE)
    last = 2 * apertures
    places = [(i, j) for j in range(last + 1) for i in range(last + 1) if i % 2 == 0 or j % 2 == 0]
    number = {place: k for k, place in enumerate(places)}
    corner = 0.5 * (side - apertures * APERTURE)
    points = [(corner + 0.5 * i * APERTURE, corner + 0.5 * j * APERTURE, height) for i, j in places]
    along_x = [(number[i, j], number[i + 1, j]) for i, j in places if j % 2 == 0 and i < last]
    along_y = [(number[i, j], number[i, j + 1]) for i, j in places if i % 2 == 0 and j < last]
    return points, along_x + along_y, [number[last, j] for j in range(last + 1)]


def geogrid_pullout(options):
    """s3; the bed is parted at its median height and the net laid in the slot."""
    bed = read_bed(options.bed)
    meetings = [*sphere_meetings(), Ig2_Sphere_GridConnection_ScGridCoGeom()]
    collider = grid.add_engines(meetings, options.verlet, grid.ALL_STRUCTURES)
    middle = sorted(sphere[2] for sphere in bed.spheres)[len(bed.spheres) // 2]
    half_slot = max(sphere[3] for sphere in bed.spheres) + BAR_RADIUS
    points, bars, pulled = geogrid(bed.width, middle + half_slot)
    nodes = grid.add_nodes(points, BAR_RADIUS)
    grid.add_bars(nodes, bars, BAR_RADIUS, grid.SPHERES | grid.ALL_STRUCTURES)
    grid.hold([nodes[k] for k in pulled], (PULL_VELOCITY, 0, 0))
    timing.add_spheres(bed, "grains", lambda height: height + 2 * half_slot * (height > middle))
    timing.add_walls(bed.width, bed.width, "grains")
    timing.add_floor("grains")
    return len(bed.spheres) + len(bars), collider


def shell_meetings():
    """A wall and a facet hand over to the wall and nodes; two facets to nodes on facets and edges on edges."""
    return [
        Ig2_Wall_PFacet_ScGeom(),
        Ig2_Wall_Sphere_ScGeom(),
        Ig2_PFacet_PFacet_ScGeom(),
        Ig2_Sphere_PFacet_ScGridCoGeom(),
        Ig2_GridConnection_GridConnection_GridCoGridCoGeom(),
    ]


def add_shells(radius, subdivisions, shells):
    """Hollow spheres at (centre, velocity), each with a bit of its own in its mask; the number of facets."""
    points, facets = grid.icosphere(subdivisions)
    for number, (centre, velocity) in enumerate(shells):
        mask = 1 | 1 << (number + 1)
        for node in grid.add_membrane([centre + radius * point for point in points], facets, MEMBRANE_RADIUS, mask):
            O.bodies[node].state.vel = velocity
    return len(shells) * len(facets)


def shell_engines(shell_count, options):
    """Shells meet each other, none itself: YADE is timed at what it does fastest."""
    own_bits = sum(1 << (number + 1) for number in range(shell_count))
    return grid.add_engines(shell_meetings(), options.verlet, own_bits)


def hollow_sphere_on_floor(options):
    """s4a"""
    radius = 0.02
    collider = shell_engines(1, options)
    shells = [(Vector3(0, 0, radius + MEMBRANE_RADIUS + 1e-3), Vector3(0, 0, -0.5))]
    facets = add_shells(radius, 3, shells)
    timing.add_floor("surface")
    return facets, collider


def colliding_hollow_spheres(options):
    """s4b; a box of 2 x 2 x 5 shells, each driving into its neighbours."""
    radius = 0.01
    spacing = 2 * (radius + MEMBRANE_RADIUS) + 5e-5
    places = [(i, j, k) for k in range(5) for j in range(2) for i in range(2)]
    shells = [
        (spacing * Vector3(i + 0.5, j + 0.5, k + 0.5), 0.2 * Vector3(1 - 2 * i, 1 - 2 * j, -(1 + k))) for i, j, k in places
    ]
    collider = shell_engines(len(shells), options)
    facets = add_shells(radius, 2, shells)
    timing.add_floor("surface")
    timing.add_walls(2 * spacing, 2 * spacing, "surface")
    return facets, collider


SCENES = {
    "s2": spheres_on_membrane,
    "s3": geogrid_pullout,
    "s4a": hollow_sphere_on_floor,
    "s4b": colliding_hollow_spheres,
}

options = timing.arguments(sys.argv[1:])
grid.structure_materials()
timing.contact_material(timing.SPHERE_DENSITY, "grains")
elements, collider = SCENES[options.scene](options)
timing.measure(options, elements, collider)
