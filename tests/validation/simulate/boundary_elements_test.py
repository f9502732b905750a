# SPDX-License-Identifier: GPL-3.0-or-later
"""Drops on an elastic half-space, judged by boundary elements, which have nothing of the program but E*, attitudes, the
height of the peak and the speed of approach.

The boxes are rigid and their patch is seen along the ground's normal, as Boussinesq's theory has it; there is neither
friction nor damping.  The error of the grid, 0.05 % of a flat's force, 0.1 % of a cube's corner's, 0.9 % at most, counts
against the program; that of the integration in time is 0.1 %.  Corners and edges are never too hard.  Edges lack ever
more as a logarithm of their length: the phone's of 71 mm and 146 mm, dropped from 1 m, 27 % and 31 %.  Peak force and
duration of the impact, by an integration of the free body, which may turn, are held within the root of what the force
is, which is what a force in proportion to the depth makes of it, one that grows faster less.

The ground sinks by u under a pressure p as Boussinesq says; where the box touches it u is the depth g of the box below the
ground at rest, elsewhere p = 0 and u > g.  The pressure is constant over each of a grid of equal rectangles; Love's closed
form is what one of them does at the middle of another.  Of all p >= 0 the one sought makes p·Kp/2 - g·p least: conjugate
gradients with that bound (Polonsky and Keer, 1999), K p by FFT.  All this is for E* = 1; forces are in proportion to it.
"""

import itertools
import math

import numpy as np
from run_folder import EmptyFolder

PHONE, MASS, GRAVITY = (0.146, 0.071, 0.008), 0.165, 9.81
DROP = ("--floor", "concrete", "--clearance", "1", "--gravity", repr(GRAVITY), "--impacts", "1", "--digits", "6",
        "--history", "history.csv")
FLAT, NARROW, CUBE_CORNER, CORNER, EDGE, LONG_EDGE = 0.03, 0.035, 0.11, 0.22, 0.25, 0.32  # the most that a force is off by
LONGEST = 50               # length over depth of an edge that is not a long one
GRID, ENERGY = 0.01, 0.01  # the most that a grid may err by, and that an impact's energy may be off by
REBOUND, TURNING = 0.01, 0.02
SIGNS = np.array(list(itertools.product((-1, 1), repeat=3)))
EDGES = [(i, j) for i, j in itertools.combinations(range(8), 2) if np.sum(SIGNS[i] != SIGNS[j]) == 1]


def influence(length, dx, dy):
    """Transform of u at the middles of a periodic grid's cells under a unit pressure on one of them (Love, 1929)."""
    def primitive(x, y):
        return x * np.arcsinh(y / np.abs(x)) + y * np.arcsinh(x / np.abs(y))
    i = np.fft.fftfreq(length, 1 / length)
    x, y = np.meshgrid(i * dx, i * dy, indexing="ij")
    return np.fft.rfft2(sum(a * b * primitive(x + a * dx / 2, y + b * dy / 2) for a in (1, -1) for b in (1, -1)) / np.pi)


def pressure(g, dx, dy, start=None, accuracy=1e-4):
    """Pressure on m x m cells, dx by dy, whose depths are g, so that u is right to `accuracy` of the deepest."""
    m, may, least = len(g), g > 0, accuracy * g.max()
    length = max(2 * m, 9 * (m - 1) // 4)  # cells of one end are no neighbours of the other's; few prime factors
    transform = influence(length, dx, dy)

    def sunk(p):
        return np.fft.irfft2(transform * np.fft.rfft2(p, (length, length)), (length, length))[:m, :m]
    p = np.where(may, g / np.sqrt(dx * dy * g.size) if start is None else start, 0)
    direction, before, residual = np.zeros_like(p), 0, g - sunk(p)
    for _ in range(2000):
        pressed = p > 0
        left = np.where(pressed, residual, 0)
        size = np.sum(left * left)
        if np.abs(left).max() <= least and not np.any(residual[may & ~pressed] > least):
            return p
        direction = np.where(pressed, left + (size / before * direction if before else 0), 0)
        moved = sunk(direction)
        step = np.sum(left * direction) / np.sum(direction * moved)
        p, residual, before = p + step * direction, residual - step * moved, size
        enters = may & ~pressed & (residual > 0)
        if np.any(p < 0) or np.any(enters):
            p = np.maximum(p, 0)
            p[enters] = step * residual[enters]
            before = 0 if np.any(enters) else before
            residual = g - sunk(p)
    raise ArithmeticError("the pressure does not converge")


class Pressed:
    """Force, and moment about the centre, on a box of half axes `half`, turned by `turn` (body to world), whose centre is
    `height` above the ground at rest; its patch is n cells long and n wide."""

    def __init__(self, half, turn, height, n, start=None):
        self.force, self.moment, self.pressure = 0.0, np.zeros(3), None
        corners = (SIGNS * half) @ turn.T + [0, 0, height]
        self.depth = -corners[:, 2].min()
        if not self.depth > 0:
            return
        # The grid lies along that axis of the box which is most level, the patch's longest side.
        level = np.argmin(np.abs(turn[2]))
        east, north = turn[:2, level] / np.hypot(*turn[:2, level])
        frame = np.array([[east, north, 0], [-north, east, 0], [0, 0, 1]])
        axes, corners = frame @ turn, corners @ frame.T
        below = [corner for corner in corners if corner[2] <= 0]
        for a, b in ((corners[i], corners[j]) for i, j in EDGES):
            if a[2] * b[2] < 0:
                below.append(a + (b - a) * a[2] / (a[2] - b[2]))
        low, high = np.min(below, 0)[:2], np.max(below, 0)[:2]
        # The lowest corner lies where cells meet: pressures that grow without limit there then err by the size of a cell.
        lowest, (dx, dy) = corners[np.argmin(corners[:, 2])][:2], (high - low) / n
        low = lowest - np.ceil((lowest - low) / (dx, dy) - 1e-6) * (dx, dy)
        middles = np.arange(n + 1) + 0.5
        x, y = np.meshgrid(low[0] + dx * middles, low[1] + dy * middles, indexing="ij")
        # The part in the box of the vertical line over each cell, from one pair of faces after the other.
        bottom, top, slope_x, slope_y = (np.full(x.shape, value) for value in (-np.inf, np.inf, 0, 0))
        for axis, size in zip(axes.T, half):
            across = axis[0] * x + axis[1] * y
            if abs(axis[2]) < 1e-9:
                top = np.where(np.abs(across) > size, -np.inf, top)
                continue
            lower = height - (size + np.sign(axis[2]) * across) / abs(axis[2])
            is_lowest = lower > bottom
            bottom, top = np.where(is_lowest, lower, bottom), np.minimum(top, lower + 2 * size / abs(axis[2]))
            slope_x = np.where(is_lowest, axis[0] / axis[2], slope_x)
            slope_y = np.where(is_lowest, axis[1] / axis[2], slope_y)
        g = np.where(bottom < top, np.maximum(-bottom, 0), 0)
        self.pressure = pressure(g, dx, dy, start)
        # It acts across the box's surface: by the couple of its part along the ground, which has no resultant, the stored
        # energy is the potential of the moment, too.
        f = self.pressure * dx * dy
        self.force = np.sum(f)
        self.moment = np.array([np.sum(f * (y + g * slope_y)), -np.sum(f * (x + g * slope_x)), 0]) @ frame


def turned(turn, vector):
    """`turn` after a rotation by `vector`, world components."""
    angle = np.linalg.norm(vector)
    x, y, z = vector / angle if angle > 0 else vector
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return (np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross) @ turn


class Impact:
    """One contact of a uniform box that comes down at `speed` without turning, in the attitude `turn` at first touch: half
    axes [m], mass [kg], E* [Pa].  By Störmer and Verlet's method, in steps of about a `steps`-th of the contact."""

    def __init__(self, half, mass, turn, speed, modulus, n, steps=40, gravity=9.81):
        inertia, touch = mass / 3 * (np.sum(half ** 2) - half ** 2), np.abs(turn[2]) @ half
        shallow, deep = 0, half.min()  # between them is the depth at which F δ = m v², about the deepest
        for _ in range(10):
            middle = (shallow + deep) / 2
            force = modulus * Pressed(half, turn, touch - middle, n).force
            shallow, deep = (shallow, middle) if force * middle > mass * speed ** 2 else (middle, deep)
        step = 3 * deep / speed / steps
        height, velocity, momentum = touch, -speed, np.zeros(3)
        at, forces = Pressed(half, turn, height, n), [0.0]
        while True:
            velocity += step / 2 * (modulus * at.force / mass - gravity)
            momentum = momentum + step / 2 * modulus * at.moment
            height += step * velocity
            half_way = turned(turn, step / 2 * turn @ (turn.T @ momentum / inertia))
            turn = turned(turn, step * half_way @ (half_way.T @ momentum / inertia))
            before, at = at, Pressed(half, turn, height, n, at.pressure)
            velocity += step / 2 * (modulus * at.force / mass - gravity)
            momentum = momentum + step / 2 * modulus * at.moment
            if not at.depth > 0:
                break
            forces.append(modulus * at.force)
        self.duration = step * (len(forces) - 1 + before.depth / (before.depth - at.depth))
        top = int(np.argmax(forces))
        left, peak, right = (forces + [0.0])[top - 1:top + 2]
        self.peak_force = peak + (right - left) ** 2 / (8 * (2 * peak - left - right))
        rate = turn.T @ momentum / inertia
        self.velocity, self.spin = velocity, np.linalg.norm(rate)
        energy = mass * (velocity ** 2 - speed ** 2) / 2 + rate @ (inertia * rate) / 2 + mass * gravity * (height - touch)
        self.energy_gap = energy / (mass * speed ** 2 / 2)


def extrapolated(quantity, n):
    """The limit for ever smaller cells of what errs in proportion to their size, by 2n and 4n cells, and as its error by
    how much it differs from that by n and 2n."""
    coarse, middle, fine = (np.asarray(quantity(cells)) for cells in (n, 2 * n, 4 * n))
    return 2 * fine - middle, np.abs(2 * fine - 3 * middle + coarse)


def orientation(n):
    """1 to 6 are faces, 7 to 18 edges, 19 to 26 corners; the centre of mass is above them."""
    return "--orientation", str(n)


def matrix(w, x, y, z):
    """Body to world, by Euler parameters."""
    u, cross = np.array([x, y, z]), np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return (w * w - u @ u) * np.eye(3) + 2 * np.outer(u, u) + 2 * w * cross


def off_balance(size, degrees):
    """The box on its first corner below its centre, then turned about the world's x axis."""
    up = np.array(size) / np.linalg.norm(size)
    w, u = 1 + up[2], np.cross(up, (0, 0, 1))  # turns `up` upright
    w, u = w / math.hypot(w, *u), u / math.hypot(w, *u)
    c, s = math.cos(math.radians(degrees) / 2), math.sin(math.radians(degrees) / 2) * np.array([1, 0, 0])
    return "--attitude", ",".join(repr(float(b)) for b in (c * w - s @ u, *(c * u + w * s + np.cross(s, u))))


class Drop:
    """An impact by the program: its row, attitude and speed at touch, the pose of its peak force, E*."""

    def __init__(self, folder, size, *pose):
        found = folder.json_of("simulate", "--body", "box", "--size", "x".join(map(repr, size)), "--mass", repr(MASS), *pose,
                               *DROP, status=(0,))
        self.row, self.half = found["impacts"][0], np.array(size) / 2
        self.modulus = found["scene"]["ground"]["reduced_modulus"]["value"]
        self.attitude, self.speed = matrix(*self.row["attitude"]), self.row["approach_speed"]
        self.peak = max(({name: float(text) for name, text in row.items()} for row in folder.records("history.csv")),
                        key=lambda row: row["fz"])

    def force(self):
        """That of the elements in the pose of the peak, and its error."""
        turn = matrix(*(self.peak[f"beta{i}"] for i in range(4)))
        return extrapolated(lambda n: self.modulus * Pressed(self.half, turn, self.peak["z"], n).force, 24)

    def impact(self):
        """Peak force, duration, vertical speed and speed of turning after it by the elements, their errors, and the worst gap
        of its energy."""
        gaps = []

        def numbers(n):
            impact = Impact(self.half, MASS, self.attitude, self.speed, self.modulus, n, gravity=GRAVITY)
            gaps.append(abs(impact.energy_gap))
            return impact.peak_force, impact.duration, impact.velocity, impact.spin
        return *extrapolated(numbers, 16), max(gaps)


class BoundaryElements(EmptyFolder):
    def within(self, low, ratio, high, error):
        """Where a ratio to what the elements have lies, whose own relative error is known and small."""
        self.assertLessEqual(error, GRID)
        self.assertGreaterEqual(ratio - error, low)
        self.assertLessEqual(ratio + error, high)

    def fallen(self, size, pose, most):
        """An impact whose force lacks `most` at most, with the elements' peak force, velocity and speed of turning after it,
        and the errors of these two."""
        drop = Drop(self, size, *pose)
        force, error = drop.force()
        self.within(1 - most, drop.peak["fz"] / force, 1, error / force)
        (peak, duration, *after), (peak_error, duration_error, *errors), gap = drop.impact()
        self.assertLessEqual(gap, ENERGY)
        root = math.sqrt(1 - most)
        self.within(root, drop.row["peak_force"] / peak, 1, peak_error / peak)
        self.within(1, drop.row["duration"] / duration, 1 / root, duration_error / duration)
        return drop, peak, after, errors

    def flat(self, size, pose, most):
        """The same of a flat, to which the body is the mass on a spring; returns the program's and the elements' peak."""
        drop = Drop(self, size, *pose)
        force, error = drop.force()
        self.within(1 - most, drop.peak["fz"] / force, 1 + most, error / force)
        rate = math.sqrt(force / drop.row["indentation"] / MASS)
        peak = MASS * (GRAVITY + math.hypot(GRAVITY, rate * drop.speed))
        duration = (math.pi + 2 * math.atan(GRAVITY / (rate * drop.speed))) / rate
        low, high = math.sqrt(1 - most), math.sqrt(1 + most)
        self.within(low, drop.row["peak_force"] / peak, high, error / force / 2)
        self.within(1 / high, drop.row["duration"] / duration, 1 / low, error / force / 2)
        return drop.row["peak_force"], peak

    def test_the_elements_know_closed_forms(self):
        """Capacity of a square plate, 0.36678746 of 4πε times its side; Sneddon's cone, Hertz's paraboloid."""
        def square(n):
            return Pressed(np.full(3, 0.5), np.eye(3), 0.5 - 1e-3, n).force
        force, error = extrapolated(square, 24)
        self.assertLessEqual(abs(force / (math.pi * 0.36678746e-3) - 1), 3e-4)
        self.assertLessEqual(error / force, 3e-4)
        n = 64
        middles = (2 * np.arange(n) + 1) / n - 1
        radius = np.hypot(*np.meshgrid(middles, middles))
        for depth, force in ((1 - radius, 2 / math.pi), ((1 - radius ** 2) / 2, 4 / 3 * 0.5 ** 1.5)):
            found = np.sum(pressure(np.maximum(depth, 0), 2 / n, 2 / n)) * (2 / n) ** 2
            self.assertLessEqual(abs(found / force - 1), 5e-4)

    def test_flats_up_to_10_to_1_press_within_3_per_cent(self):
        for size in ((0.05, 0.05, 0.05), (0.08, 0.02, 0.02), (0.2, 0.02, 0.02)):
            with self.subTest(size):
                self.flat(size, orientation(6), FLAT)

    def test_a_cube_s_corner_presses_within_11_per_cent(self):
        self.fallen((0.05, 0.05, 0.05), orientation(19), CUBE_CORNER)

    def test_edges_press_within_25_per_cent_until_they_are_long(self):
        for length, most in ((0.004, EDGE), (0.02, EDGE), (0.1, LONG_EDGE)):
            with self.subTest(length):
                drop = self.fallen((length, 0.02, 0.02), orientation(11), most)[0]
                self.assertEqual(length / drop.row["indentation"] > LONGEST, most == LONG_EDGE)

    def test_a_phone_s_corner_turns_it_as_the_elements_say_on_its_diagonal_and_10_degrees_off(self):
        for pose in (orientation(19), off_balance(PHONE, 10), off_balance(PHONE, -10)):
            with self.subTest(pose):
                drop, _, (velocity, spin), (velocity_error, spin_error) = self.fallen(PHONE, pose, CORNER)
                self.assertLessEqual(abs(drop.row["velocity_after"][2] - velocity) + velocity_error, REBOUND * drop.speed)
                self.assertLessEqual(abs(math.hypot(*drop.row["angular_velocity_after"]) - spin) + spin_error, TURNING * spin)

    def test_a_phone_s_peaks_grow_from_corner_over_edges_to_faces(self):
        peaks = []
        for part, most in ((19, CORNER), (7, EDGE), (8, LONG_EDGE), (11, LONG_EDGE)):
            with self.subTest(part):
                drop, peak, _, _ = self.fallen(PHONE, orientation(part), most)
                peaks.append((drop.row["peak_force"], peak))
        for side, most in ((1, FLAT), (4, NARROW), (6, FLAT)):
            with self.subTest(side):
                peaks.append(self.flat(PHONE, orientation(side), most))
        self.assertEqual(peaks, sorted(peaks))
        self.assertEqual(sorted(peak for _, peak in peaks), [peak for _, peak in peaks])
