# SPDX-License-Identifier: GPL-3.0-or-later
# Draws deviator stress and volume over axial strain: gnuplot -c curves.gnuplot DENSE_RUN LOOSE_RUN PICTURE.png (after check.py)
set terminal pngcairo size 550,700 font "sans,11"
set output ARG3
set datafile separator ","
set grid lc rgb "#dddddd"
set xlabel "axial strain (%)"
set xrange [0:10]
set multiplot layout 2,1
set key bottom right
set ylabel "deviator stress (kPa)"
set yrange [0:*]
plot ARG1."/triaxial.csv" every ::1 using 1:2 with lines lw 2 lc rgb "#9400d3" title "dense", \
     ARG2."/triaxial.csv" every ::1 using 1:2 with lines lw 2 lc rgb "#009e73" title "loose"
set key top left
set ylabel "volume strain (%)"
set yrange [*:*]
plot ARG1."/triaxial.csv" every ::1 using 1:3 with lines lw 2 lc rgb "#9400d3" title "dense, dilates", \
     ARG2."/triaxial.csv" every ::1 using 1:3 with lines lw 2 lc rgb "#009e73" title "loose, contracts"
unset multiplot
