# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs a benchmark with several numbers of threads while other programs keep all processors busy.

Usage: python3 busy.py --bench PROGRAM [--scenes s1 s4b] [--threads 1 2 4 7] [--repetitions 5] [--busy 2] [--json]

In every repetition each number of threads runs once, forwards in one and backwards in the next. Printed are the median,
smallest and largest wall time of a step, and the same of the ratio to one thread of the same repetition. Ends with 1 if
a median ratio is above --limit, or if runs end in different states. --busy 0 leaves the machine idle.
"""
import argparse
import json
import statistics
import subprocess
import sys
import tempfile

SPHERES = 5000


class BusyPrograms:
    """So many programs that do nothing but run, until the end of the block."""

    def __init__(self, count, own_sessions):
        self.count = count
        self.own_sessions = own_sessions
        self.programs = []

    def __enter__(self):
        loop = [sys.executable, "-c", "while True: pass"]
        self.programs = [subprocess.Popen(loop, start_new_session=self.own_sessions) for _ in range(self.count)]

    def __exit__(self, *_):
        for program in self.programs:
            program.kill()
            program.wait()


def run(arguments, scene, bed, threads):
    """The JSON line of one run."""
    command = [arguments.bench, scene, "--threads", str(threads)]
    if scene.startswith("s1"):
        command += ["--bed", bed]
    if arguments.steps:
        command += ["--steps", str(arguments.steps)]
    return json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)


def times_of(arguments, scene, bed):
    """Wall times of a step (ms) by number of threads, one for each repetition; and whether all runs end alike."""
    times = {threads: [] for threads in arguments.threads}
    states = set()
    with BusyPrograms(arguments.busy, arguments.own_sessions):
        for repetition in range(arguments.repetitions):
            order = arguments.threads if repetition % 2 == 0 else arguments.threads[::-1]
            for threads in order:
                result = run(arguments, scene, bed, threads)
                times[threads].append(result["ms_per_step"])
                states.add(json.dumps(result["state"]))
    return times, len(states) == 1


def spread(values):
    return statistics.median(values), min(values), max(values)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--bench", required=True, help="plekton-bench")
    parser.add_argument("--scenes", nargs="+", default=["s1", "s4b"])
    parser.add_argument("--threads", nargs="+", type=int, default=[1, 2, 4, 7])
    parser.add_argument("--repetitions", type=int, default=5)
    parser.add_argument("--busy", type=int, default=2, help="programs beside (2)")
    parser.add_argument("--own-sessions", action="store_true",
                        help="these are of other sessions, between which Linux may share processors out alike")
    parser.add_argument("--steps", type=int, help="that are timed; those of the scene")
    parser.add_argument("--limit", type=float, default=1.3, help="of the median ratio to one thread (1.3)")
    parser.add_argument("--json", action="store_true", help="a line for each scene and number of threads")
    arguments = parser.parse_args()
    if 1 not in arguments.threads:
        parser.error("--threads needs 1, which the others are compared with")

    good = True
    with tempfile.TemporaryDirectory() as folder:
        bed = f"{folder}/bed.txt"
        if any(scene.startswith("s1") for scene in arguments.scenes):
            subprocess.run([arguments.bench, "make-bed", "--spheres", str(SPHERES), "--out", bed], check=True,
                           capture_output=True)
        for scene in arguments.scenes:
            times, same = times_of(arguments, scene, bed)
            if not same:
                print(f"{scene}: runs end in different states")
                good = False
            for threads in arguments.threads:
                ratios = [t / one for t, one in zip(times[threads], times[1])]
                time, ratio = spread(times[threads]), spread(ratios)
                good = good and ratio[0] <= arguments.limit
                if arguments.json:
                    print(json.dumps({"scene": scene, "threads": threads, "busy": arguments.busy, "ms_per_step": time,
                                      "over_one_thread": ratio}))
                else:
                    print(f"{scene} {threads} threads beside {arguments.busy} programs: {time[0]:.3f} ms a step "
                          f"({time[1]:.3f} to {time[2]:.3f}), {ratio[0]:.2f} of one thread ({ratio[1]:.2f} to {ratio[2]:.2f})",
                          flush=True)
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
