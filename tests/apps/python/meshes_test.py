# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes in and out as arrays."""

import json

import numpy as np
import plekton
import pytest
import scenes


def test_a_mesh_is_written_and_read_with_every_bit(tmp_path):
    points, facets = scenes.sheet(3, 0.7)
    points[:, 2] = np.sin(7 * points[:, 0])
    for ending in ("off", "obj", "ply", "msh", "vtp"):
        plekton.write_mesh(tmp_path / f"mesh.{ending}", points, facets)
        mesh = plekton.import_mesh(tmp_path / f"mesh.{ending}")

        np.testing.assert_array_equal(mesh.points, points)
        np.testing.assert_array_equal(mesh.facets, facets)
        assert mesh.report["verdict"] == "ok"


def test_arrays_are_repaired_as_files_are():
    points, facets = scenes.sheet(3, 0.7)
    soup = points[facets].reshape(-1, 3)  # every facet with corners of its own
    apart = np.arange(len(soup)).reshape(-1, 3)
    apart[4] = apart[4, ::-1]
    near = soup + 1e-9 * np.random.default_rng(1).uniform(-1, 1, soup.shape)

    mesh = plekton.repair_mesh(near, apart, weld=1e-7)

    assert mesh.points.shape == points.shape
    assert mesh.facets.shape == facets.shape
    assert mesh.report["verdict"] == "repaired"
    normals = np.cross(*(mesh.points[mesh.facets[:, k]] - mesh.points[mesh.facets[:, 0]] for k in (1, 2)))
    assert len(set(np.sign(normals[:, 2]))) == 1


def test_quadrangles_are_cut():
    points = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]])

    mesh = plekton.repair_mesh(points, [[0, 1, 2, 3]])

    assert mesh.facets.shape == (2, 3)


def test_a_length_asks_for_its_step():
    points, facets = scenes.sheet(4, 1.0)
    hole = np.delete(facets, [5, 21], axis=0)

    filled = plekton.repair_mesh(points, hole, longest_hole=1.5)
    fine = plekton.repair_mesh(points, facets, target_edge=0.1)

    assert len(filled.facets) == len(facets)
    assert len(fine.facets) > 2 * len(facets)


@pytest.mark.skipif(scenes.PROGRAM is None, reason="PLEKTON_PROGRAM is not set")
def test_the_report_is_that_of_the_program(tmp_path):
    points, facets = scenes.sheet(4, 1.0)
    plekton.write_mesh(tmp_path / "mesh.off", points, facets[:-1])

    mesh = plekton.import_mesh(tmp_path / "mesh.off", scale=0.5, weld=1e-6)

    said = scenes.plekton("import", tmp_path / "mesh.off", "--scale", "0.5", "--weld", "1 um", "--json")
    assert mesh.report == json.loads(said.stdout)
    np.testing.assert_array_equal(mesh.points, 0.5 * points)


@pytest.mark.parametrize(
    ("points", "facets", "message"),
    [
        (np.eye(3), [[0, 1, 3]], "3"),
        (np.eye(3), [[0, 1, -1]], r"facets\[0\]: there is no point -1"),
        (np.full((3, 3), np.inf), [[0, 1, 2]], "finite|inf"),
        (np.eye(3), [[0, 0, 1]], "mesh: "),
        (np.eye(3), [0, 1, 2], r"shape \(3\)"),
    ],
)
def test_meshes_that_cannot_be_used_are_refused(points, facets, message):
    with pytest.raises(plekton.InputError, match=message):
        plekton.repair_mesh(points, facets)


def test_what_cannot_be_written_is_refused(tmp_path):
    with pytest.raises(plekton.MeshError, match="there is no point 7; there are 3"):
        plekton.write_mesh(tmp_path / "mesh.off", np.eye(3), [[0, 1, 7]])
    with pytest.raises(plekton.MeshError, match="mesh.xyz"):
        plekton.write_mesh(tmp_path / "mesh.xyz", np.eye(3), [[0, 1, 2]])
    with pytest.raises(plekton.OutputError, match="mesh.off.part: cannot be created: No such file or directory"):
        plekton.write_mesh(tmp_path / "none" / "mesh.off", np.eye(3), [[0, 1, 2]])
    for ending in ("off", "obj", "stl", "ply", "msh", "vtp"):
        for value in (np.nan, np.inf, -np.inf, 1e75):
            with pytest.raises(plekton.MeshError, match=r"point 2 is at \(0, 0, .*finite number below"):
                plekton.write_mesh(tmp_path / f"mesh.{ending}", np.diag([1, 1, value]), [[0, 1, 2]])
    with pytest.raises(plekton.MeshError, match="below 3.4e.38 in size in binary STL"):
        plekton.write_mesh(tmp_path / "mesh.stl", 1e39 * np.eye(3), [[0, 1, 2]])
    assert not list(tmp_path.iterdir())


def test_lengths_may_be_texts_with_units():
    points, facets = scenes.sheet(4, 1.0)

    same = [plekton.repair_mesh(points, facets, weld=weld, target_edge=edge) for weld, edge in ((1e-6, 0.1), ("1 um", "10 cm"))]

    assert same[0].report == same[1].report
    assert same[0].points.tobytes() == same[1].points.tobytes()


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"weld": "1 kg"}, 'weld: got "1 kg", a mass; expected a length'),
        ({"longest_hole": None}, "longest_hole: got None; expected a length"),
        ({"wrap_detail": [1]}, r"wrap_detail: got \[1\]; expected a length"),
        ({"target_edge": "far"}, "target_edge: got .far"),
    ],
)
def test_lengths_that_are_none_are_refused(options, message):
    with pytest.raises(plekton.InputError, match=message):
        plekton.repair_mesh(np.eye(3), [[0, 1, 2]], **options)
    with pytest.raises(plekton.InputError, match="scale: got .1 mm."):
        plekton.import_mesh("mesh.off", scale="1 mm")
