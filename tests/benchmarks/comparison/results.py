# SPDX-License-Identifier: GPL-3.0-or-later
"""What was measured, as flat records, and what is read off it: medians with their spread, and ratios within repetitions.

A record has the keys of a code's figures and code, scene, size, threads, repetition, rss_MiB; a run that failed has the key
failed in place of the figures.
"""

import statistics
from dataclasses import dataclass

DISTURBED_BELOW = 0.9
"""Share of its processors under which something else has run beside a run."""


@dataclass(frozen=True)
class Spread:
    """A median with the smallest and the largest, in the unit of what was measured."""

    median: float
    smallest: float
    largest: float


def spread(values):
    return Spread(statistics.median(values), min(values), max(values))


def is_clean(record):
    """Whether a run had its processors: the code's own word, or the share of the whole process where it says none."""
    share = record.get("share", 1.0)
    if record.get("cpu_ms_per_step") is not None:
        share = record["cpu_ms_per_step"] / record["ms_per_step"]
    return share >= DISTURBED_BELOW * record["threads"]


def clock_of(record, clock):
    """ms per step: "wall", or "cpu", which is the share of its whole process where a code does not tell its processor time."""
    if clock == "wall":
        return record["ms_per_step"]
    processor = record.get("cpu_ms_per_step")
    return processor if processor is not None else record["ms_per_step"] * min(1.0, record.get("share", 1.0))


class Results:
    """Records, asked by code, scene, size and threads."""

    def __init__(self, records, clock="wall"):
        self.records = records
        self.clock = clock

    def clock_for(self, threads):
        """What several threads bring shows in wall time only."""
        return self.clock if threads == 1 else "wall"

    def runs(self, code, scene, size, threads=1):
        """The runs that ended well, by repetition.

        By wall time without the disturbed ones where a clean one is left; processor time suffers less from others.
        """
        wanted = {"code": code, "scene": scene, "size": size, "threads": threads}
        runs = [run for run in self.records if "failed" not in run and all(run[key] == value for key, value in wanted.items())]
        clean = [run for run in runs if is_clean(run)] if self.clock_for(threads) == "wall" else []
        return {run["repetition"]: run for run in clean or runs}

    def sizes(self, scene, code="plekton"):
        """Sizes at which a code has run a scene, smallest first."""
        return sorted({run["size"] for run in self.records if run["scene"] == scene and run["code"] == code})

    def times(self, code, scene, size, threads=1):
        """ms per step by repetition."""
        runs = self.runs(code, scene, size, threads)
        return {repetition: clock_of(run, self.clock_for(threads)) for repetition, run in runs.items()}

    def failure(self, code, scene, size):
        """Why the last run that failed did, or none."""
        found = [
            run["failed"]
            for run in self.records
            if "failed" in run and (run["code"], run["scene"], run["size"]) == (code, scene, size)
        ]
        return found[-1].splitlines()[0] if found else None


def combine(formula, *series):
    """Spread of a formula of values by repetition: of the repetitions that all series have.

    Where they share none, that of the medians; none if a series is empty.
    """
    if not all(series):
        return None
    shared = set.intersection(*(set(values) for values in series))
    if not shared:
        return spread([formula(*(statistics.median(values.values()) for values in series))])
    return spread([formula(*(values[repetition] for values in series)) for repetition in shared])
