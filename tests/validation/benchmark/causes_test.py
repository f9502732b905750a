#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Right codes of fixed steps and wrong scenes: what the judge says of each, and in which order."""
import json
import pathlib
import tempfile
import unittest

import exact_motion
from planar_code import Code
from step_code import StepCode


def judged(text):
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder, "run.csv")
        path.write_text(text)
        done = exact_motion.run("benchmark", "score", str(path), "--format", "json")
        assert done.returncode == 0, done.stderr
        return json.loads(done.stdout)["files"][0]


def told(text):
    """Names of the causes, the first first."""
    return [cause["cause"] for cause in judged(text)["causes"]]


def with_gravity(code, gravity):
    code.gravity = gravity
    return code


class Gravity(unittest.TestCase):
    def test_gravity_is_named_where_none_is_asked_for(self):
        for problem in ("rod-10", "rod-45", "thick-rod"):
            for gravity in (9.81, 1.0, -9.81):
                exact = with_gravity(Code(problem, 1), gravity)
                for text in (with_gravity(StepCode(problem, 1), gravity).text(), exact.text(exact.rows(1 / 500))):
                    with self.subTest(problem=problem, gravity=gravity):
                        causes = judged(text)["causes"]
                        self.assertEqual([cause["cause"] for cause in causes], ["gravity"])
                        self.assertAlmostEqual(causes[0]["value"], gravity, delta=1e-9)

    def test_no_velocities_are_said_to_grow_where_gravity_is_left_out(self):
        for problem in ("box", "clatter-05", "clatter-08"):
            for gap in (0, 1):
                for order in ("ksd", "kds", "kdks"):
                    with self.subTest(problem=problem, gap=gap, order=order):
                        self.assertEqual(told(with_gravity(StepCode(problem, gap, order=order), 0.0).text()), ["gravity"])


if __name__ == "__main__":
    unittest.main()
