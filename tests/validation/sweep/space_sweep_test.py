#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""clatter sweep of the discrete model over drops in space: one row per scene or impact, those of the drops by themselves."""

import csv
import itertools
import math
import unittest

from space_folder import MASS, SIZE, SpaceFolder, box_moments, cross, rotated

FALLING = '[drop]\nangle_deg = 35\nspeed = 2\n[body]\nshape = "box"\nsize = [%r, %r, %r]\nmass = %r\n[run]\nimpacts = 3\n[world]\ngravity = 9.81\n' % (
    *SIZE, MASS)


class Sweep(SpaceFolder):
    def setUp(self):
        super().setUp()
        self.write("box.toml", FALLING)

    def swept(self, *arguments, status=0):
        done = self.run_program("sweep", "box.toml", "--model", "discrete", *arguments, "--bare")
        self.assertEqual(done.returncode, status, done.stderr)
        return list(csv.DictReader(done.stdout.splitlines()))

    def sequence(self, *arguments):
        text = self.run_program("sequence", "box.toml", *arguments, "--format", "csv", "--bare").stdout
        return [row for row in csv.DictReader(text.splitlines()) if row["n"].isdigit()]

    def test_each_impact_of_a_sweep_out_of_the_plane_has_every_quantity_and_error_of_its_own_sequence(self):
        rows = self.swept("--set", "drop.tilt_deg=0:20:10", "--set", "impact.friction=0:0.4:0.4", "--rows", "impact")
        seen = set()
        for (tilt, friction), group in itertools.groupby(rows, lambda row: (row["drop.tilt_deg"], row["impact.friction"])):
            own = self.sequence("--tilt", tilt, "--friction", friction)
            group = list(group)
            self.assertEqual(len(group), len(own))
            for row, expected in zip(group, own):
                for name, value in expected.items():
                    self.assertEqual(row[name], value, (tilt, friction, name))
                if float(tilt) == 0:
                    self.assertEqual({row[name] for name in ("corners", "place_x", "attitude_q0", "touches")}, {""})
            seen.add((tilt, friction))
        self.assertEqual(len(seen), 6)

    def test_the_first_impacts_of_a_sweep_over_tilts_are_the_closed_form_of_the_corner_that_strikes(self):
        rows = self.swept("--set", "drop.tilt_deg=5:85:8", "--set", "run.impacts=1", "--rows", "impact")
        self.assertEqual(len(rows), 11)
        for row in rows:
            q = [float(row[f"attitude_q{i}"]) for i in range(4)]
            arm = rotated(q, [float(row[f"place_{axis}"]) for axis in "xyz"])
            lever = rotated([q[0], *(-x for x in q[1:])], cross(arm, (0, 0, 1)))
            inverse = 1 / MASS + sum(x * x / i for x, i in zip(lever, box_moments(SIZE, MASS)))
            self.assertAlmostEqual(float(row["impulse_normal"]), 2 * 2 / inverse, delta=1e-13)
            self.assertLess(float(row["impulse_normal_error"]), 1e-12)

    def test_the_26_attitudes_of_a_box_are_26_rows_each_of_which_bounces_straight_up_like_a_point(self):
        self.write("box.toml", FALLING.replace("angle_deg = 35\n", "orientation = 1\n"))
        rows = self.swept("--set", "drop.orientation=1:26:1")
        self.assertEqual([(row["drop.orientation"], row["outcome"]) for row in rows], [(str(n), "impact-limit") for n in range(1, 27)])
        for row in rows:  # the part below the centre of mass strikes: three impulses 2 m v
            self.assertAlmostEqual(float(row["total_normal_impulse"]), 3 * 2 * MASS * 2, delta=1e-9)

    def test_a_scene_that_the_model_cannot_do_is_a_row_with_its_reason_beside_the_others(self):
        rows = self.swept("--set", "drop.tilt_deg=10:30:20", "--set", "drop.velocity=0,0.1,-1", "--set", "impact.impulse_ratio=-9:0:9",
                          "--rows", "impact")
        by_ratio = {row["impact.impulse_ratio"]: row for row in rows}
        self.assertIn("jamming", by_ratio["-9"]["reason"] + by_ratio["-9"]["outcome"])
        self.assertEqual(by_ratio["0"]["outcome"], "impact-limit")
        self.assertEqual(len(by_ratio["-9"]), len(by_ratio["0"]))

    def test_the_tail_of_bouncing_on_a_face_in_space_is_a_row_of_its_own(self):
        rows = self.swept("--set", "drop.angle_deg=0", "--set", "drop.velocity=0.1,0.2,-1", "--set", "impact.restitution=0.5:0.5:1",
                          "--rows", "impact")
        self.assertEqual(rows[-1]["n"], "tail")
        end = 2 * 0.5 * 1 / (9.81 * (1 - 0.5))
        self.assertAlmostEqual(float(rows[-1]["start"]), end, delta=1e-14)
        self.assertAlmostEqual(float(rows[-1]["velocity_after_y"]), 0.2, delta=1e-15)
        total = sum(float(row["impulse_normal"]) for row in rows)
        self.assertAlmostEqual(total, MASS * (1 + 9.81 * end), delta=1e-14)  # momentum: it is at rest then, against gravity

    def test_threads_do_not_change_a_byte(self):
        texts = {self.run_program("sweep", "box.toml", "--model", "discrete", "--set", "drop.tilt_deg=0:80:1", "--threads", n).stdout
                 for n in ("1", "3")}
        self.assertEqual(len(texts), 1)
        self.assertFalse(any(math.isnan(float(line.split(",")[4])) for line in texts.pop().splitlines() if line[0].isdigit()))


if __name__ == "__main__":
    unittest.main()
