# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs one command at a time and says what it printed and what it took."""

import contextlib
import os
import signal
import subprocess
import tempfile
import threading
import time
from dataclasses import dataclass


@dataclass(frozen=True)
class Ended:
    """A command that has ended.

    code  Its exit code; 127 if there is no such program, 128 and the number of the signal that ended it.
    text  What it printed, both streams.
    rss   MiB, its peak memory, at least that of this program; of an MPI run that of the largest process.
    share Of one processor that it had over its life.
    """

    code: int
    text: str
    rss: float
    share: float


def last_lines(text, count=5):
    """The last lines with something on them."""
    return "\n".join([line for line in text.splitlines() if line.strip()][-count:])


def environment(threads):
    """That of this process with one binding for all codes: the system may move threads from processor to processor."""
    return {**os.environ, "OMP_NUM_THREADS": str(threads), "OMP_PROC_BIND": "false", "PYTHONDONTWRITEBYTECODE": "1"}


AS_A_GRANDCHILD = ["sh", "-c", '"$@"; exit $?', "sh"]
"""A child of this process begins its count of peak memory with what this one takes; a child of a small shell does not."""

PATIENCE = 10.0
"""s, from being asked to end to being ended."""


def run(command, threads, seconds):
    """Runs a command to its end, in a folder of its own; ends it, and all it started, after a number of seconds."""
    with tempfile.TemporaryDirectory() as folder, tempfile.TemporaryFile() as output:
        begin = time.perf_counter()
        process = subprocess.Popen(
            [*AS_A_GRANDCHILD, *command],
            stdin=subprocess.DEVNULL,
            stdout=output,
            stderr=subprocess.STDOUT,
            cwd=folder,
            env=environment(threads),
            start_new_session=True,
        )
        status, usage = _wait(process, seconds)
        wall = time.perf_counter() - begin
        output.seek(0)
        text = output.read().decode(errors="replace")
    if wall > seconds:
        text += f"\nended after {seconds:g} s, the time it was given"
    share = (usage.ru_utime + usage.ru_stime) / wall
    return Ended(os.waitstatus_to_exitcode(status), text, usage.ru_maxrss / 1024, share)


def _end(process, by):
    with contextlib.suppress(ProcessLookupError):
        os.killpg(process.pid, by)


def _wait(process, seconds):
    timers = [
        threading.Timer(seconds, _end, (process, signal.SIGTERM)),
        threading.Timer(seconds + PATIENCE, _end, (process, signal.SIGKILL)),
    ]
    for timer in timers:
        timer.start()
    try:
        _, status, usage = os.wait4(process.pid, 0)
    except BaseException:
        _end(process, signal.SIGTERM)
        raise
    finally:
        for timer in timers:
            timer.cancel()
        process.returncode = 0  # It has been waited for; Popen is not to.
    return status, usage
