# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes a bed of plekton-bench as a data file that LAMMPS and LIGGGHTS read (both of the sphere styles).

Usage: python3 to_lammps_data.py BED OUT
"""

import sys
from dataclasses import dataclass

DENSITY = 2500.0
"""kg/m^3"""

HEADROOM = 0.01
"""m, of the box above the highest centre; neither code lets a sphere leave the box."""


@dataclass(frozen=True)
class Bed:
    """The box (m) and, for each sphere, x y z radius vx vy vz wx wy wz in SI units."""

    length: float
    width: float
    spheres: list


def read_bed(path):
    """The bed in a file: a line "count side extent", then a line for each sphere; the box is side*extent long, side wide.

    ValueError, naming the line, if a sphere has not ten numbers or their number is not the count.
    """
    with open(path, encoding="utf-8") as file:
        count, side, extent = (float(word) for word in file.readline().split())
        spheres = [[float(word) for word in line.split()] for line in file if line.strip()]
    for number, sphere in enumerate(spheres, start=2):
        if len(sphere) != 10:
            raise ValueError(f"{path}:{number}: {len(sphere)} numbers; expected x y z radius vx vy vz wx wy wz")
    if len(spheres) != count:
        raise ValueError(f"{path}: {len(spheres)} spheres; its first line promises {count:g}")
    return Bed(side * extent, side, spheres)


def data_lines(bed):
    """The lines of the data file."""
    top = max(sphere[2] for sphere in bed.spheres) + HEADROOM
    yield f"{len(bed.spheres)} spheres in a box without a lid\n\n{len(bed.spheres)} atoms\n1 atom types\n\n"
    yield f"0 {bed.length:.10g} xlo xhi\n0 {bed.width:.10g} ylo yhi\n-0.001 {top:.10g} zlo zhi\n\nAtoms\n\n"
    for number, (x, y, z, radius, *_) in enumerate(bed.spheres, start=1):
        yield f"{number} 1 {2 * radius:.12g} {DENSITY:g} {x:.14g} {y:.14g} {z:.14g}\n"
    yield "\nVelocities\n\n"
    for number, sphere in enumerate(bed.spheres, start=1):
        yield f"{number} " + " ".join(f"{component:.12g}" for component in sphere[4:]) + "\n"


def convert(bed_path, data_path):
    """Writes the data file of a bed."""
    with open(data_path, "w", encoding="utf-8") as file:
        file.writelines(data_lines(read_bed(bed_path)))


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    convert(sys.argv[1], sys.argv[2])
