# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws the pictures of this folder with ParaView (Debian packages: paraview, xvfb); README.md has the commands before it.

    xvfb-run -a -s "-screen 0 1600x1000x24" pvpython render.py generators out/generators generators.png
    xvfb-run -a -s "-screen 0 1600x1000x24" pvpython render.py repair bag.off out/repair out/remesh repair.png
"""
import json
import os
import sys

from paraview.simple import (CreateLayout, CreateView, SaveScreenshot, Show, Text, TrivialProducer, Tube,
                             XMLPolyDataReader, servermanager)
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData

INK = [0.16, 0.18, 0.20]
CLOTH = [0.87, 0.80, 0.66]
SHELL = [0.62, 0.75, 0.80]
NET = [0.22, 0.26, 0.28]
BORDER = [0.80, 0.10, 0.10]
FLIPPED = [0.95, 0.55, 0.15]
FILLED = [0.36, 0.66, 0.36]


# Data: polygons and lines over points.

def polydata(points, lines, facets):
    data = vtkPolyData()
    positions = vtkPoints()
    positions.SetDataTypeToDouble()
    for point in points:
        positions.InsertNextPoint(point)
    data.SetPoints(positions)
    for cells, set_cells in ((lines, data.SetLines), (facets, data.SetPolys)):
        array = vtkCellArray()
        for cell in cells:
            array.InsertNextCell(len(cell), cell)
        set_cells(array)
    return data


def source_of(points, lines, facets):
    """Only the points in use, so that the camera sees nothing else."""
    number = {}
    cells = [[[number.setdefault(k, len(number)) for k in cell] for cell in group] for group in (lines, facets)]
    source = TrivialProducer()
    source.GetClientSideObject().SetOutput(polydata([points[k] for k in number], *cells))
    return source


def edges_of(facets):
    return sorted({tuple(sorted((f[k], f[(k + 1) % 3]))) for f in facets for k in range(3)})


def read_off(path):
    with open(path) as file:
        words = file.read().split()[1:]
    count, facet_count = int(words[0]), int(words[1])
    values = words[3:]
    points = [tuple(map(float, values[3 * i:3 * i + 3])) for i in range(count)]
    corners = values[3 * count:]
    return points, [[int(k) for k in corners[4 * i + 1:4 * i + 4]] for i in range(facet_count)]


# Views and what they show.

def new_view(camera, focus, scale):
    view = CreateView("RenderView")
    view.OrientationAxesVisibility = 0
    view.UseColorPaletteForBackground = 0
    view.Background = [1.0, 1.0, 1.0]
    view.CameraPosition = [f + c for f, c in zip(focus, camera)]
    view.CameraFocalPoint = focus
    view.CameraViewUp = [0.0, 0.0, 1.0]
    view.CameraParallelProjection = 1
    view.CameraParallelScale = scale
    return view


def show(source, view, colour, **properties):
    shown = Show(source, view)
    shown.ColorArrayName = ["POINTS", ""]  # none
    shown.AmbientColor = shown.DiffuseColor = colour
    shown.Ambient, shown.Diffuse, shown.Specular = 0.4, 0.68, 0.0
    shown.Interpolation = "Flat"
    for name, value in properties.items():
        setattr(shown, name, value)
    return shown


def show_facets(points, facets, view, colour, line):
    """Facets with their sides as lines; seen from behind they are darker."""
    dark = [0.6 * c for c in colour]
    show(source_of(points, [], facets), view, colour, Representation="Surface With Edges", EdgeColor=INK, LineWidth=line,
         BackfaceRepresentation="Surface", BackfaceAmbientColor=dark, BackfaceDiffuseColor=dark)


def show_bars(points, lines, view, colour, radius):
    bars = Tube(Input=source_of(points, lines, []), Radius=radius, NumberofSides=12, Capping=1)
    bars.VaryRadius = "Off"
    show(bars, view, colour, Ambient=1.0, Diffuse=0.0)


def write(view, text, corner, size, colour=INK, bold=0):
    shown = Show(Text(Text=text), view)
    shown.WindowLocation = corner
    shown.FontSize = size
    shown.Color = colour
    shown.Bold = bold
    shown.FontFamily = "Arial"
    shown.Justification = "Left" if "Left" in corner else "Center"
    return shown


def save(layout, picture, size):
    layout.SetSize(*size)
    SaveScreenshot(picture, layout, ImageResolution=size, SeparatorWidth=0, CompressionLevel="9")


def fill_layout(views, columns):
    """A layout of views of the same size, row by row."""
    layout = CreateLayout("picture")
    rows = len(views) // columns
    cell = 0
    for row in range(rows):
        # The children of cell k are 2 k + 1 and 2 k + 2.
        if row < rows - 1:
            layout.SplitVertical(cell, 1.0 / (rows - row))
        part = 2 * cell + 1 if row < rows - 1 else cell
        for column in range(columns):
            if column < columns - 1:
                layout.SplitHorizontal(part, 1.0 / (columns - column))
            place = 2 * part + 1 if column < columns - 1 else part
            layout.AssignView(place, views[columns * row + column])
            part = 2 * part + 2
        cell = 2 * cell + 2
    return layout


# The shapes.

def draw_generators(folder, picture):
    """A panel for each membrane of generators.toml, which stand 1 m apart in x and y."""
    reader = XMLPolyDataReader(FileName=[os.path.join(folder, "frames", "membranes_00000.vtp")])
    data = servermanager.Fetch(reader)
    points = [data.GetPoint(k) for k in range(data.GetNumberOfPoints())]
    views = []
    for row, column, title in PANELS:
        def is_here(cell):
            x, y, _ = points[cell[0]]
            return round(x) == column and round(-y) == row
        cells = [cell for cell in cells_of(data) if is_here(cell)]
        facets = [cell for cell in cells if len(cell) == 3]
        lines = [cell for cell in cells if len(cell) == 2]
        nodes = len({k for cell in cells for k in cell})
        view = new_view([-0.35, -1.0, 0.95], [column, -row, 0.0], 0.225)
        if facets:
            show_facets(points, facets, view, SHELL if row == 1 else CLOTH, 1.0)
        else:
            show_bars(points, lines, view, NET, 0.002)
        write(view, title, "Upper Center", 20, bold=1)
        counts = f"{nodes} nodes, " + (f"{len(facets)} facets" if facets else f"{len(lines)} bars")
        write(view, counts, "Lower Center", 16)
        views.append(view)
    save(fill_layout(views, 3), picture, [960, 800])


PANELS = [(0, 0, "sheet, diagonal"), (0, 1, "sheet, alternating"), (0, 2, "sheet, cross"),
          (1, 0, "tube"), (1, 1, "sphere"), (1, 2, "box"),
          (2, 0, "biaxial_geogrid"), (2, 1, "uniaxial_geogrid"), (2, 2, "hexagonal_net")]


def cells_of(data):
    cells = (data.GetCell(k) for k in range(data.GetNumberOfCells()))
    return [[cell.GetPointId(k) for k in range(cell.GetNumberOfPoints())] for cell in cells]


# The repair.

def borders_of(facets):
    """Edges with one facet."""
    count = {}
    for facet in facets:
        for edge in edges_of([facet]):
            count[edge] = count.get(edge, 0) + 1
    return [edge for edge, uses in count.items() if uses == 1]


def faces_inward(points, facet):
    """The bag lies around the origin and every ray from there leaves it once."""
    a, b, c = (points[k] for k in facet)
    u, v = ([q - p for p, q in zip(a, x)] for x in (b, c))
    normal = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
    return sum(n * p for n, p in zip(normal, a)) < 0.0


def draw_bag(title, notes, points, facets, new=0):
    """@param new  How many of the last facets were added."""
    view = new_view([-0.35, -0.75, 0.85], [0.0, 0.0, -0.075], 0.425)
    old = facets[:len(facets) - new]
    outward = [f for f in old if not faces_inward(points, f)]
    inward = [f[::-1] for f in old if faces_inward(points, f)]  # so that their light side shows
    for group, colour in ((outward, CLOTH), (inward, FLIPPED), (facets[len(old):], FILLED)):
        if group:
            show_facets(points, group, view, colour, 0.7)
    if borders_of(facets):
        show_bars(points, borders_of(facets), view, BORDER, 0.003)
    write(view, title, "Upper Center", 18, bold=1)
    write(view, notes, "Lower Center", 14)
    return view


def repaired(folder):
    with open(os.path.join(folder, "report.json")) as file:
        return (*read_off(os.path.join(folder, "bag-repaired.off")), json.load(file))


def draw_repair(broken, repair, remesh, picture):
    points, facets = read_off(broken)
    fixed_points, fixed_facets, fixed = repaired(repair)
    even_points, even_facets, even = repaired(remesh)
    found, changed, filled, after = (fixed[key] for key in ("found", "changed", "reshaped", "after"))
    came = (f"{found['points']} points, {found['polygons']} facets\n"
            f"{changed['points_merged']} points twice, {changed['points_welded']} nearly (seam open, red)\n"
            f"{changed['flipped_facets']} facets flipped (orange)\n"
            f"{changed['zero_area_facets']} without area, {changed['duplicate_facets']} twice")
    closed = (f"{after['points']} nodes, {after['facets']} facets\n"
              f"{filled['holes_filled']} holes filled with {filled['hole_facets']} facets (green)\n"
              f"closed, {1e3 * after['volume']:.1f} litres\n"
              f"smallest angle {after['smallest_angle']:.0f} deg")
    remeshed = (f"{even['after']['points']} nodes, {even['after']['facets']} facets\n"
                f"edges of {1e3 * even['after']['mean_edge']:.0f} mm on average\n"
                f"closed, {1e3 * even['after']['volume']:.1f} litres\n"
                f"smallest angle {even['after']['smallest_angle']:.0f} deg")
    views = [draw_bag("as it came", came, points, facets),
             draw_bag("repaired", closed, fixed_points, fixed_facets, filled["hole_facets"]),
             draw_bag(f"remeshed to {1e3 * even['reshaped']['target_edge']:.0f} mm", remeshed, even_points, even_facets)]
    save(fill_layout(views, 3), picture, [1290, 480])


if __name__ == "__main__":
    {"generators": draw_generators, "repair": draw_repair}[sys.argv[1]](*sys.argv[2:])
