# SPDX-License-Identifier: GPL-3.0-or-later
"""Packs 20 000 grains to a porosity in a cylinder, and a box under stress, and compares what is measured with what was asked for.

Usage: python3 packings_test.py PROGRAM

The box has 2000 grains, and with PLEKTON_PACKINGS=all in the environment 20 000 (two minutes).
"""

import csv
import json
import os
import sys
import tempfile
import time
import unittest
from pathlib import Path
from subprocess import run

SCENES = Path(__file__).parent
LARGER = ["--set", "grains.sand.count=2000", "--set",
          'grains.sand.sieves=[{ sieve = "6.5 mm", passing = 0 }, { sieve = "10.8 mm", passing = 1 }]']
"""The same box of fewer grains: sizes by the root of third degree of ten."""

program = ""


class Packings(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.out = Path(folder.name) / "out"

    def run_scene(self, scene, *arguments):
        begin = time.monotonic()
        ended = run([program, "run", str(SCENES / scene), "--out", str(self.out), "--quiet", "--strict", *arguments],
                    capture_output=True, text=True, timeout=900)
        self.assertEqual(ended.returncode, 0, ended.stderr)
        print(f"{scene}: {time.monotonic() - begin:.1f} s", flush=True)

    def last_row_of(self, name):
        with open(self.out / name, encoding="utf-8") as file:
            return {column.split(" (")[0]: float(value) for column, value in list(csv.DictReader(file))[-1].items()}

    def test_of_20000_grains_in_a_cylinder_has_the_porosity_that_was_asked_for(self):
        self.run_scene("cylinder.toml")
        measured = self.last_row_of("measures/whole.csv")
        print(f"  porosity {measured['porosity']:.4f}", flush=True)
        self.assertEqual(measured["grains"], 20000)
        self.assertAlmostEqual(measured["porosity"], 0.40, delta=0.005)
        self.assertEqual(measured["contacts"], 0)
        self.assertEqual(json.loads((self.out / "run.json").read_text())["lost_grains"], 0)

    def test_between_servo_plates_has_their_stress_and_no_direction(self):
        grains = 20000 if os.environ.get("PLEKTON_PACKINGS") == "all" else 2000
        self.run_scene("box.toml", *([] if grains == 20000 else LARGER))
        forces, whole = self.last_row_of("reactions.csv"), self.last_row_of("measures/whole.csv")
        self.assertEqual(whole["grains"], grains)
        for plate, axis in (("east", "x"), ("north", "y"), ("lid", "z")):
            # On the side of the box between the planes, as they are now.
            area = whole["volume"] / forces[f"{plate}.position_{axis}"]
            stress = -forces[f"{plate}.force_{axis}"] / area
            told = whole[f"stress_{axis}{axis}"]
            fabric = whole[f"fabric_{axis}{axis}"]
            print(f"  {axis}: stress {told:.0f} Pa, by the plate {stress:.0f} Pa; fabric {fabric:.4f}", flush=True)
            self.assertAlmostEqual(told, stress, delta=0.01 * abs(stress))
            self.assertAlmostEqual(stress, -20e3, delta=0.01 * 20e3)
            self.assertAlmostEqual(fabric, 1 / 3, delta=0.02 / 3)


if __name__ == "__main__":
    program = sys.argv.pop(1)
    unittest.main()
