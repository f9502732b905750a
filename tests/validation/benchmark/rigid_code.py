# SPDX-License-Identifier: GPL-3.0-or-later
"""A small event-driven code for every rigid problem, in the plane and in space, in which faults can be planted."""
import math

import numpy as np

from exact_motion import Asked, Body, State, pull_of, rotated, steps_down, turned_back


def law_of(problem):
    """The law that the code follows, if it matters."""
    return "newton moreau" if "newton moreau" in Asked(problem).statement["laws"] else None


class RigidCode(Asked):
    """Flights to the earliest touch, then Moreau's impact; numbers and methods can be replaced by faulty ones."""

    def __init__(self, problem, gap_index=0):
        super().__init__(problem, gap_index, law_of(problem))
        scene = self.statement["scene"]
        self.body, (self.along, self.gravity) = Body(scene), pull_of(scene["world"])
        self.mass, self.inertia = self.body.mass, np.diag(self.body.moments)
        self.size = scene["body"]["radius"] if not self.body.points else max(math.hypot(*p) for p in self.body.points)
        # One point for the ends of a planar body's edges, all along y.
        end = self.statement["ground_end"]  # strikes a level box in place of the corner over it
        flat = {(end if end is not None and x > 0 > z else x, 0.0, z) for x, _, z in self.body.points}
        self.points = sorted(flat if self.is_planar else self.body.points)
        self.e, self.friction = scene["impact"]["restitution"], scene["impact"].get("friction") or 0.0
        self.state, self.solved = self.state_at_start(), moreau
        self.levers, self.count, self.gone = 1.0, 0, False
        self.speed = math.hypot(*self.state.velocity) + math.hypot(*self.state.omega) * self.size

    def arms(self, state):
        if not self.points:
            return [np.array([0.0, 0.0, -self.size])]
        return [np.array(rotated(state.attitude, p)) for p in self.points]

    def fly(self, state, time):
        return state.flown(self.body, self.gravity, time, self.along)

    def approach(self, state, arm):
        return (np.array(state.velocity) + np.cross(state.omega, arm))[2]

    def next_touch(self, state, struck, latest):
        """The earliest time at which a point comes down, by steps that none can outrun."""
        fastest = math.sqrt(sum(i * w * w for i, w in zip(self.body.moments, turned_back(state.attitude, state.omega)))
                            / min(self.body.moments))
        bound = abs(self.gravity) + 2 * self.size * fastest ** 2 + 1e-12
        now = state
        while now.time < latest and not self.gone:
            steps = steps_down([(now.position[2] + arm[2], self.approach(now, arm)) for arm in self.arms(now)], bound,
                               struck if now is state else ())
            step = min(steps)
            if step < 1e-14:
                return now, [k for k, s in enumerate(steps) if s < 1e-9]
            now = RigidCode.fly(self, now, now.time + step)
        return None, []

    def impulse(self, state, arm):
        """Newton's e and Coulomb's cone for the velocity after the impact, unless it is solved otherwise."""
        turn = np.array([rotated(state.attitude, axis) for axis in np.eye(3)]).T
        inverse = turn @ np.linalg.inv(self.inertia) @ turn.T
        cross = np.array([[0, -arm[2], arm[1]], [arm[2], 0, -arm[0]], [-arm[1], arm[0], 0]])
        w = np.eye(3) / self.mass - cross @ inverse @ cross
        v = np.array(state.velocity) + np.cross(state.omega, arm)
        return inverse, self.solved(w, v, self.e, self.friction)

    def strike(self, state, points):
        arms = self.arms(state)
        points = [k for k in points if self.approach(state, arms[k]) < -1e-9 * self.speed]
        if len(points) > 1:
            return self.land(state)
        if not points or self.statement["at_rest"] and self.approach(state, arms[points[0]]) > -1e-7 * self.speed:
            return self.stay(state)
        return self.strike_at(state, self.levers * arms[points[0]])

    def strike_at(self, state, arm):
        inverse, impulse = self.impulse(state, arm)
        return struck(state, np.array(state.velocity) + impulse / self.mass,
                      np.array(state.omega) + inverse @ np.cross(arm, impulse))

    def stay(self, state):
        """What touches goes on touching: no impact more is followed."""
        self.gone = True
        if self.statement["stays"] and not self.statement["at_rest"]:
            approach, slip = max(-state.velocity[2], 0.0), state.velocity[0]
            stop = self.friction * (1 + self.e) * approach
            state = struck(state, [0.0 if abs(slip) <= stop else slip - math.copysign(stop, slip), 0.0, 0.0], (0.0, 0.0, 0.0))
            state.slide_on((self.e * approach, min(self.e, 0.999)), self.friction, (self.along, self.gravity))
        if self.statement["at_rest"]:
            state = struck(state, [*state.velocity[:2], 0.0], state.omega)
            state.rests = True
        return state

    def land(self, state):
        """Both ends of a level thin rod, or a level face, at once; a face is slowed in its spin by the share of its slide."""
        normal, slip = -(1 + self.e) * state.velocity[2], np.array([*state.velocity[:2], 0.0])
        stop = np.linalg.norm(slip) + abs(state.omega[2]) * self.size  # no part of a face slips faster
        left = 1 - min(self.friction * normal, stop) / stop if stop > 0 else 1.0
        tilting = -self.e * np.array(state.omega)
        return struck(state, [*(left * slip[:2]), -self.e * state.velocity[2]], [*tilting[:2], left * state.omega[2]])

    def states(self, step):
        """At multiples of the step, until the end."""
        end, now, points, k = self.end(), self.state, [], 0
        most = 50 if self.statement["stays"] else len(self.truth) + 1
        while True:
            touch, coming = self.next_touch(now, points, end + 1e-3) if self.count < most else (None, [])
            stop = touch.time if touch is not None else math.inf
            while k * step < stop and k * step <= end + step:
                now = self.fly(now, k * step)
                yield now
                k += 1
            if not stop <= end:
                return
            now, points = self.strike(self.fly(now, stop), coming), coming
            self.count += 1

    def rows(self, step):
        return [self.row(state) for state in self.states(step)]


def struck(state, velocity, omega):
    return State(state.time, state.position, state.attitude, list(velocity), tuple(omega))


def moreau(w, v, e, friction, weights=(1.0, 1.0)):
    """Friction against the slip, of which each component counts by its weight."""
    jump = np.array([-v[0], -v[1], -(1 + e) * v[2]])
    sticking = np.linalg.solve(w, jump)
    if math.hypot(sticking[0], sticking[1]) <= friction * sticking[2]:
        return sticking

    def slip(angle):
        along = np.array([math.cos(angle), math.sin(angle), 0.0])
        force = np.array([0.0, 0.0, 1.0]) - friction * along
        impulse = -(1 + e) * v[2] / (w @ force)[2] * force
        after = v + w @ impulse
        return impulse, along @ after, along[0] * weights[1] * after[1] - along[1] * weights[0] * after[0]

    if friction == 0 or abs(v[1]) + abs(w[1, 0]) + abs(w[1, 2]) == 0:
        for angle in (0.0, math.pi):
            impulse, along, _ = slip(angle)
            if friction == 0 or (impulse[2] > 0 and along >= 0):
                return np.array([impulse[0], 0.0, impulse[2]])
    angles = np.linspace(0, 2 * math.pi, 721)
    for low, high in zip(angles, angles[1:]):
        left = slip(low)[2] > 0
        if left == (slip(high)[2] > 0) or slip(low)[0][2] < 0 or slip(low)[1] < 0:
            continue
        for _ in range(60):
            middle = (low + high) / 2
            low, high = (middle, high) if (slip(middle)[2] > 0) == left else (low, middle)
        return slip(low)[0]
    raise ArithmeticError("no direction of slip satisfies Moreau's law")
