# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads the folder of a run, and compares figures with bounds: what the check.py of the examples have in common."""
import csv
import json
import re
import struct
import sys
import zlib
from pathlib import Path


def columns(path):
    """A history as {head without unit: values}."""
    with open(path, newline="") as file:
        rows = list(csv.reader(file))
    return {head.split(" (")[0]: [float(row[i]) for row in rows[1:]] for i, head in enumerate(rows[0])}


def mean(values):
    return sum(values) / len(values)


def write(path, heads, rows, digits=5):
    """A table of numbers, for gnuplot."""
    with open(path, "w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(heads)
        writer.writerows([f"{value:.{digits}g}" for value in row] for row in rows)


def report_of(run):
    return json.loads((run / "run.json").read_text())


def red_rows(report, explained={}):
    """Names of the rows of the certificate that are not green, but for those of {name: largest value that has a reason}."""
    red = [entry for entry in report["certificate"] if entry["verdict"] != "green"]
    return [entry["name"] for entry in red if entry["name"] not in explained or entry["value"] > explained[entry["name"]]]


class Frame:
    """Arrays of a frame (VTK XML, raw blocks of zlib)."""

    CODES = {b"Float32": "f", b"Float64": "d", b"Int32": "i", b"Int64": "q"}

    def __init__(self, path):
        self.data = path.read_bytes()
        self.begin = self.data.index(b"_", self.data.index(b'<AppendedData encoding="raw"')) + 1

    def array(self, section, name):
        """Numbers of an array of a section (PointData, CellData, Points, Lines, Polys), one after the other."""
        pattern = rf'<{section}>.*?type="(\w+)" Name="{name}"[^>]*offset="(\d+)"'.encode()
        found = re.search(pattern, self.data, re.S)
        begin = self.begin + int(found.group(2))
        blocks = struct.unpack_from("<Q", self.data, begin)[0]
        sizes = struct.unpack_from(f"<{blocks}Q", self.data, begin + 24)
        begin, raw = begin + 24 + 8 * blocks, b""
        for size in sizes:
            raw += zlib.decompress(self.data[begin : begin + size])
            begin += size
        code = self.CODES[found.group(1)]
        return struct.unpack(f"<{len(raw) // struct.calcsize(code)}{code}", raw)

    def vectors(self, section, name):
        numbers = self.array(section, name)
        return [numbers[i : i + 3] for i in range(0, len(numbers), 3)]

    def points(self):
        return self.vectors("Points", "Points")


def frames(run, series):
    """(time, file) of each frame of a series (membranes, grains, contacts, ...), in the order of time."""
    text = (run / f"{series}.pvd").read_text()
    return [(float(t), run / file) for t, file in re.findall(r'timestep="([^"]+)"[^>]*file="([^"]+)"', text)]


def frame_before(run, series, moment):
    """(time, file) of the last frame up to a moment."""
    return max(entry for entry in frames(run, series) if entry[0] <= moment + 1e-9)


class Bounds:
    """Prints figures beside their bounds, and remembers whether all of them hold."""

    def __init__(self, width=52):
        self.hold = True
        self.width = width

    def expect(self, what, value, low, high, source):
        holds = low <= value <= high
        self.hold &= holds
        print(f"  {what:<{self.width}} {value:10.4g}  {low:.4g} to {high:.4g} ({source}){'' if holds else '  OUT OF BOUNDS'}")

    def expect_energy(self, report):
        self.expect("energy closure", report["energy_closure"], 0, 0.01, "energy is kept")

    def expect_sound(self, report):
        """Energy is kept, and the certificate is green."""
        self.expect_energy(report)
        red = red_rows(report)
        self.expect("red rows of the certificate", len(red), 0, 0, ", ".join(red) or "all green")


def runs_of_arguments(usage):
    """The folders that the command line names, at least one."""
    if len(sys.argv) < 2:
        sys.exit(usage)
    return [Path(run) for run in sys.argv[1:]]


def check_runs(usage, check, bounds):
    """check(run, bounds) of each folder that the command line names; ends the program, with 1 where something is out of its bounds."""
    for run in runs_of_arguments(usage):
        print(run)
        check(run, bounds)
    sys.exit(0 if bounds.hold else 1)
