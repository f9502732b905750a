#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""A ground that is an elastic half-space: its keys, which commands take it, what they find, and what is refused."""

import json
import math
import unittest

from run_folder import Folder

BALL = ["--body", "sphere", "--radius", "0.02", "--mass", "0.2", "--speed", "2", "--ground-modulus", "5e9"]
BOX = ["--body", "box", "--size", "0.15x0.075x0.008", "--mass", "0.165", "--height", "1", "--angle", "35",
       "--ground-modulus", "1e9", "--dissipation", "0.1"]
SCENE = """[drop]
angle_deg = 35
height = 1
[body]
shape = "box"
mass = 0.165
size = [0.15, 0.075, 0.008]
[ground]
modulus = 1e9
dissipation = 0.1
"""


class HalfSpace(Folder):
    def json_of(self, *arguments, status=(0, 3)):
        done = self.run_program(*arguments, "--format", "json")
        self.assertIn(done.returncode, status, done.stderr)
        return json.loads(done.stdout)

    def refused(self, words, *arguments):
        done = self.run_program(*arguments)
        self.assertNotEqual(done.returncode, 0)
        self.assertIn(words, done.stderr)
        self.assertEqual(done.stderr.count("\n"), 1)

    def test_file_and_flags_say_the_same_and_the_echo_has_no_springs(self):
        by_flags, by_file = self.json_of("simulate", *BOX), self.json_of("simulate", self.write("floor.toml", SCENE))
        self.assertEqual(by_file["impacts"], by_flags["impacts"])
        ground = by_flags["scene"]["ground"]
        self.assertEqual((ground["modulus"], ground["dissipation"]), (1e9, 0.1))
        for key in ("stiffness", "damping", "area"):
            self.assertNotIn(key, ground)
        springs = self.json_of("simulate", self.write("floor.toml", SCENE), "--stiffness", "1e10")["scene"]["ground"]
        self.assertNotIn("modulus", springs)
        self.assertEqual(springs["damping"], 0)

    def test_springs_beside_it_and_dissipation_without_it_are_refused(self):
        for flag, value in (("--stiffness", "1e9"), ("--damping", "1e6"), ("--area", "projected")):
            self.refused("give one of them, not both", "simulate", *BOX, flag, value)
        self.refused("only for a ground with a modulus", "sequence", "--angle", "10", "--dissipation", "1")
        self.refused("ground.modulus of an elastic half-space", "simulate", "--angle", "10", "--dissipation", "1")
        self.refused("it is what is sought", "shock", "--ground", *BOX, "--measured-e", "0.5", "--contact-time", "3e-4")

    def test_a_ball_s_impact_is_hertz_s_within_one_per_cent_and_its_peak_goes_like_the_modulus_to_two_fifths(self):
        impact = self.json_of("simulate", *BALL)["impacts"][0]
        depth = (15 * 0.2 * 4 / (16 * 5e9 * math.sqrt(0.02))) ** 0.4
        self.assertAlmostEqual(impact["peak_force"] / (4 / 3 * 5e9 * math.sqrt(0.02) * depth ** 1.5), 1, delta=0.01)
        self.assertAlmostEqual(impact["duration"] / (2.868 * (0.04 / (0.02 * 25e18 * 2)) ** 0.2), 1, delta=0.01)
        row = self.json_of("shock", *BALL, "--probe", "middle:0,0,0")["impacts"][0]
        self.assertAlmostEqual(row["sensitivity"], 0.4, delta=1e-3)

    def test_the_limit_of_an_ever_harder_half_space_is_the_discrete_model(self):
        for arguments in ([*BOX, "--impacts", "2"], [*BOX, "--tilt", "20", "--sliding-friction", "0.2", "--impacts", "1"]):
            told = self.json_of("compare", *arguments, status=(0,))
            self.assertTrue(told["agrees"])


if __name__ == "__main__":
    unittest.main()
