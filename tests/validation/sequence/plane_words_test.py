# SPDX-License-Identifier: GPL-3.0-or-later
"""What a first-time reader meets in the plane: names of angles, what a column counts, why models differ, how to go on."""

import math
import os
import re
import subprocess
import sys

from run_folder import PROGRAM, ROOT, EmptyFolder, json_of, rows_of, run


def said(*arguments):
    """What a run prints, in one line."""
    return " ".join(run(*arguments).stdout.split())


class Words(EmptyFolder):
    def test_a_state_at_a_time_is_where_free_fall_and_the_slide_take_the_body(self):
        drop = ("sequence", "--body", "box", "--size", "0.2x0.1x0.1", "--angle", "0", "--gravity", "9.81", "--restitution", "0.4",
                "--friction", "0.5", "--tangential-velocity", "6")
        run_ = json_of(*drop, "--at", "0.03,0.5,3", "--until-rest")
        flight, slide, rest = run_["states"]
        self.assertAlmostEqual(flight["position"][2], 0.05 + 0.4 * 0.03 - 9.81 / 2 * 0.03**2, delta=1e-14)
        # All impulses are m (V + g t), and friction takes half of that until the slide has stopped.
        speed = 6 - 0.5 * (1 + 9.81 * 0.5)
        self.assertAlmostEqual(slide["velocity"][0], speed, delta=1e-12)
        self.assertEqual((slide["touches"], rest["touches"], rest["velocity"]), (True, True, [0, 0, 0]))
        end = run_["end_motion"]
        self.assertEqual((run_["outcome"], end["kind"]), ("at-rest", "slides"))
        self.assertAlmostEqual(end["start"] + end["duration"], 0.5 + speed / (0.5 * 9.81), delta=1e-12)
        self.assertEqual([json_of(*drop, *more)["outcome"] for more in ((), ("--until", "0.1"))], ["slides-on", "time-limit"])
        rows = rows_of(*drop, "--at", "0.03,0.5", "--rows", "states")
        self.assertEqual((len(rows), list(rows[0])[:3]), (2, ["time", "impacts", "touches"]))

    def test_friction_by_the_slip_after_the_impact_turns_slip_back_where_friction_on_its_way_does_not(self):
        drop = ("--angle", "30", "--restitution", "0.5", "--friction", "0.3", "--tangential-velocity", "0.4")
        moreau = json_of("sequence", *drop, "--impact-friction-law", "moreau")
        self.assertEqual((moreau["scene"]["discrete_law"]["friction_law"], moreau["impacts"][0]["mode"]), ("moreau", "reverse-slip"))
        # m k² of a thin rod of 1 m and 1 kg is 1/12; P_t = μ P_n against a slip that has turned.
        normal = 1.5 / (1 + 0.75 / 4 * 12 - 0.3 * math.sqrt(3) / 16 * 12)
        self.assertAlmostEqual(moreau["impacts"][0]["impulse_normal"], normal, delta=1e-14)
        self.assertIn(f"= {normal:.6f} N·s, normal impulse", run("explain", "1", *drop, "--impact-friction-law", "moreau").stdout)
        self.each_refused({"moreau --restitution-law poisson": "newton", "morea": "did you mean moreau"}, "sequence", *drop, "--impact-friction-law")

    def test_a_body_whose_end_stays_on_the_ground_goes_on_to_rest(self):
        drop = ("sequence", "--angle", "30", "--gravity", "9.81", "--restitution", "0.5", "--friction", "0.3")
        self.assertEqual(json_of(*drop)["outcome"], "impact-limit")
        run_ = json_of(*drop, "--until-rest", "--at", "9")
        self.assertEqual(run_["outcome"], "at-rest")
        self.assertGreater(len(run_["contacts"]), 4)
        self.assertAlmostEqual(run_["states"][0]["position"][2], 0, delta=1e-15)
        self.assertIn("; the body is at rest", run_["message"])

    def test_a_body_that_does_not_come_to_rest_since_impacts_take_no_energy_is_told_so(self):
        drop = ("sequence", "--angle", "10", "--gravity", "9.81", "--until-rest", "--digits", "2")
        done = run(*drop, "--restitution", "1")
        self.assertEqual((done.returncode, done.stderr), (3, "clatter: not at rest after 100000 impacts; restitution 1 takes no energy\n"))

    def test_a_time_before_the_first_impact_and_states_without_times_are_refused(self):
        self.each_refused({"--at=-1": "--at", "--rows states": "--rows states: needs --at or --rate"}, "sequence", "--angle", "10")

    def test_where_a_later_impact_comes_the_table_says_that_it_counts_fewer(self):
        # Turned past upright the rod strikes again: end b, which angles does not count.
        drop = json_of("sequence", "--angle", "60", "--gravity", "0.1", "--impacts", "2")
        self.assertEqual(drop["impacts"][1]["end"], "b")
        self.assertGreater(drop["impacts"][1]["start"] * abs(drop["impacts"][0]["angular_velocity_after"][1]), math.radians(60 + 90))
        for more in ((), ("--as-printed",)):
            self.assertIn("a later impact always comes", said("angles", "--from", "60", "--to", "60", "--gravity-number", "0.1", *more))
        self.assertNotIn("always comes", run("angles").stdout)
        # Above an order line the same end strikes twice.
        self.assertEqual([impact["end"] for impact in json_of("sequence", "--angle", "88", "--gravity", "1.2", "--impacts", "2")["impacts"]], ["a", "a"])
        self.assertIn("the end that struck last strikes again first, an impact that is not counted", said("angles", "--regimes"))

    def test_windows_of_theta_between_two_rows_are_told(self):
        asked = ("angles", "--step", "2.5", "--gravity-number", "0.2")
        found = re.search(r"γ, P₃ also in windows narrower than the step: ([^βθ]*°)", said(*asked))
        windows = [tuple(map(float, window)) for window in re.findall(r"([\d.]+)° to ([\d.]+)°", found[1])]
        self.assertEqual([int(low) for low, _ in windows], [56, 88])
        for low, high in windows:
            inside, outside = ([row["gamma_deg"] is not None for row in json_of("angles", "--from", repr(a), "--to", repr(b), "--count", "9",
                               "--gravity-number", "0.2")["rows"]] for a, b in ((low + 1e-3, high - 1e-3), (low - 0.1, low - 1e-3)))
            self.assertTrue(all(inside) and not any(outside), (low, high))
        self.assertNotIn("windows", run("angles", "--step", "0.05", "--gravity-number", "0.2").stdout)
        self.assertNotIn("γ, P₃", run(*asked, "--as-printed").stdout)

    def test_a_ratio_that_no_friction_gives_is_said_by_every_command(self):
        # The ratio that holds the end of the rod at 10 degrees is 3sc/(1 + 3s²) = 0.4705.
        for ratio, pushes in (("0.46", False), ("0.48", True), ("-0.1", True)):
            drop = ("--angle", "10", f"--impulse-ratio={ratio}", "--impacts", "1")
            for command in (["sequence"], ["explain", "1"]):
                self.assertEqual("--friction MU follows the slip" in run(*command, *drop).stderr, pushes, (ratio, command))
            warned = run("sweep", "rod-10", "--model", "discrete", "--set", f"impact.impulse_ratio={ratio}", "--set", "run.impacts=1").stderr
            self.assertEqual("scene 0: the impulse ratio creates energy" in warned, pushes, warned)
        # With loss the energy still falls, but the impulse pushes along the slip.
        lossy = run("sequence", "--angle", "10", "--impulse-ratio=-0.01", "--restitution", "0.5", "--impacts", "1").stderr
        self.assertIn("pushes the contact along its slip", lossy)
        found = re.search(r"below θ = ([\d.]+)° and above ([\d.]+)°, and creates energy there", said("angles", "--impulse-ratio", "0.48"))
        for angle in map(float, found.groups()):
            s, c = math.sin(math.radians(angle)), math.cos(math.radians(angle))
            self.assertAlmostEqual(3 * s * c / (1 + 3 * s * s), 0.48, delta=3e-3)

    def test_a_contact_slips_where_the_ratio_that_would_hold_it_is_above_friction(self):
        for friction, slips in (("0.46", True), ("0.48", False)):  # |B|/C = 0.4705 at 10 degrees
            told = run("explain", "1", "--angle", "10", "--friction", friction).stdout
            self.assertEqual(("r₀ = |B|/C" in told, "mode is slip" in told), (slips, slips), told)
        # Slip that stops: |B|/C decides whether it sticks then or goes on the other way.
        for friction, mode in (("0.1", "reverse-slip"), ("0.6", "slip-stick")):
            self.assertIn("mode is " + mode, said("explain", "1", "--angle", "10", "--friction", friction, "--tangential-velocity", "0.01"))

    def test_why_they_differ_is_said_and_how_long_the_contact_is(self):
        contact = json_of("simulate", "phone-damped", "--impacts", "1")["impacts"][0]
        flight = json_of("sequence", "phone-damped")["impacts"][1]["start"]
        found = re.search(r"largest difference, \S+ of impact 2, comes most from [^;]+; contact 1 lasts (\S+) ms of the (\S+) ms",
                          said("compare", "phone-damped", "--impacts", "2"))
        self.assertAlmostEqual(float(found[1]), 1e3 * contact["duration"], delta=5e-3)
        self.assertAlmostEqual(float(found[2]), 1e3 * flight, delta=5e-3)

    def test_the_example_of_the_reference_reads_json(self):
        path = os.path.dirname(PROGRAM) + os.pathsep + os.environ["PATH"]
        done = subprocess.run([sys.executable, os.path.join(ROOT, "tests", "install", "json_example.py")],
                              capture_output=True, text=True, env={**os.environ, "PATH": path})
        self.assertRegex(done.stdout.splitlines()[1], r"^0\.087082 s  1\.002842 ± \de-1\d N·s$")
