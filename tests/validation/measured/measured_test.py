# SPDX-License-Identifier: GPL-3.0-or-later
"""`clatter measured`: tracked drops from a file to a table, a picture, or one line that says what is wrong."""

import os
import shutil
import unittest

from run_folder import Folder

HERE = os.path.join(os.environ["CLATTER_ROOT"], "validation", "measured")
SQUARES = os.path.join(HERE, "square-drops.csv")
CUBES = os.path.join(HERE, "cube-tosses.csv")


class Measured(Folder):
    def result(self, *arguments):
        return self.json_of("measured", *arguments, status=(0,))

    def lines(self, name):
        with open(name, encoding="utf-8") as file:
            return file.read().splitlines(keepends=True)

    def test_words_may_come_in_either_order_and_reports_name_source_and_licence_of_the_data(self):
        for file, name in ((SQUARES, "ImpactModeling"), (CUBES, "contact-nets")):
            shown = self.run_program("measured", "fit", file).stdout
            self.assertEqual(self.run_program("measured", file, "fit").stdout, shown)
            self.assertTrue(name in shown and "BSD-3-Clause" in shown)

    def test_no_drop_is_fitted_to_and_scored(self):
        scored = {row["drop"] for row in self.result("predict", SQUARES, "--fit-on", "1,11,21,31,41,51,61,71,81,91,101-250")["drops"]}
        self.assertEqual(scored & {"1", "111", "251"}, {"251"})

    def test_a_file_never_seen_goes_through_the_same_command(self):
        rows = self.lines(SQUARES)
        half = [row for row in rows[4:] if int(row.split(",")[0]) % 20 == 1]
        new = self.write("new.csv", "".join(rows[:4] + half))
        self.assertEqual(self.result("score", new, "--body", "square-drops")["data"]["drops"], 25)
        self.assertEqual(self.result("score", new, "--body", "square-drops", "--fit-from", SQUARES)["scored"], 25)

    def test_a_description_may_have_other_columns_units_and_senses(self):
        rows = self.lines(SQUARES)[4:]
        turned = ["n;k;X;Z;phi\n"]
        for row in rows:
            drop, sample, x, z, angle = row.strip().split(",")
            turned.append(f"{drop};{sample};{1000 * float(x)};{1000 * float(z)};{-57.29577951308232 * float(angle)}\n")
        self.write("turned.csv", "".join(turned))
        self.write("turned.toml", "[body]\nsize = [0.06, 0.06, 0.06]\n[track]\nmotion = 'plane'\nrate = 250\ndrop = 'n'\nsample = 'k'\n"
                   "x = 'X'\nz = 'Z'\nangle = 'phi'\nunit = 0.001\nangle_unit = 0.017453292519943295\nturns = 'clockwise'\n"
                   "[world]\ngravity = 9.2\n")
        self.check_fits(SQUARES)

    def check_fits(self, file):
        """Those of the file turned are those of this one."""
        for a, b in zip(self.result("fit", file)["fits"], self.result("fit", self.path("turned.csv"))["fits"], strict=True):
            for name in ("restitution", "friction"):
                self.assertAlmostEqual(a[name], b[name], delta=1e-4)

    def test_times_may_stand_for_samples_and_quaternions_end_with_their_scalar(self):
        turned = ["toss,ms,x_m,y_m,z_m,qx,qy,qz,qw\n"]
        for row in self.lines(CUBES)[4:]:
            toss, sample, x, y, z, w, *vector = row.strip().split(",")
            turned.append(",".join((toss, repr(1000 * float(sample) / 148), x, y, z, *vector, w)) + "\n")
        self.write("turned.csv", "".join(turned))
        self.write("turned.toml", "[body]\nsize = [0.1048, 0.1048, 0.1048]\nmass = 0.37\n[track]\nmotion = 'space'\ndrop = 'toss'\ntime = 'ms'\n"
                   "time_unit = 0.001\nq0 = 'qx'\nq1 = 'qy'\nq2 = 'qz'\nq3 = 'qw'\nquaternion = 'scalar-last'\n[impact]\nlever_tolerance = 0.25\n")
        self.check_fits(CUBES)
        head = " ".join(self.run_program("measured", "fit", "turned.csv").stdout.split())
        for words in ("148.000 Hz, motion in space", "poses: z up; quaternions with the scalar part last, body to world"):
            self.assertIn(words, head)

    def test_what_is_wrong_is_said_in_one_line(self):
        shutil.copy(SQUARES, self.path("a.csv"))
        self.each_refused({
            "guess square-drops": "ACTION", "fit body.stl": "--body takes a file or one of", "fit a.csv --body round": "--body round: neither",
            "fit a.csv --body cube-tosses": "no column toss; there are drop sample x_m z_m angle_rad (track.drop, track.x and so on in "
                                            "validation/measured/cube-tosses.toml name them)",
            "fit square-drops --fit-on 1,2": "no drop is called 2", "fit square-drops --fit-on 1,11,21 --seed 3": "excludes",
            "fit square-drops --share 1.5": "--share", "score square-drops --drop x --plot p.svg": "--drop x",
            "score square-drops --drop 999": "--drop 999: needs --plot", "fit square-drops --plot p.svg": "--plot",
            f"score {SQUARES} --fit-from {SQUARES}": "--fit-from"}, "measured")
        self.refused("point impacts among the drops to fit on", "measured", "fit", SQUARES, "--fit-on", "1,31,81", status=3)
        self.write("b.csv", "drop,sample,x_m,z_m,angle_rad\n1,0,0,1,0\n1,0,0,1,0\n")
        self.refused("b.csv:3:", "measured", "fit", self.path("b.csv"), "--body", "square-drops")
        self.write("b.toml", "[body]\nsize = [1, 1, 1]\n[track]\nmotion = 'plane'\nrate = 0\n")
        self.refused("track.rate", "measured", "fit", self.path("b.csv"))
        self.write("b.toml", self.read("b.toml").replace("rate = 0", "rate = 1e300"))
        self.refused("e+300: must be a number, greater than 0, at most 1e100", "measured", "fit", self.path("b.csv"))

    @unittest.skipUnless(shutil.which("gnuplot"), "gnuplot is not installed")
    def test_the_picture_has_the_track_beside_the_prediction(self):
        done = self.run_program("measured", "score", SQUARES, "--plot", self.path("score.svg"), "--plot-script")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("predicted from impact 1 on", self.read("score.svg"))
