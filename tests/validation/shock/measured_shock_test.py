# SPDX-License-Identifier: GPL-3.0-or-later
"""`clatter shock --measured`: records of loggers and drop towers, against closed forms and a digital filter."""

import math
import re

import numpy as np
from run_folder import EmptyFolder, json_of, printed, rows_of

G = 9.80665
PEAK, LENGTH, RATE = 1500, 5e-4, 1e6  # of a half sine [g, s], and its samples [Hz]
PROBE = ("--probe", "camera:0.048,0.016,0.0095")


def half_sine(rate=RATE, peak=PEAK, length=LENGTH, before=1e-3, after=2e-3):
    """Times, and accelerations in g."""
    times = np.arange(round((before + length + after) * rate)) / rate
    inside = (times > before) & (times < before + length)
    return times, np.where(inside, peak * np.sin(np.pi * (times - before) / length), 0)


TIMES, PULSE = half_sine()


def largest_acceleration(base, step, frequency, quality):
    """Of an oscillator's mass on a base that runs straight between its samples, at the samples."""
    omega = 2 * math.pi * frequency
    system = np.zeros((4, 4))  # of z, ż, s and its slope
    system[0, 1], system[1, 0], system[1, 1], system[1, 2], system[2, 3] = 1, -omega**2, -omega / quality, -1, 1
    turn, term = np.eye(4), np.eye(4)
    for k in range(1, 30):
        term = term @ system * step / k
        turn = turn + term
    z, speed, largest = 0.0, 0.0, 0.0
    base = np.append(base, np.zeros(round(1 / (frequency * step))))
    for here, there in zip(base, base[1:]):
        state = turn @ (z, speed, here, (there - here) / step)
        z, speed = state[0], state[1]
        largest = max(largest, abs(omega / quality * speed + omega**2 * z))
    return largest


def rows(*columns, form="{:.9g}", separator=","):
    return "".join(separator.join(form.format(x) for x in row) + "\n" for row in zip(*columns))


# Files of one and the same pulse: text, and options that say what it leaves open.
FILES = {
    "a header with units": ("time (s),az (g)\n" + rows(TIMES, PULSE), ()),
    "a line of units, semicolons, decimal commas, a mark": (
        "\ufeffInstrument;X1\nRange;2000\n\nTime;Ch1\n[ms];[g]\n" + rows(1e3 * TIMES, PULSE, separator=";").replace(".", ","), ()),
    "a rate above a single column": ("Sample rate: 1 MHz\nacc_g\n" + rows(PULSE), ()),
    "an interval above a single column": ("# Sample interval = 1 us\nacc [g]\n" + rows(PULSE), ()),
    "numbers alone": (rows(PULSE), ("--rate", "1e6", "--unit", "g")),
    "tabs, CR LF and m/s²": ("t\ta\ns\tm/s^2\n".replace("\n", "\r\n") + rows(TIMES, G * PULSE, separator="\t").replace("\n", "\r\n"), ()),
    "blanks and comments": ("% a tower\nt a\n" + rows(TIMES, PULSE, separator="   ").replace("\n", " \n# a word\n", 3), ("--unit", "g")),
    "quoted names, a counter and a size beside": (
        '"n","Time (us)","Acceleration z (mg)","Total (mg)"\n' + rows(np.arange(len(TIMES)), 1e6 * TIMES, 1e3 * PULSE, 1e3 * abs(PULSE)), ()),
    "texts in other columns": ("t,mark,a\n" + rows(TIMES, PULSE).replace(",", ",,").replace("\n", "\n", 1).replace(",,", ",x,", 5), ("--unit", "g")),
}

BAD = {
    "no unit": ("t,a\n" + rows(TIMES, PULSE), (), "column a: its unit is not stated: --unit g or --unit m/s2"),
    "no time": ("a (g)\n" + rows(PULSE), (), "no column of time among a: --rate HZ"),
    "time that falls": ("t,a (g)\n0,1\n1,2\n2,3\n1.5,4\n" + "3,4\n" * 9, (), ":5:1: column t = 1.5: must be later"),
    "four axes": ("t,a (g),b (g),c (g),d (g)\n" + "".join(f"{i},1,2,3,4\n" for i in range(9)), (), "--column must name one to three of t, a"),
    "no such column": ("t,a (g)\n" + rows(TIMES, PULSE), ("--column", "b"), "--column b: must be of t, a"),
    "a short row": ("t,a (g)\n0,1\n1,2\n2\n" + "3,4\n" * 9, (), ":4:1: 1 fields: must be 2"),
    "a word in the first row": ("t,a (g)\n0,x\n" + "".join(f"{i},4\n" for i in range(1, 12)), (), "a.csv:2:3: column 2 = x: must be a finite number"),
    "a word first in the first row": ("t,a (g)\nx,1\n" + "".join(f"{i},4\n" for i in range(1, 12)), (), "a.csv:2:1: column 1 = x: must be a finite number"),
    "nothing in the second row": ("t;b;a (g)\n0;1;2\n1;;3\n" + "".join(f"{i};2;4\n" for i in range(2, 12)), (), "a.csv:3:3: column 2 = "),
    "a word among numbers": ("t,a (g)\n0,1\n1,2\n2,x\n" + "".join(f"{i},4\n" for i in range(3, 12)), (), ":4:3: column a = x: must be a finite number"),
    "five rows": ("t,a (g)\n" + "".join(f"{i},4\n" for i in range(5)), (), "5 rows: at least 8"),
    "no numbers": ("a tale\n", (), "no rows of numbers"),
    "an empty file": ("", (), "no rows of numbers"),
    "gravity alone": ("t,a (g)\n" + "".join(f"{i},1\n" for i in range(50)), (), "no blow"),
    "a third axis of one": ("t,a (g)\n" + rows(TIMES, PULSE), ("--axis", "z"), "the record has 1 axes"),
    "a scene without a probe": ("t,a (g)\n" + rows(TIMES, PULSE), ("--against", "phone-damped"), "--probe: required"),
}


class Measured(EmptyFolder):
    def measure(self, text, *options):
        self.write("a.csv", text)
        return json_of("shock", "--measured", "a.csv", *options, cwd=self.folder)

    def test_every_kind_of_file_gives_the_closed_form_of_a_half_sine(self):
        width = LENGTH * (1 - 2 / math.pi * math.asin(0.1))
        for kind, (text, options) in FILES.items():
            with self.subTest(file=kind):
                (blow,) = self.measure(text, *options, "--frequencies", "100:1000:2")["impacts"]
                for name, right in (("delta_v", 2 * PEAK * G * LENGTH / math.pi), ("peak_g", PEAK), ("width", width),
                                    ("pulse_duration", LENGTH)):
                    self.assertLess(abs(blow[name] / right - 1), 1e-5, name)
                for name in ("delta_v", "peak_g", "width"):
                    self.assertLess(blow["error_estimate"][name], 1e-3 * blow[name], name)
                self.assertEqual(blow["condition"], "A" if blow["delta_v"] < 3 else "B" if blow["peak_g"] <= PEAK else "G")

    def test_what_a_file_leaves_open_is_asked_for_in_one_line(self):
        for case, (text, options, words) in BAD.items():
            with self.subTest(case=case):
                self.write("a.csv", text)
                self.refused(words, "shock", "--measured", "a.csv", *options)

    def test_a_simulated_record_of_a_flat_drop_reads_as_the_simulation_says(self):
        drop = ("--body", "box", "--size", "0.1x0.05x0.02", "--mass", "0.1", "--angle", "0", "--speed", "2", "--stiffness", "1e8",
                "--damping", "1e7", "--impacts", "1", "--probe", "middle:0,0,0")
        inside = [row["middle_z"] for row in rows_of("shock", *drop, "--rate", "1e6") if not row["mark"]]  # marks stand between those of the rate
        self.write("a.csv", "\n".join(["0"] * 200 + inside + ["0"] * 200))
        measured = ("shock", "--measured", "a.csv", "--rate", "1e6", "--unit", "m/s2", *drop)
        (row,) = rows_of(*measured, cwd=self.folder)
        for name in ("delta_v", "peak_g", "width"):
            self.assertLess(abs(float(row[name]) / float(row[f"simulated_{name}"]) - 1), 1e-3, row)
        spectra = {one["model"]: one["points"] for one in self.json_of(*measured, "--frequencies", "50:5000:5")["spectra"]}
        for here, simulated in zip(spectra["measured"], spectra["continuous"], strict=True):
            self.assertLess(abs(here["acceleration"]["maximax"] / simulated["acceleration"]["maximax"] - 1), 1e-5, here)

    def test_impacts_stand_beside_the_blows_of_their_times_whatever_their_numbers(self):
        self.write("drop.toml", "[drop]\nangle_deg = 0\nspeed = 1\n[world]\ngravity = 9.81\n[body]\nshape = 'box'\nsize = [0.1, 0.05, 0.02]\nmass = 0.1\n"
                   "[ground]\nstiffness = 1e9\narea = 'projected'\n[run]\nimpacts = 3\n[[probe]]\nname = 'camera'\nplace = [0, 0, 0]\n")
        # An undamped flat landing comes back after 2 v/g, again and again: the record has no second blow, but a rattle.
        blows = (0, 0.03, 4 / 9.81)
        times = np.arange(round(0.45 * 1e5)) / 1e5
        reading = sum(np.where((times > at + 0.01) & (times < at + 0.0105), 300 * np.sin(np.pi * (times - at - 0.01) / 5e-4), 0) for at in blows)
        options = ("--against", "drop.toml", "--no-sensitivity", "--frequencies", "100:1000:2")
        found = self.measure("t (s),a (g)\n" + rows(times, reading), *options)["impacts"]
        self.assertEqual([row["simulated_n"] for row in found], [1, None, 3])
        self.assertAlmostEqual(found[2]["simulated_start"], blows[2], delta=1e-3)
        self.assertIsNone(found[1]["simulated_delta_v"])
        table = printed("shock", "--measured", "a.csv", *options, cwd=self.folder)
        self.assertIn("sim. t", table)
        self.assertIn("beside no blow of the record, by their times: impact 2", table)

    def test_the_drop_beside_a_record_has_its_pulses_and_margins_under_the_probe_s_name(self):
        self.write("drop.toml", "[drop]\nangle_deg = 0\nspeed = 2\n[body]\nshape = 'box'\nsize = [0.1, 0.05, 0.02]\nmass = 0.1\n[ground]\n"
                   "stiffness = 1e7\ndamping = 1e6\nthickness = 0.002\n[run]\nimpacts = 1\n"
                   "[[probe]]\nname = 'camera'\nplace = [0.03, 0, 0]\npart = '300:100'\n[[probe]]\nname = 'crystal'\nplace = [0, 0, 0]\n")
        options = ("--against", "drop.toml", "--probe", "camera", "--no-sensitivity", "--frequencies", "100:1000:2")
        found = self.measure("t (s),a (g)\n" + rows(TIMES, PULSE), *options)
        beside = self.json_of("shock", "drop.toml", *options[2:])["pulses"]["blows"]
        blows = found["pulses"]["blows"]
        self.assertEqual([(blow["probe"], blow["model"], blow["part"]) for blow in blows],
                         [("camera", "measured", "camera:300:100"), ("camera", "continuous", "camera:300:100")])
        self.assertEqual(blows[1], beside[0])
        self.assertEqual({one["probe"] for one in found["spectra"]}, {"camera"})
        (row, _) = rows_of("shock", "--measured", "a.csv", *options, "--rows", "pulse", cwd=self.folder)
        self.assertEqual(list(row)[:3], ["probe", "n", "model"], "what tells rows apart comes first")
        for more, words in ((("--rows", "pulse"), ("no model beyond half", "measured")), (("--plot", "a.svg"), ("sim. |ΔV|", "sim. peak", "sim. width"))):
            table = self.run_program("shock", "--measured", "a.csv", *options, *more).stdout
            for word in words:
                self.assertIn(word, table)
        self.assertIn("camera, impact 1, continuous", self.read("a.svg"))
        # Where one is more than four times the other, the simulated one is drawn as high as the record's in the time that is
        # shown, to a width of the record's blow after it.
        history = [(float(row["time"]), math.hypot(*(float(row[f"camera_{axis}"]) for axis in "xyz")) / G)
                   for row in rows_of("shock", "drop.toml", *options[2:], "--rate", "1e6", cwd=self.folder)]
        begin = next(time for time, size in history if size > 0.1 * blows[1]["peak_g"])
        largest = max(size for time, size in history if time - begin < 2 * found["impacts"][0]["width"])
        times = blows[0]["peak_g"] / largest
        self.assertFalse(0.25 < times < 4)
        factor = float(re.search(r">size, simulated × ([\d.]+)<", self.read("a.svg")).group(1))
        self.assertAlmostEqual(factor / times, 1, delta=0.02)
        self.refused("--probe: required, where on the body the record was taken: a NAME of the scene's, or NAME:X,Y,Z, not 2 points: camera, crystal",
                     "shock", "--measured", "a.csv", "--against", "drop.toml")

    def test_an_axis_is_that_of_the_record_and_of_the_drop_beside_it(self):
        columns = "t,Acc X (g),Acc Y (g),Acc Z (g)\n" + rows(TIMES, PULSE / 3, 0 * PULSE, PULSE)
        options = ("--against", "phone-damped", "--angle", "30", *PROBE, "--impacts", "1", "--no-sensitivity", "--frequencies", "100:1000:2")
        for axis in "xyz":
            found = self.measure(columns, *options, "--axis", axis)["spectra"]
            self.assertEqual([(one["model"], one["axis"]) for one in found], [("measured", f"Acc {axis.upper()}"), ("continuous", axis)])
            alone = self.json_of("shock", "phone-damped", *options[2:], "--axis", axis)["spectra"]
            self.assertEqual(found[1], next(one for one in alone if one["model"] == "continuous" and one["blows"] == "1"))
        measured, drop = (one["axis"] for one in self.measure(columns, *options)["spectra"])
        table = printed("shock", "--measured", "a.csv", *options, "--rows", "spectrum", "--plot", "a.svg", cwd=self.folder)
        self.assertIn(f"{measured} beside body {drop}", " ".join(table.split()))
        self.assertIn(f"{measured} beside body {drop}", self.read("a.svg"))
        # A sensor of one axis has no other: the letter is the body's.
        found = self.measure("t,a (g)\n" + rows(TIMES, PULSE), *options, "--axis", "x")["spectra"]
        self.assertEqual([one["axis"] for one in found], ["a", "x"])

    def test_what_follows_from_a_size_that_is_not_known_is_no_number(self):
        times, pulse = half_sine(1e5, 1500, 1e-3)
        self.write("a.csv", "t,a (g)\n" + rows(times, np.minimum(pulse, 500)))
        impact, = rows_of("shock", "--measured", "a.csv", cwd=self.folder)
        blow, = rows_of("shock", "--measured", "a.csv", "--rows", "pulse", "--part", "400:250", cwd=self.folder)
        self.assertGreater(float(impact["delta_v"]), 1)  # what was read, which is less than what was
        for row, names in ((impact, ("condition", "pulse_duration")),
                           (blow, ("condition", "pulse_duration", "height_without_rebound", "margin_rectangle", "margin_half_sine"))):
            self.assertEqual({name: row[name] for name in names}, dict.fromkeys(names, ""))
        for kind in ("impact", "pulse"):
            table = printed("shock", "--measured", "a.csv", "--rows", kind, "--part", "400:250", cwd=self.folder)
            shown = [line for line in table.splitlines() if re.match(r"  (a +)?1 ", line)]
            self.assertTrue(shown)
            for line in shown:
                self.assertRegex(line, r"\?$")
                self.assertNotRegex(line, " [A-H]( |$)")

    def test_noise_leaves_a_spectrum_as_open_as_seeds_scatter_and_the_table_says_so(self):
        right = [point["pseudo_velocity"]["maximax"] for point in
                 self.measure("t,a (g)\n" + rows(*half_sine(1e6, 900, 5e-4, 0.02, 0.06)), "--frequencies", "50:1000:4")["spectra"][0]["points"]]
        times, pulse = half_sine(2.5e4, 900, 5e-4, 0.02, 0.06)
        generator, errors, distances = np.random.default_rng(5), [], []
        for _ in range(12):
            found = self.measure("t,a (g)\n" + rows(times, pulse + generator.normal(0, 3, len(times))), "--frequencies", "50:1000:4")
            points = [point["pseudo_velocity"] for point in found["spectra"][-1]["points"]]
            errors.append([point["error_estimate"] for point in points])
            distances.append([point["maximax"] - exact for point, exact in zip(points, right, strict=True)])
        for exact, error, distance in zip(right, np.array(errors).T, np.array(distances).T):
            self.assertTrue((abs(distance) <= error).all(), (exact, error, distance))
            self.assertLess(error.max(), 10 * math.sqrt((distance ** 2).mean()), exact)  # the sum of all bends is 20 to 40 times that
        table = printed("shock", "--measured", "a.csv", "--rows", "spectrum", "--frequencies", "50:1000:4", cwd=self.folder)
        lines = [line for line in table.splitlines() if re.match(r"  a +\d", line)]
        self.assertEqual(len(lines), 4)
        for line, exact in zip(lines, right):
            number, error = re.search(r" ([\d.]+)±([\d.]+) ", line).groups()
            self.assertLess(abs(float(number) - exact), float(error))
            self.assertNotIn("?", line)

    def test_blows_of_three_axes_are_told_apart(self):
        times = np.arange(5000) / 1e4
        peaks = ((0.1, (100, 0, 0)), (0.2, (0, 30, 40)), (0.205, (0, 0, 20)))
        values = sum(np.outer(np.where(abs(times - at) < 1e-3, np.cos((times - at) * math.pi / 2e-3), 0), peak) for at, peak in peaks)
        blows = self.measure("t,x (g),y (g),z (g)\n" + rows(times, *values.T))["impacts"]
        self.assertEqual([round(blow["peak_g"], 3) for blow in blows], [100, 50, 20])
        for blow, (at, peak) in zip(blows, peaks):
            self.assertLess(abs(blow["time"] + blow["peak_time"] - at), 1e-4)
            parts = np.array([blow[f"delta_v_{axis}"] for axis in "xyz"])
            self.assertLess(np.abs(parts - 4e-3 / math.pi * G * np.array(peak)).max(), blow["error_estimate"]["delta_v"])

    def test_clipping_drift_gaps_and_a_slow_clock_are_named(self):
        times, pulse = half_sine(1e4, 200, 5e-3, 0.05, 0.1)
        for words, values, unknown in (
                ("clipped: blow 1 has", np.minimum(pulse, 150), ("peak_g", "delta_v")),
                ("the zero drifts or is off", pulse + 0.3 * (times > 0.055), ()),
                ("too slow a clock for blow 1", np.where(abs(times - times[np.argmax(pulse)]) < 1.5e-4, pulse, 0), ("peak_g", "width"))):
            with self.subTest(words=words):
                found = self.measure("t,a (g)\n" + rows(times, values))
                self.assertTrue(any(words in finding for finding in found["record"]["findings"]), found["record"]["findings"])
                for name in unknown:
                    self.assertIsNone(found["impacts"][0]["error_estimate"][name])
        keep = (times < 0.02) | (times > 0.03)
        self.assertIn("gaps: 1 ", " ".join(self.measure("t,a (g)\n" + rows(times[keep], pulse[keep]))["record"]["findings"]))

    def test_numbers_of_few_digits_stand_in_tables_with_their_errors(self):
        times, pulse = half_sine(5e3, 300, 2.5e-3, 0.05, 0.05)
        self.write("a.csv", "t,a (g)\n" + rows(times, pulse + np.random.default_rng(1).normal(0, 1.5, len(times))))
        (row,) = rows_of("shock", "--measured", "a.csv", cwd=self.folder)
        shown = re.findall(r"(\d\S*)±(\S+)", printed("shock", "--measured", "a.csv", cwd=self.folder))
        self.assertEqual(len(shown), 4, shown)
        for name, exact, (number, error) in zip(("delta_v", "peak_g", "width"), (2 / math.pi * 300 * G * 2.5e-3, 300, None), shown):
            unit = 10 ** -len(error.partition(".")[2])
            self.assertLessEqual(abs(float(number) - float(row[name])), 0.501 * unit)
            self.assertAlmostEqual(float(error), float(row[f"{name}_error"]), delta=1e-9)
            if exact:
                self.assertLessEqual(abs(float(number) - exact), float(error) + 0.5 * unit, name)

    def test_a_filtered_record_is_that_of_the_squared_butterworth_response_and_keeps_its_integral(self):
        for option, design in (("CFC1000", 2077.5), ("1.65kHz", 1650 / (math.sqrt(2) - 1) ** 0.25)):
            step = 1 / RATE
            bent = np.tan(np.pi * np.fft.rfftfreq(len(TIMES), step)[:-1] * step) / np.tan(np.pi * design * step)
            right = np.fft.irfft(np.append(np.fft.rfft(PULSE)[:-1] / (1 + bent**4), 0), len(TIMES))
            found = self.measure(FILES["a header with units"][0], "--filter", option, "--frequencies", "800")
            (blow,) = found["impacts"]
            self.assertLess(abs(blow["peak_g"] / max(right) - 1), 1e-6)
            self.assertLess(abs(blow["delta_v"] / (2 * PEAK * G * LENGTH / math.pi) - 1), 1e-5)
            self.assertAlmostEqual(found["filter"]["design_frequency"], design, 6)
            # Ramps between the samples, by the exact step of (ż, z) for each.
            (point,) = found["spectra"][-1]["points"]
            self.assertLess(abs(point["acceleration"]["maximax"] / largest_acceleration(G * right, step, 800, 10) - 1), 1e-5)
        self.write("a.csv", FILES["a header with units"][0])
        self.assertIn("filtered: CFC 1000 of SAE J211-1", " ".join(printed("shock", "--measured", "a.csv", "--filter", "cfc 1000", cwd=self.folder).split()))
        self.refused("--filter 'CFC'", "shock", "--measured", "a.csv", "--filter", "CFC")
        self.refused("--filter: is for more than", "shock", "--measured", "a.csv", "--filter", "0.5e6")

    def test_a_filtered_drop_has_the_peak_and_spectrum_of_its_filtered_history(self):
        drop = ("shock", "phone-damped", "--impacts", "2", *PROBE)
        rate, design, more = 2e6, 2077.5, 8000
        history = [row for row in rows_of(*drop, "--rate", str(rate)) if not row["mark"]]
        felt = np.array([[float(row[f"camera_{axis}"]) for axis in "xyz"] for row in history])
        felt = np.concatenate([np.zeros((more, 3)), felt, np.zeros((more, 3))])
        bent = np.tan(np.pi * np.fft.rfftfreq(len(felt), 1 / rate) / rate) / np.tan(np.pi * design / rate)
        right = np.fft.irfft(np.fft.rfft(felt, axis=0) / (1 + bent**4)[:, None], len(felt), axis=0)
        found = json_of(*drop, "--filter", "CFC1000", "--frequencies", "800")
        sizes = np.linalg.norm(right, axis=1)
        self.assertLess(abs(max(row["peak"] for row in found["impacts"]) / max(sizes) - 1), 5e-4)
        (whole,) = [one for one in found["spectra"] if one["blows"] == "1-2"]
        point = whole["points"][0]["acceleration"]
        exact = largest_acceleration(right[:, "xyz".index(whole["axis"])], 1 / rate, 800, 10)
        self.assertLess(abs(point["maximax"] - exact), point["error_estimate"] + 1e-4 * exact)
        words = " ".join(printed(*drop, "--filter", "CFC1000", "--part", "300:500").split())
        self.assertIn("filtered: CFC 1000", words)
        self.assertEqual(words.count("filtered, CFC 1000: milder than unfiltered"), 2, "of the part and of B110")
        self.assertRegex(words, r"verdict: 300:500 at camera (fails|survives), margin \S+ in impact \d")
        self.refused("--filter: is of shock", "report", "phone-damped", *PROBE, "--filter", "CFC1000", "--output", "a.html")

    def test_a_required_spectrum_is_met_or_not_by_decibels_at_its_breakpoints(self):
        largest = 1.768457653993672 * PEAK  # of an undamped oscillator under a half sine, at f T = 0.809936785
        worst = 0.80993678514945079 / LENGTH
        for factor, reached, kept in ((0.5, True, False), (2, False, True)):
            self.write("asked.csv", f"frequency (Hz),asked (g)\n{worst},{largest * factor}\n{2 * worst},{largest * factor}\n")
            options = ("--required", "asked.csv", "--quality", "none", "--frequencies", "100")
            (one,) = self.measure(FILES["a header with units"][0], *options)["required"]["spectra"]
            self.assertLess(abs(one["most"]["decibels"] + 20 * math.log10(factor)), 1e-3)
            self.assertEqual([one["most"]["frequency"], one["reached"], one["kept"]], [worst, reached, kept])
            words = " ".join(printed("shock", "--measured", "a.csv", *options, cwd=self.folder).split())
            self.assertIn("as a test it is " + ("met" if reached else "not met"), words)
        self.write("asked.csv", "Hz,asked\n100,5\n200,10\n")
        self.refused("its unit must stand above the rows", "shock", "--measured", "a.csv", "--required", "asked.csv")

    def test_a_table_fits_a_terminal(self):
        self.write("a.csv", FILES["a header with units"][0])
        for kind in ("impact", "spectrum", "pulse"):
            text = printed("shock", "--measured", "a.csv", "--rows", kind, "--part", "200:100", cwd=self.folder)
            self.assertLessEqual(max(map(len, text.splitlines())), 80)
            self.assertRegex(text, "1500|impact 1")
