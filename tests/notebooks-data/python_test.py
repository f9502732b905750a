# SPDX-License-Identifier: GPL-3.0-or-later
"""The Python module gives what the program gives, in Python's terms."""

import ast
import json
import os
import pickle
import re
import shutil
import subprocess
import sys
import tempfile
import tomllib
import typing
import unittest
import warnings
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import clatter
import numpy as np
import run_folder
from waiting import until_it_computes

CASES = sorted(Path(run_folder.CASES).glob("*.toml"))

# Twenty drops of the discrete model: every option, both bodies, folds, accumulation, a flat and an upright landing.
DROPS = [
    {"angle": 10}, {"angle": 0}, {"angle": 90}, {"angle": 27.577809606636}, {"angle": 58.488442288312},
    {"angle": 1 / 3, "gravity": 9.81}, {"angle": 20, "gravity": 9.81, "height": 0.5},
    {"angle": 45, "impulse_ratio": 0.3}, {"angle": 45, "friction": 0.7}, {"angle": 45, "friction": 0.2, "restitution": 0.6},
    {"angle": 30, "restitution": 0.5, "restitution_law": "stronge", "friction": 0.4, "tangential_velocity": -0.7},
    {"angle": 30, "restitution": 0.5, "restitution_law": "poisson", "friction": 0.4, "spin": -1.5},
    {"angle": 0, "gravity": 9.81, "restitution": 0.8, "impacts": 60},
    {"angle": 5, "gravity": 9.81, "restitution": 0.7, "impacts": 200},
    {"angle": 12, "mass": 0.1, "length": 0.15, "radius": 0.01, "gravity": 9.81},
    {"angle": 10, "body": "box", "size": (0.10566, 0.04394, 0.01905), "mass": 0.08814, "gravity": 9.81, "speed": 4.4},
    {"angle": 70, "body": "box", "size": (0.2, 0.1, 0.05), "friction": 0.3, "gravity": 9.81, "restitution": 0.9},
    {"angle": 25, "digits": 12, "method": "discrete"},
    {"angle": 40, "speed": 1e-3, "gravity": 1e-6, "impacts": 2},
]


def typed(arguments):
    """The arguments as the command line has them."""
    words = []
    for name, value in arguments.items():
        text = "x".join(map(repr, value)) if isinstance(value, tuple) else str(value)
        words += ["--" + name.replace("_", "-"), text]
    return words


def printed(*arguments):
    return run_folder.printed(*arguments, status=(0, 1))


def told(*arguments):
    return run_folder.json_of(*arguments, status=(0, 1))


def quietly(function, *arguments, **named):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", clatter.ClatterWarning)
        return function(*arguments, **named)


def timeless(value):
    """Without what depends on the time that a run takes."""
    if isinstance(value, dict):
        timed = ("cost", "front", "repeats", "message", "slowest_cell")
        return {key: timeless(part) for key, part in value.items() if "seconds" not in key and key not in timed}
    return [timeless(part) for part in value] if isinstance(value, list) else value


# Those that measure what they take.
TIMED = [
    (lambda: clatter.verify(["C1", "E2", "X1"]), "verify --only C1 E2 X1"),
    (lambda: clatter.extremes(["restitution"], seconds=600), "verify --extremes --only restitution --seconds 600"),
    (lambda: clatter.tradeoff("phone-corner", impacts=1), "plan --tradeoff phone-corner --impacts 1"),
]


FORMS = ("table", "csv", "markdown", "latex", "json")
POSE = {"body": "box", "size": (0.1, 0.05, 0.02), "velocity": (0.3, 0.2, -1),
        "attitude": (0.9028605188239304, 0.11285756485299130, -0.33857269455897390, 0.23982232531260650)}
# A call, what is typed for it, and the forms that are compared besides JSON.
SAME = [
    *((lambda drop=drop: clatter.sequence(**drop), ["sequence", *typed(drop)], FORMS) for drop in DROPS),
    *((lambda name=case.stem: clatter.simulate(name, impacts=2), ["simulate", case.stem, "--impacts", "2"], ()) for case in CASES),
    *((lambda name=name: clatter.compare(name, impacts=1), ["compare", name, "--impacts", "1"], ()) for name in
      ("rod-45", "phone-damped", "rod-friction-sweep")),
    (lambda: clatter.simulate("rod-45", angle=30, stiffness=1e9, damping=1e7, sliding_friction=0.2, static_friction=0.25, method="tvd-rk3",
                              step=2e-5, impacts=1, planar=True, gravity=1.5, contact_gravity=False),
     "simulate rod-45 --angle 30 --stiffness 1e9 --damping 1e7 --sliding-friction 0.2 --static-friction 0.25 --method tvd-rk3 "
     "--step 2e-5 --impacts 1 --planar --gravity 1.5 --no-contact-gravity".split(), FORMS),
    (lambda: clatter.simulate(angle=0, curve=[(0, 0), (0.1, 2e4), (0.6, 5e4)], thickness=0.02, impacts=1),
     "simulate --angle 0 --curve [[0,0],[0.1,2e4],[0.6,5e4]] --thickness 0.02 --impacts 1".split(), ()),
    (lambda: clatter.sequence(**POSE), ["sequence", *typed(POSE)], FORMS), (lambda: clatter.gradient(**POSE), ["gradient", *typed(POSE)], FORMS),
    (lambda: clatter.explain(1, **POSE), ["explain", "1", *typed(POSE)], FORMS), (lambda: clatter.explain(2, 10), ["explain", "2", "--angle", "10"], FORMS),
    (lambda: clatter.angles(step=2.5), ["angles", "--step", "2.5"], FORMS),
    (lambda: clatter.angles(count=7, start=1, stop=60), "angles --count 7 --from 1 --to 60".split(), ()),
    (lambda: clatter.angles(gravity=9.81, as_printed=True, restitution=0.9), "angles --gravity 9.81 --as-printed --restitution 0.9".split(), FORMS),
    (clatter.regimes, ["angles", "--regimes"], FORMS), (lambda: clatter.regimes("restitution", from_=0.5, to=1, step=0.25),
                                            "regimes --over restitution --from 0.5 --to 1 --step 0.25".split(), FORMS),
    *((lambda action=action: getattr(clatter, f"measured_{action}")("square-drops", seed=3), ["measured", action, "square-drops", "--seed", "3"], FORMS)
      for action in ("fit", "predict", "score")),
    (lambda: clatter.sequence("phone-corner", friction=0.3, restitution=0.6), "sequence phone-corner --friction 0.3 --restitution 0.6".split(), ()),
    (lambda: clatter.sweep("phone-corner", {"drop.orientation": "1:26:5", "impact.restitution": 0.5}, model="discrete", rows="impact"),
     "sweep phone-corner --set drop.orientation=1:26:5 --set impact.restitution=0.5 --model discrete --rows impact".split(), ()),
    (lambda: clatter.sweep("phone-corner", {"drop.attitude": [1, 0, 0, 0], "drop.speed": "1:3:1"}, model="discrete"),
     "sweep phone-corner --set drop.attitude=1x0x0x0 --set drop.speed=1:3:1 --model discrete".split(), ()),
    (lambda: clatter.sweep("phone-damped", {"drop.attitude": 26}, model="discrete", random=52, scatter=3, columns=["hardest", "hardest_end"]),
     "sweep phone-damped --set drop.attitude=26 --model discrete --random 52 --scatter 3 --columns hardest,hardest_end".split(), ()),
    (lambda: clatter.sweep("phone-damped", {"drop.attitude": 26}, model="discrete", summary=True),
     "sweep phone-damped --set drop.attitude=26 --model discrete --summary".split(), ()),
    (lambda: clatter.sweep("rod-10", {"drop.angle_deg": "5:60", "drop.speed": "0.1:10:log"}, random=20, seed=4, model="discrete"),
     "sweep rod-10 --set drop.angle_deg=5:60 --set drop.speed=0.1:10:log --random 20 --seed 4 --model discrete".split(), ()),
    (lambda: clatter.shock("phone-damped", impacts=1, probe={"camera": (0.048, 0.016, 0.0095)}, sensitivity=False),
     "shock phone-damped --impacts 1 --probe camera:0.048,0.016,0.0095 --no-sensitivity".split(), ()),
    (lambda: clatter.shock("phone-damped", impacts=1, probe={"camera": (0.048, 0.016, 0.0095)}, sensitivity=False, rate=2e4),
     "shock phone-damped --impacts 1 --probe camera:0.048,0.016,0.0095 --no-sensitivity --rate 2e4".split(), ("csv",)),
    (lambda: clatter.ground("phone-damped", floor="concrete"), "shock --ground phone-damped --floor concrete".split(), ()),
    (lambda: clatter.atlas("rod"), ["atlas", "rod"], ("table",)), (clatter.benchmark_list, ["benchmark", "list"], ()),
    (lambda: clatter.benchmark_show("corner"), ["benchmark", "show", "corner"], ()),
    (lambda: clatter.benchmark_truth("phone-damped", "stronge"), "benchmark truth phone-damped --law stronge".split(), FORMS),
]


class TheSameBits(unittest.TestCase):
    """Numbers are compared with ==: shortest round-trip texts give back every bit."""

    def test_results_are_the_programs(self):
        for call, words, forms in SAME:
            with self.subTest(words):
                result = quietly(call)
                self.assertEqual(result.to_dict(), told(*words))
                for form in forms:
                    self.assertEqual(result.to_text(form), printed(*words, "--format", form))
        for call, words in TIMED:
            with self.subTest(words):
                self.assertEqual(timeless(call().to_dict()), timeless(told(*words.split())))
        self.assertEqual(clatter.verify(["E2"])["E2"].answer, "misprint")

    def test_states_come_in_the_order_of_their_times(self):
        for run in (clatter.sequence(angle=10, gravity=9.81), clatter.simulate("phone-damped", impacts=2)):
            states = run.at(np.array([0.02, 0.001, 0.02]))
            self.assertEqual(states.column("position").shape, (3, 3))
            self.assertEqual(list(states.column("time")), [0.02, 0.001, 0.02])
            self.assertEqual(states.column("position_z")[0], states.column("position_z")[2])
            (late,) = run.at(0.02)
            self.assertEqual(late.velocity[2], states.column("velocity_z")[0])
        fall = clatter.sequence(angle=0, body="box", size=[0.1, 0.05, 0.02], gravity=9.81, restitution=0.5, speed=1)
        self.assertAlmostEqual(fall.at(0.03).column("position_z")[0], 0.01 + 0.5 * 0.03 - 9.81 / 2 * 0.03**2, delta=1e-15)

    def test_every_flag_of_the_program_is_an_argument(self):
        flags = {word.strip(",") for word in printed("simulate", "--help").split() if word.startswith("--")}
        others = {"--help", "--format", "--output", "--ascii", "--bare", "--history", "--mesh", "--no-contact-gravity", "--plot", "--plot-script",
                  "--rows", "--window"}
        for flag in flags - others:
            name = flag[2:].replace("-", "_")
            with self.subTest(argument=name), self.assertRaises(clatter.BadInput) as refused:
                clatter.simulate("rod-45", **{name: "no value of anything", "digits": "x"})
            self.assertNotIn("unknown argument", str(refused.exception))

    def test_a_scene_may_be_a_file_a_case_or_a_dict(self):
        for name, call in (("phone-corner", clatter.sequence), ("rod-45", lambda scene: clatter.simulate(scene, impacts=1))):
            path = Path(run_folder.case(name))
            impacts = [call(scene).to_dict()["impacts"] for scene in (name, path, tomllib.loads(path.read_text(encoding="utf-8")))]
            self.assertEqual(impacts, [impacts[0]] * 3)

    def test_parts_of_gradients_and_explanations_have_names(self):
        derived, explained = clatter.gradient(**POSE), clatter.explain(1, **POSE)
        self.assertEqual([row.n for row in derived.of("speed")], sorted({row.n for row in derived}))
        with self.assertWarnsRegex(clatter.ClatterWarning, "angle: none: the body lands flat"):
            self.assertEqual(clatter.gradient(0, gravity=9.81, impacts=1).refused[0].parameter, "angle")
        self.assertEqual(list(explained["What the impulse does"]["V′"]), list(clatter.sequence(**POSE)[0].velocity_after))

    def test_plans_are_the_programs(self):
        for case in ("phone-corner", "phone-damped"):
            mine = clatter.plan(case, digits=3, impacts=2)
            program = told("plan", case, "--digits", "3", "--impacts", "2")
            self.assertEqual(timeless(mine.to_dict()["rungs"]), timeless(program["rungs"]))
            self.assertEqual(mine.choice.model, program["choice"]["model"])
        self.assertEqual([rung.model for rung in mine.rungs], ["closed form", "discrete", "discrete 3D", "planar", "spatial"])
        self.assertGreater(len(clatter.tradeoff("phone-corner", impacts=1).front), 1)


BATCHED = ("beta_deg", "gamma_deg", "P1", "P2", "P3", "T1", "T2", "impacts")


class ArraysOfAngles(unittest.TestCase):
    """What goes through the batch, whose numbers are claims of batch_test.cpp."""

    def test_each_array_is_that_of_the_list(self):
        theta = np.array([0, 90, 1e-9, 1e-300, 58.488442288312, 27.577809606636, 12.5, 89.9999999])
        for given in ({}, {"restitution": 0.6}, {"gravity_number": 0.7}, {"impulse_ratio": 0.2}, {"gravity": 2.0, "restitution": 0.85, "impulse_ratio": -0.1}):
            many, each = (clatter.angles(one, **given) for one in (theta, theta.tolist()))
            for name in BATCHED:
                np.testing.assert_allclose(many[name], each[name], rtol=1e-13, err_msg=f"{name} {given}")

    def test_the_other_columns_and_the_table_are_the_lists(self):
        theta = np.array([10.0, 30, 70])
        many, each = clatter.angles(theta, as_printed=True, gravity=1), clatter.angles(theta.tolist(), as_printed=True, gravity=1)
        for name in ("V1", "Omega3", "impulse_deficit", "beta_printed_deg"):
            np.testing.assert_array_equal(many[name], each[name])
        self.assertEqual(many.to_text("csv"), each.to_text("csv"))
        self.assertEqual(many, clatter.angles(theta, as_printed=True, gravity=1))
        for name in ("beta_deg", "P3", "impacts"):
            np.testing.assert_array_equal(each[name], [np.nan if row[name] is None else row[name] for row in each.to_dict()["rows"]])
        for again in (pickle.loads(pickle.dumps(clatter.angles(theta))), pickle.loads(pickle.dumps(many))):
            self.assertEqual(again.gamma_minus_theta_deg.shape, (3,))
        with self.assertRaisesRegex(AttributeError, "no 'beta_printed_deg' here; there are theta_deg"):
            clatter.angles(theta).beta_printed_deg
        with self.assertRaises(KeyError):
            many["gama"]

    def test_out_is_filled_and_seen_in_the_result(self):
        theta = np.linspace(1, 80, 12).reshape(3, 4)
        expected = clatter.angles(theta)
        out = {"beta_deg": np.empty((3, 4)), "impacts": np.empty((3, 4), dtype=np.int32)}
        result = clatter.angles(theta, out=out)
        np.testing.assert_array_equal(out["beta_deg"].ravel(), expected.beta_deg)
        np.testing.assert_array_equal(out["impacts"].ravel(), expected.impacts)
        self.assertTrue(np.shares_memory(result.beta_deg, out["beta_deg"]))
        self.assertTrue(out["beta_deg"].flags.writeable and not result.beta_deg.flags.writeable)
        table = np.zeros(12, dtype=[(name, float) for name in BATCHED])
        clatter.angles(theta.ravel(), out={name: table[name] for name in BATCHED})
        for name in BATCHED:
            np.testing.assert_array_equal(table[name], expected[name])

    def test_out_that_does_not_fit_is_refused_and_not_written(self):
        theta, good = np.array([10.0, 20]), np.zeros(2)
        for words, wrong in (("out\\['V1'\\]: must be one of beta_deg", {"V1": np.zeros(2)}), ("shape \\(2,\\)", {"P1": np.zeros(3)}),
                             ("takes float64", {"P1": np.zeros(2, dtype=int)}), ("out\\['P1'\\]", {"P1": [0, 0]})):
            with self.subTest(words), self.assertRaisesRegex(clatter.BadInput, words):
                clatter.angles(theta, out={"beta_deg": good, **wrong})
            self.assertEqual(good.tolist(), [0, 0])
        for kind, words, call in ((clatter.BadInput, "unless theta is an array", lambda: clatter.angles([10], out={})),
                                  (clatter.BadInput, "theta 91", lambda: clatter.angles(np.array([10.0, 91]))),
                                  (clatter.BadInput, "theta: excludes start", lambda: clatter.angles(theta, start=1)),
                                  (clatter.OutsideModel, "jam", lambda: clatter.angles(np.full(9, np.degrees(np.arctan(2))), impulse_ratio=4 / 3))):
            with self.subTest(words), self.assertRaisesRegex(kind, words):
                call()

    def test_attributes_of_a_sequence(self):
        run = clatter.sequence(angle=10)
        self.assertIsNone(run.tail)
        self.assertGreater(clatter.sequence(angle=0, gravity=9.81, restitution=0.5, impacts=20).tail.end_time, 0)
        self.assertEqual(([impact.end for impact in run], run.outcome), (["a", "b", "a"], "no-further-impact"))
        np.testing.assert_allclose(run.column("impulse_normal").sum(), run.total_normal_impulse, rtol=1e-15)
        self.assertEqual(run.column("velocity_after").shape, (3, 3))
        self.assertTrue(np.isnan(run.column("peak_force")).all())

    def test_a_history_is_what_the_program_writes(self):
        past = clatter.simulate("phone-damped", impacts=2, history=True).history
        with tempfile.TemporaryDirectory() as folder:
            printed("simulate", "phone-damped", "--impacts", "2", "--history", Path(folder, "h.csv"))
            rows = run_folder.records(Path(folder, "h.csv").read_text(encoding="utf-8"))
        for name, columns in {"time": "t", "centre": "x y z", "attitude": "beta0 beta1 beta2 beta3", "velocity": "vx vy vz", "force": "fx fy fz",
                              **{name: name for name in ("energy_translation", "energy_rotation", "energy_potential", "energy_ground", "energy_total")}}.items():
            expected = np.array([[float(row[column]) for column in columns.split()] for row in rows])
            np.testing.assert_array_equal(getattr(past, name), expected if " " in columns else expected[:, 0], err_msg=name)
        self.assertTrue((past.force[~past.in_contact] == 0).all())
        first = past.between(past.time[10], past.time[20])
        self.assertEqual((first.time[0], first.time[-1], len(first)), (past.time[10], past.time[20], 11))

    def test_a_sweep_holds_a_run_per_value(self):
        sweep, rows = clatter.simulate("rod-sweep"), [row for row in run_folder.rows_of("simulate", "rod-sweep") if row["n"] == "1"]
        self.assertEqual((sweep.quantity, len(sweep), sweep.values[10]), ("angle_deg", 91, 10))
        np.testing.assert_array_equal(sweep.column("impulse_normal"), [float(row["impulse_normal"]) for row in rows])
        np.testing.assert_array_equal(sweep.column("velocity_after")[:, 2], [float(row["velocity_after_z"]) for row in rows])
        self.assertTrue(np.isnan(sweep.column("impulse_normal", impact=2)).all())

    def test_a_case_is_a_dict_of_its_own(self):
        scene = clatter.case("rod-45")
        scene["ground"]["stiffness"] = 1e9
        self.assertEqual(clatter.simulate(scene, impacts=1).scene["ground"]["stiffness"], 1e9)
        self.assertEqual(clatter.case("rod-45")["ground"]["stiffness"], 1e11)
        self.assertEqual(set(clatter.cases()), {case.stem for case in CASES})

    def test_texts_survive_the_way_into_a_scene(self):
        scene = clatter.case("rod-45")
        scene["run"]["history"] = 'a "quoted" \\ name\nwith\tall — of it.csv'
        self.assertEqual(clatter.simulate(scene, impacts=1).scene["run"]["history"], scene["run"]["history"])
        self.assertFalse(Path(scene["run"]["history"]).exists())

    def test_results_show_themselves(self):
        run = clatter.sequence(angle=10)
        self.assertEqual(repr(run) + "\n", run.to_text())
        html = run._repr_html_()
        self.assertEqual((html.count("<tr>"), "0.511569" in html), (1 + len(run), True))
        self.assertTrue(run.to_text(ascii=True).isascii())

    def test_some_rows_show_themselves_as_the_table_does(self):
        run = clatter.sequence(angle=10, gravity=9.81, impacts=4)
        rows = [line for line in repr(run).split("\n") if re.match(r" +\d ", line)]
        blocks = len(rows) // len(run)
        self.assertEqual(len(rows), blocks * len(run))
        for some in (slice(1, None), slice(None, None, -2), slice(2, 3)):
            expected = [line for i in range(blocks) for line in rows[i * len(run):(i + 1) * len(run)][some]]
            for shown in (run[some], run.rows[some], run[:][some]):
                self.assertEqual([line for line in repr(shown).split("\n") if re.match(r" +\d ", line)], expected)
                self.assertEqual([line for line in repr(run).split("\n") if "──" in line], [line for line in repr(shown).split("\n") if "──" in line])
        self.assertEqual(pickle.loads(pickle.dumps(run[1:])), run[1:])

    def test_a_length_a_column_and_a_row_cost_no_more_than_themselves(self):
        class Costly:
            """A report of which nothing whole is asked for."""

            def __init__(self, report):
                self._report = report

            def __getattr__(self, name):
                if name in ("data", "rows", "columns", "text", "html"):
                    raise AssertionError(name)
                return getattr(self._report, name)

        tail = {"angle": 0, "gravity": 9.81, "restitution": 0.2, "impacts": 1}
        for whole in (clatter.sequence(10), clatter.sequence("phone-corner"), clatter.sequence(**tail), clatter.gradient(10), clatter.atlas("phone"),
                      clatter.sweep("rod-10", angle=[1, 2, 88], rows="impact", model="discrete"), pickle.loads(pickle.dumps(clatter.sequence(10)))):
            part = type(whole)(Costly(whole._report))
            rows = whole.rows
            self.assertEqual(len(part), len(rows))
            name = whole.columns[-1]
            for i in (0, len(rows) - 1, -1):
                self.assertEqual((part[i], [*dict(part[i])]), (rows[i], [*dict(rows[i])]))
                self.assertEqual(repr(dict(part[i])), repr(dict(rows[i])))
            if not isinstance(whole, clatter.Rows):  # which looks for the parts of vectors
                self.assertEqual(repr(part[name]), repr(whole[name]))
        with self.assertRaises(IndexError):
            clatter.sequence(10)[9]

    def test_long_results_show_their_ends(self):
        few, many = (clatter.sweep("rod-10", angle=np.linspace(1, 80, count), model="discrete") for count in (60, 500))
        self.assertEqual(repr(few) + "\n", few.to_text())
        lines, whole = repr(many).splitlines(), many.to_text().splitlines()
        self.assertEqual(lines.count("  … 500 rows"), 2)  # in each block
        self.assertEqual([line for line in whole if line in lines], [line for line in lines if "…" not in line])
        html = many._repr_html_()
        self.assertEqual((html.count("<tr>"), html.count("… 500 rows")), (1 + 21, 1))


class Calls(unittest.TestCase):
    def refused(self, words, function, *arguments, **named):
        with self.subTest(words), self.assertRaises(clatter.BadInput) as caught:
            function(*arguments, **named)
        self.assertIn(words, str(caught.exception))
        self.assertNotIn("--", str(caught.exception))

    def test_bad_input_names_the_argument(self):
        for words, call in {
                "angle 95: must be from 0 to 90 degrees": lambda: clatter.sequence(95), "angle nan": lambda: clatter.sequence(float("nan")),
                "impulse_ratio 0.1 and friction 0.2": lambda: clatter.sequence(10, impulse_ratio=0.1, friction=0.2),
                "height 2: must be left out where world.gravity is 0": lambda: clatter.sequence(10, height=2, gravity=0),
                "restitution_law 'newtn'": lambda: clatter.sequence(10, restitution_law="newtn"),
                "impacts 2.5": lambda: clatter.sequence(10, impacts=2.5), "given twice": lambda: clatter.sequence(10, angle=20),
                "closed-form: no longer there": lambda: clatter.sequence(10, method="closed-form"),
                "drop.angle_deg": lambda: clatter.sequence({"drop": {"angle_deg": 91}}), "format 'xml'": lambda: clatter.sequence(10).to_text("xml"),
                "theta 91": lambda: clatter.angles([10, 91]), "theta nan": lambda: clatter.angles([float("nan")]),
                "start 5: must not be greater than stop=3": lambda: clatter.angles(start=5, stop=3),
                "excludes start": lambda: clatter.angles([10], start=1), "impact 0": lambda: clatter.explain(0, 10),
                "unknown argument": lambda: clatter.explain(1, 10, frictoin=0.1), "did you mean angle?": lambda: clatter.simulate("rod-45", anle=3),
                "did you mean 'rod-45'?": lambda: clatter.simulate("rod-46"), "no-such.toml": lambda: clatter.simulate("no-such.toml"),
                "did you mean ground.stiffness?": lambda: clatter.simulate({"ground": {"stifness": 1}}),
                "ground.stiffness: required": lambda: clatter.simulate({"drop": {"angle_deg": 45}}),
                "static_friction = 0.075: must be at least": lambda: clatter.simulate("phone-damped", sliding_friction=0.3),
                "drop.angel_deg: unknown key": lambda: clatter.sweep("rod-10", {"drop.angel_deg": "1:2:1"}),
                "did you mean impulse_normal_2, impulse_tangential_2": lambda: clatter.sweep("rod-10", angle=[5], model="discrete", columns="impulse_2"),
                "only 'angel'": lambda: clatter.extremes(["angel"]), "seed -1": lambda: clatter.extremes(seed=-1),
                "within -1": lambda: clatter.plan("rod-10", within=-1), "method: left out": lambda: clatter.plan("rod-10", method="rk4"),
                "over": lambda: clatter.regimes("angle"), "digits 33": lambda: clatter.compare("rod-45", digits=33),
                "did you mean C1?": lambda: clatter.verify(["C1x"])}.items():
            self.refused(words, call)
        self.assertTrue(issubclass(clatter.BadInput, ValueError))

    def test_a_file_is_named_with_the_place(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "bad.toml"
            path.write_text("[drop]\nangle_deg = 91\n[ground]\nstiffness = 1e9\n", encoding="utf-8")
            self.refused(f"{path}:2:13: drop.angle_deg = 91", clatter.simulate, path)

    def test_outside_the_model_and_not_computed_have_their_own_types_and_reservations_are_warnings(self):
        with self.assertRaisesRegex(clatter.OutsideModel, "jam"):
            clatter.sequence(np.degrees(np.arctan(2)), impulse_ratio=4 / 3)
        with self.assertRaisesRegex(clatter.NotComputed, "evaluation-limit"):
            clatter.simulate("rod-45", evaluation_limit=10)
        with self.assertWarnsRegex(clatter.ClatterWarning, "energy"):
            clatter.sequence(45, impulse_ratio=0.7)

    def test_what_is_not_there_is_told_with_the_nearest_or_with_what_there_is(self):
        run, comparison = clatter.sequence(10), clatter.compare("phone-damped", impacts=1)
        simulation = clatter.simulate("phone-damped", impacts=1, history=True)
        rows = clatter.sweep("rod-10", angle=[5, 10], model="discrete")
        for kind, words, call in (
                (AttributeError, "^no 'impulse_norml' here; did you mean impulse_normal\\?$", lambda: run[1].impulse_norml),
                (AttributeError, "impulse_normal", lambda: run[0].momentum), (AttributeError, "did you mean outcome", lambda: run.outcme),
                (AttributeError, "did you mean force", lambda: simulation.history.forse),
                (AttributeError, "history=True", lambda: clatter.simulate("rod-45", impacts=1).history),
                (AttributeError, "did you mean beta_deg", lambda: clatter.angles([10]).beta_dge),
                (KeyError, "beta_deg", lambda: clatter.angles([10])["beta"]), (KeyError, "columns='impulse_normal_2'", lambda: rows["impulse_normal"]),
                (KeyError, "impulse_normal", lambda: run.column("impulsenormal")), (KeyError, "start_error", lambda: run.column("error_estimate")),
                (KeyError, "impulse_normal", lambda: run[0]["impuls"]), (KeyError, "impuls", lambda: run["impuls"]),
                (KeyError, "continuous", lambda: comparison.column("impulse_normal", "continous")),
                (KeyError, "velocity_normal", lambda: comparison.column("velocity_after", "discrete")),
                (KeyError, "Eq. 99", lambda: clatter.explain(1, 10)["Eq. 99"])):
            with self.subTest(words), self.assertRaisesRegex(kind, words):
                call()

    def test_other_threads_run_meanwhile(self):
        """A thread answers while another simulates without end; with the lock held it could not."""
        script = ("import clatter, sys, threading\n"
                  "def answer():\n  for line in sys.stdin: print(line, end='', flush=True)\n"
                  "threading.Thread(target=answer, daemon=True).start()\n"
                  "print('ready', flush=True)\n"
                  "clatter.simulate('rod-45', method='tvd-rk3', step=1e-12, evaluation_limit=10**12)\n")
        with subprocess.Popen([sys.executable, "-c", script], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as child:
            self.assertEqual(child.stdout.readline(), "ready\n")
            until_it_computes(child)
            for question in range(20):
                print(question, file=child.stdin, flush=True)
                self.assertEqual(child.stdout.readline(), f"{question}\n")
            child.kill()

    def test_calls_from_several_threads_agree(self):
        with ThreadPoolExecutor(4) as several:
            results = [one.to_dict() for one in several.map(lambda _: clatter.simulate("phone-damped", impacts=2), range(4))]
        self.assertEqual(results, [clatter.simulate("phone-damped", impacts=2).to_dict()] * 4)

    def test_everything_public_is_documented(self):
        for name in clatter.__all__:
            self.assertTrue((getattr(clatter, name).__doc__ or "").strip(), name)

    def test_types_are_sound(self):
        """With the stub that callers see, and without it, the functions themselves."""
        package = Path(clatter.__file__).resolve().parent
        with tempfile.TemporaryDirectory() as folder:
            bare = Path(folder, "bare")
            shutil.copytree(package, bare / "clatter", ignore=shutil.ignore_patterns("calls.pyi", "commands.pyi", "evidence.pyi", "fields.pyi", "*.so"))
            for path in (package.parent, bare):
                done = subprocess.run([sys.executable, "-m", "mypy", "--strict", "--cache-dir", Path(folder, f"cache-{path.name}"),
                                       "-p", "clatter"], capture_output=True, text=True, cwd=folder, env=dict(os.environ, MYPYPATH=path))
                self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def test_a_wrong_field_or_type_is_found(self):
        right = """import clatter
run = clatter.sequence(angle=10)
impulse: float = run[1].impulse_normal
some: list[clatter.Impact] = run[1:3]
peak: float = clatter.simulate("phone-damped")[0].peak_force
part: float = run[0].impulse_z
error: float | None = run[0].impulse_normal_error
outcome: str = clatter.simulate("phone-damped").outcome
worst: clatter.Record = clatter.report("phone-damped")[0]
peaks: float | None = clatter.report(["phone-damped", "phone-corner"], floor=("concrete", "wood"), floor_restitution=[0.3, 0.5]).answer.peak_g
notes: list[str] = clatter.report("phone-damped", part={"camera": (500, 300)}).answer.notes
losses: clatter.Record | None = run.energy_losses
clatter.map(over={"angle": (1, 60), "restitution": "0.1:1:log"}, quantity="ratio")
clatter.map(over={"angle": (1, 60), "restitution": (0.1, 1)}, quantity="hardest=1", samples=9)
figure = clatter.figure(7, gravity_numbers=1)
chosen: clatter.RowList[clatter.Impact] = run[1:3]
later: clatter.States = run.at([0.1, 0.2])[1:]
ranges: clatter.Atlas = clatter.atlas("phone")
rows: clatter.Rows = clatter.sweep("phone-damped", probe={"camera": (0, 0, 0)}, part="100")
counts: dict[str, dict[str, int]] = clatter.sweep("rod-10", angle=[1, 2], summary=True).texts
"""
        wrong = ["run[1].impulse_norml", "run.outcome + 1", "run[1].impulse_normal.upper()", "run[0].error_estimate.impulse_normal + 1",
                 "run.accuracy.achieve", 'clatter.sequence(angle="x")', 'clatter.plan("rod-10").choice.modle', "run.at(1)[0:1] + 1",
                 'clatter.simulate("phone-damped").outcme', 'clatter.report("rod-10").answr', 'clatter.report("rod-10").answer.peakg',
                 'clatter.shock("rod-10", model="discret")', 'clatter.shock("rod-10", rows="spectra")', 'clatter.sweep("rod-10", rows="impacts")',
                 'clatter.shock("rod-10", axis="w")', 'clatter.shock("rod-10", until=1)', 'clatter.report("rod-10", rate=1)',
                 'clatter.map(over={"angle": (1, 60), "restitution": (0.1, 1)}, quantity="impulse")']
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder, "call.py")
            path.write_text(right + "\n".join(wrong), encoding="utf-8")
            done = subprocess.run([sys.executable, "-m", "mypy", "--strict", "--cache-dir", f"{folder}/cache", path], capture_output=True, text=True,
                                  cwd=folder, env=dict(os.environ, MYPYPATH=str(Path(clatter.__file__).resolve().parents[1])))
        lines = {int(number) for number in re.findall(r"call.py:(\d+): error", done.stdout)}
        first = right.count("\n") + 1
        self.assertEqual(lines, set(range(first, first + len(wrong))), done.stdout + done.stderr)

    def test_quantities_of_maps_are_the_programs(self):
        with self.assertRaisesRegex(clatter.BadInput, f"must be one of {', '.join(typing.get_args(clatter.arguments.MapQuantity))};"):
            clatter.map(over={"angle": (1, 60), "restitution": (0.1, 1)}, quantity="lost")

    def test_what_another_model_has_is_said_to_be_there(self):
        row = clatter.sequence(angle=10)[1]
        with self.assertRaisesRegex(AttributeError, "no 'indentation' in an impact of the discrete model; those of simulate"):
            row.indentation
        with self.assertRaisesRegex(KeyError, "no 'work_friction' .*simulate"):
            row["work_friction"]
        with self.assertRaisesRegex(AttributeError, "no 'corners' .*bodies in space"):
            row.corners
        other = clatter.simulate("phone-damped", impacts=1)[0]
        self.assertTrue(all(name in other for name in clatter.Impact._simulated))
        self.assertTrue(all(name in clatter.sequence("phone-corner")[0] for name in clatter.Impact._in_space))

    def test_fields_are_what_their_stub_says(self):
        """Of all cases: the stub is made from a few results."""
        kinds = {"float": float, "int": int, "str": str, "bool": bool, "Array": np.ndarray, "None": type(None), "ImpactErrors": clatter.ImpactErrors}
        stub = ast.parse((Path(clatter.__file__).parent / "fields.pyi").read_text(encoding="utf-8"))
        fields = {node.name: {line.target.id: ast.unparse(line.annotation).split(" | ") for line in node.body if isinstance(line, ast.AnnAssign)}
                  for node in stub.body if isinstance(node, ast.ClassDef)}
        fields["SimulatedImpact"] = fields["Impact"] | fields["SimulatedImpact"]
        seen = 0
        for case in clatter.cases():
            for call in (clatter.sequence, clatter.simulate):
                try:
                    run = quietly(call, case, impacts=3)
                except clatter.Error:
                    continue
                if not isinstance(run, clatter.Run):
                    continue
                for record in [*run, *(impact.error_estimate for impact in run), run.accuracy, run.cost, *filter(None, [getattr(run, "tail", None)])]:
                    known = fields[type(record).__name__]
                    for name in dict.fromkeys((*record._raw, *filter(str.isidentifier, record))):
                        with self.subTest(case=case, call=call.__name__, field=name):
                            seen += 1
                            self.assertIsInstance(record[name], tuple(kinds[kind] for kind in known[name]))
        self.assertGreater(seen, 2000)

    def test_what_the_stubs_promise_is_there(self):
        folder = Path(clatter.__file__).resolve().parent
        with tempfile.TemporaryDirectory() as scratch:
            # Classes of pybind11 have a metaclass and a constructor of its own.
            known = Path(scratch, "known")
            known.write_text("clatter._clatter.Report\nclatter._clatter.Report.__init__\n", encoding="utf-8")
            for module in (["--allowlist", known, "clatter._clatter"], ["clatter.calls", "--ignore-missing-stub"]):
                done = subprocess.run(["stubtest", *module], capture_output=True, text=True, cwd=scratch, env=dict(os.environ, MYPYPATH=str(folder.parent)))
                self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        # pybind11 writes the signature as the first line of the docstring, which stubtest does not read.
        stub = ast.parse((folder / "_clatter.pyi").read_text(encoding="utf-8"))
        functions = {node.name: [argument.arg for argument in node.args.args] for node in stub.body if isinstance(node, ast.FunctionDef)}
        there = {name: re.findall(r"(\w+): ", getattr(clatter._clatter, name).__doc__.splitlines()[0])
                 for name in dir(clatter._clatter) if callable(getattr(clatter._clatter, name)) and name != "Report"}
        self.assertEqual(functions, there)


class Evidence(unittest.TestCase):
    """Measured drops, the benchmark, extremes and figures; long calls tell how far they are."""

    def test_measured_drops_have_a_name_or_a_file(self):
        path = Path(run_folder.ROOT, "validation/measured/square-drops.csv")
        from_file, by_name = clatter.measured_fit(path), clatter.measured_fit("square-drops")
        self.assertEqual(from_file.to_dict()["fits"], by_name.to_dict()["fits"])
        self.assertEqual((by_name.data.drops, by_name.data.file), (from_file.data.drops, "square-drops"))
        self.assertEqual(by_name.column("restitution").dtype, float)
        with self.assertRaisesRegex(clatter.BadInput, "neither|cannot|not known"):
            clatter.measured_fit("no-such-drops")

    def test_the_benchmark_scores_what_the_program_does(self):
        with tempfile.TemporaryDirectory() as folder:
            right, wrong = Path(folder, "right.csv"), Path(folder, "wrong.csv")
            truth = printed("benchmark", "truth", "rod-10", "--format", "csv", "--bare").splitlines()
            right.write_text(printed("benchmark", "truth", "rod-10", "--format", "csv"), encoding="utf-8")
            wrong.write_text("\n".join(["# problem: rod-10", truth[0], re.sub(r",([^,]*)$", r",9\1", truth[1])]), encoding="utf-8")
            scored = clatter.benchmark_score([right, wrong], require="good")
            self.assertEqual((scored.is_met, clatter.benchmark_score(right, require="exact").is_met), (False, True))
            against = clatter.compare_against("rod-10", [right], gravity=0)
            for result, *words in ((scored, "benchmark", "score", right, wrong, "--require", "good"), (against, "compare", "rod-10", "--gravity", "0", "--against", right)):
                self.assertEqual((result.to_dict(), result.to_text()), (told(*words), printed(*words)))
        with self.assertRaisesRegex(clatter.BadInput, "did you mean"):
            clatter.benchmark_show("rod-1o")

    def test_a_figure_has_the_numbers_of_its_file(self):
        with tempfile.TemporaryDirectory() as folder:
            printed("verify", "--figures", "--only", "7", "--output", folder, "--format", "json")
            self.assertEqual(clatter.figure(7).to_dict(), json.loads(Path(folder, "figure_07.json").read_text(encoding="utf-8")))
        with self.assertRaisesRegex(clatter.BadInput, "there are 7, 8"):
            clatter.figure(13)

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
                done, of = told[-1]
                self.assertTrue(told == sorted(told) and done == of and of == (count or of) > 0, told[-1])

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
