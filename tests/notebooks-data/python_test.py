# SPDX-License-Identifier: GPL-3.0-or-later
"""The Python module gives what the program gives, in Python's terms.

PYTHONPATH holds the built package, CLATTER_PROGRAM the program, CLATTER_ROOT the source tree.
"""

import ast
import json
import os
import pickle
import re
import shutil
import subprocess
import sys
import tempfile
import threading
import tomllib
import unittest
import warnings
from pathlib import Path

import numpy as np

import clatter

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from waiting import until_it_computes  # noqa: E402

PROGRAM = os.environ["CLATTER_PROGRAM"]
ROOT = Path(os.environ["CLATTER_ROOT"])
CASES = sorted((ROOT / "validation" / "cases").glob("*.toml"))

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
    done = subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, cwd=ROOT)
    assert done.returncode in (0, 1), done.stderr
    return done.stdout


def quietly(function, *arguments, **named):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", clatter.ClatterWarning)
        return function(*arguments, **named)


class TheSameBits(unittest.TestCase):
    """Numbers are compared with ==: shortest round-trip texts give back every bit."""

    def test_sequences_of_twenty_drops_are_the_programs(self):
        for drop in DROPS:
            with self.subTest(drop=drop):
                result = quietly(clatter.sequence, **drop)
                self.assertEqual(result.to_dict(), json.loads(printed("sequence", *typed(drop), "--format", "json")))
                for form in ("table", "csv", "markdown", "latex", "json"):
                    self.assertEqual(result.to_text(form), printed("sequence", *typed(drop), "--format", form))

    def test_runs_of_all_scene_files_are_the_programs(self):
        for case in CASES:
            with self.subTest(case=case.name):
                path = str(case.relative_to(ROOT))
                result = quietly(clatter.simulate, case.stem, impacts=2)
                self.assertEqual(result.to_dict(),
                                 json.loads(printed("simulate", path, "--impacts", "2", "--format", "json")))

    def test_changes_are_the_flags(self):
        result = clatter.simulate("rod-45", angle=30, stiffness=1e9, damping=1e7, sliding_friction=0.2,
                                  static_friction=0.25, method="tvd-rk3", step=2e-5, impacts=1, planar=True, gravity=1.5,
                                  contact_gravity=False)
        self.assertEqual(result.to_dict(), json.loads(printed(
            "simulate", "validation/cases/rod-45.toml", "--angle", "30", "--stiffness", "1e9", "--damping", "1e7",
            "--sliding-friction", "0.2", "--static-friction", "0.25", "--method", "tvd-rk3", "--step", "2e-5",
            "--impacts", "1", "--planar", "--gravity", "1.5", "--no-contact-gravity", "--format", "json")))

    def test_every_flag_of_the_program_is_an_argument(self):
        flags = {word.strip(",") for word in printed("simulate", "--help").split() if word.startswith("--")}
        others = {"--help", "--format", "--output", "--ascii", "--bare", "--history", "--no-contact-gravity", "--plot", "--plot-script",
                  "--window"}
        for flag in flags - others:
            name = flag[2:].replace("-", "_")
            with self.subTest(argument=name), self.assertRaises(clatter.BadInput) as refused:
                clatter.simulate("rod-45", **{name: "no value of anything", "digits": "x"})
            self.assertNotIn("unknown argument", str(refused.exception))

    def test_comparisons_are_the_programs(self):
        for name in ("rod-45", "phone-damped", "rod-friction-sweep"):
            with self.subTest(case=name):
                result = clatter.compare(name, impacts=1)
                text = printed("compare", f"validation/cases/{name}.toml", "--impacts", "1", "--format", "json")
                self.assertEqual(result.to_dict(), json.loads(text))

    def test_sequences_and_explanations_of_scenes_in_space_are_the_programs_whatever_form_the_scene_has(self):
        path = ROOT / "validation" / "cases" / "phone-corner.toml"
        for scene in ("phone-corner", path, tomllib.loads(path.read_text(encoding="utf-8"))):
            result = clatter.sequence(scene, friction=0.3, restitution=0.6)
            data = json.loads(printed("sequence", "phone-corner", "--friction", "0.3", "--restitution", "0.6", "--format", "json"))
            self.assertEqual(result.to_dict()["impacts"], data["impacts"])
            self.assertIn("attitude", data["impacts"][0])
        drop = {"body": "box", "size": (0.1, 0.05, 0.02), "attitude": (0.8, 0.1, -0.3, 0.2 ** 0.5 - 0.2), "velocity": (0.3, 0.2, -1)}
        drop["attitude"] = tuple(np.array(drop["attitude"]) / np.linalg.norm(drop["attitude"]))
        words = ["--" + name + "=" + ("x".join(map(repr, map(float, value))) if isinstance(value, tuple) else value)
                 for name, value in drop.items()]
        self.assertEqual(clatter.sequence(**drop).to_dict(), json.loads(printed("sequence", *words, "--format", "json")))
        derived = clatter.gradient(**drop)
        for form in ("table", "csv", "json"):
            self.assertEqual(derived.to_text(form), printed("gradient", *words, "--format", form))
        self.assertEqual([row.n for row in derived.of("speed")], sorted({row.n for row in derived}))
        with self.assertWarnsRegex(clatter.ClatterWarning, "angle: none: the body lands flat"):
            self.assertEqual(clatter.gradient(0, gravity=9.81, impacts=1).refused[0].parameter, "angle")
        explained = clatter.explain(1, **drop)
        for form in ("table", "csv", "json", "markdown", "latex"):
            self.assertEqual(explained.to_text(form), printed("explain", "1", *words, "--format", form))
        self.assertEqual(list(explained["What the impulse does"]["V′"]), list(clatter.sequence(**drop)[0].velocity_after))
        self.assertEqual(clatter.explain(2, 10).to_text(), printed("explain", "2", "--angle", "10"))

    def test_sweeps_are_the_programs_rows_in_the_plane_and_in_space(self):
        for values in ({"drop.orientation": "1:26:5", "impact.restitution": 0.5}, {"drop.attitude": [1, 0, 0, 0], "drop.speed": "1:3:1"}):
            sets = [word for key, value in values.items() for word in
                    ("--set", f"{key}=" + ("x".join(map(repr, map(float, value))) if isinstance(value, list) else str(value)))]
            mine = clatter.sweep(clatter.case("phone-corner") | {"drop": {"speed": 1}} if "drop.attitude" in values else "phone-corner",
                                 values, model="discrete", rows="impact")
            self.assertGreater(len(mine), 5)
            if "drop.attitude" in values:
                self.assertEqual(set(mine.column("drop.speed")), {1.0, 2.0, 3.0})
                continue
            program = json.loads(printed("sweep", "phone-corner", "--model", "discrete", "--rows", "impact", *sets, "--format", "json"))
            self.assertEqual(mine.to_dict()["rows"], program["rows"])
        few = clatter.sweep("rod-10", {"drop.angle_deg": "5:60", "drop.speed": "0.1:10:log"}, random=20, seed=4, model="discrete")
        again = clatter.sweep("rod-10", {"drop.angle_deg": "5:60", "drop.speed": "0.1:10:log"}, random=20, seed=4, model="discrete")
        self.assertEqual(few.to_dict(), again.to_dict())

    def test_plans_regimes_and_tradeoffs_are_the_programs(self):
        def timeless(value):
            if isinstance(value, dict):
                return {key: timeless(part) for key, part in value.items() if key not in ("seconds", "front", "repeats")}
            return [timeless(part) for part in value] if isinstance(value, list) else value

        for case in ("phone-corner", "phone-damped"):
            mine = clatter.plan(case, digits=3, impacts=2)
            program = json.loads(printed("plan", case, "--digits", "3", "--impacts", "2", "--format", "json"))
            self.assertEqual(timeless(mine.to_dict()["rungs"]), timeless(program["rungs"]))
            self.assertEqual(mine.choice.model, program["choice"]["model"])
        self.assertEqual([rung.model for rung in mine.rungs], ["closed form", "discrete", "discrete 3D", "planar", "spatial"])
        self.assertEqual(clatter.regimes("restitution", from_=0.5, to=1, step=0.25).to_text(),
                         printed("regimes", "--over", "restitution", "--from", "0.5", "--to", "1", "--step", "0.25"))
        self.assertEqual(clatter.regimes().to_dict(), json.loads(printed("regimes", "--format", "json")))
        mine = clatter.tradeoff("phone-corner", impacts=1)
        program = json.loads(printed("tradeoff", "phone-corner", "--impacts", "1", "--format", "json"))
        self.assertEqual(timeless(mine.to_dict()["points"]), timeless(program["points"]))
        self.assertGreater(len(mine.front), 1)

    def test_what_the_new_functions_refuse_names_the_argument(self):
        for words, call in (("impact 0", lambda: clatter.explain(0, 10)), ("given twice", lambda: clatter.sequence(10, angle=20)),
                            ("unknown argument", lambda: clatter.explain(1, 10, frictoin=0.1)),
                            ("drop.angel_deg: unknown key", lambda: clatter.sweep("rod-10", {"drop.angel_deg": "1:2:1"})),
                            ("within '-1'", lambda: clatter.plan("rod-10", within=-1)), ("method: left out", lambda: clatter.plan("rod-10", method="rk4")),
                            ("over", lambda: clatter.regimes("angle")), ("drop.angle_deg", lambda: clatter.sequence({"drop": {"angle_deg": 91}}))):
            with self.subTest(words), self.assertRaisesRegex(clatter.BadInput, words):
                call()
        with self.assertRaises(KeyError):
            clatter.explain(1, 10)["Eq. 99"]

    def test_verification_is_the_programs(self):
        def without_time(data):
            checks = [{key: value for key, value in check.items() if key != "seconds"} for check in data["checks"]]
            return checks, data["passed"], data["failed"]
        mine = clatter.verify(["C1", "E2", "X1"])
        program = json.loads(printed("verify", "--only", "C1", "E2", "X1", "--format", "json"))
        self.assertEqual(without_time(mine.to_dict()), without_time(program))
        self.assertEqual((mine.passed, mine.failed, mine["E2"].answer), (3, 0, "holds"))

    def test_angles_are_the_programs(self):
        for given, flags in (({"step": 2.5}, ["--step", "2.5"]), ({"count": 7, "start": 1, "stop": 60}, ["--count", "7", "--from", "1", "--to", "60"]),
                             ({"gravity": 9.81, "as_printed": True, "restitution": 0.9}, ["--gravity", "9.81", "--as-printed", "--restitution", "0.9"])):
            with self.subTest(given=given):
                rows = json.loads(printed("angles", *flags, "--format", "json"))["rows"]
                for row in rows:
                    del row["error_estimate"]  # the arrays are the numbers alone
                result = clatter.angles(**given)
                for name in rows[0]:
                    expected = np.array([np.nan if row[name] is None else row[name] for row in rows])
                    np.testing.assert_array_equal(result[name], expected)

    def test_angles_of_a_list_are_those_of_each_angle(self):
        theta = [1.0, 27.5, 58.4, 0.1]
        result = clatter.angles(theta)
        self.assertEqual(result.beta_deg.tolist(), [clatter.angles(value).beta_deg[0] for value in theta])


BATCHED = ("beta_deg", "gamma_deg", "P1", "P2", "P3", "T1", "T2", "impacts")


class ArraysOfAngles(unittest.TestCase):
    """What goes through the batch."""

    def test_a_hundred_thousand_angles_are_within_the_error_bars_of_the_list(self):
        for given in ({}, {"restitution": 0.6}, {"gravity_number": 0.7}, {"impulse_ratio": 0.2},
                      {"gravity": 2.0, "restitution": 0.85, "impulse_ratio": -0.1}):
            with self.subTest(given=given):
                theta = np.random.default_rng(7).uniform(0, 90, 20_000)
                many, each = clatter.angles(theta, **given), clatter.angles(theta.tolist(), **given)
                np.testing.assert_array_equal(many.theta_deg, each.theta_deg)
                np.testing.assert_array_equal(many.impacts, each.impacts)
                rows = each.to_dict()["rows"]
                for name in BATCHED[:-1]:
                    there = ~np.isnan(each[name])
                    np.testing.assert_array_equal(np.isnan(many[name]), ~there)
                    # Without a bar only next to a fold.
                    bars = np.array([np.inf if bar is None else bar for bar in (row["error_estimate"][name] for row in rows)])
                    self.assertLess(np.count_nonzero(np.isinf(bars[there])), 3)
                    beyond = there & ~(np.abs(many[name] - each[name]) <= bars)
                    self.assertFalse(beyond.any(), (name, theta[beyond][:3]))
                self.assertGreater(np.count_nonzero(many.impacts == 3), 100)
                self.assertGreater(np.count_nonzero(many.impacts == 1), 100)

    def test_arrays_obey_equations_8_and_12(self):
        theta = np.linspace(0.5, 89.5, 100_000)
        rod = clatter.angles(theta)
        t, beta = np.radians(theta), np.radians(rod.beta_deg)
        struck = rod.impacts > 1
        k = (1 - 3 * np.cos(t) ** 2) / (6 * np.cos(t))
        left = np.sin(t) + k * (t + beta) - np.sin(beta)
        slope = k - np.cos(beta)
        self.assertTrue((np.abs(left)[struck] <= 1e-14 * (1 + np.abs(slope[struck]))).all())
        self.assertAlmostEqual(theta[struck].max(), 58.488442288312, delta=0.001)
        np.testing.assert_allclose(rod.P1, 2 / (1 + 3 * np.cos(t) ** 2), rtol=4e-15)
        # The flight turns the rod by theta + beta at the speed that impulse 1 gives it, 6 P1 cos(theta).
        np.testing.assert_allclose(rod.T1[struck], ((t + beta) / (6 * rod.P1 * np.cos(t)))[struck], rtol=1e-13)
        self.assertTrue(np.isnan(rod.beta_deg[~struck]).all())

    def test_special_angles_in_an_array_are_those_of_the_list(self):
        fold = 58.488442288312
        theta = np.array([0, 90, 1e-9, 1e-300, fold, np.nextafter(fold, 0), 27.577809606636, 89.9999999])
        for given in ({}, {"restitution": 0}, {"gravity_number": 0.5}):
            many, each = clatter.angles(theta, **given), clatter.angles(theta.tolist(), **given)
            for name in BATCHED:
                np.testing.assert_allclose(many[name], each[name], rtol=1e-14, err_msg=f"{name} {given}")

    def test_the_other_columns_and_the_table_are_the_lists(self):
        theta = np.array([10.0, 30, 70])
        many, each = clatter.angles(theta, as_printed=True, gravity=1), clatter.angles(theta.tolist(), as_printed=True, gravity=1)
        for name in ("V1", "Omega3", "impulse_deficit", "beta_printed_deg"):
            np.testing.assert_array_equal(many[name], each[name])
        self.assertEqual(many.to_text("csv"), each.to_text("csv"))
        self.assertEqual(many, clatter.angles(theta, as_printed=True, gravity=1))
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
        with self.assertRaisesRegex(clatter.BadInput, "unless theta is an array"):
            clatter.angles([10], out={})
        with self.assertRaisesRegex(clatter.BadInput, "theta 91"):
            clatter.angles(np.array([10.0, 91]))
        with self.assertRaisesRegex(clatter.BadInput, "theta: excludes start"):
            clatter.angles(theta, start=1)
        with self.assertRaisesRegex(clatter.OutsideModel, "jam"):
            clatter.angles(np.full(9, np.degrees(np.arctan(2))), impulse_ratio=4 / 3)


class ClosedForms(unittest.TestCase):
    """What a user reads off a result, against formulas."""

    def test_attributes_of_a_sequence(self):
        run = clatter.sequence(angle=10)
        cosine = np.cos(np.radians(10))
        self.assertAlmostEqual(run[0].impulse_normal, 2 / (1 + 3 * cosine**2), delta=4e-16)
        self.assertEqual([impact.end for impact in run], ["a", "b", "a"])
        self.assertEqual((len(run), run.outcome, run[-1].n, len(run[:2])), (3, "no-further-impact", 3, 2))
        np.testing.assert_allclose(run.column("impulse_normal").sum(), run.total_normal_impulse, rtol=1e-15)
        self.assertEqual(run.column("velocity_after").shape, (3, 3))
        self.assertTrue(np.isnan(run.column("peak_force")).all())
        self.assertIsNone(run[0].peak_force)

    def test_tail_of_infinitely_many_impacts(self):
        run = clatter.sequence(angle=0, gravity=9.81, restitution=0.5, impacts=20)
        self.assertAlmostEqual(run.tail.end_time, 2 * 0.5 / (9.81 * 0.5), delta=1e-12)
        self.assertIsNone(clatter.sequence(angle=10).tail)

    def test_history_keeps_the_laws(self):
        run = clatter.simulate("phone-damped", impacts=2, history=True, digits=8)
        past = run.history
        mass, gravity = run.scene["body"]["mass"], run.scene["world"]["gravity"]
        self.assertEqual(past.centre.shape, (len(past), 3))
        self.assertEqual(past.attitude.shape, (len(past), 4))
        self.assertTrue((np.diff(past.time) >= 0).all())
        np.testing.assert_allclose(np.linalg.norm(past.attitude, axis=1), 1, atol=1e-14)
        np.testing.assert_allclose(past.energy_potential, mass * gravity * past.centre[:, 2], rtol=1e-12)
        np.testing.assert_allclose(past.energy_translation, mass / 2 * (past.velocity**2).sum(axis=1), rtol=1e-12)
        parts = past.energy_translation + past.energy_rotation + past.energy_potential + past.energy_ground
        np.testing.assert_allclose(past.energy_total, parts, rtol=1e-14)
        self.assertTrue((past.force[~past.in_contact] == 0).all())
        first = past.between(run[0].start, run[0].start + run[0].duration)
        self.assertEqual(first.force[:, 2].max(), run[0].peak_force)
        self.assertTrue(first.in_contact[1:-1].all())
        lost = past.energy_total[0] - past.energy_total[-1]
        self.assertAlmostEqual(lost, sum(impact.energy_loss for impact in run), delta=1e-6 * past.energy_total[0])

    def test_a_sweep_holds_a_run_per_value(self):
        sweep = clatter.simulate("rod-sweep")
        self.assertEqual((sweep.quantity, len(sweep), sweep.values[10]), ("angle_deg", 91, 10))
        impulses = sweep.column("impulse_normal")
        # Flat and upright the rod bounces back as a whole: P = 2 m v, whatever the radius and the contact's duration.
        np.testing.assert_allclose(impulses[[0, 90]], 2, rtol=1e-6)
        # Elastic and frictionless, so V = P - 1 and (V^2 + I Omega^2)/2 stays 1/2, I = (3 r^2 + L^2)/12 = 0.0834 kg m^2.
        speeds = sweep.column("velocity_after")[:, 2]
        np.testing.assert_allclose(speeds, impulses - 1, atol=1e-9)
        spins = sweep.column("angular_velocity_after")[:, 1]
        np.testing.assert_allclose(speeds**2 + (3e-4 + 1) / 12 * spins**2, 1, rtol=2e-3)
        self.assertTrue(np.isnan(sweep.column("impulse_normal", impact=2)).all())


class Forms(unittest.TestCase):
    def test_a_scene_may_be_a_file_a_case_or_a_dict(self):
        path = ROOT / "validation" / "cases" / "rod-45.toml"
        one, two, three = (clatter.simulate(scene, impacts=1).to_dict()
                           for scene in ("rod-45", path, tomllib.loads(path.read_text(encoding="utf-8"))))
        self.assertEqual(one["impacts"], two["impacts"])
        self.assertEqual(one["impacts"], three["impacts"])

    def test_the_scene_of_a_result_gives_the_result_again(self):
        for case in ("every-key", "rod-10", "phone-corner", "box-flat"):
            with self.subTest(case=case):
                run = clatter.simulate(case, impacts=1)
                self.assertEqual(clatter.simulate(run.scene).to_dict()["impacts"], run.to_dict()["impacts"])

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
        self.assertEqual(html.count("<tr>"), 1 + len(run))
        self.assertIn("0.511569", html)
        self.assertIn("Impact 2: end b", repr(run[1]))
        self.assertEqual(run.to_text(ascii=True).encode("ascii").decode(), run.to_text(ascii=True))
        self.assertIn("1000 values", repr(clatter.angles(count=1000)))

    def test_arrays_cannot_be_changed_by_accident(self):
        with self.assertRaises(ValueError):
            clatter.angles().beta_deg[0] = 1


class Errors(unittest.TestCase):
    def refused(self, words, function, *arguments, **named):
        with self.assertRaises(clatter.BadInput) as caught:
            function(*arguments, **named)
        self.assertIn(words, str(caught.exception))
        self.assertNotIn("--", str(caught.exception))

    def test_bad_input_names_the_argument(self):
        self.refused("angle '95': must be from 0 to 90 degrees", clatter.sequence, 95)
        self.refused("angle 'nan'", clatter.sequence, float("nan"))
        self.refused("impulse_ratio 0.1 and friction 0.2", clatter.sequence, 10, impulse_ratio=0.1, friction=0.2)
        self.refused("height '2': must be left out where world.gravity is 0", clatter.sequence, 10, height=2, gravity=0)
        self.refused("restitution_law 'newtn'", clatter.sequence, 10, restitution_law="newtn")
        self.refused("impacts '2.5'", clatter.sequence, 10, impacts=2.5)
        self.refused("closed-form: no longer there", clatter.sequence, 10, method="closed-form")
        self.refused("theta 91", clatter.angles, [10, 91])
        self.refused("theta nan", clatter.angles, [float("nan")])
        self.refused("start 5: must not be greater than stop 3", clatter.angles, start=5, stop=3)
        self.refused("excludes start", clatter.angles, [10], start=1)
        self.refused("did you mean angle?", clatter.simulate, "rod-45", anle=3)
        self.refused("did you mean 'rod-45'?", clatter.simulate, "rod-46")
        self.refused("did you mean ground.stiffness?", clatter.simulate, {"ground": {"stifness": 1}})
        self.refused("ground.stiffness: required", clatter.simulate, {"drop": {"angle_deg": 45}})
        self.refused("digits '33'", clatter.compare, "rod-45", digits=33)
        self.refused("no-such.toml", clatter.simulate, "no-such.toml")
        self.refused("did you mean C1?", clatter.verify, ["C1x"])
        self.refused("format 'xml'", clatter.sequence(10).to_text, "xml")
        self.assertTrue(issubclass(clatter.BadInput, ValueError))

    def test_a_file_is_named_with_the_place(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "bad.toml"
            path.write_text("[drop]\nangle_deg = 91\n[ground]\nstiffness = 1e9\n", encoding="utf-8")
            self.refused(f"{path}:2:13: drop.angle_deg = 91", clatter.simulate, path)

    def test_outside_the_model_and_not_computed_have_their_own_types(self):
        with self.assertRaisesRegex(clatter.OutsideModel, "jam"):
            clatter.sequence(np.degrees(np.arctan(2)), impulse_ratio=4 / 3)
        with self.assertRaisesRegex(clatter.NotComputed, "evaluation-limit"):
            clatter.simulate("rod-45", evaluation_limit=10)

    def test_reservations_are_warnings(self):
        with self.assertWarnsRegex(clatter.ClatterWarning, "energy"):
            clatter.sequence(45, impulse_ratio=0.7)

    def test_no_history_unless_asked(self):
        with self.assertRaisesRegex(AttributeError, "history=True"):
            clatter.simulate("rod-45", impacts=1).history

    def test_an_unknown_name_of_an_impact_lists_the_known(self):
        with self.assertRaisesRegex(AttributeError, "impulse_normal"):
            clatter.sequence(10)[0].momentum


class LongCalls(unittest.TestCase):
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
        expected = clatter.simulate("phone-damped", impacts=2).to_dict()
        results = [None] * 4

        def run(index):
            results[index] = clatter.simulate("phone-damped", impacts=2).to_dict()
        threads = [threading.Thread(target=run, args=(index,)) for index in range(len(results))]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(results, [expected] * len(results))


class Documentation(unittest.TestCase):
    def test_everything_public_is_documented(self):
        for name in clatter.__all__:
            self.assertTrue((getattr(clatter, name).__doc__ or "").strip(), name)

    def test_types_are_sound(self):
        """With the stub that callers see, and without it, the functions themselves."""
        package = Path(clatter.__file__).resolve().parent
        with tempfile.TemporaryDirectory() as folder:
            bare = Path(folder, "bare")
            shutil.copytree(package, bare / "clatter", ignore=shutil.ignore_patterns("calls.pyi", "*.so"))
            for path in (package.parent, bare):
                done = subprocess.run([sys.executable, "-m", "mypy", "--strict", "--cache-dir", Path(folder, f"cache-{path.name}"),
                                       "-p", "clatter"], capture_output=True, text=True, cwd=folder, env=dict(os.environ, MYPYPATH=path))
                self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def test_what_the_stub_promises_is_there(self):
        folder = str(Path(clatter.__file__).resolve().parent.parent)
        with tempfile.TemporaryDirectory() as scratch:
            # Classes of pybind11 have a metaclass and a constructor of its own.
            known = Path(scratch, "known")
            known.write_text("clatter._clatter.Report\nclatter._clatter.Report.__init__\n", encoding="utf-8")
            done = subprocess.run(["stubtest", "--allowlist", known, "clatter._clatter"], capture_output=True, text=True,
                                  cwd=scratch, env=dict(os.environ, MYPYPATH=folder))
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def test_the_stub_names_what_the_compiled_part_has(self):
        compiled = clatter._clatter
        stub = ast.parse(Path(clatter.__file__).with_name("_clatter.pyi").read_text(encoding="utf-8"))
        functions = {node.name: [argument.arg for argument in node.args.args]
                     for node in stub.body if isinstance(node, ast.FunctionDef)}
        # pybind11 writes the signature as the first line of the docstring.
        there = {name: re.findall(r"(\w+): ", getattr(compiled, name).__doc__.splitlines()[0])
                 for name in dir(compiled) if callable(getattr(compiled, name)) and name != "Report"}
        self.assertEqual(functions, there)
