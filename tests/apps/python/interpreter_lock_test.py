# SPDX-License-Identifier: GPL-3.0-or-later
"""Threads that are left over when the interpreter ends."""

import subprocess
import sys
from pathlib import Path

import pytest

SCRIPT = """
import sys, threading, time
sys.path.insert(0, {here!r})
import plekton, scenes
simulation = plekton.load(scenes.rain(count=200, duration=100.0))
threading.Thread(target=lambda: {work}, daemon=True).start()
time.sleep(0.3)
"""


@pytest.mark.parametrize(
    "work",
    [
        "simulation.run()",
        "simulation.step(10**9)",
        "simulation.run(every={1e-9: lambda s: sum(range(1000))})",
        "[plekton.load(scenes.rain(count=200)) for _ in range(10**9)]",
        "[plekton.pairs(0.01, centres=scenes.spheres(1000)[0], radii=0.005) for _ in range(10**9)]",
    ],
)
def test_a_daemon_thread_ends_with_the_process(work):
    script = SCRIPT.format(here=str(Path(__file__).parent), work=work)

    runs = [subprocess.run([sys.executable, "-c", script], capture_output=True, timeout=100) for _ in range(3)]

    assert [(run.returncode, run.stderr) for run in runs] == 3 * [(0, b"")]


def test_what_the_end_of_the_interpreter_calls_is_computed():
    script = """
import plekton, sys
sys.path.insert(0, %r)
import scenes
class Last:
    def __init__(self): self.simulation = plekton.load(scenes.small())
    def __del__(self):
        self.simulation.step(100)
        print(self.simulation.steps)
last = Last()
""" % str(Path(__file__).parent)

    run = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, timeout=100)

    assert (run.returncode, run.stdout, run.stderr) == (0, "100\n", "")
