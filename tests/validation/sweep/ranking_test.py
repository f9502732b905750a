# SPDX-License-Identifier: GPL-3.0-or-later
"""`clatter sweep --summary`: by what attitudes are ranked, and how much a summary asks of the simulator."""

import json
import shlex

from run_folder import EmptyFolder, json_of, rows_of, run

SWEEP = ("sweep", "phone-damped", "--set", "drop.attitude=26", "--random", "26", "--scatter", "3", "--set", "run.impacts=1", "--summary")
PROBE = ("--probe", "camera:0.048,0.016,0.0095")


def summary(*options):
    return json.loads(run(*SWEEP, *options, "--format", "json").stdout)


class Ranking(EmptyFolder):
    def test_attitudes_stand_in_the_order_of_the_column_asked_for(self):
        for options, column in (((*PROBE, "--rank-by", "width_camera"), "width_camera"), (PROBE, "peak_g_camera"),
                                (("--rank-by", "largest_indentation"), "largest_indentation"), ((), "largest_peak_force")):
            largest = [attitude[column]["largest"] for attitude in summary("--no-errors", *options)["attitudes"]]
            self.assertEqual(len(largest), 26)
            self.assertEqual(largest, sorted(largest, reverse=True), column)

    def test_a_part_ranks_by_its_least_margin(self):
        for options, column in (((), "margin_camera"), (("--rank-by", "landing_margin_camera"), "landing_margin_camera")):
            least = [attitude[column]["least"] for attitude in summary("--no-errors", *PROBE, "--part", "300:500", *options)["attitudes"]]
            self.assertEqual(least, sorted(least), column)

    def test_without_listed_attitudes_the_ten_worst_scenes_are_told(self):
        for swept in (("drop.angle_deg=1:89", "--random", "300"), ("drop.attitude=uniform", "--random", "60"), ("drop.angle_deg=1:89:1",)):
            command = ("sweep", "phone-corner", "--model", "discrete", "--set", "run.impacts=3", "--set", *swept)
            for column, sign, options in (("energy_loss", -1, ()), ("margin_camera", 1, (*PROBE, "--part", "2:0.3")), ("impacts", -1, ())):
                rows = rows_of(*command, *options)
                worst = json_of(*command, *options, "--summary", "--rank-by", column)["worst"]
                expected = sorted((row for row in rows if row[column]), key=lambda row: (sign * float(row[column]), int(row["index"])))[:10]
                for found, row in zip(worst, expected, strict=True):
                    self.assertEqual((found["index"], found[column]), (int(row["index"]), float(row[column])))
                    for name in (name for name in row if name.startswith("drop.")):
                        self.assertEqual(found[name], float(row[name]))
                again = rows_of(*shlex.split(worst[0]["command"])[1:])
                if column == "energy_loss":
                    self.assertAlmostEqual(sum(float(row["energy_loss"]) for row in again), worst[0]["energy_loss"], delta=1e-12)

    def test_a_column_that_is_none_is_refused_in_one_line(self):
        self.each_refused({"--summary --rank-by widht": "must be a column of numbers", "--summary --rank-by outcome": "must be a column of numbers",
                           "--rank-by impacts": "ranks the listed attitudes of --summary, or its scenes", "--summary --part 300:500": "needs --probe"},
                          *SWEEP[:-1])

    def test_a_summary_asks_for_three_digits_unless_it_is_told(self):
        few, words = ["set: run.digits = 3", "set: run.amplification = false"], summary()["sweep"]
        self.assertLessEqual(set(few), set(words))
        told = summary("--set", "run.digits=5", "--set", "run.amplification=true")["sweep"]
        self.assertFalse(set(few) & set(told))
        self.assertFalse(set(few) & set(summary("--model", "discrete")["sweep"]))
