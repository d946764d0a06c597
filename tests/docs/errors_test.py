# SPDX-License-Identifier: GPL-3.0-or-later
"""What docs/howto/errors.md quotes in its headings is said by the program: the quoted parts stand in texts of the sources. And of each folder of
sources that speaks to users the page quotes something, so that a new part of the program is not without an entry.

Usage: python3 errors_test.py ROOT
"""

import re
import sys
from pathlib import Path

LIBRARIES = ("geometry", "contact", "dynamics", "apps")
OTHERS = ("No space left on device",)
"""Said by the system."""

SPEAKING = ("geometry/mesh/io", "geometry/mesh/repair", "dynamics/checkpoint", "dynamics/distributed", "dynamics/ondem", "dynamics/output", "apps/*")
"""Folders whose messages reach users as they are; those of others are about what a program in C++ has passed."""

MESSAGE = re.compile(r"throw (?!std::logic_error)\w+(?:::\w+)*\(|\bcomplain\(|\bfail\(")

ADJACENT = re.compile(r'"\s*\n\s*(?:R?")')
"""Where a text goes on in the next line."""


def text_of(paths):
    """Sources in one, with texts in one piece and quotes as they are printed."""
    return ADJACENT.sub("", "\n".join(path.read_text(encoding="utf-8") for path in paths)).replace('\\"', '"')


def texts_of(root):
    """All that can be said."""
    return text_of(path for library in LIBRARIES for path in sorted(Path(root, library).rglob("*.?pp"))) + "\n".join(OTHERS)


def folders_without_entry(root, fragments):
    """Those that have messages for users, none of which the page quotes with three words or more."""
    fragments = [fragment for fragment in fragments if len(fragment.split()) > 2]
    for folder in (folder for pattern in SPEAKING for folder in sorted(root.glob(pattern)) if folder.is_dir()):
        text = text_of(sorted(folder.glob("*.?pp")))
        if MESSAGE.search(text) and not any(fragment in text for fragment in fragments):
            yield folder.relative_to(root)


def fragments_of(quote):
    """The parts of a quoted message that are the same for every case."""
    return [part.strip(' ":') for part in re.split(r'\.\.\.|"[^"]*"', quote) if len(part.strip(' ":')) > 3]


def main():
    root = Path(sys.argv[1])
    texts = texts_of(root)
    headings = [line for line in (root / "docs/howto/errors.md").read_text(encoding="utf-8").splitlines() if line.startswith("## ")]
    failures = 0
    fragments = []
    for heading in headings:
        for quote in re.findall(r"`([^`]+)`", heading):
            for fragment in fragments_of(quote):
                fragments.append(fragment)
                if fragment not in texts:
                    failures += 1
                    print(f"docs/howto/errors.md quotes {fragment!r}, which no source says ({heading})")
    for folder in folders_without_entry(root, fragments):
        failures += 1
        print(f"docs/howto/errors.md quotes no message of {folder}")
    print(f"{len(headings)} families of errors, {len(fragments)} quoted parts, {failures} failures")
    return 1 if failures or len(fragments) < 20 else 0


if __name__ == "__main__":
    sys.exit(main())
