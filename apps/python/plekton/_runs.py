# SPDX-License-Identifier: GPL-3.0-or-later
"""What a run has written, as arrays."""

from collections.abc import Mapping, Sequence
from pathlib import Path

from . import _core


class History(Mapping):
    """A CSV file of a run: its columns as arrays, by their names; `units` has their units ("" of a number)."""

    def __init__(self, file):
        self._file = file
        self._columns, self.units = _core._read_history(file)

    def __getitem__(self, name):
        if name in self._columns:
            return self._columns[name]
        there = f"there are {', '.join(self._columns)}" if self._columns else "its first line, the names of all, has no end: it is cut off or just begun"
        raise KeyError(f"{self._file}: has no column {name!r}; {there}")

    def __iter__(self):
        return iter(self._columns)

    def __len__(self):
        return len(self._columns)

    def __repr__(self):
        rows = len(next(iter(self._columns.values()), ()))
        return f"<plekton.History of {rows} rows: {', '.join(self._columns)}>"


class Frame:
    """What a run looked like at a moment. Data sets are dicts: positions (m, (N, 3)), lines and facets by the numbers of
    their points, and the arrays of_points and of_cells (of lines, then facets), by the names that ParaView shows."""

    def __init__(self, time, files):
        self.time = time
        self._files = files

    def __repr__(self):
        return f"<plekton.Frame at {self.time} s: {', '.join(self._files)}>"

    def _read(self, series):
        return _core._read_frame(self._files[series]) if series in self._files else None

    @property
    def grains(self):
        """The spheres; None if none were written."""
        return self._read("grains")

    @property
    def membranes(self):
        """Membranes and nets; None if none were written."""
        return self._read("membranes")

    @property
    def contacts(self):
        """The contacts; None if none were written."""
        return self._read("contacts")


class _Frames(Sequence):
    def __init__(self, times, files):
        self._times = times
        self._files = files

    def __len__(self):
        return len(self._files)

    def __getitem__(self, place):
        if isinstance(place, slice):
            return _Frames(self._times[place], self._files[place])
        return Frame(float(self._times[place]), self._files[place])


class Run:
    """The folder of a run, as it was when it was opened; the run may go on."""

    def __init__(self, folder):
        self.folder = Path(folder)
        self.report, self.times, files = _core._open_run(folder)
        self.frames = _Frames(self.times, files)

    def __repr__(self):
        return f"<plekton.Run {str(self.folder)!r} of {len(self.frames)} frames>"

    def history(self, name):
        """A CSV file of the run by its name, as in "energy.csv"."""
        return History(self.folder / name)

    @property
    def energy(self):
        """energy.csv: energies, contacts, overlap, over time."""
        return self.history("energy.csv")

    @property
    def reactions(self):
        """reactions.csv: columns as in "floor.force_z"."""
        return self.history("reactions.csv")

    @property
    def pressures(self):
        """pressures.csv"""
        return self.history("pressures.csv")

    def view(self, out=None):
        """Writes the page of plekton view, view.html in the folder if not told otherwise, and returns its path."""
        return _core._view_run(self.folder, Path(out) if out is not None else self.folder / "view.html")


def open_run(folder):
    """Opens the folder that a run has written, or is writing.

    `report` is run.json (None before the end), `times` are those of the `frames`, and histories are arrays by the names
    of their columns."""
    return Run(folder)
