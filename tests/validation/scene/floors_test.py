#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Floors and bodies by name: which half-space they make in each command, and what is said of what no source gives."""

import json
import math
import unittest

from run_folder import Folder, json_of, run

FLAT = ["--body", "box", "--size", "0.15x0.075x0.008", "--mass", "0.165", "--angle", "0", "--speed", "2", "--impacts", "1"]
CORNER = ["--body", "box", "--size", "0.15x0.075x0.008", "--mass", "0.165", "--height", "1", "--angle", "35", "--tilt", "20", "--impacts", "1"]
# Young's modulus [Pa] and Poisson's ratio, least and largest, as the sources that `clatter shock --ground` names have them.
CONCRETE, ABS = ((10e9, 0.15), (23e9, 0.33)), (2.4e9, 0.35)
STEEL_BODY = (212e9, 0.293)


def plane(modulus, poisson):
    return modulus / (1 - poisson ** 2)


def together(one, other):
    return 1 / (1 / one + 1 / other)


def concrete_under(body):
    ends = [together(plane(*floor), plane(*body)) for floor in CONCRETE]
    return ends[0], math.sqrt(ends[0] * ends[1]), ends[1]


class Floors(Folder):
    def refused(self, words, *arguments):
        done = run(*arguments)
        self.assertEqual((done.returncode, done.stdout), (2, ""))
        self.assertIn(words, done.stderr)
        self.assertEqual(done.stderr.count("\n"), 1)

    def test_a_floor_by_name_is_the_half_space_of_its_numbers_in_every_command(self):
        least, middle, largest = concrete_under(ABS)
        told = json_of("simulate", *CORNER, "--floor", "concrete")
        ground = told["scene"]["ground"]
        self.assertEqual((ground["floor"], ground["body_material"]), ("concrete", "abs"))
        for name, value in (("value", middle), ("least", least), ("largest", largest)):
            self.assertAlmostEqual(ground["reduced_modulus"][name] / value, 1, delta=1e-14)
        self.assertEqual(len(ground["reduced_modulus"]["sources"]), 2)
        by_number = json_of("simulate", *CORNER, "--ground-modulus", repr(ground["reduced_modulus"]["value"]))
        self.assertEqual(told["impacts"], by_number["impacts"])
        shock = json_of("shock", *CORNER, "--floor", "concrete", "--probe", "camera:0.06,0.03,0")
        self.assertEqual(shock["scene"]["ground"]["reduced_modulus"], ground["reduced_modulus"])
        scene = self.write("floor.toml", "[drop]\nangle_deg = 35\ntilt_deg = 20\nheight = 1\n[body]\nshape = 'box'\nsize = [0.15, 0.075, 0.008]\n"
                           "mass = 0.165\n[ground]\nfloor = 'concrete'\n[run]\nimpacts = 1\n")
        swept = json_of("sweep", scene, "--model", "continuous", "--set", "ground.dissipation=0,0.2")
        self.assertAlmostEqual(swept["rows"][0]["first_peak_force"] / told["impacts"][0]["peak_force"], 1, delta=1e-5)
        page = self.path("page.html")
        self.assertEqual(run("report", scene, "--probe", "camera:0.06,0.03,0", "--output", page).returncode, 0)
        self.assertIn("concrete under abs", self.read("page.html"))

    def test_the_body_s_material_or_modulus_goes_beside_the_floor_s_or_the_ground_s(self):
        def value_of(*flags):
            return json_of("simulate", *FLAT, *flags)["scene"]["ground"]["reduced_modulus"]["value"]
        self.assertAlmostEqual(value_of("--floor", "concrete", "--body-material", "steel") / concrete_under(STEEL_BODY)[1], 1, delta=1e-14)
        self.assertAlmostEqual(value_of("--ground-modulus", "3e10", "--body-modulus", "3e9") / together(3e10, 3e9), 1, delta=1e-14)
        self.assertAlmostEqual(value_of("--ground-modulus", "3e10", "--body-material", "abs") / together(3e10, plane(*ABS)), 1, delta=1e-14)
        low, middle, high = (value_of("--floor", floor) for floor in ("wood", "asphalt", "steel"))
        self.assertTrue(low < middle < high < plane(*ABS))

    def test_a_restitution_that_no_source_gives_is_told_as_a_range(self):
        told = run("simulate", *FLAT, "--floor", "concrete").stdout
        self.assertIn("no source gives a restitution", " ".join(told.split()))
        damped = run("simulate", *FLAT, "--floor", "concrete", "--dissipation", "0.2").stdout
        self.assertNotIn("no source", damped)

    def test_a_restitution_of_the_first_impact_is_that_of_a_flat_landing_on_each_kind_of_ground(self):
        for ground in (("--floor", "concrete"), ("--stiffness", "1e9"), ("--curve", "[[0, 0], [0.1, 1e5], [0.6, 1e6]]", "--thickness", "0.01")):
            impact = json_of("simulate", *FLAT, *ground, "--floor-restitution", "0.4", "--digits", "8")["impacts"][0]
            self.assertAlmostEqual(impact["velocity_after"][2] / 2, 0.4, delta=1e-6, msg=ground)
        head = " ".join(run("simulate", *FLAT, "--floor", "concrete", "--floor-restitution", "0.4").stdout.split())
        self.assertIn("e = 0.4 in the first impact (dissipation", head)
        self.refused("not both", "simulate", *FLAT, "--floor", "concrete", "--floor-restitution", "0.4", "--dissipation", "1")
        self.refused("greater than 0", "simulate", *FLAT, "--floor", "concrete", "--floor-restitution", "0")
        self.refused("no first impact", "simulate", *FLAT[:-4], "--gravity", "9.81", "--start", "rest", "--floor", "wood", "--floor-restitution", "0.4")

    def test_ground_prints_what_a_scene_and_flags_take(self):
        shown = json_of("shock", "--ground", "--floor", "concrete")
        self.assertEqual(len(shown["solutions"]), 3)
        for row, value in zip(shown["solutions"], concrete_under(ABS)):
            self.assertAlmostEqual(row["reduced_modulus"] / value, 1, delta=1e-14)
        pad = ["--curve", "[[0, 0], [0.1, 2e4], [0.6, 2.5e4], [0.8, 2e5]]", "--thickness", "0.03"]
        for ground in (["--floor", "concrete"], ["--ground-modulus", "1e9"], pad):
            text = run("shock", "--ground", *FLAT, *ground, "--measured-e", "0.4").stdout
            block = text[text.index("[ground]\n"):text.index("or as flags:")]
            flags = " ".join(text[text.index("or as flags:") + len("or as flags:"):].split()).split()
            again = json_of("simulate", *FLAT, *(pad if ground == pad else []), *flags)
            after = again["impacts"][0]["velocity_after"][2]
            self.assertAlmostEqual(after / 2, 0.4, delta=1e-5)
            self.assertIn("dissipation = ", block)
        found = run("shock", "--ground", *FLAT, "--measured-e", "0.5", "--contact-time", "5e-4").stdout
        self.assertIn("--stiffness", found[found.index("or as flags:"):])

    def test_what_cannot_be_is_refused_in_a_line(self):
        for words, flags in (("did you mean steel", ("--floor", "stell")), ("give one of them, not both", ("--floor", "wood", "--stiffness", "1e9")),
                             ("give one of them, not both", ("--floor", "wood", "--ground-modulus", "1e9")),
                             ("give one of them, not both", ("--floor", "wood", "--body-modulus", "1e9", "--body-material", "abs")),
                             ("only for a ground with a modulus or a floor", ("--body-material", "abs"))):
            self.refused(words, "simulate", *FLAT, *flags)
        self.refused("it is what is sought", "shock", "--ground", *FLAT, "--floor", "wood", "--dissipation", "1", "--measured-e", "0.5")


if __name__ == "__main__":
    unittest.main()
