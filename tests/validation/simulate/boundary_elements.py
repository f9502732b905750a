# SPDX-License-Identifier: GPL-3.0-or-later
"""A rigid box on an elastic half-space by boundary elements, and its impact without friction or damping.

Nothing is taken from the program or from its formulas.  The ground sinks by u under a pressure p as Boussinesq says; where
the box touches it u is the depth g of the box below the ground at rest, elsewhere p = 0 and u > g.  The pressure is constant
over each of a grid of equal rectangles; Love's closed form is what one of them does at the middle of another.  Of all p >= 0
the one sought makes p·Kp/2 - g·p least: conjugate gradients with that bound (Polonsky and Keer, 1999), K p by FFT.  All
this is for E* = 1; forces are in proportion to it.
"""

import itertools

import numpy as np

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
