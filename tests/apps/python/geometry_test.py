# SPDX-License-Identifier: GPL-3.0-or-later
"""Queries with arrays in and out, against what numpy computes of all pairs."""

import threading

import numpy as np
import plekton
import pytest
import scenes

ROUNDING = 1e-12  # of lengths of about 1 m: the relative error that queries promise


def nearest_on_triangles(points, corners):
    """Distance of each point from each triangle: the foot on the plane where it is inside, else that of the sides.

    points (N, 3), corners (M, 3, 3); a second way to the answer, not that of the library.
    """
    a, b, c = (corners[None, :, k] for k in range(3))
    p = points[:, None]
    distances = np.full((len(points), len(corners)), np.inf)
    for x0, x1 in ((a, b), (b, c), (c, a)):
        along = x1 - x0
        t = np.clip(((p - x0) * along).sum(-1) / (along * along).sum(-1), 0, 1)
        distances = np.minimum(distances, np.linalg.norm(p - x0 - t[..., None] * along, axis=-1))
    normal = np.cross(b - a, c - a)
    inside = np.ones(distances.shape, bool)
    for x0, x1 in ((a, b), (b, c), (c, a)):
        inside &= (np.cross(x1 - x0, p - x0) * normal).sum(-1) > 0
    height = np.abs(((p - a) * normal).sum(-1)) / np.linalg.norm(normal, axis=-1)
    return np.where(inside, np.minimum(height, distances), distances)


@pytest.fixture
def rough():
    """A sheet with hills."""
    points, facets = scenes.sheet(8, 2.0)
    points[:, 2] = 0.2 * np.sin(3 * points[:, 0]) * np.cos(2 * points[:, 1])
    return points, facets


def cube():
    """A closed box from (0, 0, 0) to (1, 1, 1)."""
    points = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], float)
    facets = [[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1],
              [2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4], [1, 5, 7], [1, 7, 3]]  # fmt: skip
    return points, np.array(facets)


def test_the_nearest_facet_is_that_of_all_pairs(rough):
    points, facets = rough
    asked = np.random.default_rng(3).uniform(-1.5, 1.5, (500, 3))
    expected = nearest_on_triangles(asked, points[facets])

    found = plekton.Surface(points, facets).nearest(asked)

    np.testing.assert_allclose(found["gap"], expected.min(axis=1), rtol=ROUNDING, atol=ROUNDING)
    np.testing.assert_allclose(expected[np.arange(500), found["cell"]], found["gap"], rtol=ROUNDING, atol=ROUNDING)
    # The nearest point is where the normal leads.
    np.testing.assert_allclose(asked + found["gap"][:, None] * found["normal"], found["point"], atol=ROUNDING)
    assert set(found["feature_kind"]) == {0, 1, 2}


def test_thickness_and_balls_shorten_the_gap(rough):
    points, facets = rough
    asked = np.random.default_rng(4).uniform(-1.5, 1.5, (50, 3))
    plain = plekton.Surface(points, facets).nearest(asked)

    thick = plekton.Surface(points, facets, radius=0.25).nearest(asked, radius=0.125, threads=2)

    np.testing.assert_allclose(thick["gap"], plain["gap"] - 0.375, rtol=0, atol=ROUNDING)


def test_rays_hit_what_is_first_along_them(rough):
    points, facets = rough
    random = np.random.default_rng(5)
    origins = np.column_stack([random.uniform(-0.9, 0.9, (200, 2)), np.full(200, 3.0)])
    surface = plekton.Surface(points, facets)

    down = surface.rays(origins, np.tile([0, 0, -2.0], (200, 1)))
    up = surface.rays(origins, np.tile([0, 0, 1.0], (200, 1)))
    short = surface.rays(origins, np.tile([0, 0, -2.0], (200, 1)), t_end=0.5)

    # The height of the one facet above or below: barycentric coordinates in the plane.
    corners = points[facets][down["cell"]]
    matrix = np.concatenate([corners[:, :, :2].transpose(0, 2, 1), np.ones((200, 1, 3))], axis=1)
    weights = np.linalg.solve(matrix, np.column_stack([origins[:, :2], np.ones(200)])[..., None])[..., 0]
    assert (weights > -1e-9).all()
    height = (weights * corners[:, :, 2]).sum(axis=1)
    np.testing.assert_allclose(down["t"], (3.0 - height) / 2.0, rtol=ROUNDING)
    assert (up["cell"] == -1).all() and np.isinf(up["t"]).all()
    assert (short["cell"] == -1).all()


def test_inside_and_outside_of_a_box_are_those_of_its_coordinates():
    points, facets = cube()
    asked = np.concatenate([np.random.default_rng(6).uniform(-0.5, 1.5, (300, 3)), points, [[0.5, 0.5, 0.0]]])
    surface = plekton.Surface(points, facets)

    inside = ((asked > 0) & (asked < 1)).all(axis=1)
    outside = ((asked < 0) | (asked > 1)).any(axis=1)
    np.testing.assert_array_equal(surface.side(asked), outside.astype(int) - inside.astype(int))

    beyond = np.maximum(np.maximum(-asked, asked - 1), 0)
    depth = np.minimum(asked, 1 - asked).min(axis=1)
    expected = np.where(inside, -depth, np.linalg.norm(beyond, axis=1))
    np.testing.assert_allclose(surface.signed_distance(asked), expected, rtol=ROUNDING, atol=ROUNDING)
    assert surface.is_closed and len(surface) == 12


def test_an_open_surface_has_no_inside(rough):
    surface = plekton.Surface(*rough)

    assert not surface.is_closed
    with pytest.raises(plekton.Error, match="edge"):
        surface.side([[0, 0, 0]])


def test_a_surface_moves():
    points, facets = cube()
    surface = plekton.Surface(points, facets)
    surface.move(points + [10, 0, 0])

    assert surface.nearest([[0.5, 0.5, 0.5]])["gap"][0] == pytest.approx(9.5)
    with pytest.raises(plekton.InputError):
        surface.move(points[:5])
    assert surface.nearest([[0.5, 0.5, 0.5]])["gap"][0] == pytest.approx(9.5)


def test_the_distance_of_two_surfaces():
    points, facets = cube()
    one = plekton.Surface(points, facets, radius=0.1)
    other = plekton.Surface(points + [0, 0, 2], facets, radius=0.2)

    _, _, gap, normal = one.nearest_surface(other)

    assert gap == pytest.approx(0.7)
    np.testing.assert_allclose(normal, [0, 0, 1], atol=ROUNDING)


def test_pairs_of_spheres_are_those_of_all_distances():
    random = np.random.default_rng(7)
    centres, radii = random.uniform(0, 1, (300, 3)), random.uniform(0.01, 0.05, 300)
    gaps = np.linalg.norm(centres[:, None] - centres[None], axis=-1) - radii[:, None] - radii[None]
    expected = [(i, j) for i, j in zip(*np.nonzero(gaps < 0.03)) if i < j]

    found = plekton.pairs(0.03, centres=centres, radii=radii)

    assert [(row["a"], row["b"]) for row in found] == expected
    np.testing.assert_allclose(found["gap"], gaps[found["a"], found["b"]], rtol=0, atol=ROUNDING)
    assert (found["kind_a"] == 0).all() and (found["kind_b"] == 0).all()


def test_pairs_of_spheres_with_facets_and_bars(rough):
    points, facets = rough
    random = np.random.default_rng(8)
    centres = random.uniform(-1.2, 1.2, (60, 3))
    ends = np.array([[-1, -1, 0.8], [1, 1, 0.8]])
    distances = nearest_on_triangles(centres, points[facets]) - 0.05 - 0.01

    found = plekton.pairs(0.1, centres=centres, radii=0.05, points=np.concatenate([points, ends]),
                          facets=facets, bars=[[81, 82]], radius=0.01)  # fmt: skip

    with_facets = found[(found["kind_a"] == 0) & (found["kind_b"] == 1)]
    expected = set(zip(*map(np.ndarray.tolist, np.nonzero(distances < 0.1))))
    assert set(zip(with_facets["a"].tolist(), with_facets["b"].tolist())) == expected
    t = np.clip(((centres - ends[0]) @ (ends[1] - ends[0])) / 8, 0, 1)
    to_bar = np.linalg.norm(centres - ends[0] - t[:, None] * (ends[1] - ends[0]), axis=1) - 0.06
    with_bar = found[(found["kind_a"] == 0) & (found["kind_b"] == 2)]
    assert set(with_bar["a"].tolist()) == set(np.nonzero(to_bar < 0.1)[0].tolist())
    assert (with_bar["b"] == 0).all()


def test_the_first_contact_of_balls_is_that_of_the_quadratic():
    a0, a1 = np.array([0.0, 0, 0]), np.array([2.0, 0.3, 0])
    b0, b1 = np.array([1.0, 0.1, 0.05]), np.array([0.9, 0.2, 0.1])
    d, v = b0 - a0, (b1 - b0) - (a1 - a0)
    # |d + t v| = 0.3
    p, q = d @ v / (v @ v), (d @ d - 0.09) / (v @ v)
    expected = -p - np.sqrt(p * p - q)

    t, gap, normal = plekton.first_contact([a0], [a1], 0.1, [b0], [b1], 0.2)

    assert t <= expected
    assert t == pytest.approx(expected, abs=1e-11)
    assert abs(gap) < 1e-12
    assert np.linalg.norm(normal) == pytest.approx(1.0)
    assert plekton.first_contact([a0], [a0], 0.1, [b0], [b1], 0.2) is None


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: plekton.Surface(np.zeros((3, 2)), [[0, 1, 2]]), r"points: got an array of shape \(3, 2\); expected"),
        (lambda: plekton.Surface(np.eye(3), [[0, 1, 3]]), "3"),
        (lambda: plekton.Surface(np.eye(3), [[0, 1, -1]]), r"facets\[0\]: there is no node -1"),
        (lambda: plekton.Surface(np.eye(3), [[0, 1]]), r"facets: got an array of shape \(1, 2\)"),
        (lambda: plekton.Surface(np.eye(3), [[0, 1, 2]], radius=-1), "radius"),
        (lambda: plekton.Surface(np.eye(3), [[0, 1, 2]]).nearest([[0, 0, np.nan]]), "finite"),
        (lambda: plekton.Surface(np.eye(3), [[0, 1, 2]]).nearest(np.eye(3), radius=[1, 2]), "radius: got 2 numbers"),
        (lambda: plekton.Surface(np.eye(3), [[0, 1, 2]]).rays(np.eye(3), [[0, 0, 1]]), "got 3 origins and 1"),
        (lambda: plekton.Surface(np.eye(3), [[0, 1, 2]]).rays([[0, 0, np.nan]], [[0, 0, 1]]), r"origins\[0\]: got \(0, 0, nan\) m; coordinates must be finite and below 1e75"),
        (lambda: plekton.Surface(np.eye(3), [[0, 1, 2]]).rays([[0, 0, -1e75]], [[0, 0, 1]]), r"origins\[0\]: got"),
        (lambda: plekton.Surface(np.eye(3), [[0, 1, 2]]).rays(np.eye(3), [[0, 0, 1], [0, 0, np.inf], [0, 0, 1]]), r"directions\[1\]: got \(0, 0, inf\); the length must be from 1e-150 to 1e150"),
        (lambda: plekton.Surface(np.eye(3), [[0, 1, 2]]).rays([[0, 0, 1]], [[0, 0, 0]]), r"directions\[0\]: got \(0, 0, 0\)"),
        (lambda: plekton.Surface(np.eye(3), [[0, 1, 2]]).rays([[0, 0, 1]], [[0, 0, 1e160]]), r"directions\[0\]: got \(0, 0, 1e\+160\)"),
        (lambda: plekton.Surface(np.eye(3), [[0, 1, 2]]).rays([[0, 0, 1]], [[0, 0, 1]], t_end=np.nan), r"t_end\[0\]: got nan; it must be at least 0"),
        (lambda: plekton.Surface(np.eye(3), [[0, 1, 2]]).rays([[0, 0, 1]], [[0, 0, 1]], t_end=-1), r"t_end\[0\]: got -1; it must be at least 0"),
        (lambda: plekton.pairs(-1, centres=np.eye(3), radii=1), "gap"),
        (lambda: plekton.pairs(1, centres=[[0, 0, 0], [0, np.nan, 0]], radii=1), r"centres\[1\]: got no number"),
        (lambda: plekton.first_contact(np.zeros((4, 3)), np.zeros((4, 3)), 1, np.eye(3), np.eye(3), 1), "4 corners"),
    ],
)  # fmt: skip
def test_what_cannot_be_asked_is_refused(call, message):
    with pytest.raises(plekton.InputError, match=message):
        call()


@pytest.mark.parametrize("facets", [[[0.2, 1.0, 2.5]], np.array([[0.2, 1.0, 2.5]]), [["0", "1", "2"]], [[0, 1, 2], [0]]])
def test_numbers_of_nodes_are_whole(facets, tmp_path):
    """Of lists fractions were cut off without a word."""
    points = np.eye(3)
    for call in (
        lambda: plekton.Surface(points, facets),
        lambda: plekton.pairs(1, points=points, facets=facets),
        lambda: plekton.repair_mesh(points, facets),
        lambda: plekton.write_mesh(tmp_path / "a.off", points, facets),
    ):
        with pytest.raises(plekton.InputError, match="^facets: got .*; expected whole numbers$"):
            call()
    assert not list(tmp_path.iterdir())
    with pytest.raises(plekton.InputError, match="^bars: got numbers of type float64; expected whole numbers$"):
        plekton.Surface(points, bars=[[0.2, 1.0]])


# Queries without Python's lock read boxes that were being replaced: most found nothing.
def test_a_surface_is_not_moved_while_another_thread_asks_it():
    points, facets = [[-1, -1, 0], [3, -1, 0], [-1, 3, 0]], [[0, 1, 2]]
    surface = plekton.Surface(points, facets)
    asked = np.tile([0.0, 0.0, 1.0], (200_000, 1))
    ended = threading.Event()
    gaps = set()

    def ask():
        for _ in range(5):
            gaps.update(surface.nearest(asked)["gap"].tolist())
        ended.set()

    thread = threading.Thread(target=ask)
    thread.start()
    refused = 0
    while not ended.is_set():
        try:
            surface.move(points)
        except plekton.Error as error:
            assert "another thread asks this surface" in str(error)
            refused += 1
    thread.join()

    assert gaps == {1.0}
    assert refused > 0
    surface.move(points)


def test_pairs_are_of_points_that_there_are():
    points, centres = np.eye(3), [[0, 0, 5], [3, 3, 3]]

    with pytest.raises(plekton.InputError, match=r"facets\[0\]: there is no point 3; there are 3"):
        plekton.pairs(10, centres=centres, radii=0.1, points=points, facets=[[0, 1, 3]])
    with pytest.raises(plekton.InputError, match=r"bars\[0\]: there is no point 0; there are 0"):
        plekton.pairs(10, centres=centres, radii=0.1, bars=[[0, 2]])
