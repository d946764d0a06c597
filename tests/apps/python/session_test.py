# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs, with results and without, and checkpoints."""

import os
import signal
import threading
from pathlib import Path

import numpy as np
import plekton
import pytest
import scenes


@pytest.fixture
def simulation():
    return plekton.load(scenes.small())


def test_a_run_ends_at_the_time_that_is_asked_for(simulation):
    simulation.run(until="5 ms")
    assert simulation.time == pytest.approx(0.005, rel=1e-12)
    simulation.run()
    assert simulation.time == pytest.approx(simulation.duration, rel=1e-12)
    steps = simulation.steps
    simulation.run(until=0.001)  # is over
    assert simulation.steps == steps


def test_steps_are_counted(simulation):
    simulation.step()
    simulation.step(9)

    assert simulation.steps == 10
    with pytest.raises(plekton.InputError, match="step: got -1"):
        simulation.step(-1)


def test_the_same_bits_with_any_number_of_threads():
    hashes = set()
    for threads in (1, 2, 3):
        simulation = plekton.load(scenes.small(threads=threads))
        simulation.run(until=0.01)
        hashes.add(simulation.hash)

    assert len(hashes) == 1


def test_a_run_with_a_folder_writes_what_the_program_writes(simulation, tmp_path):
    report = simulation.run(out=tmp_path / "out")

    assert report["status"] == "finished"
    assert report["states"]["step_time_hash"][-1][2] == simulation.hash
    assert {path.name for path in (tmp_path / "out").iterdir()} == {
        "run.json", "energy.csv", "reactions.csv", "planes.csv", "scenario-as-run.toml", "checkpoints", "frames",
        "grains.pvd", "membranes.pvd", "contacts.pvd",
    }  # fmt: skip


def test_writing_results_changes_no_bit(simulation, tmp_path):
    alone = plekton.load(scenes.small())
    alone.run()

    simulation.run(out=tmp_path / "out", every={"1 ms": lambda s: s.positions.sum()})

    assert simulation.hash == alone.hash


@pytest.mark.skipif(scenes.PROGRAM is None, reason="PLEKTON_PROGRAM is not set")
def test_the_program_runs_the_scenario_that_a_dict_left_behind(simulation, tmp_path):
    report = simulation.run(out=tmp_path / "out")

    again = scenes.plekton("run", tmp_path / "out/scenario-as-run.toml", "--out", tmp_path / "again", "--quiet")

    assert again.returncode == 0, again.stderr
    other = plekton.open_run(tmp_path / "again").report
    assert other["states"]["chain"] == report["states"]["chain"]
    for name in ("energy.csv", "reactions.csv"):
        assert (tmp_path / "again" / name).read_bytes() == (tmp_path / "out" / name).read_bytes()


def test_results_are_not_replaced_unasked(tmp_path):
    plekton.load(scenes.small()).run(until=0.001, out=tmp_path)
    with pytest.raises(plekton.OutputError, match="run.json"):
        plekton.load(scenes.small()).run(until=0.001, out=tmp_path)
    plekton.load(scenes.small()).run(until=0.001, out=tmp_path, overwrite=True)


def test_results_begin_with_the_run(simulation, tmp_path):
    simulation.step(3)
    with pytest.raises(plekton.Error, match="has made steps up to 3 already"):
        simulation.run(out=tmp_path / "out")
    assert not (tmp_path / "out").exists()


def test_a_state_is_saved_and_restored_to_the_bit(simulation, tmp_path):
    simulation.run(until=0.005)
    simulation.save(tmp_path / "state.h5")
    saved = simulation.hash
    simulation.step(50)
    later = simulation.hash

    simulation.restore(tmp_path / "state.h5")
    assert simulation.hash == saved
    simulation.step(50)
    assert simulation.hash == later

    other = plekton.load(scenes.small(threads=2))
    other.restore(tmp_path / "state.h5")
    other.step(50)
    assert other.hash == later

    alone = plekton.resume(tmp_path / "state.h5")
    assert (alone.hash, alone.duration) == (saved, simulation.duration)
    alone.step(50)
    assert alone.hash == later


def test_a_run_goes_on_from_its_folder_as_if_it_had_not_stopped(tmp_path):
    whole = plekton.load(scenes.small()).run(out=tmp_path / "whole")
    plekton.load(scenes.small()).run(out=tmp_path / "parts", every={"7 ms": lambda s: s.stop()})

    rest = plekton.resume(tmp_path / "parts")
    stopped = rest.time
    report = rest.run(out=tmp_path / "parts")

    assert 0.006 < stopped < 0.008
    assert report["states"]["chain"] == whole["states"]["chain"]
    for file in sorted((tmp_path / "whole").rglob("*")):
        name = file.relative_to(tmp_path / "whole")
        if file.is_file() and file.suffix in (".csv", ".vtp", ".pvd"):
            assert (tmp_path / "parts" / name).read_bytes() == file.read_bytes(), name


# It took the folder for its own, whose files then went on with rows of another run.
def test_a_refused_run_leaves_the_simulation_and_the_folder_as_they_were(tmp_path):
    plekton.load(scenes.small(damping=0.3)).run(out=tmp_path / "other")
    plekton.load(scenes.small()).run(out=tmp_path / "parts", every={"7 ms": lambda s: s.stop()})
    whole = plekton.load(scenes.small())
    whole.run(out=tmp_path / "whole")
    rest = plekton.resume(tmp_path / "parts")
    stopped, state = rest.time, rest.hash

    with pytest.raises(plekton.OutputError, match="holds results of an earlier run"):
        rest.run(out=tmp_path / "other")
    assert (rest.time, rest.hash) == (stopped, state)
    rest.run(out=tmp_path / "other", overwrite=True)

    assert rest.hash == whole.hash
    times = plekton.open_run(tmp_path / "other").energy["time"]
    assert min(times) >= stopped - rest.time_step


# The page of the other run was made, in its folder.
def test_a_refused_run_of_a_loaded_scene_has_no_results_to_show(simulation, tmp_path, monkeypatch):
    plekton.load(scenes.small(damping=0.3)).run(until=0.001, out=tmp_path / "other")
    with pytest.raises(plekton.OutputError):
        simulation.run(out=tmp_path / "other")

    monkeypatch.chdir(tmp_path)
    page = simulation.view()

    assert page.resolve() == tmp_path / "view.html"
    assert not (tmp_path / "other" / "view.html").exists()


def test_a_resumed_run_can_go_on_without_results(tmp_path):
    plekton.load(scenes.small()).run(out=tmp_path / "out", every={"7 ms": lambda s: s.stop()})
    whole = plekton.load(scenes.small())
    whole.run()

    rest = plekton.resume(tmp_path / "out")
    rest.run()

    assert rest.hash == whole.hash


def test_a_state_replaces_no_file_but_an_earlier_state(simulation, tmp_path):
    file = tmp_path / "state.h5"
    file.write_text("mine")

    with pytest.raises(plekton.InputError, match="is there already and no checkpoint of Plekton"):
        simulation.save(file)

    assert file.read_text() == "mine"
    file.unlink()
    simulation.save(file)
    simulation.save(file)


def test_a_run_that_goes_on_from_before_a_damaged_checkpoint_warns(simulation, tmp_path):
    simulation.run(out=tmp_path / "out")
    assert plekton.resume(tmp_path / "out").steps > 0  # without a warning
    last = sorted((tmp_path / "out" / "checkpoints").iterdir())[-1]
    (last.parent / "step_999999999999.h5").write_bytes(last.read_bytes()[:2000])

    with pytest.warns(UserWarning) as told:
        plekton.resume(tmp_path / "out")

    assert "step_999999999999.h5: is damaged" in str(told[0].message)
    assert "goes on from an earlier checkpoint" in str(told[1].message)


def test_a_saved_state_has_no_results_to_go_on_with(simulation, tmp_path):
    simulation.step(5)
    simulation.save(tmp_path / "state.h5")
    with pytest.raises(plekton.Error, match="is of no run with results"):
        plekton.resume(tmp_path / "state.h5").run(out=tmp_path / "out")


def test_what_would_make_it_another_run_is_refused(simulation, tmp_path):
    simulation.save(tmp_path / "state.h5")
    assert plekton.resume(tmp_path / "state.h5", ["simulation.duration=1 s"]).duration == 1.0
    with pytest.raises(plekton.InputError, match="would make it another run"):
        plekton.resume(tmp_path / "state.h5", ["simulation.damping=0.5"])


def test_checkpoints_of_other_scenes_and_damaged_ones_are_refused(simulation, tmp_path):
    other = scenes.small()
    other["grains"][0]["centres"] = other["grains"][0]["centres"][:10]
    other["grains"][0]["radii"] = other["grains"][0]["radii"][:10]
    plekton.load(other).save(tmp_path / "other.h5")
    before = simulation.hash
    with pytest.raises(plekton.CheckpointError):
        simulation.restore(tmp_path / "other.h5")
    bytes_ = bytearray((tmp_path / "other.h5").read_bytes())
    bytes_[-100] ^= 1
    (tmp_path / "damaged.h5").write_bytes(bytes_)
    with pytest.raises(plekton.CheckpointError, match="damaged.h5"):
        simulation.restore(tmp_path / "damaged.h5")
    with pytest.raises(plekton.CheckpointError, match="none.h5"):
        plekton.resume(tmp_path / "none.h5")
    assert simulation.hash == before
    simulation.step(1)


def test_control_c_leaves_a_run_that_can_go_on(tmp_path):
    timer = threading.Timer(0.5, os.kill, (os.getpid(), signal.SIGINT))
    long = plekton.load(scenes.rain(count=200, duration=100.0))
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        long.run(out=tmp_path / "out")

    run = plekton.open_run(tmp_path / "out")
    assert run.report["status"] == "interrupted"
    assert plekton.resume(tmp_path / "out").steps == long.steps > 0


def test_a_simulation_is_shown_as_a_page(simulation, tmp_path):
    simulation.run(until=0.002)
    page = simulation.view(tmp_path / "now.html")
    assert page == tmp_path / "now.html"
    assert b"<html" in page.read_bytes()[:1000].lower()

    written = plekton.load(scenes.small())
    written.run(until=0.006, out=tmp_path / "out")
    assert Path(written.view()) == tmp_path / "out/view.html"
    assert (tmp_path / "out/view.html").stat().st_size > 100_000


def test_a_start_that_cannot_be_is_refused():
    scene = scenes.small()
    scene["grains"][0]["centres"] = np.array(scene["grains"][0]["centres"]) - [0, 0, 1]
    with pytest.raises(plekton.InputError, match="floor"):
        plekton.load(scene)
