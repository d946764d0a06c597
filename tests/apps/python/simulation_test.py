# SPDX-License-Identifier: GPL-3.0-or-later
"""Arrays of a simulation: views that follow it, keep it, and cannot be written."""

import gc
import weakref

import numpy as np
import plekton
import pytest
import scenes

BY_NODE = {
    "positions": 3,
    "velocities": 3,
    "angular_velocities": 3,
    "orientations": 4,
    "forces": 3,
    "torques": 3,
    "masses": 1,
    "inertias": 1,
}
VIEWS = [*BY_NODE, "radii", "sphere_nodes"]


@pytest.fixture
def simulation():
    return plekton.load(scenes.small())


def address(array):
    return array.__array_interface__["data"][0]


def test_arrays_have_a_row_for_each_node_or_sphere(simulation):
    centres, radii = scenes.spheres(20)
    points, facets = scenes.sheet(4, 0.2)
    nodes = len(points) + len(centres)

    for name, columns in BY_NODE.items():
        expected = (nodes,) if columns == 1 else (nodes, columns)
        assert getattr(simulation, name).shape == expected, name
    np.testing.assert_array_equal(simulation.positions, np.concatenate([points, centres]))
    np.testing.assert_array_equal(simulation.radii, radii)
    np.testing.assert_array_equal(simulation.positions[simulation.sphere_nodes], centres)
    np.testing.assert_array_equal(simulation.facets, facets)
    np.testing.assert_array_equal(simulation.orientations, np.tile([0, 0, 0, 1], (nodes, 1)))
    np.testing.assert_array_equal(simulation.velocities[simulation.nodes("grains.gravel")], [[0, 0, -1]] * 20)
    # A sphere has 4/3 pi r^3 of 2650 kg/m3, to a few roundings.
    np.testing.assert_allclose(
        simulation.masses[simulation.sphere_nodes], 2650 * 4 / 3 * np.pi * radii**3, rtol=1e-14
    )


@pytest.mark.parametrize("name", VIEWS)
def test_a_view_copies_nothing_and_follows_the_simulation(simulation, name):
    first = getattr(simulation, name)
    simulation.run(until=0.01)
    now = getattr(simulation, name)

    assert address(now) == address(first)
    assert first.base is not None
    np.testing.assert_array_equal(first, now)


def test_positions_move(simulation):
    before = simulation.positions.copy()
    view = simulation.positions

    simulation.step(100)

    assert (view[simulation.sphere_nodes, 2] < before[simulation.sphere_nodes, 2]).all()


@pytest.mark.parametrize("name", VIEWS)
def test_a_view_cannot_be_written_nor_made_writeable(simulation, name):
    view = getattr(simulation, name)

    with pytest.raises(ValueError, match="read-only"):
        view[...] = 0
    with pytest.raises(ValueError, match="WRITEABLE"):
        view.flags.writeable = True


@pytest.mark.parametrize("name", VIEWS)
def test_a_view_keeps_its_memory_when_the_simulation_is_gone(name):
    simulation = plekton.load(scenes.small())  # no fixture: pytest would keep it
    gone = weakref.ref(simulation)
    simulation.step(5)
    view = getattr(simulation, name)
    part = view[3:7]
    expected, expected_part = view.copy(), part.copy()

    del simulation
    gc.collect()
    assert gone() is None
    others = [plekton.load(scenes.small()) for _ in range(3)]  # which would take freed memory

    np.testing.assert_array_equal(view, expected)
    np.testing.assert_array_equal(part, expected_part)
    assert len(others) == 3


def test_a_view_keeps_its_rows_where_elements_break(simulation):
    views = {name: getattr(simulation, name) for name in VIEWS}
    facets = simulation.facets
    bars = simulation.bars
    kept = facets.copy()

    simulation.break_facet(facets[5])
    simulation.break_bond(0)
    simulation.step(2)

    assert len(simulation.facets) < len(facets)
    assert len(simulation.bars) == len(bars) - 1
    np.testing.assert_array_equal(facets, kept)
    simulation.run(until=0.005)
    for name, view in views.items():
        assert address(getattr(simulation, name)) == address(view), name
        np.testing.assert_array_equal(getattr(simulation, name), view)


def test_a_view_of_before_a_restore_shows_what_was_then(simulation, tmp_path):
    simulation.step(10)
    simulation.save(tmp_path / "state.h5")
    simulation.step(10)
    view = simulation.positions
    expected = view.copy()

    simulation.restore(tmp_path / "state.h5")
    simulation.step(1)

    assert address(simulation.positions) != address(view)
    np.testing.assert_array_equal(view, expected)


def test_a_scene_without_spheres_has_empty_arrays():
    scene = scenes.small()
    del scene["grains"]
    simulation = plekton.load(scene)

    assert simulation.radii.shape == (0,)
    assert simulation.sphere_nodes.shape == (0,)
    assert simulation.bars.shape[1:] == (2,)


def test_contacts_have_the_columns_of_contacts_csv_and_balance_the_weight():
    scene = scenes.small(duration=1.0, damping=0.3)
    simulation = plekton.load(scene)
    simulation.run(until=0.3)

    contacts = simulation.contacts()

    names = contacts.dtype.names
    for name in ("id", "kind_a", "body_b", "point", "normal", "gap", "normal_force", "tangential_force"):
        assert name in names
    assert len(contacts) > 0
    assert len(set(contacts["id"])) == len(contacts)
    lengths = np.linalg.norm(contacts["normal"], axis=1)
    np.testing.assert_allclose(lengths, 1.0, rtol=1e-15)
    assert (contacts["gap"] < 0.0).all()
    # Repulsion is along the normal from a to b; its magnitude is a column of its own.
    along = np.einsum("ij,ij->i", contacts["normal_force"], contacts["normal"])
    np.testing.assert_allclose(along, contacts["normal_force_magnitude"], rtol=1e-13, atol=1e-15)
    # Forces on the nodes of spheres are those of their contacts: b gets the force, a the opposite.
    forces = np.zeros((20, 3))
    both = contacts["normal_force"] + contacts["tangential_force"]
    for kind, body, sign in (("kind_a", "body_a", -1.0), ("kind_b", "body_b", 1.0)):
        spheres = contacts[kind] == 0
        np.add.at(forces, contacts[body][spheres], sign * both[spheres])
    np.testing.assert_allclose(
        forces, simulation.forces[simulation.sphere_nodes], rtol=1e-12, atol=1e-12 * np.abs(both).max()
    )


def test_reactions_are_read_by_name():
    scene = scenes.small(duration=1.0, damping=0.3)
    simulation = plekton.load(scene)
    simulation.run(until=0.3)
    contacts = simulation.contacts()

    caught = simulation.reaction("caught")

    # Of the sheet alone; between a sphere and a structure the sphere is a.
    on_sheet = (contacts["kind_b"] >= 1) & (contacts["kind_b"] <= 3) & (contacts["kind_a"] == 0)
    both = (contacts["normal_force"] + contacts["tangential_force"])[on_sheet]
    np.testing.assert_allclose(caught.force, both.sum(axis=0), rtol=1e-12, atol=1e-12)
    assert caught.force.shape == caught.moment.shape == caught.position.shape == (3,)
    assert simulation.reaction("rim").force[2] < 0.0
    with pytest.raises(plekton.InputError, match='there is no reaction "flor"; did you mean "floor"'):
        simulation.reaction("flor")


def test_energies_add_up(simulation):
    simulation.run(until=0.01)
    energy = simulation.energy()

    total = (
        energy.kinetic + energy.contact_elastic + energy.bond_elastic + energy.sheet_elastic + energy.gravity
        + energy.friction + energy.tracking + energy.bond_dissipated + energy.damping
        - energy.external_work - energy.initial
    )  # fmt: skip
    assert energy.closure_error() == pytest.approx(total, abs=1e-15)
    assert abs(total) < 0.01 * energy.initial


def test_tables_are_found_by_name(simulation):
    assert list(simulation.nodes("membranes.sheet")) == list(range(25))
    assert list(simulation.nodes("grains.gravel")) == list(range(25, 45))
    with pytest.raises(plekton.InputError, match='there is no table "grains.gravl"; did you mean "grains.gravel"'):
        simulation.nodes("grains.gravl")


def test_held_nodes_can_be_given_a_velocity(simulation):
    rim = simulation.nodes("membranes.sheet")[:5]
    before = simulation.positions[rim].copy()

    simulation.set_velocity(rim, [0, 0, 0.5])
    simulation.run(until=0.002)

    # A motion at constant velocity, summed over steps, to an end that is met to a thousandth of a step.
    assert abs(simulation.time - 0.002) <= 1e-3 * simulation.time_step
    np.testing.assert_allclose(simulation.positions[rim] - before, [[0, 0, 0.5 * simulation.time]] * 5, rtol=1e-9, atol=1e-15)
    simulation.set_velocity(rim, np.zeros((5, 3)))
    simulation.step(1)
    assert (simulation.velocities[rim] == 0.0).all()


def test_a_truth_value_for_each_node_chooses_nodes(simulation):
    chosen = np.zeros(len(simulation.positions), bool)
    chosen[simulation.nodes("membranes.sheet")[1:3]] = True

    simulation.set_velocity(chosen, [0, 0, 0.5])
    simulation.step(1)

    np.testing.assert_array_equal(simulation.velocities[:, 2] == 0.5, chosen)


# Their spin was replaced by that of the call: 0 if none is given.
def test_held_nodes_that_are_free_to_turn_turn_on_when_given_a_velocity():
    scene = scenes.small(gravity=[0, 0, 0])
    scene["rigid_bodies"] = [
        {
            "name": "top",
            "shape": {"kind": "box", "size": [0.2, 0.1, 0.02]},
            "translate": [0, 0, 1],
            "thickness": "10 mm",
            "material": "gravel",
            "density": 2000,
            "hold": "xyz",
            "hold_rotation": "x",
            "angular_velocity": [0, 0, 5],
        }
    ]
    simulation = plekton.load(scene)
    simulation.step(1)
    node = [int(np.argmax(simulation.masses))]  # the reference node of the body

    simulation.set_velocity(node, [0, 0, 1], [2, 0, 0])

    np.testing.assert_array_equal(simulation.velocities[node], [[0, 0, 1]])
    # A body keeps its angular momentum: the spin comes back through its inertia.
    np.testing.assert_allclose(simulation.angular_velocities[node], [[2, 0, 5]], rtol=1e-15)
    with pytest.raises(plekton.InputError, match=f"node {node[0]} is free to turn, torques say how"):
        simulation.set_velocity(node, [0, 0, 1], [0, 0, 4])


@pytest.mark.parametrize(
    ("nodes", "velocity", "message"),
    [
        ([12], [0, 0, 1], "node 12 is free"),
        ([True, False], [0, 0, 1], "got 2 truth values; expected one for each of the 45 nodes"),
        ([2.9], [0, 0, 1], "nodes: got numbers of type float64; expected whole numbers"),
        ([99], [0, 0, 1], "there is no node 99; there are 45"),
        ([-1], [0, 0, 1], "there is no node -1"),
        ([0], [0, 1], "expected three components"),
        ([0, 1], np.zeros((3, 3)), "got 2 nodes, 3 velocities"),
        ([0], [0, 0, np.nan], "the velocity of node 0 is not finite"),
    ],
)
def test_velocities_that_cannot_be_given_are_refused(simulation, nodes, velocity, message):
    before = simulation.velocities.copy()

    with pytest.raises(plekton.InputError, match=message):
        simulation.set_velocity(nodes, velocity)

    np.testing.assert_array_equal(simulation.velocities, before)


def test_contacts_have_the_columns_of_the_file(tmp_path):
    simulation = plekton.load(scenes.rain(count=100, cells=4, duration=0.02) | {"output": {"contact_list": True}})
    simulation.run(out=tmp_path / "out")

    contacts = simulation.contacts()

    columns = plekton.open_run(tmp_path / "out").history("contacts.csv")
    last = columns["time"] == columns["time"][-1]
    assert 0 < len(contacts) == last.sum()
    for name in contacts.dtype.names:
        vector = contacts[name].ndim == 2
        for k, column in enumerate((f"{name}_x", f"{name}_y", f"{name}_z") if vector else (name,)):
            np.testing.assert_array_equal(contacts[name][:, k] if vector else contacts[name], columns[column][last])
    assert len(columns) == 1 + sum(3 if contacts[name].ndim == 2 else 1 for name in contacts.dtype.names)
    assert {"group_a", "material_a", "group_b", "material_b"} <= set(contacts.dtype.names)
