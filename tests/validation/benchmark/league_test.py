# SPDX-License-Identifier: GPL-3.0-or-later
"""How the league makes runs of problems, reads adapters' reports and puts phases together; no engine is needed."""

import argparse
import os
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(os.environ["CLATTER_ROOT"])
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


def vertices(problem):
    return [(x * problem.size[0] / 2, y * problem.size[1] / 2, z * problem.size[2] / 2)
            for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]


def matrix_of(q):
    a, b, c, d = q
    return [[a * a + b * b - c * c - d * d, 2 * (b * c - a * d), 2 * (b * d + a * c)],
            [2 * (b * c + a * d), a * a - b * b + c * c - d * d, 2 * (c * d - a * b)],
            [2 * (b * d - a * c), 2 * (c * d + a * b), a * a - b * b - c * c + d * d]]


def angular_momentum(problem, attitude, spin):
    turn = matrix_of(attitude)
    body = [sum(turn[j][i] * spin[j] for j in range(3)) * problem.inertia[i] for i in range(3)]
    return [sum(turn[i][j] * body[j] for j in range(3)) for i in range(3)]


def start_of(problem, gap):
    pairs = dict(pair.split("=", 1) for pair in runs.flat_numbers(problem, gap, 1e-3, "default", "x").split())
    return {key: [float(part) for part in text.split(",")] for key, text in pairs.items()
            if key in ("position", "attitude", "velocity", "angular_velocity", "radius", "duration")}


class Starts(unittest.TestCase):
    def each(self, check):
        """`check` of each problem, gap and start."""
        for problem in PROBLEMS.values():
            for gap in problem.gaps:
                with self.subTest(problem=problem.id, gap=gap):
                    check(problem, gap, start_of(problem, gap))

    def test_the_lowest_point_begins_at_the_gap(self):
        def check(problem, gap, start):
            turn = matrix_of(start["attitude"])
            low = min(sum(turn[2][j] * vertex[j] for j in range(3)) for vertex in vertices(problem))
            self.assertAlmostEqual(start["position"][2] - start["radius"][0] + low, gap, delta=ROUNDING)
        self.each(check)

    def test_the_fall_to_the_touch_keeps_energy_and_angular_momentum(self):
        def check(problem, gap, start):
            drop = start["position"][2] - start["radius"][0] - runs.lowest(problem, problem.attitude)
            speeds = [sum(part**2 for part in velocity) for velocity in (problem.velocity, start["velocity"])]
            self.assertAlmostEqual(speeds[0], speeds[1] + 2 * problem.gravity * drop, delta=ROUNDING)
            momenta = [angular_momentum(problem, *pose) for pose in
                       ((problem.attitude, problem.spin), (start["attitude"], start["angular_velocity"]))]
            for before, after in zip(*momenta):
                self.assertAlmostEqual(before, after, delta=ROUNDING)
        self.each(check)

    def test_a_body_that_spins_begins_turned_back_by_its_spin(self):
        problem = PROBLEMS["corner"]
        gap = problem.gaps[-1]
        start, time = start_of(problem, gap), runs.time_before(problem, gap)
        # Of a short time the turning is spin times time, to the second order.
        q, p = problem.attitude, start["attitude"]
        turning = [2 * part / time for part in (q[1] * p[0] - q[0] * p[1] - q[2] * p[3] + q[3] * p[2],
                                                q[2] * p[0] - q[0] * p[2] - q[3] * p[1] + q[1] * p[3],
                                                q[3] * p[0] - q[0] * p[3] - q[1] * p[2] + q[2] * p[1])]
        for got, spin in zip(turning, problem.spin):
            self.assertAlmostEqual(got, spin, delta=10 * time)

    def test_a_run_lasts_until_the_last_impact_that_is_asked_for(self):
        self.each(lambda problem, gap, start: self.assertGreaterEqual(start["duration"][0], runs.time_before(problem, gap) + problem.until))


class Reports(unittest.TestCase):
    def cell(self, folder, script):
        class Scripted(matrix.Engine):
            def command(self, places):
                return [sys.executable, "-c", script]
        engine = Scripted("scripted", "", "native", "", "", 64, "", "", "")
        cell = matrix.planned(engine, PROBLEMS["rod-10"], "default", folder)
        matrix.carry_out(cell, matrix.Places(folder, folder, folder, folder))
        return cell

    def test_what_a_crash_leaves_undone_is_run_again_alone(self):
        with tempfile.TemporaryDirectory() as folder:
            cell = self.cell(Path(folder), FALLS_OVER)
            self.assertEqual([run.reason for run in cell.runs], [""] * 12)
            self.assertEqual({run.seconds for run in cell.runs}, {0.5})

    def test_an_engine_that_always_crashes_has_its_last_words_as_the_reason(self):
        with tempfile.TemporaryDirectory() as folder:
            cell = self.cell(Path(folder), 'import sys; sys.exit("assertion failed")')
            self.assertEqual({run.reason for run in cell.runs}, {"ended with status 1: assertion failed"})

    def test_a_reason_that_an_adapter_gives_stands_in_the_row(self):
        told = 'import sys\nfor line in sys.stdin: print("cannot", dict(p.split("=", 1) for p in line.split())["output"], "no friction")'
        with tempfile.TemporaryDirectory() as folder:
            cell = self.cell(Path(folder), told)
            rows, costs = scores.scored(cell, "no program is asked")
            self.assertEqual([row["reason"] for row in rows], ["no friction"] * 3)
            self.assertEqual(costs, [])

    def test_a_trajectory_that_is_not_a_number_has_no_score(self):
        broken = FALLS_OVER.replace("0,0,0,0,0,0,0", "0.25,0,nan,0,0,0,0").replace('"assertion failed" if', "0 if")
        with tempfile.TemporaryDirectory() as folder:
            cell = self.cell(Path(folder), broken)
            self.assertEqual({run.reason for run in cell.runs}, {"a number that is none at t = 0.25"})


class Repeats(unittest.TestCase):
    def test_numbers_that_differ_from_those_kept_are_told(self):
        """An engine whose answers are random, run again and again."""
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            options = argparse.Namespace(build=folder, program=folder / "clatter", again=True, keep=False)
            class Random(matrix.Engine):
                def command(self, places):
                    return [sys.executable, "-c", RANDOM]
            engine = Random("random", "", "native", "", "", 64, "", "", "")
            told = []
            for _ in range(3):
                made = league.League(options)
                made.result(matrix.planned(engine, PROBLEMS["rod-10"], "default", made.places.trajectories))
                told.append(made.differ)
            self.assertEqual(told, [[], ["random-rod-10-default"], ["random-rod-10-default"]])


class Phases(unittest.TestCase):
    def row(self, *judged):
        with tempfile.TemporaryDirectory() as folder:
            chosen, by_file = [], {}
            for number, one in enumerate(judged):
                file = Path(folder) / str(number)
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

    def test_an_error_that_cannot_be_had_is_the_worst(self):
        row = self.row({"error": 0.5, "verdict": "fails"}, {"error": None, "time_error": None, "verdict": "fails", "finding": "missing"})
        self.assertIsNone(row["error"])
        self.assertIsNone(row["time_error"])
        self.assertEqual(row["finding"], "missing")


class Catalogue(unittest.TestCase):
    def test_each_engine_has_an_adapter_and_each_adapter_an_engine(self):
        folder = ROOT / "validation" / "benchmark" / "engines"
        engines, absent = matrix.read_engines()
        node = {name for name, engine in engines.items() if engine.adapter == "node"}
        self.assertEqual(node, {file.stem for file in (folder / "node").glob("*.mjs")} - {"problem"})
        build = (folder / "CMakeLists.txt").read_text()
        for name, engine in engines.items():
            if engine.adapter == "native":
                self.assertTrue(any(f"adapter({part}" in build for part in (name, name.rsplit("-", 1)[0])), name)
        self.assertGreaterEqual(len([engine for engine in engines.values() if engine.package != "clatter"]), 16)
        self.assertTrue(all(one["reason"] for one in absent))
