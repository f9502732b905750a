# SPDX-License-Identifier: GPL-3.0-or-later
"""Expected answers of the exercises of notebook 3, without clatter."""

from math import cos, degrees, pi, radians, sin


def bisect(function, low, high):
    falling = function(low) > 0
    for _ in range(200):
        middle = (low + high) / 2
        if (function(middle) > 0) == falling:
            low = middle
        else:
            high = middle
    return (low + high) / 2


def bouncing(e, v, g):
    """Bounce by bounce until nothing is left; the impulse is the sum of m (1 + e) v."""
    time, impulse = 0.0, (1 + e) * v
    while v > 1e-18:
        v *= e
        time += 2 * v / g
        impulse += (1 + e) * v
    return [time, impulse]


def slope(theta):
    """2 V1 / Omega1 and |v| / Omega1 of the unit rod after an elastic blow."""
    c = cos(theta)
    return (1 - 3 * c * c) / (6 * c), (1 + 3 * c * c) / (12 * c)


def one_per_cent(theta):
    """Eq. 12 with gravity, solved for G at beta = 0.99 of that without gravity."""
    k, slowness = slope(theta)
    beta = 0.99 * bisect(lambda b: sin(theta) + k * (theta + b) - sin(b), 0.0, pi / 4)
    number = (sin(theta) + k * (theta + beta) - sin(beta)) / (slowness * (theta + beta)) ** 2
    return [number, 1 / (2 * number)]


def both_ends(g):
    """Flight in small steps: the angle at which left and right end reach the floor together, and when."""
    def touch(theta):
        """Time at which the lower end is down (from a step to the next by bisection), and the inclination then."""
        impulse = 2 / (1 + 3 * cos(theta) ** 2)
        v, spin = impulse - 1, 6 * cos(theta) * impulse

        def lower(t):
            return sin(theta) / 2 + v * t - g * t * t / 2 - abs(sin(theta - spin * t)) / 2
        t = 1e-3
        while lower(t) > 0:
            t += 1e-3
        t = bisect(lower, t - 1e-3, t)
        return theta - spin * t, t

    theta = bisect(lambda angle: -touch(angle)[0], radians(50), radians(70))
    return [degrees(theta), touch(theta)[1]]


ORACLES = {
    # The series summed term by term; 6 digits are printed: at most half a unit of the last one.
    "3.1": (lambda: bouncing(0.7, 1.0, 9.81), 5e-6),
    # Linear in G, but a difference of 1 %: 5 digits are printed.
    "3.2": (lambda: one_per_cent(radians(20)), 5e-5),
    # Own search for the first touch; 5 digits are printed of the time.
    "3.3": (lambda: both_ends(9.81), 5e-5),
}
