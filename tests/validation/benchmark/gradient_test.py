# SPDX-License-Identifier: GPL-3.0-or-later
"""Derivatives in answers of others: those of a rod in 50 digits are exact, and each usual mistake gets its name."""

import sys
import tomllib

import mpmath
from exact_motion import Asked, printed, scored, told
from mpmath import mp, mpf
from run_folder import ROOT, EmptyFolder

sys.path.insert(0, f"{ROOT}/validation/benchmark")
import truth  # noqa: E402: it is in the folder just named

mp.dps = 50
STEP = mpf(10) ** -15


def rod_impacts(problem, parameter, change):
    """t, Pn, V, Omega (clockwise) of each impact."""
    with open(f"{ROOT}/validation/benchmark/problems/{problem}.toml", "rb") as file:
        data = tomllib.load(file)
    table, key, unit = {"angle": ("drop", "angle_deg", 180 / mp.pi), "speed": ("drop", "speed", 1), "restitution": ("impact", "restitution", 1)}[parameter]
    data[table][key] = truth.number(data[table][key]) + change * unit
    return [(row[0], row[3], row[6], row[8]) for _, row in truth.planar_truth(truth.Scene(data), "newton routh")]


def rod_derivatives(problem):
    """Of each impact, by column."""
    found = {}
    for parameter in ("angle", "speed", "restitution"):
        low, high = (rod_impacts(problem, parameter, way * STEP) for way in (-1, 1))
        for k, number in enumerate(("t", "Pn", "V", "Omega")):
            found[f"d{number}/d{parameter}"] = [(b[k] - a[k]) / (2 * STEP) for a, b in zip(low, high)]
    return found


class Gradients(EmptyFolder):
    def judged(self, problem, columns, clockwise=True):
        """The truth's list with columns of derivatives."""
        lines = printed("benchmark", "truth", problem, "--format", "csv").splitlines()
        head = [line for line in lines if line.startswith("# ") and not line.startswith("# units")]
        rows = [line for line in lines if not line.startswith("#")]
        rows[0] += "," + ",".join(columns)
        for n in range(1, len(rows)):
            rows[n] += "," + ",".join(one[n - 1] if isinstance(one[n - 1], str) else mpmath.nstr(one[n - 1], 17) for one in columns.values())
        if not clockwise:
            head[head.index("# Omega: clockwise")] = "# Omega: counter-clockwise"
            at = rows[0].split(",").index("Omega")
            for n in range(1, len(rows)):
                cells = rows[n].split(",")
                cells[at] = repr(-float(cells[at]))
                rows[n] = ",".join(cells)
        return scored("\n".join(head + rows) + "\n")[0]

    def test_derivatives_of_50_digits_are_exact(self):
        for problem in ("rod-10", "rod-10-half", "clatter-08"):
            with self.subTest(problem):
                judged = self.judged(problem, rod_derivatives(problem))
                self.assertEqual(judged["verdict"], "exact", judged["findings"])
                self.assertLessEqual(judged["gradient_error"], 1e-9)

    def test_a_list_may_count_omega_the_other_way(self):
        found = rod_derivatives("rod-10")
        turned = {name: [-one for one in column] if name.startswith("dOmega") else column for name, column in found.items()}
        self.assertEqual(self.judged("rod-10", turned, clockwise=False)["verdict"], "exact")
        self.assertEqual(self.judged("rod-10", found, clockwise=False)["verdict"], "fails")

    def test_usual_mistakes_are_named_and_are_no_mistakes_of_the_motion(self):
        found = rod_derivatives("rod-10-brisk")
        degree = mpmath.pi / 180
        for column, factor, words in (("dV/dangle", -1, "the other sign"), ("dOmega/dangle", degree, "per degree, not per radian"),
                                      ("dt/dangle", -degree, "per degree, and the other sign"), ("dPn/drestitution", 0, "it is left out"),
                                      ("dV/dspeed", mpmath.mpf("1.01"), "must be")):
            with self.subTest(column, words=words):
                judged = self.judged("rod-10-brisk", {column: [factor * one for one in found[column]]})
                self.assertEqual(judged["verdict"], "coarse" if factor == mpmath.mpf("1.01") else "fails")
                self.assertEqual(len(judged["findings"]), 1)
                self.assertTrue(judged["findings"][0].startswith(column), judged["findings"])
                self.assertIn(words, judged["findings"][0])
                self.assertEqual(judged["causes"], [])

    def test_where_there_is_none_a_list_says_so(self):
        """A flat landing has no derivative by the angle."""
        rows = len(Asked("flat").truth)
        self.assertEqual(self.judged("flat", {"dV/dangle": ["none"] * rows})["verdict"], "exact")
        judged = self.judged("flat", {"dV/dangle": [mpmath.mpf(0)] * rows})
        self.assertEqual(judged["verdict"], "fails")
        self.assertIn("there is none: the body lands flat", judged["findings"][0])
        self.assertIn("is none, must be", self.judged("rod-10", {"dV/dangle": ["none"] * 3})["findings"][0])

    def test_a_cell_that_is_no_number_is_refused_in_one_line(self):
        self.write("run.csv", "# problem: rod-10\n# Omega: clockwise\nt,place,Pn,Pt,V,Omega,dV/dangle\n0,a,1,0,1,1,nan\n")
        self.refused("run.csv:4:13: dV/dangle = nan: must be a number, or none", "benchmark", "score", "run.csv")

    def test_in_space_they_are_those_of_the_program_and_the_first_follows_from_the_impulse(self):
        """Without friction P is (1 + e) times a number."""
        statement = Asked("corner").statement
        rows = [row for row in told("gradient", self.write("corner.toml", statement["scene_toml"]))["gradients"] if row["parameter"] == "restitution"]
        first = statement["truth"][0]["Pz"] / (1 + statement["scene"]["impact"]["restitution"])
        columns = {"dPz/drestitution": [mpmath.mpf(first), *(mpmath.mpf(row["impulse_z"]) for row in rows[1:])],
                   "dWx/drestitution": [mpmath.mpf(row["angular_velocity_after_x"]) for row in rows]}
        judged = self.judged("corner", columns)
        self.assertEqual(judged["verdict"], "exact", judged["findings"])
        columns["dPz/drestitution"][0] *= -1
        self.assertIn("dPz/drestitution of impact 1 is -", self.judged("corner", columns)["findings"][0])
