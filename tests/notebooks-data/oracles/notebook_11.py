# SPDX-License-Identifier: GPL-3.0-or-later
"""Answers of notebook 11 without clatter."""

def struck(arms, gyration_square, restitution=1.0, most=10_000):
    """Approach speeds of a rod that falls flat with |v| = 1, contacts at -arms[0] (first) and arms[1], one after the other."""
    place = (-arms[0], arms[1])
    v, spin, speeds = -1.0, 0.0, []
    while len(speeds) < most:
        x = place[len(speeds) % 2]
        approach = -(v - spin * x)
        if approach <= 0:
            break
        impulse = (1 + restitution) * approach / (1 + x * x / gyration_square)
        v += impulse
        spin -= x * impulse / gyration_square
        speeds.append(approach)
    return speeds


def critical():
    """Between strikes that end and those that do not: the first restitution at which fewer than 300 are found."""
    low, high = 0.3, 0.5
    for _ in range(40):
        middle = (low + high) / 2
        if len(struck((4, 4), 1, middle, 300)) < 300:
            high = middle
        else:
            low = middle
    return low


ORACLES = {
    "11.1": (lambda: [len(struck((50, 50), 1))], 0),
    "11.2": (lambda: [critical()], 1e-3),
    "11.3": (lambda: [struck((0.3, 0.7), 1 / 12)[1]], 1e-5),
}
