# SPDX-License-Identifier: GPL-3.0-or-later
"""Bodies that are let go above the ground, and that turn about a lower edge until they lie: the first touch, and what is refused."""

import math
import re

from run_folder import rows_of
from space_folder import SpaceFolder, turn, words

TOAST = ["--body", "box", "--size", "0.102x0.102x0.015", "--mass", "0.2"]
# Size, Euler parameters (not of unit length), angular velocity, velocity and height at the release; then time, attitude, angular
# velocity and downward velocity at the first touch: Euler's equations integrated by Taylor series with 40 digits, and bisection of
# the height of the lowest corner, found first on a grid of 2 ms.
THROWN = [
    ("0.15x0.075x0.008", (1, 0.5, -0.25, 2), (7, -11, 3), (0.2, 0, -0.5), 0.9,
     0.36851231658449952, (-0.95055578626964271, 0.20695904998459494, -0.22658278656383569, 0.047664343609689551),
     (5.6445484546797149, -7.4777973535191170, 6.2940407288534542), -4.1151058256939403),
    ("0.1x0.06x0.03", (3, 1, 2, -1), (-20, 5, 9), (0, -0.4, 1.2), 0.5,
     0.44888126938261225, (0.35600659734540949, 0.55166475482488462, -0.74778489930991865, 0.098706865488669246),
     (-18.254890123124441, 9.1662964234097329, -2.1450833854664486), -3.2035252526434262),
    ("0.02x0.02x0.002", (1, 2, 0, 0), (40, 1, -3), (0.1, 0.1, 0), 1.1,
     0.47124259203852405, (-0.40164266521727891, -0.88721890402845431, -0.20560170239952176, 0.096196287777271804),
     (40.005427845139642, 0.95319179191860661, -2.9423066351325093), -4.6228898278979210)]
BRICK = ["--body", "box", "--size", "0.2x0.1x0.06", "--mass", "2"]
GRAVITY = 9.81


class Release(SpaceFolder):
    def touches(self, *flags):
        """The first touch by the discrete model and by the simulator."""
        return (self.json_of("sequence", *flags, "--restitution", "0.5", "--impacts", "2"),
                self.json_of("simulate", *flags, "--stiffness", "1e9", "--impacts", "1", "--digits", "3"))

    def check(self, touch, key, expected, tolerance=1e-13):
        for one, other in zip(touch[key], expected, strict=True):
            self.assertAlmostEqual(one, other, delta=tolerance * (1 + max(map(abs, expected))), msg=key)

    def test_toast_from_a_table_lands_as_calculated_by_hand(self):
        """The height of the lowest corner, 0.74 - 0.2 t - g t^2/2 less its offset at -35 - 9 t, has its first root there."""
        flags = [*TOAST, "--release-height", "0.74", "--release-angle=-35", "--release-velocity=0.3,0,-0.2",
                 "--release-angular-velocity=0,9,0"]
        for run in self.touches(*flags):
            touch = run["first_touch"]
            self.assertAlmostEqual(touch["time"], 0.358363808024947, delta=2e-15)
            self.check(touch, "velocity", (0.3, 0, -3.71554895672), 2e-12)
            angle = math.degrees(2 * math.atan2(-touch["attitude"][2], touch["attitude"][0]))
            self.assertAlmostEqual(math.remainder(angle + 219.794603570594, 360), 0, delta=1e-11)
            self.assertAlmostEqual(run["impacts"][0]["contact_angle_deg"], 180 - 140.205396429, delta=1e-8)

    def test_bodies_that_tumble_touch_when_and_as_in_forty_digits(self):
        for size, attitude, turn, velocity, height, time, touching, turning, falling in THROWN:
            runs = self.touches("--body", "box", "--size", size, "--mass", "0.2", "--gravity", "9.81", "--release-height", str(height),
                                "--release-attitude=" + words(c / math.hypot(*attitude) for c in attitude),
                                "--release-velocity=" + words(velocity), "--release-angular-velocity=" + words(turn))
            for run in runs:
                touch = run["first_touch"]
                self.assertAlmostEqual(touch["time"], time, delta=1e-14)
                self.check(touch, "angular_velocity", turning)
                self.check(touch, "velocity", (*velocity[:2], falling))
                same = math.copysign(1, touch["attitude"][0] * touching[0])
                self.check(touch, "attitude", [same * c for c in touching])
            self.assertLessEqual(abs(runs[0]["first_touch"]["time"] - time), runs[0]["first_touch"]["time_error"])

    def test_a_release_at_rest_is_a_fall_from_that_height(self):
        """Also in the plane, with a turn of more than one round, and where only the lowest point's height is given."""
        for body in (["--angle", "30"], ["--orientation", "7"], ["--attitude=0.9,0.3,0.1,0.3"]):
            for of in ("height", "clearance"):
                flags = [*TOAST, *body, "--restitution", "0.4", "--friction", "0.2", "--impacts", "3"]
                fallen = self.json_of("sequence", *flags, "--" + of, "0.3")["impacts"]
                released = self.json_of("sequence", *flags, "--release-" + of, "0.3")["impacts"]
                for one, other in zip(fallen, released, strict=True):
                    for key in ("start", "impulse_normal", "contact_angle_deg"):
                        self.assertAlmostEqual(one[key], other[key], delta=1e-11 * (1 + abs(one[key])), msg=(body, of, key))
        turned = [self.json_of("sequence", *TOAST, "--release-height", "0.3", f"--release-angle={angle}", "--impacts", "2")
                  for angle in (-35, 325, -755)]
        self.assertEqual([run["impacts"] for run in turned[1:]], [turned[0]["impacts"]] * 2)

    def test_a_spin_at_the_release_is_an_angular_velocity_about_y(self):
        flags = [*TOAST, "--release-height", "0.7", "--release-angle", "10", "--impacts", "2"]
        self.assertEqual(*(self.json_of("sequence", *flags, turn)["impacts"] for turn in ("--release-spin=-9", "--release-angular-velocity=0,-9,0")))
        self.refused("give one of them", "sequence", *flags, "--release-spin=1", "--release-angular-velocity=0,1,0")

    def test_histories_begin_at_the_release(self):
        self.run_program("simulate", *TOAST, "--release-height", "0.5", "--release-angle", "10", "--release-angular-velocity=0,3,0",
                         "--stiffness", "1e9", "--impacts", "1", "--digits", "3", "--history", "h.csv")
        first = self.records("h.csv")[0]
        self.assertAlmostEqual(float(first["z"]), 0.5, delta=1e-12)
        self.assertAlmostEqual(float(first["vz"]), 0, delta=1e-12)

    def test_what_cannot_be_is_told_in_one_line(self):
        toast, release = " ".join(TOAST), " ".join([*TOAST, "--release-height 0.5 --angle 5"])
        self.each_refused({
            f"sequence {toast} --release-height 0.001 --angle 5": "must be greater than",
            f"sequence {toast} --release-height 0.5": "--release-angle: required",
            f"sequence {toast} --release-velocity=1,0,0 --angle 5": "only for a drop with drop.release.height",
            **{f"sequence {release} {other}": "give one of them" for other in ("--speed 2", "--release-clearance 2", "--release-angle 3")},
            f"sequence {release} --incline 3": "0 or left out with drop.release.height",
            f"sequence {release} --gravity 0": "never reaches the ground",
            f"simulate {release} --gravity 0 --stiffness 1e9": "never reaches the ground", f"gradient {release}": "must be left out"})


class Toppling(SpaceFolder):
    def rate(self, extents, gyration_square, height, centre=(0, 0)):
        """Angular speed at the touch of a box with these extents along x and z, its centre of mass off the middle."""
        side, up = extents[0] / 2 - centre[0], extents[1] / 2 + centre[1]
        angle = math.asin(height / extents[0])
        work = GRAVITY * (side * math.sin(angle) - up * (1 - math.cos(angle)))  # of the weight over the turn
        return math.sqrt(2 * work / (gyration_square + side**2 + up**2)), side, up

    def check_against(self, flags, height, rate, side, up):
        drop = ("sequence", *flags, "--restitution", "0.5", "--friction", "0.3", "--impacts", "1")
        toppled = self.json_of(*drop, "--topple", str(height))
        told = self.json_of(*drop, "--gravity", str(GRAVITY), "--velocity", words((-rate * up, 0, -rate * side * (1 + 1e-12))),
                            "--angular-velocity", words((0, -rate, 0)))
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
            self.check_against([*BRICK, *pose], height, *self.rate(*body[:2], height, *body[2:]))

    def test_the_edge_that_a_slab_turned_about_stays_where_it_is_and_makes_no_hops(self):
        for slab in (["--size", "0.25x0.17x0.008"], ["--size", "0.25x0.17x0.008", "--centre", "0.006,0,0.0005"]):
            run = self.json_of("sequence", "--body", "box", *slab, "--topple", "0.1", "--restitution", "0.5", "--friction", "0.3")
            self.assertEqual((len(run["impacts"]), run["outcome"]), (1, "sustained-contact"))
            self.assertIn("end b stays on the ground", run["message"])
            self.assertTrue(run["impacts"][0]["predictable"])
            self.assertLess(run["accuracy"]["achieved"], 1e-9)

    def test_no_raise_beyond_the_balance_is_taken_and_the_balance_itself_is(self):
        told = self.refused("drop.topple: must be at most", "sequence", *BRICK, "--orientation", "1", "--topple", "0.06")
        most = re.search(r"at most (\S+) m, where ", told)[1]
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
