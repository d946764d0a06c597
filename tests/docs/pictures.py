# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures of the tutorials. Of a page NAME.md, ![...](NAME/FILE) shows the FILE that the commands of the page write in their folder, and
![...](NAME/FILE "PAGE.html#SETTINGS") what a browser shows at that address in their folder.

Beside the page, in the folder NAME, is a copy of each, so that the site is built without running anything.
"""

import re
import struct
import sys
import xml.etree.ElementTree as ElementTree
import zlib
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
import browser

SHOWN = re.compile(r"!\[[^\]]*\]\((?P<link>[^()\s]+)(?: \"(?P<address>[^\"]*)\")?\)")
UNIT = re.compile(r"\S \([^()]+\)")
LARGEST = {".svg": 60_000, ".png": 150_000}
"""Bytes of a copy that is kept, by the kind of picture."""
SIZE = "720,512"
"""Pixels of a picture that a browser takes."""
SHADES = 85
"""Of red, green and blue in it, beside black."""
COLOURED = 0.003
"""Least share of a scene that is clearly coloured: the wires of a net are thin, the ground behind it is grey."""


def pictures_of(page, name):
    """What a page shows, in order: the file and the address of each; and what of it is not in the folder of the page."""
    shown, elsewhere = [], []
    for picture in SHOWN.finditer(page):
        folder, _, file = picture["link"].rpartition("/")
        if folder == name:
            shown.append((file, picture["address"]))
        else:
            elsewhere.append(f"{picture['link']} is none that the commands of the page make; one that they make is {name}/FILE")
    return shown, elsewhere


def take(program, address, folder, file):
    """Takes a picture of a page with a scene, with fewer shades of each colour, which keeps it small."""
    raw = file.with_suffix(".raw.png")
    page, _, settings = address.partition("#")
    browser.browse(program, (folder / page).as_uri() + "#" + settings, "--virtual-time-budget=3000", f"--screenshot={raw}", size=SIZE)
    width, size, rows = browser.pixels(raw)
    shades = bytes(round(round(shade * SHADES / 255) * 255 / SHADES) for shade in range(256))
    write_png(file, width, [bytes(row).translate(shades) for row in rows], size)
    raw.unlink()


def write_png(file, width, rows, size=3):
    """Writes rows of pixels of three or four bytes."""

    def chunk(kind, body):
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))

    header = struct.pack(">IIBBBBB", width, len(rows), 8, {3: 2, 4: 6}[size], 0, 0, 0)
    packed = zlib.compress(b"".join(b"\0" + row for row in rows), 9)
    file.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", packed) + chunk(b"IEND", b""))


def texts_of(file):
    """What stands in an SVG beside numbers."""
    texts = ["".join(element.itertext()).strip() for element in ElementTree.parse(file).iter("{http://www.w3.org/2000/svg}text")]
    return [text for text in texts if re.search(r"[^\d\s.e+-]", text)]


def _is_curve(path):
    """Whether a path goes up or down over many points."""
    heights = re.findall(r"[ML]?[-\d.]+,([-\d.]+)", path.get("d", ""))
    return path.get("fill", "none") == "none" and len(heights) >= 20 and len(set(heights)) >= 10


def _fault_of_plot(file):
    if sum(UNIT.search(text) is not None for text in texts_of(file)) < 2:
        return "has no two axes with a unit"
    if not any(map(_is_curve, ElementTree.parse(file).iter("{http://www.w3.org/2000/svg}path"))):
        return "has no curve"
    return ""


def _fault_of_scene(file):
    width, size, rows = browser.pixels(file)
    scene = [row[x : x + 3] for row in rows[60 : len(rows) * 6 // 10 : 2] for x in range(width * size // 3, (width - 100) * size, size)]
    coloured = sum(max(rgb) - min(rgb) > 40 for rgb in scene) / len(scene)
    return "" if coloured >= COLOURED else f"shows nothing: {coloured:.2%} of the scene is coloured"


def fault_of(file):
    """What is wrong with a picture; nothing if there is something to see."""
    if not file.is_file():
        return "is not there"
    kinds = {".svg": _fault_of_plot, ".png": _fault_of_scene}
    if file.suffix not in kinds:
        return "is neither .svg nor .png"
    return kinds[file.suffix](file)


def fault_of_copy(copy, made):
    """What is wrong with the copy that is kept of a picture that was made."""
    if fault := fault_of(copy):
        return fault
    if copy.stat().st_size > LARGEST[copy.suffix]:
        return f"has {copy.stat().st_size} bytes, more than {LARGEST[copy.suffix]}"
    if copy.suffix == ".svg" and texts_of(copy) != texts_of(made):
        return f"shows {texts_of(copy)}, and what the commands make {texts_of(made)}"
    return ""
