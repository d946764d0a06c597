# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs an application of apps/examples and its check; then with wrong physics, which the check has to see.

Usage: python3 applications_test.py PROGRAM ROOT NAME
"""

import subprocess
import sys
import tempfile
from pathlib import Path

COARSE_NET = [
    f"membranes.net.{setting}"
    for setting in (
        "shape.mesh_size=200 mm",
        "shape.twist_length=100 mm",
        "shape.wire_height=100 mm",
        "shape.meshes=[15, 15]",
        "thickness=8 mm",
        'wire=[["1.2 %", "6 kN"], ["5 %", "9.6 kN"], ["12 %", "10.6 kN"]]',
        'twist_wire=[["1.2 %", "12 kN"], ["4 %", "18 kN"], ["9 %", "20.4 kN"]]',
    )
]
"""Half as many wires across, each twice as strong: a few seconds instead of a minute."""

APPLICATIONS = {
    "pullout_grid": {
        "right": {"grid": ("pullout_grid", []), "membrane": ("../pullout_membrane/pullout_membrane", [])},
        "wrong": {
            "a membrane with more friction than was said": (
                "../pullout_membrane/pullout_membrane",
                ["stages.pull.materials.soil.friction_angle=40 deg", "stages.pull.materials.plastic.friction_angle=40 deg"],
            )
        },
    },
    "membrane_tour": {
        "right": {"tour": ("membrane_tour", [])},
        "wrong": {"a tenth more friction": ("membrane_tour", ["materials.ball.friction_angle=22 deg", "simulation.duration=2.5 s"])},
    },
    "buckling_tube": {
        "right": {"lattice": ("buckling_tube", []), "sheet": ("continuum", [])},
        "wrong": {"beams that are a tenth too thick": ("buckling_tube", ["membranes.tube.thickness=2.2 mm"])},
    },
    "shear_box": {
        "right": {"box": ("shear_box", [])},
        "wrong": {"sand that slips": ("shear_box", ["stages.confine.materials.sand.friction_angle=5 deg"])},
    },
    "rockfall_net": {
        "right": {"net": ("rockfall_net", COARSE_NET)},
        "wrong": {
            "numerical damping": ("rockfall_net", [*COARSE_NET, "simulation.damping=0.05"]),
            "a lighter boulder": ("rockfall_net", [*COARSE_NET, "materials.rock.density=2500 kg/m3"]),
            "brakes that hold more": (
                "rockfall_net",
                [*COARSE_NET, *(f"ties.{side}_brakes.brake.force=11 kN" for side in ("left", "right", "front", "back"))],
            ),
        },
    },
    "triaxial_membrane": {
        "right": {
            "dense": ("triaxial_membrane", []),
            "loose": (
                "triaxial_membrane",
                ["grains.sand.porosity=0.52", "stages.confine.materials.sand.friction_angle=26.565 deg"],
            ),
        },
        "wrong": {
            "grains that slip": (
                "triaxial_membrane",
                ["stages.shear.materials.sand.friction_angle=5 deg", "stages.shear.end.displacement.distance=4 mm"],
            ),
            "more pressure than was said": (
                "triaxial_membrane",
                ["stages.confine.loads.cell.pressure=-32 kPa", "stages.shear.end.displacement.distance=4 mm"],
            ),
        },
    },
    "tyre": {
        "right": {"tyre": ("tyre", [])},
        "wrong": {"a floor without friction": ("tyre", ["materials.rubber.friction_angle=0", "stages.roll.end.duration=0.3 s"])},
    },
    "silo_bag": {
        "right": {"bag": ("silo_bag", [])},
        "wrong": {
            "gravel that is lighter than said": ("silo_bag", ["materials.gravel.density=2300 kg/m3"]),
            "damping that bears weight": ("silo_bag", ["simulation.damp_gravity=false", "simulation.damping=0.5"]),
        },
    },
    "gas_sphere": {
        "right": {"ball": ("gas_sphere", [])},
        "wrong": {
            "a ball that has to breathe": ("gas_sphere", ["stages.hang.membranes.ball.prestrain=0", "stages.press.end.duration=0.1 s"]),
            "gas that grows warm": ("gas_sphere", ["stages.hang.loads.gas.gas.exponent=1.4", "stages.press.end.duration=0.1 s"]),
        },
    },
    "bouncing_sphere": {
        "right": {
            "wall": ("bouncing_sphere", []),
            "half the step": ("bouncing_sphere", ["simulation.time_step=2.5 us"]),
            "gas": ("gas", []),
            "incline": ("incline", []),
        },
        "wrong": {
            "a wall that takes energy": ("bouncing_sphere", ["simulation.damping=0.1"]),
            "gas that is kept at its temperature": ("gas", ["stages.inflate.loads.air.gas.exponent=1"]),
            "more friction than there is": ("incline", ["materials.plastic.friction_angle=30 deg"]),
        },
    },
}
"""For each the runs, scenario and what is set, that its check passes, and those that it must not pass."""


def run(program, folder, scenario, settings, out):
    options = [word for setting in settings for word in ("--set", setting)]
    command = [program, "run", folder / f"{scenario}.toml", "--out", out, "--quiet", *options]
    subprocess.run(command, check=True, stderr=subprocess.PIPE)
    return out


def check(folder, runs):
    done = subprocess.run([sys.executable, "-B", folder / "check.py", *runs], capture_output=True, text=True)
    return done.returncode, done.stdout + done.stderr


def main():
    program, folder, name = sys.argv[1], Path(sys.argv[2], "apps/examples", sys.argv[3]), sys.argv[3]
    failures = []
    with tempfile.TemporaryDirectory() as work:
        right = [run(program, folder, *what, Path(work, label)) for label, what in APPLICATIONS[name]["right"].items()]
        code, said = check(folder, right)
        print(said)
        if code != 0:
            failures.append(f"{name}: the check fails")
        for label, what in APPLICATIONS[name]["wrong"].items():
            code, said = check(folder, [run(program, folder, *what, Path(work, "wrong " + label))])
            if code != 1 or "OUT OF BOUNDS" not in said:
                failures.append(f"{name}: the check passes {label}\n{said}")
    print("\n".join(failures))
    sys.exit(1 if failures else 0)


main()
