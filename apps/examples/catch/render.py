# SPDX-License-Identifier: GPL-3.0-or-later
"""Renders the picture of the README from a finished run, with ParaView:

    pvpython --force-offscreen-rendering apps/examples/catch/render.py out/catch apps/examples/catch/catch.png
"""
import sys

from paraview.simple import (ColorBy, Calculator, GetActiveViewOrCreate, GetColorTransferFunction, GetScalarBar, Glyph,
                             PVDReader, Render, SaveScreenshot, Show)

folder, picture = sys.argv[1:3]
view = GetActiveViewOrCreate("RenderView")
view.ViewSize = [1400, 800]
view.OrientationAxesVisibility = 0
view.UseColorPaletteForBackground = 0
view.Background = [1.0, 1.0, 1.0]

grains = PVDReader(FileName=f"{folder}/grains.pvd")
sheet = PVDReader(FileName=f"{folder}/membranes.pvd")
last = grains.TimestepValues[-1]

# A glyph scales a ball of diameter 1, so the scale is twice the radius.
balls = Glyph(Input=grains, GlyphType="Sphere", ScaleArray=["POINTS", "radius"], ScaleFactor=2.0, GlyphMode="All Points")
balls.GlyphType.ThetaResolution = balls.GlyphType.PhiResolution = 24
shown = Show(balls, view)
ColorBy(shown, ("POINTS", "radius"))
stone = GetColorTransferFunction("radius")
stone.RGBPoints = [0.003, 0.86, 0.80, 0.68, 0.0055, 0.66, 0.58, 0.48, 0.008, 0.42, 0.37, 0.32]
shown.SetScalarBarVisibility(view, False)

cloth = Show(sheet, view)
cloth.Representation = "Surface With Edges"
cloth.EdgeColor = [0.25, 0.35, 0.45]
ColorBy(cloth, ("CELLS", "tension"))
tension = GetColorTransferFunction("tension")
tension.ApplyPreset("Cool to Warm", True)
tension.RescaleTransferFunction(-1.0, 1.0)
bar = GetScalarBar(tension, view)
bar.Title = "tension (N)"
bar.ComponentTitle = ""
bar.TitleColor = bar.LabelColor = [0.1, 0.1, 0.1]
bar.ScalarBarLength = 0.4
cloth.SetScalarBarVisibility(view, True)

view.ViewTime = last
view.CameraPosition = [0.10, -0.62, 0.30]
view.CameraFocalPoint = [0.0, 0.0, -0.03]
view.CameraViewUp = [0.0, 0.0, 1.0]
view.CameraViewAngle = 34.0
Render(view)
SaveScreenshot(picture, view)
