# SPDX-License-Identifier: GPL-3.0-or-later
"""Types what the tutorials say, each in an empty folder, and compares what is printed with what the pages show.

Of a page, blocks ```{code-block} with a :caption: are saved under that name, and of blocks ```console the lines after "$ " are typed in
bash. The lines below a command are what it prints, in this order; "..." stands for anything, also for whole lines. Pictures that a page shows
are those that its commands make (pictures.py), and the copies that are kept of them show the same.

Usage: python3 tutorials_test.py PROGRAM FOLDER_OF_PAGES [--page NAME]... [--build BUILD] [--pictures FOLDER]
Pages that ask for find_package are left out without a build to install from; plots without gnuplot, scenes without chromium.
With --pictures the pictures are kept, as FOLDER/PAGE/FILE: python3 tests/docs/tutorials_test.py build/release/apps/plekton docs/tutorials
--build build/release --pictures docs/tutorials makes the copies anew.
"""

import argparse
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack
from pathlib import Path

import pictures

BLOCK = re.compile(r"^```(?P<kind>console|\{code-block\}[^\n]*)\n(?P<text>.*?)^```$", re.MULTILINE | re.DOTALL)
CAPTION = re.compile(r"\A:caption: (?P<name>\S+)\n\n?")
LONGEST = 600  # seconds of a command, on a machine that does much else
PLOTS = re.compile(r"plekton plot |gnuplot ")


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
        if PLOTS.match(name) and shutil.which("gnuplot") is None:
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


class Pictures:
    """Takes and looks through the pictures of pages, a page while the next one is typed."""

    def __init__(self, pages, kept):
        self.pages, self.kept = pages, kept
        self.browser = shutil.which("chromium")
        self.is_possible = {True: self.browser is not None, False: shutil.which("gnuplot") is not None}
        for is_scene, name in ((True, "scenes: needs chromium"), (False, "plots: needs gnuplot")):
            if not self.is_possible[is_scene]:
                print(f"left out {name}")

    def faults(self, page, name, folder):
        """What is wrong with the pictures of a page whose commands were typed in a folder."""
        shown, faults = pictures.pictures_of(page, name)
        for file, address in shown:
            if not self.is_possible[address is not None]:
                continue
            if self.kept:
                (self.kept / name / file).unlink(missing_ok=True)
            if address is not None and not (folder / address.partition("#")[0]).is_file():
                faults.append(f"{name}/{file}: the commands of the page write no {address.partition('#')[0]}")
                continue
            if address is not None:
                pictures.take(self.browser, address, folder, folder / file)
            if fault := pictures.fault_of(folder / file):
                faults.append(f"{name}/{file}, as the commands of the page make it: {fault}")
                continue
            if self.kept:
                (self.kept / name).mkdir(parents=True, exist_ok=True)
                shutil.copy(folder / file, self.kept / name)
            if fault := pictures.fault_of_copy(self.pages / name / file, folder / file):
                faults.append(f"{self.pages / name / file} {fault}; --pictures {self.pages} makes it anew")
        unused = {file.name for file in (self.pages / name).glob("*")} - {file for file, _ in shown}
        return faults + [f"{self.pages / name / file} is shown by no page" for file in sorted(unused)]


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program", type=Path)
    parser.add_argument("pages", type=Path)
    parser.add_argument("--page", action="append")
    parser.add_argument("--build", type=Path)
    parser.add_argument("--pictures", type=Path)
    arguments = parser.parse_args()
    environment = os.environ | {"PATH": f"{arguments.program.resolve().parent}:{os.environ['PATH']}"}
    failures, typed = [], 0
    seen = Pictures(arguments.pages, arguments.pictures)
    with ExitStack() as stack, ThreadPoolExecutor(max_workers=1) as looking:
        if arguments.build:
            installed = stack.enter_context(tempfile.TemporaryDirectory())
            subprocess.run(["cmake", "--install", arguments.build, "--prefix", installed], check=True, stdout=subprocess.DEVNULL)
            environment["CMAKE_PREFIX_PATH"] = installed
        looked_through = []
        for path in sorted(arguments.pages.glob("[0-9]*.md")):
            if arguments.page and path.stem not in arguments.page:
                continue
            page = path.read_text(encoding="utf-8")
            if "find_package" in page and not arguments.build:
                print(f"{path.stem}: left out without --build")
                continue
            began = time.monotonic()
            folder = Path(stack.enter_context(tempfile.TemporaryDirectory()))
            failure = type_page(page, folder, environment)
            typed += 1
            print(f"{path.stem}: {'as the page says' if not failure else failure} ({time.monotonic() - began:.1f} s)", flush=True)
            if failure:
                failures.append(failure)
            else:
                looked_through.append(looking.submit(seen.faults, page, path.stem, folder))
        for faults in looked_through:
            for fault in faults.result():
                print(fault)
                failures.append(fault)
    if typed == 0:
        print(f"{arguments.pages}: no page to type")
    return 1 if failures or typed == 0 else 0


if __name__ == "__main__":
    sys.exit(main())
