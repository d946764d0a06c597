# SPDX-License-Identifier: GPL-3.0-or-later
"""Renders the picture of the README from a finished run, with ParaView:

    xvfb-run -a pvpython apps/examples/catch/render.py out/catch apps/examples/catch/catch.png
"""
import sys

from paraview.simple import (ColorBy, GetActiveViewOrCreate, GetColorTransferFunction, GetScalarBar, Glyph, PVDReader,
                             Render, SaveScreenshot, Show)

folder, picture = sys.argv[1:3]
view = GetActiveViewOrCreate("RenderView")
view.ViewSize = [1200, 640]
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
cloth.Representation = "Surface"
cloth.LineWidth = 1.5
ColorBy(cloth, ("CELLS", "tension"))
tension = GetColorTransferFunction("tension")
tension.ApplyPreset("Cool to Warm", True)
tension.RescaleTransferFunction(-0.5, 0.5)
bar = GetScalarBar(tension, view)
bar.Title = "tension (N)"
bar.ComponentTitle = ""
bar.TitleColor = bar.LabelColor = [0.1, 0.1, 0.1]
bar.ScalarBarLength = 0.35
bar.WindowLocation = "Lower Right Corner"
cloth.SetScalarBarVisibility(view, True)

view.ViewTime = last
Render(view)  # the first one sets the camera itself
view.CameraPosition = [0.09, -0.42, 0.29]
view.CameraFocalPoint = [0.01, -0.01, -0.045]
view.CameraViewUp = [0.0, 0.0, 1.0]
view.CameraViewAngle = 40.0
SaveScreenshot(picture, view)
