# SPDX-License-Identifier: GPL-3.0-or-later
"""Notebook 14: a part inside, by integrating what the solutions have in closed form."""

import math

GRAVITY = 9.80665


def root(function, low, high):
    """A root by halving."""
    for _ in range(200):
        middle = (low + high) / 2
        low, high = (middle, high) if function(middle) < 0 else (low, middle)
    return (low + high) / 2


def boundary():
    """Where an impulsive pulse, and a long one, bring an undamped oscillator to its fragility."""
    omega, fragility = 2 * math.pi * 200, 150 * GRAVITY
    impulsive = root(lambda v: omega * v - fragility, 0, 10)  # it leaves with v and swings to ω z = v
    # Energy under a constant push A: ω² z²/2 = A z at the turn, ω² z = 2 A.
    constant = root(lambda a: 2 * a - fragility, 0, 1e5)
    return [impulsive, constant]


def height():
    """The fall whose speed, with the rebound, is the integral of the half sine."""
    parts = 20_000  # by the middle of each: within 1e-9
    change = sum(1500 * GRAVITY * math.sin(math.pi * (i + 0.5) / parts) for i in range(parts)) * 5e-4 / parts
    return [root(lambda h: 1.5 * math.sqrt(2 * GRAVITY * h) - change, 0, 10)]


def quarter():
    """The rod as two rigid collisions, by conservation of energy and of angular momentum about the struck end."""
    v, w = -1.0, 0.0  # of the centre, upward, and counter-clockwise
    for end in (-0.5, 0.5):
        before = (v, w)
        # P at `end`: v + P, w + 12 P end; the end's velocity v + w end reverses.
        push = -2 * (v + w * end) / (1 + 12 * end * end)
        v, w = v + push, w + 12 * push * end
        assert abs(v * v + w * w / 12 - before[0] ** 2 - before[1] ** 2 / 12) < 1e-12
    return [(v - before[0]) + (w - before[1]) / 4]


ORACLES = {"14.1": (boundary, 1e-5), "14.2": (height, 1e-5), "14.3": (quarter, 1e-9)}
