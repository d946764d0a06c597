# SPDX-License-Identifier: GPL-3.0-or-later
"""What the figures depend on: the machine, its load, and the versions of the codes."""

import os
import platform
from pathlib import Path


def processor():
    """Its model name; the architecture where the system does not tell."""
    info = Path("/proc/cpuinfo")
    lines = info.read_text(encoding="utf-8").splitlines() if info.exists() else []
    names = [line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")]
    return names[0] if names else platform.machine()


def description(found, asked):
    """Lines on the machine, its load and the codes, with the peers that were asked for and are not there."""
    load = os.getloadavg()[0]
    lines = [f"{processor()}, {os.cpu_count()} processors, Linux {platform.release()}, load {load:.2f}"]
    if load > 0.5:
        lines.append("Other work runs on this machine; quote ratios, and with --clock cpu.")
    lines += [f"{code.name}: {code.version}" for code in found if code.version]
    names = {code.name for code in found}
    missing = [name for name in asked if name not in names and name not in ("lammps-native", "loop")]
    if missing:
        lines.append(f"not on this machine: {', '.join(missing)}")
    return "\n".join(lines)
