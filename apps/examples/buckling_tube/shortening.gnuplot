# SPDX-License-Identifier: GPL-3.0-or-later
# Draws force over shortening with what theory says: gnuplot -c shortening.gnuplot LATTICE_RUN SHEET_RUN PICTURE.png (after check.py)
set terminal pngcairo size 900,480 font "sans,11"
set output ARG3
set datafile separator ","
set grid lc rgb "#dddddd"
set key top right
set xlabel "shortening over that at the buckling load of theory"
set ylabel "force over the buckling load of theory"
set xrange [0:*]
set yrange [0:1.4]
elastic(x) = x < 1.1 ? x : 1/0
plot ARG1."/shortening.csv" every ::1 using 1:2 with lines lw 2 lc rgb "#08519c" title "lattice", \
     ARG2."/shortening.csv" every ::1 using 1:2 with lines lw 2 lc rgb "#cb181d" title "sheet", \
     1.0 with lines dt 2 lw 2 lc rgb "#222222" title "buckling load, theory", \
     elastic(x) with lines dt 3 lw 2 lc rgb "#222222" title "stiffness, theory"
