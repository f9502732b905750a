# SPDX-License-Identifier: GPL-3.0-or-later
"""Faults planted in codes for every rigid problem: none passes that changes the motion, and none gets a wrong name."""
import functools
import math
import os
import random
import unittest

import numpy as np

from exact_motion import Asked, product, rotated, scored, told, turned_back
from rigid_code import RigidCode, struck

RIGID = [problem["id"] for problem in told("benchmark", "list")["problems"]]
RIGID = [problem for problem in RIGID if problem not in ("phone-damped", "long")]  # no impulses; too many impacts
RADIAN = math.pi / 180
ALL = os.environ.get("CLATTER_PLANTED") == "all"  # every fault in every problem; otherwise every fourth pair


def numbers(**factors):
    def plant(code):
        for name, factor in factors.items():
            setattr(code, name, getattr(code, name) * factor)
        code.along *= factors.get("gravity", 1)
    return plant


def sloped(turn):
    """Gravity in another direction: (along, towards the ground) of those asked for."""
    def plant(code):
        if code.along:
            code.along, code.gravity = turn(code.along, code.gravity)
    return plant


def method(**replaced):
    def plant(code):
        for name, function in replaced.items():
            setattr(code, name, function.__get__(code))
    return plant


def centre_alone(code, state, points):
    return struck(state, [*state.velocity[:2], -code.e * state.velocity[2]], state.omega)


def aimed_by_centre(code, state, arm):
    """The contact gets e times the velocity of the centre of mass."""
    e = code.e
    code.e = e * state.velocity[2] / code.approach(state, arm)
    after = RigidCode.strike_at(code, state, arm)
    code.e = e
    return after


def restitution_of(factor):
    """Another one at each impact."""
    def strike(code, state, points):
        e, code.e = code.e, code.e * factor(code)
        after = RigidCode.strike(code, state, points)
        code.e = e
        return after
    return method(strike=strike)


def slow_stick(code):
    """No restitution below a speed that the slowest impact has."""
    speeds = []

    def watch(code, state, points):
        speeds.append(max(-code.approach(state, arm) for arm in np.array(code.arms(state))[points]))
        return RigidCode.strike(code, state, points)

    probe = RigidCode(code.problem)
    probe.strike = watch.__get__(probe)
    list(probe.states(0.05))
    speeds = speeds[:len(code.truth)]
    limit = 1.01 * min(speeds)

    def strike(code, state, points):
        if max(-code.approach(state, arm) for arm in np.array(code.arms(state))[points]) > limit:
            return RigidCode.strike(code, state, points)
        code.e, code.gone = 0.0, True
        return RigidCode.strike(code, state, points)

    if len(speeds) > 1 and sorted(speeds)[1] > 1.05 * min(speeds) and code.e > 0:
        code.strike = strike.__get__(code)


def damped(linear, angular):
    def fly(code, state, time):
        dt = time - state.time
        out = RigidCode.fly(code, state, time)
        a, b = math.exp(-linear * dt), math.exp(-angular * dt)
        if linear and not state.slides:
            way = (1 - a) / linear
            for k, pull in ((0, code.along), (1, 0.0)):
                out.position[k] = state.position[k] + state.velocity[k] * way + pull * (dt - way) / linear
                out.velocity[k] = state.velocity[k] * a + pull * way
            if not state.rests:
                g = code.gravity / linear
                out.position[2] = state.position[2] + (state.velocity[2] + g) * way - g * dt
                out.velocity[2] = (state.velocity[2] + g) * a - g
        if angular:
            half = RigidCode.fly(code, state, state.time + (1 - b) / angular)
            out.attitude, out.omega = half.attitude, tuple(w * b for w in half.omega)
        return out
    return method(fly=fly)


def late(delay):
    def next_touch(code, state, points, latest):
        touch, points = RigidCode.next_touch(code, state, points, latest)
        return (touch if touch is None else RigidCode.fly(code, touch, touch.time + delay)), points
    return method(next_touch=next_touch)


def at_next_step(code, state, points, latest):
    touch, points = RigidCode.next_touch(code, state, points, latest)
    step = step_of(code)
    return (touch if touch is None else RigidCode.fly(code, touch, step * math.ceil(touch.time / step))), points


def starts(**changes):
    def plant(code):
        for name, change in changes.items():
            setattr(code.state, name, change(getattr(code.state, name)))
    return plant


def turned_start(angle):
    half = angle / 2
    return starts(attitude=lambda q: product((math.cos(half), 0.0, -math.sin(half), 0.0), q))


def missing(code):
    """The last impact but for the first is not noticed."""
    def strike(code, state, points):
        code.gone = code.count + 1 == len(code.truth)
        return state if code.gone else RigidCode.strike(code, state, points)
    if len(code.truth) > 1:
        code.strike = strike.__get__(code)


def times(names, factor):
    return lambda code, rows: [[v * (factor if name in names.split() else 1) for name, v in zip(code.columns(), row)]
                               for row in rows]


def added(name, amount):
    """amount(t) is added to a column."""
    return lambda code, rows: [[v + (amount(row[0]) if one == name else 0) for one, v in zip(code.columns(), row)]
                               for row in rows]


def where(is_planar, edit):
    return lambda code, rows: [edit(row) for row in rows] if code.is_planar == is_planar else rows


def y_up(r):
    half = math.sqrt(0.5)
    return ([r[0], r[1], r[3], -r[2], *product((half, -half, 0, 0), r[4:8]), r[8], r[10], -r[9], r[11], r[13],
             -r[12]])


def exchanged(one, other):
    """Two axes in all vectors and in the Euler parameters' vector, as they stand: of a left-handed world, with the other turn."""
    def edit(row):
        row = row[:]
        for first in (1, 5, 8, 11):
            row[first + one], row[first + other] = row[first + other], row[first + one]
        return row
    return edit


def unturned(code, state, arm):
    """An impact by the numbers of the inertia in body axes, taken for those in world axes."""
    turn = np.array([rotated(state.attitude, axis) for axis in np.eye(3)]).T
    own, code.inertia = code.inertia, turn.T @ code.inertia @ turn
    after = RigidCode.strike_at(code, state, arm)
    code.inertia = own
    return after


def a_row_late(code, rows):
    """Velocities of the row before."""
    first = 4 if code.is_planar else 8
    return [row[:first] + before[first:] for before, row in zip(rows[:1] + rows, rows)]


def truncated(share):
    def edit(code, rows):
        """Ends at a share of the time until the last impact asked for, or the end asked for."""
        if share < 0 and not code.until() or share > 0 and len(code.truth) == 1:
            return rows  # nothing that is asked for is cut off
        last = code.touch + code.truth[-1]["t"] if share > 0 else code.end()
        return [row for row in rows if row[0] <= max(last * abs(share), rows[1][0])]
    return edit


def of_a_corner(code, rows):
    out = []
    for k, row in enumerate(rows):
        state = code.sampled[k]
        arm = code.arms(state)[-1]
        state = struck(state, np.array(state.velocity) + np.cross(state.omega, arm), state.omega)
        state.position = list(np.array(state.position) + arm)
        out.append(code.row(state))
    return out


# name: (the cause that must be told, what is planted in the code, what is done to the rows[, the number that is told with the
# cause: its own, or what the faulty code has])
FAULTS = {
    **{f"e {x} times": ("restitution", numbers(e=x), None, "e") for x in (0.9, 0.7, 1.1)},
    **{f"friction {x} times": ("friction", numbers(friction=x), None, *["friction"][:x < 1]) for x in (0, 0.7, 1.4, 2)},  # where more sticks it does not matter
    **{f"inertia {x} times": ("inertia", numbers(inertia=x), None, x) for x in (1.1, 0.7, 1.5)},
    **{f"levers {x} times": ("lever", numbers(levers=x), None, x) for x in (0.8, 0.95, 1.05)},
    **{f"gravity {x} for 9.81": ("gravity", numbers(gravity=x / 9.81), None, x) for x in (9.7, 1.62)},
    **{f"damping {x} per second": ("damping", damped(x, x), None, x) for x in (0.02, 0.5, 2)},
    **{f"starts {x} times too fast": ("start-speed", starts(velocity=lambda v, x=x: [x * y for y in v]), None, x) for x in (1.01, 0.95)},
    **{f"impacts {x} s late": ("delay", late(x), None, x) for x in (1e-3, 3e-4)},
    **{f"z {x} m too high": ("margin", None, added("z", lambda t, x=x: x), x) for x in (1e-3, -2e-3, 0.1)},
    **{f"velocities {x} times": ("velocity-scale", None, times("vx vy vz", x), x) for x in (1e3, 1.1)},
    "elastic": ("restitution", lambda code: setattr(code, "e", 1.0), None, "e"),
    "linear damping 0.1 per second": ("linear-damping", damped(0.1, 0), None, 0.1),
    "spin is damped by 0.1 per second": ("spin-damping", damped(0, 0.1), None, 0.1),
    "e 0.9 times after the first impact": ("restitution", restitution_of(lambda code: 1 if code.count == 0 else 0.9), None),
    "e 0.85 times at the last impact": ("restitution", restitution_of(lambda code: 0.85 if code.count + 1 == len(code.truth) else 1), None),
    "no restitution at the slowest impact": ("restitution-threshold", slow_stick, None),
    "friction pushes on": ("friction-direction", numbers(friction=-1), None),
    "restitution of the centre alone": ("centre-alone", method(strike=centre_alone), None),
    "e by the velocity of the centre": ("centre-restitution", method(strike_at=aimed_by_centre), None),
    "gravity upwards": ("gravity", numbers(gravity=-1), None),
    "no slope": ("slope", sloped(lambda along, down: (0.0, down)), None),
    "gravity straight to the ground": ("slope", sloped(lambda along, down: (0.0, math.hypot(along, down))), None),
    "slope of the other way": ("slope", sloped(lambda along, down: (-along, down)), None),
    "velocities grow": ("growth", damped(-0.1, -0.1), None),
    "starts turned by 0.2 degrees": ("start-angle", turned_start(0.2 * RADIAN), None),
    "starts with more spin": ("start-spin", starts(omega=lambda w: (w[0], w[1] - 0.05, w[2])), None),
    "impacts at the next step": ("time-step", method(next_touch=at_next_step), None),
    "the last impact is missing": (None, missing, None),
    "z drifts": (None, None, added("z", lambda t: 1e-3 * t)),
    "x drifts": (None, None, added("x", lambda t: 1e-2 * t)),
    "phi clockwise": ("phi-sign", None, times("phi omega", -1)),
    "omega of the other sign": ("omega-sign", None, times("omega wx wy wz", -1)),
    "mirrored": ("left-right", None, where(True, lambda r: [r[0], -r[1], r[2], -r[3], -r[4], r[5], -r[6]])),
    "mirrored in space": ("mirrored", None, where(False, lambda r: [x * s for x, s in zip(r, (1, 1, -1, 1, 1, -1, 1, -1, 1, -1, 1, -1, 1, -1))])),
    "z points down": ("up-down", None, times("z vz", -1)),
    "x and z exchanged": ("exchanged", None, where(True, lambda r: [r[0], r[2], r[1], r[3], r[5], r[4], r[6]])),
    "y points up": ("y-up", None, where(False, y_up)),
    "y points up in the body too": ("y-up", None, where(False, lambda r: [r[0], r[1], r[3], -r[2], r[4], r[5], r[7], -r[6], r[8], r[10],
                                                                          -r[9], r[11], r[13], -r[12]])),
    "y and z exchanged": ("y-up", None, where(False, exchanged(1, 2))),
    "x and y exchanged": ("exchanged", None, where(False, exchanged(0, 1))),
    "inertia does not turn": ("inertia-axes", method(strike_at=unturned), None),
    "phi alone clockwise": ("phi-alone", None, times("phi", -1)),
    "velocities a row late": ("velocity-lag", None, a_row_late),
    "one row is off": ("stray-rows", None, lambda code, rows: [[*row[:1], row[1] + 0.1, *row[2:]] if k == len(rows) // 2 else row
                                                               for k, row in enumerate(rows)]),
    "world to body": ("conjugate", None, times("q1 q2 q3", -1)),
    "scalar last": ("scalar-last", None, where(False, lambda r: r[:4] + r[5:8] + r[4:5] + r[8:])),
    "omega in body axes": ("body-frame", None, where(False, lambda r: r[:11] + list(turned_back(r[4:8], r[11:14])))),
    "phi and omega in degrees": ("degrees", None, times("phi omega", 1 / RADIAN)),
    "phi in degrees": ("degrees", None, times("phi", 1 / RADIAN)),
    "omega in degrees per second": ("degrees", None, times("omega wx wy wz", 1 / RADIAN)),
    "omega in turns per second": ("turns", None, times("omega wx wy wz", 0.5 / math.pi)),
    "lengths in millimetres": ("millimetres", None, times("x y z vx vy vz", 1e3)),
    "lengths in centimetres": ("centimetres", None, times("x y z vx vy vz", 1e2)),
    "lengths in feet": ("feet", None, times("x y z vx vy vz", 1 / 0.3048)),
    "times in milliseconds": ("milliseconds", None, times("t", 1e3)),
    "place and velocity of a corner": ("other-point", None, of_a_corner),
    "cut off before the last impact": ("cut-off", None, truncated(0.9)),
    "cut off before the end": ("cut-off", None, truncated(-0.9)),
}


@functools.lru_cache(maxsize=None)
def spins(problem):
    code = RigidCode(problem)
    return max(abs(w) for state in code.states(step_of(code)) for w in state.omega) > 1e-9


def same_as(name, problem):
    """Names that say the same as the fault's own of this problem."""
    alike = {
        "mirrored": {"phi-sign"},  # a rod that falls straight down is its own mirror image
        "phi clockwise": {"left-right"},
        "restitution of the centre alone": {"friction"},  # where the normal impulse has no lever
        "no restitution at the slowest impact": {"restitution"},  # where no other impact is left
        "friction pushes on": {"friction-ratio"},  # where nothing slips before the impact
        "place and velocity of a corner": {"margin", "lowest-point"},  # of a ball
    }.get(name, set())
    if not spins(problem) and name == "linear damping 0.1 per second":
        alike.add("damping")
    if len(Asked(problem).truth) == 1 and (" late" in name or "next step" in name):
        alike |= {"margin", "delay", "time-step"}  # one impact tells no delay from a depth
    return alike


# What is no fault: it leaves the motion as it is.
FREEDOMS = {
    "time from elsewhere": added("t", lambda t: 5.0),
    "place from elsewhere": added("x", lambda t: -3.0),
    "turns counted on": added("phi", lambda t: 2 * math.pi),
    "other sign of the parameters": times("q0 q1 q2 q3", -1),
}


def step_of(code):
    return min(1 / 500, code.end() / 50)


def faulty(problem, plant=None, edit=None, gap=1):
    code = RigidCode(problem, gap)
    step = step_of(code)
    if plant:
        plant(code)
    code.sampled = list(code.states(step))
    rows = [code.row(state) for state in code.sampled]
    return code, edit(code, rows) if edit else rows


def moved(code, a, b):
    """Whether rows differ, as far as the problem asks, in more than where they begin and how often they have turned."""
    if len(a) != len(b):
        return True
    last = code.truth[-1]["t"]
    asked = code.touch + (last if code.statement["stays"] else code.until() or 1.2 * last)
    count = sum(row[0] < asked for row in b) + 1  # to the first row after the last impact
    a, b = np.array(a[:count]), np.array(b[:count])
    places = 2 if code.is_planar else 3
    a[:, 1:places] -= a[0, 1:places]
    b[:, 1:places] -= b[0, 1:places]
    if not code.points:  # a ball looks the same however it is turned
        a, b = np.delete(a, range(4, 8), 1), np.delete(b, range(4, 8), 1)
    return np.abs(a - b).max() > 1e-7


def is_named(name, problem, found):
    cause = FAULTS[name][0]
    if cause is None:  # told by the finding that the impact is missing or the flight not free
        return not found["causes"] and any("missing" in one or "not free" in one or "drifts" in one for one in found["findings"])
    told = {one["cause"] for one in found["causes"]}
    return bool(told & ({cause} | same_as(name, problem))) or (cause == "cut-off" and found["verdict"] == "incomplete")


class Planted(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scored, cls.codes = {}, {}
        for k, problem in enumerate(RIGID):
            texts, (_, right) = {}, faulty(problem)
            for n, (name, (_, plant, edit, *_)) in enumerate(FAULTS.items()):
                if not ALL and (n + k) % 4 and FAULTS[name][0] != "slope":  # two problems alone have one
                    continue
                code, rows = faulty(problem, plant, edit)
                if moved(code, rows, right):
                    texts[name] = code.text(rows)
                    cls.codes[name, problem] = code
            cls.scored |= {(name, problem): found for name, found in zip(texts, scored(*texts.values()))}

    def test_no_fault_that_changes_the_motion_passes(self):
        self.assertGreaterEqual(len(self.scored), 5 * len(FAULTS))
        for (name, problem), found in self.scored.items():
            with self.subTest(fault=name, problem=problem):
                self.assertNotIn(found["verdict"], ("exact", "sharp"))
                large = found["error"] is None or found["error"] > Asked(problem).statement["tolerances"][3]
                self.assertTrue(not large or found["verdict"] in ("fails", "incomplete"), found)

    def test_a_start_is_not_named_where_it_is_not_all_that_is_wrong(self):
        def soft_and_fast(code):
            numbers(e=0.8)(code)
            starts(velocity=lambda v: [1.05 * x for x in v])(code)

        for also, plant, edit in (("restitution", soft_and_fast, None), ("velocity-scale", None, times("vx vy vz", 1e3))):
            for problem in ("rod-10", "corner", "box"):
                code, rows = faulty(problem, plant, edit)
                with self.subTest(also=also, problem=problem):
                    causes = {one["cause"]: one["value"] for one in scored(code.text(rows))[0]["causes"]}
                    self.assertNotIn("start-speed", causes)
                    if also == "velocity-scale":
                        self.assertEqual(list(causes), [also])
                        self.assertAlmostEqual(causes[also], 1e3, delta=1e-9)

    def test_no_fault_gets_a_wrong_name(self):
        for (name, problem), found in self.scored.items():
            if not found["causes"]:
                continue
            with self.subTest(fault=name, problem=problem):
                told = {one["cause"] for one in found["causes"]}
                self.assertTrue(told & ({FAULTS[name][0]} | same_as(name, problem)), found["causes"])

    def test_the_number_of_a_fault_is_told(self):
        for (name, problem), found in self.scored.items():
            causes = {one["cause"]: one["value"] for one in found["causes"]}
            if len(FAULTS[name]) == 4 and FAULTS[name][0] in causes:
                value = FAULTS[name][3] if not isinstance(FAULTS[name][3], str) else getattr(self.codes[name, problem], FAULTS[name][3])
                with self.subTest(fault=name, problem=problem):
                    self.assertAlmostEqual(causes[FAULTS[name][0]], value, delta=max(1e-6, 2e-3 * abs(value)))

    def test_nine_faults_of_ten_get_their_name(self):
        unnamed = [key for key, found in self.scored.items() if not is_named(*key, found)]
        self.assertLessEqual(len(unnamed), 0.1 * len(self.scored), unnamed)
        for name in FAULTS:
            of_fault = [key for key in self.scored if key[0] == name]
            with self.subTest(name):
                self.assertLess(sum(key in unnamed for key in of_fault), max(len(of_fault), 1))


class Exact(unittest.TestCase):
    def test_two_hundred_answers_are_exact_whatever_their_steps_phase_and_origin(self):
        draw, count = random.Random(7), 0
        for problem in RIGID:
            texts = []
            for _ in range(8):
                code = RigidCode(problem, draw.randrange(4))
                rows = code.rows(step_of(code) * draw.uniform(0.3, 1.5))
                texts.append(code.text(draw.choice(list(FREEDOMS.values()))(code, rows)))
            for found in scored(*texts):
                count += 1
                with self.subTest(problem=problem):
                    self.assertEqual(found["verdict"], "exact", found)
        self.assertGreaterEqual(count, 200)
