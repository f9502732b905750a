# SPDX-License-Identifier: GPL-3.0-or-later
"""How the functions of the Python module are called: arrays, keyword arguments, Ctrl-C, wrong types; and what can be done with
their results."""

import copy
import csv
import inspect
import itertools
import operator
import pickle
import re
import shlex
import signal
import subprocess
import sys
import tempfile
import unittest
import warnings
from decimal import Decimal
from fractions import Fraction
from pathlib import Path

import clatter
import numpy as np
from clatter.arguments import KEYS, swept_text
from clatter.words import in_python
from run_folder import ROOT, run
from waiting import until_it_computes


class Series:
    """Numbers as pandas has them."""

    def __init__(self, values):
        self.values = np.asarray(values)

    def to_numpy(self):
        return self.values

    def __iter__(self):
        raise AssertionError("the array is there")


class Lists(unittest.TestCase):
    def rows(self, values, **options):
        return clatter.sweep("rod-10", {"drop.angle_deg": values}, model="discrete", **options)

    def test_whatever_holds_numbers_sweeps_them(self):
        expected = self.rows("5.0,12.5,20.0")
        self.assertEqual(len(expected), 3)
        for values in (np.linspace(5, 20, 3), [5, 12.5, 20], (5.0, 12.5, 20.0), Series([5, 12.5, 20]), iter([5, 12.5, 20]),
                       np.array([5, 12.5, 20], dtype=np.float32), [np.float64(5), Fraction(25, 2), Decimal(20)]):
            with self.subTest(type=type(values)):
                self.assertEqual([*self.rows(values)], [*expected])
        self.assertEqual([*self.rows(range(5, 20, 5))], [*self.rows("5,10,15")])

    def test_the_values_of_an_array_keep_all_their_bits(self):
        values = np.random.default_rng(1).uniform(1, 80, 50)
        np.testing.assert_array_equal(self.rows(values).column("drop.angle_deg"), values)

    def test_an_array_of_one_value_is_an_axis_of_one_point(self):
        one = self.rows(np.array([7.5]))
        self.assertEqual(one.column("drop.angle_deg").tolist(), [7.5])
        self.assertEqual(clatter.sweep("phone-corner", {"drop.orientation": [20]}, model="discrete").column("drop.orientation"), [20])
        self.assertEqual(self.rows(np.float64(7.5)).column("impacts"), one.column("impacts"))
        with self.assertRaisesRegex(clatter.BadInput, "drop.angle_deg.*at least one value"):
            self.rows([])

    def test_rows_of_an_array_are_the_attitudes_of_a_sweep(self):
        attitudes = [[1, 0, 0, 0], [0, 0.6, 0, 0.8]]
        for values in (attitudes, np.array(attitudes), (tuple(row) for row in np.array(attitudes))):
            self.assertEqual(re.sub(r"\.0\b", "", swept_text("drop.attitude", values)), "[1,0,0,0],[0,0.6,0,0.8]")
        self.assertEqual(swept_text("drop.attitude", np.array([1, 0, 0, 0])), "1x0x0x0")

    def test_vectors_of_a_scene_may_be_arrays(self):
        size = (0.1, 0.05, 0.02)
        expected = clatter.sequence(body="box", size=size, angle=10)
        for value in (np.array(size), list(size), Series(size), iter(size)):
            self.assertEqual(clatter.sequence(body="box", size=value, angle=10), expected)
        self.assertEqual(clatter.sequence({"body": {"shape": "box", "size": np.array(size)}, "drop": {"angle_deg": np.float64(10)}},
                                          gravity=0)[0].impulse_normal, expected[0].impulse_normal)

    def test_numbers_of_all_kinds_are_numbers(self):
        expected = clatter.sequence(12.5, impacts=2)
        for angle in (np.float64(12.5), np.array(12.5), np.float32(12.5), Decimal("12.5"), Fraction(25, 2)):
            self.assertEqual(clatter.sequence(angle, impacts=np.int64(2)), expected)
            self.assertEqual(clatter.sequence(angle=angle, impacts=np.array(2)), expected)
        self.assertEqual(clatter.simulate("rod-45", planar=np.bool_(True), impacts=1), clatter.simulate("rod-45", planar=True, impacts=1))
        # A column goes through the batch, whose numbers are within the error bars of the list's.
        np.testing.assert_allclose(clatter.angles(Series([10, 20])).beta_deg, clatter.angles(range(10, 30, 10)).beta_deg, rtol=1e-14)


def all_results():
    """One of each class, with what a run keeps beside its report."""
    scene = clatter.case("rod-45") | {"sweep": {"angle_deg": [20, 30]}}
    scene["drop"].pop("angle_deg")
    return {
        "Sequence": clatter.sequence(0, gravity=9.81, restitution=0.5), "in space": clatter.sequence("phone-corner"),
        "Explanation": clatter.explain(1, 10), "Gradient": clatter.gradient("phone-corner"), "Simulation": clatter.simulate("phone-damped", impacts=1),
        "with a history": clatter.simulate("phone-damped", impacts=1, history=True), "Sweep": clatter.simulate(scene, impacts=1),
        "Comparison": clatter.compare("rod-45", impacts=1), "ComparisonSweep": clatter.compare(scene, impacts=1),
        "Rows": clatter.sweep("rod-10", {"drop.angle_deg": [5, 10]}, model="discrete"), "regimes": clatter.regimes(),
        "Plan": clatter.plan("rod-10", digits=3), "Angles": clatter.angles(step=30), "Verification": clatter.verify("E1"),
        "Measured": clatter.measured_fit("square-drops"), "Problem": clatter.benchmark_show("rod-10"),
        "Table": clatter.benchmark_list(), "figure": clatter.figure(7),
    }


class Results(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", clatter.ClatterWarning)
            cls.results = all_results()

    def test_results_pickle_and_copy_and_are_equal_then(self):
        ways = {"pickle": lambda one: pickle.loads(pickle.dumps(one)), "copy": copy.copy, "deepcopy": copy.deepcopy,
                "twice": lambda one: pickle.loads(pickle.dumps(pickle.loads(pickle.dumps(one))))}
        for (name, result), (way, made) in itertools.product(self.results.items(), ways.items()):
            with self.subTest(result=name, way=way):
                again = made(result)
                self.assertIsNot(again, result)
                self.assertIs(type(again), type(result))
                self.assertEqual(again, result)
                self.assertEqual(again.to_dict(), result.to_dict())
                self.assertEqual(repr(again), repr(result))
                self.assertEqual(again._repr_html_(), result._repr_html_())
                for form, ascii in itertools.product(("table", "csv", "json", "markdown", "latex"), (False, True)):
                    self.assertEqual(again.to_text(form, ascii=ascii), result.to_text(form, ascii=ascii))
                with self.assertRaisesRegex(clatter.BadInput, "format 'xml': must be one of table"):
                    again.to_text("xml")

    def test_an_attribute_that_a_result_has_not_is_an_attribute_error(self):
        for name, result in self.results.items():
            for one in (attribute for attribute in dir(result) if not attribute.startswith("__")):
                with self.subTest(result=name, attribute=one):
                    try:
                        getattr(result, one)
                    except AttributeError:
                        self.assertFalse(hasattr(result, one))
        for result in (self.results["figure"], clatter.figure(10, gravity_numbers=1)):
            self.assertFalse(hasattr(result, "message") or hasattr(result, "scene"))

    def test_what_stands_beside_the_report_is_pickled_too(self):
        run = self.results["with a history"]
        again = pickle.loads(pickle.dumps(run))
        self.assertEqual(again.history, run.history)
        np.testing.assert_array_equal(again.history.force, run.history.force)
        self.assertNotEqual(run, self.results["Simulation"])
        for array in (again.history.force, copy.deepcopy(self.results["Angles"]).P1):
            self.assertFalse(array.flags.writeable)

    def test_a_dict_of_a_scene_has_its_probes(self):
        scene = {**clatter.case("phone-damped"), "probe": [{"name": "camera", "place": [0.048, 0.016, 0.0095]}]}
        rows = clatter.sweep(scene, {"drop.angle_deg": [10]}, model="discrete")
        self.assertGreater(rows.column("delta_v_camera")[0], 2 * np.sqrt(2 * 9.81))  # m/s, more than of an elastic flat drop of 1 m
        with self.assertRaisesRegex(TypeError, r"^1 = \{1\}: must be a number, a truth, a text or a list$"):
            clatter.sweep({**scene, "probe": [{"1": {1}}]}, {})

    def test_neither_impacts_nor_what_a_dict_of_a_result_is_made_of_can_be_changed(self):
        run = pickle.loads(pickle.dumps(self.results["Sequence"]))
        run.to_dict()["impacts"].clear()
        self.assertEqual(run, self.results["Sequence"])
        for impact in (clatter.sequence(10)[0], self.results["in space"][0], copy.deepcopy(clatter.sequence(10)[0])):
            with self.assertRaisesRegex(AttributeError, "impulse_normal: Impact cannot be changed"):
                impact.impulse_normal = 1
            for kind, change in ((AttributeError, lambda: setattr(impact, "anything", 1)), (AttributeError, lambda: delattr(impact, "end")),
                                 (TypeError, lambda: operator.setitem(impact, "n", 2)),
                                 (ValueError, lambda: operator.setitem(impact.velocity_after, 0, 1))):
                self.assertRaises(kind, change)

    def test_results_and_impacts_are_equal_by_their_values_and_show_themselves(self):
        first, impact = clatter.sequence(10)[:2]
        for same in (pickle.loads(pickle.dumps(impact)), copy.copy(impact), clatter.sequence(10)[1], clatter.sequence(10).to_dict()["impacts"][1]):
            self.assertEqual(impact, same)
        for one, other in ((impact, first), (clatter.sequence(10), clatter.sequence(11)), (clatter.angles([10]), clatter.angles([11])), (clatter.sequence(10), 10)):
            self.assertNotEqual(one, other)
        self.assertRegex(repr(impact), r"^Impact 2: end b at 0\.\d+ s, 5\.08198°, P = 1\.00284 N·s$")
        self.assertRegex(repr(self.results["in space"][0]), r"^Impact 1: end \S+ at 0 s, .*P = \S+ N·s$")

    def test_each_is_a_data_frame_with_the_columns_of_its_table_in_their_order(self):
        try:
            import pandas
        except ImportError:
            self.skipTest("pandas is not there")
        probe = {"camera": (0.048, 0.016, 0.0095)}
        others = {
            "shock": clatter.shock("phone-damped", impacts=1, probe=probe, sensitivity=False), "atlas": clatter.atlas("rod"),
            "ground": clatter.ground("phone-damped", floor="concrete"), "truth": clatter.benchmark_truth("rod-10"),
            "summary": clatter.sweep("rod-10", angle=[5, 10], model="discrete", summary=True),
            "rows of impacts": clatter.sweep("phone-corner", orientation=[5, 10], model="discrete", rows="impact"),
            "tradeoff": clatter.tradeoff("rod-45", digits=3, impacts=1), "score": clatter.measured_score("square-drops"),
        }
        for name, result in (self.results | others).items():
            with self.subTest(result=name):
                frame, lines = pandas.DataFrame(result), result.to_text("csv").splitlines()
                header = next(line for line in lines if not line.startswith("#"))
                self.assertEqual(list(frame.columns), header.split(","))
                self.assertEqual(len(frame), len(result))
                self.assertGreater(len(result), 0)
                self.assertEqual([*result], [result[i] for i in range(len(result))])
                self.assertEqual(result[-1], result[len(result) - 1])
                self.assertEqual([*result[1:3]], [*result][1:3])
                self.assertEqual(list(pandas.DataFrame(result[:1]).columns), list(frame.columns))
                for column in frame.columns:
                    if frame[column].dtype == float:
                        np.testing.assert_array_equal(frame[column], result[column], err_msg=column)
                        np.testing.assert_array_equal(result[1:3][column], result[column][1:3], err_msg=column)
                        self.assertFalse(frame[column].map(lambda one: one is None).any() and frame[column].map(
                            lambda one: isinstance(one, float)).any(), f"{column}: numbers and None")
        sides = clatter.sweep("phone-corner", orientation=[5, 10], model="discrete", columns="hardest")
        self.assertEqual((sides["hardest"].dtype, sides["energy_loss"].dtype), (int, float))
        with self.assertRaisesRegex(TypeError, r"^rows are taken by .*DataFrame\(x\)\[mask\]"):
            sides[sides["impacts"] > 2]
        kinds = pandas.DataFrame(sides).dtypes
        self.assertEqual({kinds[name] for name in ("index", "drop.orientation", "impacts", "hardest")}, {np.dtype(int)})
        self.assertEqual(kinds["last_start"], float)
        frame = pandas.DataFrame(self.results["Sequence"])
        self.assertEqual((frame["n"].dtype, frame["peak_force"].dtype), (int, float))
        self.assertIsNone(self.results["Sequence"][0].peak_force)
        self.assertIsNone(dict(self.results["Sequence"][0].items())["peak_force"])
        history = self.results["with a history"].history
        frame = pandas.DataFrame(history[10:20])
        np.testing.assert_array_equal(frame["force_z"], history.force[10:20, 2])
        np.testing.assert_array_equal(history["centre_z"], history["centre"][:, 2])
        self.assertEqual((len(history[-1]), len(history[2:5])), (len(frame.columns), 3))
        states = clatter.sequence(10).at([0.1, 0.2])
        self.assertEqual(list(pandas.DataFrame(states)["position_z"]), list(states["position_z"]))
        self.assertEqual(list(states[1:]["position_z"]), list(states["position_z"])[1:])
        atlas = clatter.atlas("phone")
        for row, text in zip(atlas, csv.DictReader(line for line in atlas.to_text("csv").splitlines() if not line.startswith("#"))):
            self.assertEqual([" ".join(map(str, row.order)), len(row.impulses)], [text["order"], row.impacts])
            self.assertEqual(row.approaches, [float(one) for one in text["approaches"].split()])
        self.assertEqual([len(one) for one in atlas["impulses"]], list(atlas["impacts"]))
        with tempfile.TemporaryDirectory() as folder:
            page = clatter.report("phone-damped", impacts=1, drops=0, model="discrete", output=Path(folder, "page.html"))
            self.assertIn("<html", page.read_text(encoding="utf-8"))
        worst = clatter.report("phone-damped", impacts=1, probe=probe, drops=4, sensitivity=False)
        frame = pandas.DataFrame(worst)
        row = frame[[attitude in worst.answer.attitude for attitude in frame["attitude"]]].iloc[0]
        drop = clatter.shock("phone-damped", impacts=1, probe=probe, sensitivity=False, attitude=[row[f"attitude_q{i}"] for i in range(4)])
        self.assertAlmostEqual(row["delta_v"] / drop["delta_v"][0], 1, delta=1e-3, msg="each row is one drop")

    def test_the_scene_of_a_result_gives_the_result_again(self):
        def plain(result):
            """Of equal content where numbers are."""
            return [{name: value.tolist() if hasattr(value, "tolist") else repr(value) for name, value in impact.items()} for impact in result.impacts]

        unnamed = {"drop": {"angle_deg": 10, "clearance": 0.5}, "world": {"gravity": 9.81}, "ground": {"stiffness": 1e9}}
        floor = {"drop": {"angle_deg": 10}, "body": {"shape": "box", "size": [0.1, 0.05, 0.01], "mass": 0.1}, "ground": {"floor": "wood"}}
        for call, scene in itertools.product((clatter.sequence, clatter.simulate, clatter.compare),
                                             ("phone-damped", "rod-10", "phone-corner", "every-key", "box-flat", unnamed, floor)):
            few = {} if call == clatter.sequence else {"impacts": 1}
            first = call(scene, **few)
            self.assertEqual(plain(call(first.scene, **few)), plain(first))


class SweepsAsTheProgram(unittest.TestCase):
    def test_a_sweep_takes_the_names_that_a_sequence_takes(self):
        by_key = clatter.sweep("phone-corner", {"drop.angle_deg": [20, 30], "world.gravity": 9.81}, model="discrete")
        by_name = clatter.sweep("phone-corner", angle=np.linspace(20, 30, 2), gravity=9.81, model="discrete")
        np.testing.assert_array_equal(by_name["total_normal_impulse"], by_key["total_normal_impulse"])
        with self.assertRaisesRegex(clatter.BadArgument, "^angle 10: drop.angle_deg is given, too"):
            clatter.sweep("rod-10", {"drop.angle_deg": 20}, angle=10)
        alone = clatter.sweep(angle=[10, 20], impacts=2)
        self.assertEqual(list(alone["total_normal_impulse"]),
                         [clatter.sequence(angle, impacts=2).total_normal_impulse for angle in (10, 20)])

    def test_a_run_has_its_columns_by_name_and_the_module_its_public_names(self):
        run = clatter.sequence(angle=10)
        self.assertEqual(list(run["impulse_normal_error"]), [impact.error_estimate.impulse_normal for impact in run])
        np.testing.assert_array_equal(run.column("velocity_after_z"), run["velocity_after"][:, 2])
        np.testing.assert_array_equal(run.at([0.1, 0.2])["position_z"], run.at([0.1, 0.2]).column("position_z"))
        self.assertEqual(sorted(dir(clatter)), sorted(clatter.__all__))

    def test_commands_of_the_program_take_what_a_sequence_takes(self):
        place = (0.048, 0.016, 0.0095)
        felt = {"impacts": 1, "probe": {"camera": place}, "sensitivity": False}
        shock = clatter.shock("phone-damped", **felt)
        self.assertEqual(shock["peak"][0], shock.rows[0].peak)
        scene = clatter.case("phone-damped") | {"run": {"impacts": 1}}
        self.assertEqual(clatter.shock(scene, probe={"camera": place}, sensitivity=False)["peak"][0], shock["peak"][0])
        self.assertEqual(clatter.shock("phone-damped", **felt, friction_law="local").scene["ground"]["friction_law"], "local")
        answer = clatter.report("phone-damped", **felt, drops=0)
        self.assertEqual(answer.answer, answer.to_dict()["answer"])
        swept = clatter.sweep("phone-corner", orientation=[5, 10], model="discrete", probe={"camera": place}, part="1000:100")
        self.assertTrue((swept["delta_v_camera"] > 0).all() and "margin_camera" in swept.columns)
        counts = clatter.map(over={"drop.angle_deg": (0, 60), "impact.restitution": (0.1, 1)}, size=(8, 6))
        middle = clatter.sequence(0.5 * 60 / 8, restitution=0.1 + 0.5 * 0.9 / 6, impacts=100)
        self.assertEqual((counts.shape, counts[0, 0]), ((6, 8), len(middle)))
        over = {"drop.angle_deg": (1, 60), "impact.restitution": (0.2, 0.9)}
        np.testing.assert_array_equal(clatter.map(over=over, gravity=9.81, quantity="ratio", size=(4, 3)),
                                      clatter.map(None, over, {"world.gravity": 9.81}, quantity="ratio", size=(4, 3)))
        self.assertEqual(set(clatter.map(over=over, size=(4, 3), quantity="outcome").flat), {"ends"})
        with self.assertWarnsRegex(clatter.ClatterWarning, "pixels are left open") as warned:
            hardest = clatter.map(over=over, friction=0.3, restitution_law="stronge", clearance=1, length=0.15, until_rest=True, size=(12, 9), quantity="hardest")
        self.assertEqual(np.isnan(hardest).sum(), int(str(warned.warning).split()[0]))
        tuples, texts = (clatter.shock("phone-damped", **felt, part=part, frequencies=frequencies).to_text("csv")
                         for part, frequencies in (((300, 500), (100, 900, 3)), ("300:500", "100:900:3")))
        self.assertEqual(tuples, texts)
        for refused, said in ((lambda: clatter.shock("phone-damped"), "^probe: required"),
                              (lambda: clatter.shock(scene, probe={"camera": place}, stiffness=-1), "^stiffness -1: must be"),
                              (lambda: clatter.map(over={"drop.angle_deg": (0, 60)}), "^over .*: must be two keys with their ranges")):
            with self.assertRaisesRegex(clatter.BadInput, said):
                refused()

    def test_messages_are_in_the_words_of_python(self):
        point, over = {"probe": {"camera": (0.048, 0.016, 0.0095)}, "impacts": 1}, {"angle": (1, 60), "restitution": (0.2, 0.9)}
        place = re.escape('probe={"NAME": (x, y, z)}')
        for said, call in (
                (f"^part: needs {place}", lambda: clatter.report("phone-damped", part=(500, 300), drops=0)),
                (r'^probe: required, a point of the body as \{"NAME": \(x, y, z\)\} in m', lambda: clatter.shock("phone-damped")),
                (r"^part \(500, 300, 2\): must be \(Hz, g\)$", lambda: clatter.shock("phone-damped", **point, part=(500, 300, 2))),
                (r"^frequencies array\(.*\.\.\.: must be \(low, high, count\)$", lambda: clatter.shock("phone-damped", **point, frequencies=np.logspace(1, 4, 61))),
                (r"^frequencies \(20, 10, 3\): high must be greater than low$", lambda: clatter.shock("phone-damped", **point, frequencies=(20, 10, 3))),
                ("^angle 100: must be from 0 to 90 degrees$", lambda: clatter.sequence(angle=100)),
                ("^angle 100: must be from 0 to 90 degrees$", lambda: clatter.sequence(100)),
                ("^angle 100: must be from 0 to 90 degrees$", lambda: clatter.shock(angle=100, **point)),
                ("^angle 100: must be from 0 to 90 degrees$", lambda: clatter.sweep(angle=[10, 100], model="discrete")),
                (r"^size \(0.14, 0.068\): must be three lengths in m greater than 0, as in \(0.106, 0.044, 0.019\)$",
                 lambda: clatter.sequence(10, body="box", size=(0.14, 0.068))),
                (r"^size \(0.14, 0.068\): must be three lengths", lambda: clatter.shock(angle=10, body="box", size=(0.14, 0.068), **point)),
                (r"^size \(0.14, 0.07, 0.01\): must be the map's width and height.*body\.size", lambda: clatter.map(over=over, size=(0.14, 0.07, 0.01))),
                (r'^over: must be two keys with their ranges.*"angle": \(0, 60\)', clatter.map),
                (r"^over angle 5: must be \(low, high\)", lambda: clatter.map(over={**over, "angle": 5})),
                ("^stiffness: required.*ground_modulus.*floor", lambda: clatter.simulate(angle=10)),
                (r"^scene 'fone': .*clatter\.cases\(\)", lambda: clatter.simulate("fone")), (r"^case 'fone': .*clatter\.cases\(\)", lambda: clatter.case("fone")),
                ("^sensitivity=False: the discrete model", lambda: clatter.shock("phone-damped", **point, model="discrete", sensitivity=False)),
                ("^part '300g': needs peaks", lambda: clatter.shock("phone-damped", **point, model="discrete", part="300g")),
                (r"^probe \{'camera': \(48, 16\)\}: must be", lambda: clatter.shock("phone-damped", probe={"camera": (48, 16)})),
                (r"^size \[\(.*: must be one list of numbers, which no sweep varies; call sweep\(\) for each",
                 lambda: clatter.sweep(body="box", size=[(0.1, 0.05, 0.01), (0.2, 0.05, 0.01)], angle=10)),
                ("^until: unknown argument of shock", lambda: clatter.shock("phone-damped", **point, until=1)),
                (r"^angle \[\[1, 2\]\]: must be a value or one list of values", lambda: clatter.sweep(angle=[[1, 2]])),
                ("^no 'angle' here; did you mean drop.angle_deg", lambda: clatter.sweep(angle=[5, 10], model="discrete")["angle"])):
            with self.subTest(said), self.assertRaisesRegex((clatter.BadInput, KeyError), said.replace("^no", "no")) as refused:
                call()
            self.assertNotRegex(str(refused.exception), r"--[a-z]")
        for said, call in ((r"^restitution=0\.3 is the discrete model's alone: the ground's own is floor_restitution=0\.3",
                            lambda: clatter.shock("phone-damped", **point, restitution=0.3, sensitivity=False)),
                           (r"^friction=0\.3 is .*: the ground's own is sliding_friction=0\.3",
                            lambda: clatter.sweep(floor="concrete", angle=[10, 11], friction=0.3, impacts=1, errors=False)),
                           ("^the whole body sinks below the ground", lambda: clatter.simulate(12, stiffness=1e3, body="box", mass=0.2, size=(0.15, 0.07, 0.01), impacts=1)),
                           ("^friction: .*the ground's own is sliding_friction", lambda: clatter.simulate("phone-damped", friction=0.3, impacts=1)),
                           ("friction follows the slip$", lambda: clatter.sequence(45, impulse_ratio=0.7))):
            with self.assertWarnsRegex(clatter.ClatterWarning, said):
                call()
        worst = clatter.report("phone-damped", **point, drops=4, sensitivity=False)
        for text in (*worst.answer.notes, worst.message, repr(worst), clatter.simulate("phone-damped", impacts=1).message,
                     *(getattr(clatter, name).__doc__ for name in clatter.__all__ if inspect.isfunction(getattr(clatter, name)) and name != "benchmark_score")):
            self.assertNotRegex(text, r"--[a-z]|\bis null\b|exit status|with the flag|clatter shock|clatter help")
        self.assertEqual((worst.answer.margin, clatter.report("phone-damped", impacts=1, drops=0).answer.peak_g), (None, None))
        self.assertRegex(" ".join(worst.answer.notes), r"\(drops=\)")

    def test_a_command_with_a_flag_that_its_function_does_not_have_is_the_command_lines(self):
        for function in (clatter.simulate, clatter.compare):
            with self.assertRaisesRegex(clatter.BadInput, r"clatter\.ground\(\) finds.* whose cost the command line's clatter sweep tells$"):
                function(angle=10)

    def test_a_ground_that_is_found_can_be_pasted(self):
        body = {"body": "box", "size": (0.15, 0.075, 0.008), "mass": 0.18, "orientation": 19, "clearance": 1}
        for given, names in (({"floor": "concrete"}, {"floor"}), ({"measured_e": 0.4, "contact_time": 1e-3}, {"stiffness", "damping", "area"})):
            found = re.search("or as arguments: (.*)", repr(clatter.ground(**body, **given)))[1]
            ground = eval(f"dict({found})")  # of what is printed, as a user would
            self.assertLessEqual(names, ground.keys())
            self.assertEqual(clatter.simulate(**body, **ground, impacts=1)[0].n, 1)

    def test_further_contacts_are_where_python_has_them(self):
        for said, name in (("3 further contacts like these are in JSON", ".contacts"), ("3 further landings like these\n  are in JSON", ".outcomes")):
            self.assertEqual(in_python(said), said.replace("JSON", name))

    def test_a_command_that_can_be_typed_stays_as_it_is(self):
        for text in ("clatter shock phone-damped --impacts 2 --probe a:0,0,0", "again: clatter sweep --scenes 0:9", "clatter simulate phone-damped --rate 100"):
            self.assertEqual(in_python(text), text)
        self.assertEqual(in_python("which clatter shock --ground finds; --sliding-friction MU gives it (--drops), not --restitution-law stronge"),
                         'which clatter.ground() finds; sliding_friction gives it (drops=), not restitution_law="stronge"')

    def test_parts_and_values_are_given_as_lists_and_dicts(self):
        point = {"probe": {"camera": (0.048, 0.016, 0.007)}, "impacts": 1, "sensitivity": False}
        texts = clatter.shock("phone-damped", **point, part=["camera:500:300", "40g:11ms"]).to_text("json")
        for parts in ([(500, 300), "40g:11ms"], [np.array([500, 300]), "40g:11ms"]):
            self.assertEqual([one["peak"] for one in clatter.shock("phone-damped", **point, part=parts)],
                             [one["peak"] for one in clatter.shock("phone-damped", **point, part=["500:300", "40g:11ms"])])
        self.assertEqual(clatter.shock("phone-damped", **point, part={"camera": [(500, 300), "40g:11ms"]}).to_text("json"),
                         texts.replace("40g:11ms", "camera:40g:11ms"))
        report = {**point, "drops": 0}
        told = [list(clatter.report("phone-damped", **report, floor_restitution=several)["restitution"])
                for several in ([0.3, 0.5], (0.3, 0.5), np.array([0.3, 0.5]), "0.3,0.5")]
        self.assertEqual(told, [told[0]] * 4)
        self.assertEqual(sorted(told[0]), [0.3, 0.5])
        box = {"body": "box", "size": (0.14, 0.068, 0.016), "mass": 0.25, "clearance": 0.8, "angle": 25, "floor_restitution": 0.5}
        for floors in (("concrete", "wood"), ["concrete", "wood"], np.array(["concrete", "wood"])):
            self.assertEqual(sorted(clatter.report(**box, **report, floor=floors)["floor"]), ["concrete", "wood"])
        scenes = clatter.report(["phone-damped", Path(ROOT, "validation/cases/phone-corner.toml")], **report)
        self.assertEqual(len(scenes), 2)

    def test_a_map_takes_the_names_that_a_sweep_takes_and_tells_what_is_open(self):
        by_name = clatter.map(over={"angle": (1, 60), "restitution": (0.2, 0.9)}, size=(4, 3))
        np.testing.assert_array_equal(by_name, clatter.map(over={"drop.angle_deg": (1, 60), "impact.restitution": (0.2, 0.9)}, size=(4, 3)))
        given = {"over": {"angle": (1, 60), "restitution": (0.2, 0.9)}, "friction": 0.3, "restitution_law": "stronge", "clearance": 1, "length": 0.15,
                 "until_rest": True, "size": (12, 9)}
        with self.assertWarnsRegex(clatter.ClatterWarning, "pixels are left open") as warned:
            outcome = clatter.map(**given, quantity="outcome")
        self.assertEqual((outcome == "open").sum(), int(str(warned.warning).split()[0]))
        for word in {*outcome.flat}:
            self.assertIn(f'"{word}"', clatter.map.__doc__)

    def test_the_fields_of_a_run_are_attributes_and_a_long_one_shows_its_ends(self):
        page = Path(ROOT, "notebooks-data/reference/scenes.md").read_text(encoding="utf-8")
        fields = re.findall(r"^\| `(\w+)` \|", page, re.M)
        self.assertIn("energy_losses", fields)
        for scene in ("phone-corner", "rod-10", "box-flat"):
            run_of_it = clatter.sequence(scene)
            for field in {*fields, *run_of_it.to_dict()} - {"states"}:
                with self.subTest(scene=scene, field=field):
                    getattr(run_of_it, field)
        losses = clatter.sequence("phone-corner").energy_losses
        self.assertAlmostEqual(sum(losses.values()), sum(clatter.sequence("phone-corner")["energy_loss"]), delta=1e-12)
        for long in (clatter.sequence("phone-corner", rate=1000), clatter.simulate("phone-damped", impacts=1, rate=1e5, history=True)):
            self.assertGreater(len(long.states), 100)
            self.assertLess(len(repr(long).splitlines()), 100)
        self.assertLess(len(repr(long.history)), 100)

    def test_sizes_in_mm_are_doubted_by_a_warning(self):
        for call in (clatter.sequence, clatter.simulate, clatter.sweep):
            ground = {} if call == clatter.sequence else {"stiffness": 1e9, "impacts": 1}
            with self.assertWarnsRegex(clatter.ClatterWarning, "were mm or g meant"):
                call(body="box", size=(150, 75, 8), mass=165, angle=10, **ground)

    def test_what_falls_short_in_a_command_is_a_warning_and_not_a_line(self):
        with self.assertWarnsRegex(clatter.ClatterWarning, "^evaluation-limit: ") as warned:
            shock = clatter.shock("phone-damped", probe={"a": (0, 0, 0)}, sensitivity=False, evaluation_limit=3000)
        self.assertEqual(Path(warned.filename), Path(__file__))
        self.assertGreater(len(shock), 0)
        with self.assertRaisesRegex(clatter.NotComputed, "^no ground gives both numbers"):
            clatter.ground("rod-45", contact_time=1e-3, peak_force=1e9)

    def test_a_summary_is_that_of_the_rows(self):
        drops = {"scene": "rod-10", "angle": np.linspace(1, 60, 60), "model": "discrete"}
        summary, values = clatter.sweep(**drops, summary=True), clatter.sweep(**drops)["last_start"]
        one = summary["last_start"]
        self.assertEqual((one.count, one.least, one.largest, sum(summary.texts["outcome"].values())), (60, min(values), max(values), 60))
        self.assertEqual(run(*shlex.split(summary["last_start"].largest_command)[1:]).returncode, 0)
        with self.assertRaisesRegex(KeyError, "did you mean energy_loss"):
            summary["energy_los"]
        unnamed = clatter.sweep(clatter.case("rod-10"), angle=[5, 10], model="discrete", summary=True)
        self.assertEqual(unnamed["last_start"].largest_command or "", "")
        self.assertNotIn("clatter sweep", repr(unnamed))

    def test_figures_take_other_numbers(self):
        np.testing.assert_array_equal(clatter.figure(7, gravity_numbers=[0])["beta"], clatter.figure(7)["beta"])
        with_gravity = clatter.figure(7, gravity_numbers=[0.5])
        angles = clatter.angles(with_gravity["theta"].tolist(), gravity_number=0.5)
        np.testing.assert_array_equal(with_gravity["beta_G0_5"], angles.beta_deg)
        self.assertEqual(clatter.figure(7, gravity_numbers=0.5), with_gravity)
        rods = clatter.figure(8, angles=[30, 40])
        np.testing.assert_allclose(sorted(set(rods["theta"])), [30, 40], rtol=1e-15)
        first = [row.V_centre for row in rods if row.impacts == 1 and row.panel == 2]
        self.assertEqual(set(first), {clatter.angles([40]).V1[0]})
        forces = clatter.figure(21, angle=20, impacts=2)["Fn"]
        peaks = clatter.simulate("phone-damped", angle=20, impacts=2)["peak_force"]
        self.assertAlmostEqual(forces.max(), peaks.max(), delta=0.01 * peaks.max())  # between two samples
        self.assertIn("ground.stiffness", clatter.figure(14, stiffness=1e9).to_dict()["changed"])
        for refused, words in ((lambda: clatter.figure(7, angles=[30]), "^angles: figure 7 does not have it, but gravity_numbers"),
                               (lambda: clatter.figure(9, angle=30), "^angle: figure 9 does not have it"),
                               (lambda: clatter.figure(14, angle=30), "^angle: must be left out where rod-sweep varies it"),
                               (lambda: clatter.figure(16, sliding_friction=0.1), "^sliding_friction: must be left out"),
                               (lambda: clatter.figure(8, angles=[90]), "^angles 90: must be"),
                               (lambda: clatter.figure(7, gravity_numbers=[-1]), "^gravity_numbers -1: must be")):
            with self.assertRaisesRegex(clatter.BadInput, words):
                refused()

    def test_whole_numbers_may_be_floats(self):
        self.assertEqual(clatter.explain(2.0, angle=10, impacts=3.0).impact, 2)
        with self.assertRaises(clatter.BadArgument):
            clatter.explain(2.5, angle=10)

    def test_the_keys_of_scenes_are_keyword_arguments(self):
        for name in ("sequence", "explain", "gradient", "simulate", "compare", "compare_against", "plan", "tradeoff", "shock", "ground", "report"):
            parameters = inspect.signature(getattr(clatter, name)).parameters
            for argument in ("angle", "mass", "density", "stiffness", "impacts", "require_digits"):
                self.assertIn(argument, parameters)
            self.assertFalse([one for one in parameters.values() if one.kind is one.VAR_KEYWORD])
        parameters = inspect.signature(clatter.simulate).parameters
        for name, kind in (("angle", float), ("impacts", int), ("orientation", int), ("planar", bool)):
            self.assertEqual((parameters[name].annotation, parameters[name].default), (kind | None, None))
        self.assertIn("'surface', 'projected'", str(parameters["area"]))

    def test_keyword_arguments_complete_in_a_notebook(self):
        from IPython.core.completer import provisionalcompleter
        from IPython.core.interactiveshell import InteractiveShell
        shell = InteractiveShell()
        shell.user_ns["clatter"] = clatter
        for line, expected in (("clatter.sequence(ang", {"angle=", "angular_velocity="}), ('clatter.compare("rod-45", stiff', {"stiffness="})):
            for use_jedi in (True, False):
                shell.Completer.use_jedi = use_jedi
                with self.subTest(line=line, jedi=use_jedi), provisionalcompleter():
                    self.assertLessEqual(expected, {found.text for found in shell.Completer.completions(line, len(line))})

    def refused(self, words, function, *arguments, **named):
        with self.assertRaises(TypeError) as caught:
            function(*arguments, **named)
        self.assertEqual(str(caught.exception), words)
        self.assertIsInstance(caught.exception, clatter.BadInput)

    def test_an_unknown_argument_gets_the_nearest_known_one(self):
        for function, wrong, value, right in ((clatter.sequence, "agnle", 10, "angle"), (clatter.simulate, "stifness", 1, "stiffness"),
                                              (clatter.sequence, "law", "poison", "restitution_law"), (clatter.angles, "progess", print, "progress"),
                                              (clatter.verify, "qick", True, "quick"), (clatter.sweep, "modle", "discrete", "model")):
            self.refused(f"{wrong}: unknown argument of {function.__name__}(); did you mean {right}?", function, **{wrong: value})

    def test_an_unknown_argument_that_is_near_to_none_gets_the_functions_that_have_it_or_help(self):
        for function, wrong, said in ((clatter.sequence, "history", "it belongs to simulate()"), (clatter.simulate, "output", "it belongs to report()"),
                                      (clatter.sequence, "tolerance", r"it belongs to \w+\(\), \w+\(\), \w+\(\) and others"),
                                      (clatter.gradient, "wrt", "help(clatter.gradient) lists them")):
            with self.subTest(wrong), self.assertRaises(clatter.BadArgument) as refused:
                function(**{wrong: True})
            self.assertRegex(str(refused.exception), said if "\\" in said else re.escape(said))
            self.assertNotIn("did you mean", str(refused.exception))
        for wrong, right in (("fricton", "friction"), ("restituton", "restitution")):
            for call in (lambda: clatter.map(over={wrong: (0, 1), "angle": (1, 60)}), lambda: clatter.sweep("rod-10", values={wrong: [0.1, 0.2]}),
                         lambda: clatter.sequence(10, **{wrong: 0.1})):
                with self.assertRaisesRegex(clatter.BadInput, f"^{wrong}: unknown .*; did you mean {right}\\?$"):
                    call()
        for call in (lambda: clatter.sequence("nope.stl"), lambda: clatter.sequence("nope"), lambda: clatter.sequence(10, body="ball")):
            with self.assertRaises(clatter.BadInput) as refused:
                call()
            self.assertNotIn("did you mean", str(refused.exception))

    def test_a_wrong_type_is_told_with_the_key_the_value_and_what_is_allowed(self):
        self.refused("angle [1, 2]: must be a number, from 0 to 90 degrees; sweep() takes several", clatter.sequence, angle=[1, 2])
        self.refused("damping True: must be a number, at least 0", clatter.simulate, "rod-45", damping=True)
        self.refused("planar 2: must be True or False", clatter.simulate, "rod-45", planar=2)
        self.refused("body 3: must be one of rod, box, mesh, sphere, ellipsoid, capsule", clatter.sequence, 10, body=3)
        self.refused("size ['a', 2, 3]: must be three lengths in m greater than 0, as in [0.106, 0.044, 0.019]",
                     clatter.sequence, 10, body="box", size=["a", 2, 3])
        self.refused("orientation [[1]]: must be a whole number from 1 to 26", clatter.sequence, orientation=[[1]])
        self.refused("drop.angle_deg None: must be a number, from 0 to 90 degrees", clatter.sweep, "rod-10", {"drop.angle_deg": None})
        self.refused("drop.angle_deg = {1}: must be a number, a truth, a text or a list", clatter.simulate, {"drop": {"angle_deg": {1}}})
        self.refused("values 3: must be a dict of values by the keys of scenes", clatter.sweep, "rod-10", 3)
        self.refused("scene 3: must be a scene (a file, the name of a case, a dict)", clatter.sweep, 3, {})
        self.refused("progress 3: must be a function of (done, of)", clatter.angles, progress=3)
        self.refused("tracks 3: must be the path of a file", clatter.measured_fit, 3)
        self.refused("only 3: must be a text or a list of texts", clatter.verify, 3)
        self.refused("files [3]: must be the path of a file or a list of paths", clatter.benchmark_score, [3])
        self.refused("theta 'x': must be a number or an array of numbers", clatter.angles, "x")
        with self.assertRaisesRegex(TypeError, r"^angle array\(\[\[ 0, 1, .{25,50}\.\.\.: must be a number, from 0 to 90 degrees$"):  # one short line
            clatter.sequence(angle=np.arange(100).reshape(10, 10))

    def test_every_argument_is_known_to_the_command(self):
        """Of each function those that its command has as options, keys without a flag, which stand in the scene, and what is Python's own."""
        own = {"scene", "values", "progress", "impact", "files", "theta", "out", "number", "tracks", "problem", "angles", "gravity_numbers"}
        named = {"sensitivity": "--no-sensitivity", "start": "--from", "stop": "--to", "from_": "--from", "contact_gravity": "--no-contact-gravity"}
        words = {"compare_against": "compare", "ground": "shock --ground", "tradeoff": "plan --tradeoff", "regimes": "angles --regimes",
                 "extremes": "verify --extremes", "figure": "verify --figures", "measured_fit": "measured", "measured_predict": "measured",
                 "measured_score": "measured", "benchmark_list": "benchmark", "benchmark_show": "benchmark", "benchmark_truth": "benchmark",
                 "benchmark_score": "benchmark"}
        for name in clatter.__all__:
            function = getattr(clatter, name)
            if not inspect.isfunction(function) or name in ("case", "cases"):
                continue
            command = words.get(name, name).split()
            options = set(re.findall(r"--[a-z][a-z-]*", run(*command, "--help").stdout))
            self.assertIn("--help", options)
            for argument in set(inspect.signature(function).parameters) - own:
                key = KEYS.get(argument)
                if key and (not key.flag or "--set" in options or name == "figure"):
                    continue
                flag = key.flag if key and key.flag in options else named.get(argument, "--" + argument.replace("_", "-"))
                with self.subTest(function=name, argument=argument):
                    self.assertIn(flag, options)

    def test_what_a_command_is_given_reaches_it(self):
        """A key with a value that none has is refused for its value, by its own name."""
        place = {"camera": (0.048, 0.016, 0.0095)}
        calls = {"shock": {"scene": "phone-damped", "probe": place, "sensitivity": False},
                 "report": {"scene": "phone-damped", "probe": place, "sensitivity": False, "drops": 0}, "atlas": {"scene": "rod-10"}}
        for name, given in calls.items():
            function = getattr(clatter, name)
            for argument in inspect.signature(function).parameters:
                if argument not in KEYS or argument in given or KEYS[argument].kind in ("text", "curve"):
                    continue
                with self.subTest(function=name, argument=argument), self.assertRaises(clatter.BadInput) as refused:
                    function(**given, **{argument: "no value of anything"})
                self.assertNotIn("unknown", str(refused.exception))
                self.assertIn(argument, str(refused.exception))
                self.assertNotIn("--", str(refused.exception))

    def test_truths_reach_the_program_as_they_are(self):
        for value in (True, False):
            given = clatter.shock("phone-damped", probe={"a": (0, 0, 0)}, impacts=1, sensitivity=False, contact_gravity=value, planar=not value)
            self.assertEqual((given.scene["run"]["contact_gravity"], given.scene["run"]["planar"]), (value, not value))

    def test_no_public_function_lets_the_compiled_part_refuse_a_type(self):
        """Each argument of each function, given an object that nothing can be made of."""
        class Nothing:
            def __repr__(self):
                return "nothing"
        good = {"impact": 1, "scene": "rod-10", "values": {}, "files": [], "tracks": "square-drops", "problem": "rod-10", "number": 7,
                "name": "rod-10"}
        for name in clatter.__all__:
            function = getattr(clatter, name)
            if not inspect.isfunction(function):
                continue
            parameters = inspect.signature(function).parameters
            required = {one: good[one] for one, what in parameters.items() if what.default is what.empty}
            for argument in parameters:
                with self.subTest(function=name, argument=argument), self.assertRaises(clatter.BadInput) as refused:
                    function(**{**required, argument: Nothing()})
                self.assertRegex(str(refused.exception), rf"^{argument} nothing: must be ")


# Work that would take minutes at least, with what it needs before.
ENDLESS = {
    "sequence": "clatter.sequence(1, gravity=9.81, restitution=0.99999999, impacts=10**6)",
    "explain": "clatter.explain(10**6, 1, gravity=9.81, restitution=0.99999999, impacts=10**6)",
    "regimes": "clatter.regimes(from_=0, to=1, count=10**6)",
    "angles": "clatter.angles(count=4 * 10**6)",
    "angles of an array": "clatter.angles(numpy.full(4 * 10**6, 20.0), restitution=0)",
    "text": "angles.to_text('csv')",
    "simulate": "clatter.simulate('rod-45', method='tvd-rk3', step=1e-12, evaluation_limit=10**12)",
    "simulate a sweep": "clatter.simulate(swept)",
    "compare": "clatter.compare(swept)",
    "sweep": "clatter.sweep('rod-10', {'drop.angle_deg': '1:80:0.000001'}, model='discrete')",
    "plan": "clatter.plan('phone-damped', digits=12, impacts=1000)",
    "tradeoff": "clatter.tradeoff('phone-corner')",
    "verify": "clatter.verify()",
    "extremes": "clatter.extremes()",
    "benchmark_score": "clatter.benchmark_score([answer] * 10**6)",
    "compare_against": "clatter.compare_against('rod-10', [answer] * 10**6, gravity=0)",
    "measured_fit": "clatter.measured_fit(tracks, body='square-drops')",
}
BEFORE = {
    "angles of an array": "import numpy",
    "text": "angles = clatter.angles(count=2 * 10**6)",
    "simulate a sweep": "swept = clatter.case('rod-sweep')\nswept['sweep'] = {'angle_deg': {'from': 1, 'to': 89, 'count': 99999}}",
    "compare": "swept = clatter.case('rod-sweep')\nswept['sweep'] = {'angle_deg': {'from': 1, 'to': 89, 'count': 99999}}",
}


class CtrlC(unittest.TestCase):
    def test_ctrl_c_ends_every_long_call(self):
        with tempfile.TemporaryDirectory() as folder:
            answer, tracks = Path(folder, "answer.csv"), Path(folder, "tracks.csv")
            answer.write_text(clatter.benchmark_truth("rod-10").to_text("csv"), encoding="utf-8")
            tracks.write_text(many_drops(), encoding="utf-8")
            for name, call in ENDLESS.items():
                with self.subTest(call=name):
                    self.interrupt(f"answer, tracks = {str(answer)!r}, {str(tracks)!r}\n" + BEFORE.get(name, ""), call)

    def interrupt(self, before, call):
        """The call ends once it computes and a signal comes, and Python then ends as it does else."""
        script = (f"import clatter\n{before}\ntry:\n  print('ready', flush=True)\n  {call}\n  print('done', flush=True)\n"
                  "except KeyboardInterrupt:\n  print('interrupted', flush=True)\n")
        with subprocess.Popen([sys.executable, "-B", "-W", "ignore", "-c", script], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                              text=True) as child:
            self.assertEqual(child.stdout.readline(), "ready\n")
            until_it_computes(child)
            child.send_signal(signal.SIGINT)
            self.assertEqual(child.communicate(), ("interrupted\n", ""))
        self.assertEqual(child.returncode, 0)


def many_drops():
    """The measured drops of the square two hundred times over."""
    lines = Path(ROOT, "validation/measured/square-drops.csv").read_text(encoding="utf-8").splitlines()
    begin = next(i for i, line in enumerate(lines) if not line.startswith("#"))
    rows = [line.split(",", 1) for line in lines[begin + 1:]]
    step = 1 + max(int(drop) for drop, _ in rows)
    copies = [f"{int(drop) + step * turn},{rest}" for turn in range(200) for drop, rest in rows]
    return "\n".join([*lines[:begin + 1], *copies]) + "\n"
