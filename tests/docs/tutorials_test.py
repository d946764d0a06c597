# SPDX-License-Identifier: GPL-3.0-or-later
"""Types what the tutorials say, each in an empty folder, and compares what is printed with what the pages show.

Of a page, blocks ```{code-block} with a :caption: are saved under that name, and of blocks ```console the lines after "$ " are typed in
bash. The lines below a command are what it prints, in this order; "..." stands for anything, also for whole lines.

Usage: python3 tutorials_test.py PROGRAM FOLDER_OF_PAGES [--page NAME]... [--build BUILD]
Pages that ask for find_package are left out without a build to install from.
"""

import argparse
import os
import re
import subprocess
import sys
import tempfile
import time
from pathlib import Path

BLOCK = re.compile(r"^```(?P<kind>console|\{code-block\}[^\n]*)\n(?P<text>.*?)^```$", re.MULTILINE | re.DOTALL)
CAPTION = re.compile(r"\A:caption: (?P<name>\S+)\n\n?")
LONGEST = 600  # seconds of a command, on a machine that does much else


def steps_of(page):
    """What a page tells to do, in order: ("save", name, text) and ("type", command, lines that it prints)."""
    for block in BLOCK.finditer(page):
        caption = CAPTION.match(block["text"])
        if caption:
            yield "save", caption["name"], block["text"][caption.end() :]
        if block["kind"] != "console":
            continue
        command, shown = None, []
        for line in block["text"].splitlines():
            if line.startswith("$ "):
                if command is not None:
                    yield "type", command, shown
                command, shown = line[2:], []
            else:
                shown.append(line)
        if command is not None:
            yield "type", command, shown


def pattern_of(shown):
    """What a command prints, as the page shows it, as a regular expression."""
    parts = []
    for line in shown:
        if line == "...":
            parts.append(r"(?:.*\n)*?")
        else:
            parts.append(".*".join(re.escape(part) for part in line.split("...")) + r"\n")
    return re.compile("".join(parts) + (r"\Z" if not shown or shown[-1] != "..." else ""))


def type_page(page, folder, environment):
    """What is not as the page says."""
    for what, name, text in steps_of(page):
        if what == "save":
            (folder / name).write_text(text, encoding="utf-8")
            continue
        done = subprocess.run(
            ["bash", "-c", name], cwd=folder, env=environment, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=LONGEST
        )
        if done.returncode != 0:
            return f"$ {name}\nends with {done.returncode}:\n{done.stdout}"
        if not pattern_of(text).match(done.stdout):
            shown = "\n".join(text)
            return f"$ {name}\nprints\n{done.stdout}\nand the page shows\n{shown}"
    return ""


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program", type=Path)
    parser.add_argument("pages", type=Path)
    parser.add_argument("--page", action="append")
    parser.add_argument("--build", type=Path)
    arguments = parser.parse_args()
    environment = os.environ | {"PATH": f"{arguments.program.resolve().parent}:{os.environ['PATH']}"}
    installed = tempfile.TemporaryDirectory()
    if arguments.build:
        subprocess.run(["cmake", "--install", arguments.build, "--prefix", installed.name], check=True, stdout=subprocess.DEVNULL)
        environment["CMAKE_PREFIX_PATH"] = installed.name
    failures = typed = 0
    for path in sorted(arguments.pages.glob("[0-9]*.md")):
        if arguments.page and path.stem not in arguments.page:
            continue
        page = path.read_text(encoding="utf-8")
        if "find_package" in page and not arguments.build:
            print(f"{path.stem}: left out without --build")
            continue
        began = time.monotonic()
        with tempfile.TemporaryDirectory() as folder:
            failure = type_page(page, Path(folder), environment)
        typed += 1
        print(f"{path.stem}: {'as the page says' if not failure else failure} ({time.monotonic() - began:.1f} s)", flush=True)
        failures += bool(failure)
    if typed == 0:
        print(f"{arguments.pages}: no page to type")
    return 1 if failures or typed == 0 else 0


if __name__ == "__main__":
    sys.exit(main())
