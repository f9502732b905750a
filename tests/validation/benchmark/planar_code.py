# SPDX-License-Identifier: GPL-3.0-or-later
"""A small event-driven code for planar rods and boxes, in which faults can be planted."""
import math

import exact_motion


class Code:
    """Free flight to the earliest touch, then an impact; `strike` and `fly` can be replaced by faulty ones."""

    def __init__(self, problem, gap_index=0, law=None):
        self.statement = exact_motion.told("benchmark", "show", problem)
        self.problem, self.declared = problem, law
        scene = self.statement["scene"]
        body = exact_motion.Body(scene)
        self.mass, self.moment = body.mass, body.moments[1]
        self.points = sorted({(x, z) for x, _, z in body.points})
        self.gravity = scene["world"]["gravity"]
        self.e = scene["impact"]["restitution"]
        self.friction = scene["impact"].get("friction") or 0.0
        start = self.statement["starts"][gap_index]
        self.touch = start["first_touch"]
        self.state = [0.0, start["position"][0], start["position"][2], start["phi"], start["velocity"][0],
                      start["velocity"][2], start["omega"]]
        self.impacts = 0

    def height(self, state, point):
        x, z = self.points[point]
        return state[2] + x * math.sin(state[3]) + z * math.cos(state[3])

    def arm(self, state, point):
        x, z = self.points[point]
        s, c = math.sin(state[3]), math.cos(state[3])
        return x * c - z * s, x * s + z * c

    def fly(self, state, dt):
        t, x, z, phi, vx, vz, w = state
        return [t + dt, x + vx * dt, z + vz * dt - self.gravity * dt * dt / 2, phi + w * dt, vx, vz - self.gravity * dt,
                w]

    def approach(self, state, point):
        return state[5] + state[6] * self.arm(state, point)[0]

    def next_touch(self, state, struck, latest):
        """Earliest time at which a point comes down, by steps that none can outrun."""
        reach = max(math.hypot(*p) for p in self.points)
        bound = abs(self.gravity) + reach * state[6] ** 2 + 1e-12
        t = 0.0
        while t < latest:
            now, steps = Code.fly(self, state, t), []
            for k in range(len(self.points)):
                h, v = self.height(now, k), self.approach(now, k)
                if t == 0 and k in struck:
                    steps.append(max(v, 1e-9) / bound)
                    continue
                root = math.sqrt(v * v + 2 * bound * max(h, 0))
                steps.append(2 * max(h, 0) / (root - v) if v < 0 else (v + root) / bound)
            step = min(steps)
            if step < 1e-14:
                return t, [k for k, s in enumerate(steps) if s < 1e-9]
            t += step
        return None, []

    def impulse(self, state, point, e, ratio):
        """Normal and tangential impulse, P_t = ratio P_n."""
        dx, dz = self.arm(state, point)
        normal = -(1 + e) * self.approach(state, point) / (1 / self.mass + dx * (dx - ratio * dz) / self.moment)
        return normal, ratio * normal

    def apply(self, state, point, normal, tangential):
        dx, dz = self.arm(state, point)
        return state[:4] + [state[4] + tangential / self.mass, state[5] + normal / self.mass,
                            state[6] + (dx * normal - dz * tangential) / self.moment]

    def strike(self, state, points, n):
        if len(points) == 2:
            return state[:5] + [-self.e * state[5], -self.e * state[6]]
        ratio = self.friction  # end a slips to the left
        return self.apply(state, points[0], *self.impulse(state, points[0], self.e, ratio))

    def rows(self, step, end=None):
        end = self.end() if end is None else end
        rows, state, k, struck = [], self.state, 0, []
        while True:
            flight, points = self.next_touch(state, struck, end - state[0] + 1e-3)
            stop = end if flight is None else min(end, state[0] + flight)
            while k * step < stop or (k * step <= end and flight is None):
                rows.append(self.fly(state, k * step - state[0]))
                k += 1
                if k * step > end:
                    return rows
            if flight is None or state[0] + flight >= end:
                return rows
            state = self.strike(self.fly(state, flight), points, self.impacts)
            self.impacts += 1
            struck = points

    def end(self):
        until = self.statement["until"]
        last = self.statement["truth"][-1]["t"]
        return self.touch + (until if until else 1.02 * last + 0.004)

    def text(self, rows, **head):
        lines = [f"# problem: {self.problem}"] + [f"# {key}: {value}" for key, value in head.items()]
        if self.declared:
            lines.append(f"# law: {self.declared}")
        lines.append("t,x,z,phi,vx,vz,omega")
        return "\n".join(lines + [",".join(repr(float(x)) for x in row) for row in rows]) + "\n"
