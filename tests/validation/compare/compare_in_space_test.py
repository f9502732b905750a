# SPDX-License-Identifier: GPL-3.0-or-later
"""clatter compare of drops in space: every body, every format, and one line for each impact that has no limit."""

import math

from space_folder import SpaceFolder, cross, product, rotated, turn, turned_back

QUANTITIES = ["start", "contact_angle_deg", *(f"{name}_{axis}" for name in ("impulse", "velocity_after", "angular_velocity_after") for axis in "xyz")]


class Compare(SpaceFolder):
    def table(self, *arguments):
        """It fits a terminal."""
        table = self.run_program("compare", *arguments).stdout
        self.assertLessEqual(max(map(len, table.splitlines())), 80)
        return table

    def agrees(self, *arguments, least=1):
        """The comparison, in which the limit is the discrete value for at least so many impacts."""
        done = self.json_of("compare", *arguments, status=(0,))
        self.assertTrue(done["agrees"], arguments)
        landed = [impact for impact in done["impacts"] if impact["limit_is_discrete"]]
        self.assertGreaterEqual(len(landed), least, arguments)
        for impact in landed:
            self.assertEqual(list(impact["numbers"]), QUANTITIES)
            for name, number in impact["numbers"].items():
                judged = number["discrete"] if number["mesh_corners"] is None else number["mesh_corners"]
                self.assertLessEqual(abs(number["limit"] - judged), number["allowance"], name)
        return done

    def test_each_impact_without_a_limit_is_explained_in_one_line(self):
        done = self.json_of("compare", "phone-corner", "--impacts", "40", status=(0,))
        self.assertIsNone(done["mesh_corners"])
        settled = [bool(impact["limit_is_discrete"]) for impact in done["impacts"]]
        self.assertEqual(settled, sorted(settled, reverse=True))  # none after the first without a limit
        unsettled = [impact for impact in done["impacts"] if not impact["limit_is_discrete"]]
        for impact in unsettled:
            self.assertRegex(impact["explanation"], r"\A[^\n]+\Z")
        self.assertRegex(self.table("phone-corner", "--impacts", "40"), r"\nLimit of impacts? %d" % unsettled[0]["n"])

    DISC = ["--body", "rod", "--mass", "2", "--length", "0.1", "--radius", "0.2", "--gravity", "9.81", "--stiffness", "1e9"]

    def struck(self, attitude, place):
        """Normal impulse and angular velocity after it of the disc that falls with 1 m/s on this point of its rim, by hand."""
        moments = [2 * 0.2**2 / 2] + 2 * [2 * (3 * 0.2**2 + 0.1**2) / 12]
        lever = cross(place, turned_back(attitude, (0, 0, 1)))
        impulse = 2 / (1 / 2 + sum(x * x / i for x, i in zip(lever, moments)))
        return impulse, rotated(attitude, [impulse * x / i for x, i in zip(lever, moments)])

    def test_a_disc_is_judged_by_its_meshs_corners_and_its_own_rim_stands_beside(self):
        attitude = product(turn(2, -35), turn(1, 5))
        up = turned_back(attitude, (0, 0, 1))
        across = math.hypot(*up[1:])
        rim = (-0.05, -0.2 * up[1] / across, -0.2 * up[2] / across)
        off = {}
        for sectors in (16, 64):
            self.write("disc.toml", "[body]\nmesh = { sectors = %d }\n" % sectors if sectors != 64 else "")
            done = self.agrees("disc.toml", *self.DISC, "--angle", "35", "--tilt", "5", "--impacts", "2", least=2)
            self.assertEqual(done["scene"]["body"]["mesh"]["sectors"], sectors)
            nodes = [(-0.05, 0.2 * math.sin(a), -0.2 * math.cos(a)) for a in (2 * math.pi * k / sectors for k in range(sectors))]
            lowest = min(nodes, key=lambda node: rotated(attitude, node)[2])
            numbers = done["impacts"][0]["numbers"]
            for column, place in (("discrete", rim), ("mesh_corners", lowest)):
                impulse, turning = self.struck(attitude, place)
                self.assertAlmostEqual(numbers["impulse_z"][column], impulse, delta=1e-13 * impulse)
                for axis, expected in zip("xyz", turning):
                    self.assertAlmostEqual(numbers["angular_velocity_after_" + axis][column], expected, delta=1e-12 * 10)
            turned = numbers["angular_velocity_after_x"]
            self.assertAlmostEqual(turned["mesh_corners_off"], turned["mesh_corners"] - turned["discrete"], delta=1e-13)
            self.assertEqual(done["mesh_corners"]["same_impacts"], 2)
            off[sectors] = abs(turned["mesh_corners_off"])
            self.assertIn("the discrete value of the mesh's corners for 2 of 2 impacts", done["message"])
        self.assertLess(off[64], off[16] / 4)
        table = self.table(*self.DISC, "--angle", "35", "--tilt", "5", "--impacts", "2")
        self.assertRegex(table, r"discrete +corners")
        self.assertRegex(" ".join(table.split()), r"the two are up to [0-9.]+ of the scale apart \(\S+ of impact [12]\)")

    def test_needles_tubes_and_lopsided_round_bodies_agree(self):
        tube = ["--body", "rod", "--mass", "0.2", "--length", "0.3", "--radius", "0.02", "--stiffness", "1e9", "--gravity", "9.81"]
        for given in (["--inertia", "7e-5,1.5e-3,1.5e-3"], ["--inertia", "7e-5,1.5e-3,1.45e-3"], ["--centre", "0.01,0.004,-0.003"],
                      ["--radius", "4e-4"]):
            flags = dict(zip(tube[::2], tube[1::2])) | dict(zip(given[::2], given[1::2]))
            done = self.agrees(*(word for pair in flags.items() for word in pair), "--angle", "30", "--tilt", "3",
                               "--angular-velocity", "1,2,0.5", "--impacts", "2", "--sliding-friction", "0.2")
            self.assertGreater(done["mesh_corners"]["same_impacts"], 0, given)

    def test_a_law_of_the_impact_keys_that_is_not_the_grounds_is_named_where_the_models_differ(self):
        rubbed = (*self.DISC, "--angle", "35", "--tangential-velocity", "1", "--friction", "0.3", "--tilt", "5")
        for drop, law in ((("coin",), "e = 0.5 where the ground has 0.5"), (("die",), "e = 0.5 where the ground has 0."),
                          (rubbed, "μ = 0.3 where the ground has μ = 0.")):
            done = self.json_of("compare", *drop, "--impacts", "1", status=(1,))
            self.assertIn("the law of [impact] is not the ground's: " + law, done["message"])
