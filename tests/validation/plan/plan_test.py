# SPDX-License-Identifier: GPL-3.0-or-later
"""clatter plan, the runs that follow it, and clatter plan --tradeoff.  Costs are measured, not judged: no test depends on a time."""

import collections
import shlex
import shutil
import unittest

from run_folder import EmptyFolder, case, json_of, run
from space_folder import MASS, SIZE, SpaceFolder

RUNGS = ["closed form", "discrete", "discrete 3D", "planar", "spatial"]
CORNER = "corner.toml"
TEXT = (f"[drop]\nangle_deg = 30\ntilt_deg = 40\n[body]\nshape = 'box'\nsize = {list(SIZE)}\nmass = {MASS}\n[ground]\nstiffness = 1e9\n"
        "[run]\nimpacts = 2\ndigits = 3\n")


class Plan(EmptyFolder):
    def test_command_of_the_plan_can_be_typed_whatever_the_file_is_called(self):
        path = shutil.copy(case("rod-45"), self.path("the user's scene;1.toml"))
        command = shlex.split(json_of("plan", path, "--digits", "4")["choice"]["command"])
        self.assertEqual(command[:3], ["clatter", "simulate", path])
        self.assertLessEqual(json_of(*command[1:])["accuracy"]["achieved"], 1e-4)

    def test_the_plan_tells_what_simulate_takes_of_the_scene_as_it_is(self):
        for flags in ([], ["--digits", "4"]):
            plan, run_alone = json_of("plan", "phone-damped", *flags), json_of("simulate", "phone-damped", *flags)
            self.assertEqual(plan["simulate_evaluations"], run_alone["cost"]["force_evaluations"])
            self.assertGreater(plan["simulate_seconds"], 0)

    def test_digits_out_of_reach_are_said_to_be(self):
        self.assertEqual(run("plan", "phone-damped", "--within", "0.02", "--digits", "9").returncode, 3)
        done = run("plan", case("phone-elastic"), "--digits", "12")
        self.assertEqual((done.returncode, len(done.stderr.splitlines())), (3, 1))
        self.assertIn("12 digits", done.stderr)

    def test_a_tighter_run_that_a_limit_leaves_without_errors_does_not_take_the_place_of_a_looser_one(self):
        self.write("limited.toml", "[run]\nevaluation_limit = 50000\n")
        attitude = "0.3630246612905481,0.35955313946746215,0.6382444569842466,-0.5758286622970923"
        found = self.json_of("simulate", "limited.toml", "--attitude", attitude, "--clearance", "0.8", "--body", "box", "--size", "0.2x0.1x0.03", "--mass",
                             "0.6", "--centre", "0.005,0,0", "--floor", "concrete", "--floor-restitution", "0.5", "--sliding-friction", "0.3", "--impacts", "1")
        self.assertLess(found["accuracy"]["achieved"], 1e-3)

    def test_bad_input_is_one_line(self):
        self.each_refused({f"plan rod-45 {option}": option.split()[0] for option in (
            "--digits 1", "--within 0", "--within nan", "--method rk4", "--step 1e-6", "--tolerance 1e-6", "--history x.csv")} | {
            "plan rod-sweep": "sweep", "sequence --angle 10 --method closed": "--method", "sequence --angle 10 --method closed-form": "closed-form",
            "simulate rod-45 --tolerance 1": "--tolerance", "simulate rod-45 --tolerance 1e-6 --step 1e-6": "--step", "tradeoff rod-sweep": "sweep",
            "tradeoff rod-45 --plot /no/such/folder/x.svg": "--plot", "tradeoff rod-45 --digits x": "--digits"})


class InSpace(SpaceFolder):
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
            self.assertEqual(self.run_program(*shlex.split(plan["choice"]["command"])[1:]).returncode, 0)
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

    def test_a_tradeoff_has_a_point_of_the_discrete_model_in_space_with_its_cost_and_error(self):
        all_points = self.json_of("plan", "--tradeoff", CORNER, "--stiffness", "1e15", "--impacts", "1")["points"]
        points = [p for p in all_points if p["model"] == "discrete 3D"]
        self.assertEqual(len(points), 1)
        self.assertIsNone(points[0]["failure"])
        _, rungs = self.rungs(CORNER, "--stiffness", "1e15", "--impacts", "1")
        self.assertAlmostEqual(points[0]["error"], rungs["discrete 3D"]["error"], delta=1e-2 * points[0]["error"])
        self.assertGreater(points[0]["seconds"], 0)
        spatial = [p for p in all_points if p["model"] == "spatial" and not p["failure"]]
        self.assertLess(min(p["error"] for p in spatial), points[0]["error"])


class Tradeoff(unittest.TestCase):
    def test_every_model_and_five_methods_over_their_settings_are_there_and_nothing_beats_a_point_of_the_front(self):
        points = json_of("plan", "--tradeoff", "rod-45")["points"]
        counts = collections.Counter((p["model"], p["method"]) for p in points if not p["mesh"])
        expected = {("closed form", None): 1, ("discrete", None): 1, ("planar", "tvd-rk3"): 11, ("spatial", "tvd-rk3"): 11}
        expected |= {(model, method): 13 for model in ("planar", "spatial") for method in ("rk4", "rkf45", "rkck", "rk8pd")}
        self.assertEqual({key: counts[key] for key in expected}, expected)
        self.assertEqual(sum(1 for p in points if p["mesh"]), 4)
        points = [p for p in points if p["failure"] is None]
        front = [p for p in points if p["front"]]
        self.assertGreater(len(front), 3)
        for point in front:
            self.assertFalse(any(p["seconds"] < point["seconds"] and p["error"] < point["error"] for p in points))

    def test_a_model_that_does_not_apply_is_listed_with_its_reason(self):
        points = json_of("plan", "--tradeoff", "phone-elastic", "--impacts", "1")["points"]
        for model, reason in (("closed form", "rod"), ("discrete 3D", "stays in its plane")):
            [point] = [p for p in points if p["model"] == model]
            self.assertIn(reason, point["failure"])
            self.assertIsNone(point["error"])
