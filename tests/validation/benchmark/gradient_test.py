# SPDX-License-Identifier: GPL-3.0-or-later
"""Derivatives in answers of others: those of a rod in 40 digits are exact, and each usual mistake gets its name."""
import json
import pathlib
import tempfile
import unittest

import mpmath
from exact_motion import run, told

mpmath.mp.dps = 40
STEP = mpmath.mpf(10) ** -15
PARAMETERS = ("angle", "speed", "restitution")
NUMBERS = ("t", "Pn", "V", "Omega")


def rod_impacts(scene, **moved):
    """t, Pn, V, Omega (clockwise) of a thin rod without friction, end a or b, of mass and length 1."""
    angle = scene["drop"]["angle_deg"] * mpmath.pi / 180 + moved.get("angle", 0)
    speed, e = scene["drop"]["speed"] + moved.get("speed", 0), scene["impact"]["restitution"] + moved.get("restitution", 0)
    g = scene["world"]["gravity"]
    t, phi, v, w = mpmath.mpf(0), angle, -mpmath.mpf(speed), mpmath.mpf(0)  # w: phi grows
    end, rows = -1, []
    for _ in range(scene["run"]["impacts"]):
        arm = end * mpmath.cos(phi) / 2
        impulse = -(1 + e) * (v + w * arm) / (1 + 12 * arm * arm)
        v, w = v + impulse, w + 12 * impulse * arm
        rows.append((t, impulse, v, -w))
        z = -end * mpmath.sin(phi) / 2

        def height(side, dt):
            return z + v * dt - mpmath.mpf(g) * dt * dt / 2 + side * mpmath.sin(phi + w * dt) / 2

        step, dt, touched = mpmath.mpf("0.002"), mpmath.mpf("0.002"), None
        while touched is None and dt < 3:
            below = [side for side in (-1, 1) if height(side, dt) < 0]
            touched = below[0] if below else None
            dt += step
        if touched is None:
            return rows
        flight = mpmath.findroot(lambda dt: height(touched, dt), (dt - 2 * step, dt - step), solver="anderson", tol=mpmath.mpf(10) ** -70)
        t, phi, v, end = t + flight, phi + w * flight, v - g * flight, touched
    return rows


def rod_derivatives(scene):
    """Of each impact, by column."""
    found = {}
    for parameter in PARAMETERS:
        low, high = (rod_impacts(scene, **{parameter: way * STEP}) for way in (-1, 1))
        for k, number in enumerate(NUMBERS):
            found[f"d{number}/d{parameter}"] = [(b[k] - a[k]) / (2 * STEP) for a, b in zip(low, high)]
    return found


class Gradients(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.file = pathlib.Path(folder.name, "run.csv")

    def judged(self, problem, columns, clockwise=True):
        """The truth's list with columns of derivatives."""
        lines = run("benchmark", "truth", problem, "--format", "csv").stdout.splitlines()
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
        self.file.write_text("\n".join(head + rows) + "\n")
        done = run("benchmark", "score", str(self.file), "--format", "json")
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads(done.stdout)["files"][0]

    def scene(self, problem):
        return told("benchmark", "show", problem)["scene"]

    def test_derivatives_of_40_digits_are_exact(self):
        for problem in ("rod-10", "rod-10-half", "clatter-08"):
            with self.subTest(problem):
                judged = self.judged(problem, rod_derivatives(self.scene(problem)))
                self.assertEqual(judged["verdict"], "exact", judged["findings"])
                self.assertLessEqual(judged["gradient_error"], 1e-9)

    def test_a_list_may_count_omega_the_other_way(self):
        found = rod_derivatives(self.scene("rod-10"))
        turned = {name: [-one for one in column] if name.startswith("dOmega") else column for name, column in found.items()}
        self.assertEqual(self.judged("rod-10", turned, clockwise=False)["verdict"], "exact")
        self.assertEqual(self.judged("rod-10", found, clockwise=False)["verdict"], "fails")

    def test_usual_mistakes_are_named_and_are_no_mistakes_of_the_motion(self):
        found = rod_derivatives(self.scene("rod-10"))
        degree = mpmath.pi / 180
        for column, factor, words in (("dV/dangle", -1, "the other sign"), ("dOmega/dangle", degree, "per degree, not per radian"),
                                      ("dt/dangle", -degree, "per degree, and the other sign"), ("dPn/drestitution", 0, "it is left out"),
                                      ("dV/dspeed", mpmath.mpf("1.01"), "must be")):
            with self.subTest(column, words=words):
                judged = self.judged("rod-10", {column: [factor * one for one in found[column]]})
                self.assertEqual(judged["verdict"], "coarse" if factor == mpmath.mpf("1.01") else "fails")
                self.assertEqual(len(judged["findings"]), 1)
                self.assertTrue(judged["findings"][0].startswith(column), judged["findings"])
                self.assertIn(words, judged["findings"][0])
                self.assertEqual(judged["causes"], [])

    def test_where_there_is_none_a_list_says_so(self):
        """A flat landing has no derivative by the angle."""
        rows = len(told("benchmark", "show", "flat")["truth"])
        self.assertEqual(self.judged("flat", {"dV/dangle": ["none"] * rows})["verdict"], "exact")
        judged = self.judged("flat", {"dV/dangle": [mpmath.mpf(0)] * rows})
        self.assertEqual(judged["verdict"], "fails")
        self.assertIn("there is none: the body lands flat", judged["findings"][0])
        self.assertIn("is none, must be", self.judged("rod-10", {"dV/dangle": ["none"] * 3})["findings"][0])

    def test_a_cell_that_is_no_number_is_refused_in_one_line(self):
        self.file.write_text("# problem: rod-10\n# Omega: clockwise\nt,place,Pn,Pt,V,Omega,dV/dangle\n0,a,1,0,1,1,nan\n")
        done = run("benchmark", "score", str(self.file))
        self.assertEqual((done.returncode, done.stderr.count("\n")), (2, 1))
        self.assertIn(":4:13: dV/dangle = nan: must be a number, or none", done.stderr)

    def test_in_space_they_are_those_of_the_program_and_the_first_follows_from_the_impulse(self):
        """Without friction P is (1 + e) times a number."""
        statement = told("benchmark", "show", "corner")
        self.file.with_suffix(".toml").write_text(statement["scene_toml"])
        rows = [row for row in told("gradient", str(self.file.with_suffix(".toml")))["gradients"] if row["parameter"] == "restitution"]
        first = statement["truth"][0]["Pz"] / (1 + statement["scene"]["impact"]["restitution"])
        columns = {"dPz/drestitution": [mpmath.mpf(first), *(mpmath.mpf(row["impulse_z"]) for row in rows[1:])],
                   "dWx/drestitution": [mpmath.mpf(row["angular_velocity_after_x"]) for row in rows]}
        judged = self.judged("corner", columns)
        self.assertEqual(judged["verdict"], "exact", judged["findings"])
        columns["dPz/drestitution"][0] *= -1
        self.assertIn("dPz/drestitution of impact 1 is -", self.judged("corner", columns)["findings"][0])
