# SPDX-License-Identifier: GPL-3.0-or-later
"""Keys of a drop in space: attitude and velocities, in either model, and the language that has them."""

import csv
import itertools
import math
import random
import unittest

from space_folder import BOX, CENTRE, INERTIA, MASS, SIZE, SpaceFolder, cross, product, rotated, times, turn, words


class Drop(SpaceFolder):
    RUN = [*BOX, "--impacts", "2", "--digits", "9"]
    grown = 1e-7  # of nine digits asked for, over two impacts

    def test_an_attitude_equal_to_angle_and_tilt_gives_the_same_impacts(self):
        q = product(turn(2, -30), turn(1, 40))
        by_angles = self.json_of("simulate", "--angle", "30", "--tilt", "40", *self.RUN)
        for sign in (1, -1):  # both are the same attitude
            by_attitude = self.json_of("simulate", "--attitude", words([sign * x for x in q]), *self.RUN)
            self.same_rows(by_attitude, by_angles, self.grown)
        self.assertIsNone(by_attitude["scene"]["drop"]["angle_deg"])
        self.assertEqual(by_attitude["scene"]["drop"]["attitude"], [-x for x in q])

    def test_an_orientation_puts_that_part_of_a_box_right_below_its_middle(self):
        corners = [[s * l / 2 for s, l in zip(signs, SIZE)] for signs in itertools.product((-1, 1), repeat=3)]
        seen = set()
        for n in range(1, 27):
            q = self.json_of("simulate", "--orientation", str(n), *BOX, "--impacts", "1")["impacts"][0]["attitude"]
            heights = [rotated(q, corner)[2] for corner in corners]
            lowest = [corner for corner, height in zip(corners, heights) if height < min(heights) + 1e-12]
            self.assertEqual(len(lowest), 4 if n <= 6 else 2 if n <= 18 else 1, n)
            x, y, z = rotated(q, [sum(parts) / len(lowest) for parts in zip(*lowest)])
            self.assertLess(math.hypot(x, y), 1e-15)
            self.assertLess(z, 0)
            seen.add(tuple(map(tuple, lowest)))
        self.assertEqual(len(seen), 26)
        self.refused("left out where the body is no box", "simulate", "--orientation", "1", "--stiffness", "1e9")
        self.refused("give one of them, not both", "simulate", *BOX, "--orientation", "1", "--angle", "10")

    def test_the_26_drops_of_a_box_are_one_sweep(self):
        rows = self.run_program("sweep", "phone-damped", "--set", "drop.orientation=1:26:1", "--set", "run.impacts=1").stdout
        lines = [line for line in rows.splitlines() if not line.startswith("#")]
        self.assertEqual([line.split(",")[1] for line in lines[1:]], [str(n) for n in range(1, 27)])

    def test_a_velocity_equal_to_speed_and_tangential_velocity_gives_the_same_impacts_to_the_bit(self):
        for command in (["simulate", *self.RUN], ["sequence", "--impacts", "3"]):
            by_parts = self.json_of(*command, "--angle", "20", "--speed", "1.25", "--tangential-velocity", "0.5", "--spin", "2")
            whole = self.json_of(*command, "--angle", "20", "--velocity", "0.5,0,-1.25", "--spin", "2")
            self.assertEqual(whole["impacts"], by_parts["impacts"])
            self.assertEqual([whole["scene"]["drop"][key] for key in ("speed", "tangential_velocity", "velocity")],
                             [None, None, [0.5, 0, -1.25]])

    def test_a_pure_inclination_is_planar_whatever_its_quadrant(self):
        for angle in (25, -25, 90, 155, -120):
            arguments = ["--attitude", words(turn(2, -angle)), *BOX, "--impacts", "2", "--digits", "9"]
            done = self.json_of("compare", *arguments, status=(0,))
            self.assertTrue(done["impacts"], angle)
            self.assertGreater(sum(row["lands"] is True for row in done["impacts"] if "lands" in row) +
                               sum(row.get("not_compared_because") in (None, "") for row in done["impacts"]), 0, angle)
            first = self.json_of("sequence", "--attitude", words(turn(2, -angle)), "--body", "box", "--size",
                                 "x".join(map(str, SIZE)))["impacts"][0]
            self.assertAlmostEqual(first["inclination_deg"], angle, delta=1e-12)
            self.assertAlmostEqual(first["contact_angle_deg"], min(abs(angle), 180 - abs(angle)), delta=1e-12)

    def test_a_scene_turned_about_the_vertical_gives_the_same_rows_turned(self):
        q, v, turned = product(turn(2, -35), turn(1, 25)), (0.3, 0.2, -1.5), turn(3, 73)
        body = ["--centre", words(CENTRE), "--inertia", words(INERTIA), "--static-friction", "0.2"]
        straight = self.json_of("simulate", "--attitude", words(q), "--velocity", words(v), *body, *self.RUN)
        other = self.json_of("simulate", "--attitude", words(product(turned, q)), "--velocity", words(rotated(turned, v)), *body,
                             *self.RUN)
        self.same_rows(other, straight, self.grown, lambda name, b: rotated(turned, b) if len(b) == 3 else b)

    def test_a_mirrored_scene_gives_mirrored_rows(self):
        q, v = product(turn(2, -35), turn(1, 25)), (0.3, 0.2, -1.5)
        x, y, z = CENTRE
        xx, yy, zz, xy, xz, yz = INERTIA
        straight = self.json_of("simulate", "--attitude", words(q), "--velocity", words(v), "--centre", words(CENTRE), "--inertia",
                                words(INERTIA), *self.RUN)
        mirrored = self.json_of("simulate", "--attitude", words((q[0], -q[1], q[2], -q[3])), "--velocity", words((v[0], -v[1], v[2])),
                                "--centre", words((x, -y, z)), "--inertia", words((xx, yy, zz, -xy, xz, -yz)), *self.RUN)

        def change(name, b):
            if name == "velocity_after":
                return (b[0], -b[1], b[2])
            return (-b[0], b[1], -b[2]) if name == "angular_velocity_after" else b

        self.same_rows(mirrored, straight, self.grown, change)

    def test_without_friction_an_impact_keeps_the_angular_momentum_about_the_corner_that_strikes(self):
        q = product(turn(3, 20), product(turn(2, -35), turn(1, 25)))
        v = (0.3, 0.2, -1.5)
        misses = [self.missed_angular_momentum(q, v, stiffness) for stiffness in ("1e15", "1e19")]
        # The corner sinks by less than (m v²/k)^(1/4), and the patch is as wide.
        for miss, stiffness in zip(misses, (1e15, 1e19)):
            self.assertLessEqual(miss, (MASS * 2.34 / stiffness) ** 0.25 / SIZE[2])
        self.assertAlmostEqual(misses[0] / misses[1], 10, delta=1)

    def missed_angular_momentum(self, q, v, stiffness):
        """What the body gained less r × P, r from the centre of mass to the corner at the touch; relative."""
        run = self.json_of("simulate", "--attitude", words(q), "--velocity", words(v), "--centre", words(CENTRE), "--inertia",
                           words(INERTIA), *BOX[:6], "--stiffness", stiffness, "--impacts", "1", "--digits", "9", "--history", "past.csv")
        with open(self.path("past.csv"), encoding="utf-8") as file:
            after = {name: float(value) for name, value in list(csv.DictReader(l for l in file if not l.startswith("#")))[-1].items()}
        corners = [tuple(s * size / 2 - c for s, size, c in zip(signs, SIZE, CENTRE))
                   for signs in ((i, j, k) for i in (-1, 1) for j in (-1, 1) for k in (-1, 1))]
        arm = min((rotated(q, corner) for corner in corners), key=lambda r: r[2])
        impulse = [MASS * (a - b) for a, b in zip(run["impacts"][0]["velocity_after"], v)]
        self.assertAlmostEqual(impulse[0], 0, delta=1e-12)
        self.assertAlmostEqual(impulse[1], 0, delta=1e-12)
        attitude = [after[name] for name in ("beta0", "beta1", "beta2", "beta3")]
        inverse = (attitude[0], *(-x for x in attitude[1:]))
        rate = rotated(inverse, run["impacts"][0]["angular_velocity_after"])
        gained, expected = rotated(attitude, times(INERTIA, rate)), cross(arm, impulse)
        size = math.dist(expected, (0, 0, 0))
        self.assertLessEqual(abs(gained[2]), 1e-9 * size)  # vertical forces have no moment about the vertical
        return math.dist(gained, expected) / size

    def test_an_angular_velocity_has_world_components_and_takes_the_place_of_the_spin(self):
        for command in (["simulate", *self.RUN], ["sequence", "--impacts", "3"]):
            spun = self.json_of(*command, "--angle", "20", "--spin", "2")
            whole = self.json_of(*command, "--angle", "20", "--angular-velocity", "0,2,0")
            self.assertEqual(whole["impacts"], spun["impacts"])
            self.assertEqual([whole["scene"]["drop"][key] for key in ("spin", "angular_velocity")], [None, [0, 2, 0]])
        q, w, turned = product(turn(2, -35), turn(1, 25)), (3, -2, 5), turn(3, 73)
        runs = [self.json_of("simulate", "--attitude", words(a), "--angular-velocity", words(b), "--centre", words(CENTRE), *self.RUN)
                for a, b in ((q, w), (product(turned, q), rotated(turned, w)))]
        self.same_rows(runs[1], runs[0], self.grown, lambda name, b: rotated(turned, b) if len(b) == 3 else b)
        steps = self.json_of("explain", "1", "--angle", "20", "--angular-velocity", "0.1,2,0")["steps"]
        self.assertEqual([e["value"] for step in steps for e in step["equations"] if e["name"] == "ω"], [[0.1, 2, 0]])

    def test_each_alternative_is_refused_beside_the_other_and_a_flag_takes_the_place_of_the_file_s(self):
        pairs = {"--attitude=1,0,0,0": ("--angle=1", "--tilt=2"), "--velocity=0,0,-1": ("--speed=1", "--height=1", "--tangential-velocity=1")}
        for one, others in pairs.items():
            for other in others:
                base = [] if other.startswith("--angle") or one.startswith("--att") else ["--angle=10"]
                self.refused("give one of them, not both", "simulate", *BOX, one, other, *base)
        self.write("file.toml", "[drop]\nattitude = [1, 0, 0, 0]\nvelocity = [0, 0, -1]\n[ground]\nstiffness = 1e8\n")
        drop = self.json_of("simulate", "file.toml", "--angle", "10", "--speed", "2", "--impacts", "1", "--digits", "3")["scene"]["drop"]
        self.assertEqual((drop["angle_deg"], drop["attitude"], drop["speed"], drop["velocity"]), (10, None, 2, None))
        drop = self.json_of("simulate", "rod-at-1ms", "--attitude=1,0,0,0", "--velocity=0,0,-3", "--impacts", "1", "--digits", "3")["scene"]["drop"]
        self.assertEqual((drop["angle_deg"], drop["attitude"], drop["speed"], drop["velocity"]), (None, [1, 0, 0, 0], None, [0, 0, -3]))
        self.write("both.toml", "[drop]\nangle_deg = 1\nattitude = [1, 0, 0, 0]\n[ground]\nstiffness = 1e8\n")
        self.refused("both.toml:3:12: drop.attitude", "simulate", "both.toml")

    def test_what_is_no_attitude_or_does_not_come_down_is_refused(self):
        for bad in ("0,0,0,0", "1,1,0,0", "1,0,0", "nan,0,0,1", "0.98,0,0,0", "1,0,0,0,0"):
            self.refused("--attitude '%s': must be four numbers" % bad, "simulate", *BOX, "--attitude", bad)
        self.assertEqual(self.json_of("simulate", *BOX, "--attitude=0.71,0,-0.71,0", "--impacts=1", "--digits=3")["outcome"], "impact-limit")
        for command in ("simulate", "sequence"):
            ground = ["--stiffness", "1e9"] if command == "simulate" else []
            self.refused("does not approach the ground", command, "--angle", "30", "--velocity", "0,0,1", *ground)


class Space(SpaceFolder):
    """What moves in space is for both models."""

    def test_what_leaves_the_plane_runs_in_either_model_whichever_key_says_so(self):
        sparing = {"drop.attitude": ["--attitude", words(product(turn(2, -35), turn(1, 25)))],
                   "drop.tilt_deg": ["--angle", "20", "--tilt", "5"],
                   "drop.velocity": ["--angle", "20", "--velocity", "0,0.1,-1"],
                   "body.centre": ["--angle", "20", "--centre", "0,0.001,0"],
                   "body.inertia": ["--angle", "20", "--inertia", words(INERTIA)]}
        size = ["--body", "box", "--size", "x".join(map(str, SIZE)), "--mass", str(MASS)]
        for key, given in sparing.items():
            self.assertTrue(self.json_of("sequence", *size, *given)["impacts"])
            self.assertIn("corner", self.run_program("explain", "1", *size, *given).stdout, key)
            done = self.json_of("simulate", *size, *given, "--stiffness", "1e9", "--impacts", "1", "--digits", "3")
            self.assertEqual(len(done["impacts"]), 1)

    def test_a_motion_across_the_plane_is_not_planned_as_one_in_it(self):
        run = self.json_of("simulate", "--angle", "20", "--velocity", "0,0.5,-1", *BOX, "--impacts", "2", "--digits", "6")
        for row in run["impacts"]:
            self.assertAlmostEqual(row["velocity_after"][1], 0.5, delta=1e-9)  # nothing acts along y
        done = self.run_program("simulate", "--angle", "20", "--velocity", "0,0.5,-1", *BOX, "--impacts", "1", "--planar")
        self.assertIn("mirror image", done.stderr)


class Language(SpaceFolder):
    KEYS = {"drop.attitude": "attitude", "drop.velocity": "velocity", "body.centre": "centre", "body.inertia": "inertia"}

    def test_help_completion_keys_and_the_new_file_have_every_row(self):
        listed = {key["key"]: key["flag"] for key in self.json_of("keys")["keys"]}
        begun = self.run_program("init").stdout
        for shell in ("bash", "zsh", "fish"):
            completion = self.run_program("completion", shell).stdout
            for word in self.KEYS.values():
                self.assertIn(word, completion, shell)
        for key, word in self.KEYS.items():
            self.assertEqual(listed[key], "--" + word)
            self.assertIn("# %s = [" % key.split(".")[1], begun)
            for command in ("sequence", "explain", "simulate", "compare", "plan"):
                self.assertIn("--" + word + " ", self.run_program(command, "--help").stdout, command)

    def test_a_list_is_one_value_of_a_sweep_and_no_axis(self):
        self.refused("a list cannot be swept", "sweep", "rod-10", "--set", "drop.velocity=0,0,-1:0,0,-2:3")
        done = self.run_program("sweep", "rod-10", "--model", "discrete", "--set", "drop.velocity=0,0,-2", "--set", "drop.angle_deg=10:20:10")
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_values_at_random_are_taken_or_refused_with_one_line(self):
        draw = random.Random(5)
        parts = ["0", "1", "-1", "1e5", "1e308", "1e400", "nan", "inf", "", " ", "x", "--", "0x1", "1,", "é", "1e-320", "-0", "0.5", "1;1"]
        for _ in range(60):
            flag = draw.choice(["attitude", "velocity", "centre", "inertia"])
            text = draw.choice(",x").join(draw.choice(parts) for _ in range(draw.randint(1, 7)))
            done = self.run_program("sequence", "--angle=10" if flag != "attitude" else "--spin=0", f"--{flag}={text}", "--body=box",
                                    "--size=1x1x1", "--impacts=1")
            self.assertIn(done.returncode, (0, 2, 3, 4), (flag, text, done.stderr))
            if done.returncode == 2:
                self.assertRegex(done.stderr, r"\Aclatter: [^\n]+\n\Z", text)
