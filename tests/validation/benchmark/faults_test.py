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
          "start_error", "impulse_error")


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


def written(problem, *columns, factor=-1.0):
    """Rows with columns in other units or of other signs: 1 x, 2 z, 3 phi, 4 vx, 5 vz, 6 omega."""
    return edited(problem, lambda code, rows: [[v * (factor if k in columns else 1.0) for k, v in enumerate(row)] for row in rows])


def in_body_frame(motion):
    rows = motion.rows(STEP)
    return [r[:11] + list(exact_motion.turned_back(r[4:8], r[11:14])) for r in rows]


def only_fast(threshold):
    """Restitution for contacts above a speed alone; what does not rebound is not followed."""
    def strike(code, state, points, n):
        code.gone = -code.approach(state, points[0]) <= threshold
        e = 0.0 if code.gone else code.e
        return code.apply(state, points[0], *code.impulse(state, points[0], e, code.friction))
    return strike


def scaled_moment(factor):
    def strike(code, state, points, n):
        true, code.moment = code.moment, code.moment * factor
        after = code.apply(state, points[0], *code.impulse(state, points[0], code.e, code.friction))
        code.moment = true
        return after
    return strike


def scaled_lever(factor):
    def strike(code, state, points, n):
        true, code.points = code.points, [(x * factor, z * factor) for x, z in code.points]
        after = code.apply(state, points[0], *code.impulse(state, points[0], code.e, code.friction))
        code.points = true
        return after
    return strike


def every(**values):
    """A list with values of every row changed."""
    def edit(rows):
        for row in rows:
            for key, value in values.items():
                row[key] = value(row[key])
        return rows
    return edit


def other_end(place):
    return {"a": "b", "b": "a"}.get(place, place)


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
    "e = 0.9": ("law_error", lambda: faulty("rod-10", strike=restitution(0.9))),
    "inertia 1.1 times": ("law_error", lambda: faulty("rod-10", strike=scaled_moment(1.1))),
    "inertia 1.25 times": ("law_error", lambda: faulty("rod-1", strike=scaled_moment(1.25))),
    "inertia 0.9 times with friction": ("law_error", lambda: faulty("friction-slip", strike=scaled_moment(0.9), law="newton routh")),
    "levers 0.95 times": ("law_error", lambda: faulty("clatter-08", strike=scaled_lever(0.95))),
    "no restitution below 1 m/s": ("law_error", lambda: faulty("clatter-05", strike=only_fast(1.0), next_touch=gone)),
    "phi and omega clockwise": ("start_error", lambda: written("clatter-08", 3, 6)),
    "omega of the other sign": ("flight_error", lambda: written("rod-45", 6)),
    "z points down": ("start_error", lambda: written("clatter-05", 2, 5)),
    "phi and omega in degrees": ("start_error", lambda: written("rod-45", 3, 6, factor=57.29577951308232)),
    "omega in degrees per second": ("flight_error", lambda: written("rod-10", 6, factor=57.29577951308232)),
    "lengths in millimetres": ("start_error", lambda: written("box", 1, 2, 4, 5, factor=1000.0)),
    "times in milliseconds": ("flight_error", lambda: written("rod-10", 0, factor=1000.0)),
    "omega in body axes": ("start_error", lambda: space("corner", in_body_frame)),
    "Omega of the other sign in a list": ("angular_velocity_error", lambda: listed("rod-10", every(Omega=lambda w: -w))),
    "ends exchanged in a list": ("order", lambda: listed("rod-10", every(place=other_end))),
    "a heavier rod in a list": ("impulse_error", lambda: listed("rod-10", every(Pn=lambda p: 1.1 * p))),
    "an impulse 13 % too large in a list": ("impulse_error", lambda: listed("rod-10", changed(0, Pn=lambda p: 1.13 * p))),
}

# The cause that is named, by its name and its number; a fault that is not here need not be named, and must not be named otherwise.
CAUSES = {
    "e = 0.99": ("restitution", 0.99), "e = 1.01 at the first impact": ("restitution", 1.01),
    "e = 0.99 at the second impact": ("restitution", 0.99), "e = 0.99 at the third impact": ("restitution", 0.99),
    "e = 0.75 for 0.8": ("restitution", 0.75), "e = 0.52 at the third impact": ("restitution", 0.52),
    "inertia 3 % too large": ("inertia", 1.03), "restitution of the centre alone": ("centre-alone", None),
    "end 5 mm short": ("lever", 0.99), "friction 0.29": ("friction", 0.29), "friction 0.32": ("friction", 0.32),
    "friction pushes on": ("friction-ratio", -0.3), "no friction": ("friction", 0.0),
    "sticks beyond Coulomb's bound": ("friction", 0.6), "slips at the bound where it sticks": ("friction-ratio", 0.8),
    "no reversal of slip": ("friction-ratio", -0.3), "friction bounded by weight": ("friction-direction", 0.05),
    "another law than declared": ("law", None), "both ends at once": ("centre-alone", None),
    "the rod as in a mirror": ("phi-sign", None), "impacts 1 ms late": ("delay", 1e-3), "a skin of 1 mm": ("margin", 1e-3),
    "drift of 1e-4": ("damping", 5e-4), "drift of 1e-2": ("damping", 0.02), "spin is damped": ("spin-damping", 0.01),
    "gravity 9.7": ("gravity", 9.7), "starts at 10.1 degrees": ("start-angle", 10.1), "starts with a spin": ("start-spin", 0.05),
    "starts 1 % too fast": ("start-speed", 1.01), "e = 0.9": ("restitution", 0.9), "inertia 1.1 times": ("inertia", 1.1), "inertia 1.25 times": ("inertia", 1.25),
    "inertia 0.9 times with friction": ("inertia", 0.9), "levers 0.95 times": ("lever", 0.95),
    "no restitution below 1 m/s": ("restitution-threshold", None), "phi and omega clockwise": ("phi-sign", None),
    "omega of the other sign": ("omega-sign", None), "z points down": ("up-down", None),
    "phi and omega in degrees": ("degrees", None), "omega in degrees per second": ("degrees", None),
    "lengths in millimetres": ("millimetres", None), "times in milliseconds": ("milliseconds", None),
    "omega in body axes": ("body-frame", None), "Omega of the other sign in a list": ("omega-sign", None),
    "the run stops early": ("cut-off", None),
    "ends exchanged in a list": ("ends-exchanged", None), "a heavier rod in a list": ("mass", 1.1),
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

    def test_sixty_faults_are_planted(self):
        self.assertGreaterEqual(len(FAULTS), 60)

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

    def test_the_cause_of_a_fault_is_named_and_no_other(self):
        """One that is named beside it explains the same numbers as well."""
        named = 0
        for name, file in self.scored.items():
            causes = [(cause["cause"], cause["value"]) for cause in file["causes"]]
            with self.subTest(name):
                wanted = CAUSES.get(name)
                if wanted is None:
                    self.assertEqual(causes, [])
                    continue
                self.assertIn(wanted[0], [cause for cause, _ in causes], file["findings"])
                if wanted[1] is not None:
                    self.assertAlmostEqual(dict(causes)[wanted[0]], wanted[1], delta=max(1e-6, 2e-3 * abs(wanted[1])))
                named += 1
        self.assertGreaterEqual(named, 40)

    def test_no_two_faults_look_the_same(self):
        seen = {}
        for name, file in self.scored.items():
            look = (file["problem"], tuple(file["findings"]),
                    tuple("?" if file[s] is None else f"{file[s]:.2g}" for s in SCORES),
                    tuple(cause["words"] for cause in file["causes"]))
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
                expected = abs(wrong - right) / (1 + max(wrong, right))
                self.assertGreaterEqual(error, expected - 1e-9)
                self.assertLessEqual(error, 1.1 * expected)  # two digits, rounded up

    def test_a_wrong_law_is_found_at_the_impact_that_breaks_it(self):
        for name, place in (("e = 1.01 at the first impact", 0), ("e = 0.99 at the second impact", 1),
                            ("e = 0.99 at the third impact", 2), ("e = 0.52 at the third impact", 2)):
            with self.subTest(name):
                errors = [one["law_error"] for one in self.scored[name]["impact_scores"]]
                self.assertEqual(errors.index(max(errors)), place)
                self.assertLess(sorted(errors)[-2], 1e-9)
