# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs scenes on several ranks of mpirun and compares all that they write with what one process writes, byte by byte.

Usage: python3 ranks_test.py PROGRAM [CASE]

With PLEKTON_RANKS=all in the environment also the scenes of scenes/named and all_kinds, on up to 8 ranks, and 50 runs of which a rank is
killed, whichever.

Ends 77 where there is no mpirun, or the program has no MPI: ctest shows that as skipped.
"""

import csv
import json
import os
import random
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

SCENES = Path(__file__).parent / "scenes"
SKIPPED = 77
NOT_COMPARED = {"run.json"}
"""Times and names of machines; of it the states alone are."""

program = ""


def asks_for_all():
    return os.environ.get("PLEKTON_RANKS") == "all"


def mpirun(ranks):
    return ["mpirun", "--allow-run-as-root", "--oversubscribe", "--bind-to", "none", "-n", str(ranks)]


def run(ranks, *arguments, by_chance="", seconds=300):
    """Runs the program; on no ranks it is started by itself."""
    command = [*(mpirun(ranks) if ranks else []), program, "run", *map(str, arguments)]
    environment = {**os.environ, "PLEKTON_RANKS_TEST": by_chance}
    return subprocess.run(command, env=environment, capture_output=True, text=True, timeout=seconds)


def states_of(folder):
    return json.loads((folder / "run.json").read_text(encoding="utf-8"))["states"]["step_time_hash"]


def files_of(folder):
    paths = [path for path in folder.rglob("*") if path.is_file() and path.name not in NOT_COMPARED]
    return {path.relative_to(folder).as_posix(): path.read_bytes() for path in paths}


class Ranks(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)

    def run_well(self, ranks, *arguments, **more):
        ended = run(ranks, *arguments, **more)
        self.assertEqual(ended.returncode, 0, f"{ranks} ranks:\n{ended.stdout}\n{ended.stderr}")
        return ended

    def assert_same(self, one, other, what):
        self.assertEqual(states_of(one), states_of(other), what)
        files, others = files_of(one), files_of(other)
        self.assertEqual(sorted(files), sorted(others), what)
        self.assertEqual([name for name in files if files[name] != others[name]], [], what)

    def assert_same_on_ranks(self, scene):
        alone = self.folder / "alone"
        self.run_well(0, SCENES / scene, "--out", alone, "--quiet")
        self.assertGreater(len(states_of(alone)), 2)
        for ranks in (1, 2, 3, 5):
            out = self.folder / f"on_{ranks}"
            self.run_well(ranks, SCENES / scene, "--out", out, "--quiet")
            self.assert_same(alone, out, f"{scene} on {ranks} ranks")
            self.assertEqual(json.loads((out / "run.json").read_text())["options"]["ranks"], ranks)
        for by_chance in ("owners", "delays,owners"):
            out = self.folder / by_chance
            self.run_well(3, SCENES / scene, "--out", out, "--quiet", by_chance=by_chance)
            self.assert_same(alone, out, f"{scene} with {by_chance} by chance")


class SameBytes(Ranks):
    def test_of_spheres(self):
        self.assert_same_on_ranks("spheres.toml")

    def test_of_all_kinds(self):
        self.assert_same_on_ranks("all_kinds.toml")

    def test_of_grains_that_are_pressed_together_as_they_begin(self):
        """Their first step is chosen for the speeds that their forces bring, which a rank knew of its own grains alone: ranks then looked at
        their steps at different times, and crashed."""
        radius, side = 0.003, 13
        chance = random.Random(1)
        places = [(1.98 * radius * i, 1.98 * radius * j, 1.98 * radius * k) for i in range(side) for j in range(side) for k in range(side)]
        rows = [",".join(repr(x + 0.004 * radius * chance.random()) for x in place) + f",{radius}" for place in places]
        table = self.folder / "pressed.csv"
        table.write_text("\n".join(rows) + "\n", encoding="utf-8")
        scene = self.folder / "pressed.toml"
        scene.write_text(
            f"""[simulation]
duration = "1 ms"
gravity = [0, 0, 0]
[materials.sand]
density = "2650 kg/m3"
young_modulus = "100 MPa"
friction_angle = "30 deg"
[[grains]]
name = "sand"
material = "sand"
table = "{table}"
[output]
interval = "1 ms"
history_interval = "0.2 ms"
hash_interval = 5
""",
            encoding="utf-8",
        )
        self.assert_same_on_ranks(scene)

    def test_with_threads_in_ranks(self):
        for ranks, threads in ((0, 2), (2, 2)):
            self.run_well(ranks, SCENES / "spheres.toml", "--threads", threads, "--out", self.folder / str(ranks), "--quiet")
        self.assert_same(self.folder / "0", self.folder / "2", "two threads in each of two ranks")


@unittest.skipUnless(asks_for_all(), "long: set PLEKTON_RANKS=all")
class NamedScenes(Ranks):
    def test_tear_and_drag_as_their_names_say(self):
        """What is torn and dragged goes over the blocks of more than one rank."""
        torn, dragged = self.folder / "torn", self.folder / "dragged"
        self.run_well(0, SCENES / "named/net_tearing.toml", "--out", torn, "--quiet")
        self.assertGreater(json.loads((torn / "run.json").read_text())["counts"]["broken_bonds"], 20)
        self.run_well(0, SCENES / "named/dragged_sheet.toml", "--out", dragged, "--quiet")
        with (dragged / "energy.csv").open(encoding="utf-8") as file:
            touching = [int(row["grain_membrane_contacts"]) for row in csv.DictReader(file)]
        self.assertGreater(sum(count > 0 for count in touching), 0.5 * len(touching))

    def test_on_up_to_8_ranks_and_with_owners_by_chance(self):
        for scene in [*sorted((SCENES / "named").glob("*.toml")), SCENES / "all_kinds.toml"]:
            with self.subTest(scene.stem):
                alone = self.folder / scene.stem
                self.run_well(0, scene, "--out", alone, "--quiet")
                self.assertGreater(len(states_of(alone)), 3)
                for ranks, by_chance in ((1, ""), (2, ""), (3, ""), (5, ""), (8, ""), (3, "owners"), (5, "delays,owners")):
                    out = self.folder / "out"
                    self.run_well(ranks, scene, "--out", out, "--quiet", by_chance=by_chance, seconds=900)
                    self.assert_same(alone, out, f"{scene.stem} on {ranks} ranks {by_chance}")
                    shutil.rmtree(out)
                print(f"{scene.stem}: {len(states_of(alone))} states", flush=True)


class Resume(Ranks):
    def test_after_a_killed_rank_on_another_number_of_ranks(self):
        self.assert_resumes("spheres.toml", random.Random(2), (2, 3), (3, 0), (0, 2))

    @unittest.skipUnless(asks_for_all(), "long: set PLEKTON_RANKS=all")
    def test_50_times(self):
        chance = random.Random(1)
        for scene in ("spheres.toml", "all_kinds.toml"):
            pairs = [chance.sample((0, 1, 2, 3, 5), 2) for _ in range(25)]
            self.assert_resumes(scene, chance, *pairs)
            print(f"{scene}: a rank killed and resumed on another number of ranks, {len(pairs)} of {len(pairs)} the same", flush=True)

    def assert_resumes(self, scene, chance, *pairs):
        """Runs of which one is killed of so many ranks go on on so many others."""
        alone, out = self.folder / scene, self.folder / "out"
        self.run_well(0, SCENES / scene, "--out", alone, "--quiet")
        for before, after in pairs:
            shutil.rmtree(out, ignore_errors=True)
            self.kill_when_there_is_a_checkpoint(scene, chance, before, out)
            self.run_well(after, "--resume", out, "--quiet")
            self.assert_same(alone, out, f"{scene}: {before} ranks, killed, then {after}")

    def kill_when_there_is_a_checkpoint(self, scene, chance, ranks, out):
        arguments = [program, "run", str(SCENES / scene), "--out", str(out), "--quiet"]
        with subprocess.Popen([*(mpirun(ranks) if ranks else []), *arguments], stdout=subprocess.DEVNULL,
                              stderr=subprocess.PIPE, text=True) as job:
            deadline = time.monotonic() + 120
            while not list(out.glob("checkpoints/*.h5")) and job.poll() is None and time.monotonic() < deadline:
                time.sleep(0.01)
            self.assertIsNone(job.poll(), "the run was over before it could be killed")
            # mpirun has to end the others, and says so once.
            os.kill(chance.choice(self.processes_of(job)), signal.SIGKILL)
            _, told = job.communicate(timeout=60)
        if ranks:
            self.assertEqual(told.count("signal 9"), 1, told)
        self.assertFalse((out / "run.json").exists())

    @staticmethod
    def processes_of(job):
        children = Path(f"/proc/{job.pid}/task/{job.pid}/children").read_text().split()
        return [int(child) for child in children] or [job.pid]


class Failure(Ranks):
    def test_of_a_stage_is_reported_as_by_one_process(self):
        """Of figures it told zeros, and that all was green."""
        text = (SCENES / "spheres.toml").read_text(encoding="utf-8")
        text = re.sub(r'(?m)^duration = .*\n', "", text)
        scene = self.folder / "never.toml"
        scene.write_text(text + '\n[[stages]]\nname = "fall"\nmax_duration = "1 ms"\nend = { kinetic_energy = "1e-30 J" }\n', encoding="utf-8")
        reports = []
        for ranks in (0, 3):
            out = self.folder / f"failed_{ranks}"
            self.assertEqual(run(ranks, scene, "--out", out, "--quiet").returncode, 1)
            reports.append(json.loads((out / "run.json").read_text(encoding="utf-8")))
        alone, on_ranks = reports
        self.assertEqual(alone["status"], "failed")
        for key in ("status", "message", "certificate", "counts", "energy"):
            self.assertEqual(alone[key], on_ranks[key], key)


class Speech(Ranks):
    def test_is_that_of_one_process(self):
        told = [self.run_well(ranks, SCENES / "spheres.toml", "--out", self.folder / "out", "--overwrite").stdout
                for ranks in (0, 3)]
        # What takes time takes another one each time.
        first_words = [[line.split()[0] for line in text.splitlines() if line.split() and "step" not in line] for text in told]
        self.assertEqual(*first_words)

    def test_is_one_message_where_all_fail(self):
        scene = self.folder / "wrong.toml"
        scene.write_text("[simulation]\nduration = 'long'\n", encoding="utf-8")
        ended = run(3, scene, "--out", self.folder / "out")
        self.assertNotEqual(ended.returncode, 0)
        self.assertEqual(ended.stderr.count("simulation.duration"), 1, ended.stderr)

    def test_is_one_message_where_the_first_rank_fails(self):
        out = self.folder / "out"
        out.mkdir()
        (out / "run.json").write_text("{}", encoding="utf-8")
        ended = run(3, SCENES / "spheres.toml", "--out", out)
        self.assertNotEqual(ended.returncode, 0)
        self.assertEqual(ended.stderr.count("holds results of an earlier run"), 1, ended.stderr)

    def test_is_one_message_where_another_rank_fails_alone(self):
        # The second rank is given a scenario that is not there.
        scene = SCENES / "spheres.toml"
        command = [*mpirun(1), program, "run", str(scene), "--out", str(self.folder / "out"), ":", "-n", "1", program, "run",
                   str(self.folder / "missing.toml"), "--out", str(self.folder / "out")]
        ended = subprocess.run(command, capture_output=True, text=True, timeout=60)
        self.assertNotEqual(ended.returncode, 0)
        self.assertEqual(ended.stderr.count("missing.toml"), 1, ended.stderr)
        self.assertIn("rank 1: ", ended.stderr)

    def test_ends_complete_where_the_job_is_interrupted(self):
        out = self.folder / "out"
        command = [*mpirun(2), program, "run", str(SCENES / "spheres.toml"), "--set", "simulation.duration=10 s", "--out", str(out),
                   "--quiet"]
        with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as job:
            while not list(out.glob("checkpoints/*.h5")) and job.poll() is None:
                time.sleep(0.01)
            job.send_signal(signal.SIGINT)
            job.communicate(timeout=60)
        self.assertEqual(json.loads((out / "run.json").read_text())["status"], "interrupted")


def main():
    global program
    program = sys.argv.pop(1)
    if shutil.which("mpirun") is None:
        print("skipped: there is no mpirun (Debian: openmpi-bin)")
        return SKIPPED
    tried = subprocess.run([*mpirun(2), program, "run", "nothing.toml"], capture_output=True, text=True, timeout=60)
    if "without MPI" in tried.stderr:
        print("skipped: the program was built without MPI")
        return SKIPPED
    return 0 if unittest.main(exit=False, verbosity=2).result.wasSuccessful() else 1


if __name__ == "__main__":
    sys.exit(main())
