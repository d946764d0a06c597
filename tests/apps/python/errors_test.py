# SPDX-License-Identifier: GPL-3.0-or-later
"""Errors have classes of their own and the texts of the program."""

import plekton
import pytest
import scenes


def test_all_errors_are_errors_of_plekton():
    for name in ("InputError", "MeshError", "Diverged", "OutputError", "CheckpointError"):
        assert issubclass(getattr(plekton, name), plekton.Error)
    assert issubclass(plekton.InputError, ValueError)
    assert issubclass(plekton.MeshError, plekton.InputError)
    assert issubclass(plekton.OutputError, OSError)
    assert plekton.Error.__module__ == "plekton"


def said_by_program(*arguments):
    """What the program says on standard error, without its name."""
    run = scenes.plekton(*arguments)
    assert run.returncode == 1
    text = run.stderr
    head, _, rest = text.partition("\n")
    return (rest if head.endswith("problems") else text.removeprefix("plekton: ")).rstrip("\n")


@pytest.mark.skipif(scenes.PROGRAM is None, reason="PLEKTON_PROGRAM is not set")
@pytest.mark.parametrize(
    "text",
    [
        "[simulation\n",
        "[simulation]\ndration = 3\n",
        '[simulation]\nduration = "1 kg"\ntime_step = 0\n[[grains]]\nradius = -1\n',
    ],
)
def test_a_scenario_that_cannot_be_used_is_refused_with_the_words_of_the_program(tmp_path, text):
    file = tmp_path / "wrong.toml"
    file.write_text(text)

    with pytest.raises(plekton.InputError) as error:
        plekton.load(file)

    assert str(error.value) == said_by_program("check", file)


@pytest.mark.skipif(scenes.PROGRAM is None, reason="PLEKTON_PROGRAM is not set")
def test_files_that_are_missing_are_named_as_the_program_names_them(tmp_path):
    for call, error, arguments in (
        (plekton.load, plekton.InputError, ("check", tmp_path / "none.toml")),
        (plekton.import_mesh, plekton.MeshError, ("import", tmp_path / "none.off")),
        (plekton.open_run, plekton.InputError, ("view", tmp_path / "none")),
    ):
        with pytest.raises(error) as raised:
            call(arguments[1])
        assert str(raised.value) == said_by_program(*arguments)


def test_a_simulation_that_diverges_says_where():
    step = 0.5 * plekton.load(scenes.small()).critical_time_step
    simulation = plekton.load(scenes.small(time_step=step))
    # A kilometre in each step, which a given one does not become shorter for.
    simulation.set_velocity(simulation.nodes("membranes.sheet")[:1], [0, 0, 1e3 / step])

    with pytest.raises(plekton.Diverged) as error:
        simulation.step(1000)

    assert error.value.step >= 0
    assert 0 <= error.value.node < len(simulation.positions)
    assert f"node {error.value.node}" in str(error.value)


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: plekton.load(scenes.small(), [3]), "overrides: got 3; expected a text"),
        (lambda: plekton.load(scenes.small(), ["simulation.seed=\ud800"]), "overrides: got .*halves of surrogate pairs"),
        (lambda: plekton.load("\ud800.toml"), r"got '\\ud800.toml', which is no name of a file"),
        (lambda: plekton.load("\udcff.toml"), "\udcff.toml: no such file"),
        (lambda: plekton.load({"simulation": {"duration": "\ud800"}}), "dict: got .*; expected a text without halves"),
        (lambda: plekton.load({"\ud800": 3}), "dict: got .*; expected a text without halves"),
        (lambda: plekton.load(scenes.small()).run(until="\ud800"), "until: got .*; expected a text without halves"),
    ],
)
def test_what_is_no_text_is_refused(call, message):
    with pytest.raises(plekton.InputError, match=message):
        call()


def test_wrong_types_are_type_errors():
    with pytest.raises(TypeError):
        plekton.load(3)
    with pytest.raises(TypeError):
        plekton.load(scenes.small()).nodes(3)
