#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Every C++ file is as clang-format writes it with the project's .clang-format."""

import subprocess
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
ROOMS = ("analytic", "numeric", "validation", "tests", "notebooks-data")


def sources():
    return sorted(str(path) for room in ROOMS for path in (ROOT / room).rglob("*.[ch]pp"))


class Format(unittest.TestCase):
    def test_every_cpp_file_is_as_clang_format_writes_it(self):
        result = subprocess.run(["clang-format", "--dry-run", "--Werror", *sources()], cwd=ROOT, capture_output=True, text=True)
        self.assertEqual((result.returncode, result.stderr), (0, ""))

    def test_the_rule_finds_a_line_that_is_too_long(self):
        result = subprocess.run(["clang-format", "--dry-run", "--Werror", "--assume-filename=analytic/long.cpp"], cwd=ROOT,
                                input="int sum = " + " + ".join(["1000"] * 20) + ";\n", capture_output=True, text=True)
        self.assertNotEqual(result.returncode, 0)


if __name__ == "__main__":
    unittest.main()
