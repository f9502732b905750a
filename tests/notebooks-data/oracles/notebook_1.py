# SPDX-License-Identifier: GPL-3.0-or-later
"""Expected answers of the exercises of notebook 1, without clatter."""

from decimal import Decimal, getcontext
from math import acos, cos, degrees, radians, sqrt

getcontext().prec = 60


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


def blow(v, spin, d_t):
    """Elastic, smooth blow on the unit rod: new velocity and spin, impulse."""
    approach = -(v - spin * d_t)
    impulse = 2 * approach / (1 + 12 * d_t * d_t)
    return v + impulse, spin - 12 * d_t * impulse, impulse


def next_angle(angle, v, spin):
    """Angle of the other end's blow after a flight without gravity: sin a + 2 (v/spin)(a + b) = sin b, by Newton."""
    slope = 2 * v / abs(spin)
    b, low = angle, sin_cos(angle)[0]
    for _ in range(12):
        sine, cosine = sin_cos(b)
        b -= (low + slope * (angle + b) - sine) / (slope - cosine)
    return b


def deficit(theta):
    """2 - P1 - P2 - P3 in 60 digits, so that nothing is lost in the difference."""
    angle, v, spin, total = theta, Decimal(-1), Decimal(0), Decimal(0)
    for n in range(3):
        d_t = sin_cos(angle)[1] / 2 * (1 if n == 1 else -1)
        v, spin, impulse = blow(v, spin, d_t)
        total += impulse
        angle = next_angle(angle, v, spin)
    return 2 - total


def first_blow(theta, e):
    """Energy-free form: effective mass 1/(1 + 3 cos^2) times (1 + e)."""
    impulse = (1 + e) / (1 + 3 * cos(theta) ** 2)
    return [impulse, impulse - 1, 6 * cos(theta) * impulse]


def exponent_and_factor():
    theta = Decimal("1e-6")
    factor = deficit(theta) / theta**4
    exponent = (deficit(2 * theta) / deficit(theta)).ln() / Decimal(2).ln()
    assert abs(factor - Decimal(243) / 512) < Decimal("1e-9")
    return [float(exponent), float(factor)]


ORACLES = {
    # Closed form; 6 digits are printed: at most half a unit of the last one.
    "1.1": (lambda: first_blow(radians(30), 1.0), 5e-6),
    # 3 cos^2 = e, Omega = 6 cos; 6 digits are printed: as above.
    "1.2": (lambda: [degrees(acos(sqrt(0.5 / 3))), 6 * sqrt(0.5 / 3)], 5e-6),
    # The limit theta -> 0; 4 digits are printed, at 0.1 deg the next term is some theta^2 = 3e-6.
    "1.3": (exponent_and_factor, 2e-4),
}
