# SPDX-License-Identifier: GPL-3.0-or-later
"""Right codes of fixed steps and wrong scenes: what the judge says of each, and in which order."""
import itertools
import math
import os
import pathlib
import re
import subprocess
import sys
import unittest

import numpy as np

from exact_motion import Motion, printed, scored
from planar_code import Code, StepCode
from rigid_code import RigidCode, moreau, struck
from run_folder import EmptyFolder, json_of


def judged(text):
    return scored(text)[0]


def told(text):
    """Names of the causes, the first first."""
    return [cause["cause"] for cause in judged(text)["causes"]]


def with_gravity(code, gravity):
    code.gravity = gravity
    return code


class Steps(unittest.TestCase):
    def test_gravity_is_named_where_none_is_asked_for(self):
        for problem, gravity in itertools.product(("rod-10", "rod-45", "thick-rod"), (9.81, 1.0, -9.81)):
            exact = with_gravity(Code(problem, 1), gravity)
            for text in (with_gravity(StepCode(problem, 1), gravity).text(), exact.text(exact.rows(1 / 500))):
                with self.subTest(problem=problem, gravity=gravity):
                    cause, = judged(text)["causes"]
                    self.assertEqual(cause["cause"], "gravity")
                    self.assertAlmostEqual(cause["value"], gravity, delta=1e-9)

    def test_no_velocities_are_said_to_grow_where_gravity_is_left_out(self):
        for problem, gap, order in itertools.product(("box", "clatter-05", "clatter-08"), (0, 1), ("ksd", "kds", "kdks")):
            with self.subTest(problem=problem, gap=gap, order=order):
                self.assertEqual(told(with_gravity(StepCode(problem, gap, order=order), 0.0).text()), ["gravity"])

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
        for problem, step in itertools.product(("friction-slip", "friction-stick", "friction-slip-stick"), (1 / 960, 1 / 3840)):
            with self.subTest(problem=problem, step=step):
                self.assertNotIn("restitution", told(StepCode(problem, 0, step).text(4)))

    def test_the_flights_of_a_step_of_first_order_are_named_with_what_the_step_leaves(self):
        for problem in ("box", "clatter-08"):
            for order, how in (("ksd", "semi-implicit"), ("kds", "semi-implicit"), ("dks", "explicit")):
                for every in (1, 4):
                    with self.subTest(problem=problem, order=order, every=every):
                        causes = judged(StepCode(problem, 1, 1 / 3840, order).text(every, step="1/3840"))["causes"]
                        step, = (cause for cause in causes if cause["cause"] == "first-order-step")
                        self.assertAlmostEqual(step["value"], 1 / 3840, delta=1e-15)
                        self.assertIn("g·step/2 = 0.00128 m/s", step["words"])
                        self.assertIn(how, step["words"])
                        if every == 1:
                            rest, = (cause for cause in causes if cause["cause"] == "time-step")
                            self.assertIn("the step explains the rest", rest["words"])

    def test_a_step_of_second_order_flies_freely_and_another_restitution_is_named_before_one_of_first_order(self):
        for problem in ("box", "clatter-08"):
            self.assertEqual(told(StepCode(problem, 1, order="kdks").text()), ["time-step"])
            code = StepCode(problem, 1)
            code.e -= 0.1
            causes = judged(code.text())["causes"]
            self.assertEqual(causes[0]["cause"], "restitution")
            self.assertLessEqual({cause["cause"] for cause in causes[1:]}, {"first-order-step"})  # where its mending helps
            self.assertAlmostEqual(causes[0]["value"], code.e, delta=1e-6)


class SoftCode(Code):
    """Ends on springs, by a step so short that the contact alone makes the error."""

    def rows(self, stiffness, every=1e-3):
        step, state, rows = 5e-6, self.state, []
        for k in range(math.ceil(self.end() / step) + 1):
            if k % round(every / step) == 0:
                rows.append([k * step, *state[1:]])
            for point in range(len(self.points)):
                depth = -self.height(state, point)
                if depth > 0:
                    state = self.apply(state, point, stiffness * depth * step, 0.0)
            state = self.fly(state, step)
        return rows


class Others(unittest.TestCase):
    def test_a_contact_that_takes_time_is_not_said_to_be_late(self):
        code = SoftCode("rod-10", 1)
        found = judged(code.text(code.rows(1e5)))
        self.assertEqual([cause["cause"] for cause in found["causes"]], ["contact-time"])
        effective = 1 / (1 / code.mass + (0.5 * math.cos(math.radians(10)))**2 / code.moment)
        self.assertAlmostEqual(found["causes"][0]["value"], math.pi * math.sqrt(effective / 1e5), delta=5e-5)
        self.assertIn("its contacts take 0.0050", found["causes"][0]["words"])

    def test_little_restitution_is_named_by_the_impacts_before_they_come_too_fast_for_the_rows(self):
        for e in (0.05, 0.1):
            code = Code("rod-10", 1)
            code.e = e
            causes = judged(code.text(code.rows(1e-3)))["causes"]
            self.assertEqual([cause["cause"] for cause in causes], ["restitution"])
            self.assertAlmostEqual(causes[0]["value"], e, delta=1e-9)

    def test_velocities_before_the_impacts_are_named(self):
        for problem in ("rod-10", "friction-slip"):
            truth = Motion(problem)
            lines = [f"# problem: {problem}", "# Omega: clockwise", "# ended: nothing approaches", "t,place,Pn,Pt,V,Omega"]
            for row, piece in zip(truth.truth, truth.pieces):
                before = piece.flown(truth.body, truth.gravity, truth.touch + row["t"])
                lines.append(f"{row['t']!r},{row['place']},{row['Pn']!r},{row['Pt']!r},{before.velocity[2]!r},{before.omega[1]!r}")
            self.assertEqual(told("\n".join(lines) + "\n"), ["velocities-before"], problem)


def resized(code, along=1.0, across=1.0, raised=True):
    """Another body, whose lowest point starts as high above the ground as that of the problem's, if raised."""
    lowest = min(code.height(code.state, k) for k in range(len(code.points)))
    x, z = (max(point[i] for point in code.points) for i in (0, 1))
    of_length = code.mass * x * x / 3
    code.moment = of_length * along**2 + (code.moment - of_length) * across**2
    code.points = [(along * x, across * z) for x, z in code.points]
    if raised:
        code.state[2] += lowest - min(code.height(code.state, k) for k in range(len(code.points)))
    return code


class Starts(unittest.TestCase):
    def test_what_differs_at_the_start_is_told_with_both_values(self):
        for k, change, words in ((3, 1.01, "phi is 0.440696 rad, must be 0.436332 rad"), (5, 1.01, "vz is -1.49204 m/s, must be -1.47726 m/s"),
                                 (4, 0.3, "vx is 0.3 m/s, must be 0 m/s"), (6, -0.2, "omega is -0.2 rad/s, must be 0 rad/s")):
            code = Code("box", 1)
            code.state[k] = code.state[k] * change if code.state[k] else change
            self.check_start(code.text(code.rows(1 / 500)), words + ", error 0.")
        motion = Motion("corner", 1)
        motion.pieces[0].omega = (0.5, *motion.pieces[0].omega[1:])
        self.check_start(motion.text(motion.rows(1 / 500)), "wx is 0.5 rad/s, must be")

    def check_start(self, text, words):
        with self.subTest(words):
            finding, = (one for one in judged(text)["findings"] if "does not start" in one)
            self.assertIn(f"does not start as the problem says: {words}", finding)

    def test_a_start_is_told_beside_the_one_that_is_nearest_to_it(self):
        self.check_start(resized(StepCode("box", 1), across=2).text(), "z is 0.136343 m, must be 0.0910272 m, error 0.")

    def test_an_angle_in_degrees_at_the_start_alone_is_named(self):
        for (problem, degrees), gap in itertools.product((("box", 25), ("rod-10", 10), ("clatter-08", 10)), (0, 1)):
            for code in (StepCode(problem, gap), Code(problem, gap)):
                code.state[3] = float(degrees)
                with self.subTest(problem=problem, gap=gap):
                    text = code.text() if isinstance(code, StepCode) else code.text(code.rows(1 / 500))
                    found = judged(text)
                    self.assertEqual([cause["cause"] for cause in found["causes"]], ["start-degrees"])
                    self.assertIn(f"phi is {degrees} rad, must be ", " ".join(found["findings"]))

    def test_another_size_of_the_body_is_named(self):
        for problem, changes, size in (("rod-10", {"along": 0.9}, 0.9), ("rod-10", {"along": 0.9, "raised": False}, 0.9),
                                       ("rod-45", {"along": 0.5}, 0.5), ("box", {"across": 2}, 0.2), ("box", {"along": 0.9}, 0.18),
                                       ("thick-rod", {"across": 2}, 0.1)):
            exact = resized(Code(problem, 1), **changes)
            for text, tolerance in ((exact.text(exact.rows(1 / 500)), 1e-9),
                                    (resized(StepCode(problem, 1, 1 / 3840), **changes).text(), 0.01 * size)):
                with self.subTest(problem=problem, **changes):
                    causes = judged(text)["causes"]
                    self.assertEqual([cause["cause"] for cause in causes], ["size"])
                    self.assertAlmostEqual(causes[0]["value"], size, delta=tolerance)
                    self.assertIn("is asked", causes[0]["words"])

    def test_a_body_that_starts_tilted_the_other_way_is_its_own_mirror_image(self):
        code = Code("box", 1)
        code.state[3] *= -1
        self.assertEqual(told(code.text(code.rows(1 / 500))), ["phi-sign", "left-right", "start-angle"])


class Words(EmptyFolder):
    def test_one_line_tells_causes_that_explain_the_same_and_none_is_wider_than_a_terminal(self):
        code = Code("box", 1)
        code.state[3] *= -1
        lines = printed("benchmark", "score", self.write("run.csv", code.text(code.rows(1 / 500)))).splitlines()
        self.assertLessEqual(max(map(len, lines)), 80)
        cause, = (line for line in lines if "likely cause" in line)
        self.assertIn("likely cause: either phi and omega count the other turn", cause)

    def test_an_impact_at_no_point_of_the_body_has_no_place(self):
        code = Code("rod-10", 1)
        code.points = [(x, 0.1) for x, _ in code.points]
        code.moment *= 3
        findings = judged(code.text(code.rows(1 / 500)))["findings"]
        self.assertIn("impact 1 (lines 53 to 54) is at no point of the body, must be at a", findings)
        self.assertIn("impact 1 (lines 53 to 54) does not follow the law: no point of the body explains its jump; of the lowest one e = ", " ".join(findings))


class Scenes(EmptyFolder):
    """Codes of Moreau's law, whose files name none, against scenes with friction."""

    def against(self, problem, *options, **factors):
        code = RigidCode(problem, 1)
        for name, factor in factors.items():
            setattr(code, name, getattr(code, name) * factor)
        text = code.text(code.rows(1 / 500)).replace("# law: newton moreau\n", "")
        scene = self.write("scene.toml", code.statement["scene_toml"])
        return json_of("compare", scene, *options, "--against", self.write("run.csv", text))["files"][0]

    def test_another_law_than_the_scenes_is_named_and_no_fault(self):
        for problem in ("friction-reversal", "corner-friction"):
            with self.subTest(problem):
                found = self.against(problem)
                cause, = found["causes"]
                self.assertEqual((found["verdict"], cause["cause"]), ("fails", "law"))
                for words in ("newton moreau explains", "# law: newton moreau", "--impact-friction-law moreau"):
                    self.assertIn(words, cause["words"])
                self.assertEqual(self.against(problem, "--impact-friction-law", "moreau")["verdict"], "exact")

    def test_friction_is_known_where_the_scene_asks_for_moreaus_law(self):
        for problem in ("friction-reversal", "friction-slip", "corner-friction"):
            friction = RigidCode(problem, 1).friction
            with self.subTest(problem):
                found = {factor: self.against(problem, "--impact-friction-law", "moreau", friction=factor)["causes"] for factor in (0.7, -1)}
                self.assertEqual([cause["cause"] for cause in found[0.7]], ["friction"])
                self.assertAlmostEqual(found[0.7][0]["value"], 0.7 * friction, delta=1e-3)
                self.assertIn(f"({friction} is asked)", found[0.7][0]["words"])
                # Along the slip that it reverses, such friction is also a ratio against the slip before.
                either = ["friction-ratio"] if problem == "friction-reversal" else []
                self.assertEqual([cause["cause"] for cause in found[-1]], ["friction-direction", *either])


class Directions(unittest.TestCase):
    """Friction of the other sign: it pushes along the slip after the impact or before it, or all that is solved is turned round."""

    @staticmethod
    def turned(w, v, e, friction):
        return moreau(w, v, e, friction) * (-1, -1, 1)

    @staticmethod
    def pushing_on(w, v, e, friction):
        way = np.array([0, 0, 1]) + friction / math.hypot(v[0], v[1]) * np.array([v[0], v[1], 0])
        return -(1 + e) * v[2] / (w @ way)[2] * way

    @staticmethod
    def turned_face(code, state):
        right = RigidCode.land(code, state)
        slip = [2 * before - after for before, after in zip(state.velocity[:2], right.velocity)]
        return struck(right, [*slip, right.velocity[2]], right.omega)

    def test_friction_along_the_slip_is_named_in_space_and_of_points_that_strike_together(self):
        for problem, changes in (("corner-friction", {"friction": -0.3}), ("corner-friction", {"solved": self.turned}),
                                 ("corner-friction", {"solved": self.pushing_on}), ("incline-slide", {"friction": -0.35}),
                                 ("incline-stick", {"friction": -0.4}), ("incline-slide", {"land": self.turned_face}),
                                 ("incline-stick", {"land": self.turned_face}), ("face-grip", {"land": self.turned_face})):
            with self.subTest(problem=problem, changes=changes):
                code = RigidCode(problem, 1)
                for name, change in changes.items():
                    setattr(code, name, change.__get__(code) if name == "land" else change)
                found = judged(code.text(code.rows(1 / 500)))
                self.assertEqual([cause["cause"] for cause in found["causes"]], ["friction-direction"])
                law, = (words for words in found["findings"] if "does not follow the law" in words)
                self.assertRegex(law, r"P_t along the slip|P_t turned by 1[678]\d° from the law's")

    def test_which_way_friction_points_is_told_of_two_corners(self):
        code = RigidCode("incline-slide", 1)
        code.friction *= -1
        stick = 0.1 / (1.5 * 0.7)  # stops 0.1 m/s of slip beside a normal jump of (1 + e) 0.7 m/s
        self.assertIn(f"does not follow the law: P_t/P_n = 0.350 and not {-stick:.3g}, P_t along the slip, e = 0.500",
                      " ".join(judged(code.text(code.rows(1 / 500)))["findings"]))


class Documents(EmptyFolder):
    PAGE = pathlib.Path(os.environ["CLATTER_ROOT"], "notebooks-data/reference/benchmark.md").read_text()

    def test_the_runner_of_the_reference_needs_only_the_name_of_a_problem(self):
        runner = self.PAGE.split("```python\n")[1].split("```")[0]
        os.symlink(os.environ["CLATTER_PROGRAM"], self.path("clatter"))
        for problem in ("rod-10", "clatter-08", "friction-slip"):
            path = self.write("runner.py", runner.replace('PROBLEM = "rod-10"', f'PROBLEM = "{problem}"'))
            subprocess.run([sys.executable, path], cwd=self.folder, env={**os.environ, "PATH": f"{self.folder}:{os.environ['PATH']}"}, check=True)
            found = judged(self.read(f"{problem}-2000-s3.csv"))
            self.assertEqual(found["problem"], problem)
            self.assertNotIn("cut-off", [cause["cause"] for cause in found["causes"]])

    def test_the_example_of_the_reference_is_right_as_far_as_it_goes(self):
        found = judged(self.PAGE.split("## Hand in a motion")[1].split("```")[1].strip() + "\n")
        self.assertEqual([cause["cause"] for cause in found["causes"]], ["cut-off"])
        self.assertLess(found["start_error"], 1e-6)
        self.assertLess(found["impact_scores"][0]["law_error"], 1e-6)


    def test_the_table_of_causes_has_those_that_the_judge_can_name(self):
        """A cause's name is the first part of a braced value or of a call; only columns of files stand there, too."""
        folder = pathlib.Path(os.environ["CLATTER_ROOT"], "validation/benchmark")
        first = r'[{(]\s*((?:[\w.<> ]+\?\s*"[^"]*"\s*:\s*)*"[^"]*")\s*,'
        named = {name for path in folder.glob("*cause.cpp") for part in re.findall(first, path.read_text()) for name in re.findall(r'"([a-z-]{3,})"', part)}
        listed = re.findall(r"^\| (`.+?) \|", self.PAGE.split("| likely cause |")[1].split("\n\n")[0], re.M)
        self.assertEqual({name for line in listed for name in re.findall("`(.+?)`", line)}, named - {"phi", "omega"})
