# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs of many impacts: the memory that an impact takes, and that rows written one by one are those of the whole report."""

import json
import os
import subprocess
import unittest

from run_folder import PROGRAM, records, run

BOUNCING = ("sequence", "--angle", "10", "--gravity", "9.81", "--restitution", "1")
IN_SPACE = ("sequence", "--body", "box", "--size", "0.1x0.06x0.02", "--angle", "30", "--tilt", "20", "--gravity", "9.81", "--restitution", "1")
LARGEST = 2048  # bytes for each impact
FEW, MANY = 4000, 20000


def memory(*arguments):
    """Largest resident size of a run [bytes]."""
    with subprocess.Popen([PROGRAM, *arguments], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as running:
        _, _, usage = os.wait4(running.pid, 0)
        running.returncode = 0
    return 1024 * usage.ru_maxrss


class LongRuns(unittest.TestCase):
    def test_an_impact_takes_at_most_two_kilobytes_in_any_form(self):
        for scene in (BOUNCING, IN_SPACE):
            for form in ("table", "csv", "json", "markdown", "latex"):
                with self.subTest(scene=scene[1], form=form):
                    sizes = [memory(*scene, "--impacts", str(count), "--format", form) for count in (FEW, MANY)]
                    self.assertLessEqual((sizes[1] - sizes[0]) / (MANY - FEW), LARGEST)

    def test_every_form_has_the_same_rows(self):
        for scene in (BOUNCING, IN_SPACE):
            texts = {form: run(*scene, "--impacts", "40", "--format", form).stdout for form in ("table", "csv", "json", "markdown", "latex")}
            impacts, rows = json.loads(texts["json"])["impacts"], records(texts["csv"])
            self.assertEqual((len(impacts), len(rows)), (40, 40))
            for impact, row in zip(impacts, rows):
                self.assertEqual((impact["n"], impact["start"]), (int(row["n"]), float(row["start"])))
                self.assertEqual(impact["error_estimate"]["start"], float(row["start_error"]) if row["start_error"] else None)
            for form in ("markdown", "latex", "table"):
                numbers = [line.strip("| ").replace("?", " ").split()[0] for line in texts[form].splitlines() if line.strip("| ")[:1].isdigit()]
                self.assertIn("40", numbers)
                self.assertEqual(sorted(set(map(int, numbers[:40]))), list(range(1, 41)), form)
