# SPDX-License-Identifier: GPL-3.0-or-later
"""`plekton schema` against jsonschema: every scenario of the tree is valid, and what is misspelled is not.

Usage: python3 schema_test.py PROGRAM ROOT; ends 77 where python3-jsonschema is missing
"""

import copy
import json
import os
import subprocess
import sys
import tempfile
import tomllib
from pathlib import Path

SKIPPED = 77
DEBIAN_PYTHON = "/usr/bin/python3"

MINIMAL = """
[simulation]
duration = "1 s"
[materials.stone]
density = "2650 kg/m3"
young_modulus = "1 MPa"
friction_angle = "30 deg"
[[grains]]
material = "stone"
radius = "1 cm"
centres = [[0, 0, "1 m"]]
"""

WRONG = {
    "a misspelled key": ("simulation", "duratoin", 1),
    "a misspelled table": (None, "membrane", []),
    "a number where a text is": ("materials", "stone", 3),
    "a text that is no quantity": ("simulation", "duration", "long"),
    "a value out of its range": ("simulation", "damping", 1.5),
    "a word that is none of those known": ("grains", "placement", "lattise"),
    "a kind that is not there": ("loads", None, [{"kind": "wind"}]),
    "a key of another kind": ("loads", None, [{"kind": "gravity", "factor": [["0 s", 1]], "rate": 1}]),
    "a key of another law": ("contacts", None, [{"between": "stone", "and": "stone", "law": "hertz_mindlin", "bonds": "new"}]),
    "two components instead of three": ("simulation", "gravity", [0, 0]),
}
RIGHT = {
    "a load of a kind": ("loads", None, [{"kind": "gravity", "factor": [["0 s", 1]]}]),
    "a law with its key": (
        "contacts",
        None,
        [{"between": "stone", "and": "stone", "law": "cohesive_frictional", "bonds": "start"}],
    ),
    "a word for a quantity": ("simulation", "time_step", "auto"),
    "a box for nodes": (
        "loads",
        None,
        [{"kind": "mass_damping", "rate": 1, "grains": "g", "nodes": {"min": [0, 0, 0], "max": [1, 1, "1 m"]}}],
    ),
}


def changed(scenario, table, key, value):
    """A copy with one value set; of a list of tables in its first one."""
    scenario = copy.deepcopy(scenario)
    if table is None:
        scenario[key] = value
    elif key is None:
        scenario[table] = value
    else:
        place = scenario[table]
        (place[0] if isinstance(place, list) else place)[key] = value
    return scenario


def misspelled(values, path=()):
    """Copies of a scenario with one key misspelled, each with the path of the key; names of materials may be any."""
    for key, value in list(values.items()) if isinstance(values, dict) else []:
        if path[-1:] != ("materials",):
            yield (*path, key), {(name + "x" if name == key else name): entry for name, entry in values.items()}
        for where, inner in misspelled(value, (*path, key)):
            yield where, values | {key: inner}
    for i, value in enumerate(values) if isinstance(values, list) else []:
        for where, inner in misspelled(value, (*path, i)):
            yield where, [*values[:i], inner, *values[i + 1 :]]


def scenarios(root):
    """Every file of the tree that is a scenario."""
    files = subprocess.run(["git", "ls-files", "*.toml"], cwd=root, capture_output=True, text=True).stdout.split()
    files = files or [path.relative_to(root) for path in Path(root, "apps").rglob("*.toml")]
    for file in files:
        if str(file).startswith("tests/fuzz/"):  # what no scenario may be
            continue
        values = tomllib.loads(Path(root, file).read_text(encoding="utf-8"))
        if "simulation" in values:
            yield str(file), values


def main():
    try:
        import jsonschema
    except ImportError:
        if sys.executable != DEBIAN_PYTHON and os.path.exists(DEBIAN_PYTHON):
            os.execv(DEBIAN_PYTHON, [DEBIAN_PYTHON, "-B", *sys.argv])
        print("skipped: needs python3-jsonschema")
        return SKIPPED
    program, root = sys.argv[1:3]
    schema = json.loads(subprocess.run([program, "schema"], capture_output=True, text=True, check=True).stdout)
    jsonschema.Draft202012Validator.check_schema(schema)
    validator = jsonschema.Draft202012Validator(schema)

    failures = []
    count = 0
    with tempfile.TemporaryDirectory() as folder:
        new = Path(folder, "new.toml")
        subprocess.run([program, "new", new], check=True, stdout=subprocess.DEVNULL)
        tried = [*scenarios(root), ("plekton new", tomllib.loads(new.read_text(encoding="utf-8")))]
    minimal = tomllib.loads(MINIMAL)
    tried += [("a minimal scenario", minimal)]
    tried += [(what, changed(minimal, *change)) for what, change in RIGHT.items()]
    for name, values in tried:
        count += 1
        for error in validator.iter_errors(values):
            failures.append(f"{name}: valid, but refused: {error.json_path}: {error.message[:300]}")
    without_duration = copy.deepcopy(minimal)
    del without_duration["simulation"]["duration"]
    wrong = {what: changed(minimal, *change) for what, change in WRONG.items()} | {"no duration": without_duration}
    for what, values in wrong.items():
        if validator.is_valid(values):
            failures.append(f"{what}: not refused")
    keys = 0
    for name, values in tried:
        for where, wrong_values in misspelled(values):
            keys += 1
            if validator.is_valid(wrong_values):
                failures.append(f"{name}: {'.'.join(map(str, where))} misspelled, but not refused")
    for failure in failures:
        print(failure)
    print(f"{count} scenarios valid by the schema, {len(wrong)} wrong ones and {keys} misspelled keys not; {len(failures)} failures")
    return 1 if failures or count < 10 or keys < 100 else 0


if __name__ == "__main__":
    sys.exit(main())
