# SPDX-License-Identifier: GPL-3.0-or-later
"""Scenarios with stages, run as the program runs them."""

import os
import signal
import threading
import time

import plekton
import pytest
import scenes

BODIES = """\
[simulation]
time_step = "20 us"
[materials.sand]
density = 2650
young_modulus = "5 MPa"
friction_angle = "30 deg"
[[grains]]
name = "sand"
material = "sand"
count = 12
radius = "3 mm"
box = { min = ["-20 mm", "-20 mm", "3 mm"], max = ["20 mm", "20 mm", "30 mm"] }
[[planes]]
name = "floor"
point = [0, 0, 0]
normal = [0, 0, 1]
material = "sand"
"""
STAGES = """\
[[stages]]
name = "pour"
end = { duration = "4 ms" }
[[stages]]
name = "shake"
end = { duration = "3 ms" }
materials.sand.friction_angle = "5 deg"
"""


@pytest.fixture
def scenario(tmp_path):
    path = tmp_path / "stages.toml"
    path.write_text(BODIES + STAGES)
    return path


def last_hash(report):
    return report["states"]["step_time_hash"][-1][2]


def test_stages_run_to_the_bits_of_the_program(scenario, tmp_path):
    report = plekton.run_stages(scenario, tmp_path / "python")

    assert report["status"] == "finished"
    assert [stage["name"] for stage in report["stages"]] == ["pour", "shake"]
    assert scenes.plekton("run", scenario, "--quiet", "--out", tmp_path / "program").returncode == 0
    assert plekton.open_run(tmp_path / "program").report["states"] == report["states"]


def test_stages_one_by_one_end_in_the_same_state(scenario, tmp_path):
    whole = plekton.run_stages(scenario, tmp_path / "whole")
    first = plekton.run_stages(scenario, tmp_path / "first", until="pour")
    second = plekton.run_stages(scenario, tmp_path / "second", after=("pour", tmp_path / "first"))

    assert [stage["name"] for stage in first["stages"]] == ["pour"]
    assert last_hash(second) == last_hash(whole)


def test_a_dict_has_stages_too(tmp_path):
    scenario = {
        "simulation": {"time_step": "20 us"},
        "materials": {"sand": {"density": 2650, "young_modulus": "5 MPa", "friction_angle": "30 deg"}},
        "grains": [{"name": "one", "material": "sand", "centres": [[0, 0, 0.01]], "radii": [0.003]}],
        "planes": [{"name": "floor", "point": [0, 0, 0], "normal": [0, 0, 1], "material": "sand"}],
        "stages": [
            {"name": "fall", "end": {"duration": "1 ms"}},
            {"name": "lie", "end": {"duration": "1 ms"}},
        ],
    }

    report = plekton.run_stages(scenario, tmp_path / "out")

    assert [stage["name"] for stage in report["stages"]] == ["fall", "lie"]


def test_what_cannot_be_is_said_as_the_program_says_it(scenario, tmp_path):
    plain = tmp_path / "plain.toml"
    plain.write_text(BODIES)

    with pytest.raises(plekton.InputError, match="no \\[\\[stages\\]\\]; load\\(\\)"):
        plekton.run_stages(plain, tmp_path / "out", ["simulation.duration=1 ms"])
    with pytest.raises(plekton.InputError, match="run_stages"):
        plekton.load(scenario)
    with pytest.raises(plekton.InputError, match="shear"):
        plekton.run_stages(scenario, tmp_path / "out", until="shear")
    assert not (tmp_path / "out").exists()


def test_a_stage_that_does_not_come_to_its_end_fails_and_leaves_those_before(tmp_path):
    scenario = tmp_path / "fails.toml"
    never = 'end = { kinetic_energy = "1e-30 J" }\nmax_duration = "1 ms"'
    scenario.write_text(BODIES + STAGES.replace('end = { duration = "3 ms" }', never))

    with pytest.raises(plekton.Error, match="shake"):
        plekton.run_stages(scenario, tmp_path / "out")
    assert (tmp_path / "out" / "checkpoints").is_dir()


def test_the_run_that_stages_go_on_from_is_kept(scenario, tmp_path):
    first = tmp_path / "first"
    plekton.run_stages(scenario, first, until="pour")
    kept = {path: path.read_bytes() for path in first.rglob("*") if path.is_file()}

    with pytest.raises(plekton.InputError, match="is to be kept"):
        plekton.run_stages(scenario, first, after=("pour", first), overwrite=True)
    with pytest.raises(plekton.OutputError, match="run.json"):
        plekton.run_stages(scenario, first)
    assert {path: path.read_bytes() for path in first.rglob("*") if path.is_file()} == kept


def interrupt_once(path):
    """Ctrl-C as soon as there is a file."""

    def wait():
        while not path.exists():
            time.sleep(0.01)
        os.kill(os.getpid(), signal.SIGINT)

    threading.Thread(target=wait, daemon=True).start()


def test_an_interrupted_run_goes_on_to_the_same_bits(scenario, tmp_path):
    scenario.write_text((BODIES + STAGES).replace("4 ms", "1.5 s"))
    interrupt_once(tmp_path / "out" / "energy.csv")
    with pytest.raises(KeyboardInterrupt):
        plekton.run_stages(scenario, tmp_path / "out")
    assert plekton.open_run(tmp_path / "out").report["interrupted"]

    report = plekton.resume_stages(tmp_path / "out")

    assert report["status"] == "finished"
    assert last_hash(report) == last_hash(plekton.run_stages(scenario, tmp_path / "whole"))
