# SPDX-License-Identifier: GPL-3.0-or-later
"""A box with its mass off its centre, Euler parameters, and rows of a run that are compared."""

import math

from run_folder import Folder

SIZE, MASS = (0.10566, 0.04394, 0.01905), 0.08814
BOX = ["--body", "box", "--size", "x".join(map(str, SIZE)), "--mass", str(MASS), "--stiffness", "1e9", "--gravity", "9.81"]
# Of a box with a battery at one end: what no symmetry helps.
CENTRE = (0.009, -0.004, 0.002)
INERTIA = (1.9e-5, 8.0e-5, 9.2e-5, 2e-6, -3e-6, 1e-6)


def words(numbers):
    return ",".join(map(repr, numbers))


def product(p, q):
    """Of Euler parameters: first q, then p."""
    a, b, c, d = p
    e, f, g, h = q
    return (a * e - b * f - c * g - d * h, a * f + b * e + c * h - d * g, a * g - b * h + c * e + d * f,
            a * h + b * g - c * f + d * e)


def turn(axis, degrees):
    """Euler parameters of a turn about the axis 1, 2 or 3."""
    half = math.radians(degrees) / 2
    return tuple(math.cos(half) if i == 0 else math.sin(half) if i == axis else 0.0 for i in range(4))


def rotated(q, v):
    return product(product(q, (0, *v)), (q[0], -q[1], -q[2], -q[3]))[1:]


def turned_back(q, v):
    return rotated((q[0], -q[1], -q[2], -q[3]), v)


def runge_kutta(slope, y, h):
    """A step of the classical method."""
    a = slope(y)
    b = slope([x + h / 2 * k for x, k in zip(y, a)])
    c = slope([x + h / 2 * k for x, k in zip(y, b)])
    d = slope([x + h * k for x, k in zip(y, c)])
    return [x + h / 6 * (k + 2 * m + 2 * n + o) for x, k, m, n, o in zip(y, a, b, c, d)]


def cross(a, b):
    return tuple(a[i - 2] * b[i - 1] - a[i - 1] * b[i - 2] for i in range(3))


def box_faces(size):
    """A box about the origin as triangles, counterclockwise seen from outside."""
    faces = []
    for axis in range(3):
        for side in (-1, 1):
            square = [[0.0] * 3 for _ in range(4)]
            for corner, signs in zip(square, ((-1, -1), (1, -1), (1, 1), (-1, 1))):
                for k, sign in zip((0, 1, 2), (side, *signs)):
                    corner[(axis + k) % 3] = sign * size[(axis + k) % 3] / 2
            a, b, c, d = square[::side]
            faces += [(a, b, c), (a, c, d)]
    return faces


def box_moments(size, mass):
    x, y, z = (s * s for s in size)
    return [mass * m / 12 for m in (y + z, x + z, x + y)]


def times(inertia, w):
    """The tensor of six numbers by a vector, body axes."""
    xx, yy, zz, xy, xz, yz = inertia
    return (xx * w[0] + xy * w[1] + xz * w[2], xy * w[0] + yy * w[1] + yz * w[2], xz * w[0] + yz * w[1] + zz * w[2])


class SpaceFolder(Folder):
    def same_rows(self, some, others, tolerance, change=lambda name, value: value):
        """Numbers agree within the tolerance of the sequence's sizes."""
        self.assertEqual(len(some["impacts"]), len(others["impacts"]))
        self.assertGreater(len(some["impacts"]), 0)
        for name in ("start", "impulse_normal", "peak_force", "velocity_after", "angular_velocity_after", "energy_loss"):
            rows = [[row[name] if isinstance(row[name], list) else [row[name]] for row in run["impacts"]] for run in (some, others)]
            size = max(abs(x) for row in rows[1] for x in row) + 1e-300
            if name == "energy_loss":
                size = max(row["energy_before"] for row in others["impacts"])
            for a, b in zip(*rows):
                for x, y in zip(a, change(name, b)):
                    self.assertLessEqual(abs(x - y), tolerance * size, name)
