# SPDX-License-Identifier: GPL-3.0-or-later
"""Answers of the notebooks' exercises by other means than clatter's: closed forms, own root-finders, own integrations, and
the arithmetic of 50 digits that makes the truth of the benchmark.

ORACLES: exercise to (function that gives the expected numbers, relative tolerance).
"""

import math
import sys
from math import cos, degrees, pi, radians, sin, sqrt
from statistics import NormalDist

from mpmath import mp, mpf
from run_folder import ROOT
from space_folder import runge_kutta

sys.path.insert(0, f"{ROOT}/validation/benchmark")
import truth  # noqa: E402: it is in the folder just named


def root(function, low, high, steps=200):
    """Where the function changes its sign, by halving."""
    falls = function(low) > 0
    for _ in range(steps):
        middle = (low + high) / 2
        low, high = (middle, high) if (function(middle) > 0) == falls else (low, middle)
    return (low + high) / 2


def largest(function, low, high):
    """Golden section: where, and how much."""
    ratio = (sqrt(5) - 1) / 2
    for _ in range(100):
        left, right = high - ratio * (high - low), low + ratio * (high - low)
        low, high = (low, right) if function(left) > function(right) else (left, high)
    return (low + high) / 2, function((low + high) / 2)


def rod_blow(c, e=1):
    """V and Ω of the unit rod that strikes with |v| = 1, c the cosine of its inclination."""
    impulse = (1 + e) / (1 + 3 * c * c)
    return impulse - 1, 6 * c * impulse


def planar(angle, e=1, speed=1, gravity=0, impacts=2, body=None):
    """Time, normal impulse, clockwise spin after it and end of each impact of a planar drop, by Newton's law without friction."""
    with mp.workdps(50):
        scene = truth.Scene({"problem": {"id": ""}, "drop": {"angle_deg": angle, "speed": speed}, "world": {"gravity": gravity},
                             "impact": {"restitution": e}, "run": {"impacts": impacts},
                             "body": body or {"shape": "rod", "length": 1, "radius": 0, "mass": 1}})
        return [(row[0], row[3], row[8], end) for end, row in truth.planar_truth(scene, "newton routh")]


def small(theta):
    """2 - P1 - P2 - P3 and gamma of the elastic rod in 50 digits."""
    with mp.workdps(50):
        rows = planar(mpf(theta) * 180 / mp.pi, impacts=3)
        gamma = mpf(theta) - sum(w * (later[0] - t) for (t, _, w, _), later in zip(rows, rows[1:]))
        return 2 - sum(row[1] for row in rows), gamma


def exponent_and_factor():
    once, twice = small("1e-6")[0], small("2e-6")[0]
    factor = once / mpf("1e-24")
    assert abs(factor - mpf(243) / 512) < 1e-9
    return [float(mp.log(twice / once, 2)), float(factor)]


def forty_five():
    """Eq. 12 solved for theta; P2/P1 from the approach speeds and the effective masses of the ends."""
    beta = pi / 4
    theta = root(lambda t: sin(t) + (1 - 3 * cos(t) ** 2) / (6 * cos(t)) * (t + beta) - sin(beta), radians(30), radians(58))
    v, spin = rod_blow(cos(theta))
    return [degrees(theta), (spin * cos(beta) / 2 - v) * (1 + 3 * cos(theta) ** 2) / (1 + 3 * cos(beta) ** 2)]


def grazing(e):
    """Where the second impact ends, and the angle at which both ends of the rod then move along the ground."""
    fold = root(lambda angle: len(planar(angle, e)) - 1.5, 60, 75, 40)
    v, spin = rod_blow(cos(radians(fold)), e)
    return [fold, degrees(math.acos(2 * v / spin))]


def bouncing(e, v, g):
    """Time and impulse per mass of infinitely many bounces."""
    return [2 * e * v / (g * (1 - e)), (1 + e) * v / (1 - e)]


def one_per_cent(theta):
    """Eq. 12 with gravity, solved for G at beta = 0.99 of that without gravity."""
    v, spin = rod_blow(cos(theta))
    k = 2 * v / spin
    beta = 0.99 * root(lambda b: sin(theta) + k * (theta + b) - sin(b), 0.0, pi / 4)
    number = (sin(theta) + k * (theta + beta) - sin(beta)) / ((theta + beta) / spin) ** 2
    return [number, 1 / (2 * number)]


def both_ends():
    """The angle at which left and right end reach the floor together, and when."""
    angle = root(lambda angle: 1 if planar(angle, gravity=9.81)[1][3] == "b" else -1, 50, 70, 40)
    return [angle, float(planar(angle, gravity=9.81)[1][0])]


def sticking_and_jamming():
    """The ratio that leaves no slip at 30°, and that at which u stops rising at 60°, of d_t and d_n of the end."""
    (d_t, d_n), (e_t, e_n) = ((cos(radians(angle)) / 2, sin(radians(angle)) / 2) for angle in (30, 60))
    return [12 * d_t * d_n / (1 + 12 * d_n**2), (1 + 12 * e_t**2) / (12 * e_t * e_n)]


def most_loss():
    """mu = AB/(2AC - B^2) and 9/80 J of 1/2 J at A = C = 5/2, B = 3/2."""
    A = C = 2.5
    B = 1.5
    mu = A * B / (2 * A * C - B * B)
    return [mu, 100 * 2 * mu * (B - C * mu) / (A - B * mu) ** 2 / 0.5]


def three_laws(e=0.5, mu=0.5, slip=0.8):
    """The speed without a stop of the slip, and the impulse of each law at 45° with it."""
    end = (1 + e) / (1 + 3 / 2 + 3 / 2 * mu)
    inertia = (mpf(5) / 2, mpf(3) / 2, mpf(5) / 2)
    return [end * (3 / 2 + (1 + 3 / 2) * mu), *(float(truth.planar_path(inertia, 1, mu, e, law, -1, slip)[0])
                                                for law in ("newton", "poisson", "stronge"))]


def phone():
    """The stiffness at which half a sine of k A peaks at 1000 g, and its duration."""
    mass, face, peak = 0.088, 0.10566 * 0.04394, 1000 * 9.81
    return [mass * (peak / 4.4) ** 2 / face, 1e3 * pi * 4.4 / peak]


def damped():
    """e of ln[(1+s)/(1−s e)] = s (1+e), at the s of e = 1/2 and at a quarter of it."""
    def balance(s, e):
        return math.log((1 + s) / (1 - s * e)) - s * (1 + e)
    s = root(lambda s: balance(s, 0.5), 0.5, 1.99)
    return [s * 1e8 / 2, root(lambda e: balance(s / 4, e), 0.1, 0.999)]


def edge():
    """F = K x^2 against the mass that the edge feels; x' = v sqrt(1 - (x/x_max)^3), Beta function."""
    length, width, thickness, mass, k, speed = 0.1, 0.05, 0.02, 0.1, 1e14, 1.0
    s = c = sqrt(0.5)
    d_t = -(length * c - thickness * s) / 2
    effective = 1 / (1 / mass + d_t**2 * 12 / mass / (length**2 + thickness**2))
    K = k * width / 2 * (1 / s + 1 / c)
    depth = (1.5 * effective * speed**2 / K) ** (1 / 3)
    return [K * depth**2, 2e6 * depth / speed * sqrt(pi) * math.gamma(4 / 3) / math.gamma(5 / 6)]


L, W, T, MASS, GRAVITY = 0.10566, 0.04394, 0.01905, 0.08814, 9.81
INERTIA = MASS * (L * L + T * T) / 12


def grown(thick, spin, time):
    """Growth of a small disturbance in that time, by Euler's equations, after it has settled into its growing form."""
    I1, I2, I3 = W**2 + thick**2, L**2 + thick**2, L**2 + W**2

    def run(w, time, steps):
        for _ in range(steps):
            w = runge_kutta(lambda w: ((I2 - I3) * w[1] * w[2] / I1, (I3 - I1) * w[2] * w[0] / I2, (I1 - I2) * w[0] * w[1] / I3), w, time / steps)
        return w

    settled = run([1e-30, spin, 0.0], 0.6, 3000)
    return math.log(run(settled, time, 3000)[0] / settled[0])


def rate():
    value = grown(T, 53.5, 0.5) / 0.5
    return [value, 10 * math.log(10) / value]


def corners(phi):
    """(x, z) of the corners of the section about the centre in order; at phi > 0 the left end is low."""
    c, s = cos(phi), sin(phi)
    return [(c * x - s * z, s * x + c * z) for x, z in ((-L / 2, -T / 2), (L / 2, -T / 2), (L / 2, T / 2), (-L / 2, T / 2))]


SPEED = sqrt(2 * GRAVITY * (1 + min(z for _, z in corners(radians(10)))))


def discrete():
    first, second = planar(10, speed=SPEED, gravity=GRAVITY, body={"shape": "box", "size": [L, W, T], "mass": MASS})
    return second[1] / first[1]


def load(z, phi, k):
    """Force up and moment (sign of spin) of k delta over the submerged surface: four edges times the width, two side walls."""
    points = [(x, -(z + height)) for x, height in corners(phi)]  # (lever, depth)
    wet, force, moment = [], 0.0, 0.0
    for (x1, d1), (x2, d2) in zip(points, points[1:] + points[:1]):
        if d1 > 0:
            wet.append((x1, d1))
        if d1 <= 0 and d2 <= 0:
            continue
        length = math.hypot(x2 - x1, d2 - d1)
        if d1 * d2 < 0:
            part = d1 / (d1 - d2)
            cut = (x1 + part * (x2 - x1), 0.0)
            wet.append(cut)
            length *= part if d1 > 0 else 1 - part
            (x1, d1), (x2, d2) = ((x1, d1), cut) if d1 > 0 else (cut, (x2, d2))
        d1, d2 = max(d1, 0.0), max(d2, 0.0)
        force += k * W * length * (d1 + d2) / 2
        moment -= k * W * length * (x1 * (2 * d1 + d2) + x2 * (d1 + 2 * d2)) / 6
    for i in range(1, len(wet) - 1):  # both side walls, in triangles
        triangle = (wet[0], wet[i], wet[i + 1])
        (xa, da), (xb, db), (xc, dc) = triangle
        area = abs((xb - xa) * (dc - da) - (xc - xa) * (db - da)) / 2
        depth, lever = da + db + dc, xa + xb + xc
        force += 2 * k * area * depth / 3
        moment -= 2 * k * area * (depth * lever + sum(x * d for x, d in triangle)) / 12
    return force, moment


def phone_falls(angle, speed, gravity, k, step):
    """z, phi, v, spin and impulse from the touch on, planar."""
    def slope(y):
        force, moment = load(y[0], y[1], k)
        return y[2], -y[3], force / MASS - gravity, moment / INERTIA, force

    state = [-min(z for _, z in corners(radians(angle))), radians(angle), -speed, 0.0, 0.0]
    while True:
        state = runge_kutta(slope, state, step)
        yield state, [state[0] + z for _, z in corners(state[1])]


def continuous(k, step):
    """Ratio of the impulses of the first two contacts of the elastic phone."""
    impulses, taken, touching = [], 0.0, True
    for state, heights in phone_falls(10, SPEED, GRAVITY, k, step):
        now = min(heights) < 0
        if touching and not now:
            impulses.append(state[4] - taken)
            taken = state[4]
        touching = now
        if len(impulses) == 2:
            return impulses[1] / impulses[0]


def edges_together(angle):
    """Does the other edge touch before the first has left?"""
    return next(right <= 0 for _, (left, right, *_) in phone_falls(angle, 4.4294, 0.0, 1e10, 1e-7) if right <= 0 or left > 0)


def stiffness_for_four_digits():
    """d'' = g - w^2 d from d = 0, d' = v: w t = pi + 2 atan(g / (w v)); and g t / (2 v) = 1e-4."""
    gravity, speed, mass, face = 9.81, 1.0, 0.1, 0.1 * 0.05
    omega = root(lambda w: gravity * (pi + 2 * math.atan(gravity / (w * speed))) / w / (2 * speed) - 1e-4, 1e3, 1e7, 100)
    return [omega**2 * mass / face / 1e9]


def flat_peak(s):
    """Largest (1 + s w) x of x'' = -(1 + s x') x, w = x'; first integral x^2/2 = (1 - w)/s - ln((1 + s)/(1 + s w))/s^2."""
    def force(w):
        half = (1 - w) / s - math.log((1 + s) / (1 + s * w)) / s**2
        return (1 + s * w) * sqrt(max(0.0, 2 * half))
    return largest(force, 0.0, 1.0)[1]


def best_damping():
    speed, stiffness, face = sqrt(2 * 9.81), 1e8, L * W
    s, negative = largest(lambda s: -flat_peak(s), 0.05, 1.5)
    return [s * stiffness / speed / 1e7, -negative * speed * sqrt(stiffness * face * MASS), 100 * (1 + negative)]


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


def opposite_second(length, width, thickness, restitution):
    """A corner strikes, the body turns about x and y, the opposite corner strikes."""
    x, y = length / 2, width / 2
    about_y, about_x = (length**2 + thickness**2) / 12, (width**2 + thickness**2) / 12
    impulse = (1 + restitution) / (1 + x * x / about_y + y * y / about_x)
    v, along, across = -1 + impulse, -x * impulse / about_y, -y * impulse / about_x  # rates of the slope
    return [-(v + along * x + across * y)]


def lower_end(hits, count, z=1.96):
    """The share p whose distance from the one found is z of its own standard deviations."""
    found = hits / count
    return [100 * root(lambda p: found - p - z * sqrt(p * (1 - p) / count), 0.0, found, 60)]


STANDARD = 9.80665


# Of printed numbers a tolerance is half a unit of the last digit at most, but for what is said.
ORACLES = {
    "1.1": (lambda: [rod_blow(cos(radians(30)))[0] + 1, *rod_blow(cos(radians(30)))], 5e-6),
    "1.2": (lambda: [degrees(math.acos(sqrt(0.5 / 3))), 6 * sqrt(0.5 / 3)], 5e-6),  # 3 cos^2 = e, Omega = 6 cos
    "1.3": (exponent_and_factor, 2e-4),  # the limit theta -> 0; at 0.1 deg the next term is some theta^2 = 3e-6
    "2.1": (forty_five, 5e-6),
    "2.2": (lambda: grazing(0.5), 5e-6),
    "2.3": (lambda: [float((small("1e-6")[1] - mpf("1e-6")) / mpf("1e-18"))], 5e-4),  # 1.688 stands for 1.6875
    "3.1": (lambda: bouncing(0.7, 1.0, 9.81), 5e-6),
    "3.2": (lambda: one_per_cent(radians(20)), 5e-5),
    "3.3": (both_ends, 5e-5),
    "4.1": (sticking_and_jamming, 1e-5),
    "4.2": (most_loss, 1e-5),  # the search finds mu to 1e-7 (flat maximum)
    "4.3": (three_laws, 1e-5),
    "5.1": (phone, 1e-5),
    "5.2": (damped, 1e-5),
    "5.3": (edge, 1e-3),  # the limit of a rigid body that does not turn; the gap shrinks like the contact time, k^(-1/3)
    "6.1": (rate, 1e-5),  # steps of 0.2 ms
    "6.2": (lambda: [1e3 * root(lambda thick: grown(thick, 53.5, 0.4456) - math.log(1000), 0.030, 0.0435, 25)], 1e-5),
    # Continuous: steps of 1 µs and 0.1 µs.
    "6.3": (lambda: [discrete(), continuous(1e8, 1e-6), continuous(1e14, 1e-7)], 4e-4),
    "7.1": (lambda: [10 ** (3 / order) for order in (3, 2, 8)], 1e-5),
    # Simpson's rule over the kinks at touch-down and lift-off, half a step out of phase: E differs by -1/24 to 1/24, to
    # leading order in w h = 0.03; the next order is the same for each phase.
    "7.2": (lambda: [(pi / 100.5) ** 2 / 12 * 1e6], 5e-3),
    "7.3": (stiffness_for_four_digits, 2e-3),
    "8.1": (lambda: list(largest(lambda angle: planar(angle, 0.8)[1][1], 40, 52)), 1e-4),  # a flat maximum gives its place to 1e-8
    "8.2": (best_damping, 5e-3),
    "8.3": (lambda: [root(lambda angle: -1.0 if edges_together(angle) else 1.0, 0.3, 1.2, 12)], 2e-3),  # to 2e-4 degrees
    "9.1": (lambda: [1 / (1 + 6 * (sqrt(3) / 2 * sin(radians(20))) ** 2)], 1e-3),
    # Of y² + z² over the faces of a cube (two across, four along), over that in its volume.
    "9.2": (lambda: [(2 * 2 / 12 + 4 * (1 / 12 + 1 / 4)) / 6 / (2 / 12)], 5e-4),
    "9.3": (lambda: [100 * 1.8 / 4], 1e-3),
    "10.1": (lambda: [1 - (1 + 0.98) / (1 + 1.0)], 1e-9),  # impulses that reverse a point with e = 1 and with e = 0.98
    "10.2": (lambda: [planar(10, speed=1.5)[1][0], 10 * planar(10, speed=1.5)[1][0]], 5e-3),
    "10.3": (lambda: [math.log(0.02 / 0.0013, 4)], 5e-3),  # the power of the step that leads from one error to the other
    "11.1": (lambda: [len(struck((50, 50), 1))], 0),
    # Between strikes that end and those that do not: the first restitution at which fewer than 300 are found.
    "11.2": (lambda: [root(lambda e: 299.5 - len(struck((4, 4), 1, e, 300)), 0.3, 0.5, 40)], 1e-3),
    "11.3": (lambda: [struck((0.3, 0.7), 1 / 12)[1]], 1e-5),
    "12.1": (lambda: opposite_second(0.2, 0.1, 0.01, 1), 1e-5),
    "12.2": (lambda: opposite_second(0.2, 0.1, 0.01, 0.5), 1e-5),
    "12.3": (lambda: lower_end(130, 200), 1e-3),
    "13.1": (lambda: bouncing(0.75, 4.0, 9.81), 1e-5),
    "13.2": (lambda: [math.ceil(math.log(1e-3) / math.log(0.75**2))], 1e-9),
    "13.3": (  # the plane cube's momentum about the new edge over that about the old one, squared
        lambda: [((2 / 3 - 1 / 2) / (2 / 3)) ** 2], 1e-4),
    "14.1": (lambda: [150 * STANDARD / (2 * pi * 200), 150 * STANDARD / 2], 1e-5),
    # The fall whose speed, with the rebound, is the integral of the half sine.
    "14.2": (lambda: [(1500 * STANDARD * 5e-4 * 2 / pi / 1.5) ** 2 / (2 * STANDARD)], 1e-5),
    "14.3": (lambda: [1.25 * struck((0.5, 0.5), 1 / 12)[1]], 1e-9),  # P + (12 P/2)/4 a quarter off the centre, P half the second approach
    "15.1": (lambda: [math.ceil((NormalDist().inv_cdf(0.975) / 0.01) ** 2 * 5 / 36)], 1e-9),
    "15.2": (lambda: [1 / math.sqrt(3)], 1e-5),  # half of an equilateral triangle
    # The corner above its edge: the distance of both, less the height of the centre on the face.
    "15.3": (lambda: [1e3 * (math.hypot(0.008, 0.008) - 0.008), (2 * 9.81 * (math.hypot(0.008, 0.008) - 0.008)) ** 0.5], 1e-5),
}
