# SPDX-License-Identifier: GPL-3.0-or-later
"""Takes scripts of YADE over and goes on with both programs; prints, for each, counts, masses and how far bodies are apart.

What is judged: every body with a mass that may move is there; the masses agree to 1e-6; and no body is further from its place in YADE
than the fastest body goes in a step. That is twice what the integrator explains: YADE begins with a whole kick where Plekton has half a
one, so its velocities are those of half a step later, and its places half a step's way ahead.

Run on request, with YADE and Plekton's module for Python: PYTHONPATH=build/release/python /usr/bin/python3
compare_with_yade.py PROGRAM SCRIPT... [--steps 1000] [--iteration 0] [--mend-shear] [--append CODE] [--record FOLDER]. Ends 1 if a script
is not as it should be.
"""

import argparse
import json
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
import plekton

EXPORTER = Path(__file__).resolve().parents[3] / "apps/takeover/export_scene.py"


MEND_SHEAR = """
for _i in O.interactions:
    if type(_i.geom).__name__ == "GridNodeGeom6D":
        _length = (O.bodies[_i.id2].state.pos - O.bodies[_i.id1].state.pos).norm()
        _i.phys.ks *= _length / (2 * O.bodies[_i.id1].shape.radius)
"""
"""What YADE 2023 leaves out of the shear of a beam between grid nodes: it has 2 r / length of its stiffness."""


def exported(script, stops, folder):
    """What YADE has at each iteration, of one run: GTS may number what it reads otherwise in the next."""
    command = ["yade", "-n", "-x", "-j1", EXPORTER, script.resolve()]
    files = [folder / f"scene_{at}.json" for at in stops]
    for at, file in zip(stops, files):
        command += [at, file]
    said = subprocess.run([str(c) for c in command], stdin=subprocess.DEVNULL, capture_output=True, text=True)
    if said.returncode != 0:
        raise RuntimeError(said.stdout.strip().splitlines()[-1])
    return [json.loads(file.read_text()) for file in files]


def appended(script, code, folder):
    """A copy that ends with this code, with what it reads beside it."""
    shutil.copytree(script.parent, folder / "appended")
    copy = folder / "appended" / script.name
    copy.write_text(f"{copy.read_text()}\n{code}\n")
    return copy


def moving(scene):
    """Bodies with a mass of their own that may move, by id."""
    return {b["id"]: b for b in scene["spheres"] + scene["nodes"] + scene["clumps"]}


def compare(program, script, iteration, steps, folder, record):
    before, after = exported(script, [iteration, iteration + steps], folder)
    if record:
        record.mkdir(parents=True, exist_ok=True)
        shutil.copy(folder / f"scene_{iteration}.json", record / f"{script.stem}.json")
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
    duration = after["time"] - before["time"]
    speeds = [np.linalg.norm(b["v"]) for b in (*bodies.values(), *later.values())]
    watched = list(places.values())

    def note_speeds(sim):
        speeds.append(np.linalg.norm(np.array(sim.velocities)[watched], axis=1).max())

    sim.run(until=duration, every={duration / 50: note_speeds} if watched else {})
    end = np.array(sim.positions)
    apart, moved = 0.0, 0.0
    for number, place in places.items():
        there = np.array(later[number]["x"])
        apart = max(apart, np.linalg.norm(end[place] - there))
        moved = max(moved, np.linalg.norm(there - np.array(bodies[number]["x"])))
    mass = sum(b["mass"] for b in bodies.values())
    ours = float(np.sum(np.array(sim.masses)[watched]))
    limit = max(speeds) * duration / steps
    wrong = []
    if len(places) != len(bodies):
        wrong.append("bodies are missing")
    if abs(ours - mass) > 1e-6 * mass:
        wrong.append("the masses differ")
    if apart > limit:
        wrong.append("further apart than a step's way")
    print(f"{script.stem}: {len(places)} of {len(bodies)} bodies, {mass:.6g} kg there and {ours:.6g} kg here, {duration:.4g} s in {steps} "
          f"steps there: moved by up to {moved:.4g} m, apart by up to {apart:.3g} m ({100 * apart / moved if moved else 0:.2g} % of that), "
          f"limit {limit:.3g} m: {', '.join(wrong) or 'agrees'}", flush=True)
    return not wrong


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program", type=Path)
    parser.add_argument("scripts", nargs="+", type=Path)
    parser.add_argument("--steps", type=int, default=1000)
    parser.add_argument("--iteration", type=int, default=0)
    parser.add_argument("--mend-shear", action="store_true", help="with the whole shear stiffness of beams in YADE")
    parser.add_argument("--append", default="", metavar="CODE", help="Python that each script ends with, to try what a difference comes from")
    parser.add_argument("--record", type=Path, help="folder to keep what YADE has told in, a file for each script")
    arguments = parser.parse_args()
    failed = 0
    for script in arguments.scripts:
        with tempfile.TemporaryDirectory() as folder:
            if code := MEND_SHEAR * arguments.mend_shear + arguments.append:
                script = appended(script, code, Path(folder))
            try:
                failed += not compare(arguments.program, script, arguments.iteration, arguments.steps, Path(folder), arguments.record)
            except (RuntimeError, plekton.Error) as error:
                print(f"{script.stem}: {error}", flush=True)
                failed += 1
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
