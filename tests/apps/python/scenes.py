# SPDX-License-Identifier: GPL-3.0-or-later
"""Scenes that several tests use, and what they need around them."""

import os
import subprocess
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[3]
PROGRAM = os.environ.get("PLEKTON_PROGRAM")
"""The program of the same build."""


def plekton(*arguments):
    """Runs the program."""
    # What is loaded before the interpreter, as a sanitizer's library, is not for the program.
    environment = {name: value for name, value in os.environ.items() if name != "LD_PRELOAD"}
    return subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, check=False, env=environment)


def sheet(cells, width):
    """Points (m) and facets of a square sheet at z = 0."""
    line = np.linspace(-0.5 * width, 0.5 * width, cells + 1)
    x, y = np.meshgrid(line, line)
    points = np.column_stack([x.ravel(), y.ravel(), np.zeros(x.size)])
    a = (np.arange(cells)[:, None] * (cells + 1) + np.arange(cells)).ravel()
    b, c, d = a + 1, a + cells + 1, a + cells + 2
    facets = np.concatenate([np.column_stack([a, b, d]), np.column_stack([a, d, c])])
    return points, facets


def spheres(count, seed=1):
    """Centres (m) and radii of spheres in layers above z = 0 that do not touch."""
    side = 10
    number = np.arange(count)
    cell = 0.013
    place = np.column_stack([number % side, number // side % side, number // side**2]).astype(float)
    place[:, :2] -= 0.5 * (side - 1)
    random = np.random.default_rng(seed)
    centres = cell * place + [0.0, 0.0, 0.008] + random.uniform(-0.0004, 0.0004, (count, 3))
    return centres, random.uniform(0.005, 0.006, count)


def rain(count=1000, cells=20, duration=0.02):
    """Spheres that fall on a sheet that is held at its rim, built of arrays."""
    points, facets = sheet(cells, 0.2)
    centres, radii = spheres(count)
    return {
        "simulation": {"duration": duration, "damping": 0.1},
        "materials": {
            "gravel": {"density": "2650 kg/m3", "young_modulus": "20 MPa", "friction_angle": "35 deg"}
        },
        "membranes": [
            {
                "name": "sheet",
                "shape": {"kind": "facets", "points": points, "facets": facets},
                "thickness": "2 mm",
                "material": "gravel",
                "young_modulus": "50 MPa",
                "areal_mass": "300 g/m2",
                "hold": "rim",
            }
        ],
        "grains": [
            {
                "name": "gravel",
                "material": "gravel",
                "centres": centres,
                "radii": radii,
                "velocity": [0, 0, "-1 m/s"],
            }
        ],
        "planes": [{"name": "floor", "point": [0, 0, "-5 cm"], "material": "gravel"}],
        "output": {
            "interval": "5 ms",
            "reactions": [
                {"name": "floor", "kind": "plane", "plane": "floor"},
                {"name": "rim", "kind": "support", "membrane": "sheet", "nodes": "rim"},
                {"name": "caught", "kind": "contacts", "membrane": "sheet"},
            ],
        },
    }


def small(**simulation):
    """A few spheres on a coarse sheet, for what does not depend on how many there are."""
    scene = rain(count=20, cells=4)
    scene["simulation"].update(simulation)
    return scene
