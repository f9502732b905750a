# SPDX-License-Identifier: GPL-3.0-or-later
"""Answers of notebook 12 without clatter."""
import math


def opposite_second(length, width, thickness, restitution):
    """A corner strikes, the body turns about x and y, the opposite corner strikes."""
    x, y = length / 2, width / 2
    about_y, about_x = (length**2 + thickness**2) / 12, (width**2 + thickness**2) / 12
    impulse = (1 + restitution) / (1 + x * x / about_y + y * y / about_x)
    v, along, across = -1 + impulse, -x * impulse / about_y, -y * impulse / about_x  # rates of the slope
    return -(v + along * x + across * y)


def lower_end(hits, count, z=1.96):
    """The share p whose distance from the one found is z of its own standard deviations, by halving."""
    found = hits / count
    low, high = 0.0, found
    for _ in range(60):
        p = (low + high) / 2
        if found - p > z * math.sqrt(p * (1 - p) / count):
            low = p
        else:
            high = p
    return 100 * low


ORACLES = {
    "12.1": (lambda: [opposite_second(0.2, 0.1, 0.01, 1)], 1e-5),
    "12.2": (lambda: [opposite_second(0.2, 0.1, 0.01, 0.5)], 1e-5),
    "12.3": (lambda: [lower_end(130, 200)], 1e-3),
}
