# SPDX-License-Identifier: GPL-3.0-or-later
"""[sweep] of scene files: lists, grids by count and ratio, every impact shown; windows of pictures and histories."""

import json
import os
import re
import shutil
import tempfile
import unittest

from run_folder import EmptyFolder, records, run

SCENE = """
[drop]
speed = 1
{drop}
[world]
gravity = 9.81
[body]
shape = "rod"
radius = 0.01
mesh = {{ sectors = 4, rings = 1, layers = 1 }}
[ground]
stiffness = 1e9
{ground}
[run]
impacts = 2
digits = 4
[sweep]
{sweep}
"""


class WithScenes(EmptyFolder):
    def scene(self, sweep, drop="", ground=""):
        return self.write("scene.toml", SCENE.format(sweep=sweep, drop=drop, ground=ground))

    def swept(self, *scene, **parts):
        done = run("simulate", self.scene(*scene, **parts), "--format", "json")
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads(done.stdout)


class Sweeps(WithScenes):
    def test_a_list_is_swept_value_by_value_in_its_order(self):
        data = self.swept("angle_deg = [30, 5, 10.5]")
        self.assertEqual([one["angle_deg"] for one in data["runs"]], [30, 5, 10.5])
        self.assertEqual(data["scene"]["sweep"], {"angle_deg": [30, 5, 10.5]})
        for one in data["runs"]:
            single = run("simulate", self.scene("angle_deg = [1]"), "--angle", str(one["angle_deg"]), "--format", "json")
            self.assertEqual(one["impacts"], json.loads(single.stdout)["impacts"])

    def test_a_grid_by_count_takes_both_ends_at_equal_distances_or_equal_ratios(self):
        linear = self.swept("sliding_friction = { from = 0.1, to = 0.4, count = 4 }", drop="angle_deg = 40")
        self.assertEqual([one["sliding_friction"] for one in linear["runs"]], [0.1, 0.2, 0.3, 0.4])
        grid = '{ from = 0.5, to = 40.5, count = 5, scale = "log" }'
        data = self.swept(f"angle_deg = {grid}")
        values = [one["angle_deg"] for one in data["runs"]]
        self.assertEqual((values[0], values[2], values[-1]), (0.5, 4.5, 40.5))  # the middle is the geometric mean
        for before, after in zip(values, values[1:]):
            self.assertAlmostEqual(after / before, 3, delta=1e-13)
        self.assertEqual(data["scene"]["sweep"], {"angle_deg": {"from": 0.5, "to": 40.5, "count": 5, "scale": "log"}})

    def test_a_flag_takes_the_place_of_a_swept_list(self):
        done = run("simulate", self.scene("angle_deg = [30, 5]"), "--angle", "7", "--format", "json")
        self.assertEqual(json.loads(done.stdout)["scene"]["drop"]["angle_deg"], 7)
        self.assertNotIn("sweep", json.loads(done.stdout)["scene"])

    def test_what_is_no_sweep_is_refused_in_one_line_with_its_place(self):
        for sweep, words in (("angle_deg = []", "a list of numbers"), ("angle_deg = [10, 900]", "a list of numbers, each"),
                             ("angle_deg = 5", "a list of numbers"), ('angle_deg = "5:10:1"', "a list of numbers"),
                             ("angle_deg = { from = 1, to = 5 }", "from, to and step or count"),
                             ("angle_deg = { from = 1, to = 5, step = 1, count = 3 }", "excludes"),
                             ("angle_deg = { from = 1, to = 5, count = 1 }", "a whole number from 2"),
                             ('angle_deg = { from = 1, to = 5, step = 1, scale = "log" }', "left out with step"),
                             ('angle_deg = { from = 0, to = 5, count = 3, scale = "log" }', "greater than 0"),
                             ('angle_deg = { from = 1, to = 5, count = 3, scale = "lin" }', "did you mean linear"),
                             ("angle_deg = { from = 1, to = 5, numbers = 3 }", "unknown key"),
                             ("angle_deg = [1]\nsliding_friction = [0.1]", "only one quantity")):
            with self.subTest(sweep=sweep):
                done = run("simulate", self.scene(sweep))
                self.assertEqual((done.returncode, done.stdout), (2, ""))
                self.assertEqual(done.stderr.count("\n"), 1)
                self.assertIn("scene.toml", done.stderr)
                self.assertIn(words, done.stderr)

    def test_the_table_of_a_sweep_shows_every_impact_of_every_value(self):
        path = self.scene("angle_deg = [5, 10, 70]")
        rows = records(run("simulate", path, "--format", "csv").stdout)
        table = run("simulate", path, "--format", "markdown").stdout
        shown = [[cell.strip() for cell in line.split("|")[1:-1]] for line in table.splitlines() if line.startswith("| ")][1:]
        self.assertGreater(len(rows), 3)
        self.assertEqual([row[1] for row in shown], [row["n"] for row in rows])
        values = [float(row[0]) for row in shown if row[0]]
        self.assertEqual(values, [5, 10, 70])  # once each
        names = [cell.split(" [")[0].strip() for cell in next(line for line in table.splitlines() if line.startswith("|")).split("|")[1:-1]]
        place = names.index("Pₙ")
        for row, printed in zip(rows, shown):
            self.assertAlmostEqual(float(printed[place]) / float(row["impulse_normal"]), 1, delta=1e-2)

    def test_tables_of_simulate_show_how_long_each_contact_takes(self):
        for ground in ("", "sliding_friction = 0.3\nstatic_friction = 0.3"):
            done = run("simulate", self.scene("angle_deg = [1]", ground=ground), "--angle", "20", "--format", "json")
            durations = [impact["duration"] for impact in json.loads(done.stdout)["impacts"]]
            table = run("simulate", self.scene("angle_deg = [1]", ground=ground), "--angle", "20", "--format", "markdown").stdout
            lines = [line.split("|")[1:-1] for line in table.splitlines() if line.startswith("|")]
            place = [cell.strip() for cell in lines[0]].index("contact [s]")
            shown = [float(line[place]) for line in lines[2:]]
            self.assertEqual(len(shown), len(durations))
            for one, exact in zip(shown, durations):
                self.assertGreater(one, 0)
                self.assertAlmostEqual(one / exact, 1, delta=0.01)


@unittest.skipUnless(shutil.which("gnuplot"), "pictures need gnuplot")
class Pictures(WithScenes):
    def test_the_picture_of_a_sweep_has_a_curve_for_each_impact(self):
        picture = os.path.join(self.folder, "sweep.svg")
        done = run("simulate", self.scene("angle_deg = [5, 10, 15]"), "--plot", picture, "--plot-script")
        self.assertEqual(done.returncode, 0, done.stderr)
        with open(picture.replace(".svg", ".gnuplot"), encoding="utf-8") as file:
            text = file.read()
        self.assertIn("title 'normal impulse, Pₙ, impact 1'", text)
        self.assertEqual(text.count("title 'impact 2'"), 4)  # in each of the panels

    def test_a_window_cuts_the_picture_to_its_times(self):
        picture = os.path.join(self.folder, "run.svg")
        for command in (["sequence", "--angle", "10", "--gravity", "9.81", "--impacts", "6"], ["simulate", "phone-damped"]):
            with self.subTest(command=command[0]):
                done = run(*command, "--plot", picture, "--plot-script", "--window", "0.01:0.02")
                self.assertEqual(done.returncode, 0, done.stderr)
                with open(picture.replace(".svg", ".gnuplot"), encoding="utf-8") as file:
                    script = file.read()
                self.assertIn("set xrange [0.01:0.02]", script)
                blocks = re.findall(r"^\$panel1_\d << END\n(.*?)^END", script, re.S | re.M)
                self.assertEqual(len(blocks), 2)
                for block in blocks:
                    times = [float(line.split()[0]) for line in block.splitlines() if not line.startswith("#")]
                    self.assertGreater(len(times), 3)
                    self.assertEqual((times[0], times[-1]), (0.01, 0.02))  # curves reach the frame

    def test_a_window_without_a_sample_is_refused(self):
        picture = os.path.join(self.folder, "run.svg")
        for command in (["sequence", "--angle", "10"], ["sequence", "phone-corner"], ["simulate", "phone-damped", "--impacts", "1"]):
            done = run(*command, "--plot", picture, "--window", "500:600")
            self.assertEqual((done.returncode, done.stdout), (2, ""), done.stderr)
            self.assertRegex(done.stderr, r"\Aclatter: --window 500:600: must hold times[^\n]+\n\Z")
            self.assertFalse(os.path.exists(picture))


class Windows(unittest.TestCase):
    def test_a_window_cuts_the_history_to_its_times_and_changes_no_sample(self):
        with tempfile.TemporaryDirectory() as folder:
            whole, part = os.path.join(folder, "whole.csv"), os.path.join(folder, "part.csv")
            command = ["simulate", "phone-damped", "--impacts", "2", "--history"]
            self.assertEqual(run(*command, whole).returncode, 0)
            self.assertEqual(run(*command, part, "--window", "0.001:0.01").returncode, 0)
            with open(whole, encoding="utf-8") as file:
                rows = records(file.read())
            with open(part, encoding="utf-8") as file:
                cut = records(file.read())
        expected = [row for row in rows if 0.001 <= float(row["t"]) <= 0.01]
        self.assertEqual(cut, expected)
        self.assertTrue(0 < len(cut) < len(rows))

    def test_a_window_that_is_none_or_has_nothing_to_act_on_is_refused(self):
        for words in (["--window", "1"], ["--window", "2:1", "--plot", "x.svg"], ["--window", "a:b", "--plot", "x.svg"],
                      ["--window", "0:nan", "--plot", "x.svg"], ["--window", "1:1", "--plot", "x.svg"], ["--window", "0:1"]):
            for command in (["simulate", "phone-damped"], ["sequence", "--angle", "10"]):
                with self.subTest(command=command[0], words=words):
                    done = run(*command, *words)
                    self.assertEqual((done.returncode, done.stdout), (2, ""))
                    self.assertTrue(done.stderr.startswith("clatter: --window "), done.stderr)
                    self.assertEqual(done.stderr.count("\n"), 1)
        swept = run("simulate", "phone-sweep", "--window", "0:1", "--plot", "x.svg")
        self.assertEqual(swept.returncode, 2)
