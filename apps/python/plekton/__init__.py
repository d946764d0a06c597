# SPDX-License-Identifier: GPL-3.0-or-later
"""The discrete element method with deformable structures: run scenarios, look at results, ask geometry.

    import plekton

    sim = plekton.load("catch.toml")          # or a dict with the same keys
    sim.run(until=0.5, every={"10 ms": lambda sim: print(sim.time, sim.energy().kinetic)})
    sim.positions                             # m; a read-only view, nothing is copied
    plekton.open_run("out/catch").energy["kinetic"]

All numbers are in SI units; texts may have others, as in "10 ms". docs/python.md has the rest.
"""

from ._core import (
    CheckpointError,
    Diverged,
    Energy,
    Error,
    InputError,
    MeshError,
    OutputError,
    Reaction,
    Simulation,
    Surface,
    __version__,
    first_contact,
    load,
    pairs,
    resume,
    resume_stages,
    run_stages,
    write_mesh,
)
from ._meshes import ImportedMesh, import_mesh, repair_mesh
from ._runs import Frame, History, Run, open_run

__all__ = [
    "CheckpointError",
    "Diverged",
    "Energy",
    "Error",
    "Frame",
    "History",
    "ImportedMesh",
    "InputError",
    "MeshError",
    "OutputError",
    "Reaction",
    "Run",
    "Simulation",
    "Surface",
    "first_contact",
    "import_mesh",
    "load",
    "open_run",
    "pairs",
    "repair_mesh",
    "resume",
    "resume_stages",
    "run_stages",
    "write_mesh",
]
