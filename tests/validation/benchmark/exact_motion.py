# SPDX-License-Identifier: GPL-3.0-or-later
"""Motions sampled from the truth of a benchmark's problem: parabola and free turning between the truth's impacts."""
import functools
import json
import math
import pathlib
import tempfile

from run_folder import json_of as told
from run_folder import printed
from space_folder import product, rotated, runge_kutta, turned_back


def scored(*texts, options=()):
    """What is said of each text as a file of its own."""
    with tempfile.TemporaryDirectory() as folder:
        paths = [pathlib.Path(folder, f"{k}.csv") for k in range(len(texts))]
        for path, text in zip(paths, texts):
            path.write_text(text) if isinstance(text, str) else path.write_bytes(text)
        return told("benchmark", "score", *paths, *options)["files"]


@functools.lru_cache(maxsize=None)
def answered(*arguments):
    return printed("benchmark", *arguments, "--format", "json")


class Asked:
    """A problem with one of its starts; answers are written as rows of a file."""

    def __init__(self, problem, gap_index=0, law=None):
        self.problem, self.law = problem, law
        self.statement = json.loads(answered("show", problem))
        self.truth = json.loads(answered("truth", problem, *(["--law", law] if law else [])))["impacts"]
        starts = self.statement["starts"]
        self.start = starts[min(gap_index, len(starts) - 1)]
        self.is_planar, self.touch = "phi" in self.start, self.start["first_touch"]

    def until(self):
        """The time up to which something is asked for; none where it is over with the last impact."""
        return self.statement["until"] if self.statement["until_is_asked"] else None

    def end(self):
        return self.touch + (self.until() or 1.02 * self.truth[-1]["t"] + 0.004)

    def columns(self):
        return ("t,x,z,phi,vx,vz,omega" if self.is_planar else "t,x,y,z,q0,q1,q2,q3,vx,vy,vz,wx,wy,wz").split(",")

    def text(self, rows, **head):
        lines = [f"# problem: {self.problem}"] + [f"# {key}: {value}" for key, value in head.items()]
        lines += [f"# law: {self.law}"] if self.law else []
        return "\n".join([*lines, ",".join(self.columns())] + [",".join(repr(float(x)) for x in row) for row in rows]) + "\n"

    def row(self, state):
        if not self.is_planar:
            return [state.time, *state.position, *state.attitude, *state.velocity, *state.omega]
        phi = 2 * math.atan2(-state.attitude[2], state.attitude[0])
        return [state.time, state.position[0], state.position[2], phi, state.velocity[0], state.velocity[2], -state.omega[1]]

    def state_at_start(self):
        start = self.start
        return State(0.0, start["position"], start["attitude"], start["velocity"], start["angular_velocity"])


def steps_down(heights, bound, skipped=()):
    """Times after which each point can touch at the earliest, from its height, its velocity and a bound on its acceleration;
    a point that has just been struck goes up first."""
    steps = []
    for k, (h, v) in enumerate(heights):
        root = math.sqrt(v * v + 2 * bound * max(h, 0))
        steps.append(max(v, 1e-9) / bound if k in skipped else 2 * max(h, 0) / (root - v) if v < 0 else (v + root) / bound)
    return steps


class Body:
    """Principal moments about body axes; a planar body turns about y alone, whatever they are."""

    def __init__(self, scene):
        body = scene["body"]
        self.mass = body["mass"]
        if body["shape"] == "rod":
            moment = self.mass * (body["length"] ** 2 + 3 * body["radius"] ** 2) / 12
            self.moments = (moment, moment, moment)
            half, radius = body["length"] / 2, body["radius"]
            self.points = [(x, 0.0, z) for x in (-half, half) for z in {-radius, radius}]
        elif body["shape"] == "sphere":
            self.moments = (0.4 * self.mass * body["radius"] ** 2,) * 3
            self.points = []  # which depend on the attitude
        else:
            length, width, height = body["size"]
            self.moments = tuple(self.mass * (a * a + b * b) / 12
                                 for a, b in ((width, height), (length, height), (length, width)))
            self.points = [(x * length / 2, y * width / 2, z * height / 2)
                           for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]

    def turn(self, q, rates, time):
        """Free rotation by the classical Runge-Kutta method, body rates."""
        if max(abs(r) for r in (rates[0], rates[2])) == 0:
            half = rates[1] * time / 2
            return product(q, (math.cos(half), 0.0, math.sin(half), 0.0)), rates
        i = self.moments

        def slope(y):
            w = y[4:]
            dq = product(y[:4], (0.0, *w))
            return [x / 2 for x in dq] + [(i[1] - i[2]) / i[0] * w[1] * w[2], (i[2] - i[0]) / i[1] * w[2] * w[0],
                                          (i[0] - i[1]) / i[2] * w[0] * w[1]]

        y, count = [*q, *rates], max(1, math.ceil(abs(time) / 5e-5))
        for _ in range(count):
            y = runge_kutta(slope, y, time / count)
        return tuple(x / math.hypot(*y[:4]) for x in y[:4]), tuple(y[4:])


def pull_of(world):
    """Gravity along the ground and towards it."""
    slope = math.radians(world.get("incline_deg") or 0)
    return world["gravity"] * math.sin(slope), world["gravity"] * math.cos(slope)


class State:
    def __init__(self, time, position, attitude, velocity, omega):
        self.time, self.position, self.attitude = time, list(position), tuple(attitude)
        self.velocity, self.omega = list(velocity), tuple(omega)
        self.rests = False
        self.slides = None  # on the ground: acceleration along it, and for how long

    def flown(self, body, gravity, time, along=0.0):
        dt = time - self.time
        lasts = dt
        if self.slides:
            gravity, along, lasts = 0.0, self.slides[0], min(dt, self.slides[1])
        if self.rests:
            gravity = along = 0.0
        position = [x + v * lasts for x, v in zip(self.position, self.velocity)]
        position[0] += along * lasts * lasts / 2
        position[2] -= gravity * dt * dt / 2
        velocity = [self.velocity[0] + along * lasts, self.velocity[1], self.velocity[2] - gravity * dt]
        if lasts < dt:
            velocity[0] = 0.0
        attitude, rates = body.turn(self.attitude, turned_back(self.attitude, self.omega), dt)
        state = State(time, position, attitude, velocity, rotated(attitude, rates))
        if self.rests:
            state.rests = True
        if self.slides:
            state.slides = (self.slides[0], max(self.slides[1] - dt, 0.0))
        return state

    def slide_on(self, bounce, friction, pull):
        """On the ground from now on, after bounces of this rebound speed and restitution that are too small to follow."""
        rise, restitution = bounce
        along, down = pull
        slip = self.velocity[0]
        while rise > 1e-30:
            slip += along * 2 * rise / down
            stop = friction * (1 + restitution) * rise
            slip = 0.0 if abs(slip) <= stop else slip - math.copysign(stop, slip)
            rise *= restitution
        self.velocity = [slip, 0.0, 0.0]
        if abs(slip) < 1e-15 and abs(along) <= friction * down:
            self.velocity[0], self.slides = 0.0, (0.0, math.inf)
            return
        gain = along - math.copysign(friction * down, slip if slip else along)
        self.slides = (gain, -slip / gain if slip * gain < 0 else math.inf)


class Motion(Asked):
    """Pieces of free flight, each from the state right after an impact."""

    def __init__(self, problem, gap_index=0, law=None):
        super().__init__(problem, gap_index, law)
        scene = self.statement["scene"]
        self.body, (self.along, self.gravity) = Body(scene), pull_of(scene["world"])
        self.pieces = [self.state_at_start()]
        for row in self.truth:
            self.strike(self.touch + row["t"], *self.velocities(row))
        if self.statement["at_rest"]:
            self.settle(scene["impact"]["restitution"])
        elif self.statement["stays"]:
            self.slide_down(scene["impact"])

    def settle(self, restitution):
        """The bounces that follow, until they are too small for doubles, and rest."""
        time, rise = self.pieces[-1].time, self.pieces[-1].velocity[2]
        while rise > 1e-12:
            time, rise = time + 2 * rise / self.gravity, restitution * rise
            self.strike(time, [0.0, 0.0, rise], self.pieces[-1].omega)
        self.pieces[-1].velocity = [0.0, 0.0, 0.0]
        self.pieces[-1].rests = True

    def slide_down(self, impact):
        """The bounces that follow on a slope, until they are small, and the slide."""
        time, rise, e = self.pieces[-1].time, self.pieces[-1].velocity[2], impact["restitution"]
        while rise > 1e-9:
            time += 2 * rise / self.gravity
            slip, stop = self.at(time).velocity[0], impact["friction"] * (1 + e) * rise
            rise *= e
            self.strike(time, [0.0 if abs(slip) <= stop else slip - math.copysign(stop, slip), 0.0, rise], (0.0, 0.0, 0.0))
        self.pieces[-1].slide_on((rise, e), impact["friction"], (self.along, self.gravity))

    def velocities(self, row):
        if self.is_planar:
            return [row["Vt"], 0.0, row["V"]], (0.0, row["Omega"], 0.0)
        return [row[k] for k in ("Vx", "Vy", "Vz")], tuple(row[k] for k in ("Wx", "Wy", "Wz"))

    def at(self, time):
        piece = [p for p in self.pieces if p.time <= time or p is self.pieces[0]][-1]
        return piece.flown(self.body, self.gravity, time, self.along)

    def strike(self, time, velocity, omega):
        """From this time on with these velocities."""
        before = self.pieces[-1].flown(self.body, self.gravity, time, self.along)
        self.pieces.append(State(time, before.position, before.attitude, velocity, omega))

    def rows(self, step, end=None):
        end = self.end() if end is None else end
        rows, piece = [], 0
        for k in range(math.ceil(end / step) + 1):
            time = k * step
            while piece + 1 < len(self.pieces) and self.pieces[piece + 1].time <= time:
                piece += 1
            rows.append(self.row(self.pieces[piece].flown(self.body, self.gravity, time, self.along)))
        return rows
