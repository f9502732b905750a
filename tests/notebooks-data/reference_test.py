#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The reference is built without a warning, opens offline, and holds every command, key and column."""

import html
import os
import re
import subprocess
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PROGRAM = os.environ["CLATTER_PROGRAM"]


def printed(*arguments):
    return subprocess.run([PROGRAM, *arguments], check=True, capture_output=True, text=True).stdout


class Reference(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        cls.built = subprocess.run(["/usr/bin/python3", "-B", ROOT / "notebooks-data/reference.py", PROGRAM, cls.folder.name],
                                   capture_output=True, text=True)

    def page(self, name):
        return html.unescape(re.sub(r"<[^>]*>", "", (Path(self.folder.name) / "html" / name).read_text(encoding="utf-8")))

    def test_it_is_built_without_a_warning(self):
        self.assertEqual((self.built.returncode, self.built.stderr), (0, ""))

    def test_it_holds_the_help_of_every_command(self):
        page = self.page("commands.html")
        for command in ("sequence", "simulate", "sweep", "keys", "columns"):
            self.assertIn(f"Usage: clatter {command} ", page)

    def test_it_holds_every_key_and_column(self):
        for command in ("keys", "columns"):
            names = [line.split(",")[0] for line in printed(command, "--format", "csv", "--bare").splitlines()[1:]]
            self.assertGreater(len(names), 20)
            page = self.page(f"{command}.html")
            self.assertEqual([name for name in names if name not in page], [])

    def test_it_has_a_page_of_theory_and_an_example_for_each_model(self):
        examples = sorted(path.stem for path in (ROOT / "tests/install").glob("*_example.cpp"))
        first = self.page("index.html")
        self.assertEqual(examples, ["analytic_example", "numeric_example", "space_example"])
        for page, equation, example in (("discrete_model", "P_n = −(1 + e) m u / (A − μ_i B)", "analytic_example"),
                                        ("space_model", "dv/dp = W (n − μ s)", "space_example"),
                                        ("continuous_model", "f_n", "numeric_example")):
            with self.subTest(model=page):
                self.assertIn(equation, self.page(f"{page}.html"))
                main = (ROOT / "tests/install" / f"{example}.cpp").read_text(encoding="utf-8").split("int main() {")[1]
                lines = [line.strip() for line in main.splitlines() if line.strip()]
                self.assertEqual([line for line in lines if line not in first], [])

    def test_its_pages_ask_for_nothing_from_outside(self):
        for path in (Path(self.folder.name) / "html").glob("*.html"):
            self.assertNotRegex(path.read_text(encoding="utf-8"), r'(src|href)="https?://(?!www\.doxygen\.org)', path.name)


if __name__ == "__main__":
    unittest.main()
