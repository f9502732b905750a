#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Truth of the benchmark's problems, from the equations of impact and flight alone, in arithmetic of 50 digits.

Nothing here comes from the program: its discrete model is the second route, and a test holds the two together.

  plane     Eq. 8 of Shan et al. (2005) as the 2 x 2 problem of normal and tangential impulse, piecewise linear;
            flights are parabola and constant turning.
  space     impulses by the 3 x 3 inverse contact inertia; slip that turns by Taylor series of Keller's equations in
            impulse space; flights by Taylor series of Euler's equations for Euler parameters.
  compliant the damped phone: exact integrals of the pressure over the submerged part of two edges, Taylor series in
            time.
Events: from h, h' and a bound M on |h''| a time follows before which no point reaches the ground,
    s = (h' + sqrt(h'^2 + 2 M h))/M;
steps of s approach the earliest touch from below and pass none.

usage: truth.py [--output FILE] [--check ID ...]     needs python3-mpmath; four minutes for all problems.
Every number is computed with 50 and with 65 digits; `uncertainty` is the larger of their relative difference and the
rounding of what is printed.
"""
import argparse
import pathlib
import sys
import tomllib

from mpmath import mp, mpf, cos, matrix, pi, sin, sqrt

HERE = pathlib.Path(__file__).resolve().parent
DIGITS, MORE_DIGITS, PRINTED = 50, 65, 25
LAWS = ["newton routh", "poisson routh", "stronge routh", "newton moreau"]
COLUMNS = ["t", "Px", "Py", "Pz", "Vx", "Vy", "Vz", "Wx", "Wy", "Wz", "duration"]


def tiny():
    return mpf(10) ** (8 - mp.dps)


def number(value):
    """A decimal number of a file, exactly as written."""
    return mpf(repr(value)) if isinstance(value, float) else mpf(value)


def dot(a, b):
    return sum((x * y for x, y in zip(a, b)), mpf(0))


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def norm(a):
    return sqrt(dot(a, a))


# ---------------------------------------------------------------- events

def safe_step(height, speed, bound):
    """No point that starts here comes down to 0 earlier, if its acceleration stays within the bound."""
    inside = speed * speed + 2 * bound * height
    return (speed + sqrt(inside)) / bound if inside > 0 else mpf(0)


def first_touch(heights, touching, bound, latest):
    """Earliest time at which one of the points comes down to 0; heights(t) gives (h, h') of each."""
    time = mpf(0)
    while time < latest:
        state = heights(time)
        steps = []
        for index, (height, speed) in enumerate(state):
            if time == 0 and index in touching:
                assert speed > 0, "the point that struck does not leave"
                steps.append(speed / bound)
            else:
                assert height > -tiny(), "a point is below the ground"
                steps.append(safe_step(abs(height), speed, bound))
        step = min(steps)
        if step < tiny() and time > 0:
            return time, [i for i, one in enumerate(steps) if one < sqrt(tiny())]
        time += step
    return None, []


# ---------------------------------------------------------------- one impact in the plane

def planar_pieces(inertia, mu, slip):
    """Yields (tau, du/dp, ds/dp, slip now) of the path in impulse space, times the mass."""
    a, b, c = inertia
    if slip != 0:
        tau = -mu if slip > 0 else mu
        yield tau, a - b * tau, c * tau - b
    if abs(b) <= mu * c:
        tau = b / c
    else:
        tau = mu if b > 0 else -mu
    yield tau, a - b * tau, c * tau - b


def planar_path(inertia, mass, mu, e, law, u0, s0):
    """Routh's path: (P_n, P_t) for an approach u0 < 0 and slip s0."""
    pieces = []
    p, u, s = mpf(0), u0, s0
    for tau, du, ds in planar_pieces(inertia, mu, s0):
        stops = p - mass * s / ds if s * ds < 0 else None
        pieces.append((p, u, du / mass, tau, stops))
        if stops is None:
            break
        u, s, p = u + du / mass * (stops - p), mpf(0), stops
    compression, work_c = None, mpf(0)
    for i, (p, u, du, tau, end) in enumerate(pieces):
        to = p - u / du if u < 0 and du > 0 else None
        if to is not None and (end is None or to <= end):
            compression = to
            work_c += u * (to - p) + du * (to - p) ** 2 / 2
            break
        work_c += u * (end - p) + du * (end - p) ** 2 / 2
    work = mpf(0)
    for p, u, du, tau, end in pieces:
        if end is not None and end <= compression:
            continue
        start = max(p, compression)
        v = u + du * (start - p)
        if law == "newton":
            finish = start + (-e * u0 - v) / du
        elif law == "poisson":
            finish = (1 + e) * compression
        else:
            left = -e * e * work_c - work
            finish = start + (-v + sqrt(v * v + 2 * du * left)) / du
        if end is None or finish <= end:
            break
        work += v * (end - start) + du * (end - start) ** 2 / 2
    tangential = mpf(0)
    for p, u, du, tau, end in pieces:
        upper = finish if end is None else min(end, finish)
        if upper > p:
            tangential += tau * (upper - p)
    return finish, tangential


def planar_moreau(inertia, mass, mu, e, u0, s0):
    """Newton's e and Coulomb's cone at the end of the impact."""
    a, b, c = inertia
    du, ds = -(1 + e) * u0 * mass, -s0 * mass
    normal = (c * du + b * ds) / (a * c - b * b)
    tangential = (b * du + a * ds) / (a * c - b * b)
    if abs(tangential) <= mu * normal:
        return normal, tangential
    for sign in (1, -1):
        tau = -mu * sign
        normal = du / (a - b * tau)
        after = s0 + (c * tau - b) * normal / mass
        if after * sign >= 0:
            return normal, tau * normal
    raise ArithmeticError("no impulse satisfies Moreau's law")


# ---------------------------------------------------------------- one impact in space

def series_product(a, b, k):
    return sum((a[i] * b[k - i] for i in range(k + 1)), mpf(0))


def slip_series(W, mu, v, order):
    """Taylor coefficients in p of v, dv/dp = W (n - mu s), s = v_t/|v_t|."""
    c = [[x] for x in v]
    sigma = [sqrt(v[0] ** 2 + v[1] ** 2)]
    direction = [[v[0] / sigma[0]], [v[1] / sigma[0]]]
    for k in range(order):
        force = [-mu * direction[0][k], -mu * direction[1][k], mpf(1 if k == 0 else 0)]
        for i in range(3):
            c[i].append(dot([W[i, j] for j in range(3)], force) / (k + 1))
        square = sum(series_product(c[i], c[i], k + 1) for i in (0, 1))
        inner = sum((sigma[i] * sigma[k + 1 - i] for i in range(1, k + 1)), mpf(0))
        sigma.append((square - inner) / (2 * sigma[0]))
        for i in (0, 1):
            rest = sum((direction[i][j] * sigma[k + 1 - j] for j in range(k + 1)), mpf(0))
            direction[i].append((c[i][k + 1] - rest) / sigma[0])
    return c, direction


def value(coefficients, x):
    total = mpf(0)
    for c in reversed(coefficients):
        total = total * x + c
    return total


def root(coefficients, target, high):
    """x in (0, high] with sum c x^k = target, by bisection and Newton's method."""
    low, sign = mpf(0), value(coefficients, mpf(0)) - target
    x = high
    for _ in range(40):
        middle = (low + high) / 2
        if (value(coefficients, middle) - target) * sign > 0:
            low = middle
        else:
            high = middle
    x = (low + high) / 2
    slope = [k * c for k, c in enumerate(coefficients)][1:]
    for _ in range(8):
        x -= (value(coefficients, x) - target) / value(slope, x)
    return x


def integral(coefficients):
    return [mpf(0)] + [c / (k + 1) for k, c in enumerate(coefficients)]


class SlipPath:
    """Pieces of a path: lengths in p, series of v, series of the direction of slip."""

    def __init__(self, W, mu, v):
        self.W, self.mu = W, mu
        self.pieces = []
        self.start = list(v)

    def advance(self, v):
        """The next piece from v: (length, series of v, friction direction as series)."""
        W, mu = self.W, self.mu
        slip = sqrt(v[0] ** 2 + v[1] ** 2)
        if slip > mpf(10) ** (6 - mp.dps) * abs(self.start[2]):
            order = int(mp.dps * 0.9)
            c, direction = slip_series(W, mu, v, order)
            size = max(abs(x) for x in v)
            length = min(((size * mpf(10) ** -(mp.dps + 4)) / max(abs(s[n]), mpf(10) ** -200)) ** (mpf(1) / n)
                         for s in c + direction for n in (order - 1, order))
            return length, c, direction
        A, b = W[0:2, 0:2], matrix([W[0, 2], W[1, 2]])
        ft = -(A ** -1) * b
        assert sqrt(ft[0] ** 2 + ft[1] ** 2) <= mu, "slip that goes on after a stop does not occur in these problems"
        slope = W[2, 2] + W[2, 0] * ft[0] + W[2, 1] * ft[1]
        return None, [[mpf(0)], [mpf(0)], [v[2], slope]], [[-ft[0] / mu], [-ft[1] / mu]]


def space_path(W, mu, e, law, v0):
    """Keller's path: P for the contact velocity v0, v0_z < 0."""
    path, v = SlipPath(W, mu, v0), list(v0)
    P = [mpf(0)] * 3
    work, work_c, p_c = mpf(0), mpf(0), None
    while True:
        length, c, direction = path.advance(v)
        reach = length if length is not None else mpf(10) * abs(v0[2]) / c[2][1]
        target = None
        if p_c is None:
            if value(c[2], reach) >= 0:
                target = root(c[2], mpf(0), reach)
        elif law == "newton":
            if value(c[2], reach) >= -e * v0[2]:
                target = root(c[2], -e * v0[2], reach)
        elif law == "poisson":
            if P[2] + reach >= (1 + e) * p_c:
                target = (1 + e) * p_c - P[2]
        elif work + value(integral(c[2]), reach) >= -e * e * work_c:
            target = root(integral(c[2]), -e * e * work_c - work, reach)
        step = length if target is None else target
        for i in (0, 1):
            P[i] -= mu * value(integral(direction[i]), step)
        P[2] += step
        work += value(integral(c[2]), step)
        v = [value(c[i], step) for i in range(3)]
        if target is None:
            continue
        if p_c is not None:
            return P
        p_c, work_c, work = P[2], work, mpf(0)


def space_moreau(W, mu, e, v):
    inverse = W ** -1
    jump = matrix([-v[0], -v[1], -(1 + e) * v[2]])
    P = inverse * jump
    if sqrt(P[0] ** 2 + P[1] ** 2) <= mu * P[2]:
        return list(P)

    def slip(angle):
        s = [cos(angle), sin(angle)]
        force = [-mu * s[0], -mu * s[1], mpf(1)]
        rate = [dot([W[i, j] for j in range(3)], force) for i in range(3)]
        p = -(1 + e) * v[2] / rate[2]
        after = [v[0] + p * rate[0], v[1] + p * rate[1]]
        return s[0] * after[1] - s[1] * after[0], s[0] * after[0] + s[1] * after[1], [p * f for f in force]

    count = 720
    for k in range(count):
        low, high = 2 * pi * k / count, 2 * pi * (k + 1) / count
        a, b = slip(low)[0], slip(high)[0]
        if a * b > 0 or slip(low)[1] < 0:
            continue
        for _ in range(int(mp.dps * 3.6)):
            middle = (low + high) / 2
            if slip(middle)[0] * a > 0:
                low = middle
            else:
                high = middle
        return slip((low + high) / 2)[2]
    raise ArithmeticError("no impulse satisfies Moreau's law")


# ---------------------------------------------------------------- scenes

class Scene:
    def __init__(self, data):
        drop, body, impact = data["drop"], data["body"], data["impact"]
        self.data, self.id = data, data["problem"]["id"]
        slope = number(data["world"].get("incline_deg", 0)) * pi / 180
        self.g = number(data["world"]["gravity"]) * cos(slope)
        self.along = number(data["world"]["gravity"]) * sin(slope)
        self.mass = number(body["mass"])
        self.e, self.mu = number(impact["restitution"]), number(impact.get("friction", 0))
        self.count = data["run"]["impacts"]
        self.speed = number(drop.get("speed", 1))
        self.drop = drop
        if body["shape"] == "rod":
            L, r = number(body["length"]), number(body["radius"])
            self.size = (L, 2 * r)
            self.moment = self.mass * (3 * r * r + L * L) / 12
        elif body["shape"] == "sphere":
            self.radius = number(body["radius"])
        else:
            L, W, T = (number(x) for x in body["size"])
            self.size, self.width, self.box = (L, T), W, (L, W, T)
            self.moment = self.mass * (L * L + T * T) / 12

    def planar_vertices(self):
        L, T = self.size
        if T == 0:
            return [(-L / 2, mpf(0))], [(L / 2, mpf(0))]
        end = self.data["problem"].get("ground_end")  # which strikes in place of corner b
        right = L / 2 if end is None else number(end)
        return [(-L / 2, -T / 2), (-L / 2, T / 2)], [(right, -T / 2), (L / 2, T / 2)]


def planar_names(scene):
    a, b = scene.planar_vertices()
    points = [a[0], b[0]] + a[1:] + b[1:]
    right = "edge" if "ground_end" in scene.data["problem"] else "b"
    return points, ["a", right, "a-top", "b-top"][:len(points)]


def planar_start(scene):
    """Centre's height above the lowest vertex, inclination, velocities: V_n, V_t, Omega (clockwise)."""
    alpha = number(scene.drop["angle_deg"]) * pi / 180
    points, _ = planar_names(scene)
    lowest = min(x * sin(alpha) + z * cos(alpha) for x, z in points)
    return [-lowest, alpha, -scene.speed, number(scene.drop.get("tangential_velocity", 0)),
            number(scene.drop.get("spin", 0))]


def planar_flight(scene, points, state, touching):
    z, alpha, V, _, omega = state
    reach = max(sqrt(x * x + y * y) for x, y in points)
    bound = scene.g + reach * omega ** 2 + tiny()

    def heights(t):
        turned = alpha - omega * t
        s, c = sin(turned), cos(turned)
        return [(z + V * t - scene.g * t * t / 2 + x * s + y * c, V - scene.g * t - omega * (x * c - y * s))
                for x, y in points]

    latest = 2 * (reach - z) / V if scene.g == 0 and V > 0 else mpf(100)
    return first_touch(heights, touching, bound, abs(latest) + 1)


def planar_impulse(scene, law, d, V, Vt, omega):
    k = scene.moment / scene.mass
    inertia = (1 + d[0] ** 2 / k, d[0] * d[1] / k, 1 + d[1] ** 2 / k)
    u, s = V - omega * d[0], Vt + omega * d[1]
    restitution, friction = law.split()
    if friction == "moreau":
        return planar_moreau(inertia, scene.mass, scene.mu, scene.e, u, s)
    return planar_path(inertia, scene.mass, scene.mu, scene.e, restitution, u, s)


def planar_touching(points, state):
    """Points on the ground that come down; one that is at rest there takes no impulse of its own."""
    z, alpha, V, _, omega = state
    s, c = sin(alpha), cos(alpha)
    return [i for i, (x, y) in enumerate(points)
            if z + x * s + y * c < tiny() and V - omega * (x * c - y * s) < -tiny()]


def planar_truth(scene, law):
    points, names = planar_names(scene)
    state, time, rows = planar_start(scene), mpf(0), []
    struck = planar_touching(points, state)
    while len(rows) < scene.count:
        z, alpha, V, Vt, omega = state
        if len(struck) == 2:
            assert omega == 0, "a flat landing that turns does not occur in these problems"
            normal = -(1 + scene.e) * scene.mass * V
            P = (normal, -min(scene.mu * normal, scene.mass * abs(Vt)) * (1 if Vt > 0 else -1))
            after = [-scene.e * V, Vt + P[1] / scene.mass, mpf(0)]
        else:
            x, y = points[struck[0]]
            d = (x * cos(alpha) - y * sin(alpha), x * sin(alpha) + y * cos(alpha))
            P = planar_impulse(scene, law, d, V, Vt, omega)
            after = [V + P[0] / scene.mass, Vt + P[1] / scene.mass,
                     omega + (P[1] * d[1] - P[0] * d[0]) / scene.moment]
        place = "both" if len(struck) == 2 else names[struck[0]]
        rows.append((place, [time, P[1], 0, P[0], after[1], 0, after[0], 0, after[2], 0, 0]))
        state = [z, alpha] + after
        if len(rows) == scene.count and not scene.data["problem"].get("until"):
            break
        flight, arriving = planar_flight(scene, points, state, struck)
        if flight is None:
            break
        time += flight
        state = [z + after[0] * flight - scene.g * flight ** 2 / 2, alpha - after[2] * flight,
                 after[0] - scene.g * flight, after[1] + scene.along * flight, after[2]]
        struck = arriving
    last = scene.data["problem"].get("until")
    if last is not None and not scene.data["problem"].get("energy_alone"):
        assert flight is None or time > number(last), f"{scene.id}: an impact more at {time}"
    return rows


def end_energy(scene):
    """At `until`, of a box that bounces flat down a slope, then slides, and may stop: bounce by bounce."""
    g, along, mu, e = scene.g, scene.along, scene.mu, scene.e
    V, slip, way, time = -scene.speed, number(scene.drop["tangential_velocity"]), mpf(0), mpf(0)
    while V < -tiny() * tiny():
        stop = mu * (1 + e) * -V
        slip = max(slip - stop, mpf(0))
        V *= -e
        flight = 2 * V / g
        way, slip, time, V = way + slip * flight + along * flight ** 2 / 2, slip + along * flight, time + flight, -V
    left, gain = number(scene.data["problem"]["until"]) - time, along - mu * g
    assert left > 0 and slip > 0
    if gain < 0 and slip + gain * left < 0:
        left = -slip / gain
    way, slip = way + slip * left + gain * left ** 2 / 2, slip + gain * left
    height = scene.size[1] / 2
    return scene.mass * (slip ** 2 / 2 + g * height - along * way)


def check_end(data):
    if "end_energy" not in data["problem"]:
        return
    mp.dps = MORE_DIGITS
    energy = end_energy(Scene(data))
    given = number(data["problem"]["end_energy"])
    assert abs(energy - given) <= mpf(10) ** -16, (data["problem"]["id"], mp.nstr(energy, PRINTED))


# ---------------------------------------------------------------- space

class Rotation:
    """Euler parameters and body rates by Taylor series in time, segment after segment."""

    def __init__(self, moments, q, rates):
        self.moments, self.order = moments, int(mp.dps * 0.8)
        self.segments = [(mpf(0), *self.series(q, rates))]

    def series(self, q, w):
        I = self.moments
        ratio = [(I[1] - I[2]) / I[0], (I[2] - I[0]) / I[1], (I[0] - I[1]) / I[2]]
        Q, Om = [[x] for x in q], [[x] for x in w]
        for k in range(self.order):
            new_w = [ratio[i] * series_product(Om[(i + 1) % 3], Om[(i + 2) % 3], k) / (k + 1) for i in range(3)]
            d = lambda i, j: series_product(Q[i], Om[j], k)
            new_q = [-d(1, 0) - d(2, 1) - d(3, 2), d(0, 0) + d(2, 2) - d(3, 1),
                     d(0, 1) - d(1, 2) + d(3, 0), d(0, 2) + d(1, 1) - d(2, 0)]
            for i in range(3):
                Om[i].append(new_w[i])
            for i in range(4):
                Q[i].append(new_q[i] / (2 * (k + 1)))
        n = self.order
        length = min((mpf(10) ** -(mp.dps + 4) / max(abs(s[k]), mpf(10) ** -300)) ** (mpf(1) / k)
                     for s in Q + Om for k in (n - 1, n))
        return length, Q, Om

    def at(self, t):
        while True:
            start, length, Q, Om = self.segments[-1]
            if t <= start + length:
                break
            q, w = [value(s, length) for s in Q], [value(s, length) for s in Om]
            self.segments.append((start + length, *self.series(q, w)))
        for start, length, Q, Om in reversed(self.segments):
            if t >= start:
                return [value(s, t - start) for s in Q], [value(s, t - start) for s in Om]
        raise AssertionError


def turning(q):
    a, b, c, d = q
    return [[a * a + b * b - c * c - d * d, 2 * (b * c - a * d), 2 * (b * d + a * c)],
            [2 * (b * c + a * d), a * a - b * b + c * c - d * d, 2 * (c * d - a * b)],
            [2 * (b * d - a * c), 2 * (c * d + a * b), a * a - b * b - c * c + d * d]]


def apply(R, v):
    return [dot(row, v) for row in R]


def back(R, v):
    return [sum(R[j][i] * v[j] for j in range(3)) for i in range(3)]


def space_truth(scene, law):
    L, W, T = scene.box
    corners = [(x, y, z) for x in (-L / 2, L / 2) for y in (-W / 2, W / 2) for z in (-T / 2, T / 2)]
    name = lambda c: "".join(("-" if v < 0 else "+") + axis for v, axis in zip(c, "xyz"))
    moments = [scene.mass * (W * W + T * T) / 12, scene.mass * (L * L + T * T) / 12, scene.mass * (L * L + W * W) / 12]
    q = [number(x) for x in scene.drop["attitude"]]
    q = [x / norm(q) for x in q]
    V = [number(x) for x in scene.drop.get("velocity", [0, 0, -scene.drop.get("speed", 1)])]
    R = turning(q)
    rates = back(R, [number(x) for x in scene.drop["angular_velocity"]])
    z = -min(apply(R, c)[2] for c in corners)
    struck = [i for i, c in enumerate(corners) if z + apply(R, c)[2] < tiny()]
    reach, time, rows = norm(corners[0]), mpf(0), []
    restitution, friction = law.split()
    while len(rows) < scene.count:
        assert len(struck) == 1
        R = turning(q)
        omega, arm = apply(R, rates), apply(R, corners[struck[0]])
        v = [x + y for x, y in zip(V, cross(omega, arm))]
        Wm = matrix(3, 3)
        for j in range(3):
            unit = [mpf(int(i == j)) for i in range(3)]
            turned = cross(apply(R, [x / I for x, I in zip(back(R, cross(arm, unit)), moments)]), arm)
            for i in range(3):
                Wm[i, j] = unit[i] / scene.mass + turned[i]
        if scene.mu == 0:
            P = [mpf(0), mpf(0), -(1 + scene.e) * v[2] / Wm[2, 2]]
        elif friction == "moreau":
            P = space_moreau(Wm, scene.mu, scene.e, v)
        else:
            P = space_path(Wm, scene.mu, scene.e, restitution, v)
        V = [x + p / scene.mass for x, p in zip(V, P)]
        rates = [w + x / I for w, x, I in zip(rates, back(R, cross(arm, P)), moments)]
        rows.append((name(corners[struck[0]]), [time, *P, *V, *apply(R, rates), mpf(0)]))
        fastest = sum(I * w * w for I, w in zip(moments, rates)) / min(moments)
        rotation, z0, V0 = Rotation(moments, q, rates), z, V

        def heights(t):
            q1, w1 = rotation.at(t)
            R1 = turning(q1)
            rate = apply(R1, w1)
            places = [apply(R1, c) for c in corners]
            return [(z0 + V0[2] * t - scene.g * t * t / 2 + r[2], V0[2] - scene.g * t + cross(rate, r)[2])
                    for r in places]

        flight, struck = first_touch(heights, struck, scene.g + 2 * reach * fastest, mpf(10))
        time += flight
        q, rates = rotation.at(flight)
        z, V = z + V[2] * flight - scene.g * flight ** 2 / 2, [V[0], V[1], V[2] - scene.g * flight]
    return rows


# ---------------------------------------------------------------- a ball

def ball_truth(scene, law):
    """Without coupling of normal and tangential motion the slip s shrinks by (1/m + r^2/I) P_t = 7 P_t/(2 m) along
    itself, until it stops; friction's law and that of restitution do not matter."""
    r, m, g = scene.radius, scene.mass, scene.g
    V = [number(x) for x in scene.drop.get("velocity", [0, 0, -scene.drop.get("speed", 1)])]
    W = [number(x) for x in scene.drop.get("angular_velocity", [0, 0, 0])]
    time, rows = mpf(0), []
    for _ in range(scene.count):
        slip = [V[0] - r * W[1], V[1] + r * W[0]]  # V + omega x (0, 0, -r)
        size = norm(slip)
        normal = -(1 + scene.e) * m * V[2]
        tangential = min(scene.mu * normal, 2 * m * size / 7)
        P = [-tangential * s / size if size > 0 else mpf(0) for s in slip] + [normal]
        V = [v + p / m for v, p in zip(V, P)]
        W = [w + t * 5 / (2 * m * r * r) for w, t in zip(W, cross([mpf(0), mpf(0), -r], P))]
        rows.append(("surface", [time, *P, *V, *W, mpf(0)]))
        time += 2 * V[2] / g
        V = [V[0], V[1], -V[2]]
    if scene.data["problem"].get("at_rest"):
        left = rows[-1][1][0] + 2 * rows[-1][1][6] / (g * (1 - scene.e))
        assert scene.mu == 0 and norm(V[:2]) == 0 and left < number(scene.data["problem"]["until"])
    return rows


# ---------------------------------------------------------------- a level face that grips

def face_truth(scene, law):
    """A box that lands level and keeps level while friction stops it: its momentum and spin are what friction takes,
    however the load is spread, and the normal velocity is reversed.  A load that lies evenly needs m |V + w x r| of
    friction at r; at most half of what there is at the corners leaves room for a load that the friction shifts."""
    L, W, T = scene.box
    V = [number(x) for x in scene.drop["velocity"]]
    spin = number(scene.drop["angular_velocity"][2])
    assert [number(x) for x in scene.drop["attitude"]] == [1, 0, 0, 0]
    place = " ".join(x + y + "-z" for x in ("-x", "+x") for y in ("-y", "+y"))
    time, rows = mpf(0), []
    for _ in range(scene.count):
        normal = -(1 + scene.e) * scene.mass * V[2]
        farthest = norm(V[:2]) + abs(spin) * norm([L / 2, W / 2])
        shift = scene.mass * norm(V[:2]) * T / 2 / normal  # of the load's middle
        assert 2 * scene.mass * farthest <= scene.mu * normal and 6 * shift < min(L, W) / 2
        P = [-scene.mass * V[0], -scene.mass * V[1], normal]
        V, spin = [mpf(0), mpf(0), -scene.e * V[2]], mpf(0)
        rows.append((place, [time, *P, *V, mpf(0), mpf(0), mpf(0), mpf(0)]))
        time += 2 * V[2] / scene.g
        V = [mpf(0), mpf(0), -V[2]]
    return rows


# ---------------------------------------------------------------- the damped phone

def quotient(a, b, c, k):
    """Coefficient k of a/b, c those below."""
    return (a[k] - sum((c[j] * b[k - j] for j in range(k)), mpf(0))) / b[0]


def contact_series(scene, corner, state, order):
    """Taylor coefficients of (z, V, alpha, rate) while one corner is in the ground; alpha > 0, the corner is end a."""
    k, c = number(scene.data["ground"]["stiffness"]), number(scene.data["ground"]["damping"])
    width, (x, y) = scene.width, corner
    Z, V, A, Wt = ([value_] for value_ in state)
    S, C = [sin(state[2])], [cos(state[2])]
    tan, cot = [], []
    names = ["dt", "dn", "depth", "rate", "l1", "l2", "s", "d", "S0", "S1", "S2", "stiff", "F", "M"]
    store = {n: [] for n in names}

    def prod(a, b, n):
        return series_product(store.get(a, a) if isinstance(a, str) else a, store.get(b, b) if isinstance(b, str) else b, n)

    for n in range(order):
        tan.append(quotient(S, C, tan, n))
        cot.append(quotient(C, S, cot, n))
        store["dt"].append(x * C[n] - y * S[n])
        store["dn"].append(x * S[n] + y * C[n])
        store["depth"].append(-Z[n] - store["dn"][n])
        store["rate"].append(-V[n] - prod(Wt, "dt", n))
        store["l1"].append(prod("depth", cot, n))
        store["l2"].append(prod("depth", tan, n))
        store["s"].append(store["l1"][n] + store["l2"][n])
        store["d"].append(store["l1"][n] - store["l2"][n])
        store["S0"].append(prod("depth", "s", n) / 2)
        square = [prod("s", "d", i) for i in range(n + 1)]
        store["S1"].append(prod("depth", square, n) / 6)
        cubes = [sum(series_product([prod(l, l, j) for j in range(i + 1)], store[l], i) for l in ("l1", "l2"))
                 for i in range(n + 1)]
        store["S2"].append(prod("depth", cubes, n) / 12)
        store["stiff"].append((k if n == 0 else 0) + c * store["rate"][n])
        turn = lambda name: [prod(Wt, name, i) for i in range(n + 1)]
        store["F"].append(width * (prod("stiff", "S0", n) - c * turn("S1")[n]))
        store["M"].append(width * (prod("stiff", "S1", n) - c * turn("S2")[n]) + prod("dt", "F", n))
        Z.append(V[n] / (n + 1))
        V.append((store["F"][n] / scene.mass - (scene.g if n == 0 else 0)) / (n + 1))
        A.append(Wt[n] / (n + 1))
        Wt.append(store["M"][n] / scene.moment / (n + 1))
        S.append(sum((j * A[j] * C[n + 1 - j] for j in range(1, n + 2)), mpf(0)) / (n + 1))
        C.append(-sum((j * A[j] * S[n + 1 - j] for j in range(1, n + 2)), mpf(0)) / (n + 1))
    return [Z, V, A, Wt], store["depth"], store["rate"]


def contact(scene, corner, state):
    """From touch to lift-off: duration and state then."""
    order, time = int(mp.dps * 0.6), mpf(0)
    slowest = -number(scene.data["ground"]["stiffness"]) / number(scene.data["ground"]["damping"])
    while True:
        series, depth, rate = contact_series(scene, corner, state, order)
        length = min((mpf(10) ** -(mp.dps + 4) * max(abs(s[0]), mpf(10) ** -6) / max(abs(s[n]), mpf(10) ** -300))
                     ** (mpf(1) / n) for s in series for n in (order - 1, order))
        # Nowhere does the ground pull: each submerged point is within 2 depths of the corner.
        assert rate[0] - abs(state[3]) * 2 * abs(depth[0]) * 10 > slowest, "the clamp acts"
        if time > 0 and value(depth, length) < 0:
            length = root(depth, mpf(0), length)
            return time + length, [value(s, length) for s in series]
        state = [value(s, length) for s in series]
        time += length


def compliant_truth(scene, law):
    points, names = planar_names(scene)
    z, alpha, V, Vt, omega = planar_start(scene)
    time, rows, struck = mpf(0), [], 0
    while len(rows) < scene.count:
        mirror = 1 if points[struck][0] < 0 else -1
        corner = (mirror * points[struck][0], points[struck][1])
        duration, after = contact(scene, corner, [z, V, mirror * alpha, -mirror * omega])
        z1, V1, alpha1, omega1 = after[0], after[1], mirror * after[2], -mirror * after[3]
        # The flights before and after have the same height at `middle` after the touch.
        extended = V1 + scene.g * duration
        at_touch = z1 - V1 * duration - scene.g * duration ** 2 / 2
        middle = (at_touch - z) / (V - extended)
        P = scene.mass * (extended - V)
        rows.append((names[struck], [time + middle, 0, 0, P, Vt, 0, extended - scene.g * middle, 0, omega1, 0,
                                     duration]))
        state = [z1, alpha1, V1, Vt, omega1]
        flight, arriving = planar_flight(scene, points, state, [struck])
        time += duration + flight
        z, alpha = z1 + V1 * flight - scene.g * flight ** 2 / 2, alpha1 - omega1 * flight
        V, omega, struck = V1 - scene.g * flight, omega1, arriving[0]
    return rows


# ---------------------------------------------------------------- all of them

def truth(data, law):
    scene = Scene(data)
    if data["problem"]["class"] == "compliant":
        return compliant_truth(scene, law)
    if data["body"]["shape"] == "sphere":
        return ball_truth(scene, law)
    if data["drop"].get("attitude") == [1, 0, 0, 0]:
        return face_truth(scene, law)
    return space_truth(scene, law) if "attitude" in data["drop"] else planar_truth(scene, law)


def computed(data, law, digits):
    mp.dps = digits
    return truth(data, law)


def check_that_laws_agree(data, rows):
    for law in LAWS:
        for row, other in zip(rows, computed(data, law, MORE_DIGITS)):
            assert row[0] == other[0] and max(abs(a - b) for a, b in zip(row[1], other[1])) < mpf(10) ** -40, law


def table(only):
    yield "# Truth of the benchmark's problems: made by truth.py from the problems' files.  SI; world frame, W clockwise."
    yield ",".join(["problem", "law", "n", "place"] + COLUMNS + ["uncertainty"])
    for path in sorted((HERE / "problems").glob("*.toml")):
        data = tomllib.loads(path.read_text())
        if only and data["problem"]["id"] not in only:
            continue
        check_end(data)
        has_laws = "friction" in data["impact"] and not data["problem"].get("laws_agree")
        laws = LAWS if has_laws else ["any"]
        for law in laws:
            given = "newton routh" if law == "any" else law
            first, second = (computed(data, given, digits) for digits in (DIGITS, MORE_DIGITS))
            if data["problem"].get("laws_agree"):
                check_that_laws_agree(data, second)
            sizes = [max(abs(row[1][i]) for row in second) for i in range(len(COLUMNS))]
            assert [row[0] for row in first] == [row[0] for row in second]
            for n, (one, other) in enumerate(zip(first, second), 1):
                differences = [abs(a - b) / s for a, b, s in zip(one[1], other[1], sizes) if s != 0]
                uncertainty = max(differences + [mpf(10) ** -PRINTED])
                assert uncertainty < mpf(10) ** -20, (path.name, law, uncertainty)
                numbers = [mp.nstr(mpf(x), PRINTED, min_fixed=0, max_fixed=0) if x != 0 else "0" for x in other[1]]
                yield ",".join([data["problem"]["id"], law, str(n), one[0]] + numbers + [mp.nstr(uncertainty, 2)])


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--output", type=pathlib.Path, default=HERE / "truth.csv")
    parser.add_argument("--check", nargs="+", metavar="ID", help="compare these problems' rows with truth.csv")
    arguments = parser.parse_args()
    if not arguments.check:
        arguments.output.write_text("\n".join(table([])) + "\n")
        return
    committed = (HERE / "truth.csv").read_text().splitlines()
    wanted = [line for line in committed if line.split(",")[0] in arguments.check]
    made = list(table(arguments.check))[2:]
    if made != wanted:
        sys.exit("truth.csv is not what truth.py makes: " +
                 next((a for a, b in zip(made, wanted) if a != b), f"{len(made)} rows, not {len(wanted)}"))


if __name__ == "__main__":
    main()
