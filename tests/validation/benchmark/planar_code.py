# SPDX-License-Identifier: GPL-3.0-or-later
"""Small codes for planar rods and boxes: one that goes from event to event, in which faults can be planted, and one of steps."""
import math

from exact_motion import Asked, Body, steps_down


class Code(Asked):
    """Free flight to the earliest touch, then an impact; `strike` and `fly` can be replaced by faulty ones."""

    def __init__(self, problem, gap_index=0, law=None):
        super().__init__(problem, gap_index, law)
        scene = self.statement["scene"]
        body = Body(scene)
        self.mass, self.moment = body.mass, body.moments[1]
        self.points = sorted({(x, z) for x, _, z in body.points})
        self.gravity = scene["world"]["gravity"]
        self.e = scene["impact"]["restitution"]
        self.friction = scene["impact"].get("friction") or 0.0
        self.state = self.row(self.state_at_start())
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
            now = Code.fly(self, state, t)
            steps = steps_down([(self.height(now, k), self.approach(now, k)) for k in range(len(self.points))], bound, struck if t == 0 else ())
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


class StepCode(Code):
    """Euler's steps, with the exact impulse at points on or in the ground.  One row a step, or one in `every`; what is done in
    a step, in its order: k gravity, s impacts, d places."""

    def __init__(self, problem, gap_index=0, step=1 / 960, order="ksd"):
        super().__init__(problem, gap_index)
        self.step, self.order = step, order

    def advance(self, state):
        for part in self.order:
            if part == "k":
                state = state[:5] + [state[5] - self.gravity * self.step / self.order.count("k"), state[6]]
            elif part == "d":
                x, z, phi, vx, vz, omega = state[1:]
                state = [state[0] + self.step, x + vx * self.step, z + vz * self.step, phi + omega * self.step, vx, vz, omega]
            else:
                state = self.struck(state)
        return state

    def struck(self, state):
        """The lowest point that comes down first."""
        for point in sorted(range(len(self.points)), key=lambda k: self.height(state, k)):
            if self.height(state, point) <= 1e-9 and self.approach(state, point) < 0:
                state = self.apply(state, point, *self.impulse(state, point, self.e, self.friction))
        return state

    def rows(self, every=1, end=None):
        end, rows, state = self.end() if end is None else end, [], self.state
        for k in range(math.ceil(end / self.step) + every + 1):
            if k % every == 0:
                rows.append([k * self.step, *state[1:]])
            state = self.advance(state)
        return rows

    def text(self, every=1, **head):
        return super().text(self.rows(every), **head)
