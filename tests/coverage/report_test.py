# SPDX-License-Identifier: GPL-3.0-or-later
"""The report of coverage sees what has run of a small program, and what has not."""

import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from report import ranges, report

HEADER = """template <class T>
int sign(T x) {
  if (x > 0)
    return 1;
  if (x < 0)
    return -1;
  return 0;
}
"""
FIRST = '#include "../part/sign.hpp"\nint first() { return sign(2); }\n'
MAIN = """#include "../part/sign.hpp"
int first();
int never(int x) {
  return x + 1;
}
int main() { return first() == 1 && sign(0.0) == 0 ? 0 : 1; }
"""


class SmallProgram(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name).resolve()
        self.build = self.root / "build"
        self.build.mkdir()
        for name, text in (("part/sign.hpp", HEADER), ("part/first.cpp", FIRST), ("other/main.cpp", MAIN)):
            file = self.root / name
            file.parent.mkdir(exist_ok=True)
            file.write_text(text, encoding="utf-8")
        sources = [str(self.root / "part/first.cpp"), str(self.root / "other/main.cpp")]
        subprocess.run(["g++", "-O0", "--coverage", *sources, "-o", "program"], cwd=self.build, check=True)
        subprocess.run([self.build / "program"], cwd=self.build, check=True)

    def run_report(self, *arguments):
        return subprocess.run([sys.executable, "-B", Path(__file__).with_name("report.py"), self.build, *arguments, "--root", self.root],
                              check=False, capture_output=True, text=True)

    def test_names_what_has_run_nowhere(self):
        done = self.run_report("part", "other")

        self.assertEqual(done.returncode, 0, done.stderr)
        # Line 4 has run in one object and line 7 in the other.
        self.assertIn("part/sign.hpp: not run: 6\n", done.stdout)
        self.assertIn("other/main.cpp: not run: 3-4\n", done.stdout)
        self.assertNotIn("first.cpp: not run", done.stdout)

    def test_fails_below_what_is_asked_for(self):
        done = self.run_report("part", "other", "--least", "80")

        self.assertEqual(done.returncode, 1)
        self.assertIn("less than 80 % of the lines have run: other", done.stderr)

    def test_fails_for_a_folder_without_any_line(self):
        self.assertEqual(self.run_report("nothing", "--least", "80").returncode, 1)

    def test_refuses_a_build_without_counters(self):
        for note in self.build.glob("*.gcno"):
            note.unlink()
        done = self.run_report("part")

        self.assertEqual(done.returncode, 1)
        self.assertIn("no object was compiled with --coverage", done.stderr)


class Text(unittest.TestCase):
    def test_joins_lines_that_follow_each_other(self):
        self.assertEqual(ranges([9, 3, 5, 4]), "3-5, 9")
        self.assertEqual(ranges([]), "")

    def test_counts_lines_of_a_folder_together(self):
        text, poor = report({"a/x.cpp": {1: 1, 2: 0}, "a/y.cpp": {1: 5, 2: 7}}, ["a"], 75.0)

        self.assertEqual(text, "a: 75.0 % of 4 lines in 2 files\n   50.0 %  a/x.cpp: not run: 2")
        self.assertEqual(poor, [])


if __name__ == "__main__":
    unittest.main()
