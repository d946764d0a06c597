# SPDX-License-Identifier: GPL-3.0-or-later
"""What docs/howto/errors.md quotes in its headings is said by the program: the quoted parts stand in texts of the sources.

Usage: python3 errors_test.py ROOT
"""

import re
import sys
from pathlib import Path

LIBRARIES = ("geometry", "contact", "dynamics", "apps")
OTHERS = ("The following argument was not expected", "No space left on device")
"""Said by CLI11 and by the system."""

ADJACENT = re.compile(r'"\s*\n\s*(?:R?")')
"""Where a text goes on in the next line."""


def texts_of(root):
    """All sources in one, with texts in one piece and quotes as they are printed."""
    sources = [path.read_text(encoding="utf-8") for library in LIBRARIES for path in sorted(Path(root, library).rglob("*.?pp"))]
    return ADJACENT.sub("", "\n".join(sources)).replace('\\"', '"') + "\n".join(OTHERS)


def fragments_of(quote):
    """The parts of a quoted message that are the same for every case."""
    return [part.strip(' ":') for part in re.split(r'\.\.\.|"[^"]*"', quote) if len(part.strip(' ":')) > 3]


def main():
    root = Path(sys.argv[1])
    texts = texts_of(root)
    headings = [line for line in (root / "docs/howto/errors.md").read_text(encoding="utf-8").splitlines() if line.startswith("## ")]
    failures = count = 0
    for heading in headings:
        for quote in re.findall(r"`([^`]+)`", heading):
            for fragment in fragments_of(quote):
                count += 1
                if fragment not in texts:
                    failures += 1
                    print(f"docs/howto/errors.md quotes {fragment!r}, which no source says ({heading})")
    print(f"{len(headings)} families of errors, {count} quoted parts, {failures} not in the sources")
    return 1 if failures or count < 20 else 0


if __name__ == "__main__":
    sys.exit(main())
