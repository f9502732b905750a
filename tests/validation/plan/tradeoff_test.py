# SPDX-License-Identifier: GPL-3.0-or-later
"""`clatter tradeoff` as its users meet it.  Costs are measured, not judged: no test depends on a time."""

import json
import os
import tempfile

from run_folder import case, run

import unittest


def tradeoff(name, *arguments):
    return run("tradeoff", case(name), *arguments)


class Tradeoff(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        cls.plot = os.path.join(cls.folder.name, "plot.svg")
        cls.result = json.loads(tradeoff("rod-45", "--format", "json", "--plot", cls.plot).stdout)

    def points(self, model, method=None):
        return [p for p in self.result["points"] if (p["model"], p["method"]) == (model, method) and not p["mesh"]]

    def test_every_model_and_five_methods_over_their_settings_are_there(self):
        self.assertEqual(len(self.points("closed form")), 1)
        self.assertEqual(len(self.points("discrete")), 1)
        for model in ("planar", "spatial"):
            for method in ("rk4", "rkf45", "rkck", "rk8pd"):
                self.assertEqual(len(self.points(model, method)), 13, (model, method))
            self.assertEqual(len(self.points(model, "tvd-rk3")), 11, model)
        self.assertEqual(sum(1 for p in self.result["points"] if p["mesh"]), 4)

    def test_errors_fall_with_the_tolerance(self):
        # One contact of some tens of steps: the error stays below ten times the local error, and rounding.
        for method in ("rk4", "rkf45", "rkck", "rk8pd"):
            for point in self.points("planar", method):
                self.assertLess(point["error"], 10 * point["tolerance"] + 1e-12, point)

    def test_the_papers_method_converges_with_order_three(self):
        errors = [p["error"] for p in self.points("planar", "tvd-rk3")]
        ratio = errors[3] / errors[5]
        self.assertGreater(ratio, 8 ** 2 / 2)  # two halvings
        self.assertLess(ratio, 8 ** 2 * 2)

    def test_nothing_beats_a_point_of_the_front(self):
        points = [p for p in self.result["points"] if p["failure"] is None]
        front = [p for p in points if p["front"]]
        self.assertGreater(len(front), 3)
        for point in front:
            self.assertFalse(any(p["seconds"] < point["seconds"] and p["error"] < point["error"] for p in points))

    def test_a_model_that_does_not_apply_is_listed_with_its_reason(self):
        result = json.loads(tradeoff("phone-elastic", "--impacts", "1", "--format", "json").stdout)
        closed = [p for p in result["points"] if p["model"] == "closed form"]
        self.assertEqual(len(closed), 1)
        self.assertIn("rod", closed[0]["failure"])
        self.assertIsNone(closed[0]["error"])

    def test_the_picture_is_svg(self):
        with open(self.plot, encoding="utf-8") as file:
            text = file.read()
        self.assertTrue(text.startswith("<?xml"))
        self.assertIn("rk8pd", text)

    def test_bad_arguments_have_one_line_and_status_2(self):
        for name, arguments in (("rod-sweep", []), ("rod-45", ["--plot", "/no/such/folder/x.svg"]), ("rod-45", ["--digits", "x"])):
            run = tradeoff(name, *arguments)
            self.assertEqual((run.returncode, run.stdout), (2, ""))
            self.assertEqual(len(run.stderr.splitlines()), 1)
