# SPDX-License-Identifier: GPL-3.0-or-later
"""Sums and their errors: what is printed of them, what CSV and JSON carry, and when a run falls short (exit status 3)."""

import itertools
import re
import signal
from pathlib import Path

from run_folder import EmptyFolder, case, json_of, records, rows_of, run

PHONE, TUMBLING = "phone-damped", "phone-elastic"  # in space nothing after impact 2 of the latter can be predicted
# An elastic box under gravity strikes again and again, and errors grow by each impact.
CHAOS = ["sequence", "--angle", "33", "--gravity", "9.81", "--body", "box", "--size", "0.1x0.05x0.04", "--impacts", "60"]
QUICK = ["--set", "run.impacts=2", "--set", "run.digits=4"]


def printed_sum(text):
    return re.search(r"Sum of normal impulses: (\S+)", text)[1].rstrip(";")


def half_unit(text):
    """Half a unit of the last digit of a number as printed."""
    mantissa, _, exponent = text.partition("e")
    return 0.5 * 10.0 ** (int(exponent or 0) - len(mantissa.partition(".")[2]))


class Sums(EmptyFolder):
    def test_a_sum_over_an_impact_that_cannot_be_predicted_is_unknown_in_every_form(self):
        data = json_of(*CHAOS)
        rows = data["impacts"]
        self.assertEqual((data["predictable"], data["total_normal_impulse_error"]), (False, None))
        known = [row["predictable"] for row in rows]
        self.assertEqual((known, known[0], known[-1]), (sorted(known, reverse=True), True, False))
        self.assertTrue(all(error is None or error == [None, 0, None] or error == [0, None, 0]
                            for error in rows[-1]["error_estimate"].values()), rows[-1]["error_estimate"])
        for form in ("table", "markdown", "latex"):
            self.assertEqual(printed_sum(run(*CHAOS, "--format", form).stdout), "?", form)
        last = [line.split() for line in run(*CHAOS).stdout.splitlines() if line.split()[:1] == ["60?"]][0]
        self.assertEqual(last[2:], ["?"] * (len(last) - 2))
        self.assertIn("total_normal_impulse_error: unknown", run(*CHAOS, "--format", "csv").stdout)
        self.assertEqual(printed_sum(run("simulate", TUMBLING).stdout), "?")
        self.assertIsNone(json_of("simulate", TUMBLING)["total_normal_impulse_error"])

    def test_a_printed_sum_is_right_to_half_a_unit_of_its_last_digit_and_its_error_at_every_number_of_digits(self):
        for scene in (["sequence", "--angle", "25", "--gravity", "9.81", "--restitution", "0.5", "--impacts", "40"],
                      ["sequence", "--angle", "70", "--body", "box", "--size", "0.1x0.05x0.02", "--gravity", "9.81",
                       "--restitution", "0.4", "--impacts", "60"],
                      ["simulate", PHONE, "--impacts", "2", "--planar"]):
            best = json_of(*scene, "--digits", "12")["total_normal_impulse"]
            for digits in ("3", "5", "7", "9"):
                with self.subTest(scene=scene, digits=digits):
                    data = json_of(*scene, "--digits", digits)
                    error = data["total_normal_impulse_error"]
                    self.assertLessEqual(abs(data["total_normal_impulse"] - best), error + 1e-11 * best)
                    shown = printed_sum(run(*scene, "--digits", digits).stdout)
                    # Half a unit from rounding, and as much for the error that the last digit may have.
                    self.assertLessEqual(abs(float(shown) - best), 2 * half_unit(shown))
                    self.assertLessEqual(error, half_unit(shown))

    def test_no_number_of_an_unpredictable_row_is_explained_with_digits(self):
        text = run("explain", "60", *CHAOS[1:]).stdout
        self.assertRegex(text, r"P_n = .*\n.*\n *= \? N·s")
        self.assertIsNone(re.search(r"\d\.\d+ (N·s|m/s|rad/s|s|J)\n", text))


class Columns(EmptyFolder):
    def test_a_sweeps_errors_are_empty_where_unknown_and_absent_where_not_asked_for(self):
        sweep = ["sweep", PHONE, "--model", "discrete", "--set", "drop.angle_deg=33", "--set", "run.impacts=2:62:60",
                 "--set", "impact.restitution=1", "--set", "impact.friction=0"]  # on the ground's damping errors stay small
        known, unknown = rows_of(*sweep)
        self.assertEqual((known["predictable"], unknown["predictable"]), ("true", "false"))
        self.assertGreater(float(known["total_normal_impulse_error"]), 0)
        for name in ("total_normal_impulse", "energy_loss", "last_start"):
            self.assertNotEqual(unknown[name], "")
            self.assertEqual(unknown[f"{name}_error"], "", name)
        for row in rows_of(*sweep, "--no-errors"):
            self.assertEqual((row["predictable"], row["total_normal_impulse_error"]), ("", ""))
            self.assertGreater(float(row["total_normal_impulse"]), 0)
        for rows, key in itertools.product(("scene", "impact"), ("run.errors", "run.amplification")):
            for row in rows_of("sweep", PHONE, "--set", "run.impacts=1", "--set", "run.digits=3", "--set", f"{key}=false", "--rows", rows):
                self.assertEqual(row["predictable"], "", (rows, key))


class Shortfalls(EmptyFolder):
    """Exit status 3 with the reason, the rows so far whole."""

    def setUp(self):
        """A phone on a ground with so much damping that explicit steps get nowhere in the second contact."""
        super().setUp()
        text = Path(case(PHONE)).read_text(encoding="utf-8").replace("damping = 1e7", "damping = 1e13").replace("impacts = 6", "impacts = 3")
        self.overdamped = self.write("overdamped.toml", text + "evaluation_limit = 20000\n")

    def short(self, *arguments):
        result = run(*arguments)
        self.assertEqual(result.returncode, 3, (arguments, result.stderr))
        others = (r"clatter: warning: the body goes \S+ m into the ground in impact \d+, more than a tenth of its least extent, .*"
                  r"|clatter: goes on after \d+ of \d+ scenes")
        said = [line for line in result.stderr.splitlines() if not re.fullmatch(others, line)]
        self.assertEqual(len(said), 1, result.stderr)
        return result

    def test_fewer_impacts_than_asked_because_of_a_limit_are_status_3_with_the_rows_so_far(self):
        result = self.short("simulate", self.overdamped)
        self.assertRegex(result.stderr, "evaluation-limit|step-too-small|not-representable|flight-undecided")
        data = json_of("simulate", self.overdamped, status=(3,))
        self.assertTrue(0 < len(data["impacts"]) < 3)
        self.assertIn(data["outcome"], data["shortfall"])
        self.assertIn(data["shortfall"], result.stderr)
        rows = rows_of("simulate", self.overdamped, status=(3,))
        self.assertEqual(len(rows), len(data["impacts"]))
        self.assertEqual({None} & {value for row in rows for value in row.values()}, set())

    def test_a_sweep_says_in_which_rows_and_why_it_falls_short_and_ends_with_status_3(self):
        sweep = ["sweep", PHONE, "--set", "run.evaluation_limit=20:200020:200000", *QUICK]
        result = self.short(*sweep)
        self.assertIn("1 of 2 scenes fall short; 0: evaluation-limit", result.stderr)
        limited, whole = records(result.stdout)
        self.assertIn("force evaluations", limited["reason"])
        self.assertEqual((whole["outcome"], whole["reason"]), ("impact-limit", ""))
        impacts = rows_of(*sweep, "--rows", "impact", status=(3,))
        self.assertIn("force evaluations", impacts[0]["reason"])

    def test_a_sweep_that_is_taken_up_again_remembers_the_rows_that_fall_short(self):
        # Without an end to the flights in the first half of the scenes.
        sweep = ["sweep", "rod-at-1ms", "--model", "discrete", "--set", "world.gravity=1e-200:9.81:9.81", "--set",
                 "drop.angle_deg=0.001:60:0.001"]
        self.assertEqual(self.stopped(signal.SIGINT, "out.csv", *sweep)[0], 130, "too short a sweep to interrupt")
        self.assertIn("60000 of 120000 scenes fall short; 0: not-computed", self.short(*sweep, "--output", self.path("out.csv")).stderr)

    def test_a_swept_scene_says_how_many_of_its_values_fall_short(self):
        path = self.write("scene.toml", "[world]\ngravity = 9.81\n[ground]\nstiffness = 1e8\ndamping = 1e13\n[run]\nimpacts = 3\n"
                          "evaluation_limit = 20000\n[sweep]\nangle_deg = { from = 10, to = 20, step = 10 }\n")
        self.assertIn("2 of 2 values fall short; 10: ", self.short("simulate", path).stderr)

    def test_a_sequence_whose_next_flight_cannot_be_computed_keeps_its_rows(self):
        command = ["sequence", "--angle", "80", "--gravity", "1e-200"]  # so weak that the end of the second flight has no digit
        self.assertIn("not-computed", self.short(*command).stderr)
        data = json_of(*command, status=(3,))
        self.assertEqual((data["outcome"], len(rows_of(*command, status=(3,)))), ("not-computed", len(data["impacts"])))
        self.assertGreater(len(data["impacts"]), 0)

    def test_ends_that_are_physics_are_status_0(self):
        bounce = ["--gravity", "9.81", "--restitution", "0.5", "--impacts", "40"]
        outcomes = {json_of("sequence", *scene)["outcome"]
                    for scene in (["--angle", "10"], ["--angle", "10", "--impacts", "1"], ["--angle", "0", *bounce],
                                  ["--angle", "30", "--gravity", "9.81", "--restitution", "0"])}
        self.assertEqual(outcomes, {"no-further-impact", "impact-limit", "at-rest", "sustained-contact"})
        for impacts in ("1", "2"):
            self.assertIsNone(json_of("simulate", PHONE, "--impacts", impacts)["shortfall"])

    def test_required_digits_that_are_not_achieved_are_status_3(self):
        # Four ulp are 15 digits, and every one of sixty impacts rounds several times.
        rounded = ["sequence", "--angle", "33", "--gravity", "9.81", "--impacts", "60", "--digits", "15"]
        coarse, three = ["simulate", PHONE, "--impacts", "1", "--digits", "9", "--step", "1e-5"], [TUMBLING, "--impacts", "3"]
        sweep = ["sweep", TUMBLING, "--set", "run.impacts=1:3:2", "--set", "run.digits=4"]
        for command, words in ((CHAOS, "digits"), (rounded, "achieved 1"), (coarse, "asked 9 digits, achieved "),
                               (["simulate", *three], "of 3 impacts only"), (["compare", *three], "digits")):
            self.assertIn(words, self.short(*command, "--require-digits").stderr)
        rows = records(self.short(*sweep, "--require-digits").stdout)
        self.assertEqual([bool(row["reason"]) for row in rows], [False, True])
        for command in (CHAOS, sweep, ["sequence", "--angle", "10", "--require-digits"], ["simulate", *three, "--planar", "--require-digits"]):
            self.assertEqual(run(*command).returncode, 0, command)
