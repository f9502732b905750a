# SPDX-License-Identifier: GPL-3.0-or-later
"""The program as its users meet it: options, errors, exit statuses, help; and what commands of the plane print."""

import gzip
import json
import math
import os
import re
import shutil
import subprocess
import unittest
from decimal import Decimal
from pathlib import Path

from run_folder import PROGRAM, ROOT, EmptyFolder, commands, json_of, printed, records, rows_of, run

NUMBER_OPTIONS = {
    "sequence": "--angle --speed --height --tangential-velocity --spin --gravity --restitution --impulse-ratio --friction --mass "
                "--length --radius --impacts --digits",
    "angles": "--from --to --step --count --gravity-number --gravity --length --speed --restitution --impulse-ratio --digits",
    "regimes": "--gravity-number --gravity --length --speed --restitution --impulse-ratio --digits",
}
NOT_NUMBERS = ["nan", "-nan", "inf", "-inf", "1e400", "", "abc", "1x", " 1", "0x1p3", "1,0"]
OUT_OF_RANGE = {
    "-1": "--angle --speed --height --gravity --restitution --friction --mass --length --radius --impacts --digits --from --to --step "
          "--count --gravity-number",
    "0": "--speed --height --mass --length --impacts --digits --step --count", "90.0000001": "--angle", "1.0000001": "--restitution",
    "1000001": "--impacts", "18": "--digits", "91": "--from", "90.5": "--to", "1e201": "--mass", "1e309": "--length"}
REFUSED = {
    "sequence --angle 10 --angle 20": "twice", "sequence --angle": "value", "sequence --agle 10": "did you mean --angle",
    "xyzzy": "'xyzzy': unknown; clatter help lists them", "sequence --angle 10 --xyzzy 1": "--xyzzy: unknown for sequence\n",
    "sequence nope": "nope: neither a file nor a case\n", "sequence --angle 10 --body ball": "capsule\n",
    "sequnce": "did you mean sequence", "help columns --only sequnce": "did you mean sequence?", "tradeof rod-45": "did you mean plan --tradeoff?", "scene": "did you mean help scene?",
    "plan --tradeoff --tradeoff rod-45": "--tradeoff: unknown for plan --tradeoff", "plan --tradeoff=x rod-45": "--tradeoff: unknown for plan\n",
    "help keys scene": "'scene': unexpected argument for help keys", "sequence --angle 10 --format jsn": "did you mean json",
    "sequence --angle 10 --restitution-law strong": "did you mean stronge", "angles 10": "unexpected",
    "sequence 10 --angle 10": "rod-10", "sequence --angle 10 -x": "-x", "sequence --angle 10 --step 1": "--step", "sequence": "--angle: required",
    "simulate --stiffness 1e9": "--angle: required", "simulate --angle 10": "--stiffness: required", "sequence --angle 10 --body box": "--size: required",
    "sequence --angle 10 --impulse-ratio 0.1 --friction 0.1": "--friction", "sequence --angle 10 --speed 1 --height 1 --gravity 9.81": "not both",
    "sequence --angle 10 --body box --size 1x2": "--size", "sequence --angle 10 --body box --size 1x1x1 --radius 0.1": "--radius",
    "sequence --angle 10 --size 1x1x1": "--size", "sequence --angle 10 --height 1 --gravity 0": "--height",
    "sequence --angle 10 --height 1 --clearance 1": "not both", "sequence --angle 90 --height 0.4 --gravity 9.81": "drop.height = 0.4",
    "angles --gravity 1 --gravity-number 1": "--gravity", "angles --step 1 --count 3": "--step", "angles --from 50 --to 40": "--from",
    "regimes --from 1": "--from", "angles --regimes --gravity 1 --from 0 --to 1 --count 3": "--gravity-number 1: is what --from and --to vary", "sequence --angle 30 --spin 10": "does not approach", "help nothing": "nothing",
    **{f"explain '{text}' --angle 10": text for text in ("0", "-1", "1.5", "x", "nan", "")},
    # What to type in its place.
    "sequence --angle 10 --gravity-number 0.1": "takes --gravity in m/s^2, the number times v_n^2/L", "angles --height 1": "--gravity G --speed V",
    "sweep --angle 10": "as in clatter sweep rod-10 --set drop.angle_deg=...", "map --speed 2": "as in clatter map rod-10 --set drop.speed=...",
    **{f"{command} --angle 10 --{name} 1": "did you mean --clearance, of the lowest point, or --height" for command, name in (
        ("sequence", "drop"), ("sequence", "from"), ("explain 2", "drop-height"), ("simulate", "fall"))},
    "sequence phone-elastic --planar": "is the simulator's", "compare --angle 10": "such as 1e11", "angles --angle 10": "--from, --to and --step",
}
# The third flight is too long for the phase of so fast a rotation to keep a digit.
LOST = ("[drop]\nattitude = [0.9, 0.1, 0.2, 0.374165738677]\nvelocity = [0, 0, -100]\n"
        "angular_velocity = [-3e7, 2e7, 1e6]\n[world]\ngravity = 1e-3\n[body]\nshape = 'box'\nsize = [0.1, 0.08, 0.02]\n"
        "mass = 1\n[impact]\nrestitution = 0.5\n[run]\nimpacts = 3\n")


class BadInput(EmptyFolder):
    def test_every_number_option_refuses_what_is_no_finite_number_or_out_of_its_range(self):
        for command, options in NUMBER_OPTIONS.items():
            for option in options.split():
                base = [command] if command != "sequence" or option == "--angle" else [command, "--angle", "10"]
                for text in NOT_NUMBERS if option in ("--angle", "--spin", "--step") else ["nan", "1x"]:
                    self.refused(option, *base, f"{option}={text}", "--output", "out")
                for text in (text for text, of in OUT_OF_RANGE.items() if option in of.split()):
                    self.refused(option, *base, option, text, "--output", "out")

    def test_what_options_or_their_combinations_cannot_be_is_one_line(self):
        self.each_refused(REFUSED)
        self.refused("jamming", "sequence", "--angle", "63.4", "--impulse-ratio", "1.5", status=4)

    def test_rows_before_an_impact_that_jams_are_printed_with_status_4(self):
        for angle, ratio, rows in ((30, 2.5, 4), (50, 1.5, 3), (75, -2.5, 5), (85, 2.5, 1)):
            scene = ["--angle", str(angle), f"--impulse-ratio={ratio}", "--gravity", "9.81", "--restitution", "0.7"]
            done = run("sequence", *scene, "--format", "json")
            data = json.loads(done.stdout)
            self.assertEqual((done.returncode, data["outcome"], len(data["impacts"])), (4, "outside-model", rows))
            self.assertRegex(done.stderr.splitlines()[-1], "^clatter: outside-model: jamming")
            for command in (["explain", str(rows + 1)], ["gradient"]):
                self.assertEqual(run(*command, *scene).returncode, 4)

    def test_a_run_that_could_not_be_computed_ends_every_command_with_status_3(self):
        lost = self.write("lost.toml", LOST)
        stiff = ["--body", "box", "--size", "0.1x0.1x0.02", "--mass", "1", "--angle", "5", "--stiffness", "1e300"]
        probe = ["--probe", "middle:0,0,0"]
        report = ["report", "--drops", "0", "--output", self.path("page.html")] if shutil.which("gnuplot") else []
        for words in (["sequence", lost], ["gradient", lost], ["shock", lost, "--model", "discrete", *probe],
                      ["explain", "9", lost], ["sweep", lost, "--set", "impact.restitution=0.5,0.6"],
                      ["map", lost, "--over", "impact.restitution=0.4:0.6", "--over", "world.gravity=1e-3:2e-3",
                       "--size", "2x2", "--output", self.path("map.csv")],
                      ["simulate", *stiff], ["shock", *stiff, *probe], ["compare", *stiff], ["plan", *stiff],
                      ["plan", "--tradeoff", *stiff], report and [*report, *stiff], report and [*report, lost, "--model", "discrete"]):
            if words:
                done = run(*words)
                self.assertEqual((done.returncode, done.stderr.startswith("clatter: ")), (3, True), (words, done.stderr))


class Output(unittest.TestCase):
    def test_a_height_is_that_of_the_centre_of_mass_at_release_and_the_gravity_number_g_l_over_the_square_of_the_speed(self):
        impact = json_of("sequence", "--angle", "30", "--height", "2", "--gravity", "9.81")["impacts"][0]
        # It falls until the rod's end touches, L/2 sin 30° = 0.25 m below the centre.
        self.assertAlmostEqual(impact["approach_speed"], math.sqrt(2 * 9.81 * (2 - 0.25)), delta=1e-14)
        number = json_of("angles", "--gravity", "9.81", "--length", "2", "--speed", "3", "--count", "1")["parameters"]["gravity_number"]
        self.assertAlmostEqual(number, 9.81 * 2 / 9, delta=1e-15)  # three roundings

    def test_the_regimes_of_the_json_are_the_known_folds_in_degrees(self):
        given = json_of("angles", "--regimes", "--gravity", "9.81")
        self.assertEqual([row["gravity-number"] for row in given["rows"]], [9.81])
        self.assertEqual(given["rows"][0]["second"]["kind"], "order")
        first = json_of("angles", "--regimes")["rows"][0]
        self.assertEqual(first["gravity-number"], 0)
        # The values of tests/analytic/plane/regime_boundary_test.cpp, to the digits given there.
        for kind, key, angle in [("second", "theta_deg", 58.488442288312), ("second", "beta_deg", 86.701384197437),
                                 ("third", "theta_deg", 27.577809606636), ("third", "gamma_deg", 63.128123330456)]:
            self.assertAlmostEqual(first[kind][key], angle, delta=1.2e-12)

    def test_the_numbers_in_the_tex_of_an_equation_compute_to_its_value(self):
        steps = json_of("explain", "2", "--angle", "10", "--gravity", "9.81", "--friction", "0.3")["steps"]
        computed = 0
        for e in (e for step in steps for e in step["equations"]):
            if not e["numeric"]:
                continue
            self.assertEqual(e["tex"].count("&="), 3, e["tex"])
            numbers = e["tex"].split(" \\\\ &= ")[1].replace("^2", "**2").replace("^{2}", "**2").replace("\\cdot", "*")
            numbers = re.sub(r"\^\\circ", "*math.pi/180", numbers.replace("\\left", "").replace("\\right", ""))
            numbers = re.sub(r"\|([^|]*)\|", r"abs(\1)", numbers)
            numbers = re.sub(r"\\(sin|cos) ([-0-9.]+\*math.pi/180)", r"math.\1(\2)", numbers)
            numbers = re.sub(r"\\(sin|cos)\(", r"math.\1(", numbers)
            numbers = re.sub(r"\\operatorname\{sgn\}\(", "math.copysign(1, ", numbers)
            while "\\frac" in numbers:
                numbers = re.sub(r"\\frac\{([^{}]*)\}\{([^{}]*)\}", r"((\1)/(\2))", numbers)
            value = math.radians(e["value"]) if e["unit"] == "°" else e["value"]
            self.assertAlmostEqual(eval(numbers), value, delta=2e-5 * max(1, abs(value)), msg=e["tex"])
            computed += 1
        self.assertGreaterEqual(computed, 25)

    def test_the_root_that_is_explained_solves_equation_12(self):
        steps = json_of("explain", "2", "--angle", "20", "--gravity", "9.81")["steps"]
        shown = {e["name"]: e["value"] for step in steps if step["title"] == "The flight to impact 2" for e in step["equations"]}
        theta, phi = math.radians(shown["θ"]), shown["φ"]
        self.assertGreater(shown["Γ"], 0)
        # Terms of order 1, a few roundings each, and the rounding of the angle in degrees.
        for left in (math.sin(theta) + shown["K"] * phi - shown["Γ"] * phi * phi - math.sin(phi - theta), shown["f"]):
            self.assertAlmostEqual(left, 0, delta=1e-14)

    def test_the_errors_of_angles_cover_those_against_30_digit_references_and_are_small(self):
        compared = 0
        for name in ("rod_sequence_no_gravity.csv", "rod_sequence_gravity.csv"):
            for exact in records(Path(ROOT, "validation/oracles/reference", name).read_text(encoding="utf-8")):
                arguments = ["angles", "--from", exact["theta_deg"], "--count", "1", "--gravity-number", exact["G"]]
                data, record = json_of(*arguments)["rows"][0], rows_of(*arguments)[0]
                for key in ("beta_deg", "gamma_deg", "P1", "P2", "P3", "V1", "Omega1", "V2", "Omega2", "V3", "Omega3", "T1", "T2"):
                    if not exact[key] or data[key] is None:
                        continue
                    error = data["error_estimate"][key]
                    self.assertEqual((float(record[key]), float(record[key + "_error"])), (data[key], error), (exact["theta_deg"], key))
                    self.assertLessEqual(abs(Decimal(data[key]) - Decimal(exact[key])), Decimal(error), (exact["theta_deg"], exact["G"], key))
                    self.assertLess(error, 1e-6, (exact["theta_deg"], exact["G"], key))
                    compared += 1
        self.assertGreater(compared, 500)


class Manners(EmptyFolder):
    def test_help_of_a_command_is_the_same_asked_for_either_way_and_names_the_program(self):
        for words in commands():
            told = printed(*words, "--help")
            if words != ["help"]:
                self.assertIn(f"Usage: clatter {' '.join(words)} ", told)
            if words[0] != "help":
                self.assertEqual(printed("help", *words), told)
        self.assertEqual(run("help").stdout, run("--help").stdout)

    def test_help_lists_each_command_once_under_what_it_is_for_and_a_command_names_its_other_forms(self):
        sections = dict(re.findall(r"^([A-Z][a-z ]+):\n((?:  .*\n)+)", printed("--help"), re.M))
        listed = [name for words in ("One drop", "Many drops", "Shock", "Check", "Learn") for name in re.findall(r"^  (\w+) ", sections[words], re.M)]
        self.assertEqual(listed, [words[0] for words in commands() if len(words) == 1])
        for words in commands():
            if words[-1].startswith("--"):
                self.assertIn(f"\n  {words[1]} ", printed(words[0], "--help").split("In place of this:")[1], words)

    def test_old_names_of_forms_do_what_they_did_and_say_the_new_ones(self):
        for old, new in (("regimes", ["angles", "--regimes"]), ("ground", ["shock", "--ground", "--floor", "wood"]), ("keys", ["help", "keys"]),
                         ("columns", ["help", "columns"]), ("extremes", ["verify", "--extremes", "--help"]),
                         ("figures", ["verify", "--figures", "--help"]), ("tradeoff", ["plan", "--tradeoff", "--help"])):
            was, done = run(old, *new[2:]), run(*new)
            self.assertEqual((was.returncode, was.stdout, done.stderr), (0, done.stdout, ""), old)
            self.assertEqual(was.stderr, f"clatter: {old}: is {' '.join(new[:2])} now; the old name goes with the next version\n")
            self.assertEqual(run(new[0], *new[2:], new[1]).stdout if new[0] != "help" else done.stdout, done.stdout, "the form's word may stand last")

    def test_completion_scripts_parse_and_know_commands_keys_and_files(self):
        scripts = {shell: printed("completion", shell) for shell in ("bash", "zsh", "fish")}
        for shell, script in scripts.items():
            known = set(re.findall(r"[\w-]*\w", script.replace("--", " ")))
            self.assertLessEqual({"sequence", "plot-script", "attitude", "velocity", "centre", "inertia"}, known)
            if shutil.which(shell):
                check = subprocess.run([shell, "-n"], input=script, capture_output=True, text=True)
                self.assertEqual((check.returncode, check.stderr), (0, ""), shell)
        for shell, words in (("bash", r"(?m)^ +\S*--plot\S*\) COMPREPLY=\(\$\(compgen -f "), ("bash", r"(?m)^ +verify\) list=\".*--extremes .*--seconds "),
                             ("zsh", r"'--plot\[[^\]]*\]:file:_files'"), ("fish", r"-l plot -r -F "),
                             ("fish", r"__fish_seen_subcommand_from plan' -l tradeoff ")):
            self.assertRegex(scripts[shell], words)

    def test_there_is_a_manual_page_for_each_command_and_all_render_without_warnings(self):
        if not (shutil.which("groff") and shutil.which("help2man")):
            self.skipTest("no groff or no help2man here")
        subprocess.run(["sh", os.path.join(ROOT, "validation", "program", "man_pages"), PROGRAM, self.path("man")], check=True)
        names = os.listdir(self.path("man"))
        self.assertEqual(sorted(names), sorted(["clatter.1.gz"] + ["-".join(["clatter", *(word.lstrip("-") for word in words)]) + ".1.gz" for words in commands()]))
        texts = {"": printed("man")}
        self.assertEqual(texts[""].count("\n.TP\n\\&\\-\\-plot\\-script "), 12)
        for name in names:
            with gzip.open(os.path.join(self.path("man"), name), "rt") as file:
                texts[name] = file.read()
            self.assertTrue(re.search(rf'^\.TH {name[:-5].upper()} "1" "\d+-\d+-\d+" ', texts[name], re.M), name)
        for name, text in texts.items():
            page = subprocess.run(["groff", "-man", "-ww", "-Tascii"], input=text, capture_output=True, text=True)
            self.assertEqual((page.returncode, page.stderr), (0, ""), name)
