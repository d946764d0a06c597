# SPDX-License-Identifier: GPL-3.0-or-later
"""Pages of plekton view in a browser without a screen: their own check passes, and pictures differ from frame to frame.

Usage: python3 browser_test.py PROGRAM ROOT [--pictures FOLDER]; ends 77 where chromium is missing
"""

import argparse
import html
import json
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest
import zlib
from pathlib import Path

SKIPPED = 77
BROWSER = [
    "--headless",
    "--no-sandbox",
    "--disable-dev-shm-usage",
    "--use-gl=angle",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    "--hide-scrollbars",
    "--window-size=1000,760",
    "--host-resolver-rules=MAP * ~NOTFOUND",
]
"""Software rendering, and no name is found: a page that loads something from a network fails."""

SCENES = {
    "catch": ["catch/catch.toml", "--set", "grains.gravel.count=150", "--set", "simulation.duration=300 ms"],
    "net": ["net/net.toml", "--set", "simulation.duration=80 ms"],
}

arguments = None
folder = None


def browse(address, *options):
    """What the browser says of a page."""
    with tempfile.TemporaryDirectory() as profile:
        done = subprocess.run(
            [arguments.browser, *BROWSER, f"--user-data-dir={profile}", *options, address],
            capture_output=True, text=True, timeout=300, check=True,
        )
    return done.stdout


def pixels(file):
    """Width and rows of RGB bytes of a PNG as the browser writes it: 8 bits, not interlaced."""
    data = file.read_bytes()
    at, packed = 8, b""
    while at < len(data):
        length, kind = struct.unpack_from(">I4s", data, at)
        body = data[at + 8 : at + 8 + length]
        if kind == b"IHDR":
            width, _, depth, colour = struct.unpack_from(">IIBB", body)
            assert depth == 8 and colour in (2, 6), "an unknown kind of PNG"
            size = 3 if colour == 2 else 4
        if kind == b"IDAT":
            packed += body
        at += 12 + length
    raw, rows, before = zlib.decompress(packed), [], bytearray(width * size)
    for start in range(0, len(raw), width * size + 1):
        row, line = raw[start], bytearray(raw[start + 1 : start + 1 + width * size])
        for i in range(len(line)):
            left = line[i - size] if i >= size else 0
            up, corner = before[i], before[i - size] if i >= size else 0
            if row == 1:
                line[i] = (line[i] + left) & 255
            elif row == 2:
                line[i] = (line[i] + up) & 255
            elif row == 3:
                line[i] = (line[i] + (left + up) // 2) & 255
            elif row == 4:
                p = left + up - corner
                near = min((abs(p - left), 0, left), (abs(p - up), 1, up), (abs(p - corner), 2, corner))[2]
                line[i] = (line[i] + near) & 255
        rows.append(line)
        before = line
    return width, size, rows


def coloured_share(file):
    """The share of the scene (left and top of the page) that is clearly coloured."""
    _, size, rows = pixels(file)
    count = total = 0
    for line in rows[60:440:4]:
        for x in range(120 * size, 700 * size, 4 * size):
            rgb = line[x : x + 3]
            total += 1
            count += max(rgb) - min(rgb) > 40
    return count / total


class Pages(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        examples = Path(arguments.root) / "apps" / "examples"
        for name, (scenario, *options) in SCENES.items():
            out = folder / name
            subprocess.run(
                [arguments.program, "run", examples / scenario, "--out", out, "--quiet", *options], check=True
            )
            subprocess.run([arguments.program, "view", out], check=True, stdout=subprocess.DEVNULL)

    def page(self, name):
        return (folder / name / "view.html").as_uri()

    def picture(self, name, address):
        file = folder / f"{name}.png"
        browse(address, "--virtual-time-budget=3000", f"--screenshot={file}")
        if arguments.pictures:
            Path(arguments.pictures).mkdir(parents=True, exist_ok=True)
            shutil.copy(file, arguments.pictures)
        return file

    def test_a_page_finds_nothing_wrong_with_itself(self):
        for name in SCENES:
            said = browse(self.page(name) + "#self-check", "--virtual-time-budget=20000", "--dump-dom")
            found = re.search(r'<pre id="self-check"[^>]*>(.*?)</pre>', said, re.DOTALL)
            result = json.loads(html.unescape(found[1]) or "{}")
            self.assertTrue(result.get("ok"), result)
            frames = json.loads((folder / name / "run.json").read_text())["counts"]["frames"]
            self.assertEqual(result["frames"], frames)
            self.assertGreater(result["drawn"], 0.005)

    def test_grains_are_seen_where_they_are_shown_only(self):
        shown = coloured_share(self.picture("catch", self.page("catch") + "#frame=3&membranes=0"))
        hidden = coloured_share(self.picture("catch-hidden", self.page("catch") + "#frame=3&membranes=0&grains=0"))
        self.assertGreater(shown, 0.02)
        self.assertLess(hidden, 0.002)

    def test_times_differ(self):
        files = [self.picture(f"net-{frame}", self.page("net") + f"#frame={frame}") for frame in (0, 20, "last")]
        self.assertEqual(len({file.read_bytes() for file in files}), 3)

    def test_a_page_that_is_cut_off_says_so(self):
        whole = (folder / "net" / "view.html").read_bytes()
        # The beginning with the code of the page, and a block less.
        at = whole.index(b'<script type="text/plain" id="block-3"')
        (folder / "net" / "cut.html").write_bytes(whole[:at] + whole[whole.index(b"</script>", at) + 9 :])
        said = browse(
            (folder / "net" / "cut.html").as_uri() + "#frame=3", "--virtual-time-budget=5000", "--dump-dom"
        )
        self.assertIn("The run cannot be shown: block 3 is missing", said)


def main():
    global arguments, folder
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("root")
    parser.add_argument("--pictures", help="folder to keep the pictures in")
    arguments = parser.parse_args()
    arguments.browser = shutil.which("chromium")
    if arguments.browser is None:
        print("skipped: needs chromium (Debian: chromium)")
        return SKIPPED
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        return 0 if unittest.main(argv=sys.argv[:1], exit=False).result.wasSuccessful() else 1


if __name__ == "__main__":
    sys.exit(main())
