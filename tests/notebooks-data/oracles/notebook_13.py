# SPDX-License-Identifier: GPL-3.0-or-later
"""Answers of notebook 13 without clatter."""


def bounces():
    """Time and impulse per mass of a ball's bounces, one after the other until nothing is added."""
    speed, time, impulse = 4.0, 0.0, 0.0
    while speed > 1e-14:
        impulse += speed + 0.75 * speed
        speed *= 0.75
        time += 2 * speed / 9.81
    return [time, impulse]


def impacts():
    """Speeds from impact to impact."""
    speed, count = 1.0, 0
    while speed**2 >= 1e-3:
        speed, count = 0.75 * speed, count + 1
    return count


def rocking():
    """The plane cube as 400 × 400 points: before the landing it turns about (0, 0), after it about (1, 0)."""
    n = 400
    places = [(i + 0.5) / n for i in range(n)]
    square = sum(x * x for x in places) / n
    about_edge = 2 * square
    # Momentum about the new edge of velocities (-z, x): the mean of x (x - 1) + z z.
    kept = square - sum(places) / n + square
    return (kept / about_edge) ** 2


ORACLES = {"13.1": (lambda: bounces(), 1e-5), "13.2": (lambda: [impacts()], 1e-9), "13.3": (lambda: [rocking()], 1e-4)}
