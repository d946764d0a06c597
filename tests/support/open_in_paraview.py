# SPDX-License-Identifier: GPL-3.0-or-later
"""Opens every .vtp and .pvd file of a folder in ParaView and prints what it sees, one line a file.

Usage: pvpython --force-offscreen-rendering open_in_paraview.py FOLDER
"""
import os
import sys

from paraview.simple import PVDReader, UpdatePipeline, XMLPolyDataReader
from paraview.servermanager import Fetch


def arrays(data):
    """name:components:sum of all values, for each array."""
    found = []
    for i in range(data.GetNumberOfArrays()):
        array = data.GetArray(i)
        total = sum(sum(array.GetTuple(k)) for k in range(array.GetNumberOfTuples()))
        found.append(f"{array.GetName()}:{array.GetNumberOfComponents()}:{total:g}")
    return ",".join(found)


def extent(data):
    if data.GetNumberOfPoints() == 0:
        return "nothing"
    low_high = data.GetBounds()
    return " ".join(f"{low_high[i]:g}..{low_high[i + 1]:g}" for i in (0, 2, 4))


def describe(data):
    points = f"points {data.GetNumberOfPoints()} in {extent(data)}"
    cells = f"{data.GetNumberOfVerts()}+{data.GetNumberOfLines()}+{data.GetNumberOfPolys()}"
    return f"{points} cells {cells} [{arrays(data.GetPointData())}] [{arrays(data.GetCellData())}]"


def polydata(path):
    reader = XMLPolyDataReader(FileName=[path])
    UpdatePipeline(proxy=reader)
    times = ",".join(f"{t:g}" for t in reader.TimestepValues)
    return f"time {times} {describe(Fetch(reader))}"


def series(path):
    reader = PVDReader(FileName=path)
    moments = []
    for time in reader.TimestepValues:
        UpdatePipeline(time=time, proxy=reader)
        data = Fetch(reader)
        blocks = data.GetNumberOfBlocks() if data.IsA("vtkMultiBlockDataSet") else 1
        moments.append(f"{time:g} s: {blocks} parts, {data.GetNumberOfPoints()} points")
    return "; ".join(moments)


folder = sys.argv[1]
for name in sorted(os.listdir(folder)):
    path = os.path.join(folder, name)
    print(f"{name}: {series(path) if name.endswith('.pvd') else polydata(path)}")
