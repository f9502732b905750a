# SPDX-License-Identifier: GPL-3.0-or-later
"""Answers of notebook 9 without clatter."""
import math


def felt_mass():
    """The cube of side 1 and mass 1 as a contact matrix: W = 1 − [r]× I⁻¹ [r]×, its vertical part, r found by turning the body."""
    tilt = math.radians(20)
    reach = math.sqrt(3) / 2
    r = (reach * math.sin(tilt), 0.0, -reach * math.cos(tilt))
    torque = (-r[1] * 0 + r[1], -r[0], 0.0)           # r × z
    turning = [6 * part for part in torque]           # I = 1/6
    lifted = turning[0] * r[1] - turning[1] * r[0]    # z · (ω × r)
    return 1 / (1 + lifted)


def shell_over_solid(cells=400):
    """Sums of y² + z² over the six faces of a cube, and over its volume by slices."""
    middles = [(i + 0.5) / cells - 0.5 for i in range(cells)]
    square = sum(x * x for x in middles) / cells
    across = 2 * square                               # faces x = ±1/2
    along = square + 0.25                             # the other four
    return ((2 * across + 4 * along) / 6) / (2 * square)


def caught(frames=100_000):
    """Contacts that begin at evenly spread phases of the frame's interval."""
    share = 1.8e-3 / 4e-3
    return 100 * sum((i + 0.5) / frames + share > 1 for i in range(frames)) / frames


ORACLES = {"9.1": (lambda: [felt_mass()], 1e-3), "9.2": (lambda: [shell_over_solid()], 5e-4), "9.3": (lambda: [caught()], 1e-3)}
