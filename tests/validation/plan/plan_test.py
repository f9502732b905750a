# SPDX-License-Identifier: GPL-3.0-or-later
"""clatter plan, and the runs that follow it."""

import json
import os
import re
import shlex
import shutil
import tempfile
import unittest

from run_folder import CASES, case, run

SCENES = ("rod-10", "rod-45", "rod-friction-03", "rod-damped", "phone-elastic", "phone-damped", "phone-corner", "box-flat")


def parsed(*arguments):
    done = run(*arguments, "--format", "json")
    return json.loads(done.stdout)


class Plan(unittest.TestCase):
    def test_every_scene_of_the_measured_table_has_a_plan_that_fits_80_columns(self):
        for scene in SCENES:
            done = run("plan", case(scene), "--digits", "4")
            self.assertEqual(done.returncode, 0, done.stderr)
            # A path is not broken: it would no longer be one.
            long = [line for line in done.stdout.splitlines() if len(line) > 80 and CASES not in line]
            self.assertEqual(long, [], scene)
            self.assertIn("Choice: ", done.stdout)
            self.assertIn("chosen", done.stdout)

    def test_command_of_the_plan_gives_the_digits(self):
        for scene, digits in (("rod-10", 5), ("phone-damped", 4), ("phone-corner", 6)):
            plan = parsed("plan", case(scene), "--digits", str(digits))
            command = shlex.split(plan["choice"]["command"])
            self.assertEqual(command[0], "clatter")
            result = parsed(*command[1:])
            self.assertLessEqual(plan["choice"]["error"], 10.0**-digits)
            impacts = len(result["impacts"])
            self.assertEqual(impacts, plan["impacts"])
            # True values by another method at a much smaller tolerance.
            extra = ["--planar"] if "--planar" in command else []
            true = parsed("simulate", case(scene), "--method", "rkf45", "--tolerance", "1e-13", *extra)
            for row, expected in zip(result["impacts"], true["impacts"]):
                speed = max(abs(v) for r in true["impacts"] for v in r["velocity_after"] + [r["approach_speed"]])
                for value, correct in zip(row["velocity_after"], expected["velocity_after"]):
                    self.assertLessEqual(abs(value - correct), 10.0**-digits * 3 * speed)

    def test_command_of_the_plan_can_be_typed_whatever_the_file_is_called(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "the user's scene;1.toml")
            shutil.copy(case("rod-45"), path)
            command = shlex.split(parsed("plan", path, "--digits", "4")["choice"]["command"])
            self.assertEqual(command[2], path)
            self.assertEqual(run(*command[1:]).returncode, 0)

    def test_simulate_reports_achieved_against_asked(self):
        for digits in ("3", "6", "9"):
            result = parsed("simulate", case("rod-10"), "--digits", digits)
            self.assertTrue(result["accuracy"]["planned"])
            self.assertEqual(result["accuracy"]["asked"], float("1e-" + digits))
            self.assertLessEqual(result["accuracy"]["achieved"], result["accuracy"]["asked"])
        self.assertRegex(run("simulate", case("rod-10")).stdout, r"asked 6 digits, achieved \d+\.\d")
        self.assertRegex(run("sequence", "--angle", "10").stdout, r"asked 6 digits, achieved 1\d\.\d")

    def test_simulate_with_a_method_does_as_told(self):
        result = parsed("simulate", case("rod-10"), "--method", "rkf45", "--tolerance", "1e-7")
        self.assertEqual((result["method"], result["tolerance"], result["accuracy"]["planned"]), ("rkf45", 1e-7, False))

    def test_digits_out_of_reach_are_said_to_be(self):
        done = run("plan", case("phone-elastic"), "--digits", "12")
        self.assertEqual(done.returncode, 3)
        self.assertIn("12 digits", done.stderr)
        self.assertEqual(len(done.stderr.splitlines()), 1)
        self.assertIn("Not as asked", done.stdout)

    def test_within_a_time(self):
        plan = parsed("plan", case("phone-damped"), "--within", "1000")
        self.assertLessEqual(plan["choice"]["seconds"], 1)
        self.assertLess(plan["choice"]["error"], 1e-6)
        done = run("plan", case("phone-damped"), "--within", "0.02", "--digits", "9")
        self.assertEqual(done.returncode, 3, done.stdout)

    def test_csv_has_a_row_for_every_rung(self):
        lines = [line for line in run("plan", case("rod-45"), "--format", "csv").stdout.splitlines() if line[0] != "#"]
        self.assertEqual([line.split(",")[0] for line in lines], ["model", "closed form", "discrete", "discrete 3D", "planar", "spatial"])

    def test_bad_input_is_one_line(self):
        for arguments in (["--digits", "1"], ["--within", "0"], ["--within", "nan"], ["--method", "rk4"], ["--step", "1e-6"],
                          ["--tolerance", "1e-6"], ["--history", "x.csv"]):
            done = run("plan", case("rod-45"), *arguments)
            self.assertEqual((done.returncode, done.stdout), (2, ""), arguments)
            self.assertRegex(done.stderr, r"\Aclatter: [^\n]+\n\Z")
        for arguments in (["plan", case("rod-sweep")], ["sequence", "--angle", "10", "--method", "closed"],
                          ["sequence", "--angle", "10", "--method", "closed-form"],
                          ["simulate", case("rod-45"), "--tolerance", "1"],
                          ["simulate", case("rod-45"), "--tolerance", "1e-6", "--step", "1e-6"]):
            done = run(*arguments)
            self.assertEqual((done.returncode, done.stdout), (2, ""), arguments)
            self.assertTrue(re.fullmatch(r"clatter: [^\n]+\n", done.stderr), done.stderr)
