# SPDX-License-Identifier: GPL-3.0-or-later
"""--plot and --plot-script: the pictures, the scripts that draw them, and what is refused."""

import collections
import itertools
import json
import math
import os
import re
import shutil
import struct
import subprocess
import xml.etree.ElementTree as ElementTree
from pathlib import Path

from run_folder import EmptyFolder, case, json_of, records, run

# A level face whose small tilts have four outcomes.
FACE = ["--body", "box", "--size", "0.1514x0.08958x0.1433", "--mass", "0.584", "--velocity=0,0,-1",
        "--attitude=-0.5868253197351159,0,0,0.8097135568321546", "--angular-velocity=20.31,-4.001,-25.12", "--restitution", "0.4",
        "--gravity", "9.81", "--impacts", "1"]
# For each command: arguments, axis names, legends.
COMMANDS = {
    "sequence": (["sequence", "--angle", "10", "--gravity", "9.81", "--restitution", "0.8", "--impacts", "20"],
                 ["time since the first impact [s]", "lowest point [m]", "normal impulse [N·s]"], ["end a", "end b", "at end a", "at end b"]),
    "sequence, tilts": (["sequence", *FACE], ["time since the first impact [s]", "height [m]", "small tilts"],
                        ["centre of mass", "lowest point", "corners"]),
    "angles": (["angles", "--step", "2"], ["contact angle θ of the first impact [°]", "contact angle [°]", "normal impulse [m|vₙ|]"],
               ["β, second impact", "γ, third impact", "P₁", "P₂", "P₃"]),
    "regimes": (["angles", "--regimes", "--over", "restitution"], ["coefficient of restitution e", "contact angle θ of the first impact [°]"],
                ["at least one", "at least two", "three impacts", "θ₂", "θ₃"]),
    "simulate": (["simulate", case("phone-damped"), "--impacts", "3"],
                 ["time since the first touch-down [s]", "height [m]", "force [N]", "energy [J]"],
                 ["mass centre", "lowest point", "normal contact force", "translation", "rotation", "potential", "ground", "total"]),
    "simulate, swept": (["simulate", case("rod-friction-sweep")],
                        ["friction coefficient μ", "velocity [m/s]", "Ω [rad/s]", "impulse [N·s]", "energy [J]"],
                        ["normal velocity after the impact, Vₙ", "angular velocity after the impact, Ω", "normal impulse, Pₙ", "energy lost"]),
    "compare": (["compare", case("rod-10"), "--radius", "0.01"], ["number of the impact", "normal impulse [N·s]", "largest deviation, relative"],
                ["discrete", "continuous", "limit on stiff ground", "|continuous − discrete|", "predicted size", "|limit − discrete|"]),
    "compare, swept": (["compare", case("rod-friction-sweep")],
                       ["friction coefficient μ", "normal impulse [N·s]", "largest deviation, relative"],
                       ["discrete", "continuous", "limit on stiff ground", "|continuous − discrete|"]),
    "tradeoff": (["plan", "--tradeoff", case("rod-45")], ["cost [ms]", "largest true error, relative"],
                 ["closed form", "discrete", "planar rk8pd", "spatial, all methods"]),
    "plan": (["plan", case("rod-45"), "--digits", "5", "--within", "500"],
             ["predicted cost [ms]", "predicted error, relative"], ["asked: 5 digits", "within 500 ms"]),
}
FOLD_2, BETA_AT_FOLD_2 = 58.488442288312, 86.701384197437  # [°] of the thin rod: cos β = K where f = 0
FOLD_3 = 27.577809606636
QUICK = [name for name in COMMANDS if name not in ("tradeoff", "plan")]  # which print what they have measured


def blocks(script):
    """The data blocks of a script: name -> rows of numbers."""
    found = {}
    for name, body in re.findall(r"^\$(\w+) << END\n(.*?)^END$", script, re.M | re.S):
        lines = [line for line in body.splitlines() if line and not line.startswith("#")]
        found[name] = [[float(word) for word in line.split()] for line in lines]
    return found


class InFolder(EmptyFolder):
    def plotted(self, *arguments, status=0):
        """What a run prints, and the data that its script draws."""
        done = run(*arguments, "--plot", self.path("p.svg"), "--plot-script")
        self.assertEqual(done.returncode, status, done.stderr)
        return done.stdout, blocks(self.read("p.gnuplot"))

    def plotted_data(self, *arguments, **options):
        text, drawn = self.plotted(*arguments, "--format", "json", **options)
        return json.loads(text), drawn


class Pictures(InFolder):
    def test_svg_has_axes_units_and_legends_its_script_draws_it_again_and_png_is_of_a_sensible_size(self):
        for name, (arguments, axes, legends) in COMMANDS.items():
            with self.subTest(name):
                self.plotted(*arguments)
                root = ElementTree.fromstring(self.read("p.svg"))
                texts = ["".join(text.itertext()).strip() for text in root.iter("{http://www.w3.org/2000/svg}text")]
                for words in axes + legends:
                    self.assertIn(words, texts)
                script = self.read("p.gnuplot")
                self.assertRegex(script, r"\A# clatter \d+\.\d+\.\d+, " + arguments[arguments[1] in ("--regimes", "--tradeoff")].lstrip("-"))
                if name == "simulate":
                    self.assertEqual(json.loads(re.search(r"(?m)^# scene: (.*)", script)[1])["run"]["impacts"], 3)
                again = self.path("again")
                shutil.rmtree(again, ignore_errors=True)
                os.mkdir(again)
                shutil.copy(self.path("p.gnuplot"), again)
                drawn = subprocess.run(["gnuplot", "p.gnuplot"], cwd=again, capture_output=True, text=True)
                self.assertEqual((drawn.returncode, drawn.stdout, drawn.stderr), (0, "", ""))
                self.assertEqual(self.read("again/p.svg"), self.read("p.svg"))
                if name in QUICK:
                    self.assertEqual(run(*arguments, "--plot", self.path("p.png")).returncode, 0)
                    picture = self.bytes("p.png")
                    width, height = struct.unpack(">II", picture[16:24])
                    self.assertEqual((picture[:8], picture[-8:-4], width), (b"\x89PNG\r\n\x1a\n", b"IEND", 1120))
                    self.assertTrue(500 < height < 1600 and len(picture) > 20000, height)

    def test_the_ring_of_tilts_gives_each_outcome_its_share_of_the_circle(self):
        told, data = self.plotted_data("sequence", *FACE)
        shares = [outcome["share"] for outcome in told["impacts"][0]["outcomes"]]
        self.assertEqual(len(shares), 4)
        script = self.read("p.gnuplot")
        for number, share in enumerate(shares):
            body = re.search(r"^\$panel3_%d << END\n(.*?)^END$" % number, script, re.M | re.S)[1]
            outlines = [[tuple(map(float, line.split())) for line in part.splitlines() if not line.startswith("#")]
                        for part in re.split(r"\n\n", body)]
            area = sum((a[0] * b[1] - a[1] * b[0]) / 2 for part in outlines for a, b in zip(part, part[1:] + part[:1]))
            ring = share * math.pi * (1 - 0.62**2)
            self.assertAlmostEqual(abs(area) / ring, 1, delta=2e-3)  # chords of two degrees
            self.assertIn("title '%s %%:" % format(100 * share, ".2g"), script)
        self.assertEqual(len(data["panel3_4"]), 4)

    def test_standard_output_is_the_same_with_and_without(self):
        for name, form in itertools.product(QUICK, ("table", "csv", "json")):
            arguments = [*COMMANDS[name][0], "--format", form]
            plain = run(*arguments)
            self.assertEqual(run(*arguments, "--plot", self.path("p.svg")).stdout, plain.stdout, (name, form))

    def test_names_are_quoted(self):
        name = "it's `touch x` $HOME"
        done = run("sequence", "--angle", "10", "--plot", self.path(name + ".svg"), "--plot-script")
        self.assertEqual(done.returncode, 0, done.stderr)
        first = self.read(name + ".svg")
        os.remove(self.path(name + ".svg"))
        subprocess.run(["gnuplot", name + ".gnuplot"], cwd=self.folder, check=True)
        self.assertEqual(self.read(name + ".svg"), first)
        self.assertEqual(sorted(os.listdir(self.folder)), [name + ".gnuplot", name + ".svg"])

    def test_a_single_row_gives_a_picture(self):
        for arguments in (["angles", "--from", "10", "--to", "10"], ["sequence", "--angle", "70"],
                          ["angles", "--regimes", "--from", "0.1", "--to", "0.1", "--count", "1"], ["sequence", "--angle", "0"],
                          ["angles", "--regimes", "--from", "0", "--to", "0", "--count", "1"], ["compare", case("rod-45")],
                          ["simulate", case("rod-45")], ["sequence", "--angle", "90", "--restitution", "0"]):
            done = run(*arguments, "--plot", self.path("p.svg"))
            self.assertEqual((done.returncode, done.stderr), (0, ""), arguments)
            ElementTree.fromstring(self.read("p.svg"))


# What is drawn of the rows of CSV: for each block x, y and which rows.
DRAWN = [
    (COMMANDS["sequence"][0], {f"panel2_{i}": ("start", "impulse_normal", {"end": end}) for i, end in enumerate("ab")}),
    (COMMANDS["angles"][0], {block: ("theta_deg", column, {}) for block, column in (
        ("panel1_1", "beta_deg"), ("panel1_3", "gamma_deg"), ("panel2_1", "P1"), ("panel2_3", "P2"), ("panel2_5", "P3"))}),
    (["angles", "--step", "5", "--gravity-number", "0.5", "--as-printed"], {f"panel1_{2 * i + 1}": ("theta_deg", column, {}) for i, column in
                                                                            enumerate(("beta_deg", "beta_printed_deg", "beta_printed_negative_g_deg"))}),
    (["sweep", case("phone-damped"), "--model", "discrete", "--set", "drop.angle_deg=10:40:10"],
     {f"panel{i + 1}_0": ("drop.angle_deg", column, {}) for i, column in enumerate(("impacts", "total_normal_impulse", "energy_loss"))}),
    (COMMANDS["simulate, swept"][0], {f"panel{i + 1}_0": ("sliding_friction", column, {"n": "1"}) for i, column in
                                      enumerate(("velocity_after_z", "angular_velocity_after_y", "impulse_normal", "energy_loss"))}),
    *((COMMANDS[name][0], {f"panel1_{i}": (x, column, {"quantity": "impulse_normal", **more}) for i, column in
                           enumerate(("discrete", "continuous", "limit"))}) for name, x, more in
      (("compare", "n", {}), ("compare, swept", "sliding_friction", {"n": "1"}))),
]


UNIFORM = ("sweep", case("phone-corner"), "--set", "drop.attitude=uniform", "--model", "discrete")


class Data(InFolder):
    def test_commands_draw_the_rows_that_they_print(self):
        for command, blocks_of in DRAWN:
            out, drawn = self.plotted(*command, "--format", "csv")
            for block, (x, y, wanted) in blocks_of.items():
                rows = [row for row in records(out) if row[y] and all(row[name] == value for name, value in wanted.items())]
                with self.subTest(command=command, block=block):
                    self.assertGreater(len(rows), 2)
                    self.assertEqual(drawn[block], [[float(row[x]), float(row[y])] for row in rows])

    def test_sequence_draws_ends_that_touch_the_ground_at_their_impacts_only(self):
        told, drawn = self.plotted_data(*COMMANDS["sequence"][0])
        impacts = told["impacts"]
        for block, end in (("panel1_0", "a"), ("panel1_1", "b")):
            times = [i["start"] for i in impacts if i["end"] == end]
            down = {t for t, height in drawn[block] if abs(height) < 1e-12 and t <= impacts[-1]["start"]}
            self.assertTrue(set(times) <= down)
            self.assertTrue(all(any(abs(t - s) < 1e-12 for s in times) for t in down))
            self.assertGreater(min(height for _, height in drawn[block]), -1e-8)
        self.assertAlmostEqual(next(height for t, height in drawn["panel1_1"] if t == 0), math.sin(math.radians(10)), delta=1e-15)

    def test_flat_bouncing_is_drawn_as_parabolas_up_to_its_end(self):
        result, drawn = self.plotted_data("sequence", "--angle", "0", "--gravity", "9.81", "--restitution", "0.8", "--impacts", "60")
        first, second = result["impacts"][:2]
        flight = [abs(height - first["velocity_after"][2] * t + 9.81 / 2 * t * t) for t, height in drawn["panel1_0"] if 0 <= t <= second["start"]]
        self.assertTrue(len(flight) >= 60 and max(flight) <= 1e-15)
        self.assertEqual({t for t, _ in drawn["panel1_2"]}, {result["tail"]["end_time"]})
        self.assertEqual(drawn["panel2_3"], [[result["tail"]["end_time"], result["tail"]["impulse_normal"]]])

    def test_two_hundred_accumulating_impacts_stay_a_small_picture(self):
        self.plotted("sequence", "--angle", "10", "--gravity", "9.81", "--restitution", "0.8", "--impacts", "200")
        self.assertLess(os.path.getsize(self.path("p.svg")), 300_000)

    def test_curves_of_angles_go_on_to_their_folds_however_far_apart_the_rows_are(self):
        for step in ("2", "10"):
            _, drawn = self.plotted("angles", "--step", step)
            for block, fold, end in (("panel1_0", FOLD_2, BETA_AT_FOLD_2), ("panel1_2", FOLD_3, None)):
                theta, angle = drawn[block][-1]
                self.assertTrue(fold - 1e-6 < theta <= fold, theta)
                # Like a square root at the fold: 1e-6 before it the angle is still some hundredths of a degree short.
                self.assertTrue(end is None or end - 0.05 < angle < end + 1e-3, angle)
                thetas = [point[0] for point in drawn[block]]
                self.assertLess(max(b - a for a, b in zip(thetas, thetas[1:])), 0.2)

    def test_of_very_many_angles_some_thousand_are_drawn_and_the_ends_of_branches_stay(self):
        out, drawn = self.plotted("angles", "--count", "100001", "--gravity-number", "0.5", "--format", "csv")
        rows = [(float(row["theta_deg"]), row) for row in records(out)]
        for block, column in (("panel1_0", "beta_deg"), ("panel1_1", "gamma_deg")):
            self.assertTrue(200 < len(drawn[block]) < 5000)
            lasts = [i for i in range(1, len(rows) - 1) if rows[i][1][column] and not rows[i + 1][1][column]]
            self.assertGreater(len(lasts), 0)
            shown = [point[0] for point in drawn[block]]
            for i in lasts:
                self.assertTrue(any(rows[i][0] - 1e-9 <= theta < rows[i + 1][0] for theta in shown), rows[i][0])

    def test_regimes_draws_the_boundaries_that_it_prints(self):
        told, drawn = self.plotted_data(*COMMANDS["regimes"][0])
        for block, boundary in (("panel1_4", "second"), ("panel1_6", "third")):
            self.assertEqual(drawn[block], [[row["restitution"], row[boundary]["theta_deg"]] for row in told["rows"]])
        # Between them the curve is that of many values, which is no straight line.
        self.assertGreater(len(drawn["panel1_3"]), 200)
        for value, angle in drawn["panel1_3"][::40]:
            row = json_of("angles", "--regimes", "--over", "restitution", "--from", repr(value), "--to", repr(value), "--count", "1")["rows"][0]
            self.assertAlmostEqual(angle, row["second"]["theta_deg"], 9)
        self.assertEqual([point[0] for point in drawn["panel1_1"]], [point[0] for point in drawn["panel1_3"]])

    def test_gravity_numbers_over_decades_get_a_logarithmic_axis(self):
        for more, is_logarithmic, leaves_out_0 in (("", True, True), ("--from 0 --to 1 --step 0.25", False, False),
                                                   ("--over restitution --from 0.5 --to 1 --count 5 --log", True, False)):
            self.plotted("angles", "--regimes", *more.split())
            script = self.read("p.gnuplot")
            self.assertEqual(("\nset logscale x" in script, "0 lies off this axis" in script), (is_logarithmic, leaves_out_0), more)

    def test_simulate_draws_the_history_that_it_writes_beside_it(self):
        _, drawn = self.plotted(*COMMANDS["simulate"][0], "--history", self.path("h.csv"))
        energies = ("translation", "rotation", "potential", "ground", "total")
        history = [row for row in self.records("h.csv") if float(row["t"]) >= 0]
        for block, column in (("panel1_0", "z"), ("panel2_0", "fz"), *((f"panel3_{k}", f"energy_{name}") for k, name in enumerate(energies))):
            self.assertEqual(drawn[block], [[float(row["t"]), float(row[column])] for row in history])
        self.assertLess(abs(drawn["panel1_1"][0][1]), 1e-12)  # it touches
        for (_, centre), (_, lowest) in zip(drawn["panel1_0"], drawn["panel1_1"]):
            self.assertTrue(0.0095 <= centre - lowest <= 0.0576, (centre, lowest))  # between half thickness and radius

    def test_blows_that_look_like_one_spike_have_a_panel_of_their_own(self):
        told, drawn = self.plotted_data(*COMMANDS["simulate"][0])
        first, second = told["impacts"][:2]
        times, forces = zip(*drawn["panel4_0"])
        self.assertLess(times[0], first["start"] + first["peak_time"])
        self.assertTrue(second["start"] < times[-1] < second["start"] + 2 * second["duration"])
        self.assertLessEqual({first["peak_force"], second["peak_force"]}, set(forces))
        self.assertNotIn("panel4_0", self.plotted("simulate", case("rod-45"))[1])  # one blow

    def test_a_sweep_over_two_keys_has_a_curve_for_each_value_of_the_first_or_of_that_with_few(self):
        restitution = ("--set", "impact.restitution=0.5,0.9")
        for settings in ((*restitution, "--set", "drop.angle_deg=10:40:10"), ("--set", "drop.angle_deg=10:34:2", *restitution)):
            out, drawn = self.plotted("sweep", case("rod-10"), "--model", "discrete", *settings)
            for i, value in enumerate(("0.5", "0.9")):
                self.assertIn(f"'restitution = {value}'", self.read("p.gnuplot"))
                self.assertEqual(drawn[f"panel2_{i}"], [[float(row["drop.angle_deg"]), float(row["total_normal_impulse"])]
                                                        for row in records(out) if row["impact.restitution"] == value])

    def test_a_sweep_over_two_keys_of_many_values_has_a_cell_for_each_scene_in_the_colour_of_its_number(self):
        out, drawn = self.plotted("sweep", case("rod-10"), "--model", "discrete", "--set", "drop.angle_deg=5:49:4", "--set",
                                  "impact.restitution=0.1:0.9:0.08", "--columns", "impulse_normal_1")
        cells = [(float(row["impact.restitution"]), float(row["drop.angle_deg"]), float(row["impulse_normal_1"])) for row in records(out)]
        seen, last = [], 0
        for fifth in range(5):
            corners = drawn[f"panel1_{fifth}"]
            self.assertEqual(len(corners) % 4, 0)
            middles = [[sum(corner[i] for corner in corners[k:k + 4]) / 4 for i in (0, 1)] for k in range(0, len(corners), 4)]
            own = sorted(value for e, angle, value in cells if any(abs(e - x) + abs(angle - y) < 1e-9 for x, y in middles))
            self.assertEqual(len(own), len(middles))
            self.assertGreaterEqual(own[0], last)
            seen, last = seen + own, own[-1]
        self.assertEqual(len(seen), len(cells))
        self.assertIn("set xlabel 'restitution; colour: impulse normal 1 [N·s]'", self.read("p.gnuplot"))

    def test_columns_of_texts_are_not_drawn(self):
        _, drawn = self.plotted(*UNIFORM, "--random", "9", "--columns", "hardest_corners,hardest")
        self.assertEqual(sum(bar[2] for bar in drawn["panel2_0"][::2]), 9)
        self.assertNotIn("panel3_0", drawn)

    def test_each_of_few_whole_numbers_has_its_colour_on_the_map_of_attitudes(self):
        out, drawn = self.plotted(*UNIFORM, "--random", "60", "--set", "run.impacts=20", "--columns", "hardest")
        counts = collections.Counter(int(row["hardest"]) for row in records(out))
        self.assertGreater(len(counts), 2)
        self.assertEqual([len(drawn[f"panel1_{i + 1}"]) for i in range(len(counts))], [counts[n] for n in sorted(counts)])
        self.assertEqual(re.findall(r"\$panel1_[1-9]\d* .* title '(.*?)'", self.read("p.gnuplot")), [str(n) for n in sorted(counts)])

    def test_where_no_drop_has_a_number_the_picture_says_so(self):
        self.plotted("sweep", case("rod-10"), "--model", "discrete", "--set", "drop.angle_deg=5:20", "--random", "9",
                     "--set", "run.impacts=6", "--columns", "impulse_normal_6")
        self.assertIn("no number to draw here", self.read("p.svg"))

    def test_random_drops_stand_in_a_histogram_and_on_an_equal_area_map_where_they_point_down(self):
        out, drawn = self.plotted(*UNIFORM, "--random", "50", "--columns", "impulse_normal_1")
        values = [float(row["impulse_normal_1"]) for row in records(out) if row["impulse_normal_1"]]
        bars = drawn["panel2_0"]
        self.assertEqual((bars[0][0], round(bars[-1][0], 12)), (min(values), round(max(values), 12)))
        self.assertEqual(sum(bar[2] for bar in bars[::2]), len(values))
        below = ElementTree.fromstring(self.read("p.svg")).find(".//{*}g[@id='clatter_plot_1b']")  # as wide as any panel
        numbers = [float(x) for x in re.findall(r"(-?[\d.]+),-?[\d.]+", "".join(ElementTree.tostring(below, "unicode")))]
        self.assertGreater(max(numbers) - min(numbers), 500)
        seen = []
        for fifth in range(5):
            for x, y in drawn[f"panel1_{fifth + 1}"]:
                theta = math.asin(y / math.sqrt(2))  # of Mollweide's map, here taken back
                latitude = math.asin((2 * theta + math.sin(2 * theta)) / math.pi)
                longitude = math.pi * x / (2 * math.sqrt(2) * math.cos(theta))
                seen.append((math.cos(latitude) * math.cos(longitude), math.cos(latitude) * math.sin(longitude), math.sin(latitude), fifth))
        rows = sorted(records(out), key=lambda row: float(row["impulse_normal_1"]))
        self.assertEqual(len(seen), len(rows))
        for rank, row in enumerate(rows):
            a, b, c, d = (float(row[f"drop.attitude_q{i}"]) for i in range(4))
            down = (-2 * (b * d - a * c), -2 * (c * d + a * b), -(a * a - b * b - c * c + d * d))  # minus the last row of the rotation
            nearest = min(seen, key=lambda point: math.dist(point[:3], down))
            self.assertLess(math.dist(nearest[:3], down), 1e-9)
            self.assertEqual(nearest[3], rank // 10)

    def test_a_long_history_is_thinned_and_keeps_its_peaks(self):
        told, drawn = self.plotted_data("simulate", case("rod-10"), "--method", "tvd-rk3", "--step", "2e-7", "--history", self.path("h.csv"))
        history = [(float(row["t"]), float(row["fz"])) for row in self.records("h.csv")]
        peaks = [(i["start"] + i["peak_time"], i["peak_force"]) for i in told["impacts"]]
        shown = [tuple(point) for point in drawn["panel2_0"]]
        self.assertGreater(len(history), 10_000)
        self.assertLess(len(shown), 5000)
        self.assertTrue(set(shown) <= set(history) | set(peaks))
        self.assertTrue(set(peaks) <= set(shown))
        self.assertEqual((shown[0], shown[-1]), (history[0], history[-1]))

    def test_compare_draws_deviations_of_the_size_of_those_that_it_prints(self):
        told, drawn = self.plotted_data(*COMMANDS["compare"][0])
        # Scales of the numbers: time and speed at large (1 m/s falls, nothing is faster but an end), mass 1 kg, 1 radian.
        for k, (n, deviation), (_, miss) in zip(told["impacts"], drawn["panel2_0"], drawn["panel2_2"]):
            self.assertEqual(k["n"], n)
            impulse = abs(k["numbers"]["impulse_normal"]["deviation"])
            self.assertGreaterEqual(deviation, impulse / 2)
            self.assertLess(deviation, 0.1)
            self.assertLess(miss, 1e-6)

    def test_tradeoff_draws_the_points_that_it_prints(self):
        told, drawn = self.plotted_data(*COMMANDS["tradeoff"][0])
        expected = sorted((1e3 * p["seconds"], p["error"]) for p in told["points"] if not p["failure"] and not p["mesh"] and p["error"] > 0)
        self.assertGreater(len(expected), 80)
        self.assertEqual(sorted(tuple(point) for rows in drawn.values() for point in rows), expected)

    def test_plan_draws_the_models_that_it_weighed_and_what_is_asked(self):
        told, drawn = self.plotted_data(*COMMANDS["plan"][0])
        expected = [(1e3 * level["seconds"], level["error"]) for level in told["rungs"] if level["error"] and level["seconds"]]
        self.assertGreater(len(expected), 2)
        points = [tuple(rows[0]) for rows in drawn.values() if len(rows) == 1]
        self.assertEqual(sorted(points), sorted(expected))
        lines = [rows for rows in drawn.values() if len(rows) == 2]
        self.assertEqual([[y for _, y in line] for line in lines[:1]], [[1e-5, 1e-5]])
        self.assertEqual([[x for x, _ in line] for line in lines[1:]], [[500, 500]])

    def test_a_score_draws_the_largest_error_of_each_impact(self):
        truth = run("benchmark", "truth", "rod-10", "--format", "csv").stdout
        rows = [line for line in truth.splitlines() if line[0].isdigit()]
        second = rows[1].split(",")
        second[7] = repr(float(second[7]) * (1 + 1e-5))  # Omega
        _, drawn = self.plotted("benchmark", "score", self.write("of_a_code.csv", truth.replace(rows[1], ",".join(second))))
        largest = max(abs(float(row.split(",")[7])) for row in rows)
        self.assertEqual([n for n, _ in drawn["panel1_0"]], [1, 2, 3])
        self.assertGreaterEqual(drawn["panel1_0"][1][1], 1e-5 * abs(float(rows[1].split(",")[7])) / largest * (1 - 1e-9))
        self.assertLess(drawn["panel1_0"][0][1], 1e-15)
        # Of the four limits those that lie among the errors.
        self.assertEqual([drawn[name][0][1] for name in sorted(drawn) if name not in ("panel1_0",)], [1e-9, 1e-6])

    def test_what_is_wrong_is_one_line_and_nothing_is_written(self):
        for arguments, _, _ in COMMANDS.values():
            self.each_refused({**{f"--plot {wrong}": "must end in .svg or .png" for wrong in ("p.pdf", "p", "p.svg.gz", ".svg")},
                               "--plot no/p.svg": "--plot no/p.svg", "--plot-script": "--plot-script: needs --plot",
                               "--plot p.svg --output ./p.svg": "must be another file than --output",
                               "--plot p.svg --plot-script --output p.gnuplot": "must be another file than --output"}, *arguments)
        self.each_refused({more: "--plot" for more in ("--summary", "--rows impact")}, "sweep", "rod-10", "--set", "drop.angle_deg=10,20", "--plot", "p.svg")

    def test_without_gnuplot_the_package_is_named(self):
        os.mkdir(self.path("empty"))
        for (arguments, _, _), picture in itertools.product(COMMANDS.values(), ("p.svg", "p.png")):
            self.refused("install the package gnuplot-nox", *arguments, "--plot", picture, env={**os.environ, "PATH": self.path("empty")})

    def test_a_sequence_in_space_draws_its_impulses_corner_by_corner_above_nothing_below_the_floor(self):
        told, drawn = self.plotted_data("sequence", "phone-corner", "--impacts", "6")
        impacts = told["impacts"]
        sticks = sorted((t, impulse) for name, rows in drawn.items() if name.startswith("panel2") for t, impulse in rows)
        self.assertEqual(sticks, sorted((i["start"], i["impulse_normal"]) for i in impacts))
        centre, lowest = drawn["panel1_0"], drawn["panel1_1"]
        size = max(height for _, height in centre)
        for time in (i["start"] for i in impacts):
            self.assertLess(min(height for t, height in lowest if t == time), 1e-9 * size)
        self.assertTrue(all(0 <= low <= high for (_, low), (_, high) in zip(lowest, centre)))

    def limited(self, name, evaluations):
        text = Path(case(name)).read_text(encoding="utf-8")
        return self.write("scene.toml", text.replace("[run]", f"[run]\nevaluation_limit = {evaluations}"))

    def test_a_run_that_ends_early_draws_its_rows_and_nothing_without_any(self):
        done = run("simulate", self.limited("rod-45", 10), "--method", "rk4", "--tolerance", "1e-6", "--plot", self.path("p.svg"))
        self.assertEqual((done.returncode, os.listdir(self.folder)), (3, ["scene.toml"]), done.stderr)
        self.assertIn("no picture: no impact was computed", done.stderr)
        result, drawn = self.plotted_data("simulate", self.limited("phone-damped", 3000), "--method", "rk8pd", "--tolerance", "1e-8", status=3)
        self.assertEqual(result["outcome"], "evaluation-limit")
        self.assertGreater(len(result["impacts"]), 0)
        for impact in result["impacts"]:  # the contact in which the run ended is drawn, too, but is no row
            nearest = min((force for _, force in drawn["panel2_0"]), key=lambda force: abs(force - impact["peak_force"]))
            self.assertAlmostEqual(nearest, impact["peak_force"], delta=1e-12 * nearest)
