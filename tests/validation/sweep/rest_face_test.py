# SPDX-License-Identifier: GPL-3.0-or-later
"""On which face bodies come to lie: by geometry, by symmetry, and by both models."""

import collections

from run_folder import EmptyFolder, json_of, records, rows_of, run

# A block of 0.1 m x 0.05 m that stands on its edge, hardly moving, falls to the side of its centre of mass: its diagonal
# stands upright at atan(2), 63.4 degrees.
BLOCK = ("[drop]\nangle_deg = 60\nspeed = 0.01\n[world]\ngravity = 9.81\n[body]\nshape = 'box'\nsize = [0.1, 0.05, 0.05]\nmass = 0.3\n"
         "[impact]\nrestitution = 0.2\nfriction = 0.5\n[ground]\nstiffness = 1e7\ndamping = 1e8\nstatic_friction = 0.5\nsliding_friction = 0.5\n"
         "[run]\nimpacts = 100\n")
COLUMNS = ("--columns", "rest_face,rest_time,rest_known")


class RestFace(EmptyFolder):
    def setUp(self):
        super().setUp()
        self.block = self.write("block.toml", BLOCK)

    def test_a_block_on_its_edge_falls_to_the_side_of_its_centre(self):
        for model, angles in (("discrete", "50:75:5"), ("continuous", "60:65:5")):
            for row in rows_of("sweep", self.block, "--set", f"drop.angle_deg={angles}", "--model", model, *COLUMNS):
                with self.subTest(model=model, angle=row["drop.angle_deg"]):
                    self.assertEqual(row["rest_face"], "-z" if float(row["drop.angle_deg"]) < 63.4 else "-x")
                    self.assertEqual(row["rest_known"], "true")
        run("map", self.block, "--over", "drop.angle_deg=40:80", "--over", "drop.speed=0.01:0.02", "--quantity", "rest_face",
            "--size", "8x2", "--output", self.path("map.csv"))
        self.assertEqual([self.read("map.csv").count(face) for face in ("-z", "-x")], [10, 6])

    def test_followed_to_rest_it_is_the_same_face_with_its_time(self):
        (row,) = rows_of("sweep", self.block, "--set", "run.until_rest=true", "--model", "discrete")
        (early,) = rows_of("sweep", self.block, "--set", "drop.angle_deg=60", "--model", "discrete", *COLUMNS)
        self.assertEqual((row["rest_face"], early["rest_face"], early["rest_time"]), ("-z", "-z", ""))
        # It has fallen by the difference of heights: no faster than freely, no slower than ten times that.
        self.assertGreater(float(row["rest_time"]), (2 * 0.03 / 9.81) ** 0.5)
        self.assertLess(float(row["rest_time"]), 10 * (2 * 0.03 / 9.81) ** 0.5)
        self.assertEqual(json_of("sequence", self.block, "--until-rest")["rest"]["face"], "-z")

    def test_a_face_that_could_not_be_computed_says_why_followed_to_rest_or_not(self):
        crate = self.write("crate.toml", "[drop]\nangle_deg = 10\nheight = 1\n[body]\nshape = 'box'\nsize = [0.3, 0.2, 0.1]\nmass = 1.2\n"
                           "[impact]\nrestitution = 0.4\nfriction = 0.3\n")
        sweep = ("sweep", crate, "--set", "drop.attitude=uniform", "--random", "2000", "--seed", "42", "--scenes", "639:640", *COLUMNS, "--bare")
        for more in ((), ("--set", "run.until_rest=true")):
            done = run(*sweep, *more)
            lost, other = records(done.stdout)
            self.assertEqual((done.returncode, lost["rest_face"]), (3, ""))
            self.assertIn("not-computed: a body that stays on the ground", lost["reason"])
            self.assertIn("1 of 2 scenes fall short; 639: ", done.stderr)
            self.assertEqual((other["rest_face"] != "", other["reason"]), (True, ""))

    def test_a_die_is_fair(self):
        told = json_of("sweep", "die", "--set", "drop.attitude=uniform", "--random", "240", "--set", "run.until_rest=false", *COLUMNS,
                       "--model", "discrete", "--summary")
        shares = told["shares"]["rest_face"]
        self.assertEqual(sorted(share["text"] for share in shares), ["+x", "+y", "+z", "-x", "-y", "-z"])
        self.assertEqual(sum(share["count"] for share in shares), 240)
        for share in shares:  # four deviations: one of 3000 seeds fails
            self.assertLess(abs(share["count"] - 40), 4 * (240 * 5 / 36) ** 0.5)
            self.assertLess(share["low"], share["count"] / 240)
        self.assertNotIn("rest_known", [row["quantity"] for row in told["rows"]])

    def test_shares_are_of_all_drops_also_of_those_without_a_face(self):
        sweep = ("sweep", self.block, "--set", "drop.angle_deg=0,50,75,90", "--set", "impact.restitution=0.2,1", *COLUMNS, "--model", "discrete")
        rows, told = rows_of(*sweep, status=(3,)), json_of(*sweep, "--summary", status=(3,))  # without loss they never rest
        for column in ("rest_face", "rest_known"):
            with self.subTest(column):
                expected = collections.Counter(row[column] or "none" for row in rows)
                self.assertGreater(expected["none"], 0)
                shares = told["shares"][column]
                self.assertEqual({share["text"]: share["count"] for share in shares}, expected)
                self.assertAlmostEqual(sum(share["share"] for share in shares), 1, delta=1e-12)
                self.assertIn(f"none {100 * expected['none'] / 8:g}", run(*sweep, "--summary").stdout)

    def test_rods_name_their_side_and_what_does_not_lie_has_no_face(self):
        rod = ("sequence", "--angle", "30", "--gravity", "9.81", "--restitution", "0.5", "--friction", "0.3")
        self.assertEqual(json_of(*rod, "--until-rest")["rest"]["face"], "side")
        self.assertNotIn("rest", json_of(*rod))
