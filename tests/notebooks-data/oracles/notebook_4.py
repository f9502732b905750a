# SPDX-License-Identifier: GPL-3.0-or-later
"""What the exercises of 4_friction must give, without clatter."""

import math


def sticking_and_jamming():
    """Direct solution of the impact equations: the ratio that leaves no slip; the ratio at which u stops rising."""
    def rates(theta, ratio):
        """Change of the contact point's (u, slip) by P_n = 1 with P_t = ratio, from Newton-Euler."""
        d_t, d_n = -math.cos(theta) / 2, -math.sin(theta) / 2
        spin = 12 * (d_n * ratio - d_t)
        return 1 - spin * d_t, ratio + spin * d_n

    def root(function, low, high):
        for _ in range(200):
            middle = (low + high) / 2
            low, high = (middle, high) if function(middle) * function(high) <= 0 else (low, middle)
        return high

    return [root(lambda ratio: rates(math.radians(30), ratio)[1], 0, 2),
            root(lambda ratio: rates(math.radians(60), ratio)[0], 0, 5)]


def most_loss():
    """mu = AB/(2AC - B^2) and 9/80 J of 1/2 J at A = C = 5/2, B = 3/2."""
    A = C = 2.5
    B = 1.5
    mu = A * B / (2 * A * C - B * B)
    return [mu, 100 * 2 * mu * (B - C * mu) / (A - B * mu) ** 2 / 0.5]


def march(slip, e, law, mu=0.5, theta=math.radians(45), step=2e-6):
    """Impact in small steps of P_n, Coulomb's law at each step."""
    d_t, d_n = -math.cos(theta) / 2, -math.sin(theta) / 2
    P, u, work, rate, compression, taken = 0.0, -1.0, 0.0, 1.0, None, 0.0
    while True:
        if compression is None and u >= 0:
            compression, taken = P - u / rate, -work
        if compression is not None:
            done = {"newton": u >= e, "poisson": P >= (1 + e) * compression, "stronge": work >= -(1 - e * e) * taken}
            if done[law]:
                return P
        ratio = -mu if slip > 0 else mu
        spin = 12 * (d_n * ratio - d_t)
        rate = 1 - spin * d_t
        slip += (ratio + spin * d_n) * step
        work += (u + rate * step / 2) * step
        u += rate * step
        P += step


def three_laws():
    end = 1.5 / (1 + 3 / 2 + 3 / 2 * 0.5)  # P_n without a stop of the slip
    speed = end * (3 / 2 + (1 + 3 / 2) * 0.5)
    return [speed] + [march(0.8, 0.5, law) for law in ("newton", "poisson", "stronge")]


ORACLES = {
    "4.1": (sticking_and_jamming, 1e-5),  # closed forms; the printed answer has 6 digits
    "4.2": (most_loss, 1e-5),  # closed form; the search finds mu to 1e-7 (flat maximum), the print has 6 digits
    "4.3": (three_laws, 2e-5),  # the march ends within a step, 2e-6 of 0.5 N s, and reverses within one
}
