# SPDX-License-Identifier: GPL-3.0-or-later
"""Structures of YADE's grid elements (nodes, connections, facets) and the engines that move them."""

import math

import yade_timing as timing
from yade import *  # noqa: F403  the functors are made when YADE starts
from yade import Vector3
from yade.gridpfacet import gridConnection, gridNode, pfacet

BEAM_YOUNG_MODULUS = 5e7
"""Pa"""
BEAM_POISSON_RATIO = 0.3
STRUCTURE_DENSITY = 3000.0
"""kg/m^3"""
UNBREAKABLE = 1e100
"""Pa"""

SPHERES, ALL_STRUCTURES = 1, 2
"""Bits of masks: bodies whose masks share no bit do not meet."""


def structure_materials():
    """The materials "nodes", which carries the beams, and "surface", which carries the contacts."""
    O.materials.append(
        CohFrictMat(
            young=BEAM_YOUNG_MODULUS,
            poisson=BEAM_POISSON_RATIO,
            density=STRUCTURE_DENSITY,
            frictionAngle=timing.FRICTION_ANGLE,
            normalCohesion=UNBREAKABLE,
            shearCohesion=UNBREAKABLE,
            momentRotationLaw=True,
            label="nodes",
        )
    )
    timing.contact_material(STRUCTURE_DENSITY, "surface")


def add_nodes(points, radius):
    return [O.bodies.append(gridNode(point, radius, material="nodes")) for point in points]


def add_bars(nodes, bars, radius, mask):
    for a, b in bars:
        O.bodies.append(gridConnection(nodes[a], nodes[b], radius, material="surface", mask=mask))


def add_membrane(points, facets, radius, mask):
    """Facets and their edges over shared nodes; the ids of the nodes."""
    nodes = add_nodes(points, radius)
    edges = {tuple(sorted((facet[k], facet[k - 1]))): None for facet in facets for k in range(3)}
    add_bars(nodes, edges, radius, mask)
    for a, b, c in facets:
        O.bodies.append(pfacet(nodes[a], nodes[b], nodes[c], material="surface", mask=mask))
    return nodes


def hold(body_ids, velocity=(0, 0, 0)):
    for body in body_ids:
        O.bodies[body].state.blockedDOFs = "xyzXYZ"
        O.bodies[body].state.vel = velocity


def add_engines(contact_kinds, verlet, no_self_contact):
    """The engines of a scene with structures; its collider. They come before the structures: YADE makes the beam of two nodes
    with the functors that it has when the second node is joined.

    @param contact_kinds    Functors of the meetings that are not between the nodes of a beam.
    @param verlet           m, by which the box of a body is larger.
    @param no_self_contact  Mask: bodies with one and the same mask that shares a bit with it do not meet.
    """
    boxes = [Bo1_Sphere_Aabb(), Bo1_Wall_Aabb(), Bo1_PFacet_Aabb(), Bo1_GridConnection_Aabb()]
    collider = InsertionSortCollider(boxes, verletDist=verlet, avoidSelfInteractionMask=no_self_contact)
    O.engines = [
        ForceResetter(),
        collider,
        InteractionLoop(
            [Ig2_GridNode_GridNode_GridNodeGeom6D(), *contact_kinds],
            [
                Ip2_CohFrictMat_CohFrictMat_CohFrictPhys(setCohesionNow=True, setCohesionOnNewContacts=True),
                Ip2_FrictMat_FrictMat_FrictPhys(),
            ],
            [
                Law2_ScGeom6D_CohFrictPhys_CohesionMoment(),
                Law2_ScGeom_FrictPhys_CundallStrack(),
                Law2_ScGridCoGeom_FrictPhys_CundallStrack(),
                Law2_GridCoGridCoGeom_FrictPhys_CundallStrack(),
            ],
        ),
        NewtonIntegrator(gravity=timing.GRAVITY, damping=0.3),
    ]
    return collider


def icosphere(subdivisions):
    """Points and facets of the unit sphere: an icosahedron whose facets are cut in four, that many times."""
    golden = 0.5 * (1.0 + math.sqrt(5.0))
    points = []
    for u in (-1.0, 1.0):
        for v in (-golden, golden):
            points += [Vector3(u, v, 0), Vector3(0, u, v), Vector3(v, 0, u)]
    side = 2.0
    near = [[k for k, q in enumerate(points) if abs((q - p).norm() - side) < 0.1] for p in points]
    facets = [(i, j, k) for i in range(12) for j in near[i] for k in near[i] if i < j < k and k in near[j]]
    points = [point.normalized() for point in points]
    facets = [outward(points, facet) for facet in facets]
    for _ in range(subdivisions):
        facets = cut_in_four(points, facets)
    return points, facets


def outward(points, facet):
    a, b, c = facet
    normal = (points[b] - points[a]).cross(points[c] - points[a])
    return (a, b, c) if normal.dot(points[a]) > 0 else (a, c, b)


def cut_in_four(points, facets):
    """The facets between the corners and the middles of the sides; the middles are put on the sphere and appended to points."""
    middles = {}

    def middle(a, b):
        key = (min(a, b), max(a, b))
        if key not in middles:
            middles[key] = len(points)
            points.append((points[a] + points[b]).normalized())
        return middles[key]

    finer = []
    for a, b, c in facets:
        ab, bc, ca = middle(a, b), middle(b, c), middle(c, a)
        finer += [(a, ab, ca), (b, bc, ab), (c, ca, bc), (ab, bc, ca)]
    return finer
