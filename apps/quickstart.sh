#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Installs what is missing (Debian 12, as root or with sudo), builds the program and catches a thousand grains with a
# hammock of geotextile: the scenario apps/examples/catch/catch.toml, written to out/catch.
set -eu
CDPATH='' cd -- "$(dirname -- "$0")/.."
. cmake/debian.sh

need_packages build
say "Configuring build/release"
cmake --preset release -DPLEKTON_BUILD_TESTS=OFF
say "Building the program"
cmake --build --preset release --parallel "$(nproc)" --target plekton
say "Running apps/examples/catch/catch.toml"
build/release/apps/plekton run apps/examples/catch/catch.toml --out out/catch --threads 2

say "Summary, from out/catch/run.json"
cmake -DREPORT=out/catch/run.json -P cmake/run_summary.cmake
say "Written; open the .pvd files with ParaView"
for file in out/catch/*.pvd out/catch/*.csv out/catch/run.json; do
  if [ -e "$file" ]; then
    echo "  $file"
  fi
done
