# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws one moment of a run, for pvbatch of ParaView: grains by their speed, membranes by the tension of their edges, planes
pale. plekton render writes this file and calls it with

    PICTURE GRAINS MEMBRANES PLANES TITLE

GRAINS and MEMBRANES are frames (.vtp) or empty, PLANES seven numbers for each plane, as in planes.csv: a point,
the normal (of a cylinder its axis, 0 of a sphere), the radius (0 of a flat one).
"""
import sys

import paraview.simple as pv

picture, grains_file, membranes_file, planes, title = sys.argv[1:6]
view = pv.CreateView("RenderView")
view.ViewSize = [1200, 800]
view.UseColorPaletteForBackground = 0
view.Background = [1.0, 1.0, 1.0]
view.OrientationAxesVisibility = 1
INK = [0.1, 0.1, 0.1]


def coloured(shown, where, name, head, place):
    pv.ColorBy(shown, (where, name) if name != "velocity" else (where, name, "Magnitude"))
    shown.RescaleTransferFunctionToDataRange(False, True)
    bar = pv.GetScalarBar(pv.GetColorTransferFunction(name), view)
    bar.Title, bar.ComponentTitle = head, ""
    bar.TitleColor = bar.LabelColor = INK
    bar.ScalarBarLength = 0.3
    bar.WindowLocation = place
    shown.SetScalarBarVisibility(view, True)


def has_points(reader):
    reader.UpdatePipeline()
    return reader.GetDataInformation().GetNumberOfPoints() > 0


boxes = []
if grains_file:
    grains = pv.XMLPolyDataReader(FileName=[grains_file])
    if has_points(grains):
        # A glyph scales a ball of diameter 1, so the scale is twice the radius.
        balls = pv.Glyph(Input=grains, GlyphType="Sphere", ScaleArray=["POINTS", "radius"], ScaleFactor=2.0, GlyphMode="All Points")
        balls.GlyphType.ThetaResolution = balls.GlyphType.PhiResolution = 20
        coloured(pv.Show(balls, view), "POINTS", "velocity", "speed of grains (m/s)", "Lower Right Corner")
        boxes.append(balls)
if membranes_file:
    membranes = pv.XMLPolyDataReader(FileName=[membranes_file])
    if has_points(membranes):
        cloth = pv.Show(membranes, view)
        cloth.Representation = "Surface With Edges"
        cloth.LineWidth = 2.0
        low_tension, high_tension = membranes.CellData["tension"].GetRange()
        if max(abs(low_tension), abs(high_tension)) > 1e-9:  # N; facets alone have none
            coloured(cloth, "CELLS", "tension", "tension (N)", "Upper Right Corner")
        else:
            cloth.ColorArrayName = ["POINTS", ""]
            cloth.DiffuseColor = cloth.AmbientColor = [0.78, 0.74, 0.62]
            cloth.Opacity = 0.6
        boxes.append(membranes)

bounds = [pv.servermanager.Fetch(source).GetBounds() for source in boxes]
low = [min(b[2 * k] for b in bounds) for k in range(3)] if bounds else [-0.5] * 3
high = [max(b[2 * k + 1] for b in bounds) for k in range(3)] if bounds else [0.5] * 3
middle = [0.5 * (a + b) for a, b in zip(low, high)]
size = max(b - a for a, b in zip(low, high)) or 1.0


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def show_plane(point, normal):
    """A square below, or beside, the middle of what is to be seen."""
    depth = sum((m - p) * n for m, p, n in zip(middle, point, normal))
    foot = [m - depth * n for m, n in zip(middle, normal)]
    axis = [1.0, 0.0, 0.0] if abs(normal[0]) < 0.9 else [0.0, 1.0, 0.0]
    side = cross(normal, axis)
    length = sum(c * c for c in side) ** 0.5
    side = [c / length for c in side]
    other = cross(normal, side)
    corner = [f - 0.75 * size * (a + b) for f, a, b in zip(foot, side, other)]
    plane = pv.Plane(Origin=corner, Point1=[c + 1.5 * size * a for c, a in zip(corner, side)],
                     Point2=[c + 1.5 * size * b for c, b in zip(corner, other)])
    show_pale(plane, 0.25)


def show_container(point, axis, radius):
    """A cylinder as long as what is to be seen, or a sphere."""
    if not any(axis):
        show_pale(pv.Sphere(Center=point, Radius=radius, ThetaResolution=96, PhiResolution=96), 0.12)
        return
    along = sum((m - p) * a for m, p, a in zip(middle, point, axis))
    ends = [[p + (along + reach) * a for p, a in zip(point, axis)] for reach in (-0.6 * size, 0.6 * size)]
    show_pale(pv.Tube(Input=pv.Line(Point1=ends[0], Point2=ends[1]), Radius=radius, NumberofSides=96, Capping=0), 0.12)


def show_pale(surface, opacity):
    shown = pv.Show(surface, view)
    shown.Opacity = opacity
    shown.DiffuseColor = shown.AmbientColor = [0.6, 0.62, 0.65]


numbers = [float(word) for word in planes.split()]
for i in range(0, len(numbers), 7):
    point, direction, radius = numbers[i : i + 3], numbers[i + 3 : i + 6], numbers[i + 6]
    if radius > 0.0:
        show_container(point, direction, radius)
    else:
        show_plane(point, direction)

text = pv.Show(pv.Text(Text=title), view)
text.Color = INK
text.WindowLocation = "Upper Left Corner"

view.CameraFocalPoint = middle
view.CameraPosition = [middle[0] + 0.9 * size, middle[1] - 1.9 * size, middle[2] + 1.1 * size]
view.CameraViewUp = [0.0, 0.0, 1.0]
pv.Render(view)
view.ResetCamera(low[0], high[0], low[1], high[1], low[2], high[2])
pv.Render(view)
pv.SaveScreenshot(picture, view)
