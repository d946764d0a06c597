# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks every source file below ROOT against the rules of the house; prints the violations, ends 1 if there are any.

Usage: python3 check.py ROOT
"""

import os
import sys
from pathlib import Path

from rules import RULES, Source, forget_tree

SUFFIXES = (".cpp", ".hpp", ".c", ".h", ".py", ".sh", ".cmake", ".cmake.in", "CMakeLists.txt", ".ci/run")
NOT_OURS = ("build", "out", ".git")
"""Folders at the root of the tree that hold no sources."""


def sources(root):
    """The source files below a folder, sorted by path."""
    for folder, names, files in os.walk(root):
        if Path(folder) == Path(root):
            names[:] = [name for name in names if name not in NOT_OURS and not name.startswith("build-")]
        names.sort()
        for name in sorted(files):
            path = (Path(folder) / name).relative_to(root).as_posix()
            if path.endswith(SUFFIXES):
                yield Source(path, (Path(root) / path).read_text(encoding="utf-8"))


def violations(root):
    """All violations in a tree, and the number of files that were read."""
    forget_tree()
    found, count = [], 0
    for source in sources(root):
        count += 1
        for rule in RULES:
            found.extend(rule(source, root))
    return found, count


def main():
    root = Path(sys.argv[1])
    found, count = violations(root)
    for violation in found:
        print(violation)
    print(f"{count} files read, {len(found)} violations")
    if count == 0:
        print(f"{root}: no source file; name the root of the tree")
    return 1 if found or count == 0 else 0


if __name__ == "__main__":
    sys.exit(main())
