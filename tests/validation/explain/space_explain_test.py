# SPDX-License-Identifier: GPL-3.0-or-later
"""clatter explain of a drop in space: each number that it shows against laws of mechanics put into numbers here."""

import math
import random
import unittest

from space_folder import CENTRE, INERTIA, MASS, SIZE, SpaceFolder, box_moments, cross, product, rotated, times, words

PHONE = ["--body", "box", "--size", "x".join(map(str, SIZE)), "--mass", str(MASS)]
CORNER = [*PHONE, "--angle", "40", "--tilt", "25"]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def inverse(q):
    return (q[0], -q[1], -q[2], -q[3])


def arithmetic_geometric_mean(a, b):
    while abs(a - b) > 1e-15 * a:
        a, b = (a + b) / 2, math.sqrt(a * b)
    return a


def solved(tensor, b):
    """x of T x = b, T given by xx, yy, zz, xy, xz, yz."""
    columns = [times(tensor, [float(i == k) for i in range(3)]) for k in range(3)]
    whole = dot(columns[0], cross(columns[1], columns[2]))
    return [dot(b if k == 0 else columns[0], cross(b if k == 1 else columns[1], b if k == 2 else columns[2])) / whole for k in range(3)]


def contact_inertia(q, arm, tensor):
    """1/m − [r]× I⁻¹ [r]×, column by column: what unit impulses at r do to the velocity there."""
    def velocity(k):
        push = [float(i == k) for i in range(3)]
        turn = rotated(q, solved(tensor, rotated(inverse(q), cross(arm, push))))
        return [p / MASS + t for p, t in zip(push, cross(turn, arm))]

    return [velocity(k) for k in range(3)]


class Path:
    """Coulomb's law along the normal impulse, by small steps of a fourth-order rule."""

    def __init__(self, w, mu):
        self.w, self.mu = w, mu

    def rate(self, v):
        slip = math.hypot(v[0], v[1])
        s = (v[0] / slip, v[1] / slip)
        return [self.w[2][i] - self.mu * (self.w[0][i] * s[0] + self.w[1][i] * s[1]) for i in range(3)]

    def turning(self, angle):
        """(f, g, h): how slip grows, turns, and how the normal velocity grows."""
        s = (math.cos(angle), math.sin(angle))
        r = self.rate(s + (0,))
        return dot(r[:2], s), r[1] * s[0] - r[0] * s[1], r[2]

    def follow(self, v, until, steps=8000):
        """Impulse and velocity where `until` (of the velocity) turns true, to 1 part of the steps squared."""
        p, step = 0.0, -v[2] / self.w[2][2] / steps
        while True:
            k1 = self.rate(v)
            k2 = self.rate([x + step / 2 * k for x, k in zip(v, k1)])
            k3 = self.rate([x + step / 2 * k for x, k in zip(v, k2)])
            k4 = self.rate([x + step * k for x, k in zip(v, k3)])
            after = [x + step / 6 * (a + 2 * b + 2 * c + d) for x, a, b, c, d in zip(v, k1, k2, k3, k4)]
            if until(after):
                return p, v
            p, v = p + step, after


class Explained(SpaceFolder):
    def steps_of(self, n, *arguments):
        """Equations by the title of their step, in order: (name, value)."""
        data = self.json_of("explain", str(n), *arguments)
        return {step["title"]: step for step in data["steps"]}

    @staticmethod
    def values(step):
        return {e["name"]: e["value"] for e in step["equations"]}

    def rows(self, n, *arguments):
        return self.json_of("sequence", *arguments, "--impacts", str(n))["impacts"]

    def test_the_torque_free_rotation_is_told_by_its_invariants_its_modulus_and_its_period(self):
        for given in ([], ["--centre", words(CENTRE), "--inertia", words(INERTIA)], ["--restitution", "0.5", "--friction", "0.8", "--gravity", "9.81"]):
            shown = self.values(self.steps_of(2, *CORNER, *given)["Rotation without torque"])
            first = self.rows(1, *CORNER, *given)[0]
            rate = rotated(inverse(first["attitude"]), first["angular_velocity_after"])
            spin = times(INERTIA if given[:1] == ["--centre"] else [*box_moments(SIZE, MASS), 0, 0, 0], rate)
            energy, square = dot(rate, spin), dot(spin, spin)
            self.assertAlmostEqual(2 * shown["E_r"], energy, delta=1e-13 * energy)
            self.assertAlmostEqual(shown["L"], math.sqrt(square), delta=1e-13 * math.sqrt(square))
            a, b, c = sorted(shown[name] for name in ("I₁", "I₂", "I₃"))
            if square < energy * b:  # L circles the axis of the least moment
                a, c = c, a
            k2 = (b - a) * (energy * c - square) / ((c - b) * (square - energy * a))
            rate = math.sqrt((c - b) * (square - energy * a) / (a * b * c))
            period = 4 * math.pi / (2 * arithmetic_geometric_mean(1, math.sqrt(1 - k2))) / rate
            self.assertAlmostEqual(shown["k²"], k2, delta=1e-11)
            self.assertAlmostEqual(shown["T_p"], period, delta=1e-10 * period)
            flown = self.values(self.steps_of(2, *CORNER, *given)["The earliest corner"])["N"]
            self.assertAlmostEqual(flown * shown["T_p"], self.rows(2, *CORNER, *given)[1]["start"], delta=1e-12)

    def test_the_corner_that_is_said_to_come_first_is_on_the_ground_at_the_root_and_the_next_one_as_high_as_said(self):
        for given in ([], ["--gravity", "9.81", "--restitution", "0.6"], ["--friction", "0.4", "--spin", "20"]):
            steps = self.steps_of(2, *CORNER, *given)
            start, shown = self.values(steps["The flight to impact 2"]), self.values(steps["The earliest corner"])
            touch = self.rows(2, *CORNER, *given)[1]
            gravity = 9.81 if "--gravity" in given else 0.0
            time = shown["T"]
            self.assertLessEqual(shown["T_low"], time)
            self.assertLessEqual(time, shown["T_high"])
            height = start["z₁"] + start["V₁"][2] * time - gravity * time * time / 2
            self.assertAlmostEqual(shown["z"], height, delta=1e-14)
            corners = [[s * l / 2 for s, l in zip((i, j, k), SIZE)] for i in (-1, 1) for j in (-1, 1) for k in (-1, 1)]
            heights = sorted(height + rotated(touch["attitude"], corner)[2] for corner in corners)
            self.assertAlmostEqual(heights[0], 0, delta=1e-14)
            self.assertAlmostEqual(self.values(steps["The corner"])["h"], 0, delta=1e-14)
            self.assertAlmostEqual(shown["h_next"], heights[1], delta=1e-14)
            self.assertAlmostEqual(self.values(steps["The corner"])["v"][2], -touch["approach_speed"], delta=1e-12)

    def random_corners(self, count):
        dice = random.Random(12)
        for _ in range(count):
            q = [dice.gauss(0, 1) for _ in range(4)]
            q = [x / math.hypot(*q) for x in q]
            mu = dice.choice((0.1, 0.3, 0.7, 1.2))
            v = [dice.uniform(-1, 1), dice.uniform(-1, 1), -1]
            w = [dice.uniform(-20, 20) for _ in range(3)]
            given = [*PHONE, "--centre", words(CENTRE), "--inertia", words(INERTIA), "--attitude=" + words(q), "--velocity=" + words(v),
                     "--angular-velocity=" + words(w), "--friction", str(mu), "--restitution", "0.6"]
            done = self.run_program("sequence", *given, "--impacts", "1")
            if done.returncode == 0:
                yield q, v, w, mu, given

    def test_the_contact_inertia_and_the_velocity_of_the_corner_are_those_of_unit_impulses_there(self):
        for q, v, w, _, given in self.random_corners(8):
            steps, row = self.steps_of(1, *given), self.rows(1, *given)[0]
            shown = self.values(steps["The corner"])
            arm = rotated(q, [p - c for p, c in zip(row["place"], CENTRE)])
            for mine, theirs in zip(arm, shown["r"]):
                self.assertAlmostEqual(mine, theirs, delta=1e-16)
            for mine, theirs in zip([a + b for a, b in zip(v, cross(w, arm))], shown["v"]):
                self.assertAlmostEqual(mine, theirs, delta=1e-14)
            inertia = contact_inertia(q, arm, INERTIA)
            self.assertEqual([shown["b"], shown["c"]], [[shown["W"][0][2], shown["W"][1][2]], shown["W"][2][2]])
            for i, j in ((i, j) for i in range(3) for j in range(3)):
                self.assertAlmostEqual(shown["W"][i][j], inertia[i][j], delta=1e-12 * inertia[2][2])

    def test_the_invariant_directions_are_all_the_zeros_of_turning_marked_as_stable_and_outgoing_as_they_are(self):
        counts = set()
        for q, _, _, mu, given in self.random_corners(16):
            steps, row = self.steps_of(1, *given), self.rows(1, *given)[0]
            arm = rotated(q, [p - c for p, c in zip(row["place"], CENTRE)])
            path = Path(contact_inertia(q, arm, INERTIA), mu)
            marked = {e["name"]: (e["value"], e["words"]) for e in steps["Friction in impulse space"]["equations"]}
            shown = [(marked[f"φ{d}"], marked[f"f{d}"][0], marked[f"h{d}"][0]) for d in "₁₂₃₄" if f"φ{d}" in marked]
            turns = [path.turning(math.radians(i / 10 + 0.0123))[1] for i in range(3600)]
            self.assertEqual(len(shown), sum(a * b < 0 for a, b in zip(turns, turns[1:] + turns[:1])))
            counts.add(len(shown))
            for (angle, words_of_it), f, h in shown:
                mine = path.turning(math.radians(angle))
                size = abs(mine[0]) + abs(mine[2])
                self.assertAlmostEqual(mine[1], 0, delta=1e-11 * size)
                self.assertAlmostEqual(mine[0], f, delta=1e-11 * size)
                self.assertAlmostEqual(mine[2], h, delta=1e-11 * size)
                slope = path.turning(math.radians(angle + 1e-3))[1] - path.turning(math.radians(angle - 1e-3))[1]
                self.assertEqual((", stable" in words_of_it, "outgoing" in words_of_it), (slope < 0, f > 0), words_of_it)
        self.assertEqual(counts, {2, 4})

    def test_slip_stops_compression_ends_and_the_impact_ends_where_small_steps_along_the_path_say(self):
        kinds = set()
        for q, v, w, mu, given in self.random_corners(12):
            steps, row = self.steps_of(1, *given), self.rows(1, *given)[0]
            arm = rotated(q, [p - c for p, c in zip(row["place"], CENTRE)])
            path = Path(contact_inertia(q, arm, INERTIA), mu)
            friction, end = ({**self.values(steps[a]), **self.values(steps[b])} for a, b in
                             (("Friction in impulse space", "What the impulse does"), ("The impulse", "What the impulse does")))
            before = [a + b for a, b in zip(v, cross(w, arm))]
            scale = -before[2] / path.w[2][2]
            self.assertAlmostEqual(friction["σ"], math.hypot(*before[:2]), delta=1e-13)
            kinds.add(row["mode"])
            self.assertIn(f"({row['mode']})", steps["Friction in impulse space"]["text"])
            self.assertEqual("p_stop" in friction, row["mode"] in ("slip-stick", "slip-reslip"))
            if "p_stop" in friction:
                small = 1e-3 * math.hypot(*before[:2])
                p, after = path.follow(before, lambda u: math.hypot(u[0], u[1]) < small)
                p -= math.hypot(*after[:2]) / path.turning(math.atan2(after[1], after[0]))[0]
                self.assertAlmostEqual(friction["p_stop"], p, delta=1e-3 * scale)
                continue
            for name, level in (("p_c", 0.0), ("P_z", -0.6 * before[2])):
                p, after = path.follow(before, lambda u: u[2] > level)
                self.assertAlmostEqual(end[name], p, delta=2e-4 * scale)
            self.assertAlmostEqual(friction["σ′"], math.hypot(*after[:2]), delta=1e-3 * math.hypot(*before))
            self.assertAlmostEqual(end["e_N"], 0.6, delta=1e-12)
        self.assertGreaterEqual(kinds, {"slip", "slip-stick"})

    def test_energy_is_the_sum_of_its_parts_and_its_loss_what_the_impulse_took(self):
        for given in (["--gravity", "9.81", "--friction", "0.3", "--restitution", "0.5"], ["--restitution", "0.2"]):
            shown = self.values(self.steps_of(2, *CORNER, *given)["Energy"])
            row = self.rows(2, *CORNER, *given)[1]
            self.assertEqual([shown["E"], shown["E′"]], [row["energy_before"], row["energy_after"]])
            self.assertAlmostEqual(shown["E"] - shown["E′"], shown["ΔE"], delta=1e-14)
            self.assertGreater(shown["ΔE"], 0)

    def test_the_set_of_outcomes_is_what_sequences_of_tilted_drops_come_to(self):
        attitude = (math.cos(math.radians(10)), math.sin(math.radians(10)), 0, 0)  # an edge along x
        steps = self.steps_of(1, *PHONE, "--attitude", words(attitude))
        self.assertIn("rebound as a whole", steps["Corners at once"]["text"])
        outcomes = [step for title, step in steps.items() if title.startswith("Outcome ")]
        self.assertEqual(len(outcomes), 2)
        for outcome in outcomes:
            side = math.radians(float(outcome["text"].split("side of ")[1].split("°")[0]))
            half = 1e-7
            tilt = (1, half * math.sin(side), -half * math.cos(side), 0)  # about d × z: what lies on that side goes up
            rows = self.rows(6, *PHONE, "--attitude=" + words([x / math.hypot(*tilt) for x in product(tilt, attitude)]))
            near = [row for row in rows if row["start"] < 1e-4]
            shown = self.values(outcome)
            self.assertEqual(outcome["text"].count("corner "), len(near))
            for vector, key, size in zip(shown.values(), ("velocity_after", "angular_velocity_after"), (1, 100)):
                for a, b in zip(vector, near[-1][key]):
                    self.assertAlmostEqual(a, b, delta=1e-4 * size)

    def test_a_face_shows_where_the_resultant_of_its_pushes_lies(self):
        spun = self.values(self.steps_of(1, *PHONE, "--attitude", "1,0,0,0", "--angular-velocity", "3,-2,1")["Corners at once"])
        xx, yy, _ = box_moments(SIZE, MASS)
        # Each part of the turning is reversed: M = −2 I ω, P = 2 m v.
        self.assertAlmostEqual(spun["x"], -(-2 * yy * -2) / (2 * MASS), delta=1e-15)
        self.assertAlmostEqual(spun["y"], -2 * xx * 3 / (2 * MASS), delta=1e-15)
        self.assertAlmostEqual(spun["ω′"][2], 1, delta=1e-15)

    def test_a_round_rod_on_its_rim_and_a_body_that_does_not_turn_are_explained_too(self):
        rod = ["--radius", "0.02", "--angle", "30", "--velocity=0,0.1,-1"]
        text = self.run_program("explain", "2", *rod).stdout
        self.assertIn("corner b", text)
        flat = self.run_program("explain", "2", *PHONE, "--angle", "0", "--velocity=0,0.1,-1", "--gravity", "9.81").stdout
        self.assertIn("fixed axis", flat)
        self.assertIn("impact", flat)

    def test_what_rounding_decides_is_shown_as_unknown(self):
        edge = [*PHONE, "--angle", "0", "--tilt", "1e-5"]
        self.assertFalse(self.rows(2, *edge)[1]["predictable"])
        text = self.run_program("explain", "2", *edge).stdout
        self.assertIn("= ? J, energy after", text)
        errors = {e["name"]: e["error"] for step in self.steps_of(2, *edge).values() for e in step["equations"]}
        self.assertEqual([errors[name] for name in ("V", "ω", "V′", "ω′", "E′")], [None] * 5)

    def test_an_impact_in_space_that_does_not_happen_is_explained_by_the_end_of_the_sequence(self):
        done = self.run_program("explain", "9", *CORNER)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("Impact 9 does not happen", done.stdout)
        self.assertIn("no-further-impact", done.stdout)

    def test_every_form_of_an_explanation_has_all_its_equations(self):
        given = [*CORNER, "--friction", "0.3", "--gravity", "9.81"]
        steps = self.json_of("explain", "2", *given)["steps"]
        equations = [e for step in steps for e in step["equations"]]
        laws = sum(len(step["laws"]) for step in steps)
        texts = {form: self.run_program("explain", "2", *given, "--format", form).stdout for form in ("table", "csv", "markdown", "latex")}
        numbers = sum(len(e["value"]) * (len(e["value"][0]) if isinstance(e["value"][0], list) else 1) if isinstance(e["value"], list) else 1
                      for e in equations)
        self.assertEqual(len([line for line in texts["csv"].splitlines() if not line.startswith("#")]), numbers + 1)
        self.assertEqual(texts["markdown"].count("\n- `"), len(equations))
        self.assertEqual(texts["markdown"].count("\n> `"), laws)
        names = [e["tex"].split(" &= ")[0] for e in equations]
        for name in names:
            self.assertIn(f"\n  {name} &= ", texts["latex"])
        self.assertEqual(texts["latex"].count("\\paragraph"), len(steps))
        self.assertLessEqual(max(map(len, texts["table"].splitlines())), 80)
        body = "\n".join(line for line in texts["latex"].splitlines() if not line.startswith("%"))
        self.assertEqual([c for c in body if ord(c) > 127], [])  # nothing that LaTeX would not print
