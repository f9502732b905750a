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


def functions(texts):
    """Name, first line and length of the functions of each source, without those that have no name; one ctags for all."""
    with tempfile.TemporaryDirectory() as folder:
        copies = [Path(folder, f"{number}.cpp") for number in range(len(texts))]
        for copy, text in zip(copies, texts):
            copy.write_text(text.replace("::inline ", "::"), encoding="utf-8")  # ctags finds nothing in such a namespace
        found = subprocess.run(["ctags", "--output-format=json", "--fields=+ne", "--kinds-c++=f", "-f", "-", "-L", "-"],
                               input="\n".join(map(str, copies)), capture_output=True, text=True, check=True)
    lists = [[] for _ in texts]
    for tag in map(json.loads, found.stdout.splitlines()):
        if not tag["name"].startswith("__anon"):
            lists[int(Path(tag["path"]).stem)].append((tag["name"], tag["line"], tag.get("end", tag["line"]) - tag["line"] + 1))
    return lists


def long_functions(texts):
    return [[function for function in found if function[2] > FUNCTION_LINES] for found in functions(texts)]


def formatted(paths):
    return subprocess.run(["clang-format", *paths], cwd=ROOT, capture_output=True, text=True, check=True).stdout


class Format(unittest.TestCase):
    def test_every_cpp_file_is_as_clang_format_writes_it(self):
        # With --dry-run it complains of the comment behind an inline namespace, which it writes so itself.
        paths = sources()
        texts = [Path(path).read_text(encoding="utf-8") for path in paths]
        if formatted(paths) != "".join(texts):
            self.assertEqual([path for path, text in zip(paths, texts) if formatted([path]) != text], [])
            self.fail("the files together are not written as each by itself")

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
        paths = sources(ROOMS[:3])
        texts = [Path(path).read_text(encoding="utf-8") for path in paths]
        self.assertEqual({path: found for path, found in zip(paths, long_functions(texts)) if found}, {})
        self.assertGreater(sum(map(len, functions(texts))), 3000)

    def test_the_rule_finds_a_function_that_is_long(self):
        long = "int f() {\n" + "  g();\n" * FUNCTION_LINES + "}\n"
        texts = [around % long for around in ("%s", "namespace a::b::inline c {\n%s}\n")]
        self.assertEqual([[name for name, *_ in found] for found in long_functions(texts)], [["f"], ["f"]])


if __name__ == "__main__":
    unittest.main()
