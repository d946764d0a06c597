# SPDX-License-Identifier: GPL-3.0-or-later
"""What a user's program takes to compile: the examples with the headers of the library, by g++ -O2."""

import os
import time
from pathlib import Path

from comparison.running import last_lines, run

EXAMPLES = {"compile_first_steps": ("first_steps.cpp", 3.0), "compile_own_law": ("own_law.cpp", 5.0)}
"""Name of the row: the example below apps/examples, and what it may take at most (s, processor time)."""

DEFINES = ("EIGEN_DONT_VECTORIZE", "EIGEN_MAX_ALIGN_BYTES=16", "EIGEN_MAX_STATIC_ALIGN_BYTES=16")
"""As the targets of CMake and pkg-config have."""

PACKAGES = ("/usr/include/eigen3",)
"""What users of the library need besides."""


def command_of(example, headers):
    """Compiles an example; its object goes into the folder of the run."""
    source = Path(__file__).resolve().parents[3] / "apps" / "examples" / example
    include = Path(headers).resolve()
    paths = [f"-I{include}", f"-I{include}/plekton", *(part for package in PACKAGES for part in ("-isystem", package))]
    return [os.environ.get("CXX", "g++"), "-std=c++20", "-O2", *(f"-D{name}" for name in DEFINES), *paths, "-c", str(source), "-o", "example.o"]


def runs(headers, repetitions, timeout):
    """The records of all, as of a code of one thread."""
    for repetition in range(repetitions):
        for scene, (example, _) in EXAMPLES.items():
            begin = time.perf_counter()
            ended = run(command_of(example, headers), 1, timeout)
            wall = time.perf_counter() - begin
            if ended.code != 0:
                raise RuntimeError(f"{example} does not compile with the headers below {headers}: {last_lines(ended.text)}")
            yield {
                "code": "plekton",
                "scene": scene,
                "size": 0,
                "threads": 1,
                "repetition": repetition,
                "ms_per_step": 1e3 * wall,
                "cpu_ms_per_step": 1e3 * wall * ended.share,
                "rss_MiB": ended.rss,
                "share": ended.share,
            }
