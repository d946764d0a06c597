# SPDX-License-Identifier: GPL-3.0-or-later
"""The site builds without warnings, loads nothing from outside, has formulas, every page of the tree and the pictures of the tutorials, and
links only to what is there.

Usage: python3 site_test.py PROGRAM ROOT; ends 77 where Sphinx, MyST, its theme or KaTeX are missing (cmake/debian-packages.txt, doc)
"""

import re
import subprocess
import sys
import tempfile
from pathlib import Path

from pictures import SHOWN

SKIPPED = 77
PYTHON = "/usr/bin/python3"
PARTS = ("start", "tutorials/index", "applications/tyre", "howto/errors", "reference/keys", "theory/contact_rule", "validation", "coming_from/yade", "project")
LINK = re.compile(r'(?:href|src)="([^"#:?]+)[^":]*"')


def is_installed():
    """Whether all is there that the site is made with."""
    modules = subprocess.run([PYTHON, "-c", "import sphinx, myst_parser, pydata_sphinx_theme"], capture_output=True)
    return modules.returncode == 0 and Path("/usr/share/javascript/katex").is_dir()


def broken_links(site):
    """Links of pages to files that are not there; the interface and the theme are of others."""
    has_api = (site / "api").is_dir()
    for page in site.rglob("*.html"):
        if (site / "api") in page.parents or (site / "_static") in page.parents:
            continue
        for link in LINK.findall(page.read_text(encoding="utf-8")):
            if "api/" in link and not has_api:
                continue
            if not (page.parent / link).exists():
                yield f"{page.relative_to(site)}: links to {link}, which is not there"


def missing_pictures(site, tutorials):
    """Pictures of the tutorials that the site does not show."""
    for page in sorted(tutorials.glob("*.md")):
        shown = (site / "tutorials" / page.name).with_suffix(".html").read_text(encoding="utf-8")
        for picture in SHOWN.finditer(page.read_text(encoding="utf-8")):
            if f"_images/{Path(picture['link']).name}" not in shown:
                yield f"tutorials/{page.stem}.html: does not show {picture['link']}"


def main():
    program, root = sys.argv[1:3]
    if not is_installed():
        print("skipped: needs python3-sphinx, python3-myst-parser, python3-pydata-sphinx-theme and libjs-katex")
        return SKIPPED
    with tempfile.TemporaryDirectory() as folder:
        site = Path(folder, "site")
        built = subprocess.run(["sh", Path(root, "docs/build.sh"), program, site], capture_output=True, text=True)
        if built.returncode != 0:
            print(built.stdout + built.stderr)
            return 1
        failures = [f"{part}.html is missing" for part in PARTS if not (site / f"{part}.html").is_file()]
        failures += broken_links(site)
        failures += missing_pictures(site, Path(root, "docs/tutorials"))
        if "(apps/examples/catch/catch.toml)" in re.sub("<[^>]*>", "", (site / "reference/scenario.html").read_text(encoding="utf-8")):
            failures.append("reference/scenario.html names a file twice")
        if "katex.min.js" not in (site / "theory/laws.html").read_text(encoding="utf-8"):
            failures.append("theory/laws.html does not load KaTeX")
    for failure in failures:
        print(failure)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
