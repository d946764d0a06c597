# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws the net of a finished run at some times (s) side by side, wires coloured by their tension, with ParaView:

    xvfb-run -a pvpython apps/examples/net/render.py out/net apps/examples/net/net.png 0.068 0.07 0.072
"""
import sys

from paraview.simple import (ColorBy, CreateLayout, CreateView, ExtractTimeSteps, GetColorTransferFunction, GetScalarBar,
                             PVDReader, Render, SaveScreenshot, Show, Text, Tube)

folder, picture = sys.argv[1:3]
times = [float(text) for text in sys.argv[3:]]
net = PVDReader(FileName=f"{folder}/membranes.pvd")
steps = list(net.TimestepValues)

layout = CreateLayout("net")
views = [CreateView("RenderView") for _ in times]
place = 0
for i, view in enumerate(views):
    layout.AssignView(place, view)
    if i + 1 < len(views):
        place = layout.SplitViewHorizontal(view, 1.0 / (len(views) - i)) + 1
layout.SetSize(460 * len(views), 720)

for time, view in zip(times, views):
    view.OrientationAxesVisibility = 0
    view.UseColorPaletteForBackground = 0
    view.Background = [1.0, 1.0, 1.0]
    nearest = min(range(len(steps)), key=lambda k: abs(steps[k] - time))
    moment = ExtractTimeSteps(Input=net, TimeStepIndices=[nearest])
    wires = Show(Tube(Input=moment, Radius=0.002), view)
    ColorBy(wires, ("CELLS", "tension"))
    tension = GetColorTransferFunction("tension")
    tension.ApplyPreset("Cool to Warm", True)
    tension.RescaleTransferFunction(0.0, 4600.0)
    if view is views[0]:
        bar = GetScalarBar(tension, view)
        bar.Title = "tension (N)"
        bar.ComponentTitle = ""
        bar.Orientation = "Horizontal"
        bar.WindowLocation = "Lower Center"
        bar.ScalarBarLength = 0.6
        bar.TitleColor = bar.LabelColor = [0.1, 0.1, 0.1]
        wires.SetScalarBarVisibility(view, True)
    label = Show(Text(Text=f"{1e3 * steps[nearest]:.0f} ms"), view)
    label.Color = [0.1, 0.1, 0.1]
    label.WindowLocation = "Upper Center"
    Render(view)
    view.CameraParallelProjection = 1
    view.CameraPosition = [0.0, 0.05, 2.0]
    view.CameraFocalPoint = [0.0, 0.05, 0.0]
    view.CameraViewUp = [0.0, 1.0, 0.0]
    view.CameraParallelScale = 0.6
SaveScreenshot(picture, layout)
