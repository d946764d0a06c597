# SPDX-License-Identifier: GPL-3.0-or-later
"""What the codes print, read into one form: a dictionary with the keys of plekton-bench's line.

ms_per_step, cpu_ms_per_step (or none), contacts, N, steps, state, and what else a code tells.
"""

import json
import math
import os
import re


class Unreadable(ValueError):
    """The output is not that of a finished run."""


def checked(figures, steps):
    """The figures if they can be true, Unreadable with the reason if not."""
    if figures.get("steps") != steps:
        raise Unreadable(f"{figures.get('steps')} steps were timed, {steps} were asked for")
    duration = figures.get("ms_per_step")
    if not isinstance(duration, (int, float)) or not math.isfinite(duration) or duration <= 0:
        raise Unreadable(f"a step of {duration!r} ms")
    energy = (figures.get("state") or {}).get("kinetic_energy_J", 0.0)
    if not isinstance(energy, (int, float)) or not math.isfinite(energy):
        raise Unreadable(f"a kinetic energy of {energy!r} J: the scene blew up")
    return figures


def read_json(text, steps, prefix=""):
    """The last line that holds a JSON object after a prefix: plekton-bench without one, the scripts for YADE after "RESULT "."""
    lines = [line[len(prefix) :] for line in text.splitlines() if line.startswith(prefix + "{")]
    if not lines:
        raise Unreadable("no line with a result")
    try:
        figures = json.loads(lines[-1])
    except json.JSONDecodeError as error:
        raise Unreadable(f"the result is no JSON: {error}") from error
    return checked(figures, steps)


def read_searches(text):
    """All lines of plekton-bench-search."""
    found = [json.loads(line) for line in text.splitlines() if line.startswith("{")]
    if not found:
        raise Unreadable("no line with a result")
    return [checked(figures, 1) for figures in found]


LOOP = re.compile(r"Loop time of (\S+) on (\d+) procs for (\d+) steps with (\d+) atoms")
SHARE = re.compile(r"([\d.]+)% CPU use")
CLOCK = re.compile(r"\(\S+\) [A-Z](?: -?\d+){10} (\d+) (\d+) ")
"""A line of /proc/PID/stat; its 14th and 15th words are processor time of the program and of the system for it."""
BUILDS = re.compile(r"Neighbor list builds = (\d+)")


def read_lammps(text, steps):
    """The last run of LAMMPS or LIGGGHTS."""
    loops = LOOP.findall(text)
    if len(loops) < 2:
        raise Unreadable(f"{len(loops)} of the two runs, warm-up and timed, have ended")
    seconds, ranks, timed, atoms = loops[-1]
    try:
        duration = 1e3 * float(seconds) / int(timed)
    except (ValueError, ZeroDivisionError) as error:
        raise Unreadable(f"a loop of {seconds} s and {timed} steps") from error
    builds = BUILDS.findall(text)
    energy, height, contacts = last_row(text)
    figures = {
        "N": int(atoms),
        "steps": int(timed),
        "ms_per_step": duration,
        "cpu_ms_per_step": processor_time(text, duration, int(timed), int(ranks)),
        "contacts": round(contacts / 2) if math.isfinite(contacts) else None,
        "list_rebuilds": int(builds[-1]) if builds else None,
        "state": {"kinetic_energy_J": energy, "mean_height_m": height},
    }
    return checked(figures, steps)


def processor_time(text, duration, steps, ranks):
    """ms a step of all ranks: of the share that LAMMPS prints, or of the clocks of the first rank before and after the steps
    that the script for LIGGGHTS prints (to a hundredth of a second); none without either."""
    shares, clocks = SHARE.findall(text), CLOCK.findall(text)
    if shares:
        return duration * ranks * float(shares[-1]) / 100
    if len(clocks) < 2:
        return None
    before, after = (sum(int(ticks) for ticks in clock) for clock in clocks[-2:])
    return 1e3 * ranks * (after - before) / os.sysconf("SC_CLK_TCK") / steps


def last_row(text):
    """The columns after the step in the row above the last loop time."""
    lines = text.splitlines()
    end = max(number for number, line in enumerate(lines) if LOOP.search(line))
    words = lines[end - 1].split()
    try:
        return [float(word) for word in words[1:4]] if len(words) == 4 else _no_row(lines[end - 1])
    except ValueError:
        return _no_row(lines[end - 1])


def _no_row(line):
    raise Unreadable(f"four columns are expected before the loop time, not '{line}'")
