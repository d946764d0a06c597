# SPDX-License-Identifier: GPL-3.0-or-later
# Draws what check.py wrote: gnuplot -c rockfall.gnuplot RUN PICTURE.png
set terminal pngcairo size 1400,420 font "sans,11"
set output ARG2
set datafile separator ","
set multiplot layout 1,3
set grid lc rgb "#dddddd"
set key top left samplen 2
set xlabel "time (ms)"
set ylabel "force on the boulder (kN)"
set y2label "boulder below the net (m)"
set y2tics
set ytics nomirror
set yrange [0:*]
plot ARG1."/boulder.csv" every ::1 using 1:2 with lines lc rgb "#cb181d" title "force", \
     "" every ::1 using 1:3 axes x1y2 with lines lw 2 lc rgb "#08519c" title "way"
unset y2tics
unset y2label
set ytics mirror
set ylabel "largest tension of a rope (kN)"
set key center center
set yrange [0:12]
plot for [i=2:5] ARG1."/ropes.csv" every ::1 using 1:i with lines title word("left right front back", i - 1), \
     10 with lines dt 2 lw 2 lc rgb "#222222" title "brakes pay out"
set ylabel "energy (kJ)"
set key center right
set yrange [*:*]
plot for [i=2:8] ARG1."/split.csv" using 1:i with lines lw 2 title columnheader(i)
unset multiplot
