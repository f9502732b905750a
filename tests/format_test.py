# SPDX-License-Identifier: GPL-3.0-or-later
"""Every C++ file is as clang-format writes it with the project's .clang-format; its comments are sentences with a subject."""

import re
import subprocess
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
ROOMS = ("analytic", "numeric", "validation", "tests", "notebooks-data")


def sources(rooms=ROOMS):
    return sorted(str(path) for room in rooms for path in (ROOT / room).rglob("*.[ch]pp"))


def formatted(paths):
    return subprocess.run(["clang-format", *paths], cwd=ROOT, capture_output=True, text=True, check=True).stdout


class Format(unittest.TestCase):
    def test_every_cpp_file_is_as_clang_format_writes_it(self):
        paths = sources()
        texts = [Path(path).read_text(encoding="utf-8") for path in paths]
        if formatted(paths) != "".join(texts):
            self.assertEqual([path for path, text in zip(paths, texts) if formatted([path]) != text], [])
            self.fail("the files together are not written as each by itself")

    def test_no_comment_begins_without_its_subject_and_no_namespace_is_inline(self):
        odd = re.compile(r"\s*///?<? ?(Of|Likewise|That of|Those of|As [a-z_()]+'s)\b|namespace .*\binline\b")
        found = [f"{Path(path).relative_to(ROOT)}:{number}" for path in sources(ROOMS[:3])
                 for number, line in enumerate(Path(path).read_text(encoding="utf-8").splitlines(), 1) if odd.match(line)]
        self.assertEqual(found, [])
