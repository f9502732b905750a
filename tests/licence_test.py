# SPDX-License-Identifier: GPL-3.0-or-later
"""Every file says whose it is and on what terms (reuse.software), and sources say so themselves.

The tree has no folder LICENSES/: the texts are LICENSE and, of the measured drops, data-licence.txt beside them.
"""

import re
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
MEASURED = ROOT / "validation" / "measured"
TAG = "SPDX-License-Identifier: " + "GPL-3.0-or-later"  # in two parts, or this line would be one
SOURCES = {".bash", ".cmake", ".cpp", ".css", ".hpp", ".in", ".mjs", ".py", ".pyi", ".ts"}
SCRIPTS = {"CMakeLists.txt", "clatter", "run"}
HEAD = 3  # lines, after that of the interpreter or of an encoding


def files():
    """Those of the tree, without what builds and runs leave behind."""
    if not (ROOT / ".git").exists():  # a copy of the tree
        return sorted(path for path in ROOT.rglob("*") if path.is_file() and path.relative_to(ROOT).parts[0] != "build")
    listed = subprocess.run(["git", "-C", ROOT, "ls-files", "-z", "--cached", "--others", "--exclude-standard"], check=True,
                            capture_output=True, text=True).stdout
    return sorted(path for name in listed.split("\0") if name and (path := ROOT / name).is_file())


def is_source(path):
    return path.suffix in SOURCES or path.name in SCRIPTS


class Licences(unittest.TestCase):
    maxDiff = None

    def test_every_source_names_its_licence_in_its_first_lines(self):
        sources = [path for path in files() if is_source(path)]
        self.assertGreater(len(sources), 700)
        without = [str(path.relative_to(ROOT)) for path in sources
                   if TAG not in "\n".join(path.read_text(encoding="utf-8").splitlines()[:HEAD])]
        self.assertEqual("\n".join(without), "", f"line '{TAG}' is missing")

    def test_reuse_finds_a_holder_and_a_licence_for_every_file(self):
        with tempfile.TemporaryDirectory() as folder:
            for path in files():
                copy = Path(folder, path.relative_to(ROOT))
                copy.parent.mkdir(parents=True, exist_ok=True)
                shutil.copy(path, copy)
            texts = Path(folder, "LICENSES")
            texts.mkdir()
            shutil.copy(ROOT / "LICENSE", texts / "GPL-3.0-or-later.txt")
            shutil.copy(MEASURED / "data-licence.txt", texts / "BSD-3-Clause.txt")
            done = subprocess.run(["reuse", "--root", folder, "lint"], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def test_data_of_others_are_under_the_terms_that_they_came_with(self):
        rules = (ROOT / ".reuse" / "dep5").read_text(encoding="utf-8").split("\n\n")
        others = next(rule for rule in rules if "License: BSD-3-Clause" in rule)
        for path in MEASURED.glob("*.csv"):
            head = path.read_text(encoding="utf-8").split("\n", 2)[1]
            licence, holder = re.fullmatch(r"# licence: (\S+), copyright 2020 (.*); see data-licence\.txt", head).groups()
            with self.subTest(file=path.name):
                self.assertEqual(licence, "BSD-3-Clause")
                self.assertIn(path.relative_to(ROOT).as_posix(), others)
                self.assertIn(f"Copyright: 2020 {holder}", others)
                self.assertIn(holder, (MEASURED / "data-licence.txt").read_text(encoding="utf-8"))
