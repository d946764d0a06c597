# SPDX-License-Identifier: GPL-3.0-or-later
"""Functions that a run calls, Ctrl-C, and other threads meanwhile."""

import os
import signal
import threading
import time

import plekton
import pytest
import scenes


@pytest.fixture
def simulation():
    return plekton.load(scenes.small())


def test_functions_are_called_after_the_steps_nearest_to_their_times(simulation):
    times = []

    simulation.run(until=0.01, every={"2 ms": lambda s: times.append((s.time, s.time_step))})

    assert len(times) == 5
    for i, (at, step) in enumerate(times, 1):
        assert abs(at - 0.002 * i) <= 0.5 * step * (1 + 1e-9)


def test_an_interval_below_the_step_is_after_every_step(simulation):
    for interval in (1e-12, 1e-300):
        calls = []
        simulation.run(until=simulation.time + 0.001, every={interval: lambda s: calls.append(s.steps)})
        assert calls == list(range(simulation.steps - len(calls) + 1, simulation.steps + 1)) != []


def test_looking_on_changes_no_bit(simulation):
    alone = plekton.load(scenes.small())
    alone.run(until=0.01)

    simulation.run(until=0.01, every={"1 ms": lambda s: (s.contacts(), s.energy(), s.forces.sum()), 0.0003: len_of})

    assert simulation.hash == alone.hash


def len_of(simulation):
    return len(simulation.contacts())


def test_functions_get_the_simulation_in_the_order_of_the_dict(simulation):
    calls = []

    simulation.run(
        until=0.004,
        every={
            "2 ms": [lambda s: calls.append(("a", s is simulation)), lambda s: calls.append(("b", s is simulation))],
            0.004: lambda s: calls.append(("c", s is simulation)),
        },
    )

    assert calls == [("a", True), ("b", True), ("a", True), ("b", True), ("c", True)]


def test_multiples_are_kept_from_run_to_run(simulation):
    times = []
    every = {"2 ms": lambda s: times.append(s.time)}

    simulation.run(until=0.003, every=every)
    simulation.run(until=0.0065, every=every)

    assert [round(1e3 * t) for t in times] == [2, 4, 6]


def test_an_error_in_a_function_ends_the_run_and_is_raised(simulation):
    def fail(_):
        raise KeyError("mine")

    with pytest.raises(KeyError, match="mine"):
        simulation.run(every={"1 ms": fail})

    assert simulation.time < 0.002
    simulation.run(until=0.003)  # and it can go on
    assert simulation.time == pytest.approx(0.003, rel=1e-9)


def test_a_function_can_stop_the_run(simulation):
    simulation.run(every={"1 ms": lambda s: s.stop()})

    assert simulation.time == pytest.approx(0.001, abs=simulation.time_step)


def test_a_function_can_drive_what_is_held(simulation):
    rim = simulation.nodes("membranes.sheet")[:5]
    height = simulation.positions[rim, 2].copy()

    simulation.run(until=0.01, every={"5 ms": lambda s: s.set_velocity(rim, [0, 0, 1])})

    lifted = simulation.positions[rim, 2] - height
    assert lifted == pytest.approx(0.005, abs=2 * simulation.time_step)


@pytest.mark.parametrize("move", [lambda s: s.step(), lambda s: s.run(until=1), lambda s: s.restore("x")])
def test_a_function_cannot_move_the_simulation_that_calls_it(simulation, move):
    with pytest.raises(plekton.Error, match="a function that it calls can read and stop it, not move it"):
        simulation.run(every={"1 ms": move})


@pytest.mark.parametrize(
    ("every", "message"),
    [
        ([1], "every: got \\[1\\]; expected a dict of times and functions"),
        ({"1 kg": len}, 'every: got "1 kg", a mass; expected a time'),
        ({0: len}, "every: got 0; expected a time above 0"),
        ({-1: len}, "every: got -1; expected a time of at least 0"),
        ({float("inf"): len}, "every: got inf; expected a time, finite"),
        ({None: len}, "every: got None; expected a time"),
        ({"1 ms": 3}, "every '1 ms': got 3; expected a function"),
    ],
)
def test_intervals_and_functions_that_are_none_are_refused(simulation, every, message):
    with pytest.raises(plekton.InputError, match=message):
        simulation.run(every=every)
    assert simulation.steps == 0


@pytest.mark.parametrize("until", ["1 kg", None.__class__, float("nan"), float("inf"), -1])
def test_an_end_that_is_no_time_is_refused(simulation, until):
    with pytest.raises(plekton.InputError, match="until: got"):
        simulation.run(until=until)


@pytest.mark.parametrize("out", [{}, {"out": "out"}])
def test_more_steps_than_a_run_may_have_are_refused(simulation, out, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(plekton.InputError, match=r"until: 1e\+300 s are .* steps of .* s, above the 1e\+12 that"):
        simulation.run(until=1e300, **out)
    assert simulation.steps == 0
    assert not list(tmp_path.iterdir())


def test_control_c_ends_a_run_within_a_second(simulation):
    long = plekton.load(scenes.rain(count=500, duration=100.0))
    timer = threading.Timer(0.5, os.kill, (os.getpid(), signal.SIGINT))
    timer.start()
    begin = time.monotonic()

    with pytest.raises(KeyboardInterrupt):
        long.run()

    assert time.monotonic() - begin < 20  # a sanitizer's step is slow; by itself it takes half a second
    assert long.time < 100.0
    long.step(1)


def test_other_threads_go_on_while_it_runs_and_cannot_ask_it():
    long = plekton.load(scenes.rain(count=500, duration=100.0))
    seen = []

    def ask():
        while not seen:
            try:
                long.energy()
            except plekton.Error as error:
                seen.append(str(error))
        long.stop()

    thread = threading.Thread(target=ask)
    thread.start()
    long.run()
    thread.join()

    assert "the simulation is running in another thread" in seen[0]
    assert long.energy().kinetic > 0.0
