# SPDX-License-Identifier: GPL-3.0-or-later
"""How the league makes runs of problems, reads adapters' reports and puts phases together; no engine is needed."""

import argparse
import sys
import unittest
from pathlib import Path

import run_folder
from exact_motion import Asked
from run_folder import EmptyFolder

ROOT = Path(run_folder.ROOT)
sys.path.insert(0, str(ROOT / "validation" / "benchmark" / "engines"))

import league
import matrix
import runs
import scores

PROBLEMS = runs.read_problems(ROOT / "validation" / "benchmark")
ROUNDING = 1e-13  # of sizes of one, after a few hundred steps of Runge and Kutta's method
#: An adapter that does the first run that it is given and then falls over, as engines do on an assertion.
FALLS_OVER = """
import sys
pairs = dict(pair.split("=", 1) for pair in sys.stdin.readline().split())
open(pairs["output"], "w").write("t,x,z,phi,vx,vz,omega\\n0,0,0,0,0,0,0\\n")
print("done", pairs["output"], 0.5, flush=True)
sys.exit("assertion failed" if sys.stdin.readline() else 0)
"""


#: An adapter whose reason for not answering is never the same.
RANDOM = """
import random, sys
for line in sys.stdin:
    print("cannot", dict(p.split("=", 1) for p in line.split())["output"], random.random())
"""


def scripted(name, script):
    class Scripted(matrix.Engine):
        def command(self, places):
            return [sys.executable, "-c", script]
    return Scripted(name, "", "native", "", "", 64, "", "", "")


def start_of(problem, gap):
    pairs = dict(pair.split("=", 1) for pair in runs.flat_numbers(problem, gap, 1e-3, "default", "x").split())
    return {key: [float(part) for part in text.split(",")] for key, text in pairs.items()
            if key in ("position", "attitude", "velocity", "angular_velocity", "radius", "duration")}


class Starts(unittest.TestCase):
    def test_each_run_begins_as_the_program_states_the_problem_and_lasts_until_its_last_impact(self):
        for problem in PROBLEMS.values():
            for gap, told in zip(problem.gaps, Asked(problem.id).statement["starts"], strict=True):
                start = start_of(problem, gap)
                start["position"][2] -= start["radius"][0]  # an engine's rod is not thin
                with self.subTest(problem=problem.id, gap=gap):
                    for name in ("position", "attitude", "velocity", "angular_velocity"):
                        for mine, of_program in zip(start[name], told[name], strict=True):
                            self.assertAlmostEqual(mine, of_program, delta=ROUNDING)
                    self.assertGreaterEqual(start["duration"][0], told["first_touch"] + problem.until)


class Runs(EmptyFolder):
    def cell(self, script):
        folder = Path(self.folder)
        cell = matrix.planned(scripted("scripted", script), PROBLEMS["rod-10-brisk"], "default", folder)
        matrix.carry_out(cell, matrix.Places(folder, folder, folder, folder))
        return cell

    def test_what_a_crash_leaves_undone_is_run_again_alone_and_else_there_is_a_reason(self):
        self.assertEqual([(run.reason, run.seconds) for run in self.cell(FALLS_OVER).runs], [("", 0.5)] * 12)
        no_number = FALLS_OVER.replace("0,0,0,0,0,0,0", "0.25,0,nan,0,0,0,0").replace('"assertion failed" if', "0 if")
        for script, reason in (('import sys; sys.exit("assertion failed")', "ended with status 1: assertion failed"),  # its last words
                               (no_number, "a number that is none at t = 0.25")):
            self.assertEqual({run.reason for run in self.cell(script).runs}, {reason})

    def test_a_reason_that_an_adapter_gives_stands_in_the_row(self):
        told = 'import sys\nfor line in sys.stdin: print("cannot", dict(p.split("=", 1) for p in line.split())["output"], "no friction")'
        rows, costs = scores.scored(self.cell(told), "no program is asked")
        self.assertEqual(([row["reason"] for row in rows], costs), (["no friction"] * 3, []))

    def test_numbers_that_differ_from_those_kept_are_told(self):
        """An engine whose answers are random, run again and again."""
        folder = Path(self.folder)
        options = argparse.Namespace(build=folder, program=folder / "clatter", again=True, keep=False)
        told = []
        for _ in range(3):
            made = league.League(options)
            made.result(matrix.planned(scripted("random", RANDOM), PROBLEMS["rod-10-brisk"], "default", made.places.trajectories))
            told.append(made.differ)
        self.assertEqual(told, [[], ["random-rod-10-brisk-default"], ["random-rod-10-brisk-default"]])

    def row(self, *judged):
        chosen, by_file = [], {}
        for number, one in enumerate(judged):
            file = Path(self.folder) / str(number)
            file.write_text(str(number))
            chosen.append(matrix.Run("1/60", 0.0, file, 1.0))
            by_file[str(file)] = dict.fromkeys(scores.ERRORS, 0.0) | {
                "engine_version": "1", "law": "any", "order_right": True, "finding": None, "verdict": "good"} | one
        return scores.row_of(chosen, by_file, 1.0)

    def test_a_row_has_the_worst_phase(self):
        row = self.row({"law_error": 1e-5, "error": 1e-5, "verdict": "good"},
                       {"law_error": 1e-2, "error": 1e-2, "verdict": "coarse", "finding": "late, and low"},
                       {"law_error": 1e-7, "error": 1e-7, "verdict": "sharp", "order_right": False})
        self.assertEqual((row["verdict"], row["law_error"], row["finding"], row["right"]), ("coarse", 1e-2, "late; and low", 2))

        # An error that cannot be had is the worst.
        row = self.row({"error": 0.5, "verdict": "fails"}, {"error": None, "time_error": None, "verdict": "fails", "finding": "missing"})
        self.assertEqual((row["error"], row["time_error"], row["finding"]), (None, None, "missing"))

    def test_each_engine_has_an_adapter_and_each_adapter_an_engine(self):
        folder = ROOT / "validation" / "benchmark" / "engines"
        engines, absent = matrix.read_engines()
        node = {name for name, engine in engines.items() if engine.adapter == "node"}
        self.assertEqual(node, {file.stem for file in (folder / "node").glob("*.mjs")} - {"problem"})
        build = (folder / "CMakeLists.txt").read_text()
        for name, engine in engines.items():
            if engine.adapter == "native":
                self.assertTrue(any(f"adapter({part}" in build for part in (name, name.rsplit("-", 1)[0])), name)
        self.assertTrue(all(one["reason"] for one in absent))
