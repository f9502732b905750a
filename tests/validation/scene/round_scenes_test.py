# SPDX-License-Identifier: GPL-3.0-or-later
"""Spheres, ellipsoids and capsules as scenes: keys, what is refused, closed forms, and a flight at 30 digits."""

import math
import unittest

import mpmath

from space_folder import SpaceFolder, turn, words

BALL = ["--body", "sphere", "--radius", "0.1", "--mass", "2"]
EGG = ["--body", "ellipsoid", "--size", "0.06x0.045x0.04", "--mass", "0.06"]
PILL = ["--body", "capsule", "--length", "0.02", "--radius", "0.0035", "--mass", "0.001"]


def ellipsoid_heights(size, mass, velocity, spin, attitude, gravity):
    """h(t) and h'(t) of the lowest point of a uniform ellipsoid that leaves the ground, by Euler's equations and
    e' = e x w; z at the start is such that it touches."""
    d = [mpmath.mpf(x) / 2 for x in size]
    i = [mpmath.mpf(mass) / 5 * sum(d[j] ** 2 for j in range(3) if j != k) for k in range(3)]
    q = [mpmath.mpf(x) for x in attitude]
    norm = mpmath.sqrt(sum(x * x for x in q))
    w, x, y, z = (part / norm for part in q)
    columns = [[1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)],  # body axes in world components
               [2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)],
               [2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)]]
    start = [column[2] for column in columns] + [sum(c * mpmath.mpf(s) for c, s in zip(column, spin)) for column in columns]

    def slope(_, s):
        e, r = s[:3], s[3:]
        return [e[k - 2] * r[k - 1] - e[k - 1] * r[k - 2] for k in range(3)] + [
            (i[k - 2] - i[k - 1]) * r[k - 2] * r[k - 1] / i[k] for k in range(3)]

    motion = mpmath.odefun(slope, 0, start, tol=mpmath.mpf(10) ** -28)
    depth = lambda s: mpmath.sqrt(sum((a * b) ** 2 for a, b in zip(d, s[:3])))
    rise = depth(start)
    return lambda t: rise + t * (velocity[2] - mpmath.mpf(gravity) / 2 * t) - depth(motion(t))


class RoundBodies(SpaceFolder):
    def test_the_second_touch_of_an_ellipsoid_is_the_first_root_of_its_height_at_30_digits(self):
        run = self.json_of("sequence", *EGG, "--attitude", words(turn(2, -40)), "--velocity", "0.2,0.1,-1",
                           "--angular-velocity", "6,9,-4", "--restitution", "0.4", "--friction", "0.2", "--gravity", "9.81",
                           "--impacts", "2")
        first, second = run["impacts"]
        with mpmath.workdps(30):
            height = ellipsoid_heights((0.06, 0.045, 0.04), 0.06, first["velocity_after"], first["angular_velocity_after"],
                                       first["attitude"], 9.81)
            t = mpmath.mpf(second["start"])
            samples = [height(t * k / 200) for k in range(1, 200)]
            self.assertGreater(min(samples), 0)
            root = mpmath.findroot(height, (t, t * (1 + mpmath.mpf(10) ** -9)))
            self.assertLessEqual(abs(root - t), second["error_estimate"]["start"])
            self.assertLessEqual(abs(root - t), 1e-13 * t)

    def test_a_sphere_needs_no_angle_and_a_ball_at_rest_has_bounced_a_geometric_series(self):
        run = self.json_of("sequence", *BALL, "--clearance", "1", "--restitution", "0.5", "--friction", "0.3", "--impacts", "40")
        speed = math.sqrt(2 * 9.81)
        self.assertEqual(run["outcome"], "at-rest")
        self.assertAlmostEqual(run["total_normal_impulse"], 2 * speed * 1.5 / 0.5, delta=1e-12)
        for angle in (0, 37):
            turned = self.json_of("sequence", *BALL, "--clearance", "1", "--restitution", "0.5", "--friction", "0.3",
                                  "--angle", str(angle), "--impacts", "3")["impacts"]
            for one, other in zip(run["impacts"], turned):
                self.assertEqual((one["start"], one["impulse"]), (other["start"], other["impulse"]))

    def test_a_sphere_is_an_ellipsoid_of_equal_axes_and_a_capsule_without_a_cylinder(self):
        drop = ["--angle", "20", "--tangential-velocity", "1", "--spin", "-30", "--restitution", "0.7", "--friction", "0.2",
                "--gravity", "9.81", "--impacts", "5"]
        ball = self.json_of("sequence", *BALL, *drop)["impacts"]
        for other in (["ellipsoid", "--size", "0.2x0.2x0.2"], ["capsule", "--length", "0.2", "--radius", "0.1"]):
            rows = self.json_of("sequence", "--body", *other, "--mass", "2", *drop)["impacts"]
            for one, row in zip(ball, rows, strict=True):
                self.assertEqual({k: v for k, v in one.items() if k not in ("corners", "end")},
                                 {k: v for k, v in row.items() if k not in ("corners", "end")})

    def test_each_command_takes_the_shapes_or_says_in_one_line_why_not(self):
        for body in (BALL, EGG, PILL):
            drop = [*body, "--angle", "30", "--clearance", "0.1", "--restitution", "0.5", "--friction", "0.2"]
            for command in ("sequence", "explain 2", "plan --digits 2 --stiffness 1e9"):
                done = self.run_program(*command.split(), *drop)
                self.assertEqual((done.returncode, bool(done.stdout)), (0, True), (command, done.stderr))
            keys = self.json_of("sequence", *drop)["scene"]["body"]
            self.assertEqual(keys["shape"], body[1])
            self.assertEqual("radius" in keys, "--radius" in body)
            self.assertEqual("length" in keys, "--length" in body)
        for case in ("ball", "capsule", "egg"):
            self.assertTrue(self.json_of("sequence", case)["impacts"], case)
            swept = self.run_program("sweep", case, "--set", "body.mass=0.01:0.03:0.01", "--model", "discrete", "--format", "json")
            self.assertEqual(swept.returncode, 0, swept.stderr)
            self.assertEqual(self.run_program("compare", case, "--impacts", "2").returncode, 0, case)

    def test_what_no_such_body_can_be_is_refused_in_one_line(self):
        for words_of_it, arguments in (
                ("--radius: required", ["sphere"]),
                ("--size: required", ["ellipsoid"]),
                ("--length: required", ["capsule", "--radius", "1"]),
                ("must be at least twice body.radius", ["capsule", "--radius", "1", "--length", "1.9"]),
                ("must be greater than 0", ["sphere", "--radius", "0"]),
                ("only for a box or ellipsoid", ["sphere", "--radius", "1", "--size", "1x1x1"]),
                ("only for a rod or capsule", ["sphere", "--radius", "1", "--length", "1"]),
                ("no axis below 1e-6", ["ellipsoid", "--size", "1x1x1e-7"]),
                ("within the hull", ["sphere", "--radius", "1", "--centre", "0.8,0.8,0"]),
                ("within the hull", ["capsule", "--radius", "1", "--length", "4", "--centre", "1.9,0.5,0"]),
                ("no principal moment larger than m R2", ["sphere", "--radius", "1", "--inertia", "1.1,1.1,1.1"])):
            self.refused(words_of_it, "sequence", "--angle", "10", "--body", *arguments)

    def test_the_continuous_model_drops_their_meshes(self):
        for body in (BALL, EGG, PILL):
            run = self.json_of("simulate", *body, "--angle", "0", "--speed", "1", "--stiffness", "1e11", "--impacts", "1",
                               "--digits", "3")
            self.assertAlmostEqual(run["impacts"][0]["velocity_after"][2], 1, delta=1e-3)
            self.assertLess(abs(run["impacts"][0]["energy_after"] / run["impacts"][0]["energy_before"] - 1), 1e-3)
