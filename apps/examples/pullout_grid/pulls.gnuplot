# SPDX-License-Identifier: GPL-3.0-or-later
# Draws what check.py wrote of runs under three pressures, of one bed after the other:
#   gnuplot -c pulls.gnuplot "GRID_10 GRID_20 GRID_40 [GRID_10_OF_ANOTHER ...]" "MEMBRANE_10 ..." PICTURE.png
set terminal pngcairo size 1200,480 font "sans,11"
set output ARG3
set datafile separator ","
set fit quiet
set fit logfile "/dev/null"
shade(i, shades) = word(shades, (i - 1) % 3 + 1)
brown(i) = shade(i, "#d9a066 #a0522d #5c2e18")
blue(i) = shade(i, "#9ecae1 #1f77b4 #08306b")
points(runs) = "< for run in ".runs."; do tail -n 1 $run/friction.csv; done"
name(i, run) = i > 3 ? "" : system("basename ".run)
set multiplot layout 1,2
set grid lc rgb "#dddddd"
set key top right samplen 2
set xlabel "way of the front edge (mm)"
set ylabel "F / (2 {/Symbol s} A)"
set yrange [0:1]
set xrange [0:7.5]
# Bounds of the mean of the later half of the way.
set arrow from 2.5,0.35 to 5,0.35 nohead dt 2 lc rgb "#a0522d"
set arrow from 2.5,0.65 to 5,0.65 nohead dt 2 lc rgb "#a0522d"
set arrow from 2.5,0.18 to 5,0.18 nohead dt 2 lc rgb "#1f77b4"
set label "grid: 0.35 to 0.65" at 0.1,0.95 textcolor rgb "#a0522d"
set label "membrane: 0.18 to tan 20{/Symbol \260} (means of the later half)" at 0.1,0.89 textcolor rgb "#1f77b4"
plot for [i=1:words(ARG1)] word(ARG1, i)."/shares.csv" every ::1 using 1:2 with lines lw 1.5 lc rgb brown(i) title name(i, word(ARG1, i)), \
     for [i=1:words(ARG2)] word(ARG2, i)."/shares.csv" every ::1 using 1:2 with lines lw 1.5 lc rgb blue(i) title name(i, word(ARG2, i)), \
     tan(20 * pi / 180) with lines dt 2 lw 2 lc rgb "#1f77b4" title "tan 20{/Symbol \260}"
unset arrow
unset label
set key top left
set xlabel "pressure {/Symbol s} (kPa)"
set ylabel "shear stress on either side (kPa)"
set xrange [0:45]
set yrange [0:*]
grid(x) = a * x + b
membrane(x) = c * x + d
fit grid(x) points(ARG1) using 1:2 via a, b
fit membrane(x) points(ARG2) using 1:2 via c, d
plot points(ARG1) using 1:2 with points pt 7 ps 1.5 lc rgb "#a0522d" title "grid", \
     grid(x) with lines lc rgb "#a0522d" title sprintf("%.1f{/Symbol \260}, %.2f kPa", atan(a) * 180 / pi, b), \
     points(ARG2) using 1:2 with points pt 7 ps 1.5 lc rgb "#1f77b4" title "membrane", \
     membrane(x) with lines lc rgb "#1f77b4" title sprintf("%.1f{/Symbol \260}, %.2f kPa", atan(c) * 180 / pi, d), \
     tan(20 * pi / 180) * x with lines dt 2 lc rgb "#555555" title "tan 20{/Symbol \260}"
unset multiplot
