# SPDX-License-Identifier: GPL-3.0-or-later
"""The tables that compare.py prints, as text: every line a row of Markdown."""

from comparison import promises
from comparison.cases import LONE
from comparison.results import combine, is_clean, spread


DISTURBED = (
    "* took less than 90 % of its processors: other work ran beside it (take --clock cpu, or a quiet machine), or its threads waited."
)


def table(header, rows):
    """A table whose columns are as wide as their widest word."""
    rows = [header, *rows]
    widths = [max(len(row[column]) for row in rows) for column in range(len(header))]
    lines = ["| " + " | ".join(word.ljust(width) for word, width in zip(row, widths)) + " |" for row in rows]
    lines.insert(1, "|" + "|".join("-" * (width + 2) for width in widths) + "|")
    return "\n".join(lines)


def figure(value, digits=3):
    """A number at so many digits that count, "-" for none."""
    return "-" if value is None else f"{value:#.{digits}g}".rstrip(".")


def bound(value, at_least):
    return "-" if value is None else f"{'>=' if at_least else '<='} {value:g}"


def groups(results):
    """The (scene, size, threads, code) of all runs, in the order in which they came."""
    keys = dict.fromkeys((run["scene"], run["size"], run["threads"], run["code"]) for run in results.records)
    order = {pair: place for place, pair in enumerate(dict.fromkeys(key[:2] for key in keys))}
    return sorted(keys, key=lambda key: (order[key[:2]], key[2]))


def runs_table(results):
    """Medians of every code, and how many times as long as Plekton's on as many threads."""
    header = ["scene", "size", "threads", "code", "runs", "ms/step", "min..max", "CPU ms/step", "times Plekton", "MiB"]
    rows = []
    for scene, size, threads, code in groups(results):
        runs = results.runs(code, scene, size, threads)
        if not runs or scene == LONE:
            continue
        wall = spread([run["ms_per_step"] for run in runs.values()])
        processor = [run["cpu_ms_per_step"] for run in runs.values() if run.get("cpu_ms_per_step") is not None]
        disturbed = "" if all(is_clean(run) for run in runs.values()) else " *"
        rows.append(
            [
                scene,
                str(size or "-"),
                str(threads),
                code + disturbed,
                str(len(runs)),
                figure(wall.median),
                f"{figure(wall.smallest)}..{figure(wall.largest)}",
                figure(spread(processor).median if processor else None),
                times_plekton(results, scene, size, threads, code),
                f"{max(run['rss_MiB'] for run in runs.values()):.0f}",
            ]
        )
    return table(header, rows)


def times_plekton(results, scene, size, threads, code):
    """The ratio by the clock of the verdicts, its median over repetitions."""
    pair = (results.times(name, scene, size, threads) for name in ("plekton", code))
    ratio = combine(lambda ours, theirs: theirs / ours, *pair)
    return figure(ratio.median if ratio else None)


def states_table(results):
    """Where each code has ended: the same scene ends in nearly the same state."""
    header = ["scene", "size", "code", "contacts", "kinetic energy J", "mean height m", "lists made"]
    rows, seen = [], set()
    for scene, size, threads, code in groups(results):
        runs = results.runs(code, scene, size, threads)
        if not runs or scene == LONE or (scene, size, code) in seen:
            continue
        seen.add((scene, size, code))
        run = next(iter(runs.values()))
        state = run.get("state", {})
        energy, height = (figure(state.get(key), 4) for key in ("kinetic_energy_J", "mean_height_m"))
        lists = run.get("list_rebuilds")
        rows.append([scene, str(size or "-"), code, contacts(run), energy, height, "-" if lists is None else str(lists)])
    return table(header, rows)


def contacts(run):
    """Their number, with those of spheres alone, which are what LAMMPS and LIGGGHTS count."""
    kinds = run.get("contacts_by_kind", {})
    spheres = kinds.get("sphere_sphere", kinds.get("Sphere-Sphere"))
    return f"{run.get('contacts')}" + (f" (spheres: {spheres})" if spheres else "")


def promises_table(results, installed):
    header = ["promise", "what", "must", "aim", "measured", "min..max", "must: verdict", "aim: verdict"]
    rows = []
    for row in promises.rows(results, installed):
        measured = row.measured
        rows.append(
            [
                row.promise,
                row.what,
                bound(row.must, row.at_least),
                bound(row.aim, row.at_least),
                figure(measured.median if measured else None),
                f"{figure(measured.smallest)}..{figure(measured.largest)}" if measured else "-",
                row.verdict(row.must),
                row.verdict(row.aim) if measured else "-",
            ]
        )
    return table(header, rows)


def failures(results):
    """A paragraph for every run that failed."""
    lines = []
    for run in results.records:
        if "failed" in run:
            where = f"{run['code']}, {run['scene']} {run['size'] or ''}".strip()
            lines.append(f"{where}, {run['threads']} threads, repetition {run['repetition']}: {run['failed']}")
    return "\n".join(lines)


def whole(results, installed):
    """All tables, with what has to be known to read them."""
    parts = [runs_table(results), states_table(results), promises_table(results, installed), failures(results)]
    if " *" in parts[0]:
        parts.insert(1, DISTURBED)
    if results.clock == "cpu":
        parts.insert(0, "Ratios are of processor time, those of several threads of wall time.")
    return "\n\n".join(part for part in parts if part)
