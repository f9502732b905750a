# SPDX-License-Identifier: GPL-3.0-or-later
"""Waiting for what happens, never for a time: no test may depend on how fast or busy the machine is."""

import os
import time

LONG = 3000  # seconds: a guard against waiting for ever, which decides nothing


def until(happened, process=None):
    """Returns the first true answer of `happened`; fails if the process that should bring it about ends before."""
    end = time.monotonic() + LONG
    while True:
        ended = process is not None and process.poll() is not None
        answer = happened()
        if answer:
            return answer
        if ended:
            raise AssertionError(f"the process ended with status {process.returncode} before it happened")
        if time.monotonic() > end:
            raise AssertionError("it never happened")
        time.sleep(0.005)


def sizes(folder):
    """Sizes of a folder's files, by name, while files come and go."""
    found = {}
    for name in os.listdir(folder):
        try:
            found[name] = os.path.getsize(os.path.join(folder, name))
        except FileNotFoundError:
            pass
    return found


def computing_seconds(pid):
    """Processor time that a process has used."""
    with open(f"/proc/{pid}/stat", encoding="ascii", errors="replace") as file:
        fields = file.read().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def until_it_computes(process):
    """The process has computed for a fifth of a second since the call."""
    begin = computing_seconds(process.pid)
    until(lambda: computing_seconds(process.pid) >= begin + 0.2, process)
