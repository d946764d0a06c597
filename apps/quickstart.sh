#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Installs what is missing (Debian 12, as root or with sudo), builds the program and catches a thousand grains with a
# hammock of geotextile: the scenario apps/examples/catch/catch.toml, written to out/catch.
set -eu
CDPATH='' cd -- "$(dirname -- "$0")/.."
. cmake/debian.sh

begun=$(date +%s)
need_packages build
built_from=$(date +%s)
say "Configuring build/release"
cmake --preset release -DPLEKTON_BUILD_TESTS=OFF
say "Building the program"
cmake --build --preset release --parallel "$(nproc)" --target plekton
build_time=$(seconds_since "$built_from")

# is_done: whether the run has come to its end and neither the program nor the scenario has changed since.
is_done() {
  grep -Eq '"status": *"(at_rest|finished)"' out/catch/run.json 2> /dev/null || return 1
  [ -z "$(find -L build/release/apps/plekton build/release/*/libplekton_*.so apps/examples/catch/catch.toml \
    apps/examples/catch/hammock.stl -newer out/catch/run.json)" ]
}

run_from=$(date +%s)
if is_done; then
  say "The run of apps/examples/catch/catch.toml is done; remove out/catch to do it again"
else
  say "Running apps/examples/catch/catch.toml"
  # What is there is of another program or scenario, or was not finished.
  build/release/apps/plekton run apps/examples/catch/catch.toml --out out/catch --overwrite --threads 2
fi
run_time=$(seconds_since "$run_from")

say "Summary, from out/catch/run.json"
cmake -DREPORT=out/catch/run.json -P cmake/run_summary.cmake
build/release/apps/plekton view out/catch
say "Written; open view.html in a browser, the .pvd files with ParaView"
for file in out/catch/view.html out/catch/*.pvd out/catch/*.csv out/catch/run.json; do
  if [ -e "$file" ]; then
    echo "  $file"
  fi
done
say "Took $(seconds_since "$begun") s: installing $((built_from - begun)) s, building $build_time s, running $run_time s, with $(nproc) processors"
