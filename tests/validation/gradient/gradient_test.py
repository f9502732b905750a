# SPDX-License-Identifier: GPL-3.0-or-later
"""clatter gradient: its derivatives are the slopes of clatter sequence, and it says where there are none."""

import json
import math
import unittest

from run_folder import run

NUMBERS = {"start": "start", "velocity_after_z": ("velocity_after", 2), "velocity_after_x": ("velocity_after", 0),
           "angular_velocity_after_y": ("angular_velocity_after", 1), "impulse_normal": "impulse_normal",
           "impulse_tangential": "impulse_tangential"}
AXES = "xyz"
NUMBERS_IN_SPACE = {"start": "start", **{f"{ours}_{axis}": (theirs, k) for ours, theirs in
                                         (("velocity_after", "velocity_after"), ("angular_velocity_after", "angular_velocity_after"),
                                          ("impulse", "impulse")) for k, axis in enumerate(AXES)}}
STEP = 1e-5  # of each number, beside its size: curvature and rounding balance


def told(command, flags):
    arguments = [word for key, value in flags.items() for word in (f"--{key}", repr(value) if isinstance(value, float) else str(value))]
    done = run(command, *arguments, "--format", "json")
    return done, json.loads(done.stdout) if done.stdout else None


def number(impact, key):
    return impact[key] if isinstance(key, str) else impact[key[0]][key[1]]


class Slopes(unittest.TestCase):
    """Of `clatter sequence`, by differences, beside the derivatives."""
    numbers = NUMBERS

    def slopes(self, flags, flag, step):
        low, high = (told("sequence", {**flags, flag: flags[flag] + way * step})[1]["impacts"] for way in (-1, 1))
        self.assertEqual([i["end"] for i in low], [i["end"] for i in high])
        return [{name: (number(b, key) - number(a, key)) / (2 * step) for name, key in self.numbers.items()} for a, b in zip(low, high)]

    def check(self, flags, parameter, flag, per=1.0):
        done, found = told("gradient", flags)
        self.assertEqual(done.returncode, 0, (flags, done.stderr))
        rows = [row for row in found["gradients"] if row["parameter"] == parameter]
        slopes = self.slopes(flags, flag, STEP * flags[flag])
        self.assertGreaterEqual(len(slopes), len(rows))
        for row, slope in zip(rows, slopes):
            size = max(1.0, *(abs(row[name]) for name in self.numbers))
            for name in self.numbers:
                self.assertAlmostEqual(row[name], slope[name] * per, delta=1e-4 * size, msg=(flags, parameter, row["n"], name))


class Gradient(Slopes):
    def test_of_a_drop_from_a_height_they_are_those_at_that_height(self):
        for flag in ("height", "clearance"):
            flags = {"body": "box", "size": "0.3x0.1x0.1", "angle": 25.0, flag: 0.8, "restitution": 0.6, "friction": 0.2, "impacts": 2}
            for name in (flag, "restitution", "friction"):
                self.check(flags, name, name)
            self.check(flags, "angle", "angle", 180 / math.pi)

    def test_a_fold_has_none_and_the_exit_status_says_so(self):
        done, found = told("gradient", {"angle": 58.488442288312, "impacts": 2})
        self.assertEqual(done.returncode, 3)
        self.assertEqual({row["n"] for row in found["gradients"]}, {1})
        self.assertIn("impact 2", found["shortfall"])
        self.assertEqual(done.stderr.count("\n"), 1)

    def test_a_flat_landing_has_none_by_the_angle(self):
        done, found = told("gradient", {"angle": 0, "gravity": 9.81, "restitution": 0.5, "impacts": 2})
        self.assertEqual(done.returncode, 3)
        self.assertEqual({row["parameter"] for row in found["gradients"]}, {"speed", "restitution", "friction"})
        self.assertEqual([(one["parameter"], one["from_impact"]) for one in found["refused"]], [("angle", 1)])


class GradientInSpace(Slopes):
    numbers = NUMBERS_IN_SPACE

    def test_of_a_drop_from_a_height_they_are_those_at_that_height(self):
        for flag in ("height", "clearance"):
            flags = {"body": "box", "size": "0.3x0.2x0.1", "angle": 25.0, "tilt": 15.0, flag: 0.8, "restitution": 0.6, "impacts": 2}
            self.check(flags, flag, flag)
            for name in ("angle", "tilt"):
                self.check(flags, name, name, 180 / math.pi)
