# SPDX-License-Identifier: GPL-3.0-or-later
"""Answers of notebook 8 without clatter."""
import math

RATIO = (math.sqrt(5) - 1) / 2


def largest(function, low, high):
    """Golden section: where, and how much."""
    for _ in range(90):
        left, right = high - RATIO * (high - low), low + RATIO * (high - low)
        low, high = (low, right) if function(left) > function(right) else (left, high)
    return (low + high) / 2, function((low + high) / 2)


def second_impulse(degrees, e):
    """Thin rod, m = L = v = 1: Eq. 8, free flight to the earliest contact of the other end, Eq. 8."""
    theta = math.radians(degrees)
    first = (1 + e) / (1 + 3 * math.cos(theta) ** 2)
    rise, spin = first - 1, 6 * math.cos(theta) * first
    low, high = 0.0, theta + math.acos(2 * rise / spin)
    for _ in range(100):
        turned = (low + high) / 2
        above = math.sin(theta) / 2 + rise * turned / spin - math.sin(turned - theta) / 2 > 0
        low, high = (turned, high) if above else (low, turned)
    cosine = math.cos(low - theta)
    return (1 + e) * (spin / 2 * cosine - rise) / (1 + 3 * cosine**2)


def rod_with_loss():
    return list(largest(lambda angle: second_impulse(angle, 0.8), 40, 52))


def flat_peak(s):
    """Largest (1 + s w) x of x'' = -(1 + s x') x, w = x'; first integral x^2/2 = (1 - w)/s - ln((1 + s)/(1 + s w))/s^2."""
    def force(w):
        half = (1 - w) / s - math.log((1 + s) / (1 + s * w)) / s**2
        return (1 + s * w) * math.sqrt(max(0.0, 2 * half))
    return largest(force, 0.0, 1.0)[1]


def best_damping():
    speed, stiffness, mass, face = math.sqrt(2 * 9.81), 1e8, 0.08814, 0.10566 * 0.04394
    s, negative = largest(lambda s: -flat_peak(s), 0.05, 1.5)
    elastic = speed * math.sqrt(stiffness * face * mass)
    return [s * stiffness / speed / 1e7, -negative * elastic, 100 * (1 + negative)]


def edges_together(degrees, stiffness=1e10, speed=4.4294, step=2e-8):
    """Planar drop of the phone on one edge, elastic load k * depth per unit surface on bottom, end and side faces; Runge-Kutta 4.
    Does the other edge touch before the first has left?"""
    length, width, thick, mass = 0.10566, 0.04394, 0.01905, 0.08814
    inertia = mass * (length**2 + thick**2) / 12

    def heights(z, angle):
        return (z - length / 2 * math.sin(angle) - thick / 2 * math.cos(angle),
                z + length / 2 * math.sin(angle) - thick / 2 * math.cos(angle))

    def rate(z, angle, rise, turn):
        depth = -heights(z, angle)[0]
        if depth <= 0:
            return rise, turn, 0.0, 0.0
        sine, cosine = math.sin(angle), math.cos(angle)
        edge = -length / 2 * cosine + thick / 2 * sine
        along = min(depth / sine, length) if sine > 0 else length
        up = depth / cosine
        bottom, end = stiffness * width * depth * along / 2, stiffness * width * depth * up / 2
        sides = 2 * stiffness * depth * along * up / 6
        right, left = edge + along * cosine, edge - up * sine
        force = bottom + end + sides
        moment = (bottom * (2 * edge + right) + end * (2 * edge + left)) / 3 + sides * (2 * edge + right + left) / 4
        return rise, turn, force / mass, moment / inertia

    angle = math.radians(degrees)
    state = (length / 2 * math.sin(angle) + thick / 2 * math.cos(angle), angle, -speed, 0.0)
    while True:
        one = rate(*state)
        two = rate(*(x + step / 2 * d for x, d in zip(state, one)))
        three = rate(*(x + step / 2 * d for x, d in zip(state, two)))
        four = rate(*(x + step * d for x, d in zip(state, three)))
        state = tuple(x + step / 6 * (a + 2 * b + 2 * c + d) for x, a, b, c, d in zip(state, one, two, three, four))
        first, second = heights(*state[:2])
        if second <= 0 or first > 0:
            return second <= 0


def merging_angle():
    low, high = 0.3, 1.2
    for _ in range(12):
        middle = (low + high) / 2
        low, high = (middle, high) if edges_together(middle) else (low, middle)
    return [(low + high) / 2]


ORACLES = {
    "8.1": (rod_with_loss, 1e-4),   # printed with 4 and 6 digits; a flat maximum gives its place to 1e-8
    "8.2": (best_damping, 5e-3),    # printed with 3 digits
    "8.3": (merging_angle, 2e-3),   # printed with 3 digits; bisection to 2e-4 degrees
}
