# SPDX-License-Identifier: GPL-3.0-or-later
"""Bodies that are let go above the ground: the first touch in both models, and what is refused."""

import math

from space_folder import SpaceFolder, words

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
        runs = [self.json_of("sequence", *flags, turn)["impacts"] for turn in ("--release-spin=-9", "--release-angular-velocity=0,-9,0")]
        self.assertEqual(*runs)
        self.refused("give one of them", "sequence", *flags, "--release-spin=1", "--release-angular-velocity=0,1,0")

    def test_histories_begin_at_the_release(self):
        self.run_program("simulate", *TOAST, "--release-height", "0.5", "--release-angle", "10", "--release-angular-velocity=0,3,0",
                         "--stiffness", "1e9", "--impacts", "1", "--digits", "3", "--history", "h.csv")
        first = self.records("h.csv")[0]
        self.assertAlmostEqual(float(first["z"]), 0.5, delta=1e-12)
        self.assertAlmostEqual(float(first["vz"]), 0, delta=1e-12)

    def test_the_flight_is_explained(self):
        flags = [*TOAST, "--release-height", "0.5", "--release-angular-velocity=1,3,2"]
        said = self.run_program("explain", *flags, "--angle", "10", "1").stdout
        self.assertIn("After the release the body flies freely", said)
        said = self.run_program("explain", *TOAST, "--release-height", "0.5", "--release-angle", "10", "1").stdout
        self.assertIn("since the release", said)

    def test_what_cannot_be_is_told_in_one_line(self):
        release = ["--release-height", "0.5", "--angle", "5"]
        for flags, words_said in (
                (["--release-height", "0.001", "--angle", "5"], "must be greater than"),
                (["--release-height", "0.5"], "--release-angle: required"),
                (["--release-velocity=1,0,0", "--angle", "5"], "only for a drop with drop.release.height"),
                ([*release, "--speed", "2"], "give one of them"),
                ([*release, "--release-clearance", "2"], "give one of them"),
                ([*release, "--release-angle", "3"], "give one of them"),
                ([*release, "--incline", "3"], "0 or left out with drop.release.height"),
                ([*release, "--gravity", "0"], "never reaches the ground")):
            self.refused(words_said, "sequence", *TOAST, *flags)
        self.refused("never reaches the ground", "simulate", *TOAST, *release, "--gravity", "0", "--stiffness", "1e9")
        self.refused("must be left out", "gradient", *TOAST, *release)
