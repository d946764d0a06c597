# SPDX-License-Identifier: GPL-3.0-or-later
"""What is run: the scenes with their beds, windows of time steps and list skins, which are the same for every code."""

from dataclasses import dataclass
from pathlib import Path

BED, FLOW, SLAB = "bed", "flow", "slab"
"""Kinds of beds, and the first word of their files' names."""

MAKE_BED_FLAGS = {BED: [], FLOW: ["--flow"], SLAB: ["--slab"]}


@dataclass(frozen=True)
class Scene:
    """A row of the table of scenes; plekton-bench has the same names.

    size        Spheres of the bed, if the user names no sizes; 0 without a bed.
    has_sizes   Whether --sizes holds for it.
    skin        m, by which the lists of pairs of a peer reach beyond contact; Plekton chooses its own.
    """

    name: str
    bed: str
    size: int
    has_sizes: bool
    warm_up: int
    steps: int
    skin: float


SCENES = {
    scene.name: scene
    for scene in (
        Scene("s1", BED, 5000, True, 200, 2000, 1e-4),
        Scene("s1flow", FLOW, 20000, False, 100, 400, 2e-4),
        Scene("s2", SLAB, 5000, False, 4000, 600, 2e-4),
        Scene("s3", BED, 10000, False, 5000, 600, 2e-4),
        Scene("s4a", "", 0, False, 700, 1200, 2e-4),
        Scene("s4b", "", 0, False, 300, 300, 2e-4),
    )
}

LAYERS = "layers"
"""Layers of spheres on a ground and lifted off it, from whose difference the cost of a contact follows."""

LAYER_GROUNDS = ("layer_sheet", "layer_spheres")
"""Scenes with contacts; with _lifted at the end of the name those without."""

LAYER_WARM_UP, LAYER_STEPS = 200, 600

LAWS = "laws"
"""Scenes under every law, from which follows what a law costs over linear_frictional."""

LAW_SCENES = ("s1", "s2")

LINEAR_LAW = "linear_frictional"

OTHER_LAWS = (
    "linear_frictional+parts",
    *(law + parts for law in ("hertz_mindlin", "dmt_adhesion", "cohesive_frictional") for parts in ("", "+parts")),
)
"""Of plekton-bench --law; with +parts resistance to rolling and twisting, and a dashpot."""


def under(scene, law):
    """The name of a scene under a law."""
    return f"{scene}:{law}"


SCENE_NAMES = (*SCENES, LAYERS, LAWS)
"""What can be asked for."""

SHEET = "sheet"
"""The membrane of s2 with one sphere far above it: what s2 costs without contacts."""

LONE = "lone"
"""A box with one sphere: the memory that a program takes before it has a scene to speak of."""

SHEET_SPACING = 2e-3
"""m, side of a cell."""

SHEET_CELLS = (32, 256)
"""Along a side: those of s2, and enough for the memory that a facet takes."""


@dataclass(frozen=True)
class Case:
    """What every code is to run: a scene at a size, over the same steps. The size of a sheet is its cells along a side."""

    scene: str
    size: int
    bed: str
    warm_up: int
    steps: int
    skin: float = 1e-4
    for_peers: bool = True
    once: bool = False

    @property
    def bed_file(self):
        """Name of the file of the bed, or none."""
        return f"{self.bed}_{self.size}.txt" if self.bed else None


def window(scene, size):
    """Warm-up and timed steps: fewer for larger beds, yet enough for a list of pairs to be made anew now and then."""
    if not scene.has_sizes:
        return scene.warm_up, scene.steps
    share = scene.size / size
    return max(100, round(scene.warm_up * share)), max(200, round(scene.steps * share))


def cases_of(names, sizes):
    """The cases of some scenes, with those that the promises on contacts and memory need."""
    cases = []
    for name in names:
        if name == LAYERS:
            scenes = (ground + end for ground in LAYER_GROUNDS for end in ("", "_lifted"))
            cases += [Case(scene, 0, "", LAYER_WARM_UP, LAYER_STEPS, for_peers=False) for scene in scenes]
            continue
        if name == LAWS:
            bases = [SCENES[scene] for scene in LAW_SCENES]
            cases += [
                Case(under(base.name, law), base.size, base.bed, base.warm_up, base.steps, for_peers=False)
                for base in bases
                for law in (LINEAR_LAW, *OTHER_LAWS)
            ]
            continue
        scene = SCENES[name]
        for size in sizes if scene.has_sizes else [scene.size]:
            cases.append(Case(name, size, scene.bed, *window(scene, size), scene.skin))
    if "s2" in names:
        s2 = SCENES["s2"]
        cases.append(Case(SHEET, SHEET_CELLS[0], SHEET, s2.warm_up, s2.steps, for_peers=False))
        cases.append(Case(SHEET, SHEET_CELLS[1], SHEET, 10, 10, for_peers=False, once=True))
    if "s1" in names:
        cases.append(Case(LONE, 1, LONE, 10, 10, for_peers=False, once=True))
    return cases


def one_sphere_bed(side):
    """A bed of one sphere, 1 m above the floor, in a box of that side (m)."""
    return f"1 {side:g} 1\n{side / 2:g} {side / 2:g} 1 0.001 0 0 0 0 0 0\n"


def provide_bed(case, folder, make_bed):
    """The file of a case's bed, made if it is not there; none for a case without.

    @param make_bed  Called with the words of plekton-bench make-bed after its name; raises if that fails.
    """
    if case.bed_file is None:
        return None
    path = Path(folder) / case.bed_file
    if path.exists():
        return path
    path.parent.mkdir(parents=True, exist_ok=True)
    unfinished = path.with_suffix(".part")
    if case.bed in (SHEET, LONE):
        unfinished.write_text(one_sphere_bed(SHEET_SPACING * max(case.size, 16)), encoding="utf-8")
    else:
        make_bed([*MAKE_BED_FLAGS[case.bed], "--spheres", str(case.size), "--out", str(unfinished)])
    unfinished.rename(path)
    return path
