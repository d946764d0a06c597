# SPDX-License-Identifier: GPL-3.0-or-later
"""Scenes s1 and s1flow in YADE: spheres in a box without a lid.

Usage: yade -n -x -j1 yade_bed.py --bed FILE --warm-up N --steps N [--scene s1flow] [--verlet M]
"""

import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))

import yade_timing as timing
from to_lammps_data import read_bed
from yade import *  # noqa: F403  the functors are made when YADE starts

options = timing.arguments(sys.argv[1:])
bed = read_bed(options.bed)
grains = timing.contact_material(timing.SPHERE_DENSITY, "grains")
timing.add_spheres(bed, grains)
timing.add_walls(bed.length, bed.width, grains)
timing.add_floor(grains)

collider = InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Wall_Aabb()], verletDist=options.verlet)
O.engines = [
    ForceResetter(),
    collider,
    InteractionLoop(
        [Ig2_Sphere_Sphere_ScGeom(), Ig2_Wall_Sphere_ScGeom()],
        [Ip2_FrictMat_FrictMat_FrictPhys()],
        [Law2_ScGeom_FrictPhys_CundallStrack()],
    ),
    NewtonIntegrator(gravity=timing.GRAVITY, damping=0.2),
]
timing.measure(options, len(bed.spheres), collider)
