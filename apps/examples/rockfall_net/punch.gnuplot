# SPDX-License-Identifier: GPL-3.0-or-later
# Draws what punch_check.py wrote: gnuplot -c punch.gnuplot RUN PICTURE.png
set terminal pngcairo size 900,480 font "sans,11"
set output ARG2
set datafile separator ","
set grid lc rgb "#dddddd"
set key top left
set xlabel "displacement of the cap (mm)"
set ylabel "force (kN)"
set xrange [0:*]
set yrange [0:*]
plot ARG1."/punch.csv" every ::1 using (1e3 * $1):(1e-3 * $2) with lines lw 2 lc rgb "#08519c" title "on the cap", \
     "" every ::1 using (1e3 * $1):(1e-3 * $3) with lines lc rgb "#ef6548" title "on the rim", \
     26.7 with lines dt 2 lw 2 lc rgb "#222222" title "ASTM A975, mesh 8x10: at least, galvanized", \
     23.6 with lines dt 3 lw 2 lc rgb "#222222" title "at least, PVC coated"
