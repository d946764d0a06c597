# SPDX-License-Identifier: GPL-3.0-or-later
"""The promises about speed and memory, and which of them measured results keep."""

from dataclasses import dataclass

from comparison import compiling, costs
from comparison.cases import LAW_SCENES, LINEAR_LAW, OTHER_LAWS, SCENES, SHEET_CELLS, under
from comparison.codes import ON_RANKS
from comparison.results import Results, Spread, combine

NATIVE_SHARE = 0.85
"""Time of a LAMMPS compiled for the machine over that of Debian's: 2.9 over 3.5 ms a step of 20 000 spheres, rounded against us."""

SMALL = 20000
"""Spheres, up to which two threads have to bring more."""

TITLES = {"yade": "YADE", "lammps": "LAMMPS", "liggghts": "LIGGGHTS", "loop": "the minimal loop", "cgal": "CGAL", "fcl": "FCL"}


@dataclass(frozen=True)
class Row:
    """One promise about one thing.

    measured   None if it was not; missing then says why.
    must, aim  The bound and what is hoped for, none where there is none.
    at_least   Whether larger is better.
    flaw       What makes it missed whatever the number.
    """

    promise: str
    what: str
    measured: Spread | None
    must: float | None
    aim: float | None
    at_least: bool = True
    missing: str = ""
    flaw: str = ""

    def _keeps(self, value, bound):
        return value >= bound if self.at_least else value <= bound

    def verdict(self, bound):
        """ "holds", "missed" or "not measured", with what has to be said along with it; "-" without a bound."""
        if bound is None:
            return "-"
        if self.measured is None:
            return f"not measured ({self.missing})"
        if self.flaw:
            return f"missed ({self.flaw})"
        holds = self._keeps(self.measured.median, bound)
        worst = self.measured.smallest if self.at_least else self.measured.largest
        best = self.measured.largest if self.at_least else self.measured.smallest
        if holds:
            return "holds" if self._keeps(worst, bound) else "holds (not in every repetition)"
        return "missed (not in every repetition)" if self._keeps(best, bound) else "missed"


def why_missing(results, installed, code, scene, size):
    """The reason for which there is no run of a code."""
    if code not in installed:
        return f"no {TITLES.get(code, code)} on this machine" if code != "loop" else "MINIMAL_LOOP names no program"
    if not results.sizes(scene, "plekton"):
        return f"{scene} was not run"
    reason = results.failure(code, scene, size)
    return f"{TITLES.get(code, code)} failed: {reason}" if reason else f"no run of {TITLES.get(code, code)}"


def against(results, installed, promise, peer, scene, size, bounds, share=1.0, title=None):
    """Row: how many times as fast as a peer, whose time is counted at a share."""
    ours, theirs = results.times("plekton", scene, size), results.times(peer, scene, size)
    measured = combine(lambda mine, other: share * other / mine, ours, theirs)
    culprit = peer if ours or peer not in installed else "plekton"
    missing = "" if measured else why_missing(results, {*installed, "plekton"}, culprit, scene, size)
    where = f"{scene} {size}" if size else scene
    return Row(promise, f"{where}: times {title or TITLES[peer]}", measured, *bounds, missing=missing)


def sphere_beds(results, installed):
    """G1."""
    beds = [(scene, size) for scene in ("s1", "s1flow") for size in results.sizes(scene) or [SCENES[scene].size]]
    for scene, size in beds:
        if "lammps-native" in installed:
            yield against(results, installed, "G1", "lammps-native", scene, size, (1.3, 2.0), title="LAMMPS native")
        else:
            title = f"LAMMPS native (Debian's x {NATIVE_SHARE})"
            yield against(results, installed, "G1", "lammps", scene, size, (1.3, 2.0), NATIVE_SHARE, title)
        yield against(results, installed, "G1", "yade", scene, size, (8.0, None))
        if "loop" in installed:
            yield against(results, installed, "G1", "loop", scene, size, (None, 0.5))


STRUCTURES = (("G3", "s2", (10.0, 20.0)), ("G4", "s3", (8.0, 15.0)), ("G5", "s4a", (7.0, 10.0)), ("G6", "s4b", (10.0, 20.0)))
"""Promise, scene, must and aim against YADE."""


def structures(results, installed):
    """G3 to G6; YADE without self-contact of shells."""
    for promise, scene, bounds in STRUCTURES:
        yield against(results, installed, promise, "yade", scene, SCENES[scene].size, bounds)


def contacts(results, installed):
    """G7."""
    measured = costs.facet_over_sphere_contact(results)
    what = "a sphere-facet contact over a sphere-sphere contact"
    missing = "" if measured else "needs layers"
    yield Row("G7", what, measured, 3.0, 2.0, at_least=False, missing=missing)
    measured = costs.facet_contact_with_all_of_s2(Results(results.records, "cpu"))
    missing = "" if measured else "needs s1 and s2 on one thread"
    what = "the same, bearing motion and all else of s2, as G7 was promised"
    yield Row("G7", what, measured, 3.0, 2.0, at_least=False, missing=missing)


def two_threads(results, installed):
    """G8."""
    for scene in ("s1", "s1flow"):
        for size in results.sizes(scene) or [SCENES[scene].size]:
            wall = Results(results.records, "wall")
            one, two = wall.times("plekton", scene, size, 1), wall.times("plekton", scene, size, 2)
            measured = combine(lambda single, double: single / double, one, two)
            missing = "" if measured else f"needs {scene} on 1 and 2 threads"
            flaw = "other bits than one thread" if measured and not costs.same_bits(results, scene, size) else ""
            bounds = (1.7, 1.85) if size <= SMALL else (1.4, 1.5)
            yield Row("G8", f"{scene} {size}: two threads over one", measured, *bounds, missing=missing, flaw=flaw)


def two_threads_on_structures(results, installed):
    """What two threads bring where structures touch."""
    for scene in ("s4a", "s4b"):
        wall = Results(results.records, "wall")
        size = SCENES[scene].size
        one, two = (wall.times("plekton", scene, size, threads) for threads in (1, 2))
        measured = combine(lambda single, double: single / double, one, two)
        missing = "" if measured else f"needs {scene} on 1 and 2 threads"
        flaw = "other bits than one thread" if measured and not costs.same_bits(results, scene, size) else ""
        yield Row("G8", f"{scene}: two threads over one", measured, 1.6, None, missing=missing, flaw=flaw)


def ranks(results, installed):
    """What ranks of one thread bring, and cost, by wall time."""
    wall = Results(results.records, "wall")
    for size in results.sizes("s1") or [SCENES["s1"].size]:
        alone = wall.times("plekton", "s1", size)
        on = {count: wall.times(ON_RANKS, "s1", size, count) for count in (1, 2)}
        lammps = wall.times("lammps", "s1", size, 2)
        missing = f"needs {ON_RANKS} with --peer-threads 1 2"
        two = combine(lambda none, ranks: none / ranks, alone, on[2])
        yield Row("ranks", f"s1 {size}: two over none", two, 1.6 if size > SMALL else None, None, missing=missing)
        one = combine(lambda none, rank: rank / none, alone, on[1])
        yield Row("ranks", f"s1 {size}: time on one over none", one, 1.03, None, at_least=False, missing=missing)
        both = combine(lambda ours, theirs: theirs / ours, on[2], lammps)
        yield Row("ranks", f"s1 {size}: times LAMMPS, two ranks each", both, 1.0, None, missing=missing + " and lammps")


def compile_times(results, installed):
    """G13."""
    processor = Results(results.records, "cpu")
    for scene, (example, most) in compiling.EXAMPLES.items():
        times = processor.times("plekton", scene, 0)
        measured = combine(lambda time: 1e-3 * time, times)
        missing = "" if measured else "needs --headers"
        yield Row("G13", f"s to compile {example}", measured, most, None, at_least=False, missing=missing)


def memory(results, installed):
    """G9."""
    rows = (
        ("KiB a sphere", costs.memory_per_sphere(results), 1.0, 0.7, "needs s1"),
        (f"KiB a facet ({SHEET_CELLS[0]} to {SHEET_CELLS[1]} cells)", costs.memory_per_facet(results), 2.0, None, "needs s2"),
        ("MiB fixed", costs.fixed_memory(results), 30.0, None, "needs s1"),
    )
    for what, measured, must, aim, missing in rows:
        yield Row("G9", what, measured, must, aim, at_least=False, missing="" if measured else missing)


def growth(results, installed):
    """G10."""
    measured = costs.growth(results, 5000, 100000)
    missing = "" if measured else "needs s1 at 5000 and 100000"
    yield Row("G10", "ns a sphere-step, 100000 over 5000", measured, 1.5, 1.3, at_least=False, missing=missing)


def laws(results, installed):
    """G11."""
    for scene in LAW_SCENES:
        size = SCENES[scene].size
        linear = results.times("plekton", under(scene, LINEAR_LAW), size)
        for law in OTHER_LAWS:
            times = results.times("plekton", under(scene, law), size)
            measured = combine(lambda base, other: other / base, linear, times)
            missing = "" if measured else "needs laws"
            yield Row("G11", f"{scene}: {law} over {LINEAR_LAW}", measured, 1.3, None, at_least=False, missing=missing)


SEARCHES = (
    ("search_near", "cgal", 1.0),
    ("search_far", "cgal", 1.0),
    ("search_rings", "fcl", 0.5),
    ("search_waves", "fcl", 0.5),
    ("search_tilted", "fcl", 0.5),
    ("search_flat", "fcl", 0.5),
)
"""Scene of plekton-bench-search, who else answers, and how many times as fast Plekton must be."""


def searches(results, installed):
    """G12."""
    for scene, peer, must in SEARCHES:
        for size in results.sizes(scene):
            yield against(results, installed, "G12", peer, scene, size, (must, None))
        if not results.sizes(scene):
            yield Row("G12", f"{scene}: times {TITLES[peer]}", None, must, None, missing="needs --search")


def rows(results, installed):
    """All promises.

    @param results    Results of plekton and of its peers.
    @param installed  Names of the peers found on this machine.
    """
    for group in (sphere_beds, structures, contacts, two_threads, two_threads_on_structures, ranks, memory, growth, laws, searches, compile_times):
        yield from group(results, installed)
