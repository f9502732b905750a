# SPDX-License-Identifier: GPL-3.0-or-later
"""Every row of a motion counts, and the text and the picture say what the class is by."""
import unittest

from exact_motion import Motion, scored
from run_folder import EmptyFolder

POSES = {True: ["x", "z", "phi"], False: ["x", "y", "z", "q"]}  # of a body in the plane, in space


def spoilt(motion, rows, first, last, name, change):
    """Rows first to last with one coordinate changed; of an attitude in space the body is turned upside down."""
    out = [list(row) for row in rows]
    for row in out[first:last + 1]:
        if name == "q":
            row[4:8] = [-row[5], row[4], row[7], -row[6]]
        else:
            row[motion.columns().index(name)] += change
    return out


class Rows(unittest.TestCase):
    def test_one_row_beside_its_flight_is_found_wherever_it_is(self):
        for problem in ("rod-10", "box", "corner"):
            motion = Motion(problem, 1)
            rows = motion.rows(1e-3)
            places = {"flight": len(rows) // 2, "second": 1, "last": len(rows) - 1}
            places["after an impact"] = sum(row[0] < motion.pieces[2].time for row in rows)
            texts = {}
            for where, k in places.items():
                for name in POSES[motion.is_planar]:
                    small = [1e-4] if where != "last" else []  # behind what is asked for, where a speed may do that
                    for change in [*small, 5.0, 1e200, 1e308] if name in "xz" else [2.0]:
                        texts[where, name, change] = motion.text(spoilt(motion, rows, k, k, name, change))
            for (where, name, change), found in zip(texts, scored(*texts.values())):
                with self.subTest(problem=problem, where=where, name=name, change=change):
                    self.assertEqual(found["verdict"], "good" if change == 1e-4 and found["error"] < 1e-3 else
                                     "coarse" if change == 1e-4 else "fails")
                    self.assertEqual([cause["cause"] for cause in found["causes"]], ["stray-rows"])
                    self.assertIn(f"line {places[where] + 3}: {'the attitude' if name == 'q' else name} is ",
                                  found["causes"][0]["words"])

    def test_rows_between_impacts_are_not_exact_though_the_flight_ends_right(self):
        for problem in ("rod-10", "clatter-08", "tumble"):
            motion = Motion(problem, 1)
            rows = motion.rows(1e-3)
            begin = sum(row[0] < motion.pieces[1].time for row in rows)
            last = sum(row[0] < motion.pieces[2].time for row in rows) - 3
            for name in ("x", "z"):
                found, = scored(motion.text(spoilt(motion, rows, begin + 2, last, name, 0.3)))
                with self.subTest(problem=problem, name=name):
                    self.assertEqual(found["verdict"], "fails")
                    self.assertEqual([cause["cause"] for cause in found["causes"]], ["stray-rows"])
                    self.assertIn(f"lines {begin + 5} to {last + 3}: {name} is 0.30 m off", found["causes"][0]["words"])

    def test_a_velocity_in_flight_that_would_lead_off_it_is_not_exact(self):
        for problem, name in (("rod-10", "omega"), ("rod-10", "vz"), ("box", "vx"), ("tumble", "wx")):
            motion = Motion(problem, 1)
            rows = motion.rows(1e-2)
            k = sum(row[0] < motion.pieces[2].time for row in rows) - 2
            at = motion.columns().index(name)
            for wrong in (-rows[k][at] + 3, 1e9, 1e308):
                out = [list(row) for row in rows]
                out[k][at] = wrong
                found, = scored(motion.text(out))
                with self.subTest(problem=problem, name=name, wrong=wrong):
                    self.assertIn(found["verdict"], ("coarse", "fails"))
                    if not found["order_right"]:  # counted as an impact
                        continue
                    self.assertTrue(any(f"line {k + 3}" in words for words in found["findings"] + [c["words"] for c in found["causes"]]), found)

    def test_a_body_that_leaps_at_an_impact_did_not_fly_there(self):
        for problem, name in (("rod-10", "x"), ("corner", "y")):
            motion = Motion(problem, 1)
            rows = motion.rows(1e-3)
            begin = sum(row[0] < motion.pieces[1].time for row in rows)
            found, = scored(motion.text(spoilt(motion, rows, begin, len(rows), name, 0.3)))
            self.assertEqual((found["verdict"], found["causes"]), ("fails", []))
            self.assertIn(f"no speed explains the way to line {begin + 3} after impact 1: {name} is 0.30 m",
                          " ".join(found["findings"]))

    def test_rows_behind_what_is_asked_for_and_of_a_body_at_rest_count(self):
        for problem in ("rod-10", "ball-rest", "slide", "incline-slide", "incline-stick"):
            motion = Motion(problem, 0)
            rows = motion.rows(2e-3, 1.2 * motion.end())
            k = len(rows) - 4
            right, *wrong = scored(motion.text(rows), *(motion.text(spoilt(motion, rows, k, k, name, 0.3))
                                                           for name in ("x", "z")))
            self.assertEqual(right["verdict"], "exact", problem)
            for found in wrong:
                with self.subTest(problem=problem):
                    self.assertEqual(found["verdict"], "fails")
                    self.assertIn(f"line {k + 3}: ", found["causes"][0]["words"])


class Reasons(EmptyFolder):
    def hot(self):
        """After an impact straight down V is off by 0.006 and the energy by twice that, beyond what is coarse."""
        motion = Motion("flat", 1)
        motion.pieces[1].velocity[2] *= 1.006
        return motion.text(motion.rows(1e-3))

    def test_what_the_class_is_by_is_said_with_its_size_in_text_and_picture(self):
        step = Motion("rod-10", 1)
        texts = self.hot(), step.text(spoilt(step, step.rows(1e-3), 50, 50, "z", 5.0))
        hot, stray = scored(*texts, options=("--plot", self.path("p.svg"), "--plot-script"))
        self.assertEqual([(found["verdict"], found["decided_by"]) for found in (hot, stray)], [("fails", "energy"), ("fails", "flight")])
        self.assertIn("energy after impact 1 (lines 5 to 6) is off, error 0.013", hot["findings"])
        for words in ("fails by energy", "fails by flight", "problem flat", "problem rod-10"):
            self.assertIn(words, self.read("p.gnuplot"))
        for found in (hot, stray):
            self.assertAlmostEqual(max(one["error"] for one in found["impact_scores"]) / found["error"], 1, delta=1e-9)
        self.write("0.csv", texts[0])
        self.assertIn("0.csv: fails by energy, off by 0.013", self.run_program("benchmark", "score", "0.csv").stdout)
