# SPDX-License-Identifier: GPL-3.0-or-later
# Draws what check.py wrote: gnuplot -c profiles.gnuplot GRID_RUN MEMBRANE_RUN PICTURE.png
set terminal pngcairo size 1200,460 font "sans,11"
set output ARG3
set datafile separator ","
set multiplot layout 1,2
set grid lc rgb "#dddddd"
set key top right
set xlabel "way from the front edge (mm)"
set ylabel "force in the inclusion (N)"
set xrange [0:110]
set yrange [0:*]
plot ARG1."/forces.csv" every ::1 using 1:2 with linespoints lw 2 pt 7 lc rgb "#a0522d" title "grid, bars", \
     "" every ::1 using 1:3 with points pt 6 ps 2 lc rgb "#555555" title "held by soil behind", \
     ARG2."/forces.csv" every ::1 using 1:2 with linespoints lw 2 pt 7 lc rgb "#1f77b4" title "membrane, bars", \
     "" every ::1 using 1:3 with points pt 6 ps 2 lc rgb "#555555" notitle
set xlabel "mean way of grains along the pull (mm)"
set ylabel "height over the inclusion (mm)"
set autoscale
set arrow from 0,graph 0 to 0,graph 1 nohead lc rgb "#999999"
plot ARG1."/displacements.csv" every ::1 using 2:1 with linespoints lw 2 pt 7 lc rgb "#a0522d" title "grid", \
     ARG2."/displacements.csv" every ::1 using 2:1 with linespoints lw 2 pt 7 lc rgb "#1f77b4" title "membrane"
unset multiplot
