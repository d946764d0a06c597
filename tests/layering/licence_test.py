# SPDX-License-Identifier: GPL-3.0-or-later
"""Every header of CGAL that the run-time core meets, directly or through other headers, is under the LGPL.

Usage: python3 licence_test.py ROOT COMPILER COMPILER_ARGUMENTS...
"""

import re
import subprocess
import sys
from pathlib import Path

from check import sources
from rules import CGAL_HOMES


def core_files_with_cgal(root):
    """The files outside geometry/mesh that include CGAL."""
    for source in sources(Path(root)):
        in_core = source.path.startswith(("geometry/", "contact/", "dynamics/")) and not source.path.startswith("geometry/mesh/")
        if in_core and any(include.header.startswith("CGAL/") for include in source.includes):
            yield source.path


def headers_of(path, compiler):
    """What the compiler reads for a file, as its own list of dependencies says."""
    command = [*compiler, "-M", str(path)]
    rule = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    return rule.replace("\\\n", " ").split()[1:]


def licence_of(header):
    tag = re.search(r"SPDX-License-Identifier: *(.+)", Path(header).read_text(encoding="utf-8", errors="replace"))
    return tag[1].strip() if tag else "none"


def main():
    root, *compiler = sys.argv[1:]
    files = list(core_files_with_cgal(root))
    if sorted(files) != sorted(CGAL_HOMES):
        print(f"expected CGAL in {CGAL_HOMES} alone, found it in {files}")
        return 1
    read = {header for home in CGAL_HOMES for header in headers_of(Path(root) / home, compiler)}
    headers = sorted(header for header in read if "/CGAL/" in header)
    wrong = [header for header in headers if not licence_of(header).startswith(("LGPL-", "BSL-1.0"))]
    for header in wrong:
        print(f"{header}: {licence_of(header)}")
    print(f"{len(headers)} headers of CGAL read for {' and '.join(CGAL_HOMES)}, {len(wrong)} not under the LGPL")
    return 1 if wrong or not headers else 0


if __name__ == "__main__":
    sys.exit(main())
