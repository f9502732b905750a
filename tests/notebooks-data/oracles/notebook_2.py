# SPDX-License-Identifier: GPL-3.0-or-later
"""Expected answers of the exercises of notebook 2, without clatter."""

from decimal import Decimal, getcontext
from math import acos, cos, degrees, pi, radians, sin

getcontext().prec = 60


def bisect(function, low, high):
    falling = function(low) > 0
    for _ in range(200):
        middle = (low + high) / 2
        if (function(middle) > 0) == falling:
            low = middle
        else:
            high = middle
    return (low + high) / 2


def forty_five():
    """Eq. 12 solved for theta; P2/P1 from the approach speeds and the effective masses of the ends."""
    beta = pi / 4
    theta = bisect(lambda t: sin(t) + (1 - 3 * cos(t) ** 2) / (6 * cos(t)) * (t + beta) - sin(beta), radians(30), radians(58))
    v, spin = (1 - 3 * cos(theta) ** 2) / (1 + 3 * cos(theta) ** 2), 12 * cos(theta) / (1 + 3 * cos(theta) ** 2)
    approach = spin * cos(beta) / 2 - v
    return [degrees(theta), approach * (1 + 3 * cos(theta) ** 2) / (1 + 3 * cos(beta) ** 2)]


def grazing(e):
    """Smallest height of the right end over the flight, by a golden-section search, is zero at the fold."""
    def after(theta):
        impulse = (1 + e) / (1 + 3 * cos(theta) ** 2)
        return impulse - 1, 6 * cos(theta) * impulse

    def height(t, theta):
        v, spin = after(theta)
        return sin(theta) / 2 + v * t + sin(theta - spin * t) / 2

    def lowest(theta):
        low, high = theta / after(theta)[1], (theta + radians(120)) / after(theta)[1]
        for _ in range(100):
            left, right = low + 0.381966 * (high - low), low + 0.618034 * (high - low)
            if height(left, theta) < height(right, theta):
                high = right
            else:
                low = left
        return (low + high) / 2

    theta = bisect(lambda t: height(lowest(t), t), radians(60), radians(75))
    v, spin = after(theta)
    turned = spin * lowest(theta) - theta
    assert abs(cos(turned) - 2 * v / spin) < 1e-6
    return [degrees(theta), degrees(acos(2 * v / spin))]


def sin_cos(x):
    """Taylor series of sine and cosine of a small Decimal."""
    sine, cosine, term = Decimal(0), Decimal(0), Decimal(1)
    for n in range(80):
        if n % 2:
            sine += term * (-1) ** (n // 2)
        else:
            cosine += term * (-1) ** (n // 2)
        term *= x / (n + 1)
    return sine, cosine


def next_angle(angle, slope):
    """sin a + slope (a + b) = sin b, by Newton."""
    b = angle
    for _ in range(12):
        sine, cosine = sin_cos(b)
        b -= (sin_cos(angle)[0] + slope * (angle + b) - sine) / (slope - cosine)
    return b


def gamma_factor():
    """(gamma - theta) / theta^3 in 60 digits."""
    theta = Decimal("1e-6")
    c = sin_cos(theta)[1]
    v, spin = (1 - 3 * c * c) / (1 + 3 * c * c), 12 * c / (1 + 3 * c * c)
    beta = next_angle(theta, 2 * v / spin)
    c = sin_cos(beta)[1]
    impulse = 2 * (spin * c / 2 - v) / (1 + 3 * c * c)
    gamma = next_angle(beta, 2 * (v + impulse) / -(spin - 6 * c * impulse))
    return [float((gamma - theta) / theta**3)]


ORACLES = {
    # Own bisection; 6 digits are printed: at most half a unit of the last one.
    "2.1": (forty_five, 5e-6),
    # As above; the search for the minimum finds its height to rounding.
    "2.2": (lambda: grazing(0.5), 5e-6),
    # The limit theta -> 0; 4 digits are printed, 1.688 stands for 1.6875.
    "2.3": (gamma_factor, 5e-4),
}
