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


class Steps(unittest.TestCase):
    """Right codes, whose error is their step."""

    def test_no_other_cause_is_told_where_the_step_makes_the_error(self):
        """The gravity of the first step looked like e = 0.701 for 0.7, since the body touches the ground in the first row."""
        for problem in ("box", "clatter-05", "clatter-08"):
            for gap, step, every in ((0, 1 / 15360, 1), (0, 1 / 3840, 4), (0, 1 / 960, 1), (1, 1 / 3840, 4)):
                for order in ("ksd", "dks", "kdks"):
                    with self.subTest(problem=problem, gap=gap, step=step, every=every, order=order):
                        found = judged(StepCode(problem, gap, step, order).text(every, step=step))
                        self.assertLessEqual({cause["cause"] for cause in found["causes"]}, {"first-order-step", "time-step"})
                        if every == 1 or gap == 0 and order == "ksd":
                            self.assertLess(found["impact_scores"][0]["law_error"], 1e-12)

    def test_one_impact_in_the_first_row_proves_no_other_restitution(self):
        for problem in ("friction-slip", "friction-stick", "friction-slip-stick"):
            for step in (1 / 960, 1 / 3840):
                with self.subTest(problem=problem, step=step):
                    self.assertNotIn("restitution", told(StepCode(problem, 0, step).text(4)))

    def test_the_flights_of_a_step_of_first_order_are_named_with_what_the_step_leaves(self):
        for problem in ("box", "clatter-08"):
            for order, how in (("ksd", "semi-implicit"), ("kds", "semi-implicit"), ("dks", "explicit")):
                for every in (1, 4):
                    with self.subTest(problem=problem, order=order, every=every):
                        causes = judged(StepCode(problem, 1, 1 / 3840, order).text(every, step="1/3840"))["causes"]
                        self.assertEqual(causes[0]["cause"], "first-order-step")
                        self.assertAlmostEqual(causes[0]["value"], 1 / 3840, delta=1e-15)
                        self.assertIn("g·step/2 = 0.00128 m/s", causes[0]["words"])
                        self.assertIn(how, causes[0]["words"])
                        if every == 1:
                            self.assertEqual([cause["cause"] for cause in causes], ["first-order-step", "time-step"])
                            self.assertIn("the step explains the rest", causes[1]["words"])

    def test_a_step_of_second_order_flies_freely(self):
        for problem in ("box", "clatter-08"):
            self.assertEqual(told(StepCode(problem, 1, order="kdks").text()), ["time-step"])

    def test_another_restitution_of_a_code_of_steps_is_named_beside_its_step(self):
        for problem in ("box", "clatter-08"):
            code = StepCode(problem, 1)
            code.e -= 0.1
            causes = judged(code.text())["causes"]
            self.assertEqual([cause["cause"] for cause in causes], ["restitution", "first-order-step"])
            self.assertAlmostEqual(causes[0]["value"], code.e, delta=1e-6)


if __name__ == "__main__":
    unittest.main()
