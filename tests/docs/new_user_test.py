# SPDX-License-Identifier: GPL-3.0-or-later
"""Walks the path of a new user: installs Plekton into an empty folder as docs/start.md says, then types what the pages say, from the first run
to reading its result, a mesh and a contact law of one's own. Of this build nothing but what it installs is found.

Usage: python3 new_user_test.py BUILD ROOT
"""

import os
import re
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from tutorials_test import type_page

WALKS = (("start.md", "howto/results.md"), ("tutorials/03-own-mesh.md",), ("tutorials/10-own-law.md",))
"""Pages whose commands are typed in one folder, one after the other."""

INSTALL = "cmake --install build/release --prefix /usr/local"
"""What start.md says; here it is another build, into another folder."""

FIRST_RUN = re.compile(r"^## First run\n```sh\n(?P<text>.*?)^```$", re.MULTILINE | re.DOTALL)


def first_run_of(page):
    """The commands of start.md below "First run" as a page that shows nothing of what they print."""
    commands = [line.split("#")[0].strip() for line in FIRST_RUN.search(page)["text"].splitlines()]
    return "".join(f"```console\n$ {command}\n...\n```\n" for command in commands)


def environment_of(prefix):
    """What is found of Plekton is what was installed."""
    kept = {name: value for name, value in os.environ.items() if not name.startswith(("PLEKTON", "PYTHON", "CMAKE"))}
    return kept | {
        "PATH": f"{prefix}/bin:/usr/bin:/bin",
        "CMAKE_PREFIX_PATH": str(prefix),
        "PYTHONPATH": f"{prefix}/lib/python3/dist-packages",
    }


def main():
    build, root = Path(sys.argv[1]), Path(sys.argv[2])
    start = (root / "docs/start.md").read_text(encoding="utf-8")
    if INSTALL not in start:
        print(f"docs/start.md does not say {INSTALL!r} any more")
        return 1
    failures = 0
    with tempfile.TemporaryDirectory() as prefix:
        words = INSTALL.replace("build/release", str(build)).replace("/usr/local", prefix).split()
        subprocess.run(words, check=True, stdout=subprocess.DEVNULL)
        for walk in WALKS:
            with tempfile.TemporaryDirectory() as folder:
                for name in walk:
                    began = time.monotonic()
                    page = (root / "docs" / name).read_text(encoding="utf-8")
                    failure = type_page(first_run_of(page) if name == "start.md" else page, Path(folder), environment_of(prefix))
                    print(f"{name}: {failure or 'as the page says'} ({time.monotonic() - began:.1f} s)", flush=True)
                    failures += bool(failure)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
