# SPDX-License-Identifier: GPL-3.0-or-later
"""The codes: where they are, how each is told to run a case, how its output is read."""

import os
import shutil
import sys
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Callable

from comparison import outputs
from comparison.running import run

PEERS = Path(__file__).resolve().parent.parent / "peers"
BEDS_ONLY = ("s1", "s1flow")
ON_RANKS = "plekton-ranks"
"""Plekton by mpirun."""


@dataclass(frozen=True)
class Job:
    """A case for one code: its bed's file (or none) and the threads or ranks."""

    case: object
    bed: Path | None
    threads: int


@dataclass(frozen=True)
class Code:
    """A code that is on this machine.

    scenes   Those that it can run; none: all.
    command  From a job to the words of its command.
    read     From its output and the number of timed steps to the figures; outputs.Unreadable if it is no result.
    """

    name: str
    version: str
    scenes: tuple
    command: Callable
    read: Callable


def plekton_command(program, job):
    case = job.case
    scene, _, law = {"sheet": "s2", "lone": "s1"}.get(case.scene, case.scene).partition(":")
    command = [program, scene, "--warm-up", str(case.warm_up), "--steps", str(case.steps), "--threads", str(job.threads)]
    if law:
        command += ["--law", law]
    if job.bed:
        command += ["--bed", str(job.bed)]
    if case.scene == "sheet":
        command += ["--cells", str(case.size)]
    return command


def yade_command(program, job):
    case = job.case
    script = "yade_bed.py" if case.scene in BEDS_ONLY else "yade_structures.py"
    # Both boxes of a pair are larger by half of the skin.
    command = [program, "-n", "-x", f"-j{job.threads}", str(PEERS / script), "--scene", case.scene]
    command += ["--warm-up", str(case.warm_up), "--steps", str(case.steps), "--verlet", repr(case.skin / 2)]
    return command + (["--bed", str(job.bed)] if job.bed else [])


def lammps_data(bed):
    """The data file beside a bed, made if it is missing or older; the length and width of the box."""
    if str(PEERS) not in sys.path:
        sys.path.insert(0, str(PEERS))
    import to_lammps_data

    data = bed.with_suffix(".lammps")
    if not data.exists() or data.stat().st_mtime < bed.stat().st_mtime:
        to_lammps_data.convert(bed, data)
    with open(bed, encoding="utf-8") as file:
        _, side, extent = (float(word) for word in file.readline().split())
    return data, side * extent, side


def mpirun(count):
    """The words before a command that run it on so many ranks, of one thread each."""
    words = ["env", "OMP_NUM_THREADS=1", "mpirun", "--bind-to", "none", "-np", str(count)]
    return [*words, "--allow-run-as-root"] if os.geteuid() == 0 else words


def mpi_ranks(count):
    """The same; one rank is started by itself."""
    return mpirun(count) if count > 1 else []


def lammps_command(script, program, job):
    data, length, width = lammps_data(job.bed)
    variables = {
        "data": data,
        "length": repr(length),
        "width": repr(width),
        "warm_up": job.case.warm_up,
        "steps": job.case.steps,
        "skin": repr(job.case.skin),
    }
    # Whole lines: the clocks in the output of LIGGGHTS are printed by another program.
    command = [*mpi_ranks(job.threads), "stdbuf", "-oL", program, "-in", str(PEERS / script), "-log", "none"]
    for name, value in variables.items():
        command += ["-var", name, str(value)]
    return command


def minimal_loop_command(program, job):
    # Its skin is in radii, and its windows begin after a warm-up of its own.
    skin = f"SKIN={job.case.skin / 1e-3:g}"
    return ["env", skin, program, "time", str(job.bed), "2", str(job.case.steps)]


def plekton(program):
    return Code("plekton", "", (), partial(plekton_command, program), outputs.read_json)


def plekton_on_ranks(program):
    """Ranks of one thread each, one of them as well."""

    def command(job):
        return [*mpirun(job.threads), *plekton_command(program, Job(job.case, job.bed, 1))]

    return Code(ON_RANKS, "", BEDS_ONLY, command, outputs.read_json)


def yade(program):
    version = first_line_with("version", [program, "--version"])
    scenes = (*BEDS_ONLY, "s2", "s3", "s4a", "s4b")
    read = partial(outputs.read_json, prefix="RESULT ")
    return Code("yade", version, scenes, partial(yade_command, program), read)


def lammps(name, program):
    version = first_line_with("Simulator", [program, "-h"])
    return Code(name, version, BEDS_ONLY, partial(lammps_command, "bed.lammps", program), outputs.read_lammps)


def liggghts(program):
    version = first_line_with("Version", [program, "-h"])
    command = partial(lammps_command, "bed.liggghts", program)
    return Code("liggghts", version, BEDS_ONLY, command, outputs.read_lammps)


def minimal_loop(program):
    return Code("loop", "", BEDS_ONLY, partial(minimal_loop_command, program), outputs.read_json)


MAKERS = {
    "yade": ("YADE", "yade", yade),
    "lammps": ("LMP", "lmp", partial(lammps, "lammps")),
    "lammps-native": ("LMP_NATIVE", None, partial(lammps, "lammps-native")),
    "liggghts": ("LIGGGHTS", "liggghts", liggghts),
    "loop": ("MINIMAL_LOOP", None, minimal_loop),
}
"""Name of a peer: the variable of the environment with its path, its name on the PATH, and what makes a Code of it."""


def first_line_with(word, command):
    """Of what a command prints; empty if there is none."""
    text = run(command, 1, 60).text
    return next((line.strip() for line in text.splitlines() if word in line), "")


NAMES = (ON_RANKS, *MAKERS)
"""All that plekton-bench may be compared with."""


def find_codes(bench, names=NAMES):
    """plekton-bench, then the peers of these names that are on this machine."""
    program = str(Path(bench).resolve())
    codes = [plekton(program)]
    if ON_RANKS in names and shutil.which("mpirun"):
        codes.append(plekton_on_ranks(program))
    for name in [name for name in names if name in MAKERS]:
        variable, default, make = MAKERS[name]
        wanted = os.environ.get(variable) or default
        program = shutil.which(wanted) if wanted else None
        if program:
            codes.append(make(str(Path(program).absolute())))
    return codes
