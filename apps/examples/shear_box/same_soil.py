#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests one soil in the shear box and in the triaxial cell, and says how far their friction angles are apart.

    python3 same_soil.py [--plekton PROGRAM] [--out DIR] [--seeds 1 2 3] [--friction 30] [--box PATH=VALUE ...]

Runs shear_box.toml here and ../triaxial_membrane/triaxial_membrane.toml with the same grains, each with every seed; a run that is in DIR
(out/same_soil) already is not made again. --box changes the box alone. Ends 1 where the mean angles are further apart than 3 degrees.

Both peaks are of one rule: the largest of means over 25 ms that begin 5 ms apart, which are 0.75 mm of the way in both, as the upper half and the
upper platen move with 30 mm/s (check.py of both). The angle of the box is that of the forces on its lower half. Beside it stands that of the
stresses in the sand around the gap, shear over normal stress of measures/middle.csv, by the same rule.
"""
import argparse
import importlib.util
import math
import subprocess
import sys
import zlib
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from results import columns, mean, report_of  # noqa: E402

HERE = Path(__file__).resolve().parent
TRIAXIAL = HERE.parent / "triaxial_membrane"
ALLOWED = 3.0  # degrees
SOIL = {
    "materials.sand.young_modulus": '"20 MPa"',
    "grains.sand.sieves": '[{ sieve = "4 mm", passing = 0 }, { sieve = "6 mm", passing = 1 }]',
}
PRESSURE = 25e3  # Pa, of the cell, and of the lid on the 56 mm by 56 mm between the walls
# The soil at three quarters of its scale, fifteen grains across; and walls without friction, on which sand that rises does not hang.
BOX = {
    "stages.confine.loads.press.force": f'"{PRESSURE * 0.056**2:.1f} N"',
    "materials.steel.friction_angle": "0",
    "grains.sand.sieves": '[{ sieve = "3 mm", passing = 0 }, { sieve = "4.5 mm", passing = 1 }]',
    "grains.sand.count": "2850",
}
# Friction while the samples are made says how dense they get; rain and packing differ, so for the same porosity it does too.
BOX_MAKING, TRIAXIAL_MAKING = "stages.deposit.materials.sand.friction_angle", "stages.confine.materials.sand.friction_angle"


def module(path):
    spec = importlib.util.spec_from_file_location(path.parent.name, path)
    found = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(found)
    return found


def run(program, scenario, settings, out):
    """The folder of a run, which is made if it is not there yet."""
    options = [word for path, value in settings.items() for word in ("--set", f"{path}={value}")]
    folder = out / f"{scenario.stem}_{zlib.crc32(repr(options).encode()):08x}"
    if not (folder / "run.json").exists():
        command = [program, "run", scenario, "--out", folder, "--overwrite", "--quiet", "--threads", "1", *options]
        done = subprocess.run(command, stderr=subprocess.PIPE, text=True)
        if done.returncode != 0:
            sys.exit(done.stderr)
    return folder


def deviation(values):
    """Standard deviation of one of these."""
    return math.sqrt(sum((v - mean(values)) ** 2 for v in values) / (len(values) - 1)) if len(values) > 1 else math.nan


def of(path, *names):
    history = columns(path)
    return [history[name] for name in names]


def box_test(out, check):
    """Porosity when it is confined, angles of shear over normal force through the gap and of the stresses there, and how steeply the lid rises."""
    confine, shear = report_of(out)["stages"][-2:]
    times, over, under = of(out / "reactions.csv", "time", "lower half.force_x", "lower half.force_z")
    moments, porosity, xz, zz = of(out / "measures" / "middle.csv", "time", "porosity", "stress_xz", "stress_zz")
    moving = lambda times: next(i for i, t in enumerate(times) if t > shear["start_s"] + 0.01)
    forces, row = check.peak(over, [-z for z in under], moving(times))
    stresses, _ = check.peak([abs(s) for s in xz], [abs(s) for s in zz], moving(moments))
    moment, rise, way = of(out / "rigid_bodies.csv", "time", "lid.position_z", "upper half.position_x")
    near = [i for i, t in enumerate(moment) if abs(t - times[row]) < 0.015]
    slope = (rise[near[-1]] - rise[near[0]]) / (way[near[-1]] - way[near[0]])
    confined = [p for t, p in zip(moments, porosity) if t <= confine["end_s"]][-1]
    return confined, *(math.degrees(math.atan(ratio)) for ratio in (forces, stresses)), slope


def triaxial_test(out, check):
    """Porosity when it is confined, angle of the principal stresses, and the rate of dilation there."""
    test = check.Test(out)
    peak = max(range(2, len(test.strain) - 2), key=test.smooth)
    return test.porosity, check.friction_angle(test.smooth(peak)), test.dilation(peak)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--plekton", default="plekton", help="the program")
    parser.add_argument("--out", type=Path, default=Path("out/same_soil"))
    parser.add_argument("--seeds", type=int, nargs="+", default=[1, 2, 3])
    parser.add_argument("--friction", type=float, default=30.0, help="of the grains, degrees")
    parser.add_argument("--making", type=float, nargs=2, default=[2.0, 5.0], help="while the samples of box and cell are made, degrees")
    parser.add_argument("--box", nargs="*", default=[], metavar="PATH=VALUE", help="other values of the box")
    given = parser.parse_args()
    sand = f'"{given.friction:g} deg"'
    in_box, in_cell = (f'"{angle:g} deg"' for angle in given.making)
    box_check, triaxial_check = module(HERE / "check.py"), module(TRIAXIAL / "check.py")
    boxes, cells = [], []
    print("seed   box: porosity, angle of forces, of stresses, rise over way   cell: porosity, angle, dilation")
    for seed in given.seeds:
        common = {**SOIL, "simulation.seed": seed, "materials.sand.friction_angle": sand}
        box = {**common, **BOX, BOX_MAKING: in_box, "stages.level.materials.sand.friction_angle": sand}
        box.update(setting.split("=", 1) for setting in given.box)
        cell = {**common, TRIAXIAL_MAKING: in_cell, "stages.shear.materials.sand.friction_angle": sand}
        boxes.append(box_test(run(given.plekton, HERE / "shear_box.toml", box, given.out), box_check))
        cells.append(triaxial_test(run(given.plekton, TRIAXIAL / "triaxial_membrane.toml", cell, given.out), triaxial_check))
        (loose, forces, stresses, rise), (cell_loose, angle, dilation) = boxes[-1], cells[-1]
        print(f"{seed:4}   {loose:.3f}, {forces:.1f} deg, {stresses:.1f} deg, {rise:.2f}   {cell_loose:.3f}, {angle:.1f} deg, {dilation:.2f}", flush=True)
    print(f"mean porosity of the boxes {mean([t[0] for t in boxes]):.3f}, of the cells {mean([t[0] for t in cells]):.3f}")
    angles = {"box": [t[1] for t in boxes], "stresses in the box": [t[2] for t in boxes], "cell": [t[1] for t in cells]}
    for name, values in angles.items():
        print(f"{name}: {mean(values):.1f} deg, standard deviation of one {deviation(values):.1f}")
    apart = mean(angles["box"]) - mean(angles["cell"])
    print(f"box less cell: {apart:+.1f} deg ({-ALLOWED:g} to {ALLOWED:g}){'' if abs(apart) <= ALLOWED else '  OUT OF BOUNDS'}")
    return 0 if abs(apart) <= ALLOWED else 1


if __name__ == "__main__":
    sys.exit(main())
