#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""clatter compare of drops in space: every body, every format, and one line for each impact that has no limit."""

import csv
import unittest

from space_folder import BOX, INERTIA, SpaceFolder, l_shape, product, turn, words

QUANTITIES = ["start", "contact_angle_deg", "impulse_x", "impulse_y", "impulse_z", "velocity_after_x", "velocity_after_y",
              "velocity_after_z", "angular_velocity_after_x", "angular_velocity_after_y", "angular_velocity_after_z"]


class Compare(SpaceFolder):
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

    def test_what_leaves_the_plane_agrees_with_the_discrete_model_in_space(self):
        for given in (["--attitude", words(product(turn(2, -35), turn(1, 25)))], ["--angle", "20", "--tilt", "5"],
                      ["--angle", "20", "--velocity", "0,0.1,-1"], ["--angle", "20", "--tilt", "8", "--centre", "0,0.001,0"],
                      ["--angle", "20", "--tilt", "8", "--inertia", words(INERTIA)]):
            done = self.agrees(*BOX, "--impacts", "2", *given)
            self.assertGreater(max(abs(done["impacts"][0]["numbers"][name]["discrete"]) for name in
                                   ("angular_velocity_after_x", "angular_velocity_after_z", "velocity_after_y")), 1e-3, given)

    def test_rods_and_ls_of_triangles_agree_with_friction_and_damping(self):
        ground = ["--stiffness", "1e9", "--damping", "1e8", "--static-friction", "0.3", "--impacts", "2", "--gravity", "9.81"]
        rod = self.agrees("--body", "rod", "--length", "1", "--radius", "0.05", "--angle", "30", "--velocity", "0.2,0.5,-1", *ground)
        self.assertEqual(rod["impacts"][0]["discrete_end"], "a")
        self.write("l.stl", l_shape(0.02))
        self.write("l.toml", '[body]\nshape = "mesh"\nmass = 0.2\nmesh = { file = "l.stl", unit = 1 }\n[drop]\nspeed = 1\n')
        for angle, tilt in ((20, 35), (70, -20), (-35, 140)):
            done = self.agrees("l.toml", "--attitude=" + words(product(turn(2, -angle), turn(1, tilt))), *ground)
            self.assertIn(done["impacts"][0]["discrete_end"], [str(n) for n in range(1, 11)])

    def test_each_impact_without_a_limit_is_explained_in_one_line(self):
        done = self.json_of("compare", "phone-corner", "--impacts", "40", status=(0,))
        unsettled = [impact for impact in done["impacts"] if not impact["limit_is_discrete"]]
        self.assertTrue(unsettled)
        for impact in unsettled:
            self.assertRegex(impact["explanation"], r"\A[^\n]+\Z")
        table = self.run_program("compare", "phone-corner", "--impacts", "40").stdout
        self.assertRegex(table, r"\nLimit of impacts? %d" % unsettled[0]["n"])
        self.assertLessEqual(max(map(len, table.splitlines())), 80)

    def test_a_face_that_lands_turning_names_its_corners_and_the_outcomes_of_tilts(self):
        done = self.json_of("compare", *BOX, "--angle", "0", "--angular-velocity", "2,1,0", "--impacts", "1", status=(0, 4))
        first = done["impacts"][0]
        self.assertEqual(len(first["discrete_end"].split()), 4)
        self.assertIn("4 corners land at once", first["explanation"])

    def test_an_edge_under_a_mass_off_its_middle_has_no_limit_and_says_so(self):
        done = self.json_of("compare", *BOX, "--angle", "20", "--centre", "0,0.001,0", "--impacts", "1", status=(0, 4))
        self.assertIsNone(done["impacts"][0]["limit_is_discrete"])
        self.assertIn("2 corners land at once", done["impacts"][0]["explanation"])

    def test_every_format_has_the_rows(self):
        data = self.agrees("phone-corner", "--impacts", "2", least=2)
        text = self.run_program("compare", "phone-corner", "--impacts", "2", "--format", "csv", "--bare").stdout
        rows = list(csv.DictReader(text.splitlines()))
        self.assertEqual([row["quantity"] for row in rows], 2 * QUANTITIES)
        self.assertEqual([float(row["limit"]) for row in rows],
                         [number["limit"] for impact in data["impacts"] for number in impact["numbers"].values()])
        for form, mark in (("markdown", "| +x+y-z |"), ("latex", "+x+y-z")):
            self.assertIn(mark, self.run_program("compare", "phone-corner", "--impacts", "2", "--format", form).stdout)
        swept = self.run_program("compare", "phone-sweep", "--tilt", "20", "--impacts", "1", "--format", "csv", "--bare").stdout
        self.assertEqual(len(swept.splitlines()) % 11, 1)


if __name__ == "__main__":
    unittest.main()
