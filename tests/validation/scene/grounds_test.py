# SPDX-License-Identifier: GPL-3.0-or-later
"""Grounds that are no springs: floors and bodies by name, an elastic half-space, a pad by its curve; their keys, files and
units, which commands take them, what these find, and what is refused."""

import json
import math

import numpy as np
from run_folder import EmptyFolder, Folder, json_of, printed

SHAPE = ["--body", "box", "--size", "0.15x0.075x0.008", "--mass", "0.165"]
FLAT = [*SHAPE, "--angle", "0", "--speed", "2", "--impacts", "1"]
CORNER = [*SHAPE, "--height", "1", "--angle", "35", "--tilt", "20", "--impacts", "1"]
SLAB = [*SHAPE, "--height", "1", "--angle", "35", "--ground-modulus", "1e9", "--dissipation", "0.1"]
PHONE = [*SHAPE, "--height", "0.2", "--angle", "35"]
BOX = ["--body", "box", "--size", "0.2x0.1x0.04", "--mass", "0.7", "--gravity", "9.81"]
POINTS = [[0, 0], [0.1, 2e4], [0.6, 2.5e4], [0.8, 2e5]]
THICKNESS = 0.03
PAD = ["--curve", json.dumps(POINTS), "--thickness", str(THICKNESS)]
# Young's modulus [Pa] and Poisson's ratio, least and largest, as the sources that `clatter shock --ground` names have them.
CONCRETE, ABS = ((10e9, 0.15), (23e9, 0.33)), (2.4e9, 0.35)
STEEL_BODY = (212e9, 0.293)


def file_of(ground, height=1, drop=""):
    return (f"[drop]\nangle_deg = 35\nheight = {height}\n{drop}[body]\nshape = 'box'\nsize = [0.15, 0.075, 0.008]\nmass = 0.165\n"
            f"[ground]\n{ground}\n")


def plane(modulus, poisson):
    return modulus / (1 - poisson ** 2)


def together(one, other):
    return 1 / (1 / one + 1 / other)


def concrete_under(body):
    ends = [together(plane(*floor), plane(*body)) for floor in CONCRETE]
    return ends[0], math.sqrt(ends[0] * ends[1]), ends[1]


class Floors(Folder):
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
        scene = self.write("floor.toml", file_of("floor = 'concrete'\n[run]\nimpacts = 1", drop="tilt_deg = 20\n"))
        swept = json_of("sweep", scene, "--model", "continuous", "--set", "ground.dissipation=0,0.2")
        self.assertAlmostEqual(swept["rows"][0]["first_peak_force"] / told["impacts"][0]["peak_force"], 1, delta=1e-5)
        printed("report", scene, "--probe", "camera:0.06,0.03,0", "--output", self.path("page.html"))
        self.assertIn("concrete under abs", self.read("page.html"))

    def test_the_body_s_material_or_modulus_goes_beside_the_floor_s_or_the_ground_s(self):
        def value_of(*flags):
            return json_of("simulate", *FLAT, *flags)["scene"]["ground"]["reduced_modulus"]["value"]
        self.assertAlmostEqual(value_of("--floor", "concrete", "--body-material", "steel") / concrete_under(STEEL_BODY)[1], 1, delta=1e-14)
        self.assertAlmostEqual(value_of("--ground-modulus", "3e10", "--body-modulus", "3e9") / together(3e10, 3e9), 1, delta=1e-14)
        self.assertAlmostEqual(value_of("--ground-modulus", "3e10", "--body-material", "abs") / together(3e10, plane(*ABS)), 1, delta=1e-14)
        low, middle, high = (value_of("--floor", floor) for floor in ("wood", "asphalt", "steel"))
        self.assertTrue(low < middle < high < plane(*ABS))

    def test_a_restitution_of_the_first_impact_is_that_of_a_flat_landing_on_each_kind_of_ground(self):
        for ground in (("--floor", "concrete"), ("--stiffness", "1e9"), ("--curve", "[[0, 0], [0.1, 1e5], [0.6, 1e6]]", "--thickness", "0.01")):
            impact = json_of("simulate", *FLAT, *ground, "--floor-restitution", "0.4", "--digits", "8")["impacts"][0]
            self.assertAlmostEqual(impact["velocity_after"][2] / 2, 0.4, delta=1e-6, msg=ground)

    def test_ground_prints_what_a_scene_and_flags_take(self):
        shown = json_of("shock", "--ground", "--floor", "concrete")
        self.assertEqual(len(shown["solutions"]), 3)
        for row, value in zip(shown["solutions"], concrete_under(ABS)):
            self.assertAlmostEqual(row["reduced_modulus"] / value, 1, delta=1e-14)
        for ground in (["--floor", "concrete"], ["--ground-modulus", "1e9"], PAD):
            block, flags = printed("shock", "--ground", *FLAT, *ground, "--measured-e", "0.4").split("or as flags:")
            self.assertIn("dissipation = ", block.split("[ground]\n")[1])
            after = json_of("simulate", *FLAT, *(PAD if ground == PAD else []), *flags.split())["impacts"][0]["velocity_after"]
            self.assertAlmostEqual(after[2] / 2, 0.4, delta=1e-5)
        found = printed("shock", "--ground", *FLAT, "--measured-e", "0.5", "--contact-time", "5e-4")
        self.assertIn("--stiffness", found.split("or as flags:")[1])

    def test_what_cannot_be_is_refused_in_a_line(self):
        one = "give one of them, not both"
        self.each_refused({
            "--floor stell": "did you mean steel", "--floor tile": "must be one of concrete, steel, asphalt, wood\n", "--floor wood --stiffness 1e9": one, "--floor wood --ground-modulus 1e9": one,
            "--floor wood --body-modulus 1e9 --body-material abs": one, "--body-material abs": "only for a ground with a modulus or a floor",
            "--floor concrete --floor-restitution 0.4 --dissipation 1": "not both",
            "--floor concrete --floor-restitution 0": "greater than 0"}, "simulate", *FLAT)
        self.refused("no first impact", "simulate", *FLAT[:-4], "--gravity", "9.81", "--start", "rest", "--floor", "wood", "--floor-restitution", "0.4")
        self.refused("it is what is sought", "shock", "--ground", *FLAT, "--floor", "wood", "--dissipation", "1", "--measured-e", "0.5")


class HalfSpace(Folder):
    def test_file_and_flags_say_the_same_and_the_echo_has_no_springs(self):
        file = self.write("floor.toml", file_of("modulus = 1e9\ndissipation = 0.1"))
        by_flags, by_file = self.json_of("simulate", *SLAB), self.json_of("simulate", file)
        self.assertEqual(by_file["impacts"], by_flags["impacts"])
        ground = by_flags["scene"]["ground"]
        self.assertEqual((ground["modulus"], ground["dissipation"], {"stiffness", "damping", "area"} & set(ground)), (1e9, 0.1, set()))
        springs = self.json_of("simulate", file, "--stiffness", "1e10")["scene"]["ground"]
        self.assertEqual((springs["damping"], "modulus" in springs), (0, False))

    def test_springs_beside_it_and_dissipation_without_it_are_refused(self):
        self.each_refused(dict.fromkeys(("--stiffness 1e9", "--damping 1e6", "--area projected"), "give one of them, not both"), "simulate", *SLAB)
        self.each_refused({"sequence --angle 10 --dissipation 1": "only for a ground with a modulus",
                           "simulate --angle 10 --dissipation 1": "ground.modulus of an elastic half-space",
                           f"shock --ground {' '.join(SLAB)} --measured-e 0.5 --contact-time 3e-4": "it is what is sought"})

    def test_a_ball_s_peak_goes_like_the_modulus_to_two_fifths(self):
        ball = ("--body", "sphere", "--radius", "0.02", "--mass", "0.2", "--speed", "2", "--ground-modulus", "5e9")
        row = self.json_of("shock", *ball, "--probe", "middle:0,0,0")["impacts"][0]
        self.assertAlmostEqual(row["sensitivity"], 0.4, delta=1e-3)


class Pad(Folder):
    def json_of(self, *arguments):
        return super().json_of(*arguments, status=(0,))

    def impacts_of(self, *arguments):
        return self.json_of("simulate", *arguments, "--impacts", "1")["impacts"]

    def test_a_flat_drop_is_pressed_as_the_curve_says_where_it_is_deepest(self):
        for speed in ("0.3", "1", "1.6"):
            impact = self.impacts_of(*BOX, *PAD, "--angle", "0", "--speed", speed, "--digits", "9")[0]
            pressure = np.interp(impact["indentation"] / THICKNESS, *zip(*POINTS))
            self.assertAlmostEqual(impact["peak_force"] / (0.02 * pressure), 1, delta=1e-9)

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
        scene = self.write("scene.toml", file_of(f"curve = 'pad.csv'\nthickness = {THICKNESS}\ndissipation = 0.3", height=0.2))
        told = self.json_of("simulate", scene, "--impacts", "1")
        ground = told["scene"]["ground"]
        self.assertEqual((ground["curve"], ground["curve_units"]), (POINTS[1:], "1,Pa"))
        self.assertEqual((ground["thickness"], ground["dissipation"], ground["area"], "stiffness" in ground), (THICKNESS, 0.3, "projected", False))
        self.assertEqual(told["impacts"], self.impacts_of(*PHONE, *PAD, "--dissipation", "0.3"))
        springs = self.json_of("simulate", scene, "--impacts", "1", "--stiffness", "1e7")["scene"]["ground"]
        self.assertEqual((springs["stiffness"], springs["damping"], "curve" in springs), (1e7, 0, False))
        swept = self.json_of("sweep", scene, "--model", "continuous", "--set", "run.impacts=1", "--set", "ground.thickness=0.03,0.06")
        peaks = [row["largest_peak_force"] for row in swept["rows"]]
        self.assertAlmostEqual(peaks[0] / told["impacts"][0]["peak_force"], 1, delta=1e-5)
        self.assertAlmostEqual(peaks[1] / self.impacts_of(scene, "--thickness", "0.06")[0]["peak_force"], 1, delta=1e-5)

    def test_beyond_its_last_point_it_bottoms_out_and_says_so(self):
        for speed, more, *words in (("1", ()), ("9", (), "beyond the last point", "its last slope"), ("14", (), "further than it is thick"),
                                    ("9", ("--under", "1e10"), "beyond the last point", "ground.under")):
            told = self.json_of("simulate", *BOX, *PAD, "--angle", "0", "--speed", speed, "--impacts", "1", *more)
            warned = " ".join(told.get("warnings", []))
            self.assertEqual(([word for word in words if word not in warned], "beyond" in warned), ([], speed != "1"), (speed, more))
        (hard,) = told["impacts"]
        self.assertAlmostEqual(hard["peak_force"] / (0.02 * (2e5 + 1e10 * (hard["indentation"] - 0.8 * THICKNESS))), 1, delta=1e-5)

    def test_a_floor_under_it_makes_of_what_is_left_of_it_a_layer_as_stiff_as_floor_and_body(self):
        """E*/h, of steel under abs the geometric mean of the E* of both ends of the sources' ranges."""
        under = math.sqrt(math.prod(together(plane(*steel), plane(*ABS)) for steel in ((200e9, 0.288), (205e9, 0.33)))) / (0.2 * THICKNESS)
        flat = (*BOX, *PAD, "--angle", "0", "--speed", "9", "--impacts", "1")
        told = self.json_of("simulate", *flat, "--floor", "steel")
        depth = told["impacts"][0]["indentation"] - 0.8 * THICKNESS
        self.assertAlmostEqual(told["impacts"][0]["peak_force"] / (0.02 * (2e5 + under * depth)), 1, delta=1e-5)
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


class Limits(EmptyFolder):
    def test_the_limit_of_ever_harder_half_spaces_and_pads_is_the_discrete_model_with_one_restitution(self):
        damped = (*BOX[:-2], *PAD, "--angle", "0", "--speed", "0.8", "--dissipation", "1.2", "--impacts", "1")
        for drop in ((*SLAB, "--impacts", "2"), (*SLAB, "--tilt", "20", "--sliding-friction", "0.2", "--impacts", "1"),
                     (*PHONE, *PAD, "--sliding-friction", "0.2", "--impacts", "1"), damped):
            self.assertTrue(json_of("compare", *drop)["agrees"], drop)
