# SPDX-License-Identifier: GPL-3.0-or-later
"""Measured drops, the benchmark, extremes and figures in Python are those of the program; long calls tell how far they are.

PYTHONPATH holds the built package, CLATTER_PROGRAM the program, CLATTER_ROOT the source tree.
"""

import json
import os
import re
import subprocess
import tempfile
import unittest
from pathlib import Path

import numpy as np

import clatter

PROGRAM = os.environ["CLATTER_PROGRAM"]
ROOT = Path(os.environ["CLATTER_ROOT"])


def printed(*arguments, statuses=(0,)):
    done = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, check=False)
    assert done.returncode in statuses, done.stderr
    return done.stdout


def program_json(*arguments, statuses=(0,)):
    return json.loads(printed(*arguments, "--format", "json", statuses=statuses))


class Evidence(unittest.TestCase):
    def assert_same(self, result, *arguments, statuses=(0,)):
        self.assertEqual(result.to_dict(), program_json(*arguments, statuses=statuses))
        self.assertEqual(result.to_text(), printed(*arguments, "--format", "table", statuses=statuses))

    def test_measured_drops_give_what_the_program_says_by_name_and_by_file(self):
        for action, function in (("fit", clatter.measured_fit), ("predict", clatter.measured_predict),
                                 ("score", clatter.measured_score)):
            with self.subTest(action=action):
                self.assert_same(function("square-drops", seed=3), "measured", action, "square-drops", "--seed", 3)
        path = ROOT / "validation" / "measured" / "square-drops.csv"
        from_file, by_name = clatter.measured_fit(path), clatter.measured_fit("square-drops")
        self.assertEqual(from_file.to_dict()["fits"], by_name.to_dict()["fits"])
        self.assertEqual((by_name.data.drops, by_name.data.file), (from_file.data.drops, "square-drops"))
        self.assertEqual(by_name.column("restitution").dtype, float)
        with self.assertRaisesRegex(clatter.BadInput, "neither|cannot|not known"):
            clatter.measured_fit("no-such-drops")

    def test_the_benchmark_states_and_scores_what_the_program_does(self):
        self.assertEqual(clatter.benchmark_list().to_dict(), program_json("benchmark", "list"))
        self.assertEqual(clatter.benchmark_show("corner").to_dict(), program_json("benchmark", "show", "corner"))
        self.assert_same(clatter.benchmark_truth("phone-damped", "stronge"), "benchmark", "truth", "phone-damped", "--law", "stronge")
        with tempfile.TemporaryDirectory() as folder:
            right, wrong = Path(folder, "right.csv"), Path(folder, "wrong.csv")
            truth = printed("benchmark", "truth", "rod-10", "--format", "csv", "--bare").splitlines()
            right.write_text(printed("benchmark", "truth", "rod-10", "--format", "csv"), encoding="utf-8")
            wrong.write_text("\n".join(["# problem: rod-10", truth[0], re.sub(r",([^,]*)$", r",9\1", truth[1])]), encoding="utf-8")
            scored = clatter.benchmark_score([right, wrong], require="good")
            self.assert_same(scored, "benchmark", "score", right, wrong, "--require", "good", statuses=(1,))
            self.assertFalse(scored.is_met)
            self.assertTrue(clatter.benchmark_score(right, require="exact").is_met)
            against = clatter.compare_against("rod-10", [right], gravity=0)
            self.assert_same(against, "compare", "rod-10", "--gravity", "0", "--against", right)
        with self.assertRaisesRegex(clatter.BadInput, "did you mean"):
            clatter.benchmark_show("rod-1o")

    def test_the_map_of_extremes_has_the_program_s_cells(self):
        cells = clatter.extremes(["restitution"], seconds=600)
        expected = program_json("extremes", "--only", "restitution", "--seconds", "600")["cells"]
        timed = {"seconds", "model_seconds", "cost"}
        self.assertEqual([{k: v for k, v in cell.items() if "seconds" not in k and k not in timed} for cell in cells.to_dict()["cells"]],
                         [{k: v for k, v in cell.items() if "seconds" not in k and k not in timed} for cell in expected])
        for refused in (dict(only=["angel"]), dict(seconds=float("nan")), dict(quick=True, only=["angle"]), dict(seed=-1)):
            with self.assertRaises(clatter.BadInput):
                clatter.extremes(**refused)

    def test_a_figure_has_the_numbers_of_its_file(self):
        with tempfile.TemporaryDirectory() as folder:
            printed("figures", "--only", "7", "--output", folder, "--format", "json")
            self.assertEqual(clatter.figure(7).to_dict(), json.loads(Path(folder, "figure_07.json").read_text(encoding="utf-8")))
        with self.assertRaisesRegex(clatter.BadInput, "there are 7, 8"):
            clatter.figure(13)

    def test_rows_are_those_of_csv_whatever_json_groups(self):
        sweep = clatter.sweep("rod-10", {"drop.angle_deg": "5,10"}, model="discrete")
        np.testing.assert_array_equal(sweep.column("drop.angle_deg"), [5, 10])
        np.testing.assert_array_equal(sweep["drop.angle_deg"], [5, 10])
        self.assertEqual([row["impacts"] for row in sweep], [row["impacts"] for row in sweep.to_dict()["rows"]])


class Progress(unittest.TestCase):
    def test_every_long_call_tells_how_far_it_is_up_to_the_end(self):
        grid = {"drop": {"speed": 1}, "body": {"radius": 0.01}, "ground": {"stiffness": 1e9}, "run": {"impacts": 1},
                "sweep": {"angle_deg": [20, 30, 40]}}
        calls = {
            "simulate": (lambda told: clatter.simulate("phone-damped", impacts=2, progress=told), 2),
            "simulate a sweep": (lambda told: clatter.simulate(grid, progress=told), 3),
            "compare": (lambda told: clatter.compare("rod-45", progress=told), 1),
            "sweep": (lambda told: clatter.sweep("rod-10", {"drop.angle_deg": "1:50:1"}, model="discrete", progress=told), 50),
            "angles": (lambda told: clatter.angles(count=91, progress=told), 91),
            "verify": (lambda told: clatter.verify(["E1", "E2"], progress=told), 2),
            "extremes": (lambda told: clatter.extremes(["restitution"], progress=told), None),
            "tradeoff": (lambda told: clatter.tradeoff("rod-45", digits=3, progress=told), None),
        }
        for name, (call, count) in calls.items():
            with self.subTest(call=name):
                told = []
                call(lambda done, of, told=told: told.append((done, of)))
                self.assertEqual(told, sorted(told))
                self.assertEqual(told[-1][0], told[-1][1])
                self.assertGreater(told[-1][1], 0)
                if count is not None:
                    self.assertEqual(told[-1][1], count)

    def test_what_progress_raises_ends_the_call_and_arrives(self):
        class Enough(Exception):
            pass
        seen = []

        def told(done, of):
            seen.append(done)
            raise Enough
        with self.assertRaises(Enough):
            clatter.simulate("phone-sweep", progress=told)
        self.assertEqual(len(seen), 1)
