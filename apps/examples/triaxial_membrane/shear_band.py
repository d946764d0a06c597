# SPDX-License-Identifier: GPL-3.0-or-later
"""Shows where a sample deforms: python3 shear_band.py RUN [RUN ...]; then gnuplot -c shear_band.gnuplot RUN PICTURE.png

RUN is the folder of a run of triaxial_membrane.toml. For increments of the axial strain it prints how small a part of the sample has half of
the deviatoric strain, and the flat slab, eight grains thick, that has most more of it than its share of the volume. A shear band is a slab
that is steep, and has much. Writes shear_band.csv into each folder, of the first and the last increment. Needs numpy.
"""
import math
import sys
from pathlib import Path

import numpy as np

import check

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import results  # noqa: E402

INCREMENTS = [(0.00, 0.01), (0.01, 0.02), (0.02, 0.04), (0.04, 0.06), (0.06, 0.08), (0.08, 0.10), (0.10, 0.12), (0.12, 0.15)]
NEIGHBOURHOOD = 2  # mean distance of grains that the strain at a grain is taken from, in d50
SLAB = 8  # thickness, in d50


class Sample:
    """The grains of a run from where shear begins: places and turns (m, rad) at the times of frames, radii, and the axial strain."""

    def __init__(self, run):
        begin = results.report_of(run)["stages"][0]["end_s"]
        frames = [(time, file) for time, file in results.frames(run, "grains") if time >= begin]
        times = [time for time, _ in frames]
        arrays = [results.Frame(file) for _, file in frames]
        self.places = [np.array(frame.points()) for frame in arrays]
        spins = [np.array(frame.vectors("PointData", "angular_velocity")) for frame in arrays]
        steps = [0.5 * (b - a) * (u + v) for a, b, u, v in zip(times, times[1:], spins, spins[1:])]
        self.turns = np.cumsum([np.zeros_like(spins[0]), *steps], axis=0)
        self.radii = np.array(arrays[0].array("PointData", "radius"))
        self.volumes = self.radii**3 / np.sum(self.radii**3)
        self.d50 = 2 * weighted_median(self.radii, self.volumes)
        moved = results.columns(run / "rigid_bodies.csv")
        height = np.interp(times, moved["time"], moved["upper platen.position_z"]) - moved["lower platen.position_z"][0]
        between = height - (height[0] - np.ptp(self.places[0][:, 2]))
        self.strain = 1 - between / between[0]

    def frame(self, strain):
        return int(np.argmin(np.abs(self.strain - strain)))


def weighted_median(values, weights):
    order = np.argsort(values)
    return values[order][np.searchsorted(np.cumsum(weights[order]), 0.5 * np.sum(weights))]


def neighbours(places, distance):
    """Pairs (i, j) of points nearer than a distance, each both ways."""
    cells = {}
    for i, cell in enumerate(map(tuple, np.floor(places / distance).astype(int))):
        cells.setdefault(cell, []).append(i)
    around = [(x, y, z) for x in (-1, 0, 1) for y in (-1, 0, 1) for z in (-1, 0, 1)]
    pairs = []
    for (x, y, z), mine in cells.items():
        near = np.array([j for a, b, c in around for j in cells.get((x + a, y + b, z + c), ())])
        apart = np.linalg.norm(places[mine][:, None] - places[near], axis=2)
        i, j = np.nonzero((apart < distance) & (apart > 0))
        pairs.append((np.array(mine)[i], near[j]))
    return (np.concatenate(side) for side in zip(*pairs))


def deviatoric_strains(before, after, distance):
    """sqrt(2/3 e:e) at each grain, of the deformation gradient that moves its neighbours with the least squares of errors."""
    i, j = neighbours(before, distance)
    old, new = before[j] - before[i], after[j] - after[i]
    squares, products = np.zeros((2, len(before), 3, 3))
    np.add.at(squares, i, old[:, :, None] * old[:, None, :])
    np.add.at(products, i, new[:, :, None] * old[:, None, :])
    gradient = products @ np.linalg.inv(squares)
    strain = 0.5 * (gradient.transpose(0, 2, 1) @ gradient - np.eye(3))
    deviator = strain - np.trace(strain, axis1=1, axis2=2)[:, None, None] / 3 * np.eye(3)
    return np.sqrt(2 / 3 * np.sum(deviator**2, axis=(1, 2)))


def part_with_half(strains, volumes):
    """The smallest part of the volume that has half of the strain: 0.5 where all is strained alike."""
    order = np.argsort(-strains)
    held = np.cumsum(strains[order] * volumes[order])
    return np.sum(volumes[order][: np.searchsorted(held, 0.5 * held[-1]) + 1])


def slab(places, strains, volumes, thickness):
    """(how much more of the strain than of the volume, part of the volume, slope in degrees, direction it falls to in rad) of the best slab."""
    best = (0,)
    held = strains * volumes / np.sum(strains * volumes)
    for slope in range(0, 91, 3):
        for azimuth in range(0, 360 if slope else 1, 10):
            a, b = math.radians(slope), math.radians(azimuth)
            along = (places - np.mean(places, axis=0)) @ (math.sin(a) * math.cos(b), math.sin(a) * math.sin(b), math.cos(a))
            order = np.argsort(along)
            total = lambda values: np.concatenate([[0], np.cumsum(values[order])])
            begin = np.arange(np.min(along), np.max(along) - thickness, 0.1 * thickness)
            ends = np.searchsorted(along[order], [begin, begin + thickness])
            volume, more = (np.diff(total(values)[ends], axis=0)[0] for values in (volumes, held - volumes))
            k = int(np.argmax(more))
            best = max(best, (more[k], volume[k], slope, b))
    return best


def expected_slopes(run):
    """Slopes (degrees) of a band between those of Roscoe, 45 + psi / 2, and of Coulomb, 45 + phi / 2, at the peak."""
    test = check.Test(run)
    peak = max(range(2, len(test.strain) - 2), key=test.smooth)
    slope = test.dilation(peak)
    dilatancy = math.degrees(math.asin(slope / (2 + slope)))
    return 45 + dilatancy / 2, 45 + check.friction_angle(test.smooth(peak)) / 2


def main():
    for run in results.runs_of_arguments(__doc__):
        sample = Sample(run)
        across = np.ptp(sample.places[0][:, 0]) / sample.d50
        if across < 2 * SLAB:
            sys.exit(f"{run}: {across:.0f} grains across; beside a slab of {SLAB} there have to be as many")
        print(f"{run}: {len(sample.radii)} grains, d50 {1e3 * sample.d50:.2f} mm; a band is expected at {'%.0f to %.0f' % expected_slopes(run)} deg")
        print("  axial strain    mean strain   half of it in   a slab of   has    slope")
        first = None
        for begin, end in INCREMENTS:
            if end > sample.strain[-1] + 0.005:
                break
            i, j = sample.frame(begin), sample.frame(end)
            strains = deviatoric_strains(sample.places[i], sample.places[j], NEIGHBOURHOOD * sample.d50)
            mean = np.sum(strains * sample.volumes)
            more, part, slope, azimuth = slab(sample.places[i], strains, sample.volumes, SLAB * sample.d50)
            print(f"  {100 * begin:4.0f} to {100 * end:2.0f} %    {100 * mean:8.2f} %     {100 * part_with_half(strains, sample.volumes):8.1f} %"
                  f"   {100 * part:8.0f} %   {100 * (part + more):3.0f} %   {slope:3} deg")
            turned = np.linalg.norm(sample.turns[j] - sample.turns[i], axis=1)
            first = first if first is not None else (sample.places[j], strains / mean, turned)
        write(run / "shear_band.csv", sample, azimuth, first, (sample.places[j], strains / mean, turned))


def write(path, sample, azimuth, *states):
    """Places, across the slab, along it and upwards from the axis (mm), strain over its mean, and turn (deg), each in two states; radii (mm)."""
    c, s = math.cos(azimuth), math.sin(azimuth)
    turn = np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])
    parts = [part for places, strains, turned in states for part in (1e3 * places @ turn, strains[:, None], np.degrees(turned)[:, None])]
    names = [f"{name} {state}" for state in ("first", "last") for name in ("x (mm)", "y (mm)", "z (mm)", "strain over mean", "turn (deg)")]
    results.write(path, [*names, "radius (mm)"], np.column_stack([*parts, 1e3 * sample.radii]), digits=4)


if __name__ == "__main__":
    main()
