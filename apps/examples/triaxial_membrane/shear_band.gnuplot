# SPDX-License-Identifier: GPL-3.0-or-later
# Draws slices along the axis, across the slab of most strain: gnuplot -c shear_band.gnuplot RUN PICTURE.png (after shear_band.py)
set terminal pngcairo size 1200,640 font "sans,11"
set output ARG2
set datafile separator ","
set size ratio -1
set xrange [-26:26]
set yrange [-2:84]
set xlabel "mm"
set style fill solid noborder
set palette defined (0 "#e8eef4", 0.35 "#6fa8dc", 0.7 "#7b3fa0", 1 "#c00020")
file = ARG1."/shear_band.csv"
near(y, r) = abs(y) < 2 ? r : NaN  # of the axis, mm
set multiplot layout 1,3
set cbrange [0:3]
set title "deviatoric strain over its mean, first percent"
plot file every ::1 using 1:3:(near($2, $11)):4 with circles lc palette notitle
set title "the same, last increment"
plot file every ::1 using 6:8:(near($7, $11)):9 with circles lc palette notitle
set cbrange [0:20]
set title "rotation (degrees), last increment"
plot file every ::1 using 6:8:(near($7, $11)):10 with circles lc palette notitle
unset multiplot
