# SPDX-License-Identifier: GPL-3.0-or-later
# Prints what came of a run, a line for each figure. Usage: cmake -DREPORT=run.json -P run_summary.cmake
cmake_minimum_required(VERSION 3.24)

file(READ "${REPORT}" report)

# figure(text path...): prints the value at this path of the report; an error names the path if there is none.
function(figure text)
  string(JSON value ERROR_VARIABLE problem GET "${report}" ${ARGN})
  if(problem)
    list(JOIN ARGN "." path)
    message(FATAL_ERROR "${REPORT}: no ${path}: ${problem}; run it again with this version of plekton")
  endif()
  execute_process(COMMAND ${CMAKE_COMMAND} -E echo "  ${text}: ${value}")
endfunction()

figure("status" status)
figure("wall time, s" timing wall_time_s)
figure("simulated time, s" timing simulated_time_s)
figure("steps" timing steps)
figure("largest overlap over radius" largest_overlap_ratio)
figure("time step over critical" dt_over_critical)
figure("energy closure" energy_closure)
figure("lost grains" lost_grains)
