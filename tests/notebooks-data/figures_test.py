# SPDX-License-Identifier: GPL-3.0-or-later
"""The pictures show the program's numbers, with names and units, and their files are the same every time."""

import math
import re
import shutil
import subprocess
import sys
import unittest
from pathlib import Path

import numpy as np
from matplotlib.patches import Polygon
from run_folder import PROGRAM, ROOT, EmptyFolder, records

DATA = Path(ROOT, "notebooks-data")
sys.path.insert(0, str(DATA))

import figures  # noqa: E402: it is in the folder just named
import plotting  # noqa: E402

MODELS = ("", "_continuous")
GRAVITIES = ("", "_G0_1", "_G9_81")
ENERGIES = ["E", "E_kinetic", "E_potential"]
FOLD_BETA = 86.701384197437  # erratum E5


def each(columns, suffixes):
    return [column + suffix for suffix in suffixes for column in columns]


def sources(numbers, suffixes):
    return [[f"{number}_{suffix}" for suffix in suffixes] for number in numbers]


def where(name, value, *columns):
    """Columns of the rows that have this value."""
    return [(column, lambda row: row[name] == value) for column in columns]


# The columns that the panels of each figure show, in order: first all lines, then all points of the continuous model.
COLUMNS = {
    7: [each(["beta"], MODELS)], 9: [each(["P1", "P2"], MODELS)], 10: [each(["beta", "gamma"], MODELS)],
    11: [each([name + gravity for name in ("beta", "gamma") for gravity in GRAVITIES], MODELS)],
    12: [each(["P1"] + [name + gravity for name in ("P2", "P3") for gravity in GRAVITIES], MODELS)],
    14: sources(("Vn", "Omega", "Pn", "loss"), ("thin", "rim", "continuous")),
    15: sources(("Vn", "Omega", "Vt", "Pn", "loss"), ("eq9", "coulomb", "continuous")),
    16: [sum((where("mu", mu, name) for mu in (0.1, 0.3, 0.5, 0.7)), []) for name in ("point_vn", "point_vt", "Fn", "Ft")],
    17: [where("variant", variant, *names) for variant in (1, 2) for names in (["Fn"], ENERGIES)],
    19: [["Fn"], ENERGIES], 20: [["peak_force"], ["start"]], 21: [["Fn"], ENERGIES], 22: [["peak_force"], ["start"]],
    23: [["E", "E_translation", "E_rotation", "E_potential"]],
    24: [lines + where("touches", 1, name) + where("touches", 2, name)
         for name, lines in (("Vn", ["Vn_discrete"]), ("Omega", ["Omega_discrete"]), ("peak_force", []), ("loss", []))],
}


def rows_of(number):
    return [{name: float(cell) if cell else math.nan for name, cell in row.items()}
            for row in records((DATA / "figures" / f"figure_{number:02}.csv").read_text(encoding="utf-8"))]


def finite(values):
    return [value for value in values if math.isfinite(value)]


def drawn_values(axes):
    """y of each curve, or the heights of the bars."""
    if axes.containers:
        return [[bar.get_height() for bar in axes.containers[0]]]
    return [finite(line.get_ydata()) for line in axes.lines]


def line_named(axes, name):
    return next(line for line in axes.lines if line.get_label() == name)


class Drawn(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.all = {name: figures.draw(name) for name in figures.names()}
        cls.charts = {name: figure for name, figure in cls.all.items() if name != "conventions"}  # a drawing, named where it is drawn

    def test_all_figures_with_data_and_the_extra_pictures_are_there(self):
        self.assertEqual(list(self.all), [7, 8, 9, 10, 11, 12, 14, 15, 16, 17, 19, 20, 21, 22, 23, 24, "contact_angles", "conventions", "regimes",
                                          "corner_sequence", "fold", "error_against_cost", "extremes_map"])

    def test_every_axis_of_every_panel_has_a_name_and_a_unit(self):
        """Unless it takes its numbers, and so its name, from the panel beside or below."""
        for name, figure in self.charts.items():
            named = 0
            for axis in (axis for axes in figure.axes for axis in (axes.xaxis, axes.yaxis)):
                if axis.get_major_ticks()[0].label1.get_visible():
                    self.assertRegex(axis.get_label_text(), r"^\S.* \[[^]]+\]$", name)
                    named += 1
            self.assertGreaterEqual(named, 2 * len(figure.axes) if isinstance(name, int) else 2, name)

    def test_every_picture_has_a_legend_that_names_what_each_panel_shows(self):
        for name, figure in self.charts.items():
            common = {text.get_text() for legend in figure.legends for text in legend.get_texts()}
            for axes in figure.axes:
                own = {text.get_text() for text in axes.get_legend().get_texts()} if axes.get_legend() else set()
                self.assertTrue(common | own, name)
                self.assertLessEqual(set(axes.get_legend_handles_labels()[1]), common | own, name)

    def test_curves_are_the_columns_of_the_data(self):
        self.assertEqual(set(COLUMNS), {name for name in self.all if isinstance(name, int)} - {8})
        for number, panels in COLUMNS.items():
            rows = rows_of(number)
            self.assertEqual(len(self.all[number].axes), len(panels), number)
            for axes, columns in zip(self.all[number].axes, panels):
                expected = []
                for column in columns:
                    column, chosen = column if isinstance(column, tuple) else (column, lambda row: True)
                    expected.append(finite(row[column] for row in rows if chosen(row)))
                self.assertEqual(drawn_values(axes), expected, (number, axes.get_ylabel()))

    def test_units_are_those_of_the_head_but_for_milliseconds(self):
        self.assertEqual(self.all[14].axes[1].get_ylabel(), "post-impact Ω [rad/s]")
        self.assertEqual(self.all[9].axes[0].get_ylabel(), "normal impulse P₁, P₂ [m |vₙ|]")
        for number in (16, 23):
            line = self.all[number].axes[0].lines[0]
            self.assertEqual(self.all[number].axes[0].get_xlabel(), "time [ms]")
            self.assertAlmostEqual(line.get_xdata()[1], 1e3 * rows_of(number)[1]["time"], delta=1e-12)

    def test_no_peak_is_left_out_of_the_file(self):
        """Files leave out points that cannot be told apart; the highest point of Fig. 19(a) stays."""
        axes = self.all[19].axes[0]
        text = plotting.svg(self.all[19])
        top = self.all[19].get_figheight() * 72 - axes.transData.transform(
            (0, max(row["Fn"] for row in rows_of(19))))[1] * 72 / self.all[19].dpi
        curve = re.search(r'<path d="([^"]*)"[^>]*stroke: #d55e00', text)[1]
        heights = [float(y) for y in re.findall(r"L [\d.]+ ([\d.]+)", curve)]
        self.assertLess(len(heights), len(rows_of(19)))
        self.assertAlmostEqual(min(heights), top, delta=0.02)

    def test_the_zoom_windows_show_the_first_two_impacts(self):
        for number, windows, ratio in ((19, [1, 0], 2.26), (21, [1, 1], 2.29)):
            self.assertEqual([len(axes.child_axes) for axes in self.all[number].axes], windows, number)
            x, y = (np.asarray(values) for values in self.all[number].axes[0].child_axes[0].lines[0].get_data())
            first, second = y[x < 0.0025].max(), y[x > 0.0025].max()
            self.assertAlmostEqual(second / first, ratio, delta=0.01)
            self.assertEqual(second, max(row["Fn"] for row in rows_of(number)))

    def test_rods_of_figure_8_have_length_1_and_stay_above_the_ground(self):
        for axes in self.all[8].axes:
            rods = [line.get_data() for line in axes.lines  # each is drawn as one line of two ends
                    if line.get_linestyle() == "-" and len(line.get_xdata()) == 2 and line.get_xdata()[0] != 0]
            self.assertEqual(len(rods), 9)
            for x, z in rods:
                self.assertAlmostEqual(math.hypot(x[1] - x[0], z[1] - z[0]), 1, delta=1e-14)
                self.assertGreater(min(z), -1e-15)


class ExtraPictures(unittest.TestCase):
    def test_contact_angles_are_the_data(self):
        axes = figures.draw("contact_angles").axes[0]
        rows = rows_of(11)
        for name, column in (("β, no gravity", "beta"), ("γ, G = 0.1", "gamma_G0_1")):
            self.assertEqual(finite(line_named(axes, name).get_ydata()), finite(row[column] for row in rows))
        self.assertEqual({text.get_text() for text in axes.texts}, {"58.49°", "27.58°", "β = θ = 54.74°"})

    def test_the_phone_stands_on_the_corner_that_strikes(self):
        """No corner of the box as drawn lies below the ground, and the one that strikes lies on it."""
        axes = figures.draw("corner_sequence").axes[0]
        ends = np.concatenate([patch.get_xy() for patch in axes.patches if isinstance(patch, Polygon)])
        struck = np.array([line.get_xydata()[0] for line in axes.lines if line.get_marker() == "o" and len(line.get_xydata())])
        self.assertEqual(len(struck), 3)
        self.assertGreater(ends[:, 1].min(), -1e-9)
        for point in struck:
            self.assertLess(np.hypot(*(ends - point).T).min(), 1e-9)

    def test_the_roots_of_the_fold_are_the_contact_angles(self):
        left, right = figures.draw("fold").axes
        beta = {row["theta"]: row["beta"] for row in rows_of(7)}
        roots = [line.get_xdata()[0] for line in left.lines if len(line.get_xdata()) == 1]
        self.assertEqual(len(roots), 3)
        for root, expected in zip(roots, (beta[56], beta[57.5], FOLD_BETA)):
            self.assertAlmostEqual(root, expected, delta=1e-6)
        trap = line_named(right, "θ = 58.473°: root, no change")
        at_right_angle = np.interp(90, trap.get_xdata(), trap.get_ydata())
        self.assertGreater(at_right_angle, 0)
        self.assertLess(trap.get_ydata().min(), 0)

    def test_costs_have_a_panel_for_each_scene_and_a_line_for_each_method(self):
        figure = figures.draw("error_against_cost")
        rows = records((DATA / "tradeoff.csv").read_text(encoding="utf-8"))
        self.assertEqual([axes.get_title(loc="left") for axes in figure.axes], list(dict.fromkeys(row["scene"] for row in rows)))
        expected = [float(row["error"]) for row in rows if (row["scene"], row["model"], row["method"], row["mesh"]) ==
                    ("rod-45", "planar", "rkck", "") and row["error"]]
        self.assertEqual(list(line_named(figure.axes[1], "rkck").get_ydata()), expected)

    def test_the_map_of_extremes_hatches_what_has_no_number(self):
        rows = records((DATA / "figures" / "extremes.csv").read_text(encoding="utf-8"))
        self.assertLessEqual({row["verdict"] for row in rows}, {"number", "bad-input", "ended-early", "not-computed", "outside-model"})
        for axes in figures.draw("extremes_map").axes:
            own = [row for row in rows if row["model"] == axes.get_title(loc="left")]
            widths = {False: 0, True: 0}
            for strip in axes.collections:
                for path in strip.get_paths():
                    widths[bool(strip.get_hatch())] += path.get_extents().width
            per_axis = {}
            for row in own:
                per_axis.setdefault(row["axis"], []).append(row["verdict"] != "number")
            self.assertAlmostEqual(widths[True], sum(sum(part) / len(part) for part in per_axis.values()), delta=1e-9)
            self.assertAlmostEqual(widths[True] + widths[False], len(per_axis), delta=1e-9)


class Files(EmptyFolder):
    def setUp(self):
        super().setUp()
        self.data = Path(self.path("notebooks-data"))
        shutil.copytree(DATA, self.data, ignore=shutil.ignore_patterns("__pycache__"))

    def figures(self, *arguments):
        return subprocess.run(["/usr/bin/python3", "-B", str(self.data / "figures.py"), *arguments], capture_output=True, text=True)

    def test_files_are_small_text_of_one_kind_without_a_date(self):
        for name in figures.names():
            text = figures.path(name).read_text(encoding="utf-8")
            self.assertLess(len(text.encode()), 60000, name)
            self.assertIn("<text", text)
            self.assertNotIn("date", text)

    def test_a_check_names_the_files_that_differ_and_a_run_mends_them(self):
        picture, data = self.data / "figures" / "figure_07.svg", self.data / "figures" / "regimes_restitution.csv"
        data.unlink()  # written anew, for its last digits are those of the machine that writes them
        self.assertEqual(self.figures(PROGRAM, "--only", "regimes").returncode, 0)
        kept = picture.read_text(encoding="utf-8"), data.read_text(encoding="utf-8")
        picture.write_text(kept[0].replace("86", "87", 1), encoding="utf-8")
        data.write_text(kept[1].replace("58.488", "58.588"), encoding="utf-8")
        run = self.figures(PROGRAM, "--check", "--only", "7", "9", "regimes")
        self.assertEqual((run.returncode, [line.split()[0].removeprefix("notebooks-data/figures/") for line in run.stdout.splitlines()]),
                         (1, ["figure_07.svg", "regimes_restitution.csv", "regimes.svg"]))
        self.assertEqual(self.figures(PROGRAM, "--only", "7", "regimes").returncode, 0)
        self.assertEqual((picture.read_text(encoding="utf-8"), data.read_text(encoding="utf-8")), kept)
        self.assertEqual(self.figures(PROGRAM, "--check", "--only", "7", "regimes").stdout, "")

    def test_bad_arguments_have_one_line_and_status_2_and_a_program_that_fails_3(self):
        for status, *arguments in ((2,), (2, PROGRAM, "--only", "13"), (2, PROGRAM, "--fast"), (2, "/no/such/program", "--only", "regimes"),
                                   (3, "/bin/false", "--only", "regimes")):
            run = self.figures(*arguments)
            self.assertEqual((run.returncode, run.stdout, len(run.stderr.splitlines())), (status, "", 1), run.stderr)
