# SPDX-License-Identifier: GPL-3.0-or-later
"""The completion for bash completes, and the manual page has no warnings of man or mandoc.

Usage: python3 shell_and_manual_test.py PROGRAM ROOT; what is not installed (man, mandoc) is named and left out
"""

import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

COMPLETE = """
source "$1"
shift
COMP_WORDS=("$@")
COMP_CWORD=$(($# - 1))
_plekton
printf '%s\\n' "${COMPREPLY[@]}"
"""


def output_of(*command, **more):
    return subprocess.run(command, capture_output=True, text=True, check=True, **more).stdout


def completion_failures(program, root):
    """What is not completed as it should be."""
    catch = str(Path(root, "apps/examples/catch/catch.toml"))
    expected = [
        (["v"], {"validate", "verify", "view"}),
        (["run", "--ov"], {"--overwrite"}),
        (["view", "--se"], {"--serve"}),
        (["check", catch, "--set", "grains.gravel.co"], {"grains.gravel.count="}),
        (["run", catch, "--set", "materials.fibre.yo"], {"materials.fibre.young_modulus="}),
        (["run", "--set", "simulation.dur"], set()),
        (["run", str(Path(root, "apps/examples/catch/ca"))], {catch}),
        (["run", "--threads", ""], set()),
        (["examples", "ca"], {"catch"}),
        (["validate", "ca"], {"cantilever", "cable"}),
        (["study", str(Path(root, "apps/examples/shear_test/cal"))], {str(Path(root, "apps/examples/shear_test/calibration.toml"))}),
        (["import-yade", str(Path(root, "apps/takeover/export_s"))], {str(Path(root, "apps/takeover/export_scene.py"))}),
    ]
    failures = []
    with tempfile.TemporaryDirectory() as folder:
        script = Path(folder, "plekton")
        script.write_text(output_of(program, "generate", "bash-completion"), encoding="utf-8")
        environment = os.environ | {"PATH": f"{Path(program).parent}:{os.environ['PATH']}"}
        for words, wanted in expected:
            found = output_of("bash", "-c", COMPLETE, "bash", script, "plekton", *words, env=environment).split()
            if set(found) != wanted:
                failures.append(f"completion of {words}: {found}, expected {sorted(wanted)}")
    return failures


def manual_failures(program):
    """Warnings about the manual page, and what it does not say."""
    failures = []
    page = output_of(program, "generate", "manual", "--date", "2026-01-31")
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder, "plekton.1")
        file.write_text(page, encoding="utf-8")
        checks = {
            "man": ["man", "--warnings=all", "-E", "UTF-8", "-Tutf8", "-l", file],
            "mandoc": ["mandoc", "-T", "lint", "-W", "warning", file],
        }
        for tool, command in checks.items():
            if shutil.which(tool) is None:
                print(f"left out: {tool} is not installed")
                continue
            done = subprocess.run(command, capture_output=True, text=True)
            complaints = done.stderr if tool == "man" else done.stdout + done.stderr
            if done.returncode != 0 or complaints:
                failures.append(f"{tool}: {complaints or done.returncode}")
    for line in output_of(program, "--help").partition("Subcommands:\n")[2].splitlines():
        if line.startswith("  ") and line[2] != " " and f".SS {line.split()[0]}\n" not in page.replace("\\-", "-"):
            failures.append(f"plekton(1) does not have the command {line.split()[0]}")
    return failures


def main():
    program, root = sys.argv[1:3]
    failures = completion_failures(program, root) + manual_failures(program)
    for failure in failures:
        print(failure)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
