# SPDX-License-Identifier: GPL-3.0-or-later
"""`clatter atlas`: what it prints of rods and boxes; its numbers are claims of tests/analytic/near_flat."""

import math

from run_folder import EmptyFolder, json_of, printed


def atlas(*arguments):
    return json_of("atlas", *arguments)


class Atlas(EmptyFolder):
    def test_the_rod_prints_one_half_one_one_half(self):
        for words in ("P₁ : P₂ : P₃ = ½ : 1 : ½", "0.0717967697245"):
            self.assertIn(words, printed("atlas", "rod"))
        found = atlas("rod")
        self.assertEqual((found["impacts"], found["amplification"]["impact"]), (3, 2))
        self.assertAlmostEqual(found["critical_restitution"], 7 - 4 * math.sqrt(3), delta=1e-14)

    def test_a_damped_rod_strikes_for_ever_and_says_so(self):
        found = atlas("rod", "--restitution", "0.07")
        self.assertIsNone(found["impacts"])
        self.assertAlmostEqual(sum(row["impulse"] for row in found["rows"]), 1, delta=1e-12)
        self.assertGreater(atlas("rod", "--restitution", "0.08")["impacts"], 3)  # above 7 - 4 sqrt(3)

    def test_the_hardest_blows_are_the_known_fractions(self):
        for body, words in (("rectangle", ("17/7", "121/49", "4 to 6")), ("square", ("17/7", "121/49", "4 to 6")),
                            ("triangle", ("77/27", "impact 4")), ("cube", ("2 times, at impact 2", "infinitely many impacts: none found")),
                            ("handset", ("2.425101", "2.456013", "impact 3"))):
            for word in words:
                self.assertIn(word, printed("atlas", body), body)

    def test_the_phone_is_that_of_the_cases(self):
        of_case = atlas("phone-damped", "--restitution", "1", "--friction", "0", "--angle", "0", "--tilt", "0")
        self.assertEqual(atlas("phone")["amplification"], of_case["amplification"])

    def test_a_face_is_the_one_that_the_attitude_brings_down(self):
        found = [atlas("box", "--size", "3x2x1", "--orientation", str(n)) for n in (1, 3, 5)]
        self.assertEqual(len({round(one["amplification"]["second"], 9) for one in found}), 3)
        turned = atlas("box", "--size", "2x1x3", "--angle", "0")
        self.assertLess(min(abs(turned["amplification"]["second"] - one["amplification"]["second"]) for one in found), 1e-12)

    def test_what_has_no_footprint_or_no_one_restitution_is_refused_in_one_line(self):
        self.each_refused({"rot": "rot", "box": "--size", "triangle --size 1x1x1": "--size", "rod --body box": "--body",
                           "rod --restitution 2": "--restitution", "triangle --plane": "--plane"}, "atlas")
        self.refused("", "atlas", "phone-damped", status=4)

    def test_a_picture_is_drawn(self):
        for body in ("rod", "cube"):
            printed("atlas", body, "--plot", self.path("p.svg"))
            self.assertIn("velocity change", self.read("p.svg"))
