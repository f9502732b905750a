# SPDX-License-Identifier: GPL-3.0-or-later
"""Centre and inertia of every body, and what a closed STL surface encloses."""

import math
import unittest

from space_folder import BOX, MASS, SIZE, SpaceFolder, box_moments, words


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

    def test_the_first_impulse_of_a_box_with_its_mass_off_centre_is_that_of_its_corner(self):
        # P = 2 u/(1/m + d_t²/I), d_t the horizontal arm from the centre of mass to corner a.
        for x, z, inertia in ((0.02, 0, None), (-0.03, 0.004, 9e-5), (0, -0.005, 1.1e-4)):
            moments = box_moments(SIZE, MASS)
            given = ["--centre", words((x, 0, z))]
            if inertia:
                moments[1] = inertia
                given += ["--inertia", words(moments)]
            sine, cosine = math.sin(math.radians(20)), math.cos(math.radians(20))
            arm = (-SIZE[0] / 2 - x) * cosine - (-SIZE[2] / 2 - z) * sine
            expected = 2 * 1.5 / (1 / MASS + arm * arm / moments[1])
            run = self.json_of("sequence", "--angle", "20", "--speed", "1.5", *BOX[:6], *given, "--impacts", "1")
            self.assertAlmostEqual(run["impacts"][0]["impulse_normal"] / expected, 1, delta=1e-13)

    def test_both_models_agree_on_bodies_with_their_mass_off_centre(self):
        moments = box_moments(SIZE, MASS)
        shapes = [[*BOX[:6], "--centre", "0.01,0,0.002"], [*BOX[:6], "--centre=-0.02,0,-0.003", "--inertia", words(moments)],
                  ["--body", "rod", "--length", "0.3", "--radius", "0.01", "--centre", "0.05,0,0", "--inertia", "1e-4,0.006,0.006"]]
        for shape in shapes:
            done = self.json_of("compare", *shape, "--angle", "20", "--stiffness", "1e9", "--damping", "1e4", "--impacts", "2", status=(0,))
            self.assertTrue(done["impacts"][0]["numbers"], shape)

    def test_impossible_bodies_are_refused_with_one_line_that_says_why(self):
        size = ["--body", "box", "--size", "0.2x0.1x0.1", "--angle", "10"]
        bad = {"larger than the sum of the other two": ["--inertia", "1e-4,1e-4,3e-4"],
               "positive definite": ["--inertia", "1e-3,1e-3,1e-3,2e-3,0,0"],
               "larger than m R2": ["--inertia", "0.1,0.1,0.1"],
               "within the hull": ["--centre", "0.11,0,0"],
               "three principal moments": ["--inertia", "1,1"],
               "three coordinates": ["--centre", "0,0,0,0"]}
        for why, given in bad.items():
            self.refused(why, "sequence", *size, *given)
            self.refused(why, "simulate", *size, "--stiffness", "1e9", *given)
        rod = ["--angle", "10", "--length", "0.2"]
        self.refused("within the hull", "sequence", *rod, "--centre", "0,0,1e-6")
        self.refused("within the hull", "sequence", *rod, "--radius", "0.01", "--centre", "0,0.008,0.008")
        self.assertEqual(self.json_of("sequence", *rod, "--centre", "0.05,0,0", "--inertia", "0,1e-3,1e-3")["body"]["centre"], [0.05, 0, 0])
        self.write("meshed.toml", self.read("scene.toml").replace("0.25, 0.25, 0.25", "0.4, 0.4, 0.4"))
        self.refused("meshed.toml: body.centre = [0.4,0.4,0.4]: must be within the hull", "simulate", "meshed.toml")

    def test_a_closed_stl_has_the_closed_form_mass_properties_of_its_tetrahedron(self):
        # Edges 2, 2 and 2 along the axes: m = ρ abc/6, centre at a/4, xx = 3 m (b² + c²)/80, xy = m ab/80.
        stl = self.read("body.stl")
        exact = [3 * 0.5 * 8 / 80] * 3 + [0.5 * 4 / 80] * 3
        for unit, given, mass in ((2, "mass = 0.5", 0.5), (2, "density", 0.5)):
            density = ", density = %r" % (0.5 / (8 / 6)) if given == "density" else ""
            self.write("body.stl", stl)
            self.write("tetrahedron.toml", "[drop]\nangle_deg = 10\n[body]\nshape = 'mesh'\n%s\nmesh = { file = 'body.stl', unit = %r%s }\n"
                       "[ground]\nstiffness = 1e8\n[run]\nimpacts = 1\ndigits = 3\n" % ("" if density else given, unit, density))
            body = self.json_of("simulate", "tetrahedron.toml")["body"]
            self.assertAlmostEqual(body["mass"], mass, delta=1e-15)
            self.assertEqual(body["extents"], [2, 2, 2])
            for a, b in zip(body["centre"], (0.5, 0.5, 0.5)):
                self.assertAlmostEqual(a, b, delta=1e-15)
            for a, b in zip(body["inertia"], exact):
                self.assertAlmostEqual(a, b, delta=1e-15)
            # Eigenvalues of a(1 + …): xx + 2 xy once, xx − xy twice.
            for a, b in zip(body["principal_inertia"], sorted((exact[0] - exact[3], exact[0] - exact[3], exact[0] + 2 * exact[3]))):
                self.assertAlmostEqual(a, b, delta=1e-15)

    def test_an_stl_without_mass_or_that_is_open_or_inside_out_is_refused(self):
        head = "[drop]\nangle_deg = 10\n[body]\nshape = 'mesh'\nmesh = { file = 'body.stl' }\n"
        tail = "[ground]\nstiffness = 1e8\n"
        self.write("none.toml", head + tail)
        self.refused("body.mass: required, or body.mesh.density", "simulate", "none.toml")
        self.write("mass.toml", head.replace("mesh =", "mass = 1\nmesh =") + tail)
        facets = self.read("body.stl").splitlines()
        self.write("body.stl", "\n".join(facets[:-2] + facets[-1:]))
        self.refused("body.stl", "simulate", "mass.toml")
        self.write("body.stl", "\n".join([facets[0]] + [self.inverted(facet) for facet in facets[1:-1]] + [facets[-1]]))
        self.refused("face inward", "simulate", "mass.toml")

    @staticmethod
    def inverted(facet):
        head, a, b, c = facet.split("vertex")
        return "vertex".join([head, b, a, c])

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
            text = " ".join(self.run_program(*command, *given).stdout.split())
            self.assertIn("body: mass 0.08814 kg, extents 0.10566 × 0.04394 × 0.01905 m, centre of mass (0.01, 0, 0) m, principal inertia",
                          text, command)
            if command[0] != "explain":
                self.assertIn('# body: {"mass":0.0881', self.run_program(*command, *given, "--format", "csv").stdout, command)
