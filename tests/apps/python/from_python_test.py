# SPDX-License-Identifier: GPL-3.0-or-later
"""What a scenario can say a dict can, with the same bits and the same messages."""

import copy
import datetime
import json
import tomllib

import numpy as np
import plekton
import pytest
import scenes


def toml_of(points, facets, centres, radii, folder):
    """The scene of scenes.rain() as somebody writes it: a mesh in a file, numbers in a text."""
    plekton.write_mesh(folder / "sheet.off", points, facets)
    rows = ",\n".join("[" + ", ".join(map(repr, map(float, row))) + "]" for row in centres)
    file = folder / "rain.toml"
    file.write_text(
        f"""[simulation]
duration = 0.02
damping = 0.1
[materials.gravel]
density = "2650 kg/m3"
young_modulus = "20 MPa"
friction_angle = "35 deg"
[[membranes]]
name = "sheet"
mesh = "sheet.off"
thickness = "2 mm"
material = "gravel"
young_modulus = "50 MPa"
areal_mass = "300 g/m2"
hold = "rim"
[[grains]]
name = "gravel"
material = "gravel"
velocity = [0, 0, "-1 m/s"]
radii = [{", ".join(map(repr, map(float, radii)))}]
centres = [{rows}]
[[planes]]
name = "floor"
point = [0, 0, "-5 cm"]
material = "gravel"
[output]
interval = "5 ms"
reactions = [
  {{ name = "floor", kind = "plane", plane = "floor" }},
  {{ name = "rim", kind = "support", membrane = "sheet", nodes = "rim" }},
  {{ name = "caught", kind = "contacts", membrane = "sheet" }},
]
"""
    )
    return file


@pytest.mark.skipif(scenes.PROGRAM is None, reason="PLEKTON_PROGRAM is not set")
def test_a_thousand_spheres_on_a_membrane_from_arrays_have_the_bits_of_the_scenario(tmp_path):
    file = toml_of(*scenes.sheet(20, 0.2), *scenes.spheres(1000), tmp_path)
    run = scenes.plekton("run", file, "--out", tmp_path / "out", "--quiet")
    assert run.returncode == 0, run.stderr
    step, _, expected = json.loads((tmp_path / "out/run.json").read_text())["states"]["step_time_hash"][-1]

    simulation = plekton.load(scenes.rain())
    simulation.run()

    assert (simulation.steps, simulation.hash) == (step, expected)
    assert len(simulation.contacts()) >= 100  # the lowest layer has come down
    assert simulation.energy().friction > 0.0


def test_a_file_and_the_dict_that_it_reads_as_are_the_same_scene(tmp_path):
    file = toml_of(*scenes.sheet(4, 0.2), *scenes.spheres(20), tmp_path)
    from_file = plekton.load(file)
    from_dict = plekton.load(tomllib.loads(file.read_text()), folder=tmp_path)

    from_file.step(10)
    from_dict.step(10)

    assert from_dict.hash == from_file.hash


def test_the_text_of_a_dict_is_a_scenario_of_the_same_scene(tmp_path):
    simulation = plekton.load(scenes.small())
    (tmp_path / "written.toml").write_text(simulation.scenario)

    written = plekton.load(tmp_path / "written.toml")
    written.step(10)
    simulation.step(10)

    assert written.hash == simulation.hash


def test_overrides_replace_what_a_dict_says():
    simulation = plekton.load(scenes.small(), ["simulation.duration=3 ms", "simulation.threads=2"])

    assert simulation.duration == 0.003


def test_an_override_alone_is_no_list():
    with pytest.raises(plekton.InputError, match="overrides: got 'a=b'; expected a list"):
        plekton.load(scenes.small(), "a=b")


@pytest.mark.parametrize("number", [5, np.int32(5), np.uint8(5), np.array(5)])
def test_whole_numbers_of_numpy_are_whole_numbers(number):
    scene = scenes.small()
    scene["simulation"]["seed"] = number

    plekton.load(scene)


# What numpy makes of a long double for Python is the long double again.
def test_long_doubles_are_numbers():
    scene = scenes.small()
    scene["simulation"]["duration"] = np.longdouble(0.25)
    scene["grains"][0]["velocity"] = np.array([0, 0.5, -1], np.longdouble)

    plekton.load(scene)


def test_bars_from_arrays_become_bars_and_their_ends_are_held():
    points = np.array([[0, 0, 0], [0.1, 0, 0], [0.2, 0, 0.01], [0.3, 0, 0]])
    net = {
        "shape": {"kind": "bars", "points": points, "bars": np.array([[2, 1], [0, 1], [3, 2]])},
        "thickness": "2 mm",
        "material": "gravel",
        "young_modulus": "1 GPa",
        "density": "1000 kg/m3",
        "hold": "rim",
    }
    scene = scenes.small()
    scene["membranes"] = [net]
    del scene["grains"], scene["output"]["reactions"]

    simulation = plekton.load(scene)
    simulation.run(until=0.002)

    np.testing.assert_array_equal(simulation.bars, [[0, 1], [1, 2], [2, 3]])
    moved = np.linalg.norm(simulation.positions - points, axis=1)
    assert moved[0] == moved[3] == 0.0
    assert min(moved[1], moved[2]) > 0.0


def error_of(change):
    scene = copy.deepcopy(scenes.small())
    change(scene)
    with pytest.raises(plekton.InputError) as error:
        plekton.load(scene)
    return str(error.value)


def put(path, value):
    def change(scene):
        *keys, last = path.split(".")
        for key in keys:
            scene = scene[int(key) if key.isdigit() else key]
        scene[last] = value

    return change


@pytest.mark.parametrize(
    ("path", "value", "message"),
    [
        ("simulation.duration", "5 kg", 'dict: simulation.duration: got "5 kg", a mass; expected a time'),
        ("simulation.duration", None, "dict: simulation.duration: got None; expected a time"),
        ("simulation.dration", 1, 'dict: simulation.dration: unknown key; did you mean "duration"?'),
        ("simulation.seed", 2**70, f"dict: simulation.seed: got {2**70}; expected a whole number"),
        ("simulation.seed", 1.5, "dict: simulation.seed: got 1.5; expected a whole number"),
        ("simulation.damping", np.nan, "dict: simulation.damping: got nan; expected"),
        ("simulation.gravity", np.zeros(2), "dict: simulation.gravity: got a list of 2; expected a list of three"),
        ("stop", datetime.date(2026, 1, 1), "dict: stop: got something of type date; expected a table"),
        ("membranes.0.thickness", "2 s", "dict: membranes.sheet.thickness: got"),
        ("membranes.0.shape.facets", [[0, 1, 1]], "dict: membranes.sheet.shape.facets[0]: got [0, 1, 1]; "
         "expected 3 different whole numbers from 0 to 24"),
        ("membranes.0.shape.facets", [[0, 1, 25]], "facets[0]: got [0, 1, 25]; expected 3 different"),
        ("membranes.0.shape.facets", np.zeros((0, 3)), "facets: got a list of 0; expected a list of lists of 3"),
        ("grains.0.radii", [0.005], "dict: grains.gravel.radii: got a list of 1; expected a list of 20"),
        ("grains.0.radius", 0.005, "dict: grains.gravel.radius: radii says how large each grain is"),
    ],
)
def test_what_is_wrong_in_a_dict_is_said_with_the_path_of_its_key(path, value, message):
    assert message in error_of(put(path, value))


def test_every_problem_of_a_dict_is_listed():
    def change(scene):
        put("simulation.duration", "x")(scene)
        put("grains.0.material", "grvel")(scene)

    lines = error_of(change).splitlines()

    assert len(lines) == 2
    assert lines[0].startswith("dict: simulation.duration: ")
    assert lines[1].startswith("dict: grains.gravel.material: ")


def test_keys_are_texts():
    assert "dict: got the key 3; expected a text" in error_of(lambda scene: scene.update({3: 4}))


def test_a_dict_within_itself_is_refused():
    def change(scene):
        scene["simulation"]["simulation"] = scene["simulation"]

    # Not by error_of(), which copies it.
    scene = scenes.small()
    change(scene)
    with pytest.raises(plekton.InputError, match="nested more than 32 deep"):
        plekton.load(scene)


def test_texts_with_any_characters_survive_the_way_through_a_file(tmp_path):
    scene = scenes.small()
    scene["grains"][0]["name"] = 'a "name" with \\ and ü'
    simulation = plekton.load(scene)
    (tmp_path / "written.toml").write_text(simulation.scenario)

    written = plekton.load(tmp_path / "written.toml")

    assert len(written.nodes('grains.a "name" with \\ and ü')) == 20
