# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs plekton-bench and the peers on this machine in turns, prints medians and ratios, and says which promises hold.

Peers are YADE, LAMMPS and LIGGGHTS, found on the PATH or by the variables YADE, LMP, LIGGGHTS; LMP_NATIVE names a LAMMPS
compiled for this machine. See README.md, "Against the peers".
"""

import argparse
import itertools
import json
import os
import sys
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).resolve().parent))

from comparison import cases, codes, compiling, machine, outputs, report
from comparison.results import Results
from comparison.running import last_lines, run


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bench", help="path of plekton-bench")
    parser.add_argument("--search", help="path of plekton-bench-search, which is run beside the scenes (G12)")
    parser.add_argument("--headers", help="folder that has plekton/...: the examples are compiled with it beside the scenes (G13)")
    parser.add_argument("--scenes", nargs="*", default=cases.SCENE_NAMES, choices=cases.SCENE_NAMES)
    parser.add_argument("--sizes", nargs="+", type=int, default=[5000, 20000, 100000], help="spheres of s1")
    parser.add_argument("--repetitions", type=int, default=5)
    parser.add_argument("--threads", nargs="+", type=int, default=[1, 2], help="of Plekton")
    parser.add_argument("--peer-threads", nargs="+", type=int, default=[1], help="threads or ranks of the peers")
    parser.add_argument("--peers", nargs="*", default=list(codes.NAMES), choices=list(codes.NAMES))
    parser.add_argument("--beds", default=str(default_beds()), help="folder of beds; those missing are made there")
    parser.add_argument("--out", help="file to which each run is added, a JSON line each")
    parser.add_argument("--read", action="store_true", help="runs nothing: prints the tables of what is in --out")
    parser.add_argument("--clock", choices=("wall", "cpu"), default="wall", help="of which ratios are taken")
    parser.add_argument("--timeout", type=float, default=3600.0, help="s, after which a run is given up")
    options = parser.parse_args()
    if options.read and not options.out:
        parser.error("--read needs --out, the file of the runs")
    if not options.read and not (options.bench and Path(options.bench).is_file()):
        parser.error(f"--bench {options.bench}: no such program; build the target plekton-bench and name it")
    return options


def default_beds():
    return Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "plekton" / "beds"


def in_turns(items, repetition):
    """There and back: what drifts while the machine warms up falls on first and last alike."""
    return list(items) if repetition % 2 == 0 else list(reversed(items))


def entrants(case, found, options):
    """The (code, threads) that run a case."""
    ours, *peers = found
    if not case.for_peers:
        return [(ours, 1)]
    turns = [(ours, threads) for threads in options.threads]
    able = [peer for peer in peers if case.scene in peer.scenes]
    return turns + [(peer, threads) for peer in able for threads in options.peer_threads]


def measure(code, job, repetition, timeout):
    """The record of one run, that of a failure included."""
    case = job.case
    record = {"code": code.name, "scene": case.scene, "size": case.size, "threads": job.threads, "repetition": repetition}
    try:
        ended = run(code.command(job), job.threads, timeout)
    except (OSError, ValueError) as error:
        return {**record, "failed": str(error)}
    try:
        if ended.code != 0:
            raise outputs.Unreadable(f"exit code {ended.code}")
        figures = code.read(ended.text, case.steps)
    except outputs.Unreadable as error:
        return {**record, "failed": f"{error}; its last lines:\n{last_lines(ended.text)}"}
    own = {key: value for key, value in figures.items() if key not in record}
    return {"rss_MiB": ended.rss, **own, "share": ended.share, **record}


def bed_maker(bench, timeout):
    """What makes a bed with plekton-bench; RuntimeError with its last lines if that fails."""

    def make(words):
        print("making a bed: " + " ".join(words), file=sys.stderr, flush=True)
        ended = run([str(Path(bench).resolve()), "make-bed", *words], 1, timeout)
        if ended.code != 0:
            raise RuntimeError(f"plekton-bench make-bed ends with {ended.code}: {last_lines(ended.text)}")

    return make


def provide_beds(wanted, options):
    """The cases with the files of their beds; without those whose bed cannot be made, which are told."""
    ready = []
    for case in wanted:
        try:
            bed = cases.provide_bed(case, Path(options.beds).resolve(), bed_maker(options.bench, options.timeout))
        except (OSError, RuntimeError) as error:
            print(f"{case.scene} {case.size} is left out: {error}", file=sys.stderr)
            continue
        ready.append((case, bed))
    return ready


def all_runs(ready, found, options):
    """The records of all runs, one at a time; a code that fails at a case is not asked for that case again."""
    given_up = set()
    for repetition in range(options.repetitions):
        for case, bed in ready:
            if case.once and repetition > 0:
                continue
            for code, threads in in_turns(entrants(case, found, options), repetition):
                if (code.name, case, threads) in given_up:
                    continue
                record = measure(code, codes.Job(case, bed, threads), repetition, options.timeout)
                if "failed" in record:
                    given_up.add((code.name, case, threads))
                yield record


def search_runs(options):
    """The records of plekton-bench-search, which asks CGAL and FCL as well, in turns, by processor time."""
    if not options.search:
        return
    command = [str(Path(options.search).resolve()), "--repetitions", str(options.repetitions)]
    ended = run(command, 1, options.timeout)
    if ended.code != 0:
        raise RuntimeError(f"plekton-bench-search ends with {ended.code}: {last_lines(ended.text)}")
    for figures in outputs.read_searches(ended.text):
        yield {**figures, "threads": 1, "rss_MiB": ended.rss, "share": ended.share}


def compile_runs(options):
    """The records of the examples, compiled."""
    if options.headers:
        yield from compiling.runs(options.headers, options.repetitions, options.timeout)


def tell(record):
    what = f"{record['scene']} {record['size'] or ''} {record['code']} x{record['threads']} #{record['repetition']}"
    figure = "failed" if "failed" in record else f"{record['ms_per_step']:.4g} ms/step"
    print(f"{what}: {figure}", file=sys.stderr, flush=True)


def collect(ready, found, options):
    """Runs all and writes each record as it comes; an interrupt keeps what there is."""
    records = []
    try:
        for record in itertools.chain(all_runs(ready, found, options), search_runs(options), compile_runs(options)):
            records.append(record)
            tell(record)
            if options.out:
                with open(options.out, "a", encoding="utf-8") as file:
                    file.write(json.dumps(record) + "\n")
    except KeyboardInterrupt:
        print("interrupted: the tables hold what was measured", file=sys.stderr)
    return records


def read_records(path):
    with open(path, encoding="utf-8") as file:
        return [json.loads(line) for line in file if line.strip()]


def compare(options):
    """Runs all; the records, and the names of the codes found."""
    found = codes.find_codes(options.bench, options.peers)
    print(machine.description(found, options.peers), flush=True)
    ready = provide_beds(cases.cases_of(options.scenes, options.sizes), options)
    return collect(ready, found, options), {code.name for code in found}


def main():
    options = arguments()
    records, installed = (read_records(options.out), set()) if options.read else compare(options)
    installed |= {record["code"] for record in records}
    print("\n" + report.whole(Results(records, options.clock), installed))


if __name__ == "__main__":
    main()
