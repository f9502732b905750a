# SPDX-License-Identifier: GPL-3.0-or-later
"""clatter explain of a drop in space: each number that it shows against laws of mechanics put into numbers here."""

import math

import mpmath
from run_folder import printed
from space_folder import CENTRE, INERTIA, MASS, SIZE, SpaceFolder, box_moments, rotated, times, turned_back, words

PHONE = ["--body", "box", "--size", "x".join(map(str, SIZE)), "--mass", str(MASS)]
CORNER = [*PHONE, "--angle", "40", "--tilt", "25"]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


class Explained(SpaceFolder):
    def values_of(self, n, *arguments):
        """By the title of a step and the name of an equation."""
        return {step["title"]: {e["name"]: e["value"] for e in step["equations"]} for step in self.json_of("explain", str(n), *arguments)["steps"]}

    def rows(self, n, *arguments):
        return self.json_of("sequence", *arguments, "--impacts", str(n))["impacts"]

    def test_an_impact_is_compared_with_the_one_before_by_the_factors_of_its_impulse(self):
        # A thin rod's point of contact feels the mass m/(1 + 3 cos²θ).
        for given in (["--angle", "10"], ["--angle", "20", "--gravity", "9.81", "--restitution", "0.7"]):
            rows = self.rows(3, *given)
            self.assertIsNone(self.json_of("explain", "1", *given)["beside_last"])
            for n in (2, 3):
                last, now = rows[n - 2], rows[n - 1]
                said = self.json_of("explain", str(n), *given)["beside_last"]
                felt = [1 / (1 + 3 * math.cos(math.radians(row["contact_angle_deg"])) ** 2) for row in (last, now)]
                expected = {"impact": n - 1, "normal_impulse": now["impulse_normal"] / last["impulse_normal"], "effective_mass": felt[1] / felt[0],
                            "approach_speed": now["approach_speed"] / last["approach_speed"], "one_plus_restitution": 1}
                for name, value in expected.items():
                    self.assertAlmostEqual(said[name], value, delta=1e-12 * value, msg=(given, n, name))
                self.assertAlmostEqual(said["approach_speed"] * said["effective_mass"], said["normal_impulse"], delta=1e-12)
        # A face that lands as a whole has no one point whose speed and mass could be compared.
        self.assertIsNone(self.json_of("explain", "2", *PHONE, "--angle", "0", "--gravity", "9.81")["beside_last"])

    def test_the_torque_free_rotation_is_told_by_its_invariants_its_modulus_and_its_period(self):
        for given in ([], ["--centre", words(CENTRE), "--inertia", words(INERTIA)], ["--restitution", "0.5", "--friction", "0.8", "--gravity", "9.81"]):
            steps = self.values_of(2, *CORNER, *given)
            shown = steps["Rotation without torque"]
            first = self.rows(1, *CORNER, *given)[0]
            rate = turned_back(first["attitude"], first["angular_velocity_after"])
            spin = times(INERTIA if given[:1] == ["--centre"] else [*box_moments(SIZE, MASS), 0, 0, 0], rate)
            energy, square = dot(rate, spin), dot(spin, spin)
            self.assertAlmostEqual(2 * shown["E_r"], energy, delta=1e-13 * energy)
            self.assertAlmostEqual(shown["L"], math.sqrt(square), delta=1e-13 * math.sqrt(square))
            a, b, c = sorted(shown[name] for name in ("I₁", "I₂", "I₃"))
            if square < energy * b:  # L circles the axis of the least moment
                a, c = c, a
            k2 = (b - a) * (energy * c - square) / ((c - b) * (square - energy * a))
            rate = math.sqrt((c - b) * (square - energy * a) / (a * b * c))
            period = 4 * math.pi / (2 * float(mpmath.agm(1, math.sqrt(1 - k2)))) / rate
            self.assertAlmostEqual(shown["k²"], k2, delta=1e-11)
            self.assertAlmostEqual(shown["T_p"], period, delta=1e-10 * period)
            start = self.rows(2, *CORNER, *given)[1]["start"]
            self.assertAlmostEqual(steps["The earliest corner"]["N"] * shown["T_p"], start, delta=1e-12)

    def test_the_corner_that_is_said_to_come_first_is_on_the_ground_at_the_root_and_the_next_one_as_high_as_said(self):
        for given in ([], ["--gravity", "9.81", "--restitution", "0.6"], ["--friction", "0.4", "--spin", "20"]):
            steps = self.values_of(2, *CORNER, *given)
            start, shown = steps["The flight to impact 2"], steps["The earliest corner"]
            touch = self.rows(2, *CORNER, *given)[1]
            gravity = 9.81 if "--gravity" in given else 0.0
            time = shown["T"]
            self.assertTrue(shown["T_low"] <= time <= shown["T_high"])
            height = start["z₁"] + start["V₁"][2] * time - gravity * time * time / 2
            self.assertAlmostEqual(shown["z"], height, delta=1e-14)
            corners = [[s * l / 2 for s, l in zip((i, j, k), SIZE)] for i in (-1, 1) for j in (-1, 1) for k in (-1, 1)]
            heights = sorted(height + rotated(touch["attitude"], corner)[2] for corner in corners)
            self.assertAlmostEqual(heights[0], 0, delta=1e-14)
            self.assertAlmostEqual(steps["The corner"]["h"], 0, delta=1e-14)
            self.assertAlmostEqual(shown["h_next"], heights[1], delta=1e-14)
            self.assertAlmostEqual(steps["The corner"]["v"][2], -touch["approach_speed"], delta=1e-12)

    def test_a_face_shows_where_the_resultant_of_its_pushes_lies(self):
        spun = self.values_of(1, *PHONE, "--attitude", "1,0,0,0", "--angular-velocity", "3,-2,1")["Corners at once"]
        xx, yy, _ = box_moments(SIZE, MASS)
        # Each part of the turning is reversed: M = −2 I ω, P = 2 m v.
        self.assertAlmostEqual(spun["x"], -(-2 * yy * -2) / (2 * MASS), delta=1e-15)
        self.assertAlmostEqual(spun["y"], -2 * xx * 3 / (2 * MASS), delta=1e-15)
        self.assertAlmostEqual(spun["ω′"][2], 1, delta=1e-15)

    def test_a_round_rod_on_its_rim_and_a_body_that_does_not_turn_are_explained_too(self):
        for body, words in ((["--radius", "0.02", "--angle", "30"], "corner b"), ([*PHONE, "--angle", "0", "--gravity", "9.81"], "fixed axis")):
            self.assertIn(words, self.run_program("explain", "2", *body, "--velocity=0,0.1,-1").stdout)

    def test_what_rounding_decides_is_shown_as_unknown(self):
        edge = [*PHONE, "--angle", "0", "--tilt", "1e-5"]
        self.assertFalse(self.rows(2, *edge)[1]["predictable"])
        text = self.run_program("explain", "2", *edge).stdout
        self.assertIn("= ? J, energy after", text)
        errors = {e["name"]: e["error"] for step in self.json_of("explain", "2", *edge)["steps"] for e in step["equations"]}
        self.assertEqual([errors[name] for name in ("V", "ω", "V′", "ω′", "E′")], [None] * 5)

    def test_an_impact_in_space_that_does_not_happen_is_explained_by_the_end_of_the_sequence(self):
        for words in ("Impact 9 does not happen", "no-further-impact"):
            self.assertIn(words, printed("explain", "9", *CORNER))
        self.assertIn("does not happen", printed("explain", "2", "--angle", "80"))

    def test_every_form_of_an_explanation_has_all_its_equations(self):
        given = [*CORNER, "--friction", "0.3", "--gravity", "9.81"]
        steps = self.json_of("explain", "2", *given)["steps"]
        equations = [e for step in steps for e in step["equations"]]
        laws = sum(len(step["laws"]) for step in steps)
        texts = {form: self.run_program("explain", "2", *given, "--format", form).stdout for form in ("table", "csv", "markdown", "latex")}
        numbers = sum(len(e["value"]) * (len(e["value"][0]) if isinstance(e["value"][0], list) else 1) if isinstance(e["value"], list) else 1
                      for e in equations)
        self.assertEqual(len([line for line in texts["csv"].splitlines() if not line.startswith("#")]), numbers + 1)
        self.assertEqual(texts["markdown"].count("\n- `"), len(equations))
        self.assertEqual(texts["markdown"].count("\n> `"), laws)
        names = [e["tex"].split(" &= ")[0] for e in equations]
        for name in names:
            self.assertIn(f"\n  {name} &= ", texts["latex"])
        self.assertEqual(texts["latex"].count("\\paragraph"), len(steps))
        body = "\n".join(line for line in texts["latex"].splitlines() if not line.startswith("%"))
        self.assertEqual([c for c in body if ord(c) > 127], [])  # nothing that LaTeX would not print
