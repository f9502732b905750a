# SPDX-License-Identifier: GPL-3.0-or-later
"""The league's numbers, pages and pictures say the same, and each thing that goes wrong is shown by a run."""

import os
import re
import subprocess
import sys
import tomllib
import unittest
from pathlib import Path

ROOT = Path(os.environ["CLATTER_ROOT"])
DATA = ROOT / "notebooks-data"
ENGINES = ROOT / "validation" / "benchmark" / "engines"
sys.path[:0] = [str(DATA), str(ENGINES)]

import runs
from league_tables import League


class Numbers(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.league = League(DATA, ENGINES / "engines.toml")

    def test_sixteen_engines_and_more_ran_with_three_steps_and_two_settings(self):
        full = [engine for engine in self.league.engines if engine["package"] != "clatter"
                and all(self.league.answered(engine, settings, step) for settings in ("default", "tuned") for step in League.STEPS)]
        self.assertGreaterEqual(len(full), 16)

    def test_every_engine_has_every_problem_with_a_verdict_or_a_reason(self):
        problems = {path.stem for path in (ROOT / "validation" / "benchmark" / "problems").glob("*.toml")} - runs.LATER
        for engine in self.league.engines:
            self.assertEqual({row["problem"] for row in self.league.rows if row["engine"] == engine["id"]}, problems)
        for row in self.league.rows:
            self.assertNotEqual(bool(row["verdict"]), bool(row["reason"]), row)

    def test_this_program_stands_among_the_engines_with_what_it_cannot_do(self):
        own = [engine for engine in self.league.engines if engine["package"] == "clatter"]
        answered = [row for engine in own for row in self.league.rows if row["engine"] == engine["id"]]
        self.assertEqual((len(own), any(row["reason"] for row in answered), any(row["verdict"] == "fails" for row in answered)), (2, True, True))

    def test_each_engine_has_something_that_goes_wrong_shown_by_the_runs_it_names(self):
        findings = tomllib.loads((ENGINES / "findings.toml").read_text())["finding"]
        self.assertLessEqual({engine["id"] for engine in self.league.engines}, {finding["engine"] for finding in findings})
        for finding in findings:
            with self.subTest(finding=finding["says"]):
                self.assertTrue(finding["shown"])
                for run in finding["shown"]:
                    self.assertTrue({"above", "below"} & set(run))
                    self.league.shown(finding["engine"], run)

    def test_a_finding_that_a_run_does_not_show_is_refused(self):
        run = {"problem": "rod-10-brisk", "settings": "tuned", "step": "1/960", "column": "law_error", "above": 0.5}
        with self.assertRaisesRegex(ValueError, "does not show it"):
            self.league.shown("chipmunk", run)


class Pages(unittest.TestCase):
    def test_pages_and_pictures_are_what_the_numbers_say(self):
        told = subprocess.run(["/usr/bin/python3", "-B", DATA / "league_documents.py", "--check"], capture_output=True, text=True, check=False)
        self.assertEqual((told.returncode, told.stdout), (0, ""), told.stderr)

    def test_the_page_opens_offline_and_names_every_engine(self):
        page = (DATA / "league.html").read_text()
        self.assertEqual(re.findall(r'(?:src|href)="(?!#)[^"]*"', page), [])
        self.assertEqual(re.findall(r"\*\w[^<]*\*|`|\]\(", re.sub("<svg.*?</svg>", "", page, flags=re.DOTALL)), [])
        for engine in League(DATA, ENGINES / "engines.toml").engines:
            self.assertIn(engine["name"], page)
