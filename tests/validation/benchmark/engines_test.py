# SPDX-License-Identifier: GPL-3.0-or-later
"""Two engines of Debian through the whole league: built, run, judged, run again."""

import csv
import math
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

ROOT = Path(os.environ["CLATTER_ROOT"])
PROGRAM = os.environ["CLATTER_PROGRAM"]
RUN = ROOT / "validation" / "benchmark" / "engines" / "run"
#: Impulses of one point in double precision follow the exact map but for rounding, those of Box2D but for a few
#: hundred roundings in single precision.
DOUBLE, SINGLE = 1e-13, 1e-4
HOURS = 3600


class League(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        cls.rows = cls.run_league()

    @classmethod
    def run_league(cls, *options):
        ended = subprocess.run([RUN, "--program", PROGRAM, "--engines", "chipmunk,box2d", "--problems", "rod-10-brisk,rod-10-half,corner",
                                "--output", cls.folder.name, *options], capture_output=True, text=True, timeout=HOURS, check=False)
        assert ended.returncode == 0, ended.stderr
        lines = (Path(cls.folder.name) / "league.csv").read_text().splitlines()
        return list(csv.DictReader(line for line in lines if not line.startswith("#")))

    def answered(self, engine, problem, settings):
        return [row for row in self.rows if (row["engine"], row["problem"], row["settings"]) == (engine, problem, settings)]

    def test_each_engine_problem_setting_and_step_has_a_row(self):
        keys = {(row["engine"], row["problem"], row["settings"], row["step"]) for row in self.rows}
        self.assertEqual(len(keys), 2 * 3 * 2 * 3)
        self.assertEqual(len(self.rows), len(keys))

    def test_a_problem_that_an_engine_cannot_express_has_its_reason(self):
        for engine in ("chipmunk", "box2d"):
            for row in self.answered(engine, "corner", "default"):
                self.assertEqual((row["verdict"], row["reason"]), ("", "an engine of the plane"))

    def test_impulses_follow_the_exact_map_to_the_engines_precision(self):
        for engine, tolerance in (("chipmunk", DOUBLE), ("box2d", SINGLE)):
            for row in self.answered(engine, "rod-10-brisk", "tuned"):
                self.assertEqual(row["right"], row["phases"])
                self.assertLessEqual(float(row["law_error"]), tolerance)

    def test_errors_of_velocities_shrink_with_the_step(self):
        errors = [float(row["velocity_error"]) for row in self.answered("chipmunk", "rod-10-brisk", "tuned")]
        self.assertEqual(errors, sorted(errors, reverse=True))
        self.assertLess(errors[-1], errors[0] / 4)

    def test_a_threshold_of_restitution_is_found(self):
        """Box2D's own settings have no restitution below 1 m/s: the problem at 0.6 m/s tells them from tuned ones."""
        own, tuned = (max(float(row["velocity_error"] or math.inf) for row in self.answered("box2d", "rod-10-half", settings))
                      for settings in ("default", "tuned"))
        self.assertGreater(own, 0.3)
        self.assertLess(tuned, 0.05)

    def test_numbers_repeat_to_the_bit(self):
        self.assertEqual(self.run_league("--again"), self.rows)

    def test_a_league_goes_on_where_it_was_and_writes_the_same(self):
        cells = ROOT / "build" / "league" / "cells"
        before = {file: file.stat().st_mtime_ns for file in cells.glob("chipmunk-*.json")}
        self.assertTrue(before)
        self.assertEqual(self.run_league(), self.rows)
        self.assertEqual({file: file.stat().st_mtime_ns for file in before}, before)

    def test_arguments_that_are_wrong_are_refused_in_one_line(self):
        for options, words in ((["--engines", "newton"], "newton"), (["--problems", "rod-11"], "rod-11"), (["--fast"], "--fast")):
            ended = subprocess.run([RUN, "--program", PROGRAM, *options], capture_output=True, text=True, timeout=HOURS, check=False)
            self.assertEqual(ended.returncode, 2, ended.stderr)
            self.assertEqual(len(ended.stderr.splitlines()), 1, ended.stderr)
            self.assertIn(words, ended.stderr)
