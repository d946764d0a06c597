#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Installs what is missing (Debian 12, as root or with sudo), builds everything and runs all tests.
set -eu
CDPATH='' cd -- "$(dirname -- "$0")/.."
. cmake/debian.sh

need_packages build test
say "Configuring build/release"
cmake --preset release -DPLEKTON_BUILD_TESTS=ON
say "Building"
cmake --build --preset release --parallel "$(nproc)"
say "Running the tests"
ctest --preset release --output-on-failure -j2
say "All tests passed"
