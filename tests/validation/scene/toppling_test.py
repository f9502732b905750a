# SPDX-License-Identifier: GPL-3.0-or-later
"""Bodies that turn about a lower edge until they lie: the motion at the touch, and what is refused."""

import math
import re

from run_folder import rows_of
from space_folder import SpaceFolder, turn, words

BRICK = ["--body", "box", "--size", "0.2x0.1x0.06", "--mass", "2"]
GRAVITY = 9.81


class Toppling(SpaceFolder):
    def rate(self, extents, gyration_square, height, centre=(0, 0)):
        """Angular speed at the touch of a box with these extents along x and z, its centre of mass off the middle."""
        side, up = extents[0] / 2 - centre[0], extents[1] / 2 + centre[1]
        angle = math.asin(height / extents[0])
        work = GRAVITY * (side * math.sin(angle) - up * (1 - math.cos(angle)))  # of the weight over the turn
        return math.sqrt(2 * work / (gyration_square + side**2 + up**2)), side, up

    def check_against(self, flags, rate, side, up):
        toppled = self.json_of("sequence", *flags, "--restitution", "0.5", "--friction", "0.3", "--impacts", "3")
        given = [flag for flag in flags if flag != "--topple"]
        given.remove(flags[flags.index("--topple") + 1])
        told = self.json_of("sequence", *given, "--gravity", str(GRAVITY), "--restitution", "0.5", "--friction", "0.3",
                            "--velocity", words((-rate * up, 0, -rate * side * (1 + 1e-12))), "--angular-velocity", words((0, -rate, 0)),
                            "--impacts", "1")
        for key in ("impulse", "velocity_after", "angular_velocity_after"):
            size = max(map(abs, told["impacts"][0][key]))
            for one, other in zip(toppled["impacts"][0][key], told["impacts"][0][key], strict=True):
                self.assertAlmostEqual(one, other, delta=1e-11 * size, msg=key)
        self.assertEqual(toppled["scene"]["drop"]["speed"], None)

    def test_the_weights_work_about_the_edge_is_the_energy_at_the_touch(self):
        """Of the brick, turned about the vertical, and standing: of orientation 1 the face -x is down, and body z points to -x of
        the world; of 2 +x is down, and body z points to +x."""
        along, across = (0.2**2 + 0.06**2) / 12, (0.1**2 + 0.06**2) / 12
        inertia = ["--inertia", "0.004,0.009,0.008", "--centre", "0.02,0,0.01"]
        for pose, height, *body in (*((["--angle", "0"], height, (0.2, 0.06), along) for height in (0.001, 0.05, 0.1)),
                                    (["--attitude", words(turn(3, 90))], 0.03, (0.1, 0.06), across),
                                    ([*inertia, "--orientation", "1"], 0.01, (0.06, 0.2), 0.009 / 2, (-0.01, 0.02)),
                                    ([*inertia, "--orientation", "2"], 0.01, (0.06, 0.2), 0.009 / 2, (0.01, -0.02))):
            self.check_against([*BRICK, *pose, "--topple", str(height)], *self.rate(*body[:2], height, *body[2:]))

    def test_the_edge_that_a_slab_turned_about_stays_where_it_is_and_makes_no_hops(self):
        for slab in (["--size", "0.25x0.17x0.008"], ["--size", "0.25x0.17x0.008", "--centre", "0.006,0,0.0005"]):
            run = self.json_of("sequence", "--body", "box", *slab, "--topple", "0.1", "--restitution", "0.5", "--friction", "0.3")
            self.assertEqual((len(run["impacts"]), run["outcome"]), (1, "sustained-contact"))
            self.assertIn("end b stays on the ground", run["message"])
            self.assertTrue(run["impacts"][0]["predictable"])
            self.assertLess(run["accuracy"]["achieved"], 1e-9)

    def test_no_raise_beyond_the_balance_is_taken_and_the_balance_itself_is(self):
        done = self.run_program("sequence", *BRICK, "--orientation", "1", "--topple", "0.06")
        self.assertEqual(done.returncode, 2)
        most = re.search(r"\Aclatter: .*drop.topple: must be at most (\S+) m, where [^\n]+\n\Z", done.stderr).group(1)
        self.assertAlmostEqual(float(most), 0.06 * 0.03 / math.hypot(0.03, 0.1), delta=1e-15)
        self.assertTrue(self.json_of("sequence", *BRICK, "--orientation", "1", "--topple", most)["impacts"])

    def test_what_does_not_lie_or_is_thrown_is_refused(self):
        self.each_refused({"--angle 10": "does not arrive on a face", "--angle 0 --tilt 5": "on a face", "--orientation 9": "on a face",
                           "--angle 0 --speed 1": "not both", "--angle 0 --gravity 0": "left out where world.gravity is 0",
                           "--angle 0 --velocity 0,0,-1": "not both"}, "sequence", *BRICK, "--topple", "0.01")
        self.refused("neither rod nor box", "sequence", "--body", "sphere", "--radius", "0.1", "--topple", "0.01")

    def test_the_continuous_model_starts_with_the_same_energy_and_a_sweep_raises_higher(self):
        ground = ["--stiffness", "1e8", "--damping", "1e5"]
        scene = [*BRICK, "--angle", "0", "--topple", "0.05", *ground, "--impacts", "1"]
        energies = [self.json_of(command, *scene)["impacts"][0]["energy_before"] for command in ("sequence", "simulate")]
        self.assertAlmostEqual(*energies, delta=1e-12 * energies[0])
        scene = self.write("brick.toml", "drop = { angle_deg = 0 }\nbody = { shape = 'box', size = [0.2, 0.1, 0.06], mass = 2 }\n")
        rows = rows_of("sweep", scene, "--set", "drop.topple=0.01:0.05:0.01", "--columns", "energy_before_1")
        self.assertEqual(len(rows), 5)
        self.assertAlmostEqual(float(rows[4]["energy_before_1"]), energies[0], delta=1e-12 * energies[0])
