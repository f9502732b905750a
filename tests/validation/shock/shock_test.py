# SPDX-License-Identifier: GPL-3.0-or-later
"""`clatter shock` and `clatter shock --ground` as their users meet them: probes, tables, JSON, bad input."""

import json
import math
import pathlib
import random
import re
import tempfile
import unittest

import numpy as np

from run_folder import EmptyFolder, json_of, printed, rows_of, run

PROBE = ("--probe", "camera:0.048,0.016,0.0095")
FEW = ("--impacts", "2", "--frequencies", "100:3000:4", "--no-sensitivity")
PHONE = ("phone-damped", *PROBE, *FEW)
FLAT = ("--body", "box", "--size", "0.1057x0.0439x0.0191", "--mass", "0.088", "--angle", "0", "--speed", "2")
STEEL = "--floor steel --thickness 0.1"

BAD = {
    "phone-damped --angle -30 --probe a:0,0,0": "must be from 0 to 90 degrees: end a (-x) is low; the other one is with a negative --release-angle",
    "phone-damped": "--probe: required", **{f"phone-damped --probe {probe}": "NAME:X,Y,Z" for probe in (":1,2,3", "a:1,2", "a:nan,0,0", "a:1e400,0,0", "a:1,,3")},
    "phone-damped --probe a:0,0,0 --probe a:0,0,1": "already", "rod-10 --probe a:0,0,0 --model continuos": "continuous",
    **{f"phone-damped --probe a:0,0,0 {options}": words for options, words in {
        "--quality 0.5": "--quality", "--frequencies 10:5:3": "--frequencies", "--frequencies 10:20:1": "--frequencies", "--axis w": "--axis",
        "--severity 0": "--severity", "--rows spectra": "did you mean spectrum", "--history x.csv": "--history", "--part 200:": "--part", "--part 40ms:11g": "must be HZ:G", "--part x": "must be HZ:G",
        "--part 0:100": "--part", "--part 200:300 --part 200:300g": "given twice", "--part 200:300 --part x": "must be HZ:G", "--part 200:nan": "--part", "--model discrete --rows pulse": "--rows pulse", "--model discrete --rate 1e5": "--rate",
        "--rate 1e5 --rows pulse": "--rate", "--rate 0": "--rate"}.items()}}
BAD_FILES = (  # text, place, words
    ("[probe]\nname = 'a'\n", "1:", "[[probe]]"), ("[[probe]]\nname = 'a'\nplce = [1, 2, 3]\n", "3:1", "probe.place"),
    ("[[probe]]\nname = 'a'\n", "", "probe.0.place"), ("[[probe]]\nname = 'a'\nplace = [1, 2]\n", "3:", "three coordinates"),
    ("[[probe]]\nname = 'a b'\nplace = [1, 2, 3]\n", "2:", "letters"),
    ("[[probe]]\nname = 'a'\nplace = [1, 2, 3]\n[[probe]]\nname = 'a'\nplace = [1, 2, 3]\n", "5:", "another name"),
    ("[[probe]]\n[[probe]]\nname = 'a'\nplace = [1, 2, 3]\n", "1:", "name and place"))
BAD_GROUND = {
    **{f"{' '.join(FLAT)} {options}": words for options, words in {
        "--measured-e 0.5": "--measured-e 0.5: needs a second number", "--contact-time 1e-3": "--measured-e E", "--measured-e 0.5 --contact-time 1e-3 --peak-force 9": "two of", "--measured-e 1.5 --contact-time 1e-3": "--measured-e",
        "--measured-e 0.5 --contact-time 0": "--contact-time", "--stiffness 1e9 --measured-e 0.5 --contact-time 1e-3": "--stiffness",
        "--peak-force 5 --floor steel": "needs a second number",
        **{f"{STEEL} {other} 0.5": "--measured-e alone" for other in ("--contact-time", "--peak-force", "--indentation")}}.items()},
    "--modulus 1e6": "--poisson", "--floor lava --footprint 1e-3": "--floor",
    "--floor steel --modulus 1e6 --footprint 1": "--floor", "--thickness 1": "--modulus",
    "--modulus 1e6 --poisson 0.3 --thickness 1 --footprint 1": "--modulus"}


def shock(*arguments):
    return json_of("shock", *arguments)


class Shock(EmptyFolder):
    def test_one_command_prints_what_a_camera_near_a_corner_sees(self):
        found = shock("phone-damped", "--impacts", "2", *PROBE)
        first = found["impacts"][0]
        self.assertEqual([row["n"] for row in found["impacts"]], [1, 2])
        self.assertAlmostEqual(first["peak_g"] * 9.80665, first["peak"], delta=1e-9 * first["peak"])
        for row in found["impacts"]:
            size = math.hypot(row["delta_v_x"], row["delta_v_y"], row["delta_v_z"])
            self.assertAlmostEqual(size, row["delta_v"], delta=1e-12)
            self.assertLess(row["closure"], 1e-6)
            self.assertLess(abs(row["sensitivity"] - 0.4), 0.3)
        blows = {(one["model"], one["blows"]) for one in found["spectra"]}
        self.assertLessEqual({("continuous", "1"), ("continuous", "1-2"), ("continuous", "flat")}, blows)
        self.assertIn("oscillator of", printed("shock", "phone-damped", "--impacts", "2", *PROBE))

    def test_probes_of_a_file_are_those_of_flags(self):
        path = self.write("scene.toml", "[drop]\nangle_deg = 10\n[[probe]]\nname = 'tip'\nplace = [-0.5, 0, 0]\n")
        of_file = shock(path, "--frequencies", "10:100:2")
        of_flag = shock("--angle", "10", "--probe", "tip:-0.5,0,0", "--frequencies", "10:100:2")
        self.assertEqual(of_file["impacts"], of_flag["impacts"])
        self.assertEqual(of_file["scene"]["probe"], [{"name": "tip", "place": [-0.5, 0, 0]}])
        other = shock(path, "--probe", "middle:0,0,0", "--frequencies", "10:100:2")
        self.assertEqual([one["name"] for one in other["scene"]["probe"]], ["middle"])
        self.assertEqual(run("sequence", path).returncode, 0)

    def test_the_centre_of_mass_is_where_the_scene_puts_it(self):
        box = ("--body", "box", "--size", "0.1x0.06x0.02", "--mass", "0.2", "--orientation", "20", "--impacts", "1", "--centre", "0.01,0.005,-0.002")
        row = shock(*box, "--probe", "c:0.01,0.005,-0.002", "--frequencies", "10:20:2")["impacts"][0]
        impact = json_of("sequence", *box)["impacts"][0]
        self.assertAlmostEqual(row["discrete_delta_v_z"], impact["impulse_normal"] / 0.2, delta=1e-13)

    def test_spectrum_rows_are_those_of_json(self):
        self.assertEqual([(row["model"], row["blows"], float(row["pseudo_velocity"])) for row in rows_of("shock", *PHONE, "--rows", "spectrum")],
                         [(one["model"], one["blows"], point["pseudo_velocity"]["maximax"]) for one in shock(*PHONE)["spectra"]
                          for point in one["points"]])
        table = printed("shock", *PHONE, "--rows", "spectrum")
        self.assertLessEqual(max(len(line) for line in table.splitlines()), 80)

    def test_each_spectrum_is_listed_once_whichever_impacts_are_the_first_ones(self):
        for first in ("1", "2", "9"):
            rows = rows_of("shock", *PHONE, "--first", first, "--rows", "spectrum")
            for model in ("continuous", "discrete"):
                blows = [row["blows"] for row in rows if row["model"] == model and row["frequency"] == rows[0]["frequency"]]
                self.assertEqual([one for one in blows if one != "flat"], ["1", "1-2"])

    def test_blows_that_compare_says_are_others_do_not_stand_beside_each_other(self):
        # A soft floor: the second corner comes down before the first has left.
        scene = ("phone-elastic", "--angle", "5", "--stiffness", "1e6", "--impacts", "3")
        parted = (*scene, *PROBE, "--frequencies", "100:200:2", "--no-sensitivity")
        reason, found = json_of("compare", *scene)["impacts"][0]["reason"], shock(*parted)
        self.assertIn("before the first contact has ended", reason)
        self.assertEqual((found["parted"]["from"], found["parted"]["reason"]), (1, reason))
        for row in found["impacts"]:
            self.assertIsNotNone(row["delta_v"])
            self.assertIsNone(row["discrete_delta_v"])
        bound = "whatever the time between them"  # of the discrete model's first two blows, which are others here
        self.assertNotIn(bound, " ".join(printed("shock", *parted).split()))
        self.assertIn(bound, " ".join(printed("shock", *PHONE).split()))
        same = shock(*PHONE)
        self.assertNotIn("parted", same)
        self.assertTrue(all(row["discrete_delta_v"] for row in same["impacts"]))

    def test_a_severity_is_told_where_it_is_exceeded(self):
        self.assertIn("above the severity of 0.01 m/s", printed("shock", *PHONE, "--severity", "0.01"))
        self.assertIn("nowhere above", printed("shock", *PHONE, "--severity", "1e6"))

    def test_bad_input_is_one_line(self):
        self.each_refused(BAD, "shock")
        self.each_refused(BAD_GROUND, "ground")
        for text, place, words in BAD_FILES:
            with self.subTest(text):
                self.write("scene.toml", text)
                self.assertIn(f"scene.toml:{place}" if place else "scene.toml", self.refused(words, "shock", "scene.toml", "--angle", "10"))


def largest_response(times, accelerations, omega):
    """Largest |ω² z| of z̈ + ω² z = −s over all axes, by Duhamel's integral with trapezoids and, after the blow, in closed form."""
    steps = np.diff(times)[:, None]

    def integral(values):
        return np.vstack([np.zeros((1, 3)), np.cumsum((values[1:] + values[:-1]) / 2 * steps, axis=0)])

    cosine, sine = np.cos(omega * times)[:, None], np.sin(omega * times)[:, None]
    a, b = integral(cosine * accelerations), integral(sine * accelerations)
    during = np.linalg.norm(sine * a - cosine * b, axis=1).max()
    a, b = a[-1], b[-1]  # rings on along an ellipse, whose longer axis counts
    return omega * max(during, math.sqrt((a @ a + b @ b) / 2 + math.hypot((a @ a - b @ b) / 2, a @ b)))


class Parts(unittest.TestCase):
    PAD = ("--body", "box", "--size", "0.1x0.05x0.01", "--mass", "0.1", "--clearance", "1", "--curve", "[[0, 0], [0.1, 2e4], [0.6, 2.5e4], [0.8, 2e5]]",
           "--thickness", "0.03", "--probe", "camera:0.048,0.016,0.0045", "--no-sensitivity", "--frequencies", "100:3000:2")

    def test_no_margin_is_better_than_that_of_the_exact_oscillator(self):
        """Undamped drops on a pad, whose first impact has often several humps: of a part with a frequency, and of one known
        by a test, whose oscillator has V_c = A_s/ω and A_c = A_s/2."""
        trapezoids, axes = 2e-3, 3**0.5  # (ω/rate)²/12 and the first instants; peaks of the axes that are not at one time
        draw, rings_more = random.Random(7), 0
        for _ in range(24):
            turned = ("--angle", repr(draw.uniform(0, 90)), "--tilt", repr(draw.uniform(0, 20)))
            found = shock(*self.PAD, *turned, "--impacts", "1", "--part", "100:100", "--part", "40g:2.5ms", "--rate", "1e5")
            impact, history = found["impacts"][0], found["history"]
            inside = [row for row in history if not row["mark"] and row["time"] <= impact["duration"]]
            times = np.array([row["time"] for row in inside])
            felt = np.array([[row[f"camera_{axis}"] for axis in "xyz"] for row in inside])
            for blow, frequency, bears in zip(found["pulses"]["blows"], (100, 200), (100, 80), strict=True):
                exact = bears * 9.80665 / largest_response(times, felt, 2 * math.pi * frequency)
                self.assertLessEqual(blow["margin_history"] - blow["error_estimate"]["margin_history"], exact * (1 + trapezoids))
                self.assertGreaterEqual(blow["margin_history"], exact / axes)
                rings_more += exact < 0.98 * min(blow["margin_rectangle"], blow["margin_half_sine"])
        self.assertGreater(rings_more, 10, "some ring more than by one pulse")

    def test_notes_say_up_to_how_long_a_pulse_the_change_of_velocity_decides(self):
        """Below the corner of a boundary: f T = 1/2 of a rectangle, of a half sine where its response is largest."""
        table = " ".join(printed("shock", *PHONE, "--part", "500:300", "--rows", "pulse").split())
        self.assertEqual([float(number) for number in re.findall(r"alone decides up to (\S+) ms", table)], [1, round(0.809936785 / 0.5, 2)])
        self.assertIn("covers |ΔV| and peak, - beyond all", table)

    def test_several_parts_have_a_row_each_and_one_prints_what_it_prints_alone(self):
        parts = ("300:500", "300g", "900g:0.7ms")
        together = shock(*PHONE, *(word for part in parts for word in ("--part", part)))["pulses"]
        self.assertEqual([boundary["part"] for boundary in together["damage_boundaries"]], list(parts))
        margins = {}
        for part in parts:
            alone = shock(*PHONE, "--part", part)["pulses"]
            self.assertEqual(alone["blows"], [blow for blow in together["blows"] if blow["part"] == part])
            margins[part] = min(blow[name] for blow in alone["blows"] for name in blow if name.startswith("margin") and blow[name] is not None)
        self.assertRegex(together["message"], rf": {min(margins, key=margins.get)} at camera fails, margin \S+ in impact 2")
        rows = rows_of("shock", *PHONE, "--rows", "pulse", "--part", "300:500", "--part", "300g")
        self.assertEqual([row["part"] for row in rows], ["300:500", "300g"] * 2)
        self.assertNotIn("  part", printed("shock", *PHONE, "--rows", "pulse", "--part", "300:500"))

    def test_blows_as_test_pulses_are_those_of_the_impacts(self):
        found = shock(*PHONE, "--rows", "pulse", "--part", "300:500")
        self.assertEqual([(blow["delta_v"], blow["peak_g"]) for blow in found["pulses"]["blows"]],
                         [(impact["delta_v"], impact["peak_g"]) for impact in found["impacts"]])

    def test_a_history_at_a_rate_has_the_impulse_the_peaks_and_the_depths_of_the_run(self):
        rows = rows_of("shock", *PHONE, "--rate", "5e5")
        for peak, impact in zip((row for row in rows if row["mark"] == "peak of camera"), shock(*PHONE)["impacts"], strict=True):
            self.assertAlmostEqual(float(peak["camera"]) / impact["peak"], 1, delta=1e-6)
            for axis in "xyz":
                self.assertAlmostEqual(float(peak[f"camera_{axis}"]), impact[f"peak_{axis}"], delta=1e-6 * impact["peak"])
        uniform = [row for row in rows if not row["mark"]]
        for impact in json_of("simulate", "phone-damped", "--impacts", "2")["impacts"]:
            forces = [float(row["force_z"]) for row in uniform if int(row["impact"]) == impact["n"]]
            self.assertAlmostEqual(sum(forces) / 5e5 / impact["impulse"][2], 1, delta=1e-5)
            self.assertAlmostEqual(max(forces) / impact["peak_force"], 1, delta=1e-4)
        # The deepest point bears (k_G + c_G δ̇) δ: neither it nor the force acts in flight.
        for row in uniform:
            if float(row["force_z"]) > 1e-6:
                self.assertGreater(float(row["pressure"]), 0, row)
                self.assertGreater(float(row["indentation"]), 0, row)
            if float(row["indentation"]) < 0:
                self.assertEqual((float(row["pressure"]), float(row["force_z"])), (0, 0), row)

    def test_a_plot_at_a_rate_is_the_history_of_each_probe_by_axis(self):
        with tempfile.TemporaryDirectory() as folder:
            printed("shock", "phone-damped", *PROBE, "--probe", "middle:0,0,0", "--impacts", "1", "--no-sensitivity", "--frequencies", "100:200:2",
                    "--rate", "1e5", "--plot", "a.svg", cwd=folder)
            with open(f"{folder}/a.svg", encoding="utf-8") as file:
                drawn = file.read()
        for words in ("camera [g]", "middle [g]", "time after the first touch-down [s]", ">x<", ">y<", ">z<"):
            self.assertIn(words, drawn)
        self.assertNotIn("natural frequency", drawn)

    def test_a_marked_row_is_the_peak_also_where_friction_jumps(self):
        # Friction that turns makes the force jump: two pieces of the history meet at one time, and the peak is that of one of them.
        phone = ("--body", "box", "--size", "0.14x0.068x0.016", "--mass", "0.25", "--clearance", "0.8", "--floor", "wood", "--floor-restitution", "0.55",
                 "--impacts", "3")
        rod = ("rod-45", "--stiffness", "1e9", "--impacts", "2", "--probe", "end:0.4,0,0")
        lens = ("--probe", "lens:0.06,0.025,0")
        scenes = [*((*phone, "--angle", str(angle), "--sliding-friction", str(friction), *lens) for angle, friction in ((25, 0.3), (40, 0.3), (40, 0.6))),
                  (*phone, "--angle", "65", "--tilt", "20", "--sliding-friction", "0.4", *lens, "--probe", "corner:0.07,0.034,0.008"),
                  (*rod, "--sliding-friction", "0.2")]
        for scene in scenes:
            with self.subTest(scene=scene):
                command = ("shock", *scene, "--no-sensitivity", "--frequencies", "100:3000:4")
                impacts = rows_of(*command)
                marked = [row for row in rows_of(*command, "--rate", "1e4") if row["mark"]]
                self.assertEqual(sorted((int(row["impact"]), row["mark"]) for row in marked),
                                 sorted((int(row["n"]), f"peak of {row['probe']}") for row in impacts))
                for impact in impacts:
                    name = impact["probe"]
                    (peak,) = (row for row in marked if row["impact"] == impact["n"] and row["mark"] == f"peak of {name}")
                    allowed = 1e-6 * float(impact["peak"])  # two polynomials through the same samples
                    self.assertAlmostEqual(float(peak[name]), float(impact["peak"]), delta=allowed)
                    for axis in "xyz":
                        self.assertAlmostEqual(float(peak[f"{name}_{axis}"]), float(impact[f"peak_{axis}"]), delta=allowed)


class Ground(unittest.TestCase):
    def test_a_material_and_e_give_a_ground_that_gives_e_back(self):
        layer = ("--modulus", "3e10", "--poisson", "0.2", "--thickness", "0.1")
        ground = json_of("shock", "--ground", *FLAT, *layer, "--measured-e", "0.5")["solutions"][0]
        self.assertAlmostEqual(ground["stiffness"], 3e10 * 0.8 / (1.2 * 0.6 * 0.1), delta=1)
        again = json_of("simulate", *FLAT, *(f"--{name}={ground[name]!r}" for name in ("stiffness", "damping")), "--impacts", "1", "--digits", "8")
        self.assertAlmostEqual(again["impacts"][0]["velocity_after"][2] / 2, 0.5, delta=1e-5)

    def test_a_pad_from_two_numbers_says_how_deep_the_drop_goes_and_gives_a_curve_of_its_stiffness(self):
        drop = ("--body", "box", "--size", "0.16x0.08x0.02", "--mass", "0.25", "--clearance", "1.2", "--angle", "0", "--area", "projected")
        measured = ("shock", "--ground", *drop, "--measured-e", "0.4", "--contact-time", "4e-3", "--thickness", "0.005")
        found = json_of(*measured)
        one = found["solutions"][0]
        # Energy: what is stored and lost on the way to the greatest depth is m v^2/2 (and m g times it); without loss k A depth^2/2.
        free = math.sqrt(0.25 * 2 * 9.81 * 1.2 / (one["stiffness"] * 0.16 * 0.08))
        self.assertTrue(0.4 * free < one["depth"] < 1.1 * free, (one["depth"], free))
        self.assertAlmostEqual(one["depth_percent"], 100 * one["depth"] / 0.005, delta=1e-9 * one["depth_percent"])
        pairs = json.loads(found["pad"]["curve"])
        self.assertAlmostEqual(pairs[-1][1] / (pairs[-1][0] * 0.005 * one["stiffness"]), 1, delta=1e-5)
        for words in ("no model beyond half", f"curve = {found['pad']['curve']}"):
            self.assertIn(words, printed(*measured))
        same = json_of("shock", "--ground", *drop, "--restitution", "0.4", "--contact-time", "4e-3")["solutions"][0]
        self.assertEqual(same["stiffness"], one["stiffness"])
        self.assertIn("its restitution, --measured-e E", run("shock", "--ground", *drop, "--contact-time", "4e-3").stderr)
        with tempfile.TemporaryDirectory() as folder:
            pad = pathlib.Path(folder, "pad.toml")
            pad.write_text("[ground]\ncurve = [[0, 0], [0.5, 1e5]]\nthickness = 0.005\n")
            self.assertIn("springs; the scene's curve does not count", printed("shock", "--ground", pad, *drop, *measured[-6:]))

    def test_a_bound_part_has_rows_at_its_probe_alone_and_other_blows_are_not_bounded(self):
        probes = ("--probe", "camera:0.05,0.02,0.004", "--probe", "crystal:-0.03,0,0")
        scene = ("phone-damped", "--impacts", "1", "--no-sensitivity", "--frequencies", "100:3000:2", *probes)
        blows = json_of("shock", *scene, "--part", "camera:300:500", "--part", "crystal:40g:11ms")["pulses"]["blows"]
        self.assertEqual([(blow["probe"], blow["part"]) for blow in blows], [("camera", "camera:300:500"), ("crystal", "crystal:40g:11ms")])
        every = json_of("shock", *scene, "--part", "300:500")
        self.assertEqual([blow["probe"] for blow in every["pulses"]["blows"]], ["camera", "crystal"])
        self.assertEqual(every["pulses"]["blows"][0]["margin_half_sine"], blows[0]["margin_half_sine"])
        self.assertIn("300:500: judged at each of camera, crystal", run("shock", *scene, "--part", "300:500").stdout)
        self.assertIn("no probe is named crysta; did you mean crystal?", run("shock", *scene, "--part", "crysta:300g").stderr)

    def test_two_numbers_of_a_drop_on_a_half_space_give_its_modulus_and_dissipation(self):
        cube = ("--body", "box", "--size", "0.06x0.06x0.06", "--mass", "0.2", "--speed", "2", "--angle", "0")
        for floor in (("--floor", "concrete", "--floor-restitution", "0.9"), ("--ground-modulus", "1e9")):
            found = json_of("shock", "--ground", *cube, *floor, "--measured-e", "1", "--contact-time", "4e-4")
            # Boussinesq's flat punch, a square taken for a disc of its area: F = 2 E* sqrt(A/pi) depth, a half-period of m on that spring.
            modulus = (math.pi / 4e-4) ** 2 * 0.2 / (2 * math.sqrt(0.06 ** 2 / math.pi))
            self.assertAlmostEqual(found["ground"]["modulus"] / modulus, 1, delta=1e-5)  # printed with six digits
            self.assertEqual(found["ground"]["dissipation"], 0)
            self.assertAlmostEqual(found["solutions"][0]["indentation"] * (math.pi / 4e-4) ** 2 / 9.80665, 1, delta=1e-8)
        damped = json_of("shock", "--ground", *cube, "--floor", "steel", "--measured-e", "0.593624260040", "--peak-force", "900")["ground"]
        self.assertAlmostEqual(damped["dissipation"] * 2, 1, delta=1e-5)  # ln[(1+s)/(1-s e)] = s (1+e) at s = 1
        again = json_of("simulate", *cube, "--ground-modulus", str(damped["modulus"]), "--dissipation", str(damped["dissipation"]), "--impacts", "1")["impacts"][0]
        self.assertAlmostEqual(again["peak_force"] / 900, 1, delta=1e-5)
        self.assertIn("sought: E* and τ of an elastic half-space, in place of steel under abs", printed("shock", "--ground", *cube, "--floor", "steel", "--measured-e", "0.6", "--peak-force", "900"))

    def test_numbers_that_no_ground_gives_are_status_3(self):
        found = run("shock", "--ground", *FLAT, "--contact-time", "5e-4", "--peak-force", "1")
        self.assertEqual(found.returncode, 3)
        self.assertIn("no ground gives both", found.stdout)

    def test_a_named_floor_has_a_range_and_its_source(self):
        found = json_of("shock", "--ground", "--floor", "concrete", "--footprint", "0.004")
        self.assertLess(found["solutions"][0]["stiffness"], found["solutions"][1]["stiffness"])
        self.assertIn("doi", found["source"])
