# SPDX-License-Identifier: GPL-3.0-or-later
"""Figures of the structure of a tree of sources, of any revision, and its arrows as a graph for graphviz.

Usage: python3 figures.py ROOT [--dot FILE]
"""

import argparse
from collections import defaultdict
from pathlib import Path

from check import sources
from rules import LIBRARIES, closure


def units_of(root):
    """The C++ files of the libraries, by path."""
    return {source.path: source for source in sources(root)
            if source.folder in LIBRARIES and source.path.endswith((".cpp", ".hpp")) and "/examples/" not in source.path}


def own_includes(source, units):
    return {include.header for include in source.includes if include.quoted and include.header in units}


def arrows_between(units, place_of):
    """How many files of a place include one of another, by pair of places."""
    arrows = defaultdict(int)
    for source in units.values():
        for place in {place_of(units[header]) for header in own_includes(source, units)} - {place_of(source)}:
            arrows[place_of(source), place] += 1
    return arrows


def in_a_circle(arrows):
    """Those of the places that can be reached from themselves."""
    after = defaultdict(set)
    for place, other in arrows:
        after[place].add(other)
    return sorted(place for place, reached in closure(after).items() if place in reached)


def headers_of_one(units):
    """Headers that one file alone includes beside the source of their name."""
    users = defaultdict(set)
    for source in units.values():
        for header in own_includes(source, units):
            if source.path.rpartition(".")[0] != header.rpartition(".")[0]:
                users[header].add(source.path)
    return sorted(header for header, by in users.items() if len(by) == 1)


def without_a_test(units, root):
    """Units with a source that have no test of their name below tests/."""
    return sorted(path for path in units if path.endswith(".cpp") and path != "apps/main.cpp"
                  and not list((Path(root) / "tests").rglob(Path(path).stem + "_test.*")))


def dot_of(units):
    """A graph of the folders, a box for each library."""
    lines = ["digraph plekton {", '  rankdir=TB; node [shape=box, fontname="sans"]; edge [color=gray40];']
    for library in LIBRARIES:
        folders = sorted({source.directory for source in units.values() if source.folder == library})
        names = " ".join(f'"{folder}" [label="{folder.removeprefix(library + "/")}"];' for folder in folders)
        lines.append(f'  subgraph "cluster_{library}" {{ label="{library}"; {names} }}')
    lines += [f'  "{place}" -> "{other}" [penwidth={1 + min(number, 20) / 5:.1f}];'
              for (place, other), number in sorted(arrows_between(units, lambda source: source.directory).items())]
    return "\n".join(lines + ["}", ""])


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("root", type=Path)
    parser.add_argument("--dot", type=Path, help="file for the graph of folders")
    given = parser.parse_args()
    units = units_of(given.root)
    for library in LIBRARIES:
        of = [source for source in units.values() if source.folder == library]
        print(f"{library}: {len(of)} files, {sum(source.text.count(chr(10)) for source in of)} lines")
    folders = arrows_between(units, lambda source: source.directory)
    headers = {path: source for path, source in units.items() if path.endswith(".hpp")}
    of_headers = arrows_between(headers, lambda source: source.path)
    with_sources = arrows_between(units, lambda source: source.path.rpartition(".")[0])
    sourced = [path for path in units if path.endswith(".cpp")]
    print(f"arrows: {len(arrows_between(units, lambda source: source.folder))} between libraries, {len(folders)} between folders")
    print(f"in a circle: {len(in_a_circle(folders))} folders, {len(in_a_circle(of_headers))} headers, "
          f"{len(in_a_circle(with_sources))} units if a header and its source count as one")
    print(f"headers that one file includes: {len(headers_of_one(units))} of {len(headers)}")
    print(f"units without a test of their name: {len(without_a_test(units, given.root))} of {len(sourced)}")
    if given.dot:
        given.dot.write_text(dot_of(units), encoding="utf-8")


if __name__ == "__main__":
    main()
