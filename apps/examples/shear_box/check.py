#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Looks whether a run of shear_box.toml is sound: balance of forces, energy, the certificate, and the friction angle.

    python3 check.py RUN_FOLDER
"""
import csv
import json
import math
import sys
from pathlib import Path


def columns(path):
    with open(path, newline="") as file:
        rows = list(csv.reader(file))
    numbers = [[float(cell) for cell in row] for row in rows[1:]]
    return {name: [row[i] for row in numbers] for i, name in enumerate(rows[0])}


def mean(values):
    return sum(values) / len(values)


WINDOW, APART = 25, 5  # rows of a millisecond: a mean is over 0.75 mm of the way, and means begin that far from each other
RIM = 0.15  # largest overlap over radius, of grains on the rim of the gap, that README.md explains


def peak(over, under, first=0):
    """The largest ratio of two histories, each a mean over WINDOW rows from `first` on, and the row in the middle of it."""
    begins = range(first, len(over) - WINDOW + 1, APART)
    ratio = lambda i: sum(over[i:i + WINDOW]) / sum(under[i:i + WINDOW])
    best = max(begins, key=ratio)
    return ratio(best), best + WINDOW // 2


def new_red_rows(report):
    """Names of the red rows of the certificate but for the one of README.md."""
    red = {entry["name"]: entry["value"] for entry in report["certificate"] if entry["verdict"] != "green"}
    return [name for name, value in red.items() if name != "largest_overlap_ratio" or value > RIM]


def check(folder):
    """Figures by name: (value, least, most)."""
    report = json.loads((folder / "run.json").read_text())
    shear = report["stages"][-1]
    force = columns(folder / "reactions.csv")
    rows = [i for i, time in enumerate(force["time (s)"]) if time > shear["start_s"] + 0.01]

    def of(body, axis):
        return [force[f"{body}.force_{axis} (N)"][i] for i in rows]

    total = {axis: [sum(parts) for parts in zip(of("lower half", axis), of("upper half", axis), of("lid", axis))]
             for axis in "xyz"}
    # Through the shear plane goes what the lower half bears, but for the weight of the sand in it.
    ratio, _ = peak(of("lower half", "x"), [-z for z in of("lower half", "z")])
    lid = mean(of("lid", "z"))
    return {
        "peak friction angle (deg)": (math.degrees(math.atan(ratio)), 25.0, 45.0),
        "force of the lid (N)": (lid, 97.0, 103.0),
        "sum of shear forces over that of the lid": (mean(total["x"]) / lid, -0.02, 0.02),
        "sum of forces across over that of the lid": (mean(total["y"]) / lid, -0.02, 0.02),
        "energy closure": (abs(report["energy_closure"]), 0.0, 0.01),
        " ".join(["red rows of the certificate", *new_red_rows(report)]): (len(new_red_rows(report)), 0, 0),
    }


def main():
    failed = 0
    for name, (value, least, most) in check(Path(sys.argv[1])).items():
        is_sound = least <= value <= most
        failed += not is_sound
        print(f"{name}: {value:.4g} ({least:g} to {most:g}){'' if is_sound else '  OUT OF BOUNDS'}")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
