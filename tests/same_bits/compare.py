# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the scenes beside it in several ways, and says whether all give the same bits: the hashes of the state in run.json.

Usage: python3 compare.py PROGRAM... [--widths 2,4,8] [--threads 1,2] [--write FILE] [--against FILE]

Each PROGRAM is a plekton, or a command that runs one, as "qemu-aarch64 build/arm64/apps/plekton". It is run with every width of vectors
that its processor has and every number of threads, and once with the C library told that the processor is an old one. --write keeps the hashes, --against compares with those of another machine.
Ends 1 if a bit differs, 2 if a run fails.
"""

import argparse
import json
import os
import shlex
import subprocess
import sys
import tempfile
from pathlib import Path

SCENES = sorted((Path(__file__).parent / "scenes").glob("*.toml"))
LACKING = "no vectors of"
"""What the program says of a width that its processor has not."""


OLD_PROCESSOR = "glibc.cpu.hwcaps=-FMA,-FMA4,-AVX2,-AVX512F"
"""For GLIBC_TUNABLES: the C library takes the functions that it has for an x86-64 without these."""


class RunFailed(Exception):
    pass


def states_of(program, scene, width, threads, tunables):
    """The hashes of a run as [step, time, hash]; nothing if the processor lacks vectors of this width."""
    with tempfile.TemporaryDirectory() as folder:
        command = [*shlex.split(program), "run", str(scene), "--out", f"{folder}/out", "--threads", str(threads), "--quiet"]
        environment = {**os.environ, "PLEKTON_VECTOR_WIDTH": str(width), "GLIBC_TUNABLES": tunables}
        run = subprocess.run(command, env=environment, capture_output=True, text=True)
        if run.returncode != 0:
            if LACKING in run.stderr:
                return None
            raise RunFailed(f"{shlex.join(command)}, PLEKTON_VECTOR_WIDTH={width}:\n{run.stderr}")
        report = json.loads((Path(folder) / "out" / "run.json").read_text(encoding="utf-8"))
        if report["vector_width"] != width:
            raise RunFailed(f"{program}: ran with vectors of {report['vector_width']}, not {width}")
        return report["states"]["step_time_hash"]


def first_difference(states, others):
    """The step of the first state that differs, or nothing."""
    for state, other in zip(states, others):
        if state != other:
            return min(state[0], other[0])
    if len(states) != len(others):
        return max(states[-1][0], others[-1][0])
    return None


def compare(scene, programs, widths, threads, reference, report):
    """Runs a scene in all ways; returns its hashes, and how many ways differ from the reference, or from the first one."""
    differ = 0
    for program in programs:
        ways = [(width, count, "") for width in widths for count in threads]
        for width, count, tunables in [*ways, (widths[0], threads[0], OLD_PROCESSOR)]:
            states = states_of(program, scene, width, count, tunables)
            way = f"{scene.stem:8} width {width}, {count} threads, {program}" + (", old C library" if tunables else "")
            if states is None:
                report(f"{way}: the processor has no such vectors")
                continue
            reference = reference or states
            step = first_difference(states, reference)
            differ += step is not None
            last = states[-1]
            report(f"{way}: {last[2]} after {last[0]} steps" + ("" if step is None else f"; DIFFERS from step {step} on"))
    return reference, differ


def numbers(text):
    return [int(part) for part in text.split(",")]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("programs", nargs="+", metavar="PROGRAM")
    parser.add_argument("--widths", type=numbers, default=[2, 4, 8])
    parser.add_argument("--threads", type=numbers, default=[1, 2])
    parser.add_argument("--write", metavar="FILE")
    parser.add_argument("--against", metavar="FILE")
    line = parser.parse_args()
    known = json.loads(Path(line.against).read_text(encoding="utf-8")) if line.against else {}
    found, differ = {}, 0
    try:
        for scene in SCENES:
            found[scene.stem], more = compare(
                scene, line.programs, line.widths, line.threads, known.get(scene.stem), print
            )
            differ += more
    except RunFailed as failure:
        print(failure)
        return 2
    if line.write:
        Path(line.write).write_text(json.dumps(found, indent=1) + "\n", encoding="utf-8")
    print(f"{len(SCENES)} scenes, {differ} runs differ")
    return 1 if differ else 0


if __name__ == "__main__":
    sys.exit(main())
