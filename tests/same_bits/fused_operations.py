# SPDX-License-Identifier: GPL-3.0-or-later
"""Looks for fused multiply-add in compiled libraries and programs: it rounds once where others round twice, so that other processors
have other bits.

Usage: python3 fused_operations.py FILE...

Ends 1 if there is any, 77 (skipped) without objdump.
"""

import re
import shutil
import subprocess
import sys

FUSED = re.compile(r"\t(vfn?m(?:add|sub)\w*|fn?m(?:add|sub)|fml[as])\b")
"""Of x86-64, and of arm64."""


def fused_in(path):
    """Each fused instruction in a file, and how often it is there."""
    counts = {}
    with subprocess.Popen(["objdump", "-d", "--no-show-raw-insn", path], stdout=subprocess.PIPE, text=True) as dump:
        for line in dump.stdout:
            match = FUSED.search(line)
            if match:
                counts[match[1]] = counts.get(match[1], 0) + 1
    if dump.returncode != 0:
        raise SystemExit(f"{path}: objdump cannot read it")
    return counts


def main():
    if not shutil.which("objdump"):
        print("no objdump (Debian: binutils)")
        return 77
    found = {path: fused_in(path) for path in sys.argv[1:]}
    for path, counts in found.items():
        print(f"{path}: {counts or 'none'}")
    return 1 if any(found.values()) else 0


if __name__ == "__main__":
    sys.exit(main())
