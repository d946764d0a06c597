#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Looks whether a run of shear_box.toml is sound: balance of forces, energy, the certificate, and the friction angle.

    python3 check.py RUN [RUN ...]
"""
import math
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from results import Bounds, check_runs, columns, mean, red_rows, report_of  # noqa: E402


WINDOW, APART = 25, 5  # rows of a millisecond: a mean is over 0.75 mm of the way, and means begin that far from each other
RIM = 0.15  # largest overlap over radius, of grains on the rim of the gap, that README.md explains


def peak(over, under, first=0):
    """The largest ratio of two histories, each a mean over WINDOW rows from `first` on, and the row in the middle of it."""
    begins = range(first, len(over) - WINDOW + 1, APART)
    ratio = lambda i: sum(over[i:i + WINDOW]) / sum(under[i:i + WINDOW])
    best = max(begins, key=ratio)
    return ratio(best), best + WINDOW // 2


def check(run, bounds):
    report = report_of(run)
    shear = report["stages"][-1]
    force = columns(run / "reactions.csv")
    rows = [i for i, time in enumerate(force["time"]) if time > shear["start_s"] + 0.01]

    def of(body, axis):
        return [force[f"{body}.force_{axis}"][i] for i in rows]

    total = {axis: [sum(parts) for parts in zip(of("lower half", axis), of("upper half", axis), of("lid", axis))]
             for axis in "xyz"}
    # Through the shear plane goes what the lower half bears, but for the weight of the sand in it.
    ratio, _ = peak(of("lower half", "x"), [-z for z in of("lower half", "z")])
    lid = mean(of("lid", "z"))
    bounds.expect("peak friction angle (deg)", math.degrees(math.atan(ratio)), 25, 45, "of sand")
    bounds.expect("force of the lid (N)", lid, 97, 103, "what its servo wants")
    bounds.expect("sum of shear forces over that of the lid", mean(total["x"]) / lid, -0.02, 0.02, "balance")
    bounds.expect("sum of forces across over that of the lid", mean(total["y"]) / lid, -0.02, 0.02, "balance")
    bounds.expect_energy(report)
    red = red_rows(report, {"largest_overlap_ratio": RIM})
    bounds.expect("red rows of the certificate", len(red), 0, 0, ", ".join(red) or f"but for overlaps up to {RIM:.0%}, see README.md")


if __name__ == "__main__":
    check_runs(__doc__, check, Bounds())
