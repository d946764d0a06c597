# SPDX-License-Identifier: GPL-3.0-or-later
"""Puts the pages of the site together: those of this folder, what other folders have, and what the program writes.

Usage: python3 gather.py PROGRAM ROOT FOLDER [PICTURES]; FOLDER is made anew. PICTURES has pictures that the tests of the tutorials have made,
which take the place of the copies that are kept beside the tutorials
"""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

KATEX = Path("/usr/share/javascript/katex")

ELSEWHERE = {
    "apps/scenario.md": "reference/scenario.md",
    "apps/examples/import/README.md": "howto/membrane_sources.md",
    "apps/study.md": "howto/study.md",
    "docs/python.md": "howto/python.md",
    "tests/validation/README.md": "validation_tables.md",
    "CHANGELOG.md": "changelog.md",
}
"""Pages of other folders, and where they go. Those that are missing are left out."""

WRITTEN = {"keys": "reference/keys.md", "laws": "reference/laws.md", "outputs": "reference/outputs.md", "commands": "reference/commands.md"}
"""What `plekton generate` writes, and where it goes."""

APPLICATION = re.compile(r"apps/examples/(\w+)/README\.md")
"""Pages of applications, which go to applications/NAME.md, but for those that are named above."""

PICTURE = re.compile(r"apps/examples/\w+/(\w+\.png)")

LINK = re.compile(r"(!?)\[((?:[^\[\]]|\[[^\]]*\])*)\]\(([^()\s]+)\)")


def place_of(path, root):
    """Where a file of the tree is on the site; nothing if it is not."""
    relative = path.relative_to(root).as_posix()
    if relative in ELSEWHERE:
        return ELSEWHERE[relative]
    if application := APPLICATION.fullmatch(relative):
        return f"applications/{application[1]}.md"
    if picture := PICTURE.fullmatch(relative):
        return "pictures/" + picture[1]
    return relative[len("docs/") :] if relative.startswith("docs/") and relative.endswith((".md", ".png", ".svg")) else None


def with_links_of_the_site(text, page, root, target):
    """The text of a page, with links to what is on the site as from its place there; other files become their path in the
    sources."""

    def replaced(match):
        mark, words, link = match.groups()
        if link.startswith(("#", "http://", "https://")):
            return match[0]
        file, _, anchor = link.partition("#")
        path = (page.parent / file).resolve()
        if not path.is_relative_to(root):
            return match[0]
        place = place_of(path, root)
        if place is None:
            in_sources = path.relative_to(root).as_posix()
            named = words.strip("`")
            return f"`{in_sources}`" if in_sources.endswith(named) else f"{words} (`{in_sources}`)"
        return f"{mark}[{words}]({os.path.relpath(place, os.path.dirname(target))}{'#' + anchor if anchor else ''})"

    return LINK.sub(replaced, text)


def pages_of_the_site(root):
    """Pages of the tree, and where they go."""
    for page in [*map(root.joinpath, ELSEWHERE), *root.glob("docs/**/*.md"), *root.glob("apps/examples/*/README.md")]:
        if page.is_file():
            yield page, place_of(page, root)


def fresh_pictures(program, tutorials, made):
    """Pictures that were made after the program and the page were, and their places below the tutorials; others are of another page or program."""
    for copy in sorted(tutorials.glob("*/*")):
        picture = made / copy.relative_to(tutorials)
        sources = (Path(program), copy.parent.with_suffix(".md"))
        if picture.is_file() and all(picture.stat().st_mtime >= source.stat().st_mtime for source in sources):
            yield picture, copy.relative_to(tutorials)


def main():
    program, root, folder = sys.argv[1], Path(sys.argv[2]).resolve(), Path(sys.argv[3])
    shutil.rmtree(folder, ignore_errors=True)
    shutil.copytree(root / "docs", folder, ignore=shutil.ignore_patterns("build.sh", "gather.py", "Doxyfile.in", "api.sh", "api.dox"))
    for page, target in pages_of_the_site(root):
        if page.is_relative_to(root / "docs") and (copy := folder / page.relative_to(root / "docs")) != folder / target:
            copy.unlink(missing_ok=True)
        text = with_links_of_the_site(page.read_text(encoding="utf-8"), page, root, target)
        (folder / target).write_text(text, encoding="utf-8")
    if len(sys.argv) > 4:
        for picture, place in fresh_pictures(program, root / "docs" / "tutorials", Path(sys.argv[4])):
            shutil.copy(picture, folder / "tutorials" / place)
    for what, target in WRITTEN.items():
        text = subprocess.run([program, "generate", what], capture_output=True, text=True, check=True).stdout
        (folder / target).write_text(text, encoding="utf-8")
    (folder / "pictures").mkdir()
    for picture in root.glob("apps/examples/*/*.png"):
        shutil.copy(picture, folder / "pictures")
    if not KATEX.is_dir():
        sys.exit(f"{KATEX} is missing, which sets formulas; install libjs-katex")
    katex = folder / "_static" / "katex"
    katex.mkdir()
    for name in ("katex.min.js", "katex.min.css", "contrib/auto-render.min.js"):
        source = KATEX / name
        if not source.is_file():
            source = KATEX / name.replace(".min", "")
        shutil.copy(source, katex / Path(name).name)
    shutil.copytree(KATEX / "fonts", katex / "fonts")


if __name__ == "__main__":
    main()
