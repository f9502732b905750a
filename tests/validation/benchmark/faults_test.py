# SPDX-License-Identifier: GPL-3.0-or-later
"""Small faults, faults in lists and in the order of impacts: each is found by the score that should find it, with its cause and
number, and no two look the same.  What is planted in every problem is in planted_test.py."""

import unittest

from exact_motion import Motion, answered, json, scored
from planar_code import Code

STEP = 1 / 500
SCORES = ("law_error", "velocity_error", "angular_velocity_error", "time_error", "energy_error", "flight_error", "start_error",
          "impulse_error")


def faulty(problem, law=None, edit=lambda code, rows: rows, **replaced):
    """A code in which methods are replaced: each takes the code and what the method takes."""
    code = Code(problem, 1, law)
    for name, value in replaced.items():
        setattr(code, name, value.__get__(code))
    return code.text(edit(code, code.rows(STEP)))


def restitution(value, only=None):
    """Another restitution, at one impact or at all."""
    def strike(code, state, points, n):
        e = value if only in (None, n + 1) else code.e
        return code.apply(state, points[0], *code.impulse(state, points[0], e, code.friction))
    return strike


def ratio(value):
    return lambda code, state, points, n: code.apply(state, points[0], *code.impulse(state, points[0], code.e, value))


def thrown_down(at, impulse):
    """An impact more, at the high end, in the air or not."""
    def edit(code, rows):
        out, change = [], None
        for row in rows:
            if row[0] > code.touch + at and change is None:
                change = code.apply(row, len(code.points) - 1, impulse, 0.0)
            out.append(row if change is None else code.fly(change, row[0] - change[0]))
        return out
    return edit


def spun_up():
    """The spin about z kept too large after the second impact of a box in space."""
    motion = Motion("corner", 1)
    strike = motion.touch + motion.truth[1]["t"]
    return motion.text([[v * (1.2 if k == 13 and r[0] > strike else 1.0) for k, v in enumerate(r)] for r in motion.rows(STEP)])


def listed(problem, edit=lambda rows: rows, law=None):
    """The truth as a list of impacts, changed."""
    rows = json.loads(answered("truth", problem, *(["--law", law] if law else [])))["impacts"]
    rows = edit([{k: row[k] for k in ("t", "place", "Pn", "Pt", "V", "Omega")} for row in rows])
    head = [f"# problem: {problem}"] + ([f"# law: {law}"] if law else []) + ["# Omega: clockwise", "# ended: nothing approaches"]
    return "\n".join([*head, "t,place,Pn,Pt,V,Omega"] + [",".join(str(v) for v in row.values()) for row in rows]) + "\n"


def changed(key, value, *indices):
    """Of the rows with these indices, or of all, one value."""
    return lambda rows: [row | {key: value(row[key])} if not indices or n in indices else row for n, row in enumerate(rows)]


def other_end(place):
    return {"a": "b", "b": "a"}.get(place, place)


# What is planted, the score that must find it ("order", or the name of an error), and the cause that is named, with its
# number; none need be named without, and must not be named otherwise.
FAULTS = {
    "e = 0.99": (lambda: faulty("rod-10", strike=restitution(0.99)), "law_error", "restitution", 0.99),
    "e = 1.01 at the first impact": (lambda: faulty("rod-10", strike=restitution(1.01, 1)), "law_error", "restitution", 1.01),
    "e = 0.99 at the second impact": (lambda: faulty("rod-10", strike=restitution(0.99, 2)), "law_error", "restitution", 0.99),
    "e = 0.99 at the third impact": (lambda: faulty("rod-10", strike=restitution(0.99, 3)), "law_error", "restitution", 0.99),
    "e = 0.52 at the third impact": (lambda: faulty("clatter-05", strike=restitution(0.52, 3)), "law_error", "restitution", 0.52),
    "sticks beyond Coulomb's bound": (lambda: faulty("friction-slip", strike=ratio(0.6)), "law_error", "friction", 0.6),
    "slips at the bound where it sticks": (lambda: faulty("friction-stick", strike=ratio(0.8)), "law_error", "friction-ratio", 0.8),
    "no reversal of slip": (lambda: faulty("friction-reversal", strike=ratio(-0.3)), "law_error", "friction-ratio", -0.3),
    "friction bounded by weight": (lambda: faulty("friction-slip-stick", strike=ratio(0.05)), "law_error", "friction-direction", 0.05),
    "another law than declared": (lambda: listed("friction-reversal", law="poisson routh").replace("# law: poisson", "# law: stronge"),
                                  "law_error", "law", None),
    "tangential impulse against Coulomb in a list": (lambda: listed("friction-slip", changed("Pt", lambda p: 0.5, 0), "newton routh"), "law_error"),
    "swapped end at the first impact": (lambda: listed("rod-10", changed("place", other_end, 0)), "order"),
    "swapped end at the third impact": (lambda: listed("rod-10", changed("place", other_end, 2)), "order"),
    "ends exchanged in a list": (lambda: listed("rod-10", changed("place", other_end)), "order", "ends-exchanged", None),
    "the second impact is not in the list": (lambda: listed("rod-10", lambda rows: [rows[0], rows[2]]), "order"),
    "an impact that should miss": (lambda: faulty("fold-2-above", edit=thrown_down(0.44, 0.05)), "order"),
    "second impact 0.15 ms late in a list": (lambda: listed("rod-10", changed("t", lambda t: t + 1.5e-4, 1)), "time_error"),
    "V 2e-3 too large after the second impact in a list": (lambda: listed("rod-45", changed("V", lambda v: v + 2e-3, 1)), "velocity_error"),
    "Omega of the other sign in a list": (lambda: listed("rod-10", changed("Omega", lambda w: -w)), "angular_velocity_error", "omega-sign", None),
    "omega of the other sign": (lambda: faulty("rod-45", edit=lambda code, rows: [[*row[:6], -row[6]] for row in rows]), "flight_error",
                                "omega-sign", None),
    "spin about z kept too large": (spun_up, "law_error"),
    "a heavier rod in a list": (lambda: listed("rod-10", changed("Pn", lambda p: 1.1 * p)), "impulse_error", "mass", 1.1),
    "an impulse 13 % too large in a list": (lambda: listed("rod-10", changed("Pn", lambda p: 1.13 * p, 0)), "impulse_error"),
}


class PlantedFaults(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scored = dict(zip(FAULTS, scored(*(make() for make, *_ in FAULTS.values()))))

    def test_each_fault_is_found_by_the_score_that_should_find_it_and_told_in_words(self):
        for name, (_, score, *_) in FAULTS.items():
            with self.subTest(name):
                file = self.scored[name]
                self.assertNotIn(file["verdict"], ("exact", "sharp"))
                self.assertTrue(file["findings"])
                if score == "order":
                    self.assertFalse(file["order_right"], file)
                else:
                    self.assertTrue(file[score] is None or file[score] > 2e-4, (score, file))

    def test_the_cause_of_a_fault_is_named_and_no_other(self):
        """One that is named beside it explains the same numbers as well."""
        for name, (_, _, *wanted) in FAULTS.items():
            causes = {cause["cause"]: cause["value"] for cause in self.scored[name]["causes"]}
            with self.subTest(name):
                if not wanted:
                    self.assertEqual(causes, {})
                    continue
                self.assertIn(wanted[0], causes, self.scored[name]["findings"])
                if wanted[1] is not None:
                    self.assertAlmostEqual(causes[wanted[0]], wanted[1], delta=max(1e-6, 2e-3 * abs(wanted[1])))

    def test_no_two_faults_look_the_same(self):
        seen = {}
        for name, file in self.scored.items():
            look = (file["problem"], tuple(file["findings"]), tuple("?" if file[s] is None else f"{file[s]:.2g}" for s in SCORES),
                    tuple(cause["words"] for cause in file["causes"]))
            self.assertNotIn(look, seen, f"{name} looks like {seen.get(look)}")
            seen[look] = name

    def test_an_error_of_restitution_is_measured_as_such_at_the_impact_that_breaks_the_law(self):
        # An impulse (1 + e') P in place of (1 + e) P errs by their difference over the larger, gravity or not.
        for name, n, wrong, right in (("e = 0.52 at the third impact", 3, 0.52, 0.5), ("e = 0.99 at the second impact", 2, 0.99, 1.0),
                                      ("e = 1.01 at the first impact", 1, 1.01, 1.0), ("e = 0.99 at the third impact", 3, 0.99, 1.0)):
            with self.subTest(name):
                errors = [one["law_error"] for one in self.scored[name]["impact_scores"]]
                expected = abs(wrong - right) / (1 + max(wrong, right))
                self.assertGreaterEqual(errors[n - 1], expected - 1e-9)
                self.assertLessEqual(errors[n - 1], 1.1 * expected)  # two digits, rounded up
                self.assertLess(max(errors[:n - 1] + errors[n:], default=0), 1e-9)
