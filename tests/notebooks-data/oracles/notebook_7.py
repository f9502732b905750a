# SPDX-License-Identifier: GPL-3.0-or-later
"""Answers of notebook 7 without clatter."""
import math


def more_digits():
    return [10 ** (3 / order) for order in (3, 2, 8)]


def swing_of_blind_rebounds():
    """Simpson's rule over the kinks at touch-down and lift-off, half a step out of phase: E differs by -1/24 to 1/24."""
    return [(math.pi / 100.5) ** 2 / 12 * 1e6]


def stiffness_for_four_digits():
    """d'' = g - w^2 d from d = 0, d' = v: w t = pi + 2 atan(g / (w v)); and g t / (2 v) = 1e-4.  Bisection for w."""
    gravity, speed, mass, face = 9.81, 1.0, 0.1, 0.1 * 0.05
    low, high = 1e3, 1e7
    for _ in range(100):
        omega = (low + high) / 2
        contact = (math.pi + 2 * math.atan(gravity / (omega * speed))) / omega
        low, high = (omega, high) if gravity * contact / (2 * speed) > 1e-4 else (low, omega)
    return [omega**2 * mass / face / 1e9]


ORACLES = {
    "7.1": (more_digits, 1e-5),              # closed form, printed with 6 digits
    "7.2": (swing_of_blind_rebounds, 5e-3),  # leading order in w h = 0.03, and 3 digits printed; the next order is the same for each phase
    "7.3": (stiffness_for_four_digits, 2e-3),  # closed form, printed with 3 digits
}
