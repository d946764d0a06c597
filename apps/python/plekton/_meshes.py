# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes in and out, as arrays."""

from math import inf
from typing import NamedTuple

from . import _core


class ImportedMesh(NamedTuple):
    """A mesh that can be used, and what its repair tells."""

    points: object
    """m, (N, 3)"""
    facets: object
    """(M, 3), by the numbers of their points, counterclockwise seen from outside"""
    report: dict
    """what was found, changed and remains, as plekton import --json prints it"""


def _options(weld, fill_holes, longest_hole, wrap, wrap_detail, target_edge, refuse_intersections):
    """A length asks for its step by itself, as in a scenario."""
    options = _core._RepairOptions()
    options.weld = _core._length(weld, "weld")
    options.longest_hole = _core._length(longest_hole, "longest_hole")
    options.fill_holes = bool(fill_holes) or options.longest_hole != inf
    options.wrap_detail = _core._length(wrap_detail, "wrap_detail")
    options.wrap = bool(wrap) or options.wrap_detail != 0
    options.target_edge = _core._length(target_edge, "target_edge")
    options.refuse_intersections = bool(refuse_intersections)
    return options


def import_mesh(
    path,
    *,
    scale=1.0,
    weld=0.0,
    fill_holes=False,
    longest_hole=inf,
    wrap=False,
    wrap_detail=0.0,
    target_edge=0.0,
    refuse_intersections=False,
):
    """Reads a mesh (.off .obj .stl .ply .msh .vtp), repairs it and reports on it, as plekton import does.

    Lengths are in m, or texts as in "1 um", after scaling. Raises MeshError for a mesh that cannot be used.
    """
    options = _options(weld, fill_holes, longest_hole, wrap, wrap_detail, target_edge, refuse_intersections)
    return ImportedMesh(*_core._import_mesh(path, _core._number(scale, "scale"), options))


def repair_mesh(
    points,
    facets,
    *,
    weld=0.0,
    fill_holes=False,
    longest_hole=inf,
    wrap=False,
    wrap_detail=0.0,
    target_edge=0.0,
    refuse_intersections=False,
):
    """The same with points (m, (N, 3)) and facets ((M, 3), or polygons of more corners) in place of a file."""
    options = _options(weld, fill_holes, longest_hole, wrap, wrap_detail, target_edge, refuse_intersections)
    return ImportedMesh(*_core._repair_mesh(points, facets, options))
