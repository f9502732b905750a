# SPDX-License-Identifier: GPL-3.0-or-later
"""What tests of every day import comes with Python, lies beside them, or is a package that tests/run installs for them."""

import ast
import re
import sys
import unittest
from pathlib import Path

TESTS = Path(__file__).resolve().parent
FULL = {"install", "notebooks-data"}  # run with --full alone, which installs more


def imported(path):
    """The modules that a script imports as it starts, by their first names."""
    for line in ast.parse(path.read_text(encoding="utf-8")).body:
        if isinstance(line, ast.Import):
            yield from (one.name.split(".")[0] for one in line.names)
        elif isinstance(line, ast.ImportFrom):
            yield line.module.split(".")[0]


class Imports(unittest.TestCase):
    def test_each_import_is_there_on_a_machine_that_is_new(self):
        listed = re.search(r"^test_packages=\((.*?)\)$", (TESTS / "packages.bash").read_text(encoding="utf-8"), re.M | re.S)[1]
        there = set(sys.stdlib_module_names)
        there |= {path.stem for room in ("tests", "validation", "notebooks-data") for path in (TESTS.parent / room).rglob("*.py")}
        there |= {package.removeprefix("python3-") for package in listed.split()}
        missing = {(path.relative_to(TESTS).as_posix(), name) for path in TESTS.rglob("*.py")
                   if path.relative_to(TESTS).parts[0] not in FULL for name in imported(path) if name not in there}
        self.assertEqual(missing, set())
