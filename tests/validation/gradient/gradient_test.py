# SPDX-License-Identifier: GPL-3.0-or-later
"""clatter gradient: its derivatives are the slopes of clatter sequence, and it says where there are none."""

import json
import math
import unittest

from run_folder import run

VECTORS = {f"{name}_{axis}": (name, k) for name in ("velocity_after", "angular_velocity_after", "impulse") for k, axis in enumerate("xyz")}
# Of drops in the plane, and of others.
NUMBERS = {"start": "start", **{name: VECTORS[name] for name in ("velocity_after_z", "velocity_after_x", "angular_velocity_after_y")},
           "impulse_normal": "impulse_normal", "impulse_tangential": "impulse_tangential"}
NUMBERS_IN_SPACE = {"start": "start", **VECTORS}
STEP = 1e-5  # of each number, beside its size: curvature and rounding balance


def told(command, flags):
    arguments = [word for key, value in flags.items() for word in (f"--{key}", repr(value) if isinstance(value, float) else str(value))]
    done = run(command, *arguments, "--format", "json")
    return done, json.loads(done.stdout) if done.stdout else None


def number(impact, key):
    return impact[key] if isinstance(key, str) else impact[key[0]][key[1]]


class Gradient(unittest.TestCase):
    def check(self, flags, flag):
        """Derivatives by this number are the differences of clatter sequence."""
        numbers = NUMBERS_IN_SPACE if "tilt" in flags else NUMBERS
        step, per = STEP * flags[flag], 180 / math.pi if flag in ("angle", "tilt") else 1
        low, high = (told("sequence", {**flags, flag: flags[flag] + way * step})[1]["impacts"] for way in (-1, 1))
        self.assertEqual([i["end"] for i in low], [i["end"] for i in high])
        done, found = told("gradient", flags)
        self.assertEqual(done.returncode, 0, (flags, done.stderr))
        rows = [row for row in found["gradients"] if row["parameter"] == flag]
        self.assertGreaterEqual(len(low), len(rows))
        for row, a, b in zip(rows, low, high):
            size = max(1.0, *(abs(row[name]) for name in numbers))
            for name, key in numbers.items():
                slope = (number(b, key) - number(a, key)) / (2 * step) * per
                self.assertAlmostEqual(row[name], slope, delta=1e-4 * size, msg=(flags, flag, row["n"], name))

    def test_of_a_drop_from_a_height_they_are_those_at_that_height(self):
        for flag in ("height", "clearance"):
            flags = {"body": "box", "size": "0.3x0.1x0.1", "angle": 25.0, flag: 0.8, "restitution": 0.6, "impacts": 2}
            for name in (flag, "restitution", "friction", "angle"):
                self.check({**flags, "friction": 0.2}, name)
            for name in (flag, "angle", "tilt"):
                self.check({**flags, "size": "0.3x0.2x0.1", "tilt": 15.0}, name)

    def test_a_fold_has_none_and_the_exit_status_says_so(self):
        done, found = told("gradient", {"angle": 58.488442288312, "impacts": 2})
        self.assertEqual(done.returncode, 3)
        self.assertEqual({row["n"] for row in found["gradients"]}, {1})
        self.assertIn("impact 2", found["shortfall"])
        self.assertEqual(done.stderr.count("\n"), 1)
