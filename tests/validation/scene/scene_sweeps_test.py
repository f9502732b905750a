# SPDX-License-Identifier: GPL-3.0-or-later
"""[sweep] of scene files: lists, grids by count and ratio, every impact shown; windows of pictures and histories."""

import re

from run_folder import EmptyFolder, json_of, printed, rows_of

SCENE = ("[drop]\nspeed = 1\n{drop}\n[world]\ngravity = 9.81\n[body]\nshape = 'rod'\nradius = 0.01\nmesh = {{ sectors = 4, rings = 1, layers = 1 }}\n"
         "[ground]\nstiffness = 1e9\n{ground}\n[run]\nimpacts = 2\ndigits = 4\n[sweep]\n{sweep}\n")


class Sweeps(EmptyFolder):
    def scene(self, sweep, drop="", ground=""):
        return self.write("scene.toml", SCENE.format(sweep=sweep, drop=drop, ground=ground))

    def swept(self, *scene, **parts):
        return json_of("simulate", self.scene(*scene, **parts))

    def columns(self, *arguments):
        """Names and cells of a table of simulate, line by line."""
        lines = [[cell.strip() for cell in line.split("|")[1:-1]] for line in printed("simulate", *arguments, "--format", "markdown").splitlines()
                 if line.startswith("|")]
        return [name.split(" [")[0].strip() for name in lines[0]], lines[2:]

    def test_a_list_is_swept_value_by_value_in_its_order(self):
        data = self.swept("angle_deg = [30, 5, 10.5]")
        self.assertEqual([one["angle_deg"] for one in data["runs"]], [30, 5, 10.5])
        self.assertEqual(data["scene"]["sweep"], {"angle_deg": [30, 5, 10.5]})
        for one in data["runs"]:
            single = json_of("simulate", self.scene("angle_deg = [1]"), "--angle", str(one["angle_deg"]))
            self.assertEqual(one["impacts"], single["impacts"])
            self.assertNotIn("sweep", single["scene"])

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

    def test_what_is_no_sweep_is_refused_in_one_line_with_its_place(self):
        for sweep, words in (("[]", "a list of numbers"), ("[10, 900]", "a list of numbers, each"), ("5", "a list of numbers"), ('"5:10:1"', "a list of numbers"),
                             ("{ from = 1, to = 5 }", "from, to and step or count"), ("{ from = 1, to = 5, step = 1, count = 3 }", "excludes"),
                             ("{ from = 1, to = 5, count = 1 }", "a whole number from 2"),
                             ('{ from = 1, to = 5, step = 1, scale = "log" }', "left out with step"),
                             ('{ from = 0, to = 5, count = 3, scale = "log" }', "greater than 0"),
                             ('{ from = 1, to = 5, count = 3, scale = "lin" }', "did you mean linear"),
                             ("{ from = 1, to = 5, numbers = 3 }", "unknown key"), ("[1]\nsliding_friction = [0.1]", "only one quantity")):
            with self.subTest(sweep=sweep):
                self.scene("angle_deg = " + sweep)
                self.assertIn("scene.toml", self.refused(words, "simulate", "scene.toml"))

    def test_the_table_of_a_sweep_shows_every_impact_of_every_value(self):
        path = self.scene("angle_deg = [5, 10, 70]")
        rows, (names, shown) = rows_of("simulate", path), self.columns(path)
        self.assertGreater(len(rows), 3)
        self.assertEqual([row[1] for row in shown], [row["n"] for row in rows])
        self.assertEqual([float(row[0]) for row in shown if row[0]], [5, 10, 70])  # once each
        for row, cells in zip(rows, shown):
            self.assertAlmostEqual(float(cells[names.index("Pₙ")]) / float(row["impulse_normal"]), 1, delta=1e-2)

    def test_tables_of_simulate_show_how_long_each_contact_takes(self):
        for ground in ("", "sliding_friction = 0.3\nstatic_friction = 0.3"):
            drop = (self.scene("angle_deg = [1]", ground=ground), "--angle", "20")
            names, shown = self.columns(*drop)
            for cells, impact in zip(shown, json_of("simulate", *drop)["impacts"], strict=True):
                self.assertAlmostEqual(float(cells[names.index("contact")]) / impact["duration"], 1, delta=0.01)

    def test_the_picture_of_a_sweep_has_a_curve_for_each_impact(self):
        printed("simulate", self.scene("angle_deg = [5, 10, 15]"), "--plot", self.path("sweep.svg"), "--plot-script")
        script = self.read("sweep.gnuplot")
        self.assertIn("title 'normal impulse, Pₙ, impact 1'", script)
        self.assertEqual(script.count("title 'impact 2'"), 4)  # in each of the panels

    def test_a_window_cuts_the_picture_to_its_times(self):
        for command in (["sequence", "--angle", "10", "--gravity", "9.81", "--impacts", "6"], ["simulate", "phone-damped"]):
            with self.subTest(command=command[0]):
                printed(*command, "--plot", self.path("run.svg"), "--plot-script", "--window", "0.01:0.02")
                script = self.read("run.gnuplot")
                self.assertIn("set xrange [0.01:0.02]", script)
                blocks = re.findall(r"^\$panel1_\d << END\n(.*?)^END", script, re.S | re.M)
                self.assertEqual(len(blocks), 2)
                for block in blocks:
                    times = [float(line.split()[0]) for line in block.splitlines() if not line.startswith("#")]
                    self.assertGreater(len(times), 3)
                    self.assertEqual((times[0], times[-1]), (0.01, 0.02))  # curves reach the frame

    def test_a_window_cuts_the_history_to_its_times_and_changes_no_sample(self):
        for name, window in (("whole.csv", []), ("part.csv", ["--window", "0.001:0.01"])):
            printed("simulate", "phone-damped", "--impacts", "2", "--history", self.path(name), *window)
        rows, cut = self.records("whole.csv"), self.records("part.csv")
        self.assertEqual(cut, [row for row in rows if 0.001 <= float(row["t"]) <= 0.01])
        self.assertTrue(0 < len(cut) < len(rows))

    def test_a_window_that_is_none_or_has_nothing_to_act_on_is_refused(self):
        for command in ("simulate phone-damped", "sequence --angle 10"):
            self.each_refused({f"{command} --window {words}": "--window " for words in (
                "1", "2:1 --plot x.svg", "a:b --plot x.svg", "0:nan --plot x.svg", "1:1 --plot x.svg", "0:1")})
        self.each_refused({f"{command} --plot x.svg --window 500:600": "--window 500:600: must hold times" for command in (
            "sequence --angle 10", "sequence phone-corner", "simulate phone-damped --impacts 1")})
        self.refused("--window", "simulate", "phone-sweep", "--window", "0:1", "--plot", "x.svg")
