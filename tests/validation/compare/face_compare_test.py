# SPDX-License-Identifier: GPL-3.0-or-later
"""clatter compare of faces that land level, slide and turn, against a plate on an even bed that is integrated here."""

import math

import numpy as np

from space_folder import SpaceFolder, box_moments, words

MOTION = [f"{name}_after_{axis}" for name in ("velocity", "angular_velocity") for axis in "xyz"]
MASS, FRICTION, STIFFNESS = 0.18, 0.3, 1e9
HALF = 1.4327505332713744  # c_G v/k_G at which a contact of F = (k + c δ̇) δⁿ has e = 0.5, whatever n
THIN, THICK = (0.14, 0.07, 0.008), (0.14, 0.07, 0.07)


def on_an_even_bed(size, depth, velocity, spin, damping=HALF, cells=24, steps=1500):
    """Motion of a level box after it lands on a Winkler bed with Coulomb friction at each point, k → ∞: heave and tilt
    are small, the attitude stays.  Gauss's rule over the face, Runge and Kutta's of order 4 in time; friction's
    direction s/√(|s|² + ε²) with ε = 1e-4 of the speed, which and the pole inside the face leave an error of 1e-3."""
    nodes, weights = np.polynomial.legendre.leggauss(cells)
    x, y = (0.5 * side * n.ravel() for side, n in zip(size, np.meshgrid(nodes, nodes)))
    spring = MASS * np.outer(weights, weights).ravel() / 4  # heave has the angular frequency 1
    inertia = np.array(box_moments(size, MASS))
    slow = 1e-4 * np.linalg.norm(velocity)

    def rate(state):
        (z, tilt_x, tilt_y), (vx, vy, vz), (wx, wy, wz) = state.reshape(3, 3)
        indentation, sinking = tilt_y * x - tilt_x * y - z, wy * x - wx * y - vz
        push = spring * np.maximum(indentation, 0) * np.maximum(1 + damping * sinking, 0)
        slip_x, slip_y = vx - depth * wy - wz * y, vy + depth * wx + wz * x
        rub = -FRICTION * push / np.sqrt(slip_x**2 + slip_y**2 + slow**2)
        fx, fy = rub * slip_x, rub * slip_y
        moment = [(y * push + depth * fy).sum(), -(x * push + depth * fx).sum(), (x * fy - y * fx).sum()]
        force = np.array([fx.sum(), fy.sum(), push.sum()])
        return np.concatenate([[vz, wx, wy], force / MASS, moment / inertia])

    state, h = np.array([0, 0, 0, *velocity, 0, 0, spin], dtype=float), math.pi / steps
    for step in range(6 * steps):
        a = rate(state)
        if step > steps and a[5] == 0:
            break
        b = rate(state + h / 2 * a)
        c = rate(state + h / 2 * b)
        state = state + h / 6 * (a + 2 * b + 2 * c + rate(state + h * c))
    return state[3:]


class Faces(SpaceFolder):
    def landing(self, *body, velocity=(0.3, 0, -1), spin=20, turning="0,0", given=()):
        done = self.json_of("compare", *body, "--mass", repr(MASS), "--velocity=" + words(velocity), "--angular-velocity",
                            f"{turning},{spin}", "--impacts", "1", "--stiffness", repr(STIFFNESS), "--damping", repr(HALF * STIFFNESS),
                            "--static-friction", repr(FRICTION), "--sliding-friction", repr(FRICTION), *given, status=(0,))
        return done["impacts"][0]

    def box(self, size, **more):
        return self.landing("--body", "box", "--size", "x".join(map(repr, size)), "--angle", "0", **more)

    def largest_gap(self, impact, numbers):
        """Of the limit from these numbers, V and then ω times half the length."""
        lever = [1] * 3 + [THIN[0] / 2] * 3
        return max(abs(impact["numbers"][name]["limit"] - number) * by for name, number, by in zip(MOTION, numbers, lever))

    def discrete(self, impact):
        return [impact["numbers"][name]["discrete"] for name in MOTION]

    def test_a_face_with_the_centre_of_mass_in_it_has_the_rule_as_its_limit_to_the_last_digits(self):
        for velocity, spin in (((0.3, 0, -1), 20), ((0.05, 0.2, -1), -9), ((0.6, 0.1, -1), 0.3)):
            impact = self.box(THIN, velocity=velocity, spin=spin, given=["--centre=0,0,-0.004"])
            self.assertTrue(impact["limit_is_discrete"])
            self.assertIsNone(impact["explanation"])
            self.assertLessEqual(self.largest_gap(impact, self.discrete(impact)), 1e-11)
            self.assertLessEqual(self.largest_gap(impact, on_an_even_bed(THIN, 0, velocity, spin)), 2e-3)

    def test_a_face_that_stops_has_its_limit_up_to_what_the_runs_know_of_its_end(self):
        impact = self.box(THIN, velocity=(0.03, 0, -1), spin=2, given=["--centre=0,0,-0.004"])
        self.assertTrue(impact["limit_is_discrete"])
        self.assertEqual(impact["numbers"]["angular_velocity_after_z"]["discrete"], 0)
        self.assertLessEqual(self.largest_gap(impact, self.discrete(impact)), 1e-5)

    def test_a_thin_plate_agrees_up_to_its_tipping(self):
        for spin, tolerance in ((0, 1e-3), (20, 2e-4)):
            impact = self.box(THIN, spin=spin)
            self.assertTrue(impact["limit_is_discrete"])
            self.assertRegex(impact["explanation"], "tips the body on an even bed")
            self.assertLessEqual(self.largest_gap(impact, on_an_even_bed(THIN, 0.004, (0.3, 0, -1), spin)), tolerance)
        for name, number in zip(MOTION, (0.1649, -0.0025, 0.5, 0, 0, 11.333)):
            self.assertLessEqual(abs(impact["numbers"][name]["discrete"] - number), 1e-3, name)
        allowed = impact["numbers"]["angular_velocity_after_z"]["allowance"]
        self.assertLessEqual(allowed, 0.01 * 20)  # an answer that keeps its spin would be found

    def test_a_thick_body_is_told_how_far_the_rule_is_from_an_even_bed(self):
        impact = self.box(THICK)
        self.assertIsNone(impact["limit_is_discrete"])
        self.assertRegex(impact["explanation"], r"on an even bed up to 0\.0\d+ of the scale off .*friction, far below the centre")
        self.assertLessEqual(self.largest_gap(impact, on_an_even_bed(THICK, 0.035, (0.3, 0, -1), 20)), 1e-3)
        self.assertGreaterEqual(self.largest_gap(impact, self.discrete(impact)), 0.02)

    def test_a_face_that_comes_down_turning_over_is_told_its_limit_too(self):
        impact = self.box(THIN, turning="0.5,0.2")
        self.assertIsNone(impact["limit_is_discrete"])
        self.assertRegex(impact["explanation"], r"on an even bed up to 0\.\d+ of the scale off .*4 corners land at once.*outcomes")

    def test_a_disc_agrees_with_the_corners_of_its_mesh(self):
        self.assertTrue(self.landing("--body", "rod", "--radius", "0.05", "--length", "0.01", "--angle", "90")["limit_is_discrete"])
