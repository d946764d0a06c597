# SPDX-License-Identifier: GPL-3.0-or-later
"""What a run has written, as arrays."""

import csv
import shutil

import numpy as np
import plekton
import pytest
import scenes


@pytest.fixture(scope="module")
def written(tmp_path_factory):
    """A run, and the simulation at its end."""
    folder = tmp_path_factory.mktemp("runs") / "out"
    simulation = plekton.load(scenes.small())
    simulation.run(out=folder)
    return folder, simulation


def test_a_run_has_its_report_and_times(written):
    folder, simulation = written
    run = plekton.open_run(folder)

    assert run.report["status"] == "finished"
    assert run.report["timing"]["steps"] == simulation.steps
    assert len(run.frames) == run.report["counts"]["frames"] == 5
    np.testing.assert_allclose(run.times, [0, 0.005, 0.01, 0.015, 0.02], atol=simulation.time_step)
    assert [frame.time for frame in run.frames] == list(run.times)
    assert len(run.frames[1:3]) == 2 and run.frames[-1].time == run.times[-1]
    with pytest.raises(IndexError):
        run.frames[5]


def test_frames_have_the_places_of_the_simulation(written):
    folder, simulation = written
    last = plekton.open_run(folder).frames[-1]

    np.testing.assert_array_equal(last.grains["positions"], simulation.positions[simulation.sphere_nodes])
    np.testing.assert_array_equal(last.membranes["facets"], simulation.facets)
    np.testing.assert_array_equal(
        last.membranes["positions"], simulation.positions[simulation.nodes("membranes.sheet")]
    )
    # Fields are written as floats of 7 digits.
    np.testing.assert_allclose(last.grains["of_points"]["radius"], simulation.radii, rtol=1e-7)
    velocities = simulation.velocities[simulation.sphere_nodes]
    np.testing.assert_allclose(last.grains["of_points"]["velocity"], velocities, rtol=1e-6, atol=1e-30)
    assert last.contacts is not None


def test_histories_have_the_columns_of_their_files(written):
    folder, _ = written
    run = plekton.open_run(folder)
    with (folder / "energy.csv").open() as file:
        head, *rows = csv.reader(file)

    assert [f"{name} ({run.energy.units[name]})" if run.energy.units[name] else name for name in run.energy] == head
    table = np.array(rows, dtype=float)
    for name, column in zip(run.energy, table.T):
        np.testing.assert_array_equal(run.energy[name], column)
    assert run.reactions.units["floor.force_z"] == "N"
    assert len(run.reactions["time"]) == len(table)


def test_what_is_not_there_is_named(written, tmp_path):
    folder, _ = written
    run = plekton.open_run(folder)

    with pytest.raises(plekton.InputError, match="pressures.csv"):
        print(run.pressures)
    with pytest.raises(plekton.InputError, match="holds no run"):
        plekton.open_run(tmp_path)
    with pytest.raises(KeyError, match="energy.csv: has no column 'nothing'; there are time, kinetic, "):
        run.energy["nothing"]


def test_a_history_that_is_cut_in_its_first_line_says_so(written, tmp_path):
    folder, _ = written
    cut = shutil.copytree(folder, tmp_path / "cut")
    (cut / "energy.csv").write_bytes((folder / "energy.csv").read_bytes()[:30])

    with pytest.raises(KeyError, match="energy.csv: has no column 'kinetic'; its first line.*is cut off or just begun"):
        plekton.open_run(cut).energy["kinetic"]


def test_a_run_is_shown_as_a_page(written, tmp_path):
    folder, _ = written
    assert plekton.open_run(folder).view(tmp_path / "run.html") == tmp_path / "run.html"
    assert (tmp_path / "run.html").stat().st_size > 100_000
    with pytest.raises(plekton.InputError, match="no such page|is no page|is there"):
        (tmp_path / "mine.html").write_text("mine")
        plekton.open_run(folder).view(tmp_path / "mine.html")
