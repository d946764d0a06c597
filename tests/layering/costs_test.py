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

LAW = ("contact/law_list.cpp", "contact/law_list.hpp", "contact/law/list_problems.cpp", "contact/shipped_laws.hpp")
CHANGES = {
    "a contact law": (
        r"DmtAdhesion|dmt_adhesion",
        ("contact/law/dmt_adhesion.hpp", "contact/shipped_laws/dmt_adhesion.cpp", *LAW, "apps/scenario.md"),
    ),
    "a kind of load": (
        r"GroundSpring|ground_spring|AnchoredNodes",
        (
            "dynamics/loads/ground_springs.hpp",
            "dynamics/model/loads.hpp",
            "dynamics/model/acted_on.cpp",
            "dynamics/loads/loads_check.cpp",
            "dynamics/loads/applied_loads.cpp",
            "dynamics/loads/applied_loads.hpp",
            "apps/scenario/load_settings.hpp",
            "apps/scenario/read_load.cpp",
            "apps/scene/build_loads.cpp",
            "apps/scenario.md",
            # As it is stiff:
            "dynamics/time_step/step_limits.cpp",
            "dynamics/time_step/step_cause.hpp",
            "apps/command_line/step_advice.cpp",
        ),
    ),
    "an output field of contacts": (
        r"normal_force_magnitude",
        ("dynamics/output/contact_fields.cpp", "apps/scenario.md"),
    ),
    "a scenario key": (
        r"apertures",
        ("apps/scenario/read_shape.cpp", "apps/scenario/key_meanings.cpp", "apps/scenario.md",
         "geometry/mesh/generate/lattice.hpp", "geometry/mesh/generate/lattice.cpp"),
    ),
}
"""Kind of change, as in the table of the page: a pattern of an existing one, and the files that know of it."""

ROOT = Path(sys.argv[1] if len(sys.argv) > 1 else ".")


def files_with(pattern):
    wanted = re.compile(pattern)
    found = set()
    for library in LIBRARIES:
        for file in (ROOT / library).rglob("*"):
            path = file.relative_to(ROOT).as_posix()
            if file.suffix in ENDINGS and not path.startswith(LEFT_OUT) and wanted.search(file.read_text(encoding="utf-8")):
                found.add(path)
    return found


class OneChange(unittest.TestCase):
    def test_is_known_to_the_files_that_are_listed_and_to_no_other(self):
        for kind, (pattern, files) in CHANGES.items():
            with self.subTest(kind):
                self.assertEqual(files_with(pattern), set(files))

    def test_has_a_row_in_the_page(self):
        page = (ROOT / PAGE).read_text(encoding="utf-8")
        for kind in CHANGES:
            self.assertIn(f"| {kind} |", page)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
