# SPDX-License-Identifier: GPL-3.0-or-later
"""What the exercises of 6_the_phone must give, without clatter."""

import math

L, W, T, MASS, GRAVITY = 0.10566, 0.04394, 0.01905, 0.08814, 9.81


def grown(thickness, spin, time):
    """Growth of a small disturbance in that time, by Euler's equations in steps (RK4), after it has settled into its growing form."""
    I1, I2, I3 = W**2 + thickness**2, L**2 + thickness**2, L**2 + W**2

    def euler(w):
        return (I2 - I3) * w[1] * w[2] / I1, (I3 - I1) * w[2] * w[0] / I2, (I1 - I2) * w[0] * w[1] / I3

    def run(w, time, steps):
        h = time / steps
        for _ in range(steps):
            a = euler(w)
            b = euler([x + h / 2 * k for x, k in zip(w, a)])
            c = euler([x + h / 2 * k for x, k in zip(w, b)])
            d = euler([x + h * k for x, k in zip(w, c)])
            w = [x + h / 6 * (k + 2 * m + 2 * n + o) for x, k, m, n, o in zip(w, a, b, c, d)]
        return w

    settled = run([1e-30, spin, 0.0], 0.6, 3000)
    return math.log(run(settled, time, 3000)[0] / settled[0])


def rate():
    value = grown(T, 53.5, 0.5) / 0.5
    return [value, 10 * math.log(10) / value]


def thickness():
    low, high = 0.030, 0.0435
    for _ in range(25):
        middle = (low + high) / 2
        low, high = (middle, high) if grown(middle, 53.5, 0.4456) > math.log(1000) else (low, middle)
    return [1e3 * (low + high) / 2]


def corners(phi):
    """(x, z) of the corners of the section about the centre in order; at phi > 0 the left end is low."""
    c, s = math.cos(phi), math.sin(phi)
    return [(c * x - s * z, s * x + c * z) for x, z in ((-L / 2, -T / 2), (L / 2, -T / 2), (L / 2, T / 2), (-L / 2, T / 2))]


INERTIA = MASS * (L * L + T * T) / 12
SPEED = math.sqrt(2 * GRAVITY * (1 + min(z for _, z in corners(math.radians(10)))))


def discrete():
    """Impulses at corners, flights scanned in small steps for the first corner to come down; d(phi)/dt = -spin."""
    phi, v, spin, impulses = math.radians(10), -SPEED, 0.0, []
    for _ in range(2):
        at = min(corners(phi), key=lambda corner: corner[1])
        z = -at[1]
        P = -2 * (v - spin * at[0]) / (1 / MASS + at[0] ** 2 / INERTIA)
        impulses.append(P)
        v, spin = v + P / MASS, spin - at[0] * P / INERTIA

        def lowest(t):
            return z + v * t - GRAVITY * t * t / 2 + min(height for _, height in corners(phi - spin * t))
        t, step = 1e-7, 1e-7
        while lowest(t) > 0 and t < 0.01:
            t += step
        low, high = t - step, t
        for _ in range(60):
            middle = (low + high) / 2
            low, high = (middle, high) if lowest(middle) > 0 else (low, middle)
        phi, v = phi - spin * high, v - GRAVITY * high
    return impulses[1] / impulses[0]


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


def continuous(k, step):
    """Ratio of the impulses of the first two contacts of the elastic phone, planar, RK4 with fixed steps."""
    phi = math.radians(10)
    state = (-min(z for _, z in corners(phi)), phi, -SPEED, 0.0, 0.0)  # z, phi, v, spin, impulse

    def slope(y):
        force, moment = load(y[0], y[1], k)
        return y[2], -y[3], force / MASS - GRAVITY, moment / INERTIA, force

    impulses, taken, touching = [], 0.0, True
    while len(impulses) < 2:
        a = slope(state)
        b = slope([y + step / 2 * q for y, q in zip(state, a)])
        c = slope([y + step / 2 * q for y, q in zip(state, b)])
        d = slope([y + step * q for y, q in zip(state, c)])
        state = tuple(y + step / 6 * (p + 2 * q + 2 * r + s) for y, p, q, r, s in zip(state, a, b, c, d))
        now = state[0] + min(z for _, z in corners(state[1])) < 0
        if touching and not now:
            impulses.append(state[4] - taken)
            taken = state[4]
        touching = now
    return impulses[1] / impulses[0]


ORACLES = {
    "6.1": (rate, 1e-5),  # RK4 in steps of 0.2 ms; the printed answer has 6 digits
    "6.2": (thickness, 1e-5),  # the same, and 25 bisections of 13 mm
    # Discrete: scan in steps of 0.1 µs, and bisection.  Continuous: RK4 in steps of 1 µs and 0.1 µs.  The printed answer has 4 digits.
    "6.3": (lambda: [discrete(), continuous(1e8, 1e-6), continuous(1e14, 1e-7)], 4e-4),
}
