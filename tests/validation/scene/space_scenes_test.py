# SPDX-License-Identifier: GPL-3.0-or-later
"""Keys of a drop in space: attitude and velocities, in either model, and the language that has them."""

from space_folder import BOX, CENTRE, INERTIA, SIZE, SpaceFolder, product, rotated, turn, words


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

    def test_vectors_in_place_of_speed_tangential_velocity_and_spin_give_the_same_impacts_to_the_bit(self):
        for command in (["simulate", *self.RUN], ["sequence", "--impacts", "3"]):
            by_parts = self.json_of(*command, "--angle", "20", "--speed", "1.25", "--tangential-velocity", "0.5", "--spin", "2")
            whole = self.json_of(*command, "--angle", "20", "--velocity", "0.5,0,-1.25", "--angular-velocity", "0,2,0")
            self.assertEqual(whole["impacts"], by_parts["impacts"])
            self.assertEqual([whole["scene"]["drop"][key] for key in ("speed", "tangential_velocity", "spin", "velocity", "angular_velocity")],
                             [None, None, None, [0.5, 0, -1.25], [0, 2, 0]])

    def test_a_pure_inclination_is_planar_whatever_its_quadrant(self):
        for angle in (25, -25, 90, 155, -120):
            arguments = ["--attitude", words(turn(2, -angle)), *BOX, "--impacts", "2", "--digits", "9"]
            self.assertTrue(self.json_of("compare", *arguments, status=(0,))["impacts"], angle)
            first = self.json_of("sequence", "--attitude", words(turn(2, -angle)), "--body", "box", "--size",
                                 "x".join(map(str, SIZE)))["impacts"][0]
            self.assertAlmostEqual(first["inclination_deg"], angle, delta=1e-12)
            self.assertAlmostEqual(first["contact_angle_deg"], min(abs(angle), 180 - abs(angle)), delta=1e-12)

    def test_a_scene_turned_about_the_vertical_gives_the_same_rows_turned(self):
        q, v, w, turned = product(turn(2, -35), turn(1, 25)), (0.3, 0.2, -1.5), (3, -2, 5), turn(3, 73)
        lopsided = ["--centre", words(CENTRE), "--inertia", words(INERTIA), "--static-friction", "0.2"]
        for motion, body in (({"--velocity": v}, lopsided), ({"--angular-velocity": w}, lopsided[:2])):
            straight, other = (self.json_of("simulate", "--attitude", words(attitude), *body, *self.RUN,
                                            *(word for name, value in motion.items() for word in (name, words(along(value)))))
                               for attitude, along in ((q, tuple), (product(turned, q), lambda value: rotated(turned, value))))
            self.same_rows(other, straight, self.grown, lambda name, b: rotated(turned, b) if len(b) == 3 else b)

    def test_an_explanation_has_the_angular_velocity_of_the_world(self):
        steps = self.json_of("explain", "1", "--angle", "20", "--angular-velocity", "0.1,2,0")["steps"]
        self.assertEqual([e["value"] for step in steps for e in step["equations"] if e["name"] == "ω"], [[0.1, 2, 0]])

    def test_each_alternative_is_refused_beside_the_other_and_a_flag_takes_the_place_of_the_file_s(self):
        pairs = {"--attitude=1,0,0,0": ("--angle=1", "--tilt=2"), "--velocity=0,0,-1": ("--speed=1", "--height=1", "--tangential-velocity=1")}
        for one, others in pairs.items():
            for other in others:
                base = [] if other.startswith("--angle") or one.startswith("--att") else ["--angle=10"]
                self.refused("give one of them, not both", "simulate", *BOX, one, other, *base)
        self.refused("left out where the body is no box", "simulate", "--orientation", "1", "--stiffness", "1e9")
        self.refused("give one of them, not both", "simulate", *BOX, "--orientation", "1", "--angle", "10")
        self.write("file.toml", "[drop]\nattitude = [1, 0, 0, 0]\nvelocity = [0, 0, -1]\n[ground]\nstiffness = 1e8\n")
        for given, told in ((("file.toml", "--angle", "10", "--speed", "2"), (10, None, 2, None)),
                            (("rod-at-1ms", "--attitude=1,0,0,0", "--velocity=0,0,-3"), (None, [1, 0, 0, 0], None, [0, 0, -3]))):
            drop = self.json_of("simulate", *given, "--impacts", "1", "--digits", "3")["scene"]["drop"]
            self.assertEqual((drop["angle_deg"], drop["attitude"], drop["speed"], drop["velocity"]), told)
        self.write("both.toml", "[drop]\nangle_deg = 1\nattitude = [1, 0, 0, 0]\n[ground]\nstiffness = 1e8\n")
        self.refused("both.toml:3:12: drop.attitude", "simulate", "both.toml")

    def test_what_is_no_attitude_or_does_not_come_down_is_refused(self):
        for bad in ("0,0,0,0", "1,1,0,0", "1,0,0", "nan,0,0,1", "0.98,0,0,0", "1,0,0,0,0"):
            self.refused("--attitude '%s': must be four numbers" % bad, "simulate", *BOX, "--attitude", bad)
        self.assertEqual(self.json_of("simulate", *BOX, "--attitude=0.71,0,-0.71,0", "--impacts=1", "--digits=3")["outcome"], "impact-limit")
        for command in ("simulate", "sequence"):
            ground = ["--stiffness", "1e9"] if command == "simulate" else []
            self.refused("does not approach the ground", command, "--angle", "30", "--velocity", "0,0,1", *ground)

    def test_a_list_is_one_value_of_a_sweep_and_no_axis(self):
        self.refused("a list cannot be swept", "sweep", "rod-10", "--set", "drop.velocity=0,0,-1:0,0,-2:3")
        self.refused("names cannot be swept", "sweep", "rod-10", "--set", "impact.law=newton,poisson")
        done = self.run_program("sweep", "rod-10", "--model", "discrete", "--set", "drop.velocity=0,0,-2", "--set", "drop.angle_deg=10:20:10")
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_a_motion_across_the_plane_is_not_planned_as_one_in_it(self):
        run = self.json_of("simulate", "--angle", "20", "--velocity", "0,0.5,-1", *BOX, "--impacts", "2", "--digits", "6")
        for row in run["impacts"]:
            self.assertAlmostEqual(row["velocity_after"][1], 0.5, delta=1e-9)  # nothing acts along y
        done = self.run_program("simulate", "--angle", "20", "--velocity", "0,0.5,-1", *BOX, "--impacts", "1", "--planar")
        self.assertIn("mirror image", done.stderr)
