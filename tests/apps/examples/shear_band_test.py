# SPDX-License-Identifier: GPL-3.0-or-later
"""shear_band.py of the triaxial test finds strains and a slab that are known. Usage: python3 shear_band_test.py ROOT"""

import importlib.util
import math
import sys
import unittest
from pathlib import Path

if importlib.util.find_spec("numpy") is None:
    sys.exit(77)
import numpy as np

sys.path.insert(0, str(Path(sys.argv.pop(), "apps/examples/triaxial_membrane")))
import shear_band

SPACING = 2e-3  # m


def cylinder():
    """Points of a cubic grid in a cylinder of 40 mm by 80 mm, moved by a tenth of it at most, by chance that is the same every time."""
    axis = np.arange(-0.02, 0.0201, SPACING)
    grid = np.stack(np.meshgrid(axis, axis, np.arange(0, 0.0801, SPACING), indexing="ij"), axis=-1).reshape(-1, 3)
    inside = grid[np.hypot(grid[:, 0], grid[:, 1]) < 0.02]
    return inside + np.random.default_rng(1).uniform(-0.1 * SPACING, 0.1 * SPACING, inside.shape)


class ShearBand(unittest.TestCase):
    def test_strain_is_alike_where_all_is_compressed_alike(self):
        before = cylinder()
        shares = np.full(len(before), 1 / len(before))

        strains = shear_band.deviatoric_strains(before, before * (1.004, 1.004, 0.99), 2 * SPACING)

        # Green strains (l² - 1) / 2 along and across the axis; the deviator of these is 2/3 of their difference.
        expected = 2 / 3 * 0.5 * (1.004**2 - 0.99**2)
        np.testing.assert_allclose(strains, expected, rtol=1e-9)
        self.assertAlmostEqual(shear_band.part_with_half(strains, shares), 0.5, delta=2 / len(before))

    def test_a_turned_sample_is_not_strained(self):
        before = cylinder()
        c, s = math.cos(0.3), math.sin(0.3)

        strains = shear_band.deviatoric_strains(before, before @ np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]]), 2 * SPACING)

        self.assertLess(np.max(strains), 1e-12)

    def test_a_band_is_found_where_it_is(self):
        before = cylinder()
        shares = np.full(len(before), 1 / len(before))
        slope, azimuth, thickness = math.radians(51), math.radians(40), 8 * SPACING
        normal = np.array([math.sin(slope) * math.cos(azimuth), math.sin(slope) * math.sin(azimuth), math.cos(slope)])
        down = np.array([math.cos(slope) * math.cos(azimuth), math.cos(slope) * math.sin(azimuth), -math.sin(slope)])
        above = np.clip((before - (0, 0, 0.04)) @ normal / thickness + 0.5, 0, 1)

        strains = shear_band.deviatoric_strains(before, before + 1e-4 * above[:, None] * down, 2 * SPACING)
        more, volume, found, direction = shear_band.slab(before, strains, shares, thickness)

        self.assertAlmostEqual(found, 51, delta=3)  # the step of the search
        self.assertAlmostEqual(math.degrees(direction), 40, delta=10)
        self.assertLess(shear_band.part_with_half(strains, shares), 0.6 * volume)
        self.assertGreater(volume + more, 0.85)  # what the neighbourhoods smear out of it is missing


unittest.main()
