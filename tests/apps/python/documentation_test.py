# SPDX-License-Identifier: GPL-3.0-or-later
"""What the pages say in Python runs as it stands, with the arrays and files that it speaks of."""

import re

import numpy as np
import plekton
import pytest
import scenes

BLOCK = re.compile(r"^```python\n(.*?)^```", re.DOTALL | re.MULTILINE)


def blocks_of(page, heading=""):
    text = (scenes.ROOT / page).read_text(encoding="utf-8")
    begin = text.index(f"\n## {heading}\n") if heading else 0
    end = text.find("\n## ", begin + 1) if heading else len(text)
    return BLOCK.findall(text[begin:end])


@pytest.fixture
def names(tmp_path, monkeypatch):
    """A folder with what the pages name, and arrays by their names."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "apps").symlink_to(scenes.ROOT / "apps")
    plekton.load(scenes.small()).run(out="out/catch")
    corners = np.array([[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]], float)
    faces = np.array([[0, 1, 2], [0, 2, 3], [0, 3, 1], [1, 3, 2]])
    plekton.write_mesh("tyre.stl", 1000 * corners, faces)
    centres, radii = scenes.spheres(20)
    return {
        "centres": centres + [0, 0, 2],
        "radii": radii,
        "points": corners,
        "facets": faces,
        "knots": np.array([[0, 0, 3], [1, 0, 3], [2, 0, 3]], float),
        "wires": np.array([[0, 1], [1, 2]]),
        "queries": np.random.default_rng(1).uniform(-1, 1, (10, 3)),
        "origins": np.zeros((1, 3)),
        "directions": np.eye(3)[:1],
        "a0": [0, 0, 0],
        "a1": [1, 0, 0],
        "b0": [1, 0, 0],
        "b1": [0, 0, 0],
        "plekton": plekton,
    }


def run(blocks, names):
    for number, block in enumerate(blocks, 1):
        exec(compile(block, f"block {number}", "exec"), names)


def test_the_page_on_python_runs(names):
    blocks = blocks_of("docs/python.md")
    assert len(blocks) == 4
    # A sheet that is closed has no rim.
    run([block.replace('"hold": "rim"},\n        {', '"hold": "none"},\n        {') for block in blocks], names)


def test_the_readme_runs(names):
    blocks = blocks_of("README.md", "Python")
    assert len(blocks) == 1
    run(blocks, names)
