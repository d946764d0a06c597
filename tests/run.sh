#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Installs what is missing (Debian 12, as root or with sudo), builds everything and runs all tests.
#
#   sh tests/run.sh                       all tests, as CI does
#   sh tests/run.sh --coverage            which lines of geometry, contact and dynamics their own tests run, in build/coverage: at
#                                         least 90 % of each, and which lines they do not
#   sh tests/run.sh --coverage geometry   the same of these folders alone
set -eu
CDPATH='' cd -- "$(dirname -- "$0")/.."
. cmake/debian.sh

configure() {
  need_packages build python test doc
  say "Configuring build/$1"
  cmake --preset "$1" -DPLEKTON_BUILD_TESTS=ON
}

# What the quick start takes is told at the end: less where a compiler cache has been filled.
run_tests() {
  configure release
  say "Building the program"
  from=$(date +%s)
  cmake --build --preset release --parallel "$(nproc)" --target plekton
  build_time=$(seconds_since "$from")
  say "Running the catch"
  from=$(date +%s)
  build/release/apps/plekton run apps/examples/catch/catch.toml --out build/release/catch --overwrite --threads 2 --quiet
  run_time=$(seconds_since "$from")
  say "Building the tests"
  cmake --build --preset release --parallel "$(nproc)"
  say "Running the tests"
  ctest --preset release --output-on-failure -j2
  say "All tests passed; building the program alone took $build_time s, running the catch $run_time s, with $(nproc) processors"
}

# run_coverage [FOLDER...]: of the lines and of the tests of these folders. What an earlier build has counted is forgotten.
run_coverage() {
  [ $# -gt 0 ] || set -- geometry contact dynamics
  configure coverage
  say "Building"
  # shellcheck disable=SC2046
  cmake --build --preset coverage --parallel "$(nproc)" --target $(printf 'plekton_%s_tests ' "$@")
  find build/coverage -name '*.gcda' -delete
  say "Running the tests"
  ctest --preset coverage --output-on-failure -j2 -R "^($(echo "$@" | tr ' ' '|'))\."
  say "Lines that have run"
  python3 -B tests/coverage/report.py build/coverage "$@" --least 90
}

case "${1:-}" in
  '') run_tests ;;
  --coverage)
    shift
    run_coverage "$@"
    ;;
  *)
    echo "tests/run.sh: unknown argument $1; expected nothing, or --coverage and folders of tests/" >&2
    exit 2
    ;;
esac
