# SPDX-License-Identifier: GPL-3.0-or-later
"""clatter sequence of a drop in space: one scene language, one record, laws of mechanics as oracles."""

import math

from space_folder import MASS, SIZE, SpaceFolder, words

PHONE = ["--body", "box", "--size", "x".join(map(str, SIZE)), "--mass", str(MASS)]
CORNER = [*PHONE, "--angle", "40", "--tilt", "25"]
# A level face with four outcomes, one of which 8.1 degrees of tilts give.
TURN = (-0.5868253197351159, 0, 0, 0.8097135568321546)
FACE = ["--body", "box", "--size", "0.1514x0.08958x0.1433", "--mass", "0.584", "--velocity=0,0,-1",
        "--angular-velocity=20.31,-4.001,-25.12", "--restitution", "0.4", "--gravity", "9.81"]


class Sequence(SpaceFolder):
    def test_the_cases_that_come_to_rest_end_and_their_momentum_balances(self):
        masses = {"coin": 0.0075, "tube": 0.1934, "needle": 1.578e-4, "cube": 0.0875, "die": 4.83e-3}
        for case, mass in masses.items():
            done = self.json_of("sequence", case, status=(0,))
            self.assertIn(done["outcome"], ("at-rest",) if case in ("cube", "die") else ("sustained-contact",), case)
            self.assertGreater(len(done["impacts"]), 10)
            tail, first = done["tail"], done["impacts"][0]
            arrived = first["velocity_after"][2] - first["impulse"][2] / mass
            given = done["total_normal_impulse"] / mass
            self.assertAlmostEqual(tail["velocity_after"][2], arrived + given - 9.81 * tail["end_time"], delta=1e-8, msg=case)
        tube = self.json_of("sequence", "tube", "--impacts", "1")["body"]
        outer, inner = 0.02, 0.018
        mass = 2700 * math.pi * (outer**2 - inner**2) * 0.3
        self.assertAlmostEqual(tube["mass"] / mass, 1, delta=1e-3)
        self.assertAlmostEqual(tube["inertia"][0] / (mass / 2 * (outer**2 + inner**2)), 1, delta=1e-3)
        self.assertAlmostEqual(tube["inertia"][1] / (mass / 12 * (3 * (outer**2 + inner**2) + 0.3**2)), 1, delta=1e-3)

    def test_a_scene_in_its_plane_runs_in_the_plane_and_one_tilted_by_next_to_nothing_in_space(self):
        for tilt, in_space in (("0", False), ("1e-7", True), ("-1e-7", True)):
            row = self.json_of("sequence", *PHONE, "--angle", "20", "--tilt", tilt, "--gravity", "9.81", "--impacts", "1")["impacts"][0]
            self.assertEqual(("attitude" in row, row["end"]), (in_space, "a"))

    def test_until_rest_goes_on_to_the_end_and_says_where_the_body_settles(self):
        drop = ("sequence", *PHONE, "--angle", "4", "--tilt", "3", "--clearance", "0.01", "--restitution", "0.4")
        six, all_of_it = self.json_of(*drop), self.json_of(*drop, "--until-rest")
        self.assertEqual((len(six["impacts"]), six["outcome"]), (6, "impact-limit"))
        self.assertGreater(len(all_of_it["impacts"]), 6)
        self.assertEqual(all_of_it["impacts"][:6], six["impacts"])
        self.assertEqual((all_of_it["outcome"], all_of_it["shortfall"]), ("slides-on", None))  # without friction
        self.assertEqual(len(all_of_it["rest"]["corners"].split(", ")), 4)
        self.assertGreaterEqual(all_of_it["rest"]["latest"], all_of_it["tail"]["end_time"])
        # Of hops whose order is open no error is known.
        self.assertEqual((all_of_it["impacts"][-1]["predictable"], all_of_it["tail"]["end_time_error"]), (False, None))

    def test_where_a_corner_stays_the_run_tells_how_the_body_turns_on_it_and_until_rest_goes_on_from_there(self):
        drop = ("sequence", *CORNER, "--gravity", "9.81", "--restitution", "0")
        run = self.json_of(*drop)
        self.assertEqual(run["outcome"], "sustained-contact")
        row, contact = run["impacts"][-1], run["contact"]
        self.assertEqual((contact["mode"], contact["end"], contact["corners"]), ("frictionless", "impact", row["corners"]))
        self.assertEqual(contact["start"], row["start"])
        self.assertGreater(contact["approach_speed"], 0)
        rise = contact["velocity_after"][2] - row["velocity_after"][2] + 9.81 * contact["duration"]
        self.assertAlmostEqual(contact["impulse_normal"], MASS * rise, delta=1e-12)
        self.assertEqual(set(run["energy_losses"]), {"point", "edge", "face", "hops", "contacts"})
        self.assertAlmostEqual(run["energy_losses"]["point"], sum(r["energy_loss"] for r in run["impacts"]), delta=1e-15)
        self.assertIn("the body turns on " + row["corners"], " ".join(self.run_program(*drop).stdout.split()))
        run = self.json_of(*drop, "--friction", "0.2", "--until-rest")  # which accounts for all energy
        self.assertEqual((run["outcome"], run["shortfall"], run["contacts"][0]["end"]), ("at-rest", None, "impact"))
        first, contact = run["impacts"][0], run["contacts"][0]
        then = run["impacts"][contact["after_impact"]]
        self.assertAlmostEqual(then["start"], contact["start"] + contact["duration"], delta=1e-15)
        self.assertEqual(set(then["corners"].split()), {contact["arriving"], contact["corners_at_end"]})
        self.assertAlmostEqual(sum(run["energy_losses"].values()) + run["energy_at_end"], first["energy_before"], delta=1e-9 * first["energy_before"])

    def test_the_outcomes_of_small_tilts_are_all_in_json_and_one_line_of_the_table(self):
        face = ("sequence", *FACE, "--attitude=" + words(TURN), "--impacts", "1")
        row = self.json_of(*face)["impacts"][0]
        outcomes = row["outcomes"]
        self.assertEqual(len(outcomes), 4)
        self.assertAlmostEqual(sum(outcome["share"] for outcome in outcomes), 1, delta=1e-9)
        self.assertEqual((row["outcomes_complete"], row["outcomes_vary"]), (True, False))
        self.assertIn("one after the other", row["convention"])
        self.assertAlmostEqual(outcomes[-1]["share"], 8.1 / 360, delta=1e-4)
        self.assertEqual(outcomes[-1]["strikes"], len(outcomes[-1]["order"]))
        for k in range(3):
            rates = [outcome["angular_velocity_after"][k] for outcome in outcomes]
            self.assertAlmostEqual(row["outcomes_range"]["angular_velocity_after"][k], max(rates) - min(rates), delta=1e-12)
        table = self.run_program(*face).stdout
        self.assertEqual(table.count("4 outcomes"), 1)
        self.assertLessEqual(max(map(len, table.splitlines())), 80)
        self.assertNotIn("outcomes", self.json_of("sequence", *CORNER, "--impacts", "1")["impacts"][0])
