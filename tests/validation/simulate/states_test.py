# SPDX-License-Identifier: GPL-3.0-or-later
"""Where the simulator's body is at a time, and how its drop ends; their numbers are claims of tests/numeric."""

from run_folder import EmptyFolder, json_of, rows_of

# Sides that stand upright bear nothing on the projected area.
SCENE = ("[drop]\nangle_deg = 0\n[world]\ngravity = 9.81\n[body]\nshape = 'box'\nsize = [0.1, 0.05, 0.02]\nmass = 0.2\n"
         "[ground]\nstiffness = 1e8\narea = 'projected'\n")


class States(EmptyFolder):
    def setUp(self):
        super().setUp()
        self.box = ("simulate", self.write("box.toml", SCENE))

    def test_states_come_at_the_times_asked_for_with_their_errors_and_change_no_other_number(self):
        drop = (*self.box, "--speed", "0.5", "--tangential-velocity", "0.25", "--impacts", "2", "--digits", "9")
        times = [0, 0.0005, 0.02, 0.1043, 0.25, 0.4]
        told = json_of(*drop, "--at", ",".join(map(str, times)))
        states, first = told["states"], told["impacts"][0]
        self.assertEqual([(state["time"], state["impacts"]) for state in states], list(zip(times, (1, 1, 1, 2, 3, 4))))
        self.assertEqual([state["touches"] for state in states[:3]], [True, first["duration"] > 0.0005, False])
        for state in states:
            self.assertLessEqual(abs(state["position"][0] - 0.25 * state["time"]), state["error_estimate"]["position"])
        self.assertEqual(told["impacts"], json_of(*drop)["impacts"])
        until = json_of(*drop, "--until", "0.15")
        self.assertEqual((len(until["impacts"]), until["outcome"]), (2, "time-limit"))
        swept = rows_of("sweep", self.box[1], "--set", "drop.speed=0.5", "--set", "run.until=0.05,0.15", "--model", "continuous")
        self.assertEqual([row["impacts"] for row in swept], ["1", "2"])

    def test_rates_and_times_before_the_touch_agree_with_the_discrete_model(self):
        toast = ("--body", "box", "--size", "0.102x0.102x0.015", "--mass", "0.03", "--release-height", "0.74", "--release-angle=-35",
                 "--release-velocity", "0.3,0,-0.2", "--release-angular-velocity", "0,9,0")
        models = (("simulate", "--stiffness", "1e9"), ("sequence",))
        rows = [rows_of(*model, *toast, "--at=-0.3,-0.2,-0.1", "--rows", "states") for model in models]
        for simulated, discrete in zip(*rows, strict=True):
            for name in ("position_x", "position_z", "attitude_q0", "attitude_q2", "velocity_z", "angular_velocity_y", "energy"):
                self.assertAlmostEqual(float(simulated[name]), float(discrete[name]), delta=1e-13, msg=name)
            self.assertAlmostEqual(float(simulated["position_x"]), 0.3 * float(simulated["time"]), delta=1e-15)
        for model in models:
            held, flies = json_of(*model, *toast, "--at=-0.36,-0.35")["states"]
            self.assertEqual((held["position"][0], flies["position"][0] is None), (None, False), model)
        told = json_of(*self.box, "--speed", "0.5", "--rate", "50", "--until", "0.1")
        self.assertEqual([state["time"] for state in told["states"]], [0, 0.02, 0.04, 0.06, 0.08, 0.1])

    def test_a_box_may_start_at_rest(self):
        told = json_of(*self.box, "--start", "rest", "--at", "0.3")
        self.assertEqual((told["outcome"], told["impacts"], told["states"][0]["touches"]), ("at-rest", [], True))
        self.each_refused({"--speed 2": "--speed", "--gravity 0": "world.gravity is 0"}, *self.box, "--start", "rest")
        for command in ("compare", "plan"):
            self.refused("", command, self.box[1], "--start", "rest")

    def test_what_slides_on_for_ever_and_what_friction_stops_are_ends_of_their_own(self):
        drop = (*self.box, "--damping", "1e9", "--speed", "0.1", "--impacts", "400")
        free = json_of(*drop, "--tangential-velocity", "0.6")
        self.assertEqual((free["outcome"], free["end_motion"]["kind"]), ("slides-on", "slides"))
        self.assertEqual((free["end_motion"]["velocity"][0], free["end_motion"]["duration"]), (0.6, None))
        stopped = json_of(*drop, "--sliding-friction", "0.05", "--tangential-velocity", "0.6")
        end = stopped["end_motion"]
        self.assertEqual((stopped["outcome"], end["kind"]), ("at-rest", "slides"))
        self.assertAlmostEqual(end["distance"], end["velocity"][0] * end["duration"] / 2, delta=1e-12)
