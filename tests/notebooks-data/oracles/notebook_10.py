# SPDX-License-Identifier: GPL-3.0-or-later
"""Answers of notebook 10 without clatter."""
import math


def short_of_the_law():
    """Impulses that reverse 1 m/s of a point of mass 1 with e = 1 and with e = 0.98."""
    right, taken = 1 + 1.0, 1 + 0.98
    return (right - taken) / right


def interval():
    """The rod of 1 m and 1 kg at 1.5 m/s: end a is struck at 10°, and end b found on the ground by halving time."""
    theta, speed = math.radians(10), 1.5
    arm = math.cos(theta) / 2
    impulse = 2 * speed / (1 + 12 * arm**2)
    rise, turning = -speed + impulse, 12 * impulse * arm

    def height(time):
        return math.sin(theta) / 2 + rise * time + math.sin(theta - turning * time) / 2

    low, high = 1e-6, 0.1
    while height(high) > 0:
        high += 0.001
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if height(middle) > 0 else (low, middle)
    return low


def order():
    """The power of the step that leads from one error to the other, by halving it."""
    low, high = 0.0, 4.0
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if 0.02 / 4**middle > 0.0013 else (low, middle)
    return low


ORACLES = {"10.1": (lambda: [short_of_the_law()], 1e-9), "10.2": (lambda: [interval(), 10 * interval()], 5e-3),
           "10.3": (lambda: [order()], 5e-3)}
