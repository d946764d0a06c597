# SPDX-License-Identifier: GPL-3.0-or-later
"""Time to the same displacement of a pull-out, Plekton and YADE in turns: python3 pull_out.py PROGRAM [--rounds N] [--clock cpu]

PROGRAM is plekton-bench-pull-out. Both go from the loose bed to 12 mm of pull: Plekton with the step that it chooses and with that of
YADE, 12 us. Prints a row for each run, and for grid and membrane the ratios of the rounds with their median (G15). Where other work
runs on the machine, count processor time.
"""

import argparse
import json
import statistics
from pathlib import Path

from comparison.machine import description
from comparison.running import last_lines, run

YADE = Path(__file__).resolve().parent / "peers" / "yade_pull_out.py"
STEP_OF_YADE = "1.2e-5"  # s
PATIENCE = 900.0  # s, for a run


def result_of(command, mark):
    """The figures of a command that prints them as JSON behind a mark."""
    ended = run(command, 1, PATIENCE)
    lines = [line[len(mark) :] for line in ended.text.splitlines() if line.startswith(mark + "{")]
    if ended.code != 0 or not lines:
        raise SystemExit(f"{' '.join(command)} ended with {ended.code}:\n{last_lines(ended.text)}")
    return json.loads(lines[-1])


def commands(program, kind, seed):
    own = [program, kind, "--seed", str(seed)]
    return {
        "yade": (["yade", "-n", "-x", "-j1", str(YADE), kind, str(seed)], "RESULT "),
        "plekton": (own, ""),
        "plekton, step of yade": ([*own, "--time-step", STEP_OF_YADE], ""),
    }


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--clock", choices=("wall", "cpu"), default="wall", help="of the ratios")
    parser.add_argument("--seed", type=int, default=3)
    options = parser.parse_args()
    program = str(Path(options.program).resolve())
    print(description([], []))
    times = {}
    print("| kind | code | round | steps | wall (s) | processor (s) | pull over 2 sigma A |\n|---|---|---|---|---|---|---|")
    for number in range(options.rounds):
        for kind in ("grid", "membrane"):
            for code, (command, mark) in commands(program, kind, options.seed).items():
                row = result_of(command, mark)
                times.setdefault((kind, code), []).append(row[f"{options.clock}_s"])
                print(
                    f"| {kind} | {code} | {number + 1} | {row['steps']} | {row['wall_s']:.2f} "
                    f"| {row['cpu_s']:.2f} | {row['share']:.3f} |",
                    flush=True,
                )
    for (kind, code), own in times.items():
        if code == "yade":
            continue
        ratios = [theirs / ours for theirs, ours in zip(times[kind, "yade"], own)]
        print(f"{kind}, yade over {code}: {statistics.median(ratios):.1f} ({min(ratios):.1f} to {max(ratios):.1f})")


main()
