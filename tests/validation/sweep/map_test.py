# SPDX-License-Identifier: GPL-3.0-or-later
"""`clatter map`: its counts change where the paper's folds are, its pixels are what a sweep has, its picture shows them."""

import colorsys
import math
import os
import re
import shutil
import signal
import subprocess
import unittest
from pathlib import Path

import numpy
from matplotlib.image import imread
from run_folder import MPIRUN, PROGRAM, ROOT, EmptyFolder, records, run

# Of the elastic rod without gravity, to 12 digits by 60-digit bisection.
FOLDS = {2: 58.488442288312, 3: 27.577809606636}
ANGLE = ["--over", "drop.angle_deg=0:60"]
ELASTIC = [*ANGLE, "--over", "drop.speed=1:2"]
BLOCK = "[drop]\nangle_deg = 60\n[body]\nshape = 'box'\nsize = [0.1, 0.05, 0.05]\nmass = 0.3\n[world]\ngravity = 9.81\n[impact]\nfriction = 0.5\n"
FRICTION = [*ANGLE, "--over", "impact.restitution=0.3:0.9", "--set", "impact.friction=0.1", "--set", "run.impacts=4"]

BAD = {
    "": "--over", "--over drop.angle_deg=0:60": "--over: must be given twice",
    "--over drop.angle_deg=0:60 --over impact.restitution=0:1 --samples 3 --quantity impacts=banana": "a number from 1",
    "--over drop.angle_deg=0:60 --over impact.restitution=0:1 --samples 3 --quantity outcome=end": "did you mean ends?",
    "--over drop.angle=0:60 --over drop.speed=1:2": "--over drop.angle: unknown key; did you mean drop.angle_deg?",
    "--over fricton=0:1 --over drop.speed=1:2": "did you mean impact.friction?", "--over xyzzy=0:1 --over drop.speed=1:2": "--over xyzzy: unknown key\n",
    "--over drop.angle_deg=0:60 --over drop.angle_deg=0:60": "twice", "--over drop.angle_deg=60:0 --over drop.speed=1:2": "LOW",
    "--over drop.angle_deg=0:95 --over drop.speed=1:2": "from 0 to 90", "--over drop.angle_deg=5 --over drop.speed=1:2": "KEY=LOW:HIGH",
    "--over drop.speed=1:2 --over world.gravity=1:2": "--angle: required", "no-such-case --over drop.angle_deg=0:60 --over drop.speed=1:2": "no-such-case",
    **{f"--over drop.angle_deg=0:60 --over drop.speed=1:2 {options}": words for options, words in {
        "--size 0x5": "--size", "--size 5": "WIDTHxHEIGHT", "--size 5x": "--size '5x': must be WIDTHxHEIGHT", "--size 5x20001": "from 1 to 20000",
        "--quantity impact": "did you mean impacts?", "--quantity impacts=2": "--samples N", "--samples 5": "must be a class",
        "--quantity ratio=2 --samples 5": "must be a class", "--seed 5": "--samples N", "--set world.gravity=1:2": "--samples N",
        "--threads 0": "--threads"}.items()}}


def expected_count(angle):
    return 3 if angle < FOLDS[3] else 2 if angle < FOLDS[2] else 1


class Map(EmptyFolder):
    def made(self, name, *arguments):
        done = run("map", *arguments, "--output", self.path(name), "--restart")
        self.assertEqual((done.returncode, done.stdout), (0, ""), done.stderr)
        return self.path(name)

    def rows(self, *arguments):
        self.made("map.csv", *arguments)
        return records(self.read("map.csv"))

    def test_the_count_changes_at_the_folds(self):
        rows = self.rows(*ELASTIC, "--size", "240x3")
        self.assertEqual(len(rows), 720)
        for row in rows:
            self.assertEqual(row["impacts"], str(expected_count(float(row["drop.angle_deg"]))), row)
            self.assertEqual(row["open"], "false")

    def test_a_zoom_to_the_fold_shows_it_between_neighbouring_angles(self):
        rows = self.rows("--over", f"drop.angle_deg={FOLDS[2] - 1e-9}:{FOLDS[2] + 1e-9}", "--over", "drop.speed=1:2", "--size", "40x1")
        counts = [row["impacts"] for row in rows]
        self.assertEqual((counts[:18], counts[22:]), (["2"] * 18, ["1"] * 18))

    def test_pixels_are_the_rows_of_a_sweep(self):
        rod, counted = self.write("rod.toml", ""), ["run.impacts=100"]
        for scene, over, given, quantity, column in (
                (rod, [*ANGLE, "--over", "impact.restitution=0.2:1"], counted, "total", "total_normal_impulse"),
                (rod, [*ANGLE, "--over", "impact.impulse_ratio=-0.2:0.2"], counted, "total", "total_normal_impulse"),
                (rod, [*ANGLE, "--over", "world.gravity=0.1:2"], ["run.impacts=3"], "total", "total_normal_impulse"),
                (rod, FRICTION[:4], ["impact.friction=0.1", "run.impacts=4"], "largest", "hardest_impulse_normal"),
                ("phone-corner", ["--over", "drop.height=0.5:2", "--over", "impact.restitution=0.2:0.9"], ["run.impacts=3"], "largest", "hardest_impulse_z")):
            sets = [word for one in given for word in ("--set", one)]
            named = [] if quantity == "total" else ["--columns", column]
            for row in self.rows(*[scene][scene == rod:], *over, *(sets if given != counted else []), "--size", "4x3", "--quantity", quantity):
                with self.subTest(row):
                    own = [word for name in list(row)[:2] for word in ("--set", f"{name}={row[name]}")]
                    alone, = records(run("sweep", "--model", "discrete", scene, *own, *sets, *named).stdout)
                    error = float(alone["total_normal_impulse_error"] or "inf") if quantity == "total" else 0
                    self.assertLessEqual(abs(float(row[quantity]) - float(alone[column])), error)

    def test_the_array_holds_what_the_csv_has(self):
        for quantity, kind in (("impacts", "f"), ("ratio", "f"), ("last_end", "S")):
            rows = self.rows(*ELASTIC, "--size", "30x4", "--quantity", quantity)
            array = numpy.load(self.made("map.npy", *ELASTIC, "--size", "30x4", "--quantity", quantity))
            self.assertEqual((array.shape, array.dtype.kind), ((4, 30), kind))
            texts = [row[quantity] for row in rows]
            found = [value.decode() for value in array.ravel()] if kind == "S" else array.ravel()
            numpy.testing.assert_array_equal(found, texts if kind == "S" else [float(text or "nan") for text in texts])

    def test_the_picture_has_the_classes_colours_and_the_fold_between_them(self):
        image = imread(self.made("map.png", *ELASTIC, "--size", "600x300"))[..., :3]
        palette = re.search(r"classes\{(.*?)\}", text("validation/output/palette.hpp"), re.DOTALL).group(1)
        colours = [tuple(int(text[i:i + 2], 16) for i in (0, 2, 4)) for text in re.findall(r"#(\w{6})", palette)]
        pixels = numpy.rint(image * 255).astype(int)
        row = [tuple(pixel) for pixel in pixels[len(pixels) // 2].tolist()]
        left = round(115 * 0.75)
        for angle in (10, 20, 35, 50):
            self.assertEqual(row[left + round(angle * 10)], colours[expected_count(angle) - 1], angle)
        for fold in FOLDS.values():
            middle = left + round(fold * 10)
            near = pixels[100:200, middle - 1:middle + 2].sum(axis=2)  # some rows: one of the curves is dashed
            self.assertLess(near.min(), 250, f"no dark curve at {fold}")

    def keeping_the_script(self):
        """The environment in which gnuplot leaves what it is told as the file script."""
        fake = self.write("gnuplot", f"#!/bin/sh\ncp \"$2\" {self.path('script')}\nexec {shutil.which('gnuplot')} \"$@\"\n")
        os.chmod(fake, 0o755)
        return {**os.environ, "PATH": f"{self.folder}:{os.environ['PATH']}"}

    def test_pixels_that_are_open_or_have_no_number_are_in_the_legend(self):
        env, block = self.keeping_the_script(), self.write("block.toml", BLOCK)
        for arguments, colour, words in ((["--over", "drop.angle_deg=0:80", "--over", "drop.speed=1:2", "--quantity", "ratio"], "d9d9d9", "no drop, or no number"),
                                         ([block, "--over", "drop.angle_deg=10:80", "--over", "impact.restitution=0.2:1", "--quantity", "rest_face"],
                                          "ff2da0", "left open")):
            done = run("map", *arguments, "--size", "12x4", "--output", self.path("map.png"), "--restart", env=env)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn((colour, words), re.findall(r"lc rgb '#(\w{6})' title '(.*?)'", self.read("script")))
        run("map", *ELASTIC, "--quantity", "total", "--size", "12x4", "--output", self.path("map.png"), "--restart", env=env)
        self.assertNotRegex(self.read("script"), "no number|left open")

    def test_no_word_of_the_title_is_cut(self):
        """The title has as many lines as its words take, and paper beside each."""
        env = self.keeping_the_script()
        for size in ("600x1", "40x30", "1x600", "3x3"):
            with self.subTest(size=size):
                output = self.path("map.png")
                done = run("map", "phone-corner", "--over", "drop.height=0.5:2", "--over", "impact.restitution=0.2:0.9", "--size", size, "--output", output, "--restart",
                           env=env)
                self.assertEqual(done.returncode, 0, done.stderr)
                _, *lines = re.findall(r"set label \d+ '([^']*)' at screen", self.read("script"))
                words = " ".join(lines)
                self.assertTrue(words.startswith("box 0.10566 × 0.04394 × 0.01905 m, 0.08814 kg") and words.endswith("at most 3 impacts, 6 digits"), words)
                self.assertEqual(imread(output)[:, -6:, :3].min(), 1)
                self.assertLess(max(imread(output).shape), 2400)  # also where it is one pixel wide

    def test_samples_give_the_part_of_the_class_with_wilsons_interval(self):
        arguments = ["--over", "drop.speed=1:2", "--over", "body.length=1:2", "--set", "drop.angle_deg=0:60", "--samples", "200",
                     "--quantity", "impacts=3", "--size", "20x10"]
        rows = self.rows(*arguments)
        exact, covered, z = FOLDS[3] / 60, 0, 1.959963984540054
        for row in rows:
            part, low, high = (float(row[name]) for name in ("probability", "low", "high"))
            # The ends are where the part is z standard deviations away.
            for end in (low, high):
                self.assertAlmostEqual(abs(part - end), z * math.sqrt(end * (1 - end) / 200), delta=1e-12)
            covered += low <= exact <= high
        self.assertGreaterEqual(covered, 0.9 * len(rows))
        self.assertLess(covered, len(rows), "no interval misses: they are too wide, or the drops are not random")
        array = numpy.load(self.made("map.npy", *arguments))
        self.assertEqual(array.shape, (3, 10, 20))
        self.assertEqual(array[0].ravel().tolist(), [float(row["probability"]) for row in rows])
        self.assertNotEqual(rows, self.rows(*arguments, "--seed", "2"))

    def test_neither_threads_nor_processes_matter(self):
        arguments = [*FRICTION, "--size", "40x30"]
        for name in ("map.csv", "map.npy"):
            found = {self.bytes(self.made(name, *arguments, "--threads", threads)) for threads in ("1", "3")}
            self.assertEqual(len(found), 1)
        if MPIRUN[0]:  # else a build without MPI
            done = subprocess.run([*MPIRUN, "2", PROGRAM, "map", *arguments, "--output", self.path("shared.npy")], capture_output=True, text=True)
            self.assertEqual((done.returncode, done.stdout), (0, ""), done.stderr)
            self.assertEqual({self.bytes("shared.npy")}, found)

    def test_an_interrupted_map_goes_on_with_the_same_bytes(self):
        arguments = ["map", *FRICTION, "--size", "900x600", "--threads", "1"]
        for name in ("map.npy", "map.csv"):
            status, words = self.stopped(signal.SIGINT, name, *arguments)
            self.assertEqual(status, 130, words)
            self.assertIn("the same command goes on", words)
            self.assertFalse(os.path.exists(self.path(name)))
            for output in (name, "again" + name[-4:]):
                self.assertEqual(run(*arguments, "--output", self.path(output)).returncode, 0)
            self.assertFalse(os.path.exists(self.path(name + ".part")))
            self.assertEqual(self.bytes(name), self.bytes("again" + name[-4:]))

    def test_counts_are_not_capped_unless_run_impacts_is_given(self):
        arguments = ["--over", "drop.angle_deg=5:6", "--over", "impact.restitution=0.05:0.06", "--size", "2x2"]
        self.assertEqual({row["impacts"] for row in self.rows(*arguments)}, {"infinite"})
        self.assertEqual({row["impacts"] for row in self.rows(*arguments, "--set", "run.impacts=3")}, {">=3"})
        self.assertEqual({row["probability"] for row in self.rows(*arguments, "--samples", "3", "--quantity", "impacts=>=40")}, {"1"})

    def test_a_class_of_counts_is_told_whatever_run_impacts_of_the_scene(self):
        scene = self.write("rod.toml", "[drop]\nangle_deg = 10\n[run]\nimpacts = 2\n")
        over = ["--over", "drop.angle_deg=1:60", "--over", "drop.speed=1:2", "--size", "30x2"]
        counts = [int(row["impacts"]) for row in self.rows(*over)]
        self.assertEqual(set(counts), {1, 2, 3})
        for wanted in ("1", "2", "3", ">=1", ">=2", ">=3"):
            rows = self.rows(scene, *over, "--samples", "1", "--quantity", f"impacts={wanted}")
            number = int(wanted.lstrip(">="))
            expected = [count >= number if ">" in wanted else count == number for count in counts]
            self.assertEqual([float(row["probability"]) for row in rows], [float(one) for one in expected], wanted)

    def test_what_cannot_change_or_show_anything_is_said(self):
        over = ["map", "--over", "drop.angle_deg=1:60", "--over", "drop.speed=1:2", "--size", "4x2"]
        self.each_refused({"--quantity impacts=3": "changes nothing", "--quantity hardest=9": "3 impacts are followed"},
                          *over, "--samples", "1", "--set", "run.impacts=3", "--output", "map.npy")
        for arguments, words in ((["--samples", "2", "--quantity", "impacts=9"], "no drop of any pixel has impacts=9"),
                                 (["--samples", "2", "--quantity", "impacts=>=1"], "each drop of every pixel has impacts=>=1"),
                                 (["--set", "run.impacts=1"], "all pixels have the same impacts: >=1")):
            for name in ("map.npy", "map.csv"):
                done = run(*over, *arguments, "--output", self.path(name), "--restart")
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertIn(words, done.stderr)
        self.assertNotIn("pixel", run(*over, "--output", self.path("map.npy"), "--restart").stderr)

    def test_refused_drops_are_a_class_and_no_number_and_pixels_without_a_drop_are_counted(self):
        arguments = ["--over", "drop.angle_deg=50:70", "--over", "impact.impulse_ratio=1:3", "--size", "8x8"]
        for quantity, value in (("outcome", "outside-model"), ("total", "")):
            self.assertIn(value, {row[quantity] for row in self.rows(*arguments, "--quantity", quantity)})
        lifts_off = ["--over", "drop.angle_deg=0:60", "--over", "drop.spin=50:100", "--size", "4x3"]
        self.assertIn("12 of 12 pixels have no drop", run("map", *lifts_off, "--output", self.path("map.npy")).stderr)

    def test_bad_input_is_one_line_and_writes_nothing(self):
        self.each_refused({f"map {options} --output map.csv": words for options, words in BAD.items()})
        self.each_refused(dict.fromkeys(("", "--output map.svg", "--output -"), "--output"), "map", *ELASTIC)


def text(path):
    return Path(ROOT, path).read_text(encoding="utf-8")


class Palette(unittest.TestCase):
    def test_page_and_notebooks_have_the_palettes_colours(self):
        palette = dict(re.findall(r"\*(\w+) = \"(#\w{6})\"", text("validation/output/palette.hpp")))
        palette |= {name: palette[other] for name, other in re.findall(r"(\w+) = (\w+)[,;]", text("validation/output/palette.hpp"))}
        # The page's colours stand in its style sheet alone: of the same hue, with a contrast of 3 to the paper of their theme.
        hue = lambda colour: colorsys.rgb_to_hsv(*(int(colour[i:i + 2], 16) / 255 for i in (1, 3, 5)))[0]
        page = re.findall(r"^ *--([\w-]+): (#\w{6});", text("validation/demo/page/page.css"), re.MULTILINE)
        for of_page, name in (("discrete", "discrete"), ("continuous", "continuous"), ("beta", "beta"), ("gamma", "gamma"),
                              ("floor", "ground"), ("speed", "ochre"), ("tangential", "sky"), ("translation", "translation"),
                              ("rotation", "rotation"), ("potential", "potential")):
            colours = [colour for told, colour in page if told == of_page]
            self.assertIn(len(colours), (1, 2), of_page)
            for colour in colours:
                self.assertAlmostEqual(hue(colour), hue(palette[name]), delta=0.015, msg=of_page)
            papers = [colour for told, colour in page if told == "paper"]
            for colour, paper in zip((colours * 2)[:2], papers):
                self.assertGreaterEqual(contrast(colour, paper), 3, (of_page, colour, paper))
        for file in ("colours.ts", "story.css", "charts.ts", "map.ts", "view.ts", "stage.ts"):
            self.assertNotRegex(text(f"validation/demo/page/{file}"), r"#[0-9a-f]{6}\b")
        look = re.search(r"PALETTE = \((.*)\)", text("notebooks-data/look.py")).group(1)
        self.assertEqual(re.findall(r"#\w{6}", look),
                         [palette[name] for name in ("discrete", "continuous", "ground", "gamma", "ochre", "sky")])
        self.assertIn(f'ROTATION, POTENTIAL, SPEED = ORANGE, "{palette["rotation"]}", SKY, ORANGE', text("notebooks-data/look.py"))

    def test_classes_and_numbers_stay_apart_in_grey(self):
        for name, step in (("classes", 0.02), ("numbers", 0.08)):
            colours = re.findall(r"#\w{6}", re.search(name + r"\{(.*?)\}", text("validation/output/palette.hpp"), re.DOTALL).group(1))
            lightness = [grey(colour) for colour in colours]
            steps = [abs(b - a) for a, b in zip(lightness, lightness[1:])]
            self.assertIn(lightness, (sorted(lightness), sorted(lightness, reverse=True)))
            self.assertGreater(min(steps), step, list(zip(colours, lightness)))


def contrast(one, other):
    """Of sRGB colours by their luminances, 1 to 21 (WCAG 2)."""
    dark, light = sorted(((grey(colour) + 0.16) / 1.16) ** 3 for colour in (one, other))
    return (light + 0.05) / (dark + 0.05)


def grey(colour):
    """CIE lightness of sRGB over 100."""
    parts = [int(colour[i:i + 2], 16) / 255 for i in (1, 3, 5)]
    linear = [part / 12.92 if part <= 0.04045 else ((part + 0.055) / 1.055) ** 2.4 for part in parts]
    light = sum(weight * part for weight, part in zip((0.2126, 0.7152, 0.0722), linear))
    return 1.16 * light ** (1 / 3) - 0.16
