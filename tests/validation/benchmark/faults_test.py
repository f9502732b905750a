#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Planted faults: each is found by the score that should find it, and no two look the same."""
import json
import pathlib
import tempfile
import unittest

import exact_motion
from planar_code import Code

STEP = 1 / 500
SCORES = ("law_error", "velocity_error", "angular_velocity_error", "time_error", "energy_error", "flight_error",
          "start_error")


def faulty(problem, law=None, **replaced):
    """A code in which methods are replaced: each takes the code and what the method takes."""
    code = Code(problem, 1, law)
    for name, value in replaced.items():
        setattr(code, name, value.__get__(code) if callable(value) else value)
    return code.text(code.rows(STEP))


def restitution(value, only=None):
    """Another restitution, at one impact or at all."""
    def strike(code, state, points, n):
        e = value if only in (None, n + 1) else code.e
        return code.apply(state, points[0], *code.impulse(state, points[0], e, code.friction))
    return strike


def ratio(value):
    return lambda code, state, points, n: code.apply(state, points[0],
                                                     *code.impulse(state, points[0], code.e, value))


def centre_only(code, state, points, n):
    """Restitution acts on the velocity of the centre of mass alone."""
    return state[:5] + [-code.e * state[5], state[6]]


def heavy(code, state, points, n):
    """The impulse for a moment of inertia 3 % too large, and its effect, too."""
    true, code.moment = code.moment, code.moment * 1.03
    after = code.apply(state, points[0], *code.impulse(state, points[0], code.e, 0))
    code.moment = true
    return after


def short_lever(code, state, points, n):
    """The end is 5 mm short."""
    true, code.points = code.points, [(x * 0.99, z) for x, z in code.points]
    after = code.apply(state, points[0], *code.impulse(state, points[0], code.e, 0))
    code.points = true
    return after


def passes_through(n_missing):
    def strike(code, state, points, n):
        if n + 1 == n_missing:
            code.gone = True
            return state
        return Code.strike(code, state, points, n)
    return strike


def gone(code, state, struck, latest):
    return (None, []) if getattr(code, "gone", False) else Code.next_touch(code, state, struck, latest)


def merges(code, state, points, n):
    """Both ends at once, as a flat landing."""
    code.gone = True
    return state[:5] + [-state[5], 0.0]


def edited(problem, edit, law=None):
    code = Code(problem, 1, law)
    return code.text(edit(code, code.rows(STEP)))


def thrown_down(at, impulse):
    """An impact more, at the high end, in the air or not."""
    def edit(code, rows):
        out, change = [], None
        for row in rows:
            if row[0] > code.touch + at and change is None:
                struck = code.apply(row, len(code.points) - 1, impulse, 0.0)
                change = struck
            out.append(row if change is None else code.fly(change, row[0] - change[0]))
        return out
    return edit


def decays(rate):
    """Velocities that shrink by exp(-rate t), with the way that belongs to them."""
    import math

    def fly(code, state, dt):
        t, x, z, phi, vx, vz, w = state
        f = math.exp(-rate * dt)
        way = (1 - f) / rate
        return [t + dt, x + vx * way, z + vz * way, phi + w * way, vx * f, vz * f, w * f]
    return fly


def spin_decays(rate):
    import math

    def fly(code, state, dt):
        out = Code.fly(code, state, dt)
        out[6] = state[6] * math.exp(-rate * dt)
        return out
    return fly


def listed(problem, edit, law=None):
    """The truth as a list of impacts, changed."""
    rows = exact_motion.told("benchmark", "truth", problem, *(["--law", law] if law else []))["impacts"]
    rows = edit([{k: row[k] for k in ("t", "place", "Pn", "Pt", "V", "Omega")} for row in rows])
    head = ["# Omega: clockwise", "# ended: nothing approaches", "t,place,Pn,Pt,V,Omega"]
    lines = [f"# problem: {problem}"] + ([f"# law: {law}"] if law else []) + head
    return "\n".join(lines + [",".join(str(v) for v in row.values()) for row in rows]) + "\n"


def changed(index, **values):
    def edit(rows):
        for key, value in values.items():
            rows[index][key] = value(rows[index][key]) if callable(value) else value
        return rows
    return edit


def moved(column, amount, after):
    """A column moved from some time after the first touch on."""
    def edit(code, rows):
        return [[v + (amount if k == column and row[0] > code.touch + after else 0.0) for k, v in enumerate(row)]
                for row in rows]
    return edit


def start(**values):
    def edit(code):
        for key, value in values.items():
            code.state[int(key[1:])] = value(code.state[int(key[1:])])
        return code.text(code.rows(STEP))
    return edit


def started(problem, **values):
    return start(**values)(Code(problem, 1))


def late(code, state, struck, latest):
    """Every impact is noticed 1 ms late."""
    flight, points = Code.next_touch(code, state, struck, latest)
    return (flight if flight is None else flight + 1e-3), points


def space(problem, spoil):
    motion = exact_motion.Motion(problem, 1)
    return motion.text(spoil(motion))


def no_gyroscopic_term(motion):
    rows = motion.rows(STEP)
    first = [r for r in rows if r[0] < motion.touch + motion.truth["impacts"][1]["t"] and r[0] > motion.touch][0]
    return [r[:11] + first[11:] if first[0] <= r[0] < motion.touch + motion.truth["impacts"][1]["t"] else r
            for r in rows]


def turned_by(axis, factor):
    def spoil(motion):
        rows = motion.rows(STEP)
        strike = motion.touch + motion.truth["impacts"][1]["t"]
        return [[v * (factor if k == axis and r[0] > strike else 1.0) for k, v in enumerate(r)] for r in rows]
    return spoil


def ground_mirror(code, rows):
    return [[r[0], -r[1], r[2], -r[3], -r[4], r[5], -r[6]] for r in rows]


def no_gravity(code, state, dt):
    t, x, z, phi, vx, vz, w = state
    return [t + dt, x + vx * dt, z + vz * dt, phi + w * dt, vx, vz, w]


def weak_gravity(code, state, dt):
    true, code.gravity = code.gravity, 9.7
    after = Code.fly(code, state, dt)
    code.gravity = true
    return after


# What is planted, and the score that must find it: "order", or the name of an error.
FAULTS = {
    "e = 0.99": ("law_error", lambda: faulty("rod-10", strike=restitution(0.99))),
    "e = 1.01 at the first impact": ("law_error", lambda: faulty("rod-10", strike=restitution(1.01, 1))),
    "e = 0.99 at the second impact": ("law_error", lambda: faulty("rod-10", strike=restitution(0.99, 2))),
    "e = 0.99 at the third impact": ("law_error", lambda: faulty("rod-10", strike=restitution(0.99, 3))),
    "e = 0.75 for 0.8": ("law_error", lambda: faulty("clatter-08", strike=restitution(0.75))),
    "e = 0.52 at the third impact": ("law_error", lambda: faulty("clatter-05", strike=restitution(0.52, 3))),
    "inertia 3 % too large": ("law_error", lambda: faulty("rod-45", strike=heavy)),
    "restitution of the centre alone": ("law_error", lambda: faulty("rod-10-half", strike=centre_only)),
    "end 5 mm short": ("law_error", lambda: faulty("rod-10-fast", strike=short_lever)),
    "friction 0.29": ("law_error", lambda: faulty("friction-slip", strike=ratio(0.29))),
    "friction 0.32": ("law_error", lambda: faulty("friction-slip", strike=ratio(0.32))),
    "friction pushes on": ("law_error", lambda: faulty("friction-slip", strike=ratio(-0.3))),
    "no friction": ("law_error", lambda: faulty("friction-slip", strike=ratio(0.0))),
    "sticks beyond Coulomb's bound": ("law_error", lambda: faulty("friction-slip", strike=ratio(0.6))),
    "slips at the bound where it sticks": ("law_error", lambda: faulty("friction-stick", strike=ratio(0.8))),
    "no reversal of slip": ("law_error", lambda: faulty("friction-reversal", strike=ratio(-0.3))),
    "friction bounded by weight": ("law_error", lambda: faulty("friction-slip-stick", strike=ratio(0.05))),
    "another law than declared": ("law_error", lambda: listed("friction-reversal", lambda rows: rows, "poisson routh")
                                  .replace("# law: poisson routh", "# law: stronge routh")),
    "tangential impulse against Coulomb in a list":
        ("law_error", lambda: listed("friction-slip", changed(0, Pt=0.5), "newton routh")),
    "swapped end at the first impact": ("order", lambda: listed("rod-10", changed(0, place="b"))),
    "swapped end at the third impact": ("order", lambda: listed("rod-10", changed(2, place="b"))),
    "the second impact is not in the list": ("order", lambda: listed("rod-10", lambda rows: [rows[0], rows[2]])),
    "the rod as in a mirror": ("order", lambda: edited("rod-10", ground_mirror)),
    "the second impact is missing": ("order", lambda: faulty("rod-10", strike=passes_through(2), next_touch=gone)),
    "the third impact is missing": ("order", lambda: faulty("rod-10", strike=passes_through(3), next_touch=gone)),
    "the grazing impact is missing":
        ("order", lambda: faulty("fold-2-below", strike=passes_through(2), next_touch=gone)),
    "an impact that should miss": ("order", lambda: edited("fold-2-above", thrown_down(0.44, 0.05))),
    "both ends at once": ("order", lambda: faulty("rod-1", strike=merges, next_touch=gone)),
    "the run stops early": ("order", lambda: edited("rod-45", lambda code, rows: rows[:len(rows) // 3])),
    "impacts 1 ms late": ("time_error", lambda: faulty("rod-10", next_touch=late)),
    "second impact 0.1 ms late in a list":
        ("time_error", lambda: listed("rod-10", changed(1, t=lambda t: t + 1.5e-4))),
    "a skin of 1 mm": ("time_error", lambda: edited("rod-10-half", lambda code, rows: [
        r[:2] + [r[2] + 1e-3] + r[3:] for r in rows])),
    "drift of 1e-4": ("energy_error", lambda: faulty("rod-10", fly=decays(5e-4))),
    "drift of 1e-2": ("energy_error", lambda: faulty("rod-10", fly=decays(0.02))),
    "spin is damped": ("energy_error", lambda: faulty("rod-10-slow", fly=spin_decays(0.01))),
    "gravity 9.7": ("energy_error", lambda: faulty("box", fly=weak_gravity)),
    "V 1e-3 too large after the second impact in a list":
        ("velocity_error", lambda: listed("rod-45", changed(1, V=lambda v: v + 2e-3))),
    "pushed up by 1 mm in flight": ("flight_error", lambda: edited("rod-10", moved(2, 1e-3, 0.02))),
    "turned by 1 mrad in flight": ("flight_error", lambda: edited("rod-45", moved(3, 1e-3, 0.1))),
    "no gyroscopic term": ("energy_error", lambda: space("corner", no_gyroscopic_term)),
    "spin about z kept too large": ("law_error", lambda: space("corner", turned_by(13, 1.2))),
    "starts at 10.1 degrees": ("start_error", lambda: started("rod-10", _3=lambda phi: phi * 1.01)),
    "starts with a spin": ("start_error", lambda: started("rod-10", _6=lambda w: w + 0.05)),
    "starts 1 % too fast": ("start_error", lambda: started("rod-10", _5=lambda v: v * 1.01)),
}

# Faults so small that a class of tolerance may pass them are found by the exact one.
SMALL = {"drift of 1e-4": 1e-4}


class PlantedFaults(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        cls.scored = {}
        for name, (_, make) in FAULTS.items():
            path = cls.folder / "run.csv"
            path.write_text(make())
            done = exact_motion.run("benchmark", "score", str(path), "--format", "json")
            assert done.returncode == 0, (name, done.stderr)
            cls.scored[name] = json.loads(done.stdout)["files"][0]

    def test_forty_faults_are_planted(self):
        self.assertGreaterEqual(len(FAULTS), 40)

    def test_each_fault_is_found_by_the_score_that_should_find_it(self):
        for name, (score, _) in FAULTS.items():
            with self.subTest(name):
                file = self.scored[name]
                if score == "order":
                    self.assertFalse(file["order_right"], file)
                    continue
                error = file[score]
                self.assertTrue(error is None or error > SMALL.get(name, 2e-4), (score, file))

    def test_no_fault_is_taken_for_exact_or_sharp(self):
        for name, file in self.scored.items():
            with self.subTest(name):
                self.assertNotIn(file["verdict"], ("exact",) if name in SMALL else ("exact", "sharp"))

    def test_each_fault_is_named_in_words(self):
        for name, file in self.scored.items():
            with self.subTest(name):
                self.assertTrue(file["findings"])

    def test_no_two_faults_look_the_same(self):
        seen = {}
        for name, file in self.scored.items():
            look = (file["problem"], tuple(file["findings"]),
                    tuple("?" if file[s] is None else f"{file[s]:.2g}" for s in SCORES))
            self.assertNotIn(look, seen, f"{name} looks like {seen.get(look)}")
            seen[look] = name

    def test_the_same_code_without_a_fault_is_exact(self):
        for problem in ("rod-10", "rod-45", "clatter-05", "clatter-08", "friction-slip", "fold-2-below", "rod-1", "box",
                        "flat"):
            with self.subTest(problem):
                path = self.folder / "run.csv"
                code = Code(problem, 1, "newton routh" if problem == "friction-slip" else None)
                path.write_text(code.text(code.rows(STEP)))
                done = exact_motion.run("benchmark", "score", str(path), "--require", "exact")
                self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def test_an_error_of_restitution_is_measured_as_such_where_the_instant_is_resolved(self):
        # An impulse (1 + e') P in place of (1 + e) P errs by their difference over the larger, gravity or not.
        for name, n, wrong, right in (("e = 0.52 at the third impact", 3, 0.52, 0.5), ("e = 0.75 for 0.8", 1, 0.75, 0.8),
                                      ("e = 0.99 at the second impact", 2, 0.99, 1.0)):
            with self.subTest(name):
                error = self.scored[name]["impact_scores"][n - 1]["law_error"]
                self.assertAlmostEqual(error, abs(wrong - right) / (1 + max(wrong, right)), delta=1e-9)

    def test_a_wrong_law_is_found_at_the_impact_that_breaks_it(self):
        for name, place in (("e = 1.01 at the first impact", 0), ("e = 0.99 at the second impact", 1),
                            ("e = 0.99 at the third impact", 2), ("e = 0.52 at the third impact", 2)):
            with self.subTest(name):
                errors = [one["law_error"] for one in self.scored[name]["impact_scores"]]
                self.assertEqual(errors.index(max(errors)), place)
                self.assertLess(sorted(errors)[-2], 1e-9)


if __name__ == "__main__":
    unittest.main()
