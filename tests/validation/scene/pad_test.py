#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""A ground that is a pad by its curve: keys, files and units, what commands find on it, and what is refused."""

import json
import unittest

from run_folder import Folder

BOX = ["--body", "box", "--size", "0.2x0.1x0.04", "--mass", "0.7", "--gravity", "9.81"]
POINTS = [[0, 0], [0.1, 2e4], [0.6, 2.5e4], [0.8, 2e5]]
THICKNESS = 0.03
PAD = ["--curve", json.dumps(POINTS), "--thickness", str(THICKNESS)]
PHONE = ["--body", "box", "--size", "0.15x0.075x0.008", "--mass", "0.165", "--height", "0.2", "--angle", "35"]


def depth_of(load, height_on_pad):
    """Where the integral of pressure over depth, load = m g/A over it, is that of a fall from `height_on_pad`."""
    taken = 0
    for (a, p), (b, q) in zip(POINTS, POINTS[1:]):
        x, width = a * THICKNESS, (b - a) * THICKNESS
        if taken + (p + q) / 2 * width < load * (height_on_pad + b * THICKNESS):
            taken += (p + q) / 2 * width
            continue
        slope, left = (q - p) / width, load * (height_on_pad + x) - taken
        push = p - load
        return x + 2 * left / (push + (push * push + 2 * slope * left) ** 0.5)
    raise ValueError("deeper than the curve")


class Pad(Folder):
    def json_of(self, *arguments, status=(0,)):
        done = self.run_program(*arguments, "--format", "json")
        self.assertIn(done.returncode, status, done.stderr)
        return json.loads(done.stdout)

    def impacts_of(self, *arguments):
        return self.json_of("simulate", *arguments, "--impacts", "1")["impacts"]

    def refused(self, words, *arguments):
        done = self.run_program(*arguments)
        self.assertEqual(done.returncode, 2, done.stdout)
        self.assertIn(words, done.stderr)
        self.assertEqual(done.stderr.count("\n"), 1)
        self.assertEqual(done.stdout, "")

    def test_a_flat_drop_goes_as_deep_as_the_curve_says(self):
        for speed in (0.3, 1, 1.6):
            impact = self.impacts_of(*BOX, *PAD, "--angle", "0", "--speed", str(speed), "--digits", "9")[0]
            depth = depth_of(0.7 * 9.81 / 0.02, speed * speed / 2 / 9.81)
            self.assertAlmostEqual(impact["indentation"] / depth, 1, delta=1e-9)

    def test_a_straight_curve_is_a_stiffness_to_the_bit(self):
        springs = self.impacts_of(*PHONE, "--stiffness", repr(5e4 / 0.01), "--area", "projected")
        self.assertEqual(self.impacts_of(*PHONE, "--curve", "[[0, 0], [0.01, 5e4]]"), springs)
        self.assertEqual(self.impacts_of(*PHONE, "--curve", "[[0.01, 5e4], [0.02, 1e5]]"), springs)

    def test_files_of_all_kinds_state_their_units(self):
        told = self.impacts_of(*PHONE, *PAD)
        thick = ("--thickness", str(THICKNESS))
        for text, more in (("# foam\nstrain [%],stress [kPa]\n0,0\n10,20\n60,25\n80,200\n", thick),
                           ("Strain in %,Stress in kPa\n0,0\n10,20\n60,25\n80,200\n", thick),
                           ("Strain;Stress\n%;MPa\n0;0\n10;0,02\n60;0,025\n80;0,2\n", thick),
                           ("n,stress_kPa,strain_%\n1,20,10\n2,25,60\n3,200,80\n", thick),
                           ("x,p\n10,20\n60,25\n80,200\n", (*thick, "--curve-units", "%,kPa")),
                           ("depth (mm)\tpressure (N/mm2)\n3\t0.02\n18\t0.025\n24\t0.2\n", ())):
            found = self.impacts_of(*PHONE, "--curve", self.write("pad.csv", text), *more)
            for one, other in zip(found, told):
                self.assertAlmostEqual(one["peak_force"] / other["peak_force"], 1, delta=1e-9)

    def test_a_scene_s_file_stands_beside_it_and_flags_take_its_ground_s_place(self):
        self.write("pad.csv", "strain [-],stress [Pa]\n0.1,2e4\n0.6,2.5e4\n0.8,2e5\n")
        scene = self.write("scene.toml", f"""[drop]
angle_deg = 35
height = 0.2
[body]
shape = "box"
size = [0.15, 0.075, 0.008]
mass = 0.165
[ground]
curve = "pad.csv"
thickness = {THICKNESS}
dissipation = 0.3
""")
        told = self.json_of("simulate", scene, "--impacts", "1")
        ground = told["scene"]["ground"]
        self.assertEqual((ground["curve"], ground["curve_units"]), (POINTS[1:], "1,Pa"))
        self.assertEqual((ground["thickness"], ground["dissipation"], ground["area"]), (THICKNESS, 0.3, "projected"))
        self.assertNotIn("stiffness", ground)
        self.assertEqual(told["impacts"], self.impacts_of(*PHONE, *PAD, "--dissipation", "0.3"))
        springs = self.json_of("simulate", scene, "--impacts", "1", "--stiffness", "1e7")["scene"]["ground"]
        self.assertEqual((springs["stiffness"], springs["damping"]), (1e7, 0))
        self.assertNotIn("curve", springs)
        swept = self.json_of("sweep", scene, "--model", "continuous", "--set", "run.impacts=1", "--set", "ground.thickness=0.03,0.06")
        peaks = [row["largest_peak_force"] for row in swept["rows"]]
        self.assertAlmostEqual(peaks[0] / told["impacts"][0]["peak_force"], 1, delta=1e-5)
        self.assertAlmostEqual(peaks[1] / self.impacts_of(scene, "--thickness", "0.06")[0]["peak_force"], 1, delta=1e-5)

    def test_beyond_its_last_point_it_bottoms_out_and_says_so(self):
        soft, hard = (self.json_of("simulate", *BOX, *PAD, "--angle", "0", "--speed", "9", "--impacts", "1", *more)
                      for more in ((), ("--under", "1e10")))
        warned = " ".join(self.json_of("simulate", *BOX, *PAD, "--angle", "0", "--speed", "1", "--impacts", "1").get("warnings", []))
        self.assertNotIn("beyond", warned)
        for told, words in ((soft, "its last slope"), (hard, "ground.under")):
            self.assertIn("beyond the last point", " ".join(told["warnings"]))
            self.assertIn(words, " ".join(told["warnings"]))
        depth = hard["impacts"][0]["indentation"] - 0.8 * THICKNESS
        self.assertAlmostEqual(hard["impacts"][0]["peak_force"] / (0.02 * (2e5 + 1e10 * depth)), 1, delta=1e-5)
        through = self.json_of("simulate", *BOX, *PAD, "--angle", "0", "--speed", "14", "--impacts", "1")
        self.assertIn("further than it is thick", " ".join(through["warnings"]))

    def test_a_floor_under_it_makes_of_what_is_left_of_it_a_layer_as_stiff_as_floor_and_body(self):
        """E*/h, of steel under abs the geometric mean of the E* of both ends of the sources' ranges."""
        both = [1 / ((1 - poisson ** 2) / modulus + (1 - 0.35 ** 2) / 2.4e9) for modulus, poisson in ((200e9, 0.288), (205e9, 0.33))]
        under = (both[0] * both[1]) ** 0.5 / (0.2 * THICKNESS)
        flat = (*BOX, *PAD, "--angle", "0", "--speed", "9", "--impacts", "1")
        told = self.json_of("simulate", *flat, "--floor", "steel")
        depth = told["impacts"][0]["indentation"] - 0.8 * THICKNESS
        self.assertAlmostEqual(told["impacts"][0]["peak_force"] / (0.02 * (2e5 + under * depth)), 1, delta=1e-5)
        self.assertAlmostEqual(told["impacts"][0]["peak_force"] / self.json_of("simulate", *flat, "--under", repr(under))["impacts"][0]["peak_force"],
                               1, delta=1e-5)
        self.assertIn("rest on ground.floor", " ".join(told["warnings"]))
        self.assertEqual((told["scene"]["ground"]["floor"], told["scene"]["ground"]["thickness"]), ("steel", THICKNESS))
        scene = self.write("scene.toml", "[drop]\nangle_deg = 0\nspeed = 9\n[body]\nshape = 'box'\nsize = [0.2, 0.1, 0.04]\nmass = 0.7\n[world]\n"
                           "gravity = 9.81\n[ground]\nfloor = 'steel'\n[run]\nimpacts = 1\n")
        self.assertEqual(self.json_of("simulate", scene, *PAD)["impacts"], told["impacts"])
        harder = self.json_of("simulate", *flat, "--floor", "steel", "--body-material", "glass")["impacts"][0]
        self.assertGreater(harder["peak_force"], told["impacts"][0]["peak_force"])

    def test_one_thicker_than_the_body_is_large_is_doubted(self):
        for thickness, doubts in (("0.03", 0), ("30", 1)):
            told = self.run_program("simulate", *BOX, "--curve", "[[0, 0], [0.5, 2e4]]", "--thickness", thickness, "--angle", "0", "--impacts", "1")
            self.assertEqual(told.stderr.count("were mm meant"), doubts)

    def test_dissipation_gives_both_models_one_restitution(self):
        damped = (*BOX[:-2], *PAD, "--angle", "0", "--speed", "0.8", "--dissipation", "1.2")
        told = self.json_of("compare", *damped, "--impacts", "1")
        self.assertTrue(told["agrees"])

    def test_the_limit_of_an_ever_harder_pad_is_the_discrete_model(self):
        self.assertTrue(self.json_of("compare", *PHONE, *PAD, "--sliding-friction", "0.2", "--impacts", "1")["agrees"])

    def test_what_is_no_curve_is_refused_in_a_line(self):
        thick = ("--thickness", str(THICKNESS))
        for words, curve, more in (
                ("does not fall", "[[0, 0], [0.1, 2e4], [0.2, 1e4]]", thick), ("at least two points", "[[0.1, 2e4]]", thick),
                ("finite", "[[0, 0], [nan, 2e4]]", thick), ("rises", "[[0, 0], [0.2, 2e4], [0.1, 3e4]]", thick),
                ("begins at 0, 0", "[[0, 1], [0.1, 2e4]]", thick), ("rises from the first", "[[0, 0], [0.1, 0], [0.2, 1e4]]", thick),
                ("in per cent", "[[0, 0], [10, 2e4]]", thick), ("two or more points", "[0, 0, 1]", thick),
                ("--thickness: required", "[[0, 0], [10, 20]]", ("--curve-units", "%,kPa")),
                ("two units", "[[0, 0], [10, 20]]", (*thick, "--curve-units", "kPa,%")),
                ("up to ground.thickness", "[[0, 0], [40, 20]]", (*thick, "--curve-units", "mm,kPa")),
                ("give one of them, not both", "[[0, 0], [0.1, 2e4]]", (*thick, "--stiffness", "1e7")),
                ("give one of them, not both", "[[0, 0], [0.1, 2e4]]", (*thick, "--ground-modulus", "1e9")),
                ("give one of them, not both", "[[0, 0], [0.1, 2e4]]", (*thick, "--floor", "steel", "--under", "1e9")),
                ("beyond its curve", "[[0, 0], [0.01, 2e4]]", ("--floor", "steel")),
                ("a floor", "[[0, 0], [0.1, 2e4]]", (*thick, "--body-material", "abs")),
                ("--under", "[[0, 0], [0.1, 2e4]]", (*thick, "--under", "0"))):
            self.refused(words, "simulate", *PHONE, "--curve", curve, *more)
        for words, text in (("a unit of pressure", "strain,stress\n0,0\n1,2\n"), (":4:1: must be", "strain [%],stress [kPa]\n0,0\n1,2\n2,1\n"),
                            ("no rows", "strain [%],stress [kPa]\n1,2\n"), ("finite number", "strain [%],stress [kPa]\n0,0\n1,2\n2,x\n")):
            self.refused(words, "simulate", *PHONE, "--curve", self.write("bad.csv", text), *thick)
        both = self.write("both.toml", "[drop]\nangle_deg = 9\n[ground]\nstiffness = 1e7\ncurve = [[0, 0], [0.1, 2e4]]\n")
        self.refused("both.toml:5:9: ground.curve = [[0, 0], [0.1, 20000]]: excludes ground.stiffness", "simulate", both)
        self.refused("cannot be read", "simulate", *PHONE, "--curve", self.path("none.csv"), *thick)
        self.refused("give one of them, not both", "simulate", *PHONE, "--stiffness", "1e7", "--under", "1e9")
        self.refused("only for a pad", "simulate", *PHONE, "--under", "1e9")


if __name__ == "__main__":
    unittest.main()
