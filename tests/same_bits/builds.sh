#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Builds the program for any x86-64 (SSE2), for AVX2 with fused operations and for the processor of this machine, and runs the scenes
# with each: all have to give the same bits. Takes three builds of the program, in build/bits-*; not part of the tests that CI runs. Arguments go to compare.py.
set -eu
CDPATH='' cd -- "$(dirname -- "$0")/../.."

build() {  # name, compiler flags
  cmake --preset release -B "build/bits-$1" -DPLEKTON_BUILD_TESTS=OFF -DCMAKE_CXX_FLAGS="$2" > "build/bits-$1.log"
  cmake --build "build/bits-$1" --target plekton >> "build/bits-$1.log"
}

mkdir -p build
build sse2 "-march=x86-64"
build avx2 "-march=x86-64-v3"
build native "-march=native"
python3 -B tests/same_bits/compare.py build/bits-sse2/apps/plekton build/bits-avx2/apps/plekton build/bits-native/apps/plekton "$@"
