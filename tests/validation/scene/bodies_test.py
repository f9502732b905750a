# SPDX-License-Identifier: GPL-3.0-or-later
"""Bodies: centre and inertia of each, what a closed STL surface encloses, and spheres, ellipsoids and capsules."""

from run_folder import printed
from space_folder import BOX, MASS, SIZE, SpaceFolder, box_moments, words

BALL = ["--body", "sphere", "--radius", "0.1", "--mass", "2"]
EGG = ["--body", "ellipsoid", "--size", "0.06x0.045x0.04", "--mass", "0.06"]
PILL = ["--body", "capsule", "--length", "0.02", "--radius", "0.0035", "--mass", "0.001"]


class Mass(SpaceFolder):
    def test_a_box_with_its_own_centre_and_inertia_falls_the_same(self):
        own = ["--centre", "0,0,0", "--inertia", words(box_moments(SIZE, MASS))]
        for command in (["simulate", *BOX, "--digits", "9"], ["sequence", *BOX[:6]]):
            plain, given = (self.json_of(*command, "--angle", "20", "--impacts", "2", *more) for more in ([], own))
            for a, b in zip(plain["impacts"], given["impacts"], strict=True):
                for key in ("start", "impulse_normal", "contact_angle_deg"):
                    self.assertAlmostEqual(a[key], b[key], delta=1e-8 * (1 + abs(a[key])))
            for key in ("centre", "extents"):
                self.assertEqual(plain["body"][key], given["body"][key])

    def test_impossible_bodies_are_refused_with_one_line_that_says_why(self):
        size = ["--body", "box", "--size", "0.2x0.1x0.1", "--angle", "10"]
        for command in (["sequence"], ["simulate", "--stiffness", "1e9"]):
            self.each_refused({"--inertia 1e-4,1e-4,3e-4": "larger than the sum of the other two", "--inertia 1,1": "three principal moments",
                               "--inertia 1e-3,1e-3,1e-3,2e-3,0,0": "positive definite", "--inertia 0.1,0.1,0.1": "larger than m R2",
                               "--centre 0.11,0,0": "within the hull", "--centre 0,0,0,0": "three coordinates"}, *command, *size)
        rod = ["--angle", "10", "--length", "0.2"]
        self.refused("within the hull", "sequence", *rod, "--centre", "0,0,1e-6")
        self.refused("within the hull", "sequence", *rod, "--radius", "0.01", "--centre", "0,0.008,0.008")
        self.assertEqual(self.json_of("sequence", *rod, "--centre", "0.05,0,0", "--inertia", "0,1e-3,1e-3")["body"]["centre"], [0.05, 0, 0])
        self.write("meshed.toml", self.read("scene.toml").replace("0.25, 0.25, 0.25", "0.4, 0.4, 0.4"))
        self.refused("meshed.toml: body.centre = [0.4,0.4,0.4]: must be within the hull", "simulate", "meshed.toml")

    def test_the_mass_of_an_stl_is_given_or_follows_from_its_density(self):
        head, tail = "[drop]\nangle_deg = 10\n[body]\nshape = 'mesh'\n", "[ground]\nstiffness = 1e8\n[run]\nimpacts = 1\ndigits = 3\n"
        bodies = []
        for name, keys in (("mass.toml", "mass = 0.5\nmesh = { file = 'body.stl', unit = 2 }\n"),
                           ("density.toml", "mesh = { file = 'body.stl', unit = 2, density = 0.375 }\n")):  # of 2^3/6 m^3
            self.write(name, head + keys + tail)
            bodies.append(self.json_of("simulate", name)["body"])
        for body in bodies:
            self.assertAlmostEqual(body["mass"], 0.5, delta=1e-15)
            self.assertEqual(body["extents"], [2, 2, 2])
            for a, b in zip(body["inertia"], [3 * 0.5 * 8 / 80] * 3 + [0.5 * 4 / 80] * 3):  # xx = 3 m (b² + c²)/80, xy = m ab/80
                self.assertAlmostEqual(a, b, delta=1e-15)
        self.write("none.toml", head + "mesh = { file = 'body.stl' }\n" + tail)
        self.refused("body.mass: required, or body.mesh.density", "simulate", "none.toml")
        self.write("body.stl", "\n".join(line for k, line in enumerate(self.read("body.stl").splitlines()) if k != 4))
        self.refused("body.stl", "simulate", "mass.toml")

    def test_every_output_prints_mass_extents_centre_and_principal_inertia(self):
        scene = ["--angle", "20", *BOX, "--centre", "0.01,0,0", "--impacts", "1", "--digits", "3"]
        moments = sorted(box_moments(SIZE, MASS))
        for command in (["simulate"], ["sequence"], ["explain", "1"], ["compare"], ["plan"]):
            given = [w for w in scene if command[0] in ("simulate", "compare", "plan") or w not in ("--stiffness", "1e9")]
            body = self.json_of(*command, *given)["body"]
            self.assertEqual((body["extents"], body["centre"]), (list(SIZE), [0.01, 0, 0]))
            self.assertAlmostEqual(body["mass"], MASS, delta=1e-15)
            for a, b in zip(body["principal_inertia"], moments):
                self.assertAlmostEqual(a / b, 1, delta=1e-12)
            self.assertIn("body: mass 0.08814 kg, extents 0.10566 × 0.04394 × 0.01905 m, centre of mass (0.01, 0, 0) m, principal inertia",
                          " ".join(self.run_program(*command, *given).stdout.split()), command)


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
            for command in ("explain 2", "plan --digits 2 --stiffness 1e9"):
                printed(*command.split(), *drop)
            keys = self.json_of("sequence", *drop)["scene"]["body"]
            self.assertEqual((keys["shape"], "radius" in keys, "length" in keys), (body[1], "--radius" in body, "--length" in body))
        for case in ("ball", "capsule", "egg"):
            self.assertTrue(self.json_of("sequence", case)["impacts"], case)
            printed("sweep", case, "--set", "body.mass=0.01:0.03:0.01", "--model", "discrete")
            printed("compare", case, "--impacts", "2")

    def test_what_no_such_body_can_be_is_refused_in_one_line(self):
        self.each_refused({
            "sphere": "--radius: required", "ellipsoid": "--size: required", "capsule --radius 1": "--length: required",
            "capsule --radius 1 --length 1.9": "must be at least twice body.radius", "sphere --radius 0": "must be greater than 0",
            "sphere --radius 1 --size 1x1x1": "only for a box or ellipsoid", "sphere --radius 1 --length 1": "only for a rod or capsule",
            "ellipsoid --size 1x1x1e-7": "no axis below 1e-6", "sphere --radius 1 --centre 0.8,0.8,0": "within the hull",
            "capsule --radius 1 --length 4 --centre 1.9,0.5,0": "within the hull",
            "sphere --radius 1 --inertia 1.1,1.1,1.1": "no principal moment larger than m R2"}, "sequence", "--angle", "10", "--body")
