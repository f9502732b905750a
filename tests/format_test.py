#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Every C++ file is as clang-format writes it with the project's .clang-format; files and functions are short."""

import json
import subprocess
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
ROOMS = ("analytic", "numeric", "validation", "tests", "notebooks-data")
FILE_LINES = 600
FUNCTION_LINES = 40


def sources(rooms=ROOMS):
    return sorted(str(path) for room in rooms for path in (ROOT / room).rglob("*.[ch]pp"))


def long_functions(command, **options):
    """Name, first line and length of the functions that ctags finds to be longer than allowed."""
    found = subprocess.run(["ctags", "--output-format=json", "--fields=+ne", "--kinds-c++=f", "-f", "-", *command],
                           capture_output=True, text=True, check=True, **options)
    tags = [json.loads(line) for line in found.stdout.splitlines()]
    return [f"{tag['path']}:{tag['line']}: {tag['name']} has {tag['end'] - tag['line'] + 1} lines" for tag in tags
            if tag.get("end", 0) - tag["line"] + 1 > FUNCTION_LINES]


class Format(unittest.TestCase):
    def test_every_cpp_file_is_as_clang_format_writes_it(self):
        # With --dry-run it complains of the comment behind an inline namespace, which it writes so itself.
        for path in sources():
            written = subprocess.run(["clang-format", path], cwd=ROOT, capture_output=True, text=True, check=True).stdout
            self.assertEqual(Path(path).read_text(encoding="utf-8"), written, path)

    def test_the_rule_finds_a_line_that_is_too_long(self):
        result = subprocess.run(["clang-format", "--dry-run", "--Werror", "--assume-filename=analytic/long.cpp"], cwd=ROOT,
                                input="int sum = " + " + ".join(["1000"] * 20) + ";\n", capture_output=True, text=True)
        self.assertNotEqual(result.returncode, 0)


class Length(unittest.TestCase):
    """Tests are left out: a table of cases may be long."""

    def test_no_file_is_long(self):
        lengths = {path: len(Path(path).read_text(encoding="utf-8").splitlines()) for path in sources(ROOMS[:3])}
        self.assertEqual({path: lines for path, lines in lengths.items() if lines > FILE_LINES}, {})

    def test_no_function_is_long(self):
        self.assertEqual(long_functions(["-L", "-"], input="\n".join(sources(ROOMS[:3]))), [])

    def test_the_rule_finds_a_function_that_is_long(self):
        with tempfile.NamedTemporaryFile("w", suffix=".cpp") as file:
            file.write("int f() {\n" + "  g();\n" * FUNCTION_LINES + "}\n")
            file.flush()
            self.assertEqual(len(long_functions([file.name])), 1)


if __name__ == "__main__":
    unittest.main()
