# SPDX-License-Identifier: GPL-3.0-or-later
"""A picture that the commands of a tutorial do not make, an empty one, and a copy that shows something else are found; the site takes what was
made anew; every tutorial has a picture.

Usage: python3 pictures_test.py ROOT
"""

import os
import shutil
import sys
import tempfile
import unittest
from pathlib import Path

import pictures
from tutorials_test import Pictures

ROOT = Path(sys.argv[1]).resolve()
TUTORIALS = ROOT / "docs" / "tutorials"
sys.path.insert(0, str(ROOT / "docs"))
import gather

AXES = "<text>time (s)</text><text>force (N)</text>"
CURVE = "M0,0 " + " ".join(f"L{x},{x * (40 - x)}" for x in range(1, 40))
FLAT = "M0,0 " + " ".join(f"L{x},0" for x in range(1, 40))


def plot(texts, curve):
    return f'<svg xmlns="http://www.w3.org/2000/svg">{texts}<path stroke="red" d="{curve}"/></svg>'


class PicturesOfTutorials(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.pages, self.run = self.folder / "pages", self.folder / "run"
        (self.pages / "01-page").mkdir(parents=True)
        self.run.mkdir()

    def faults(self, page):
        seen = Pictures(self.pages, None)
        seen.is_possible = {True: True, False: True}
        return " ".join(seen.faults(page, "01-page", self.run))

    def write(self, folder, texts=AXES, curve=CURVE):
        (folder / "force.svg").write_text(plot(texts, curve), encoding="utf-8")

    def test_a_picture_that_the_commands_make_is_right(self):
        self.write(self.run)
        self.write(self.pages / "01-page")

        self.assertEqual(self.faults("![Force](01-page/force.svg)"), "")

    def test_a_picture_that_the_commands_do_not_make_is_found(self):
        self.write(self.pages / "01-page")

        self.assertIn("force.svg, as the commands of the page make it: is not there", self.faults("![Force](01-page/force.svg)"))
        self.assertIn("write no out/view.html", self.faults('![Scene](01-page/scene.png "out/view.html#frame=last")'))
        self.assertIn("../net.png is none that the commands of the page make", self.faults("![Net](../net.png)"))

    def test_an_empty_plot_is_found(self):
        self.write(self.pages / "01-page")
        for texts, curve, fault in ((AXES, FLAT, "has no curve"), ("<text>force</text>", CURVE, "has no two axes with a unit")):
            self.write(self.run, texts, curve)

            self.assertIn(fault, self.faults("![Force](01-page/force.svg)"))

    def test_a_scene_of_one_colour_is_found(self):
        scene = self.run / "scene.png"
        rows = [bytes((200, 210, 220)) * 300] * 300
        pictures.write_png(scene, 300, rows)
        self.assertIn("shows nothing", pictures.fault_of(scene))

        rows[100:120] = [bytes((255, 120, 0)) * 300] * 20
        pictures.write_png(scene, 300, rows)
        self.assertEqual(pictures.fault_of(scene), "")

    def test_a_copy_that_is_not_there_or_shows_something_else_or_is_shown_nowhere_is_found(self):
        self.write(self.run)
        self.assertIn("force.svg is not there", self.faults("![Force](01-page/force.svg)"))

        self.write(self.pages / "01-page", AXES.replace("force", "moment"))
        self.assertIn("shows ['time (s)', 'moment (N)'], and what the commands make", self.faults("![Force](01-page/force.svg)"))

        self.assertIn("force.svg is shown by no page", self.faults("No picture"))

    def test_the_site_takes_pictures_that_are_newer_than_page_and_program(self):
        program, page, made = self.folder / "program", self.pages / "01-page.md", self.folder / "made"
        for file in (program, page):
            file.touch()
        self.write(self.pages / "01-page")
        shutil.copytree(self.pages / "01-page", made / "01-page")
        fresh = (made / "01-page" / "force.svg", Path("01-page/force.svg"))

        self.assertEqual(list(gather.fresh_pictures(program, self.pages, made)), [fresh])
        self.assertEqual(list(gather.fresh_pictures(program, self.pages, self.folder / "none")), [])
        for later in (program, page):
            os.utime(later, (2e9, 2e9))
            self.assertEqual(list(gather.fresh_pictures(program, self.pages, made)), [])
            os.utime(later, (1, 1))

    def test_every_tutorial_has_a_picture(self):
        pages = {page.stem: page.read_text(encoding="utf-8") for page in TUTORIALS.glob("[0-9]*.md")}

        self.assertGreater(len(pages), 0)
        self.assertEqual([name for name, text in sorted(pages.items()) if not pictures.pictures_of(text, name)[0]], [])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
