# SPDX-License-Identifier: GPL-3.0-or-later
"""`clatter report`: the page has all in itself, its answer is the sweep's worst and what the commands beside it say."""

import html
import itertools
import json
import math
import os
import re
import shlex
import signal
import subprocess

from run_folder import PROGRAM, EmptyFolder, json_of, rows_of, run
from waiting import computing_seconds, until

PROBE = ("--probe", "camera:0.048,0.016,0.0045")
FEW = ("--impacts", "2", "--frequencies", "100:3000:4", "--no-sensitivity")
BOX = ("--body", "box", "--size", "0.1x0.05x0.01", "--mass", "0.1", "--clearance", "1")
SCENE = "[drop]\nclearance = 1\n[body]\nshape = 'box'\nsize = [0.1, 0.05, 0.01]\nmass = 0.1\n[run]\nimpacts = 1\n[ground]\n"
OPTIONS = ("--no-sensitivity", "--frequencies", "100:3000:2", "--drops", "26")
CURVE = "[[0, 0], [0.1, 2e4], [0.6, 2.5e4], [0.8, 2e5]]"
ROCKING = ("--angle", "10", "--restitution", "0")  # its impacts follow each other ever faster


class Report(EmptyFolder):
    def page(self, *arguments):
        done = self.run_program("report", *arguments, "--output", "page.html")
        self.assertEqual((done.returncode, done.stdout), (0, ""), done.stderr)
        self.assertIn("clatter: page.html: ", done.stderr, "what was found is said where it is asked for")
        return self.read("page.html")

    def rows(self, command, *arguments):
        return rows_of(command, *arguments, cwd=self.folder)

    def test_the_page_has_every_part_in_itself_and_asks_for_nothing(self):
        page = self.page("phone-damped", "--angle", "5", *FEW, *PROBE, "--part", "300:500", "--drops", "26")
        for part in ("of 26 drops on faces, edges and corners", "; least margin", "The drop as given", "Attitudes", "Shock at points", "continuous model", "Accuracy",
                     "Assumptions", "leaves out", "clatter shock phone-damped"):
            self.assertIn(part, page)
        self.assertGreaterEqual(page.count("<svg"), 4)
        self.assertNotRegex(page.split("Commands that give")[0], r"0\.\d{12}", "Euler parameters stand in the commands alone")
        links = set(re.findall(r"(?:https?:)?//[^\s\"'<>]+", page))
        self.assertLessEqual(links, {"http://www.w3.org/2000/svg", "http://www.w3.org/1999/xlink"})
        self.assertNotRegex(page, r"<script|<link rel=\"style|@import|url\(http")

    def test_it_says_how_many_impacts_can_be_predicted_with_a_probe_and_without(self):
        for arguments in (PROBE, ()):
            page = self.page("phone-damped", *FEW, *arguments, "--drops", "0")
            self.assertIn("all 2 impacts listed can be predicted", page)
            self.assertNotIn(" drops; ", page)

    def test_it_says_in_how_many_drops_the_last_impact_followed_is_the_hardest(self):
        scene = (*BOX, "--restitution", "0.5", *PROBE, "--part", "300:500", "--drops", "52")
        for impacts in ("1", "4"):
            found = json_of("report", *scene, "--impacts", impacts)
            sweep = next(one for one in found["commands"] if one.startswith("clatter sweep"))
            rows = self.rows(*shlex.split(sweep.replace(" --summary", "").replace(" --rank-by margin_camera", ""))[1:])
            last = sum(row["margin_camera_impact"] == impacts for row in rows)
            words = f"In {last} of 52 drops the hardest blow is the last one followed, impact {impacts}: later" if last else "In none of 52 drops"
            self.assertTrue(any(note.startswith(words) for note in found["answer"]["notes"]), (words, found["answer"]["notes"]))
        self.assertIn("later ones may be harder (--impacts)", " ".join(run("shock", *BOX, "--angle", "5", "--restitution", "0.5", *PROBE, "--impacts", "1").stdout.split()))

    def test_the_answer_has_the_errors_of_its_blow(self):
        known = json_of("report", *BOX, "--floor", "concrete", "--floor-restitution", "0.3", *PROBE, "--part", "300:500", "--impacts", "1", "--drops", "26")["answer"]
        for name in ("margin", "peak_g", "delta_v"):
            self.assertTrue(0 < known[f"{name}_error"] < 1e-3 * known[name], name)

    def test_headline_table_and_margin_are_of_one_blow_of_one_drop_whose_margin_is_the_least(self):
        """Damped and not, with a scatter and without, for each form of a part and either model; the page has their three digits."""
        damped, elastic = ("--stiffness", "1e9", "--damping", "2e8"), ("--floor", "concrete")
        for ground, part, drops in ((damped, "300:500", ("--drops", "52")), (elastic, "300Hz:500g", ("--drops", "26", "--scatter", "0")),
                                    (damped, "4000g", ("--drops", "26")), (elastic, "900g:0.7ms", ("--drops", "26")),
                                    (("--restitution", "0.4"), "300:500", ("--drops", "26"))):
            scene = [*BOX, "--impacts", "3", *ground, *PROBE]
            found = json_of("report", *scene, "--part", part, *drops)
            answer = found["answer"]
            column = answer["ranked_by"]
            self.assertEqual(column, "landing_margin_camera" if ground == elastic else "margin_camera")
            least = [one[column]["least"] for one in found["attitudes"]]
            self.assertEqual(len(least), 26)
            self.assertEqual(answer["least"], min(least))
            # Undamped blows without a scatter depend on digits that nobody has.
            self.assertAlmostEqual(answer["margin"] / answer["least"], 1, delta=2e-3 if "0" not in drops else 0.02)
            self.assertRegex(answer["attitude"], r"\A(face|edge|corner) \S+ down, \S+° off\Z")
            again = json_of(*shlex.split(next(one for one in found["commands"] if one.startswith("clatter shock")))[1:])
            mine = next(row for row in again["impacts"] if (row["probe"], row["n"]) == (answer["probe"], answer["impact"]))
            is_discrete = "--restitution" in ground
            self.assertEqual(answer["delta_v"], mine["discrete_delta_v" if is_discrete else "delta_v"])
            if is_discrete:  # what an undamped part bears of a step of velocity
                margin = 500 * 9.80665 / (2 * math.pi * 300 * answer["delta_v"])
            else:
                blow = next(one for one in again["pulses"]["blows"] if (one["probe"], one["n"]) == (answer["probe"], answer["impact"]))
                margin = min(number for name, number in blow.items() if name.startswith("margin") and number is not None)
                self.assertEqual(answer["decided_by"] == "history", margin == blow["margin_history"])
            self.assertAlmostEqual(answer["margin"] / margin, 1, delta=1e-9)
            page = self.page(*scene, "--part", part, *drops)
            name, off = re.match(r"(.*) down, (.*)° off", answer["attitude"]).groups()
            first = re.search(f"<tr><td[^>]*>{re.escape(name)}</td>(.*?)</tr>", page.split("<h2>Attitudes")[1], re.S).group(1)
            cells = re.findall(r"<td[^>]*>(.*?)</td>", first)
            self.assertEqual(cells[1], str(answer["impact"]))
            shown = [float(cell) for cell in cells[2:4 if is_discrete else 6]]
            # The half sine of a peak and a change of velocity lasts pi/2 of the rectangle.
            expected = [answer["delta_v"], answer["margin"]] if is_discrete else [
                answer["peak_g"], answer["delta_v"], 1e3 * math.pi / 2 * answer["delta_v"] / (answer["peak_g"] * 9.80665), answer["margin"]]
            for one, other in zip(shown, expected, strict=True):
                self.assertAlmostEqual(one / other, 1, delta=2e-2 if "0" in drops else 6e-3)
            self.assertEqual(page.count("° off: "), int(drops[1]))  # the dots of the map
            self.assertIn(f"camera survives in {answer['drops'] - answer['failing']} of {drops[1]} drops on faces, edges and corners", page)

    def test_the_table_of_faces_edges_and_corners_for_a_spreadsheet_and_the_drops_that_fail_are_those_of_the_sweep_s_rows(self):
        scene = ("phone-damped", "--impacts", "2", "--probe", "camera:0.048,0.016,0.0095", "--part", "2000:900", "--drops", "52")
        rows = rows_of("report", *scene)
        self.assertEqual(len(rows), 26)
        found = json_of("report", *scene)
        swept = rows_of(*shlex.split(found["commands"][0].replace(" --summary", "").replace(" --rank-by margin_camera", ""))[1:])
        margins, failing = [float(row["margin_camera"]) for row in swept], found["answer"]["failing"]
        self.assertEqual((failing, found["answer"]["least"]), (sum(not margin > 1 for margin in margins), min(margins)))
        self.assertTrue(0 < failing < 52)
        self.assertIn(f"survives in {52 - failing} of 52 drops", found["message"])
        halves = [min(margin for row, margin in zip(swept, margins) if int(row["index"]) // 26 == half) for half in (0, 1)]
        self.assertIn("the worst of one half has {:.3g}, of the other {:.3g};".format(*sorted(halves)), " ".join(found["answer"]["notes"]))
        self.assertEqual(*([one["margin"] for one in ranked] for ranked in (rows, sorted(rows, key=lambda row: float(row["margin"])))), "the worst first")
        for row in rows:
            self.assertEqual(row["verdict"], "survives" if float(row["margin"]) > 1 else "fails")
            number = next(int(one["attitude"].split()[0]) for one in found["attitudes"] if f"({row['attitude'].split()[1]})" in one["attitude"])
            own = [one for one in swept if int(one["index"]) % 26 == number - 1]
            self.assertEqual(len(own), int(row["drops"]))
            peak, margin = max(float(one["peak_g_camera"]) for one in own), min(float(one["margin_camera"]) for one in own)
            self.assertAlmostEqual(float(row["largest_peak_g"]), peak, delta=0.006 * peak)
            self.assertAlmostEqual(float(row["margin"]), margin, delta=1e-6 * margin)
            self.assertLessEqual(float(row["peak_g"]), float(row["largest_peak_g"]) * 1.006)
        self.assertIn("down", run("report", *scene[:-1], "26", "--format", "markdown").stdout)

    def test_without_loss_the_first_landing_alone_is_ranked_and_what_was_assumed_is_told(self):
        scene = [*BOX, "--floor", "concrete", *PROBE, "--part", "300:500", "--drops", "26"]
        answer = json_of("report", *scene, "--restitution", "0.4")["answer"]
        # In the time in which the box goes its own length at its first approach.
        self.assertLess(next(impact for impact in json_of("report", *scene)["simulation"]["impacts"] if impact["n"] == answer["impact"])["start"],
                        0.1 / math.sqrt(2 * 9.81))
        notes = " ".join(answer["notes"])
        for words in ("Undamped floor (e = 1)", "--restitution 0.4 is the discrete model's alone", "taken as abs", "after the first landing"):
            self.assertIn(words, notes)
        damped = " ".join(json_of("report", *scene, "--floor-restitution", "0.4", "--body-material", "nylon")["answer"]["notes"])
        for words in ("Restitution of the first impact: 0.4", "surface: nylon"):
            self.assertIn(words, damped)
        for words in ("Undamped", "after the first landing", "taken as"):
            self.assertNotIn(words, damped)
        for command, options in (("shock", PROBE), ("simulate", ())):
            told = run(command, *BOX, "--orientation", "1", "--impacts", "1", "--floor", "concrete", "--restitution", "0.4", *options).stderr
            self.assertEqual(told.count("--restitution 0.4 is the discrete model's alone"), 1, command)

    def test_what_looks_like_mm_or_grams_and_a_probe_beside_the_body_are_doubted(self):
        for options, words in ((("--size", "100x50x10", "--mass", "100", "--probe", "camera:48,16,4"), "were mm or g meant"),
                               (("--size", "0.1x0.05x0.01", "--mass", "0.1", "--probe", "camera:0.06,0,0"), "camera: outside of the body")):
            scene = ["--body", "box", *options, "--clearance", "1", "--floor", "concrete", "--drops", "26", "--impacts", "1"]
            self.assertIn(words, " ".join(json_of("report", *scene)["answer"]["notes"]))
            self.assertEqual(run("report", *scene, "--format", "json").stderr.count(words), 1)

    def test_a_pad_says_in_how_many_drops_it_bottoms_out_and_how_deep_each_impact_goes(self):
        pad = [*BOX, "--curve", CURVE, *PROBE, "--part", "100", "--drops", "26", "--impacts", "2"]
        scene = [*pad, "--thickness", "0.008"]
        self.assertTrue(0 < json_of("report", *scene)["answer"]["bottoming"] <= 26)
        self.assertIn("were mm meant", " ".join(json_of("report", *pad, "--thickness", "8")["answer"]["notes"]))
        page = self.page(*scene, "--floor", "steel")
        self.assertRegex(page, r"The pad bottoms out in \d+ of 26 drops, going to \S+ times its curve's depth, onto the floor")
        impact = json_of("report", *scene, "--floor", "steel")["simulation"]["impacts"][0]
        table = page.split("<h2>The impacts")[1].split("</table>")[0]
        self.assertRegex(table, r"of pad(<br>)?\W*%")
        self.assertIn(f">{100 * impact['indentation'] / 0.008:.3g}<", table)

    def test_each_of_the_26_attitudes_is_in_the_table_and_a_released_drop_says_its_height(self):
        page = self.page(*BOX[:-2], "--floor", "wood", *PROBE, "--part", "40g:11ms", "--impacts", "1", "--drops", "26",
                         "--release-clearance", "0.6", "--release-spin", "2")
        table = page.split("<h2>Attitudes")[1].split("</table>")[0]
        self.assertEqual([table.count(f">{kind} ") for kind in ("face", "edge", "corner")], [6, 12, 8])
        self.assertIn("drop: at the release, the lowest point 0.6 m above the ground, velocity (0, 0, 0) m/s, angular velocity (0, 2, 0) rad/s", page)
        self.assertIn("the attitude at the release is what is given", page)

    def test_blows_of_the_discrete_model_that_overlap_on_the_floor_are_told(self):
        """The contact of a phone that lands flat on springs of 1e8 N/m³ lasts at least pi sqrt(m/(k A))."""
        found = json_of("report", "phone-damped", *FEW[:4], *PROBE, "--model", "discrete", "--drops", "26")
        apart, lasts = (float(number) for number in re.search(r"are (\S+) ms apart, .* lasts (\S+) ms", found["overlap"]).groups())
        self.assertGreater(lasts, 1e3 * math.pi * math.sqrt(0.08814 / (1e8 * 0.10566 * 0.04394)))
        starts = [impact["start"] for impact in found["sequence"]["impacts"]]
        self.assertAlmostEqual(apart, 1e3 * (starts[1] - starts[0]), delta=0.005 * apart)

    def test_floors_restitutions_and_parts_are_a_row_each_the_worst_first_and_a_page_with_title_and_date(self):
        self.write("concrete.toml", SCENE + "floor = 'concrete'\n")
        self.write("pad.toml", SCENE + f"curve = {CURVE}\nthickness = 0.03\n")
        scenes, options = ("concrete.toml", "pad.toml"), (*PROBE, *OPTIONS)
        several = (*scenes, *options, "--floor-restitution", "0.4:0.6:0.2", "--part", "300:100", "--part", "300g")
        found = self.json_of("report", *several)
        cases = found["cases"]
        self.assertEqual({(case["scene"], case["floor"], case["restitution"], case["friction"], case["part"]) for case in cases},
                         {(floor, floor, e, 0, part) for floor in ("concrete", "pad") for e in (0.4, 0.6) for part in ("300:100", "300g")})
        margins = [case["margin"] for case in cases]
        self.assertEqual(margins, sorted(margins))
        self.assertEqual(found["answer"]["margin"], margins[0])
        for case in (cases[0], cases[-1]):
            alone = self.json_of("report", f"{case['scene']}.toml", *options, "--floor-restitution", str(case["restitution"]), "--part", case["part"])
            for name in ("margin", "attitude", "failing"):
                self.assertEqual(alone["answer"][name], case[name], name)
        self.assertEqual([float(row["margin"]) for row in self.rows("report", *several)], margins)
        page = self.page(*several, "--title", "Handset <A>", "--date", "2026-11-29")
        for words in ("Handset &lt;A&gt;</h1>", ">2026-11-29, clatter "):
            self.assertIn(words, page)
        # Each part has its own range, and tells in how many of its cases it fails.
        for part, name in (("300:100", "a part of 300 Hz that bears 100 g"), ("300g", "a part that bears 300 g at its place")):
            own = [case for case in cases if case["part"] == part]
            failing = sum(case["verdict"] == "fails" for case in own)
            verdict = f"fails in {failing} of 4 cases" if 0 < failing < 4 else f"{own[0]['verdict']} in all 4 cases"
            ends = " to ".join("{margin:.3g} ({scene}, e = {restitution}: {attitude}, impact {impact})".format(**case) for case in (own[0], own[-1]))
            self.assertIn(f"{name} {verdict}, least margin {ends}, of 26 drops on faces, edges and corners, each ±3°", found["message"])
            times = {"scene": 1, "e": 1}
            for one, other in itertools.product(own, own):
                differ = [name for name, column in (("scene", "scene"), ("e", "restitution")) if one[column] != other[column]]
                if len(differ) == 1:
                    times[differ[0]] = max(times[differ[0]], one["margin"] / other["margin"])
            self.assertEqual({move["name"]: round(move["times"], 9) for move in found["moves"] if move["part"] == name},
                             {one: round(ratio, 9) for one, ratio in times.items()})
            self.assertRegex(html.unescape(page.split("</ul>")[0]), rf"What moves the least margin most, all else the same: .*{name}: \w+ [\d.]+ times, ")
        floors, parts, headings = set(), set(), []
        for case in cases:  # the worst of each floor, and of each part
            if case["scene"] not in floors or case["part"] not in parts:
                headings.append(case["scene"])
            floors.add(case["scene"]), parts.add(case["part"])
        self.assertEqual(re.findall(r'<h2 class="case">(\w+), e = [\d.]+: a part .* (?:fails|survives)</h2>', page), headings)
        self.assertEqual(page.count("What the model leaves out"), 1, "both floors have the same there")
        for wrong, words in ((("--date", "2026-02-30"), "--date"), (("--date", "tomorrow"), "--date"), (("--floor-restitution", "0.7:0.3:0.1"), "0.7:0.3:0.1"),
                             (("--floor-restitution", "0.5:1.5:0.5"), "--floor-restitution"), (("--part", "1:2", "--part", "1:2g"), "given twice")):
            self.refused(words, "report", *scenes, *options, *wrong, "--format", "json")

    def test_cases_are_told_apart_by_the_restitution_of_the_model_that_runs_and_by_that_of_the_other(self):
        scene = (*BOX, "--drops", "26", "--impacts", "1", "--model", "discrete", "--floor", "concrete,wood", "--floor-restitution", "0.3,0.5")
        found = self.json_of("report", *scene)
        self.assertEqual({(case["floor"], case["restitution"]) for case in found["cases"]},
                         {(floor, e) for floor in ("concrete", "wood") for e in (0.3, 0.5)})
        self.assertIn(" e ", self.run_program("report", *scene, "--format", "table").stdout.split("──")[0])
        self.assertEqual(found["moves"], [], "without a blow there is nothing to compare")
        # Impacts' own law leaves the ground's restitution out.
        both = self.json_of("report", *scene, "--restitution", "0.6")["cases"]
        self.assertEqual({(case["restitution"], case["given"]) for case in both}, {(0.6, f"floor restitution {e}") for e in (0.3, 0.5)})

    def test_each_value_of_a_flag_is_a_case_and_the_answer_says_what_moves_the_margin_most(self):
        scene = (*BOX, "--impacts", "1", *PROBE, *OPTIONS, "--part", "300:500")
        several = ("--floor", "concrete,wood", "--floor-restitution", "0.4,0.6", "--gravity", "9:10:1")
        cases = self.json_of("report", *scene, *several)["cases"]
        self.assertEqual({(case["floor"], case["restitution"], case["given"]) for case in cases},
                         {(floor, e, f"gravity {gravity}") for floor in ("concrete", "wood") for e in (0.4, 0.6) for gravity in (9, 10)})
        for case in (cases[0], cases[-1]):
            alone = self.json_of("report", *scene, "--floor", case["floor"], "--floor-restitution", str(case["restitution"]),
                                 "--gravity", case["given"].split()[1])["answer"]
            self.assertEqual((alone["margin"], alone["attitude"]), (case["margin"], case["attitude"]))
        times = {"floor": 1, "e": 1, "gravity": 1}
        for one in cases:
            for other in cases:
                differ = [name for name, column in (("floor", "floor"), ("e", "restitution"), ("gravity", "given")) if one[column] != other[column]]
                if len(differ) == 1:
                    times[differ[0]] = max(times[differ[0]], one["margin"] / other["margin"])
        found = self.json_of("report", *scene, *several)
        self.assertEqual([move["name"] for move in found["moves"]], sorted(times, key=times.get, reverse=True))
        for move in found["moves"]:
            self.assertAlmostEqual(move["times"], times[move["name"]], delta=1e-9)
        page = self.page(*scene, *several, "--short", "--also", "rows.csv", "--also", "short.html", "--also", "all.json")
        self.assertIn(f"What moves the least margin most, all else the same: {found['moves'][0]['name']} ", page)
        self.assertEqual(self.read("short.html"), page)
        self.assertEqual(json.loads(self.read("all.json")), found)
        self.assertEqual(self.read("rows.csv"), self.run_program("report", *scene, *several, "--format", "csv").stdout)
        self.assertNotRegex(page.split("</ul>")[0], "Restitution of the first impact", "it is not the same in all")
        self.assertEqual(page.count("The body&#39;s surface is taken as abs") + page.count("The body's surface is taken as abs"), 1)
        bare = self.run_program("report", *scene, *several, "--format", "csv", "--bare").stdout
        self.assertTrue(bare.startswith("scene,floor,restitution,friction,given,"), bare[:80])
        for wrong, words in ((("--floor", "concrete,wodo"), "did you mean wood"), (("--gravity", "1:2:0"), "--gravity"),
                             (("--gravity", "1:200:1"), "more than 100"), (("--digits", "2:12:1", "--gravity", "1:10:1"), "110 cases"), (("--also", "page.pdf"), "--also 'page.pdf': must end in")):
            self.refused(words, "report", *scene, *wrong, "--format", "json")

    def test_cases_less_apart_than_the_halves_of_their_samples_are_not_told_apart(self):
        scene = (*BOX, "--impacts", "1", *PROBE, *OPTIONS[:-1], "52", "--floor", "concrete", "--floor-restitution", "0.5", "--part", "300:500")
        told = []
        for pair in (("9.81", "9.82"), ("9.81", "19")):
            margins, spreads = [], []
            for gravity in pair:
                answer = self.json_of("report", *scene, "--gravity", gravity)["answer"]
                halves = re.search(r"the worst of one half has (\S+), of the other ([\d.]+)", " ".join(answer["notes"])).groups()
                margins.append(answer["margin"])
                spreads.append(math.log(float(halves[1]) / float(halves[0])))
            page = self.page(*scene, "--gravity", ",".join(pair), "--short")
            told.append("gravity {1} ({3:.3g}) and {0} ({2:.3g})".format(*pair, *margins) in page)
            self.assertEqual(told[-1], math.log(margins[0] / margins[1]) < max(spreads), (margins, spreads))
            self.assertEqual(told[-1], "more --drops may change which is worse" in page)
        self.assertEqual(told, [True, False])

    def test_a_drop_is_followed_to_four_digits_unless_others_are_asked_for(self):
        scene = (*BOX, "--impacts", "1", *PROBE, *OPTIONS, "--floor", "concrete", "--part", "300:500")
        self.write("fixed.toml", SCENE.replace("[run]", "[run]\ndigits = 5") + "floor = 'concrete'\n")
        for arguments, digits in ((scene, 4), ((*scene, "--digits", "6"), 6), (("fixed.toml", *PROBE, *OPTIONS), 5)):
            found = self.json_of("report", *arguments)
            self.assertEqual(found["scene"]["run"]["digits"], digits)
            again = self.json_of(*shlex.split(found["commands"][1])[1:])
            for mine, other in zip(found["shock"]["impacts"], again["impacts"], strict=True):
                self.assertEqual((mine["peak_g"], mine["delta_v"]), (other["peak_g"], other["delta_v"]))
        page = self.page(*scene)
        self.assertIn("followed to 4 digits (--digits)", page)
        numbers = re.findall(r">(-?[\d.]+(?:e-?\d+)?)<", page.split("<h2>Shock")[1].split("<h2>Accuracy")[0])
        self.assertGreater(len(numbers), 10)
        for number in numbers:
            self.assertLessEqual(len(number.split("e")[0].replace(".", "").strip("-0")), 4, number)

    def test_interrupted_it_leaves_the_finished_cases_beside_the_file_marked_as_that(self):
        self.write("short.toml", SCENE + "floor = 'concrete'\n")
        self.write("long.toml", (SCENE + "floor = 'concrete'\n").replace("impacts = 1", "impacts = 100000"))  # it bounces for ever
        arguments = ("report", "short.toml", "long.toml", *PROBE, "--part", "300:500", *OPTIONS, "--output", "page.html", "--also", "rows.csv", "--also", "all.json")
        self.write("page.html", "before")
        seconds = 1  # of computing, until one case is done
        while not os.path.exists(self.path("page.html.part")):
            with subprocess.Popen([PROGRAM, *arguments], cwd=self.folder, stderr=subprocess.PIPE, text=True) as process:
                until(lambda: process.poll() is not None or computing_seconds(process.pid) >= seconds)
                process.send_signal(signal.SIGINT)
                told = process.stderr.read()
            self.assertEqual(process.returncode, 130, told)
            seconds *= 2
        lack = "INCOMPLETE: interrupted after 1 of 2 cases"
        self.assertEqual((self.read("page.html"), os.path.exists(self.path("rows.csv"))), ("before", False))
        self.assertIn(f"page.html.part: {lack}: camera ", told)
        page = self.read("page.html.part")
        self.assertLess(page.index(lack), page.index("least margin"))
        self.assertTrue(page.endswith("</html>\n"))
        self.assertIn(f"# {lack}\n", self.read("rows.csv.part"))
        self.assertEqual(json.loads(self.read("all.json.part"))["incomplete"], lack)
        alone = self.json_of("report", "short.toml", *PROBE, "--part", "300:500", *OPTIONS)
        self.assertEqual(json.loads(self.read("all.json.part"))["answer"], alone["answer"])

    def test_a_part_belongs_to_its_probe_by_flag_and_by_file(self):
        scene = SCENE + "floor = 'concrete'\n"
        probes = "[[probe]]\nname = 'camera'\nplace = [0.048, 0.016, 0.0045]\n{}[[probe]]\nname = 'crystal'\nplace = [-0.02, 0, 0]\n{}"
        self.write("bare.toml", scene + probes.format("", ""))
        self.write("full.toml", scene + probes.format("part = '300:500'\n", "part = '1500g:2ms'\n"))
        options = (*OPTIONS, "--floor-restitution", "0.5")
        by_flag = self.json_of("report", "bare.toml", *options, "--part", "camera:300:500", "--part", "crystal:1500g:2ms")
        by_file = self.json_of("report", "full.toml", *options)
        self.assertEqual(by_flag["cases"], [{**case, "scene": "bare"} for case in by_file["cases"]])
        self.assertEqual({case["part"]: case["probe"] for case in by_file["cases"]}, {"camera:300:500": "camera", "crystal:1500g:2ms": "crystal"})
        # Each is what it is at its place alone.
        for case in by_file["cases"]:
            probe, part = case["part"].split(":", 1)
            alone = self.json_of("report", "bare.toml", *options, "--probe", probe, "--part", part)["answer"]
            for name in ("margin", "verdict", "attitude", "failing", "peak_g"):
                self.assertEqual(alone[name], case[name], name)
            self.assertIn(f"{probe} {case['verdict']}, least margin {case['margin']:.3g}", by_file["message"])
        self.assertNotRegex(by_file["message"], "cases| to ")
        for sweep, points in (("full.toml --set drop.attitude=26", ("camera", "crystal")),
                              ("bare.toml --part crystal:300g --set drop.angle_deg=3", ("crystal",))):
            columns = self.rows("sweep", *sweep.split(), "--set", "run.digits=3")[0]
            self.assertEqual({name for name in columns if name.startswith("margin_")},
                             {f"margin_{point}{ending}" for point in points for ending in ("", "_impact", "_error")})
        page = self.page("full.toml", *options)
        self.assertEqual(sorted(re.findall(r'<h2 class="case">A part.*? at (\w+) ', page)), ["camera", "crystal"])
        self.assertNotIn("delta_v", page.split("Commands that give")[0])
        short = self.page("full.toml", *options, "--short")
        self.assertEqual(("<h2>Attitudes" in short, short.count("The body as it touches")), (False, 2))
        # The crystal's part bore 2 ms, as one of 1/(2 T) = 250 Hz does.
        quarters = {"camera": 1e3 / (4 * 300), "crystal": 1e3 / (4 * 250)}
        self.assertTrue(all(case["pulse_ms"] < quarters[case["probe"]] for case in by_file["cases"]))
        self.assertIn("short against the part's period: read the change of velocity", html.unescape(short))
        # An unbound one is judged at each, as shock does, or where the ranking looks.
        unbound = self.json_of("report", "bare.toml", *options, "--part", "300:500")["cases"]
        self.assertEqual([(case["part"], case["probe"]) for case in unbound], [("camera:300:500", "camera"), ("crystal:300:500", "crystal")])
        self.assertEqual(unbound[0]["margin"], next(case["margin"] for case in by_file["cases"] if case["probe"] == "camera"))
        looked_at = self.json_of("report", "bare.toml", *options, "--part", "300:500", "--rank-by", "margin_crystal")["answer"]
        self.assertEqual((looked_at["probe"], looked_at["margin"]), ("crystal", unbound[1]["margin"]))
        self.refused("no probe is named crysta; did you mean crystal?", "report", "bare.toml", *options, "--part", "crysta:300g", "--format", "json")
        self.write("bad.toml", scene + probes.format("", "part = '15q'\n"))
        self.refused("bad.toml:17:8: probe.1.part", "report", "bad.toml", *options, "--format", "json")

    def test_a_part_without_a_limit_is_ranked_by_its_response_and_the_report_says_so(self):
        self.write("concrete.toml", SCENE + "floor = 'concrete'\n")
        options = (*PROBE, *OPTIONS, "--centre", "0.005,0,0", "--floor-restitution", "0.4,0.6")
        found = self.json_of("report", "concrete.toml", *options, "--part", "0.4kHz")
        limited = self.json_of("report", "concrete.toml", *options, "--part", "400:100")
        answers = [case["response_g"] for case in found["cases"]]
        self.assertEqual(answers, sorted(answers, reverse=True))
        for one, other in zip(found["cases"], limited["cases"], strict=True):
            self.assertAlmostEqual(one["response_g"] * other["margin"] / 100, 1, 9)
            self.assertEqual([one[name] for name in ("attitude", "impact", "restitution")], [other[name] for name in ("attitude", "impact", "restitution")])
            self.assertEqual((one["verdict"], one["margin"], one["part"]), (None, None, "400Hz"))
        self.assertIn(f"answers with {float(format(answers[0], '.3g')):g} g (e = ", found["message"])
        self.assertIn("no limit was given", found["message"])
        self.assertTrue(any("--inertia (body.inertia)" in note for note in found["answer"]["notes"]))
        page = self.page("concrete.toml", *options, "--part", "400Hz")
        self.assertNotRegex(page, "fails|survives|least margin")
        self.assertIn("no limit was given", page)

    def test_attitudes_of_several_cases_are_rows_behind_scene_e_and_part(self):
        body = SCENE.replace("[body]", "angle_deg = 0\n[body]")
        self.write("hard.toml", body + "floor = 'concrete'\nrestitution = 0.4\n")
        self.write("soft.toml", body + "stiffness = 1e7\nthickness = 0.004\nrestitution = 0.6\n")
        options = (*PROBE, *OPTIONS, "--part", "300:500")
        rows = self.rows("report", "hard.toml", "soft.toml", *options, "--rows", "attitude")
        self.assertEqual(len(rows), 2 * 26)
        self.assertEqual({(row["scene"], float(row["restitution"]), row["part"]) for row in rows}, {("hard", 0.4, "300:500"), ("soft", 0.6, "300:500")})
        cases = self.rows("report", "hard.toml", "soft.toml", *options)
        self.assertEqual({(case["scene"], float(case["restitution"])) for case in cases}, {("hard", 0.4), ("soft", 0.6)})
        self.assertEqual({row["floor"] for row in rows}, {"concrete", "springs"})
        for case in cases:
            own = [row for row in rows if row["scene"] == case["scene"]]
            self.assertAlmostEqual(min(float(row["margin"]) for row in own) / float(case["margin"]), 1, delta=6e-3)
        # The springs go further than half the pad's thickness: headline, table and CSV say so.
        soft = next(case for case in cases if case["scene"] == "soft")
        self.assertAlmostEqual(float(soft["depth_percent"]), float(soft["depth_mm"]) / 4 * 100, delta=1e-6 * float(soft["depth_percent"]))
        self.assertGreater(float(soft["depth_percent"]), 50)
        answer = self.json_of("report", "soft.toml", *options)
        self.assertIn("too deep for a bed of springs", answer["message"])
        self.assertNotIn("The drop as given", answer["message"], "an angle of the file is no wish")
        ranged = self.json_of("report", "soft.toml", *options, "--floor-restitution", "0.4,0.6")
        self.assertEqual(len(ranged["cases"]), 2)
        self.write("none.toml", body + "floor = 'concrete'\n[[probe]]\nname = 'camera'\nplace = [0.048, 0.016, 0.0045]\n")
        self.write("some.toml", self.read("none.toml") + "part = '300:500'\n")
        mixed = self.json_of("report", "none.toml", "some.toml", *OPTIONS, "--floor-restitution", "0.4:0.6:0.2")["cases"]
        self.assertEqual([case["scene"] for case in mixed], ["some", "some", "none", "none"])
        self.assertLess(mixed[0]["margin"], mixed[1]["margin"])
        self.assertGreater(mixed[2]["peak_g"], mixed[3]["peak_g"])
        self.assertIn("k_G is the same at each e", self.page("soft.toml", *options, "--floor-restitution", "0.4,0.6", "--short"))

    def test_without_a_file_nothing_is_written(self):
        self.refused("--output", "report", "phone-damped")

    def test_where_prediction_ends_it_says_so(self):
        sequence = json_of("sequence", *ROCKING)
        known = [impact["predictable"] for impact in sequence["impacts"]].index(False)
        self.assertIn(f"impacts 1 to {known} can be predicted; later ones", self.page(*ROCKING, "--model", "discrete"))
