# SPDX-License-Identifier: GPL-3.0-or-later
"""What is derived from Plekton's own runs: the cost of a contact, memory, growth. Each is none where a run is missing."""

from comparison.cases import LAYER_GROUNDS, LONE, SCENES, SHEET, SHEET_CELLS
from comparison.results import combine, spread

KIB = 1024.0
"""KiB in a MiB."""


def facet_over_sphere_contact(results):
    """Cost of a sphere-facet contact over that of a sphere-sphere contact, each end to end.

    A contact costs what a layer of spheres on a ground takes more than the same spheres lifted off the same ground, over the
    contacts at the end: with its share of lists, of looks at what is near, of histories and of sums, without motion.
    """
    grounds = []
    for scene, kind in zip(LAYER_GROUNDS, ("sphere_surface", "sphere_sphere")):
        runs = results.runs("plekton", scene, 0)
        if not runs:
            return None
        grounds.append(kinds_of(next(iter(runs.values())))[kind])
    if not all(grounds):
        return None

    def ratio(on_sheet, above_sheet, on_spheres, above_spheres):
        return (on_sheet - above_sheet) / grounds[0] / ((on_spheres - above_spheres) / grounds[1])

    scenes = (ground + end for ground in LAYER_GROUNDS for end in ("", "_lifted"))
    return combine(ratio, *(results.times("plekton", scene, 0) for scene in scenes))


def facet_contact_with_all_of_s2(results):
    """The same as it was defined at first: contacts bear all that a step takes.

    A sphere-sphere contact costs the step of s1 over its contacts, those with walls included. The step of s2 is that of the membrane alone (the same sheet, steps
    and program, without grains), plus its contacts between spheres and with walls at the cost of those in s1, plus those
    of spheres with the membrane, at the cost in question.
    """
    s1_size, s2_size = SCENES["s1"].size, SCENES["s2"].size
    s1, s2 = results.runs("plekton", "s1", s1_size), results.runs("plekton", "s2", s2_size)
    if not s1 or not s2:
        return None
    plain = without_facets(next(iter(s1.values())))
    beside = without_facets(next(iter(s2.values())))
    on_facets = kinds_of(next(iter(s2.values())))["sphere_surface"]
    if not plain or not on_facets:
        return None

    def ratio(bed, whole, sheet):
        sphere_contact = bed / plain
        return (whole - sheet - beside * sphere_contact) / on_facets / sphere_contact

    times = (("s1", s1_size), ("s2", s2_size), (SHEET, SHEET_CELLS[0]))
    return combine(ratio, *(results.times("plekton", scene, size) for scene, size in times))


def without_facets(run):
    """Contacts of spheres with spheres and with walls."""
    kinds = kinds_of(run)
    return kinds["sphere_sphere"] + kinds["with_planes"]


def kinds_of(run):
    """Contacts by kind, 0 of those that were not told."""
    return {"sphere_sphere": 0, "sphere_surface": 0, "with_planes": 0, **run.get("contacts_by_kind", {})}


def same_bits(results, scene, size):
    """Whether all runs of plekton ended in one state, to the last digit that they print, whatever the threads."""
    wanted = {"code": "plekton", "scene": scene, "size": size}
    states = {
        str(run.get("state")) + str(run.get("contacts"))
        for run in results.records
        if "failed" not in run and all(run[key] == value for key, value in wanted.items())
    }
    return len(states) <= 1


def peak(results, scene, size):
    """MiB, the largest of all repetitions; none without a run."""
    runs = results.runs("plekton", scene, size)
    return max(run["rss_MiB"] for run in runs.values()) if runs else None


def between(results, small, large, elements):
    """Spread of one value: KiB an element of what a large run takes more than a small one."""
    low, high = peak(results, *small), peak(results, *large)
    if low is None or high is None or elements <= 0:
        return None
    return spread([KIB * (high - low) / elements])


def memory_per_sphere(results):
    """KiB, from the smallest and largest bed; from one sphere and the bed if there is one size."""
    sizes = results.sizes("s1")
    if not sizes:
        return None
    small = ("s1", sizes[0]) if len(sizes) > 1 else (LONE, 1)
    return between(results, small, ("s1", sizes[-1]), sizes[-1] - small[1])


def memory_per_facet(results):
    """KiB with its share of nodes, edges and beams, from two sheets without grains."""
    few, many = SHEET_CELLS
    return between(results, (SHEET, few), (SHEET, many), 2 * (many**2 - few**2))


def fixed_memory(results):
    """MiB of a run of one sphere."""
    fixed = peak(results, LONE, 1)
    return None if fixed is None else spread([fixed])


def growth(results, few, many):
    """Time a sphere-step in a bed of many spheres over that in a bed of few."""
    times = (results.times("plekton", "s1", size) for size in (few, many))
    return combine(lambda small, large: (large / many) / (small / few), *times)
