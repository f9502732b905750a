# SPDX-License-Identifier: GPL-3.0-or-later
"""Spheres, ellipsoids and capsules as scenes: keys, what is refused, shapes that are the same."""

from space_folder import SpaceFolder

BALL = ["--body", "sphere", "--radius", "0.1", "--mass", "2"]
EGG = ["--body", "ellipsoid", "--size", "0.06x0.045x0.04", "--mass", "0.06"]
PILL = ["--body", "capsule", "--length", "0.02", "--radius", "0.0035", "--mass", "0.001"]


class RoundBodies(SpaceFolder):
    def test_a_sphere_is_an_ellipsoid_of_equal_axes_and_a_capsule_without_a_cylinder(self):
        drop = ["--angle", "20", "--tangential-velocity", "1", "--spin", "-30", "--restitution", "0.7", "--friction", "0.2",
                "--gravity", "9.81", "--impacts", "5"]
        ball = self.json_of("sequence", *BALL, *drop)["impacts"]
        for other in (["ellipsoid", "--size", "0.2x0.2x0.2"], ["capsule", "--length", "0.2", "--radius", "0.1"]):
            rows = self.json_of("sequence", "--body", *other, "--mass", "2", *drop)["impacts"]
            for one, row in zip(ball, rows, strict=True):
                self.assertEqual({k: v for k, v in one.items() if k not in ("corners", "end")},
                                 {k: v for k, v in row.items() if k not in ("corners", "end")})

    def test_a_sphere_needs_no_angle(self):
        bounces = ["sequence", *BALL, "--clearance", "1", "--restitution", "0.5", "--friction", "0.3"]
        run, turned = (self.json_of(*bounces, *more) for more in (["--impacts", "40"], ["--angle", "37", "--impacts", "3"]))
        self.assertEqual(run["outcome"], "at-rest")
        for one, other in zip(run["impacts"], turned["impacts"]):
            self.assertEqual((one["start"], one["impulse"]), (other["start"], other["impulse"]))

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
        self.each_refused({
            "sphere": "--radius: required", "ellipsoid": "--size: required", "capsule --radius 1": "--length: required",
            "capsule --radius 1 --length 1.9": "must be at least twice body.radius", "sphere --radius 0": "must be greater than 0",
            "sphere --radius 1 --size 1x1x1": "only for a box or ellipsoid", "sphere --radius 1 --length 1": "only for a rod or capsule",
            "ellipsoid --size 1x1x1e-7": "no axis below 1e-6", "sphere --radius 1 --centre 0.8,0.8,0": "within the hull",
            "capsule --radius 1 --length 4 --centre 1.9,0.5,0": "within the hull",
            "sphere --radius 1 --inertia 1.1,1.1,1.1": "no principal moment larger than m R2"}, "sequence", "--angle", "10", "--body")

    def test_the_continuous_model_drops_their_meshes(self):
        for body in (BALL, EGG, PILL):
            run = self.json_of("simulate", *body, "--angle", "0", "--speed", "1", "--stiffness", "1e11", "--impacts", "1",
                               "--digits", "3")
            self.assertAlmostEqual(run["impacts"][0]["velocity_after"][2], 1, delta=1e-3)
            self.assertLess(abs(run["impacts"][0]["energy_after"] / run["impacts"][0]["energy_before"] - 1), 1e-3)
