# SPDX-License-Identifier: GPL-3.0-or-later
"""What one change costs: the files that know of one thing of each kind are those that docs/architecture.md names.

    costs_test.py ROOT

A file more is a cost that the page does not own up to; a file less is one that it can stop naming."""

import re
import sys
import unittest
from pathlib import Path

LIBRARIES = ("geometry", "contact", "dynamics", "apps")
ENDINGS = (".cpp", ".hpp", ".in", ".md")
LEFT_OUT = ("apps/examples/", "apps/viewer/web/")
PAGE = "docs/architecture.md"

ROOT = Path(sys.argv[1] if len(sys.argv) > 1 else ".")


def rows_below(head):
    """The cells of each row of the table of the page that has this head."""
    lines = (ROOT / PAGE).read_text(encoding="utf-8").splitlines()
    rows = []
    for line in lines[lines.index(head) + 2 :]:
        if not line.startswith("|"):
            break
        rows.append([cell.strip() for cell in line.strip("|").split("|")])
    return rows


def quoted(cell):
    return re.findall(r"`([^`]+)`", cell)


def files_of(cell):
    """The paths of a cell; `x.*` is a source and its header."""
    return {path.replace(".*", ending) for path in quoted(cell) for ending in ((".cpp", ".hpp") if ".*" in path else ("",))}


def files_with(names):
    wanted = re.compile("|".join(re.escape(name) for name in names))
    found = set()
    for library in LIBRARIES:
        for file in (ROOT / library).rglob("*"):
            path = file.relative_to(ROOT).as_posix()
            if file.suffix in ENDINGS and not path.startswith(LEFT_OUT) and wanted.search(file.read_text(encoding="utf-8")):
                found.add(path)
    return found


CHANGES = rows_below("| to add | new file | other edits |")
KNOWN = rows_below("| one of them | by these names | is known to |")


class OneChange(unittest.TestCase):
    def test_is_known_to_the_files_that_the_page_names_and_to_no_other(self):
        self.assertGreaterEqual(len(KNOWN), 7)
        for kind, names, files in KNOWN:
            with self.subTest(kind):
                self.assertEqual(files_with(quoted(names)), files_of(files))

    def test_costs_what_the_page_says_it_does(self):
        kinds = {row[0]: " ".join(row[1:]) for row in CHANGES}
        for kind, _, files in KNOWN:
            with self.subTest(kind):
                said = {Path(path).name for path in files_of(kinds[kind])}
                stands_for = {"x.cpp", "x.hpp", "read_*.cpp", "*.cpp", "x_command.cpp", "x_command.hpp"}
                known = {Path(path).name for path in files_of(files)}
                self.assertEqual(said - stands_for - known, set())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
