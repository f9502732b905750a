# SPDX-License-Identifier: GPL-3.0-or-later
"""Where the simulator's body is at a time, and how its drop ends: against closed forms of level boxes."""

import csv
import math
import unittest

from run_folder import EmptyFolder, json_of, rows_of, run

G, SPEED, MASS, SIZE, STIFFNESS = 9.81, 0.5, 0.2, (0.1, 0.05, 0.02), 1e8
# Sides that stand upright bear nothing on the projected area.
SCENE = """
[drop]
angle_deg = 0
[world]
gravity = 9.81
[body]
shape = "box"
size = [0.1, 0.05, 0.02]
mass = 0.2
[ground]
stiffness = 1e8
area = "projected"
"""
FREQUENCY = math.sqrt(STIFFNESS * SIZE[0] * SIZE[1] / MASS)


def undamped(time):
    """Height and velocity of the centre of a level box that bounces on springs for ever."""
    phase = math.atan(SPEED * FREQUENCY / G)
    contact = 2 * (math.pi - phase) / FREQUENCY
    within = time % (contact + 2 * SPEED / G)
    if within > contact:
        flown = within - contact
        return SIZE[2] / 2 + SPEED * flown - G / 2 * flown**2, SPEED - G * flown
    sine, cosine = math.sin(FREQUENCY * within), math.cos(FREQUENCY * within)
    depth = G / FREQUENCY**2 * (1 - cosine) + SPEED / FREQUENCY * sine
    return SIZE[2] / 2 - depth, -(G / FREQUENCY * sine + SPEED * cosine)


class States(EmptyFolder):
    def setUp(self):
        super().setUp()
        self.box = ("simulate", self.write("box.toml", SCENE))

    def test_a_level_box_is_where_springs_and_free_fall_take_it(self):
        drop = (*self.box, "--speed", "0.5", "--tangential-velocity", "0.25", "--impacts", "2", "--digits", "9")
        times = [0, 0.0005, 0.02, 0.1043, 0.25, 0.4]
        told = json_of(*drop, "--at", ",".join(map(str, times)))
        self.assertEqual([state["time"] for state in told["states"]], times)
        self.assertEqual([state["impacts"] for state in told["states"]], [1, 1, 1, 2, 3, 4])
        for state in told["states"]:
            with self.subTest(time=state["time"]):
                height, velocity = undamped(state["time"])
                error = state["error_estimate"]
                self.assertLessEqual(abs(state["position"][2] - height), error["position"])
                self.assertLessEqual(abs(state["position"][0] - 0.25 * state["time"]), error["position"])
                self.assertLessEqual(abs(state["velocity"][2] - velocity), error["velocity"])
                self.assertLess(error["velocity"], 1e-6)
                self.assertEqual(state["touches"], height < SIZE[2] / 2 or state["time"] == 0)
        self.assertEqual(told["impacts"], json_of(*drop)["impacts"], "states change no other number")
        self.assertEqual(len(json_of(*drop, "--until", "0.15")["impacts"]), 2)
        self.assertEqual(json_of(*drop, "--until", "0.15")["outcome"], "time-limit")
        swept = rows_of("sweep", self.box[1], "--set", "drop.speed=0.5", "--set", "run.until=0.05,0.15", "--model", "continuous")
        self.assertEqual([row["impacts"] for row in swept], ["1", "2"])

    def test_rates_and_times_before_the_touch_agree_with_the_discrete_model(self):
        toast = ("--body", "box", "--size", "0.102x0.102x0.015", "--mass", "0.03", "--release-height", "0.74", "--release-angle=-35",
                 "--release-velocity", "0.3,0,-0.2", "--release-angular-velocity", "0,9,0")
        rows = []
        for model in (("simulate", "--stiffness", "1e9"), ("sequence",)):
            out = run(*model, *toast, "--at=-0.3,-0.2,-0.1", "--format", "csv", "--bare", "--rows", "states").stdout
            rows.append(list(csv.DictReader(out.splitlines())))
        for simulated, discrete in zip(*rows):
            for name in ("position_x", "position_z", "attitude_q0", "attitude_q2", "velocity_z", "angular_velocity_y", "energy"):
                self.assertAlmostEqual(float(simulated[name]), float(discrete[name]), delta=1e-13, msg=name)
            self.assertAlmostEqual(float(simulated["position_x"]), 0.3 * float(simulated["time"]), delta=1e-15)
        for model in (("simulate", "--stiffness", "1e9"), ("sequence",)):
            held, flies = json_of(*model, *toast, "--at=-0.36,-0.35")["states"]
            self.assertEqual((held["position"][0], flies["position"][0] is None), (None, False), model)
        told = json_of(*self.box, "--speed", "0.5", "--rate", "50", "--until", "0.1")
        self.assertEqual([state["time"] for state in told["states"]], [0, 0.02, 0.04, 0.06, 0.08, 0.1])

    def test_a_box_at_rest_lies_as_deep_as_its_weight_presses_it(self):
        told = json_of(*self.box, "--start", "rest", "--at", "0.3")
        (state,) = told["states"]
        depth = MASS * G / (STIFFNESS * SIZE[0] * SIZE[1])
        self.assertAlmostEqual(state["position"][2], SIZE[2] / 2 - depth, delta=1e-14)
        self.assertEqual((told["outcome"], told["impacts"], state["touches"]), ("at-rest", [], True))
        for given, said in ((("--speed", "2"), "--speed"), (("--gravity", "0"), "world.gravity is 0")):
            done = run(*self.box, "--start", "rest", *given)
            self.assertEqual(done.returncode, 2)
            self.assertRegex(done.stderr, said)
        for command in (("compare",), ("plan",)):
            done = run(*command, self.box[1], "--start", "rest")
            self.assertEqual((done.returncode, len(done.stderr.splitlines())), (2, 1))

    def test_what_slides_on_for_ever_and_what_friction_stops_are_ends_of_their_own(self):
        drop = (*self.box, "--damping", "1e9", "--speed", "0.1", "--impacts", "400")
        free = json_of(*drop, "--tangential-velocity", "0.6")
        self.assertEqual((free["outcome"], free["end_motion"]["kind"]), ("slides-on", "slides"))
        self.assertEqual((free["end_motion"]["velocity"][0], free["end_motion"]["duration"]), (0.6, None))
        friction = ("--static-friction", "0.05", "--sliding-friction", "0.05")
        stopped = json_of(*drop, *friction, "--tangential-velocity", "0.6")
        end = stopped["end_motion"]
        self.assertEqual((stopped["outcome"], end["kind"]), ("at-rest", "slides"))
        # All of the weight's impulse passes through the ground, and friction takes a twentieth of it.
        self.assertAlmostEqual(end["start"] + end["duration"], (0.6 - 0.05 * 0.1) / (0.05 * G), delta=1e-6)
        self.assertAlmostEqual(end["distance"], end["velocity"][0] ** 2 / (2 * 0.05 * G), delta=1e-12)


if __name__ == "__main__":
    unittest.main()
