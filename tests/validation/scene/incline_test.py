# SPDX-License-Identifier: GPL-3.0-or-later
"""Sloping ground: what its key and flag mean, which commands take it, and what is refused."""

import math

from run_folder import EmptyFolder, printed, rows_of

BOX = ["--body", "box", "--size", "0.3x0.2x0.1", "--angle", "10", "--restitution", "0.6", "--friction", "0.3"]
SCENE = ("[drop]\nangle_deg = 10\n[world]\nincline_deg = 20\n[body]\nshape = 'box'\nsize = [0.3, 0.2, 0.1]\n"
         "[impact]\nrestitution = 0.6\nfriction = 0.3\n")


class Incline(EmptyFolder):
    def test_a_file_has_the_key_and_level_ground_none(self):
        by_flags = self.json_of("sequence", *BOX, "--incline", "20")
        self.assertEqual(self.json_of("sequence", self.write("slope.toml", SCENE))["impacts"], by_flags["impacts"])
        self.assertNotIn("incline_deg", self.json_of("sequence", *BOX)["scene"]["world"])
        for degrees, side in ((20, "right"), (-20, "left")):
            self.assertIn(f"slopes 20° down to the {side}", " ".join(printed("sequence", *BOX, "--incline", str(degrees), status=(0, 3)).split()))

    def test_the_simulator_tends_to_the_discrete_model_as_the_ground_gets_stiff(self):
        def velocity(*words):
            return self.json_of(words[0], *BOX[:6], "--incline", "20", "--impacts", "1", *words[1:])["impacts"][0]["velocity_after"]

        discrete = velocity("sequence", "--friction", "0.3")
        errors = [math.dist(velocity("simulate", "--sliding-friction", "0.3", "--planar", "--stiffness", stiffness), discrete)
                  for stiffness in ("1e9", "1e11", "1e13")]
        self.assertLess(errors[1], errors[0] / 2)
        self.assertLess(errors[2], errors[1] / 2)

    def test_a_sweep_and_a_map_over_the_slope_run_the_model_of_each(self):
        scene = self.write("slope.toml", SCENE)
        rows = rows_of("sweep", scene, "--set", "world.incline_deg=-20:20:10", "--model", "discrete", status=(0, 3))
        self.assertEqual(len(rows), 5)
        for row in rows:
            degrees = row["world.incline_deg"]
            flags = ("--incline", degrees) if float(degrees) else ("--gravity", "9.81")
            alone = self.json_of("sequence", self.write("one.toml", SCENE.replace("incline_deg = 20", "gravity = 9.81")), *flags)
            self.assertEqual(float(row["total_normal_impulse"]), alone["total_normal_impulse"])

    def test_what_a_slope_does_not_go_with_is_one_line(self):
        box = " ".join(BOX)
        self.each_refused({f"sequence {box} --incline 95": "from -89 to 89 degrees", f"sequence {box} --incline 20 --gravity 0": "world.gravity is 0",
                           f"sequence {box} --incline 20 --height 1": "0 or left out with drop.height",
                           f"explain 1 {box} --incline 20": "clatter explain, whose ground is level",
                           f"shock {box} --incline 20 --probe c:0,0,0": "whose ground is level",
                           "plan --angle 10 --incline 20 --stiffness 1e9": "clatter plan, whose ground is level"})
