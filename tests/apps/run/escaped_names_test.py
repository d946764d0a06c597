# SPDX-License-Identifier: GPL-3.0-or-later
"""Names with all that means something in XML, CSV, HTML or JSON come out of every output as they are, by the parsers of Python.

    python3 tests/apps/run/escaped_names_test.py PROGRAM
"""

import csv
import json
import re
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree
from html.parser import HTMLParser
from pathlib import Path

PROGRAM = ""
HOSTILE = """</script><b>&amp; "x", 'y'; {z} $(w) \\ %s é &lt;"""

SCENARIO = """
[simulation]
duration = "3 ms"
[materials.'MATERIAL']
density = "2650 kg/m3"
young_modulus = "10 MPa"
friction_angle = "30 deg"
[[membranes]]
name = '''bag NAME'''
shape = { kind = "sphere", radius = "4 cm", subdivisions = 1 }
mode = "continuum"
young_modulus = "2 MPa"
thickness = "3 mm"
areal_mass = "1 kg/m2"
material = 'MATERIAL'
[[grains]]
name = '''grains NAME'''
material = 'MATERIAL'
radius = "1 cm"
centres = [[0, 0, "5.1 cm"]]
[[rigid_bodies]]
name = '''brick NAME'''
shape = { kind = "box", size = ["2 cm", "2 cm", "2 cm"] }
translate = ["8 cm", 0, 0]
thickness = "1 mm"
density = "2000 kg/m3"
material = 'MATERIAL'
[[planes]]
name = '''floor NAME'''
point = [0, 0, "-4.15 cm"]
material = 'MATERIAL'
[[loads]]
name = '''gas NAME'''
kind = "pressure"
membrane = '''bag NAME'''
pressure = "1 kPa"
[[output.reactions]]
name = '''reaction NAME'''
kind = "plane"
plane = '''floor NAME'''
[output]
interval = "1 ms"
contact_list = true
"""


class Page(HTMLParser):
    """Tags and texts of a page, and what is in its scripts by id."""

    def __init__(self):
        super().__init__()
        self.tags, self.scripts, self.inside = [], {}, None

    def handle_starttag(self, tag, attributes):
        self.tags.append(tag)
        self.inside = dict(attributes).get("id") if tag == "script" else None

    def handle_endtag(self, tag):
        self.inside = None if tag == "script" else self.inside

    def handle_data(self, data):
        if self.inside:
            self.scripts[self.inside] = self.scripts.get(self.inside, "") + data


def page_of(file):
    page = Page()
    page.feed(file.read_text(encoding="utf-8"))
    return page


def strings_in(data):
    """All texts of what was JSON."""
    if isinstance(data, str):
        yield data
    for part in data.values() if isinstance(data, dict) else data if isinstance(data, list) else ():
        yield from strings_in(part)


def run(*arguments):
    return subprocess.run([PROGRAM, *map(str, arguments)], check=False, capture_output=True, text=True)


class EscapedNames(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        folder = Path(cls.temporary.name)
        # The names of files are the user's too.
        cls.out, cls.plain = folder / "a<b>&\"c\",'d'", folder / "plain"
        for name, out in ((HOSTILE, cls.out), ("plain", cls.plain)):
            scenario = folder / "scene.toml"
            scenario.write_text(SCENARIO.replace("NAME", name).replace("MATERIAL", name.replace("'", "’")), encoding="utf-8")
            done = run("run", scenario, "--quiet", "--out", out)
            assert done.returncode == 0, done.stderr

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def test_every_xml_file_is_well_formed_and_lists_what_is_there(self):
        files = sorted(self.out.rglob("*.pvd")) + sorted(self.out.rglob("*.vtp"))
        self.assertGreater(len(files), 6)
        for file in files:
            # What follows <AppendedData encoding="raw"> is no XML by design of VTK.
            head = re.split(rb"<AppendedData[^>]*>", file.read_bytes())
            text = head[0] + b"</VTKFile>" if len(head) > 1 else head[0]
            root = ElementTree.fromstring(text.decode("utf-8"))
            for data_set in root.iter("DataSet"):
                self.assertTrue((file.parent / data_set.get("file")).is_file(), data_set.get("file"))

    def test_every_row_of_every_table_has_the_columns_of_its_head(self):
        tables = sorted(self.out.rglob("*.csv"))
        self.assertEqual([file.name for file in tables], [file.name for file in sorted(self.plain.rglob("*.csv"))])
        heads = []
        for file in tables:
            with file.open(encoding="utf-8", newline="") as lines:
                rows = list(csv.reader(lines, strict=True))
            with (self.plain / file.name).open(encoding="utf-8", newline="") as lines:
                plain = next(csv.reader(lines, strict=True))
            self.assertEqual({len(row) for row in rows}, {len(plain)}, file.name)
            self.assertEqual(rows[0], [head.replace("plain", HOSTILE) for head in plain])
            heads += rows[0]
        for kind in ("reaction", "gas", "brick"):
            self.assertTrue(any(f"{kind} {HOSTILE}" in head for head in heads), (kind, heads))

    def test_run_json_has_the_names(self):
        names = json.loads((self.out / "run.json").read_text(encoding="utf-8"))["names"]

        self.assertEqual(names["grains"], [f"grains {HOSTILE}"])
        self.assertEqual(names["planes"], [f"floor {HOSTILE}"])

    def test_the_page_of_the_viewer_has_the_elements_that_it_has_with_plain_names(self):
        for out in (self.out, self.plain):
            done = run("view", out)
            self.assertEqual(done.returncode, 0, done.stderr)
        hostile, plain = page_of(self.out / "view.html"), page_of(self.plain / "view.html")

        self.assertEqual(hostile.tags, plain.tags)
        self.assertEqual(sorted(hostile.scripts), sorted(plain.scripts))
        run_data = json.loads(hostile.scripts["plekton-run"])
        texts = list(strings_in(run_data))
        self.assertIn(f"grains {HOSTILE}", texts)
        self.assertIn(f"bag {HOSTILE}", texts)

    def test_a_resumed_run_goes_on(self):
        for out in (self.out, self.plain):
            done = run("run", "--resume", out, "--quiet", "--set", 'simulation.duration="3.2 ms"')
            self.assertEqual(done.returncode, 0, done.stderr)


if __name__ == "__main__":
    PROGRAM = str(Path(sys.argv.pop(1)).resolve())
    unittest.main()
