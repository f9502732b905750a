# SPDX-License-Identifier: GPL-3.0-or-later
"""Problems as runs: what an adapter reads, one line of flat numbers for each problem, gap, step and settings.

A problem gives the body at the first touch.  A run begins earlier, with the body's lowest point at `gap` above the floor:
gaps move the impact's phase within a step.  Frames: x to the right, y into the page, z up; Euler parameters body to world,
scalar first; angular velocity in the world frame.
"""

import csv
import math
import tomllib
from dataclasses import dataclass
from pathlib import Path

ROD_RADIUS = 1e-4  # of the length: spheres that stand for the ends of a thin rod
SLENDER_INERTIA = 0.01  # of the largest: about the rod's axis, which no motion of the plane feels and some engines need
STEPS_AFTER_THE_END = 2
# Newer than the last run of all engines; the adapters do not know balls yet.  rod-10 was the drop of rod-10-brisk then.
LATER = {"ball-grip", "ball-rest", "face-grip", "incline-slide", "incline-stick", "overhang", "painleve", "rock", "rod-10", "slide", "tumble"}
LONG_RUN = 120  # impacts, more than any problem has until its end
AFTER_THE_LAST = 0.05  # s after the last impact that is asked for
TURNING_STEPS = 400  # of Runge and Kutta's method over a flight of some milliseconds: rounding is all that is left


@dataclass(frozen=True)
class Problem:
    id: str
    compliant: bool
    space: bool
    shape: str  # "rod" or "box"
    size: tuple  # extents along the body's axes [m]; a thin rod has no thickness
    mass: float
    inertia: tuple  # principal [kg m²]
    restitution: float
    friction: float
    gravity: float
    ground: dict  # of a compliant problem
    attitude: tuple
    velocity: tuple
    spin: tuple  # angular velocity
    cylinder: float  # radius of a rod that has one: in its plane it touches as a box does
    gaps: tuple
    until: float  # s after the first touch
    impacts: int  # that the answer must go through


def read_problems(folder):
    """The problems of the benchmark in `folder` that engines are run on, by their names."""
    last = {}
    with (folder / "truth.csv").open(encoding="utf-8") as lines:
        for row in csv.DictReader(line for line in lines if not line.startswith("#")):
            last[row["problem"]] = max(last.get(row["problem"], 0.0), float(row["t"]))
    problems = (read_problem(path, last) for path in sorted((folder / "problems").glob("*.toml")) if path.stem not in LATER)
    return {problem.id: problem for problem in problems}


def read_problem(path, last_impact):
    """`last_impact`: time of each problem's last impact, for problems that do not say until when they go on."""
    data = tomllib.loads(Path(path).read_text(encoding="utf-8"))
    problem, drop, body = data["problem"], data["drop"], data["body"]
    shape, size, inertia = shape_of(body)
    attitude = tuple(drop["attitude"]) if "attitude" in drop else planar_attitude(drop["angle_deg"])
    norm = math.hypot(*attitude)
    speed = drop.get("speed", 1.0)
    return Problem(
        id=problem["id"], compliant=problem["class"] == "compliant", space="attitude" in drop, shape=shape, size=size,
        mass=body["mass"], inertia=inertia, restitution=data["impact"]["restitution"],
        friction=data["impact"].get("friction", 0.0), gravity=data["world"]["gravity"], ground=data.get("ground", {}),
        attitude=tuple(q / norm for q in attitude),
        velocity=tuple(drop.get("velocity", (drop.get("tangential_velocity", 0.0), 0.0, -speed))),
        spin=tuple(drop.get("angular_velocity", (0.0, drop.get("spin", 0.0), 0.0))),
        impacts=LONG_RUN if problem.get("energy_alone") else data["run"]["impacts"] + 1, cylinder=body.get("radius", 0.0), gaps=tuple(problem["gaps"]), until=problem.get("until") or last_impact[problem["id"]] + AFTER_THE_LAST)


def shape_of(body):
    """Shape, extents and principal moments.  In its plane a rod with a radius, a cylinder, touches as a box does."""
    mass = body["mass"]
    if body["shape"] == "box":
        length, width, height = size = tuple(body["size"])
        inertia = tuple(mass * (a * a + b * b) / 12 for a, b in ((width, height), (length, height), (length, width)))
        return "box", size, inertia
    length, radius = body["length"], body.get("radius", 0.0)
    across = mass * (3 * radius**2 + length**2) / 12
    along = mass * radius**2 / 2 or SLENDER_INERTIA * across
    return "box" if radius else "rod", (length, 2 * radius, 2 * radius), (along, across, across)


def planar_attitude(angle_deg):
    """End a, on the left, is low: the body is turned counter-clockwise on the page, about -y."""
    half = math.radians(angle_deg) / 2
    return (math.cos(half), 0.0, -math.sin(half), 0.0)


def rotated(q, v):
    """`v` in body axes, in world axes."""
    w, axis = q[0], q[1:]
    once = cross(axis, v)
    twice = cross(axis, once)
    return tuple(v[i] + 2 * (w * once[i] + twice[i]) for i in range(3))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def lowest(problem, attitude):
    """Height of the body's lowest point below its centre of mass."""
    half = [extent / 2 for extent in problem.size]
    axes = (rotated(attitude, axis) for axis in ((1, 0, 0), (0, 1, 0), (0, 0, 1)))
    return sum(abs(axis[2]) * extent for axis, extent in zip(axes, half))


def turned_back(problem, duration):
    """Attitude and angular velocity (world) that long before the touch: the body turns freely."""
    attitude = problem.attitude
    inverse = (attitude[0], *(-part for part in attitude[1:]))
    state = (*attitude, *rotated(inverse, problem.spin))
    if not any(problem.spin):
        return attitude, problem.spin
    step = -duration / TURNING_STEPS
    for _ in range(TURNING_STEPS):
        state = runge_kutta(lambda s: turning_rates(problem.inertia, s), state, step)
    norm = math.hypot(*state[:4])
    attitude = tuple(part / norm for part in state[:4])
    return attitude, rotated(attitude, state[4:])


def turning_rates(inertia, state):
    """Euler's equations and those of the Euler parameters, with angular velocity in body axes."""
    (q0, q1, q2, q3), (x, y, z) = state[:4], state[4:]
    return ((-q1 * x - q2 * y - q3 * z) / 2, (q0 * x + q2 * z - q3 * y) / 2, (q0 * y - q1 * z + q3 * x) / 2,
            (q0 * z + q1 * y - q2 * x) / 2, (inertia[1] - inertia[2]) * y * z / inertia[0],
            (inertia[2] - inertia[0]) * z * x / inertia[1], (inertia[0] - inertia[1]) * x * y / inertia[2])


def runge_kutta(rates, state, step):
    def moved(slope, part):
        return tuple(s + part * step * k for s, k in zip(state, slope))
    k1 = rates(state)
    k2 = rates(moved(k1, 0.5))
    k3 = rates(moved(k2, 0.5))
    k4 = rates(moved(k3, 1.0))
    return tuple(s + step * (a + 2 * b + 2 * c + d) / 6 for s, a, b, c, d in zip(state, k1, k2, k3, k4))


def height_before(problem, time):
    """Of the body's lowest point, that long before the touch."""
    attitude, _ = turned_back(problem, time)
    rise = -problem.velocity[2] * time - problem.gravity * time**2 / 2
    return lowest(problem, problem.attitude) + rise - lowest(problem, attitude)


def time_before(problem, gap):
    """How long before the touch the lowest point is `gap` high: by Newton's method with the centre's speed."""
    time = 0.0
    for _ in range(60):
        missing = gap - height_before(problem, time)
        time += missing / (-problem.velocity[2] - problem.gravity * time)
        if abs(missing) <= 1e-16:
            break
    return time


def flat_numbers(problem, gap, step, settings, output):
    """The line that an adapter reads."""
    time = time_before(problem, gap)
    attitude, spin = turned_back(problem, time)
    radius = ROD_RADIUS * problem.size[0] if problem.shape == "rod" else 0.0
    velocity = (problem.velocity[0], problem.velocity[1], problem.velocity[2] + problem.gravity * time)
    position = (-velocity[0] * time, -velocity[1] * time, lowest(problem, attitude) + gap + radius)
    numbers = {
        "problem": problem.id, "shape": problem.shape, "length": problem.size[0], "width": problem.size[1],
        "height": problem.size[2], "radius": radius, "mass": problem.mass, "inertia": problem.inertia,
        "restitution": problem.restitution, "friction": problem.friction, "gravity": problem.gravity,
        "position": position, "attitude": attitude, "velocity": velocity, "angular_velocity": spin,
        "cylinder": problem.cylinder, "stiffness": problem.ground.get("stiffness", 0), "damping": problem.ground.get("damping", 0),
        "impacts": problem.impacts, "space": int(problem.space), "start": 0, "duration": time + problem.until + STEPS_AFTER_THE_END * step,
        "step": step, "settings": settings, "output": output}
    return " ".join(f"{key}={as_text(value)}" for key, value in numbers.items())


def as_text(value):
    return ",".join(map(repr, value)) if isinstance(value, tuple) else str(value)
