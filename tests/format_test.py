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


def functions(text):
    """Name, first line and length of the functions of a source, without those that have no name."""
    with tempfile.NamedTemporaryFile("w", suffix=".cpp") as file:
        file.write(text.replace("::inline ", "::"))  # ctags finds nothing in such a namespace
        file.flush()
        found = subprocess.run(["ctags", "--output-format=json", "--fields=+ne", "--kinds-c++=f", "-f", "-", file.name],
                               capture_output=True, text=True, check=True)
    tags = [json.loads(line) for line in found.stdout.splitlines()]
    return [(tag["name"], tag["line"], tag.get("end", tag["line"]) - tag["line"] + 1) for tag in tags
            if not tag["name"].startswith("__anon")]


def long_functions(text):
    return [function for function in functions(text) if function[2] > FUNCTION_LINES]


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
        found = {}
        for path in sources(ROOMS[:3]):
            text = Path(path).read_text(encoding="utf-8")
            found[path] = len(functions(text))
            self.assertEqual(long_functions(text), [], path)
        self.assertGreater(sum(found.values()), 3000, found)

    def test_the_rule_finds_a_function_that_is_long(self):
        long = "int f() {\n" + "  g();\n" * FUNCTION_LINES + "}\n"
        for around in ("%s", "namespace a::b::inline c {\n%s}\n"):
            self.assertEqual([name for name, *_ in long_functions(around % long)], ["f"])


if __name__ == "__main__":
    unittest.main()
