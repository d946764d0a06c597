# SPDX-License-Identifier: GPL-3.0-or-later
"""A browser without a screen, and the pixels of the pictures that it takes."""

import struct
import subprocess
import tempfile
import zlib

OPTIONS = [
    "--headless",
    "--no-sandbox",
    "--disable-dev-shm-usage",
    "--use-gl=angle",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    "--hide-scrollbars",
    "--host-resolver-rules=MAP * ~NOTFOUND, EXCLUDE 127.0.0.1",
]
"""Software rendering, and no name is found: a page that loads something from a network fails."""


def command(browser, profile, size="1000,760"):
    """How a browser is started that keeps what it has to keep in a folder."""
    return [browser, *OPTIONS, f"--window-size={size}", f"--user-data-dir={profile}"]


SECONDS = (60, 120, 240)
"""For how long a browser may be at one page. Now and then one hangs as it starts, and never the next."""


def browse(browser, address, *options, size="1000,760"):
    """What the browser says of a page."""
    for seconds in SECONDS:
        with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as profile:
            line = [*command(browser, profile, size), *options, address]
            try:
                return subprocess.run(line, capture_output=True, text=True, timeout=seconds, check=True).stdout
            except subprocess.TimeoutExpired:
                if seconds == SECONDS[-1]:
                    raise


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
        for i in range(len(line) if row else 0):
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
