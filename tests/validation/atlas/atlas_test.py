# SPDX-License-Identifier: GPL-3.0-or-later
"""`clatter atlas` against event simulations in 50 digits and in fractions, which know Newton's law alone."""

import json
import math
import random
import tempfile
import unittest
from fractions import Fraction
from pathlib import Path

from mpmath import mp, mpf

from run_folder import run

mp.dps = 50


def atlas(*arguments):
    result = run("atlas", *arguments, "--format", "json")
    assert result.returncode == 0, result.stderr
    return json.loads(result.stdout)


def rod_by_events(arms, gyration_square, e, first, most=200):
    """Impulses of a falling rod with contacts at -arms[0] and arms[1], m = |v| = 1: heights, velocities and times, the
    first contact on the ground and the other a unit above it."""
    place = (-arms[0], arms[1])
    v, spin = mpf(-1), mpf(0)  # the velocity of a contact: v - spin x
    heights = [mpf(1), mpf(1)]
    heights[first] = mpf(0)
    impulses = []
    while len(impulses) < most:
        speeds = [v - spin * x for x in place]
        arriving = [(heights[i] / -speeds[i], i) for i in (0, 1) if speeds[i] < 0]
        if not arriving:
            return impulses
        time, at = min(arriving)
        heights = [h + u * time for h, u in zip(heights, speeds)]
        heights[at] = mpf(0)
        impulse = -(1 + e) * speeds[at] / (1 + place[at] ** 2 / gyration_square)
        impulses.append(impulse)
        v += impulse
        spin -= place[at] * impulse / gyration_square
    return impulses


def box_by_events(size, e, tilt, most=100):
    """Order and approach speeds of the corners of a box, in fractions; tilt: a direction (x, y) in which it is higher."""
    length, width, thickness = size
    corners = [(x * length / 2, y * width / 2) for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    per_x, per_y = 12 / (length**2 + thickness**2), 12 / (width**2 + thickness**2)
    v, along, across = Fraction(-1), Fraction(0), Fraction(0)
    heights = [tilt[0] * x + tilt[1] * y for x, y in corners]
    heights = [h - min(heights) for h in heights]
    strikes = []
    while len(strikes) < most:
        speeds = [v + along * x + across * y for x, y in corners]
        arriving = [(heights[i] / -speeds[i], i) for i in range(4) if speeds[i] < 0]
        if not arriving:
            return strikes
        time, at = min(arriving)
        heights = [h + u * time for h, u in zip(heights, speeds)]
        x, y = corners[at]
        impulse = -(1 + e) * speeds[at] / (1 + per_x * x * x + per_y * y * y)
        strikes.append((at + 1, -speeds[at]))
        v, along, across = v + impulse, along + per_x * x * impulse, across + per_y * y * impulse
    return strikes


class Plane(unittest.TestCase):
    def test_the_rod_prints_one_half_one_one_half(self):
        text = run("atlas", "rod").stdout
        self.assertIn("P₁ : P₂ : P₃ = ½ : 1 : ½", text)
        self.assertIn("0.0717967697245", text)
        found = atlas("rod")
        self.assertEqual((found["impacts"], found["amplification"]["impact"]), (3, 2))
        self.assertAlmostEqual(found["critical_restitution"], 7 - 4 * math.sqrt(3), delta=1e-14)

    def test_counts_are_the_digits_of_half_pi(self):
        for moment, count in (("2.5e-5", 157), ("2.5e-7", 1571)):
            found = atlas("rod", "--inertia", f"1e-12,{moment},{moment}")
            self.assertEqual(found["impacts"], count)
            self.assertEqual(len(found["rows"]), count)

    def test_impulses_of_unequal_arms_are_those_of_an_event_simulation_in_50_digits(self):
        rng = random.Random(3)
        for e in ("1", "0.8", "0.45"):
            centre, moment = rng.uniform(0.05, 0.35), rng.uniform(0.005, 0.05)
            found = atlas("rod", "--centre", f"{centre!r},0,0", "--inertia", f"1e-9,{moment!r},{moment!r}", "--restitution", e)
            for first in (0, 1):
                exact = rod_by_events((mpf("0.5") + mpf(centre), mpf("0.5") - mpf(centre)), mpf(moment), mpf(e), first)
                rows = [row for row in found["rows"] if row["first"] == "ab"[first]]
                self.assertEqual(len(rows), len(exact))
                for row, impulse in zip(rows, exact):
                    self.assertLessEqual(abs(mpf(row["impulse"]) - impulse), 1e-12)

    def test_a_damped_rod_strikes_for_ever_and_says_so(self):
        found = atlas("rod", "--restitution", "0.07")
        self.assertIsNone(found["impacts"])
        self.assertAlmostEqual(sum(row["impulse"] for row in found["rows"]), 1, delta=1e-12)
        self.assertEqual(atlas("rod", "--restitution", "0.08")["impacts"], len(rod_by_events((mpf("0.5"),) * 2, mpf(1) / 12, mpf("0.08"), 0)))

    def test_the_simulator_on_ever_stiffer_ground_tends_to_the_atlas_with_the_first_power_of_the_tilt(self):
        limit = [row["impulse"] for row in atlas("phone", "--plane")["rows"]]
        distances = []
        for angle in ("0.8", "0.2"):
            result = run("compare", "--body", "box", "--size", "0.15x0.075x0.008", "--angle", angle, "--stiffness", "1e15",
                         "--impacts", "3", "--format", "json")
            self.assertEqual(result.returncode, 0, result.stderr)
            numbers = [one["numbers"]["impulse_normal"] for one in json.loads(result.stdout)["impacts"]]
            self.assertLess(max(one["limit_error"] for one in numbers), 1e-5)
            distances.append(max(abs(one["limit"] - impulse) for one, impulse in zip(numbers, limit)))
        self.assertLess(distances[0], 1e-3)
        self.assertAlmostEqual(math.log(distances[0] / distances[1], 4), 1, delta=0.1)  # the next order adds a tenth at 0.8°


class Space(unittest.TestCase):
    def test_sectors_of_a_box_are_what_their_directions_give_in_fractions(self):
        for size, e in (((2, 1, Fraction(1, 10)), Fraction(1)), ((3, 2, 1), Fraction(1, 2)), ((1, 1, 1), Fraction(1, 4))):
            given = "x".join(str(float(side)) for side in size)
            found = atlas("box", "--size", given, "--restitution", str(float(e)))
            self.assertAlmostEqual(sum(row["share"] for row in found["rows"]) + found["open_share"], 1, delta=1e-9)
            for row in found["rows"]:
                middle = math.radians((row["tilt_from_deg"] + row["tilt_to_deg"]) / 2)
                exact = box_by_events(tuple(map(Fraction, size)), e, (Fraction(math.cos(middle)), Fraction(math.sin(middle))))
                self.assertEqual(row["order"], " ".join(str(corner) for corner, _ in exact))
                for approach, speed in zip(row["approaches"].split(), exact):
                    self.assertLessEqual(abs(float(approach) - float(speed[1])), 1e-12)

    def test_the_hardest_blows_are_the_known_fractions(self):
        for body, words in (("rectangle", ("17/7", "121/49", "4 to 6")), ("square", ("17/7", "121/49", "4 to 6")),
                            ("triangle", ("77/27", "impact 4")), ("cube", ("2 times, at impact 2", "infinitely many impacts: none found")),
                            ("phone", ("2.425101", "2.456013", "impact 3"))):
            text = run("atlas", body).stdout
            for word in words:
                self.assertIn(word, text, body)

    def test_a_face_is_the_one_that_the_attitude_brings_down(self):
        found = [atlas("box", "--size", "3x2x1", "--orientation", str(n)) for n in (1, 3, 5)]
        self.assertEqual(len({round(one["amplification"]["second"], 9) for one in found}), 3)
        turned = atlas("box", "--size", "2x1x3", "--angle", "0")
        self.assertAlmostEqual(min(abs(turned["amplification"]["second"] - one["amplification"]["second"]) for one in found), 0,
                               delta=1e-12)

    def test_what_has_no_footprint_or_no_one_restitution_is_refused_in_one_line(self):
        for arguments, status in ((("rot",), 2), (("box",), 2), (("triangle", "--size", "1x1x1"), 2), (("rod", "--body", "box"), 2),
                                  (("phone-damped",), 4), (("rod", "--restitution", "2"), 2), (("triangle", "--plane"), 2)):
            result = run("atlas", *arguments)
            self.assertEqual((result.returncode, result.stdout, result.stderr.count("\n")), (status, "", 1), (arguments, result.stderr))

    def test_a_picture_is_drawn(self):
        with tempfile.TemporaryDirectory() as folder:
            for body in ("rod", "cube"):
                path = Path(folder) / f"{body}.svg"
                self.assertEqual(run("atlas", body, "--plot", str(path)).returncode, 0)
                self.assertIn("velocity change", path.read_text(encoding="utf-8"))
