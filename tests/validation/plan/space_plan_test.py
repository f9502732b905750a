# SPDX-License-Identifier: GPL-3.0-or-later
"""clatter plan and tradeoff of drops in space: the discrete model in space stands between the plane and the contacts."""

import json
import unittest

from space_folder import MASS, SIZE, SpaceFolder

CORNER = "corner.toml"
TEXT = """[drop]
angle_deg = 30
tilt_deg = 40
[body]
shape = "box"
size = [%r, %r, %r]
mass = %r
[ground]
stiffness = 1e9
[run]
impacts = 2
digits = 3
""" % (*SIZE, MASS)
RUNGS = ["closed form", "discrete", "discrete 3D", "planar", "spatial"]


class Plan(SpaceFolder):
    def setUp(self):
        super().setUp()
        self.write(CORNER, TEXT)

    def rungs(self, *arguments):
        plan = self.json_of("plan", *arguments, status=(0,))
        self.assertEqual([rung["model"] for rung in plan["rungs"]], RUNGS)
        return plan, {rung["model"]: rung for rung in plan["rungs"]}

    def test_the_discrete_model_in_space_comes_nearer_to_the_contacts_the_stiffer_the_ground_and_is_chosen_at_last(self):
        errors, chosen = [], []
        for stiffness in ("1e11", "1e15", "1e19"):
            plan, rungs = self.rungs(CORNER, "--stiffness", stiffness, "--static-friction", "0.3", "--sliding-friction", "0.3", "--digits", "2")
            errors.append(rungs["discrete 3D"]["error"])
            chosen.append(plan["choice"]["model"])
        # Contacts of a corner last 1/10 as long at 10⁴ times the stiffness, and so do the effects of their time.
        for stiff, stiffer in zip(errors, errors[1:]):
            self.assertAlmostEqual(stiff / stiffer, 10, delta=3)
        self.assertEqual((chosen[0], chosen[-1]), ("spatial", "discrete 3D"))

    def test_the_error_of_the_discrete_rung_in_space_is_how_far_its_sequence_is_from_the_contacts(self):
        ground = [CORNER, "--stiffness", "1e13"]
        _, rungs = self.rungs(*ground)
        simulated = self.json_of("simulate", *ground, "--digits", "8")["impacts"]
        discrete = self.json_of("sequence", CORNER)["impacts"]
        speed = max(max(abs(v) for v in row["velocity_after"]) for row in simulated)
        apart = max(abs(a - b) for row, other in zip(simulated, discrete) for a, b in zip(row["velocity_after"], other["velocity_after"]))
        self.assertLessEqual(apart / (4 * speed), rungs["discrete 3D"]["error"])
        self.assertGreater(rungs["discrete 3D"]["error"], 0)

    def test_a_drop_that_stays_in_its_plane_needs_no_discrete_model_in_space_and_one_that_leaves_it_none_in_the_plane(self):
        _, rungs = self.rungs("phone-damped", "--impacts", "1", "--digits", "3")
        self.assertIsNone(rungs["discrete"]["reason"])
        self.assertIn("stays in its plane", rungs["discrete 3D"]["reason"])
        _, rungs = self.rungs(CORNER)
        self.assertIn("drop.tilt_deg turns it out of its plane", rungs["discrete"]["reason"])
        self.assertIsNone(rungs["discrete 3D"]["reason"])

    def test_a_friction_law_that_the_discrete_model_does_not_have_is_the_reason_against_it(self):
        self.write("creeps.toml", '[drop]\nangle_deg = 20\ntilt_deg = 30\n[body]\nshape = "box"\nsize = [0.1, 0.05, 0.02]\n[ground]\n'
                   'stiffness = 1e9\nsliding_friction = 0.2\nfriction_law = "regularised"\n[run]\nimpacts = 1\n')
        _, rungs = self.rungs("creeps.toml", "--digits", "3")
        self.assertIn("regularised friction creeps", rungs["discrete 3D"]["reason"])

    def test_what_contacts_take_is_accounted_for_before_they_are_simulated(self):
        plan, rungs = self.rungs(CORNER, "--stiffness", "1e15")
        rung = rungs["discrete 3D"]
        self.assertEqual(rung["assumption"], "contacts take no time and no depth")
        self.assertLess(rung["error"], 30 * rung["assumption_error"])
        self.assertGreater(rung["error"], rung["assumption_error"] / 30)
        self.assertEqual(plan["impacts"], 2)

    def test_the_plan_s_command_runs_the_model_that_is_chosen(self):
        self.write(CORNER, TEXT.replace("1e9", "1e19").replace("impacts = 2", "impacts = 1"))
        plan, _ = self.rungs(CORNER, "--digits", "2")
        self.assertEqual(plan["choice"]["model"], "discrete 3D")
        done = self.run_program(*plan["choice"]["command"].split()[1:])
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_a_tradeoff_has_a_point_of_the_discrete_model_in_space_with_its_cost_and_error(self):
        done = self.run_program("tradeoff", CORNER, "--stiffness", "1e15", "--impacts", "1", "--format", "json")
        points = [p for p in json.loads(done.stdout)["points"] if p["model"] == "discrete 3D"]
        self.assertEqual(len(points), 1)
        self.assertIsNone(points[0]["failure"])
        _, rungs = self.rungs(CORNER, "--stiffness", "1e15", "--impacts", "1")
        self.assertAlmostEqual(points[0]["error"], rungs["discrete 3D"]["error"], delta=1e-2 * points[0]["error"])
        self.assertGreater(points[0]["seconds"], 0)
        spatial = [p for p in json.loads(done.stdout)["points"] if p["model"] == "spatial" and not p["failure"]]
        self.assertLess(min(p["error"] for p in spatial), points[0]["error"])

    def test_a_tradeoff_in_the_plane_lists_why_space_is_left_out(self):
        done = self.run_program("tradeoff", "phone-elastic", "--impacts", "1", "--format", "json")
        [point] = [p for p in json.loads(done.stdout)["points"] if p["model"] == "discrete 3D"]
        self.assertIn("stays in its plane", point["failure"])
