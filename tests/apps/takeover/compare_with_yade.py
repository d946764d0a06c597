# SPDX-License-Identifier: GPL-3.0-or-later
"""Takes scripts of YADE over and goes on with both programs; prints, for each, counts, masses and how far bodies are apart.

Run on request, with YADE and Plekton's module for Python: PYTHONPATH=build/release/python /usr/bin/python3
compare_with_yade.py PROGRAM SCRIPT... [--steps 1000] [--iteration 0]. A script that fails is told and counted; ends 1 if any does.
"""

import argparse
import json
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
import plekton

EXPORTER = Path(__file__).resolve().parents[3] / "apps/takeover/export_scene.py"


def exported(script, iteration, folder):
    """What YADE has at an iteration."""
    out = folder / f"scene_{iteration}.json"
    command = ["yade", "-n", "-x", "-j1", EXPORTER, script.resolve(), str(iteration), out]
    said = subprocess.run([str(c) for c in command], stdin=subprocess.DEVNULL, capture_output=True, text=True)
    if said.returncode != 0:
        raise RuntimeError(said.stdout.strip().splitlines()[-1])
    return json.loads(out.read_text())


def moving(scene):
    """Bodies with a mass of their own that may move, by id."""
    return {b["id"]: b for b in scene["spheres"] + scene["nodes"] + scene["clumps"]}


def compare(program, script, iteration, steps, folder):
    before, after = exported(script, iteration, folder), exported(script, iteration + steps, folder)
    command = [program, "import-yade", script, "--iteration", str(iteration), "--out", folder / "taken", "--overwrite"]
    said = subprocess.run([str(c) for c in command], capture_output=True, text=True)
    if said.returncode != 0:
        raise RuntimeError(said.stderr.strip())
    sim = plekton.load(folder / "taken" / (script.stem + ".toml"), [f"simulation.duration={after['time'] - before['time']!r}"])
    start = np.array(sim.positions)
    bodies, later = moving(before), moving(after)
    places = {}
    for number, body in bodies.items():
        distance = np.linalg.norm(start - np.array(body["x"]), axis=1)
        nearest = int(distance.argmin())
        if distance[nearest] > 0:
            continue
        places[number] = nearest
    sim.run(until=after["time"] - before["time"])
    end = np.array(sim.positions)
    apart, moved = 0.0, 0.0
    for number, place in places.items():
        there = np.array(later[number]["x"])
        apart = max(apart, np.linalg.norm(end[place] - there))
        moved = max(moved, np.linalg.norm(there - np.array(bodies[number]["x"])))
    mass = sum(b["mass"] for b in bodies.values())
    ours = float(np.sum(np.array(sim.masses)[list(places.values())]))
    print(f"{script.stem}: {len(places)} of {len(bodies)} bodies, {mass:.6g} kg there and {ours:.6g} kg here, "
          f"{after['time'] - before['time']:.4g} s in {steps} steps there: moved by up to {moved:.4g} m, apart by up to {apart:.3g} m "
          f"({100 * apart / moved if moved else 0:.2g} % of that)")
    return len(places) == len(bodies)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program", type=Path)
    parser.add_argument("scripts", nargs="+", type=Path)
    parser.add_argument("--steps", type=int, default=1000)
    parser.add_argument("--iteration", type=int, default=0)
    arguments = parser.parse_args()
    failed = 0
    for script in arguments.scripts:
        with tempfile.TemporaryDirectory() as folder:
            try:
                failed += not compare(arguments.program, script, arguments.iteration, arguments.steps, Path(folder))
            except (RuntimeError, plekton.Error) as error:
                print(f"{script.stem}: {error}")
                failed += 1
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
