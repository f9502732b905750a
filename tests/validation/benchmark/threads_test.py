# SPDX-License-Identifier: GPL-3.0-or-later
"""The answers of notebooks-data/threads: each is what the behaviour of a thread gives, and gets the verdict of the page.

Run as a program it makes the files anew.
"""
import math
import pathlib
import re
import unittest

import planted_test
from exact_motion import Asked, printed, product, scored
from rigid_code import RigidCode

FOLDER = pathlib.Path(__file__).resolve().parents[3] / "notebooks-data" / "threads"


class Watched(RigidCode):
    """Keeps its impacts."""

    def __init__(self, problem, e=None, friction=None, threshold=0.0):
        super().__init__(problem, 0)
        self.e, self.friction = self.e if e is None else e, self.friction if friction is None else friction
        self.asked, self.threshold, self.impacts = self.e, threshold, []

    def strike(self, state, points):
        speed = max((-self.approach(state, arm) for arm in self.arms(state)), default=0.0)
        self.e, self.gone = (0.0, True) if speed < self.threshold else (self.asked, self.gone)
        after = super().strike(state, points)
        change = [self.mass * (b - a) for a, b in zip(state.velocity, after.velocity)]
        self.impacts.append([state.time - self.touch, *change, *after.velocity, *after.omega])
        return after

    def listed(self, place, *lines):
        """In space; `place` names what strikes."""
        list(self.states(0.05))
        rows = self.impacts[:len(self.truth)]
        head = [f"# problem: {self.problem}", *lines, "t,place,Px,Py,Pz,Vx,Vy,Vz,Wx,Wy,Wz"]
        return "\n".join(head + [",".join([repr(float(row[0])), place] + [repr(float(v)) for v in row[1:]])
                                 for row in rows]) + "\n"


def planar_list(problem, rows, *lines):
    head = [f"# problem: {problem}", *lines, "# Omega: clockwise", "t,place,Pn,Pt,V,Omega"]
    return "\n".join(head + [",".join(map(str, row)) for row in rows]) + "\n"


def one_end_at_a_time():
    """A level rod whose ends are served one after the other: each rebounds from what the other left."""
    rows, velocity, omega = [], -1.5, 0.0
    for place, side in (("a", -1), ("b", 1)):
        approach = velocity - omega * side / 2
        impulse = -2 * approach / (1 + 3)
        velocity, omega = velocity + impulse, omega - side / 2 * 12 * impulse
        rows.append((0.0, place, impulse, 0.0, velocity, omega))
    return planar_list("flat", rows, "# ended: nothing approaches")


def second_end_rests():
    truth = Asked("rod-45").truth
    first, second = ([row[k] for k in ("t", "place", "Pn", "Pt", "V", "Omega")] for row in truth)
    second[2:] = second[2] / 2, 0.0, (first[4] + second[4]) / 2, (first[5] + second[5]) / 2
    return planar_list("rod-45", (first, second), "# ended: nothing approaches")


def more_energy():
    text = printed("benchmark", "truth", "long", "--format", "csv")
    energy = text.split("# energy: ")[1].split()[0]
    return text.replace(energy, repr(1.05 * float(energy)), 1)


def rock_that_rebounds():
    code = Watched("rock", e=0.5)
    list(code.states(1e-3))
    t, px, _, pz, _, _, vz, _, omega, _ = code.impacts[0]
    return planar_list("rock", [(t, "b", pz, px, vz, omega)])


def without_gyroscopic_term():
    def fly(code, state, time):
        out, speed = RigidCode.fly(code, state, time), math.hypot(*state.omega)
        half = speed * (time - state.time) / 2
        turn = (math.cos(half), *(math.sin(half) * w / speed for w in state.omega))
        out.attitude, out.omega = product(turn, state.attitude), state.omega
        return out
    code = RigidCode("tumble", 2)
    code.fly = fly.__get__(code)
    return code.text(code.rows(0.02))


def damped():
    code = RigidCode("rod-10-brisk", 1)
    planted_test.damped(0.1, 0.1)(code)
    return code.text(code.rows(0.005))


REST = "# energy: 0.9810000000000001"
# file: (its text, the cause that is told, what it says)
THREADS = {
    "siconos-125": (one_end_at_a_time, None, "impact 1 (line 5) is at a, must be at both"),
    "newton-1137": (rock_that_rebounds, "restitution", "e = 0.5"),
    "physx-351": (lambda: Watched("ball-rest", threshold=2.0).listed("surface", REST), "restitution", "e = 0 "),
    "reactphysics3d-96": (lambda: Watched("ball-rest", threshold=1.0).listed("surface", REST), "restitution-threshold", "0.75"),
    "rapier-974": (lambda: Watched("ball-rest", e=0.1).listed("surface", REST), "restitution", "e = 0.1"),
    "rapier-98": (second_end_rests, "restitution", "impact 2 alone"),
    "jolt-803": (without_gyroscopic_term, "gyroscopic-term", "gyroscopic"),
    "jolt-1286": (more_energy, None, "energy"),
    "godot-82968": (damped, "damping", "0.100 per second"),
    "mbsim-49": (lambda: Watched("ball-grip", friction=0.0).listed("surface"), "friction", "no friction"),
}


class Threads(unittest.TestCase):
    def test_each_answer_is_what_the_behaviour_gives(self):
        for name, (text, _, _) in THREADS.items():
            with self.subTest(name):
                made, kept = ([float(v) for v in re.findall(r"(?<![\w.])-?\d[\d.]*(?:e-?\d+)?(?=[,\n])", re.sub("(?m)^#.*", "", one))]
                              for one in (text(), (FOLDER / f"{name}.csv").read_text()))
                self.assertGreater(len(kept), 4)
                for x, y in zip(made, kept, strict=True):
                    self.assertAlmostEqual(x, y, delta=1e-9 * max(1, abs(y)))

    def test_each_answer_gets_the_name_of_its_fault(self):
        for name, (_, cause, words) in THREADS.items():
            with self.subTest(name):
                found = scored((FOLDER / f"{name}.csv").read_text())[0]
                self.assertEqual(found["verdict"], "fails")
                self.assertEqual([one["cause"] for one in found["causes"]][:1], [cause] if cause else [])
                self.assertIn(words, " ".join([one["words"] for one in found["causes"]] + found["findings"]))


if __name__ == "__main__":
    for name, (text, _, _) in THREADS.items():
        (FOLDER / f"{name}.csv").write_text(text())
