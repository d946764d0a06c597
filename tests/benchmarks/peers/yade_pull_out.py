# SPDX-License-Identifier: GPL-3.0-or-later
"""The pull-out of plekton-bench-pull-out in YADE: OMP_NUM_THREADS=1 yade -n -x -j1 yade_pull_out.py KIND SEED

KIND is "grid" or "membrane". Prints "RESULT {json}" with the keys of plekton-bench-pull-out. Beds of the same seed differ between the
codes in what chance moves grains by: at most 0.1 mm.
"""

import json
import math
import os
import random
import sys
import time

from yade import *  # noqa: F403  the functors are made when YADE starts
from yade import Vector3, utils
from yade.gridpfacet import gridConnection, gridNode, pfacet

LENGTH, WIDTH, CELL = 0.1, 0.05, 0.01  # m
GRAIN, RADIUS = 2.5e-3, 1e-3  # m, of the largest grain and of the lattice
MODULUS = 5e6  # Pa, of contacts; of the lattice ten times as much
DENSITY, FRICTION, PRESSURE = 2650.0, math.radians(20), 20e3  # SI
LAYERS, SETTLING, SPEED, PULL, STEP = 4, 0.06, 0.1, 0.012, 1.2e-5  # -, s, m/s, m, s
UNBREAKABLE = 1e40  # Pa


def materials(is_grid):
    O.materials.append(
        CohFrictMat(
            young=10 * MODULUS,
            poisson=0.3,
            density=DENSITY,
            frictionAngle=FRICTION,
            normalCohesion=UNBREAKABLE,
            shearCohesion=UNBREAKABLE,
            momentRotationLaw=is_grid,
            isCohesive=True,
            label="nodes",
        )
    )
    for label, friction in (("grains", FRICTION), ("walls", 0.0)):
        O.materials.append(FrictMat(young=MODULUS, poisson=0.3, density=DENSITY, frictionAngle=friction, label=label))


def engines(is_grid):
    lattice = (
        [Ig2_Sphere_GridConnection_ScGridCoGeom(), Ig2_GridConnection_GridConnection_GridCoGridCoGeom()]
        if is_grid
        else [Ig2_Sphere_PFacet_ScGridCoGeom()]
    )
    boxes = [Bo1_Sphere_Aabb(), Bo1_Wall_Aabb(), Bo1_GridConnection_Aabb() if is_grid else Bo1_PFacet_Aabb()]
    O.engines = [
        ForceResetter(),
        InsertionSortCollider(boxes, verletDist=-0.2),
        InteractionLoop(
            [Ig2_GridNode_GridNode_GridNodeGeom6D(), Ig2_Sphere_Sphere_ScGeom(), Ig2_Wall_Sphere_ScGeom(), *lattice],
            [
                Ip2_CohFrictMat_CohFrictMat_CohFrictPhys(setCohesionNow=True, setCohesionOnNewContacts=False),
                Ip2_FrictMat_FrictMat_FrictPhys(),
            ],
            [
                Law2_ScGeom6D_CohFrictPhys_CohesionMoment(),
                Law2_ScGeom_FrictPhys_CundallStrack(),
                Law2_ScGridCoGeom_FrictPhys_CundallStrack(),
                Law2_GridCoGridCoGeom_FrictPhys_CundallStrack(),
            ],
        ),
        NewtonIntegrator(damping=0.2, gravity=(0, 0, 0)),
    ]


def lattice(is_grid):
    """Nodes of the lattice by columns along the pull; the front is the first column."""
    columns, rows = round(LENGTH / CELL), round(WIDTH / CELL)
    number = lambda i, j: i * (rows + 1) + j
    nodes = [
        O.bodies.append(gridNode((i * CELL, j * CELL, 0), RADIUS, material="nodes"))
        for i in range(columns + 1)
        for j in range(rows + 1)
    ]
    facets = []
    for i in range(columns):
        for j in range(rows):
            a, b, c, d = number(i, j), number(i + 1, j), number(i + 1, j + 1), number(i, j + 1)
            facets += [(a, b, c), (a, c, d)] if (i + j) % 2 == 0 else [(a, b, d), (b, c, d)]
    edges = dict.fromkeys(tuple(sorted((f[k], f[(k + 1) % 3]))) for f in facets for k in range(3))
    straight = [(a, b) for a, b in edges if a // (rows + 1) == b // (rows + 1) or a % (rows + 1) == b % (rows + 1)]
    for a, b in straight if is_grid else edges:
        O.bodies.append(gridConnection(nodes[a], nodes[b], RADIUS, material="grains"))
    for corners in [] if is_grid else facets:
        O.bodies.append(pfacet(*(nodes[k] for k in corners), material="grains"))
    for node in nodes:
        state = O.bodies[node].state
        state.inertia = Vector3(1, 1, 1) * max(state.inertia[0], state.mass * CELL * CELL / 12)
        if not is_grid:
            state.blockedDOFs = "XYZ"
    if not is_grid:  # bars have no stiffness across them
        for beam in O.interactions:
            beam.phys.ks = 0.0
    return nodes[: rows + 1]


def bed(seed):
    chance = random.Random(seed)
    pitch = 2.04 * GRAIN
    columns, rows = int(LENGTH / pitch), int(WIDTH / pitch)
    grains = []
    for side in (1, -1):
        for layer in range(LAYERS):
            z = side * (RADIUS + GRAIN + 2e-4 + layer * pitch)
            for i in range(columns):
                for j in range(rows):
                    radius = GRAIN * chance.uniform(0.88, 1.0)
                    x = (i + 0.5) * LENGTH / columns + chance.uniform(-1e-4, 1e-4)
                    y = (j + 0.5) * WIDTH / rows + chance.uniform(-1e-4, 1e-4)
                    grains.append(O.bodies.append(utils.sphere((x, y, z), radius, material="grains")))
    top = RADIUS + 2 * GRAIN + 9e-4 + (LAYERS - 1) * pitch
    walls = [
        O.bodies.append(utils.wall(position, axis=axis, sense=sense, material="walls"))
        for position, axis, sense in ((0, 0, 1), (LENGTH, 0, -1), (0, 1, 1), (WIDTH, 1, -1), (-top, 2, 1), (top, 2, -1))
    ]
    for wall in walls:  # the lattice passes through them
        O.bodies[wall].mask = 2
    for grain in grains:
        O.bodies[grain].mask = 3
    return len(grains), [(O.bodies[walls[5]], -1), (O.bodies[walls[4]], 1)]


def add_servo(plates):
    """Plates go on at a speed by what of the pressure is missing."""

    def servo():
        for plate, sense in plates:
            missing = (PRESSURE - abs(O.forces.f(plate.id)[2]) / (LENGTH * WIDTH)) / PRESSURE
            plate.state.vel = (0, 0, sense * max(-0.3, min(0.3, 0.15 * missing)))

    import builtins

    builtins.pull_out_servo = servo
    O.engines += [PyRunner(command="import builtins; builtins.pull_out_servo()", iterPeriod=1)]


def main():
    kind, seed = sys.argv[1], int(sys.argv[2])
    is_grid = kind == "grid"
    begin, processor = time.perf_counter(), time.process_time()
    engines(is_grid)
    materials(is_grid)
    front = [O.bodies[node] for node in lattice(is_grid)]
    grains, plates = bed(seed)
    add_servo(plates)
    O.dt = STEP
    O.run(int(SETTLING / STEP), True)
    for node in front:
        node.state.blockedDOFs, node.state.vel = "xyzXYZ", (-SPEED, 0, 0)
    rows, shares = 120, []
    part = int(PULL / SPEED / STEP) // rows
    for row in range(rows):
        O.run(part, True)
        out = SPEED * (row + 1) * part * STEP
        shares.append(sum(O.forces.f(node.id)[0] for node in front) / (2 * PRESSURE * (LENGTH - out) * WIDTH))
    later = shares[rows // 2 :]
    print(
        "RESULT "
        + json.dumps(
            {
                "kind": kind,
                "grains": grains,
                "steps": O.iter,
                "wall_s": time.perf_counter() - begin,
                "cpu_s": time.process_time() - processor,
                "share": sum(later) / len(later),
            }
        ),
        flush=True,
    )
    os._exit(0)


main()
