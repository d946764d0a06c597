# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the cells of a notebook as they stand, one after the other, without Jupyter.

Usage: python3 run_notebook.py NOTEBOOK.ipynb; files that it writes go to the current folder
"""

import ast
import json
import sys
from pathlib import Path


def cells_of(notebook):
    """The code of a notebook, a text for each cell."""
    content = json.loads(Path(notebook).read_text(encoding="utf-8"))
    return ["".join(cell["source"]) for cell in content["cells"] if cell["cell_type"] == "code"]


def run_cell(code, name, names):
    """Runs a cell, and shows the value of an expression at its end, as Jupyter does."""
    tree = ast.parse(code, name)
    last = tree.body.pop() if tree.body and isinstance(tree.body[-1], ast.Expr) else None
    exec(compile(tree, name, "exec"), names)
    if last is not None:
        value = eval(compile(ast.Expression(last.value), name, "eval"), names)
        if value is not None:
            print(repr(value))


def run(notebook):
    names = {"__name__": "__main__"}
    for number, code in enumerate(cells_of(notebook), 1):
        run_cell(code, f"{Path(notebook).name} cell {number}", names)
    return names


if __name__ == "__main__":
    run(sys.argv[1])
