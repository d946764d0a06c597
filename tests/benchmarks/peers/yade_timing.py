# SPDX-License-Identifier: GPL-3.0-or-later
"""What the scenes for YADE share: their arguments, the walls, and the measurement printed as one line "RESULT {json}"."""

import argparse
import json
import math
import os
import time
from collections import Counter

from yade import FrictMat, O, Vector3, utils

TIME_STEP = 4e-6
"""s"""
CONTACT_YOUNG_MODULUS = 2e6
"""Pa; 2 kN/m between two spheres of 1 mm."""
STIFFNESS_RATIO = 2.0 / 7.0
"""tangential over normal; YADE calls it poisson."""
FRICTION_ANGLE = math.atan(0.5)
SPHERE_DENSITY = 2500.0
"""kg/m^3"""
GRAVITY = Vector3(0, 0, -9.81)


def arguments(argv):
    parser = argparse.ArgumentParser()
    parser.add_argument("--scene", default="s1")
    parser.add_argument("--bed")
    parser.add_argument("--cells", type=int, default=32)
    parser.add_argument("--verlet", type=float, default=1e-4, help="m, by which the box of a body is larger")
    parser.add_argument("--warm-up", type=int, required=True)
    parser.add_argument("--steps", type=int, required=True)
    return parser.parse_args(argv)


def contact_material(density, label):
    material = FrictMat(
        young=CONTACT_YOUNG_MODULUS, poisson=STIFFNESS_RATIO, density=density, frictionAngle=FRICTION_ANGLE, label=label
    )
    O.materials.append(material)
    return label


def add_spheres(bed, material, lift=lambda height: height):
    """The spheres of a bed, each at the height that lift() gives."""
    for x, y, z, radius, vx, vy, vz, wx, wy, wz in bed.spheres:
        body = utils.sphere((x, y, lift(z)), radius, material=material)
        body.state.vel = Vector3(vx, vy, vz)
        body.state.angVel = Vector3(wx, wy, wz)
        O.bodies.append(body)


def add_walls(length, width, material):
    for axis, position in ((0, 0.0), (0, length), (1, 0.0), (1, width)):
        O.bodies.append(utils.wall(position, axis, material=material))


def add_floor(material):
    O.bodies.append(utils.wall(0.0, 2, material=material))


def contacts_by_kind():
    """Number of interactions with a force, by the names of the two shapes; the beams of a grid are GridNode-GridNode."""
    counts = Counter()
    for contact in O.interactions:
        names = (O.bodies[body].shape.__class__.__name__ for body in (contact.id1, contact.id2))
        counts["-".join(sorted(names))] += bool(contact.isReal)
    return dict(counts)


def state_figures():
    """Kinetic energy of free nodes without rotation (J), mean, lowest and highest node (m), force on held nodes (N)."""
    nodes = [body for body in O.bodies if body.shape.__class__.__name__ in ("Sphere", "GridNode")]
    free = [body.state for body in nodes if body.state.blockedDOFs == ""]
    heights = [body.state.pos[2] for body in nodes]
    held = sum((O.forces.f(body.id) for body in nodes if body.state.blockedDOFs != ""), Vector3(0, 0, 0))
    return {
        "kinetic_energy_J": sum(0.5 * state.mass * state.vel.squaredNorm() for state in free),
        "mean_height_m": sum(heights) / len(heights),
        "lowest_node_m": min(heights),
        "highest_node_m": max(heights),
        "held_force_N": list(held),
    }


def measure(options, elements, collider):
    """Runs the warm-up and the timed steps and prints the result."""
    O.dt = TIME_STEP
    O.run(options.warm_up, True)
    runs_before, wall, processor = collider.numAction, time.perf_counter(), time.process_time()
    O.run(options.steps, True)
    wall, processor = time.perf_counter() - wall, time.process_time() - processor
    kinds = contacts_by_kind()
    result = {
        "scene": options.scene,
        "N": elements,
        "threads": int(os.environ.get("OMP_NUM_THREADS", "1")),
        "steps": options.steps,
        "ms_per_step": 1e3 * wall / options.steps,
        "cpu_ms_per_step": 1e3 * processor / options.steps,
        "contacts": sum(count for kind, count in kinds.items() if kind != "GridNode-GridNode"),
        "contacts_by_kind": kinds,
        "list_rebuilds": collider.numAction - runs_before,
        "state": state_figures(),
    }
    print("RESULT " + json.dumps(result), flush=True)
