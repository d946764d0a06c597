# SPDX-License-Identifier: GPL-3.0-or-later
"""Opens a VTKHDF file with the reader of VTK and prints what it sees, one line a block. Ends 77, with a reason, where there
is no reader of such files.

Usage: python3 open_vtkhdf.py FILE
"""
import sys

try:
    from vtkmodules.vtkCommonCore import vtkVersion
    from vtkmodules.vtkIOHDF import vtkHDFReader
except ImportError:
    print("the Python package vtk is not installed (9.4 or later)")
    sys.exit(77)

version = (vtkVersion.GetVTKMajorVersion(), vtkVersion.GetVTKMinorVersion())
if version < (9, 4):
    print(f"VTK {version[0]}.{version[1]} reads no VTKHDF files with several blocks; 9.4 does")
    sys.exit(77)

reader = vtkHDFReader()
reader.SetFileName(sys.argv[1])
reader.Update()
data = reader.GetOutput()
for i in range(data.GetNumberOfBlocks()):
    block = data.GetBlock(i)
    name = data.GetMetaData(i).Get(data.NAME())
    points, cells = block.GetPointData(), block.GetCellData()
    arrays = sorted(d.GetArrayName(k) for d in (points, cells) for k in range(d.GetNumberOfArrays()))
    print(name, block.GetNumberOfPoints(), block.GetNumberOfVerts(), block.GetNumberOfLines(), block.GetNumberOfPolys(), ",".join(arrays))
