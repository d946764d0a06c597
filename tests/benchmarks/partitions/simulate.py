# SPDX-License-Identifier: GPL-3.0-or-later
"""How fast many ranks would be on a cluster that SimGrid imagines: steps of 10 million spheres in a box, of which plekton-bench-partitions
counts what each rank computes and tells. Two ways: "whole", with lists made whole by every rank, and "planned", where each is told of
spheres near it alone. Before that it prints what was counted.

Usage: python3 simulate.py PLEKTON-BENCH-PARTITIONS [--spheres 10000000] [--ranks 8 64 256 512]

Ends 77 where there is no SimGrid (Debian: libsimgrid-dev).
"""

import argparse
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

SKIPPED = 77

PLATFORM = """<?xml version='1.0'?>
<!DOCTYPE platform SYSTEM "https://simgrid.org/simgrid.dtd">
<platform version="4.1">
  <cluster id="cluster" prefix="node-" suffix="" radical="0-{last}" speed="1Gf" bw="12.5GBps" lat="1us"/>
</platform>
"""
"""One rank a machine, each with a link of 100 Gbit/s and 1 us to a switch."""


def simulated(program, parts, ranks, way, folder):
    """ms that a step takes on one process and on these ranks, and their efficiency."""
    (folder / "cluster.xml").write_text(PLATFORM.format(last=ranks - 1), encoding="utf-8")
    (folder / "hosts").write_text("".join(f"node-{i}\n" for i in range(ranks)), encoding="utf-8")
    ended = subprocess.run(
        ["smpirun", "-np", str(ranks), "-platform", folder / "cluster.xml", "-hostfile", folder / "hosts",
         "--cfg=smpi/simulate-computation:no", "--log=root.thres:error", program, parts, way],
        capture_output=True, text=True, check=False)
    if ended.returncode != 0:
        sys.exit(f"smpirun failed:\n{ended.stdout}\n{ended.stderr}")
    return [float(number) for number in ended.stdout.split()]


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("partitions", help="the program plekton-bench-partitions")
    options.add_argument("--spheres", type=int, default=10000000)
    options.add_argument("--ranks", type=int, nargs="+", default=[8, 64, 256, 512], help="of those that the program counts")
    asked = options.parse_args()
    if shutil.which("smpicxx") is None or shutil.which("smpirun") is None:
        print("skipped: there is no SimGrid (Debian: libsimgrid-dev)")
        return SKIPPED
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        subprocess.run([asked.partitions, "--spheres", str(asked.spheres), "--write", folder], check=True)
        program = folder / "simulated"
        subprocess.run(["smpicxx", "-std=c++20", "-O2", Path(__file__).with_name("simulated.cpp"), "-o", program], check=True)
        print("\nranks      way  ms of one  ms a step  efficiency")
        for way in ("whole", "planned"):
            for ranks in asked.ranks:
                one, step, efficiency = simulated(program, folder / f"{ranks}.txt", ranks, way, folder)
                print(f"{ranks:5} {way:>8} {one:10.1f} {step:10.3f} {efficiency:11.3f}", flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
