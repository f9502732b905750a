# SPDX-License-Identifier: GPL-3.0-or-later
"""No test depends on how fast or busy the machine is: none sleeps in a hope, and no limit of time is short enough to decide.

What is waited for stands in tests/waiting.py and in the launcher's wait_for, which look for it again and again.
"""

import re
import unittest
from pathlib import Path

HERE = Path(__file__).resolve().parent
# These measure times or start others' tests, and judge none by a time.
LEFT_OUT = {"waiting.py", "no_time_test.py", "seeded_faults", "speed_benchmark.py", "numeric_benchmark.cpp", "page_benchmark.mjs"}
WAITS = {"launcher_test.bash": ['until "$@"; do sleep 0.02; done', " readlink rm sleep tail touch"],
         "page_test.mjs": ["window.setTimeout = (act) => later.push(act);"],
         "page_browsers_test.mjs": ["const { setTimeout, clearTimeout } = window;", "window.setTimeout = (act, ...rest) => {",
                                    "const id = setTimeout(() => { window.due.delete(id); act(); }, ...rest);"]}
SLEEP = re.compile(r"\bu?sleep\b|\bnanosleep\b|\bsleep_(for|until)\b|\bsetTimeout\b|\bwaitForTimeout\b|\bwait_for\(.*\bchrono\b")
CLOCK = re.compile(r"\bsteady_clock\b|\bsystem_clock\b|\bmonotonic\b|\bperf_counter\b|\btime\.time\b|\bSECONDS\b")
LIMIT = re.compile(r"\btimeout\s*=\s*([\d_.]+)|\b(?:--timeout|timeout)\s+([\d_.]+)|\bsettimeout\(([\d_.]+)")
SHORTEST_LIMIT = 600  # seconds


def code_lines():
    for path in sorted(HERE.rglob("*")):
        if path.suffix not in {".py", ".cpp", ".hpp", ".bash", ".mjs"} or LEFT_OUT & set(path.relative_to(HERE).parts):
            continue
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
            code = line.split("  #")[0].split("  //")[0]
            if not code.lstrip().startswith(("#", "//")) and not any(known in code for known in WAITS.get(path.name, [])):
                yield f"{path.relative_to(HERE)}:{number}: {line.strip()}", code


class NoTime(unittest.TestCase):
    def test_no_test_sleeps(self):
        self.assertEqual([where for where, code in code_lines() if SLEEP.search(code)], [])

    def test_no_test_reads_a_clock(self):
        self.assertEqual([where for where, code in code_lines() if CLOCK.search(code)], [])

    def test_no_limit_of_time_decides(self):
        limits = [(where, float(next(filter(None, found.groups())).replace("_", "")))
                  for where, code in code_lines() for found in LIMIT.finditer(code)]
        self.assertGreater(len(limits), 3)
        self.assertEqual([where for where, limit in limits if limit < SHORTEST_LIMIT], [])
