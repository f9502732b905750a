# SPDX-License-Identifier: GPL-3.0-or-later
"""The program as its users meet it: options, errors, formats, files, exit statuses."""

import csv
import gzip
import io
import json
import math
import os
import re
import shutil
import signal
import subprocess
import tempfile
import unittest
from decimal import Decimal

from run_folder import PROGRAM, ROOT, run
from waiting import sizes, until


NUMBER_OPTIONS = {
    "sequence": ["--angle", "--speed", "--height", "--tangential-velocity", "--spin", "--gravity",
                 "--restitution", "--impulse-ratio", "--friction", "--mass", "--length", "--radius",
                 "--impacts", "--digits"],
    "angles": ["--from", "--to", "--step", "--count", "--gravity-number", "--gravity", "--length",
               "--speed", "--restitution", "--impulse-ratio", "--digits"],
    "regimes": ["--gravity-number", "--gravity", "--length", "--speed", "--restitution",
                "--impulse-ratio", "--digits"],
}
NOT_NUMBERS = ["nan", "-nan", "inf", "-inf", "1e400", "", "abc", "1x", " 1", "0x1p3", "1,0"]
NEGATIVE_REFUSED = {"--angle", "--speed", "--height", "--gravity", "--restitution", "--friction", "--mass",
                    "--length", "--radius", "--impacts", "--digits", "--from", "--to", "--step", "--count",
                    "--gravity-number"}
ZERO_REFUSED = {"--speed", "--height", "--mass", "--length", "--impacts", "--digits", "--step", "--count"}
TOO_LARGE = {"--angle": "90.0000001", "--restitution": "1.0000001", "--impacts": "1000001", "--digits": "18",
             "--from": "91", "--to": "90.5", "--mass": "1e201", "--length": "1e309"}


class BadInput(unittest.TestCase):
    def refuse(self, *arguments, status=2):
        with tempfile.TemporaryDirectory() as folder:
            target = os.path.join(folder, "out")
            result = run(*arguments, "--output", target) if arguments and "--output" not in arguments else run(*arguments)
            self.assertEqual(result.returncode, status, (arguments, result.stderr))
            self.assertEqual(result.stdout, "", arguments)
            self.assertEqual(result.stderr.count("\n"), 1, (arguments, result.stderr))
            self.assertEqual(os.listdir(folder), [], arguments)
        return result.stderr

    def base(self, command, option):
        return ["--angle", "10"] if command == "sequence" and option != "--angle" else []

    def test_every_number_option_refuses_what_is_no_finite_number(self):
        for command, options in NUMBER_OPTIONS.items():
            for option in options:
                for text in NOT_NUMBERS:
                    message = self.refuse(command, *self.base(command, option), option, text)
                    self.assertIn(option, message)

    def test_every_number_option_refuses_what_is_out_of_its_range(self):
        for command, options in NUMBER_OPTIONS.items():
            for option in options:
                base = self.base(command, option)
                if option in NEGATIVE_REFUSED:
                    self.refuse(command, *base, option, "-1")
                if option in ZERO_REFUSED:
                    self.refuse(command, *base, option, "0")
                if option in TOO_LARGE:
                    self.refuse(command, *base, option, TOO_LARGE[option])

    def test_options_given_twice_without_value_or_unknown_are_refused(self):
        self.assertIn("twice", self.refuse("sequence", "--angle", "10", "--angle", "20"))
        self.assertIn("value", self.refuse("sequence", "--angle"))
        self.assertIn("did you mean --angle", self.refuse("sequence", "--agle", "10"))
        self.assertIn("did you mean sequence", self.refuse("sequnce"))
        self.assertIn("did you mean json", self.refuse("sequence", "--angle", "10", "--format", "jsn"))
        self.assertIn("did you mean stronge", self.refuse("sequence", "--angle", "10", "--restitution-law", "strong"))
        self.assertIn("unexpected", self.refuse("angles", "10"))
        self.assertIn("rod-10", self.refuse("sequence", "10", "--angle", "10"))
        self.refuse("sequence", "--angle", "10", "-x")
        self.refuse("sequence", "--angle", "10", "--step", "1")
        self.refuse("sequence")

    def test_options_that_exclude_each_other_are_refused(self):
        self.refuse("sequence", "--angle", "10", "--impulse-ratio", "0.1", "--friction", "0.1")
        self.refuse("sequence", "--angle", "10", "--speed", "1", "--height", "1", "--gravity", "9.81")
        self.refuse("sequence", "--angle", "10", "--body", "box")
        self.refuse("sequence", "--angle", "10", "--body", "box", "--size", "1x2")
        self.refuse("sequence", "--angle", "10", "--body", "box", "--size", "1x1x1", "--radius", "0.1")
        self.refuse("sequence", "--angle", "10", "--size", "1x1x1")
        self.refuse("sequence", "--angle", "10", "--height", "1", "--gravity", "0")
        self.refuse("sequence", "--angle", "10", "--height", "1", "--clearance", "1")
        self.refuse("sequence", "--angle", "90", "--height", "0.4", "--gravity", "9.81")
        self.refuse("angles", "--gravity", "1", "--gravity-number", "1")
        self.refuse("angles", "--step", "1", "--count", "3")
        self.refuse("angles", "--from", "50", "--to", "40")
        self.refuse("regimes", "--from", "1")

    def test_explain_wants_a_positive_whole_number(self):
        for text in ["0", "-1", "1.5", "x", "nan", ""]:
            self.refuse("explain", text, "--angle", "10")

    def test_a_first_contact_that_recedes_is_bad_input(self):
        self.refuse("sequence", "--angle", "30", "--spin", "10")

    def test_jamming_is_refused_by_name_with_status_4(self):
        self.assertIn("jamming", self.refuse("sequence", "--angle", "63.4", "--impulse-ratio", "1.5", status=4))

    def test_rows_before_an_impact_that_jams_are_printed_with_status_4(self):
        jammed = 0
        for angle in range(5, 90, 5):
            for ratio in ("-1.5", "1.5", "2.5", "-2.5"):
                done = run("sequence", "--angle", str(angle), f"--impulse-ratio={ratio}", "--gravity", "9.81", "--restitution", "0.7",
                           "--format", "json")
                if done.returncode != 4 or not done.stdout:
                    continue
                data = json.loads(done.stdout)
                jammed += 1
                self.assertEqual(data["outcome"], "outside-model")
                self.assertGreaterEqual(len(data["impacts"]), 1)
                self.assertRegex(done.stderr.splitlines()[-1], "^clatter: outside-model: jamming")
                number = str(len(data["impacts"]) + 1)
                for command in (["explain", number], ["gradient"]):
                    self.assertEqual(run(*command, "--angle", str(angle), f"--impulse-ratio={ratio}", "--gravity", "9.81",
                                         "--restitution", "0.7").returncode, 4)
        self.assertGreater(jammed, 0)

    # The third flight is too long for the phase of so fast a rotation to keep a digit.
    LOST = ("[drop]\nattitude = [0.9, 0.1, 0.2, 0.374165738677]\nvelocity = [0, 0, -100]\n"
            "angular_velocity = [-3e7, 2e7, 1e6]\n[world]\ngravity = 1e-3\n[body]\nshape = 'box'\nsize = [0.1, 0.08, 0.02]\n"
            "mass = 1\n[impact]\nrestitution = 0.5\n[run]\nimpacts = 3\n")

    def test_a_run_that_could_not_be_computed_ends_every_command_with_status_3(self):
        with tempfile.TemporaryDirectory() as folder:
            lost, page, picture = (os.path.join(folder, name) for name in ("lost.toml", "page.html", "map.csv"))
            with open(lost, "w") as file:
                file.write(self.LOST)
            stiff = ["--body", "box", "--size", "0.1x0.1x0.02", "--mass", "1", "--angle", "5", "--stiffness", "1e300"]
            probe = ["--probe", "middle:0,0,0"]
            report = ["report", "--drops", "0", "--output", page] if shutil.which("gnuplot") else []
            for words in (["sequence", lost], ["gradient", lost], ["shock", lost, "--model", "discrete", *probe],
                          ["explain", "9", lost], ["sweep", lost, "--set", "impact.restitution=0.5,0.6"],
                          ["map", lost, "--over", "impact.restitution=0.4:0.6", "--over", "world.gravity=1e-3:2e-3",
                           "--size", "2x2", "--output", picture],
                          ["simulate", *stiff], ["shock", *stiff, *probe], ["compare", *stiff], ["plan", *stiff],
                          ["tradeoff", *stiff], report and [*report, *stiff], report and [*report, lost, "--model", "discrete"]):
                if words:
                    done = run(*words)
                    self.assertEqual((done.returncode, done.stderr.startswith("clatter: ")), (3, True), (words, done.stderr))

    def test_a_file_that_cannot_be_written_is_bad_input(self):
        for path in ["/nonexistent/folder/file", "/dev"]:
            result = run("sequence", "--angle", "10", "--output", path)
            self.assertEqual((result.returncode, result.stdout), (2, ""))


class Output(unittest.TestCase):
    def test_the_readme_table_has_the_three_impacts(self):
        text = run("sequence", "--angle", "10").stdout
        for number in ["5.08198", "10.5480", "0.511569", "1.00284", "0.485091", "1.99950"]:
            self.assertIn(number, text)

    def test_tables_fit_80_columns(self):
        for arguments in [["sequence", "--angle", "10"],
                          ["sequence", "--angle", "10", "--gravity", "9.81", "--restitution", "0.5", "--friction", "0.3",
                           "--impacts", "60"],
                          ["sequence", "--angle", "90", "--body", "rod", "--radius", "0.1", "--gravity", "9.81", "--restitution", "0.5"],
                          ["angles"], ["angles", "--as-printed", "--gravity-number", "1"], ["regimes"],
                          ["explain", "2", "--angle", "10", "--gravity", "9.81", "--friction", "0.2"],
                          ["explain", "9", "--angle", "10"], ["--help"]]:
            for line in run(*arguments).stdout.splitlines():
                self.assertLessEqual(len(line), 80, (arguments, line))

    def test_ascii_means_ascii(self):
        for arguments in [["sequence", "--angle", "10", "--restitution", "0.5", "--gravity", "9.81", "--impacts", "99"],
                          ["angles", "--as-printed"], ["regimes"], ["explain", "2", "--angle", "10", "--gravity", "1"],
                          ["gradient", "--angle", "10"], ["ground", "--floor", "wood", "--footprint", "1e-4"], ["columns"], ["keys"], ["benchmark", "list"],
                          ["measured", "fit", "square-drops"], ["shock", "phone-damped", "--impacts", "1", "--probe", "a:0,0,0"]]:
            shown = run(*arguments, "--ascii").stdout
            self.assertTrue(shown and shown.isascii(), (arguments, shown))

    def test_json_has_the_promised_keys_and_no_nan(self):
        text = run("sequence", "--angle", "10", "--format", "json").stdout
        data = json.loads(text, parse_constant=lambda name: self.fail(name))
        self.assertEqual(data["model"], "discrete")
        self.assertEqual(data["outcome"], "no-further-impact")
        for key in ["clatter", "scene", "impacts", "message", "total_normal_impulse", "cost"]:
            self.assertIn(key, data)
        wanted = ["n", "start", "duration", "end", "inclination_deg", "contact_angle_deg", "approach_speed", "restitution",
                  "impulse_normal", "impulse_tangential", "impulse_ratio", "mode", "impulse", "peak_force", "peak_time", "velocity_after",
                  "angular_velocity_after", "energy_before", "energy_after", "energy_loss", "error_estimate", "amplification",
                  "predictable"]
        for impact in data["impacts"]:
            self.assertEqual(sorted(impact), sorted(wanted))
            self.assertIsNone(impact["peak_force"])
        self.assertEqual([i["end"] for i in data["impacts"]], ["a", "b", "a"])
        self.assertEqual(data["scene"]["drop"]["angle_deg"], 10)
        self.assertEqual(set(data["cost"]), {"force_evaluations", "root_evaluations"})

    def test_the_angles_of_the_json_are_degrees(self):
        impacts = json.loads(run("sequence", "--angle", "10", "--format", "json").stdout)["impacts"]
        # 30-digit values of an independent computation (validation/oracles/reference).
        for impact, angle in zip(impacts, [10, 5.08198288305537, 10.5479772399858]):
            self.assertAlmostEqual(impact["contact_angle_deg"], angle, delta=1e-13)  # their last digit
            self.assertAlmostEqual(abs(impact["inclination_deg"]), angle, delta=1e-13)

    def test_a_height_is_that_of_the_centre_of_mass_at_release(self):
        impacts = json.loads(run("sequence", "--angle", "30", "--height", "2", "--gravity", "9.81", "--format", "json").stdout)
        # It falls until the rod's end touches, L/2 sin 30° = 0.25 m below the centre.
        self.assertAlmostEqual(impacts["impacts"][0]["approach_speed"], math.sqrt(2 * 9.81 * (2 - 0.25)), delta=1e-14)

    def test_the_gravity_number_is_g_l_over_the_square_of_the_speed(self):
        arguments = ["--gravity", "9.81", "--length", "2", "--speed", "3", "--count", "1", "--format", "json"]
        number = json.loads(run("angles", *arguments).stdout)["parameters"]["gravity_number"]
        self.assertAlmostEqual(number, 9.81 * 2 / 9, delta=1e-15)  # three roundings

    def test_the_regimes_of_the_json_are_the_known_folds_in_degrees(self):
        first = json.loads(run("regimes", "--format", "json").stdout)["rows"][0]
        self.assertEqual(first["gravity-number"], 0)
        # The values of tests/analytic/plane/regime_boundary_test.cpp, to the digits given there.
        for kind, key, angle in [("second", "theta_deg", 58.488442288312), ("second", "beta_deg", 86.701384197437),
                                 ("third", "theta_deg", 27.577809606636), ("third", "gamma_deg", 63.128123330456)]:
            self.assertAlmostEqual(first[kind][key], angle, delta=1.2e-12)

    def test_the_numbers_in_the_tex_of_an_equation_compute_to_its_value(self):
        steps = json.loads(run("explain", "2", "--angle", "10", "--gravity", "9.81", "--friction", "0.3", "--format", "json").stdout)["steps"]
        computed = 0
        for e in (e for step in steps for e in step["equations"]):
            self.assertTrue(e["tex"].isascii() and e["tex"].count("&=") >= 1, e["tex"])
            self.assertEqual(e["tex"].count("{"), e["tex"].count("}"), e["tex"])
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
        steps = json.loads(run("explain", "2", "--angle", "20", "--gravity", "9.81", "--format", "json").stdout)["steps"]
        shown = {e["name"]: e["value"] for step in steps if step["title"] == "The flight to impact 2" for e in step["equations"]}
        theta, phi = math.radians(shown["θ"]), shown["φ"]
        left = math.sin(theta) + shown["K"] * phi - shown["Γ"] * phi * phi - math.sin(phi - theta)
        self.assertGreater(shown["Γ"], 0)
        # Terms of order 1, a few roundings each, and the rounding of the angle in degrees.
        self.assertAlmostEqual(left, 0, delta=1e-14)
        self.assertAlmostEqual(shown["f"], 0, delta=1e-14)

    def test_csv_and_json_carry_the_same_numbers(self):
        arguments = ["sequence", "--angle", "33", "--gravity", "9.81", "--friction", "0.1"]
        data = json.loads(run(*arguments, "--format", "json").stdout)
        lines = [l for l in run(*arguments, "--format", "csv").stdout.splitlines() if not l.startswith("#")]
        rows = list(csv.DictReader(io.StringIO("\n".join(lines))))
        self.assertEqual(len(rows), len(data["impacts"]))
        for row, impact in zip(rows, data["impacts"]):
            for key in ["start", "contact_angle_deg", "impulse_normal", "energy_after"]:
                self.assertEqual(float(row[key]), impact[key])
            self.assertEqual(float(row["velocity_after_z"]), impact["velocity_after"][2])

    def test_numbers_are_shortest_round_trip(self):
        for line in run("angles", "--count", "301", "--format", "csv").stdout.splitlines():
            if line.startswith("#") or line.startswith("theta"):
                continue
            for field in filter(None, line.split(",")):
                digits = len(repr(float(field)).replace("-", "").replace(".", "").split("e")[0].strip("0"))
                self.assertLessEqual(len(field.replace("-", "").replace(".", "").split("e")[0].strip("0")), digits)

    def test_the_errors_of_angles_cover_those_against_30_digit_references_and_are_small(self):
        folder = os.path.join(ROOT, "validation", "oracles", "reference")
        compared = 0
        for name in ("rod_sequence_no_gravity.csv", "rod_sequence_gravity.csv"):
            with open(os.path.join(folder, name), encoding="utf-8") as file:
                rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
            for exact in rows:
                arguments = ["angles", "--from", exact["theta_deg"], "--count", "1", "--gravity-number", exact["G"]]
                data = json.loads(run(*arguments, "--format", "json").stdout)["rows"][0]
                lines = [line for line in run(*arguments, "--format", "csv").stdout.splitlines() if not line.startswith("#")]
                record = next(csv.DictReader(lines))
                for key in ("beta_deg", "gamma_deg", "P1", "P2", "P3", "V1", "Omega1", "V2", "Omega2", "V3", "Omega3", "T1", "T2"):
                    if not exact[key] or data[key] is None:
                        continue
                    error = data["error_estimate"][key]
                    self.assertEqual((float(record[key]), float(record[key + "_error"])), (data[key], error), (exact["theta_deg"], key))
                    off = abs(Decimal(data[key]) - Decimal(exact[key]))
                    self.assertLessEqual(off, Decimal(error), (exact["theta_deg"], exact["G"], key))
                    self.assertLess(error, 1e-6, (exact["theta_deg"], exact["G"], key))
                    compared += 1
        self.assertGreater(compared, 500)

    def test_steps_give_clean_decimals_and_both_ends(self):
        lines = [l for l in run("angles", "--step", "0.1", "--format", "csv").stdout.splitlines() if l[0].isdigit()]
        self.assertEqual(len(lines), 901)
        self.assertEqual(lines[3].split(",")[0], "0.3")
        self.assertEqual(lines[-1].split(",")[0], "90")

    def test_an_accumulation_ends_in_a_tail_and_at_rest(self):
        data = json.loads(run("sequence", "--angle", "0", "--gravity", "9.81", "--restitution", "0.5", "--format", "json").stdout)
        self.assertEqual(data["outcome"], "at-rest")
        self.assertTrue(data["tail"]["closed_form"])
        self.assertAlmostEqual(data["tail"]["end_time"], 2 * 0.5 / (9.81 * 0.5), delta=1e-15)

    def test_output_files_appear_whole_with_the_same_text(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "table")
            result = run("sequence", "--angle", "10", "--output", path)
            self.assertEqual((result.returncode, result.stdout, os.listdir(folder)), (0, "", ["table"]))
            with open(path, encoding="utf-8") as file:
                self.assertEqual(file.read(), run("sequence", "--angle", "10").stdout)

    def test_markdown_and_latex_have_a_row_for_each_impact(self):
        self.assertEqual(run("sequence", "--angle", "10", "--format", "markdown").stdout.count("\n| "), 4)
        self.assertEqual(run("sequence", "--angle", "10", "--format", "latex").stdout.count("\\\\"), 5)
        explained = run("explain", "2", "--angle", "10", "--format", "latex").stdout
        for law in ("V_n - \\Omega d_t &= -e (v_n - \\omega d_t)", "m (V_n - v_n) &= P_n",  # of Eq. 8
                    "\\sin \\theta + K \\varphi - \\sin(\\varphi - \\theta) &= 0"):     # Eq. 12
            self.assertIn(law, explained)

    def test_an_impact_that_does_not_happen_is_explained(self):
        result = run("explain", "2", "--angle", "80")
        self.assertEqual(result.returncode, 0)
        self.assertIn("does not happen", result.stdout)

    def test_the_printed_gravity_term_is_shown_beside_the_corrected_one(self):
        data = json.loads(run("angles", "--as-printed", "--gravity", "9.81", "--from", "20", "--to", "20", "--format", "json").stdout)
        row = data["rows"][0]
        self.assertAlmostEqual(row["beta_deg"], 3.1820, delta=5e-5)
        self.assertAlmostEqual(row["beta_printed_deg"], 25.99, delta=5e-3)
        self.assertAlmostEqual(row["beta_printed_negative_g_deg"], 5.97, delta=5e-3)


class Manners(unittest.TestCase):
    def test_help_of_a_command_is_the_same_asked_for_either_way_and_names_the_program(self):
        for command in ("sequence", "simulate", "keys"):
            asked = run("help", command)
            self.assertEqual((asked.returncode, asked.stdout), (0, run(command, "--help").stdout))
            self.assertIn(f"Usage: clatter {command} ", asked.stdout)
        self.assertEqual(run("help").stdout, run("--help").stdout)
        self.assertEqual(run("help", "nothing").returncode, 2)

    def test_help_at_every_level_has_an_example(self):
        for command in [[], ["sequence"], ["angles"], ["regimes"], ["explain"], ["completion"], ["man"]]:
            result = run(*command, "--help")
            self.assertEqual((result.returncode, result.stderr), (0, ""))
            self.assertIn("Example:", result.stdout)

    def test_version(self):
        self.assertRegex(run("--version").stdout, r"^clatter \d+\.\d+\.\d+\n$")

    def test_completion_scripts_parse(self):
        for shell in ["bash", "zsh", "fish"]:
            script = run("completion", shell)
            self.assertEqual(script.returncode, 0)
            self.assertIn("sequence", script.stdout)
            if shutil.which(shell):
                check = subprocess.run([shell, "-n"], input=script.stdout, capture_output=True, text=True)
                self.assertEqual((check.returncode, check.stderr), (0, ""), shell)

    def test_the_man_page_renders_without_warnings(self):
        if not shutil.which("groff"):
            self.skipTest("no groff here")
        page = subprocess.run(["groff", "-man", "-ww", "-Tascii"], input=run("man").stdout, capture_output=True, text=True)
        self.assertEqual((page.returncode, page.stderr), (0, ""))

    def test_there_is_a_manual_page_for_each_command_and_all_render_without_warnings(self):
        if not (shutil.which("groff") and shutil.which("help2man")):
            self.skipTest("no groff or no help2man here")
        with tempfile.TemporaryDirectory() as folder:
            pages = os.path.join(folder, "man")
            script = os.path.join(ROOT, "validation", "program", "man_pages")
            subprocess.run(["sh", script, PROGRAM, pages], check=True)
            commands = re.findall(r"^  (\w+) ", run("--help").stdout.split("Subcommands:")[1].split("\n\n")[0], re.M)
            self.assertEqual(sorted(os.listdir(pages)),
                             sorted(["clatter.1.gz"] + [f"clatter-{command}.1.gz" for command in commands]))
            for name in os.listdir(pages):
                with gzip.open(os.path.join(pages, name), "rt") as file:
                    text = file.read()
                self.assertTrue(re.search(rf'^\.TH {name[:-5].upper()} "1" "\d+-\d+-\d+" ', text, re.M), name)
                page = subprocess.run(["groff", "-man", "-ww", "-Tascii"], input=text, capture_output=True, text=True)
                self.assertEqual((page.returncode, page.stderr), (0, ""), name)

    def test_a_reader_that_leaves_early_is_no_error(self):
        process = subprocess.Popen([PROGRAM, "angles", "--count", "300000", "--format", "csv"], stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        process.stdout.readline()
        process.stdout.close()
        self.assertEqual(process.stderr.read(), b"")
        process.stderr.close()
        self.assertEqual(process.wait(timeout=3000), 0)

    def test_an_interrupt_gives_130_whole_rows_and_no_half_file(self):
        with tempfile.TemporaryDirectory() as folder:
            process = subprocess.Popen([PROGRAM, "angles", "--count", "50000000", "--format", "csv", "--output", os.path.join(folder, "x")])
            until(lambda: any(sizes(folder).values()), process)
            process.send_signal(signal.SIGINT)
            self.assertEqual(process.wait(timeout=3000), 130)
            self.assertEqual(os.listdir(folder), [])
        process = subprocess.Popen([PROGRAM, "angles", "--count", "50000000", "--format", "csv"], stdout=subprocess.PIPE, text=True)
        lines = [process.stdout.readline() for _ in range(5)]
        process.send_signal(signal.SIGINT)
        lines += process.stdout.read().splitlines(keepends=True)
        process.stdout.close()
        self.assertEqual(process.wait(timeout=3000), 130)
        self.assertTrue(lines[-1].startswith("# interrupted after"))
        width = next(l for l in lines if l.startswith("theta")).count(",")
        self.assertTrue(all(l.count(",") == width for l in lines if l[0].isdigit()))
