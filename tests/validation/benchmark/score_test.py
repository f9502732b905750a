# SPDX-License-Identifier: GPL-3.0-or-later
"""Answers of others: what is read, how it is scored, what is refused."""
import itertools
import math
import re
import shutil
import subprocess
import unittest
from pathlib import Path

from exact_motion import Asked, Motion, printed, scored, told
from planar_code import Code, StepCode
from run_folder import PROGRAM, EmptyFolder, run

IDS = [problem["id"] for problem in told("benchmark", "list")["problems"]]
SIMULATED = "phone-damped"  # has no motion of impulses
SHORT = ("flat", "rod-45", "friction-stick", "friction-slip-stick", "ball-rest", "ball-grip", "rock", "slide", "incline-slide",
         "incline-stick", "face-grip")  # truths of few digits


def truth_of(problem, law=None):
    return printed("benchmark", "truth", problem, "--format", "csv", *(["--law", law] if law else []))


def judged(text, **options):
    return scored(text, **options)[0]


def verdict(text):
    return judged(text)["verdict"]


class Problems(EmptyFolder):
    def test_list_prints_a_line_per_problem_with_its_id_first(self):
        self.assertEqual(IDS, [line.split()[0] for line in printed("benchmark", "list").splitlines()])
        self.assertTrue(24 <= len(IDS) <= 36)

    def test_each_statement_has_the_parts_of_the_library_of_benchmarks(self):
        for problem in IDS:
            with self.subTest(problem):
                text = printed("benchmark", "show", problem, "--format", "markdown")
                for part in ("**motivation:** ", "**separates:** ", "**data:** ", "**equations:** ", "law", "**asked:** ",
                             "**error:** ", "**acceptance:** ", "**results:** as text", "truth by ", "run.impacts = ", "---> x", " > 0",
                             "\n\n**signs:** ", "\n```\n\n**law"):
                    self.assertIn(part, text)
                self.assertNotIn("\\x", text)

    def test_a_scene_in_a_statement_is_a_scene_file(self):
        for problem in IDS:
            statement = Asked(problem).statement
            if problem == SIMULATED or statement["ground_end"] is not None:  # no key of scenes
                continue
            with self.subTest(problem):
                found = told("sequence", self.write("scene.toml", statement["scene_toml"]), status=(0, 3))
                for row, impact in zip(Asked(problem).truth, found["impacts"]):
                    self.assertAlmostEqual(row["t"], impact["start"], delta=1e-12)

    def test_speeds_keep_off_the_known_thresholds(self):
        for problem in set(IDS) - {"rod-10"}:  # the drop of the case of this name, and its statement says what that means
            drop = Asked(problem).statement["scene"]["drop"]
            speed = drop["speed"] if drop["velocity"] is None else -drop["velocity"][2]
            for threshold in (0.1, 0.2, 0.5, 1.0, 2.0):
                self.assertGreater(abs(speed / threshold - 1), 0.09, problem)

    def test_the_truth_has_25_digits_and_an_uncertainty(self):
        for problem in IDS:
            told_truth = told("benchmark", "truth", problem)
            for row, digits in zip(told_truth["impacts"], told_truth["digits"]):
                self.assertLessEqual(row["uncertainty"], 1e-20)
                self.assertGreater(len(digits["Pz"]) if problem not in SHORT else 25, 20)

    def test_names_that_there_are_not_are_refused_with_the_nearest(self):
        self.each_refused({"show rod-12": "rod-1", "truth": "needs the ID", "lst": "list", "show rod-10 flat": "needs the ID", "score": "needs a FILE",
                           "truth flat --law coulomb": "newton, poisson or stronge", "list --require good": "only for benchmark score"}, "benchmark")


class Exact(EmptyFolder):
    def test_a_motion_sampled_from_the_truth_scores_exact_at_every_step_and_phase(self):
        for problem in IDS:
            if problem in (SIMULATED, "long"):
                continue
            for gap in (0, 2):
                motion = Motion(problem, gap)
                # More than two impacts within a step cannot be told apart: 6.4 ms hold three of clatter-08.
                steps = (1 / 240 if problem == "clatter-08" else 1 / 60, 1 / 1000)
                for step, file in zip(steps, scored(*(motion.text(motion.rows(step)) for step in steps))):
                    with self.subTest(problem=problem, gap=gap, step=step):
                        self.assertEqual(file["verdict"], "exact", file)

    def test_the_truth_as_a_list_of_impacts_is_exact_by_every_law(self):
        for problem in IDS:
            for law in Asked(problem).statement["laws"]:
                with self.subTest(problem=problem, law=law):
                    self.assertEqual(verdict(truth_of(problem, law if law != "any" else None)), "exact")

    def test_a_list_says_which_turn_its_omega_counts_as_positive(self):
        """Nobody guesses: the other sign fails, and without the line the list is incomplete."""
        wanted = {(1, "clockwise"): "exact", (-1, "counter-clockwise"): "exact", (1, ""): "incomplete"}
        for problem, sign, turn in itertools.product(("rod-10", "clatter-08", "friction-stick"), (1, -1), ("clockwise", "counter-clockwise", "")):
            head = [f"# problem: {problem}", "# ended: nothing approaches", *[f"# Omega: {turn}"] * bool(turn), "t,place,Pn,Pt,V,Omega"]
            numbers = [f"{r['t']!r},{r['place']},{r['Pn']!r},{r['Pt']!r},{r['V']!r},{sign * r['Omega']!r}" for r in Asked(problem).truth]
            self.assertEqual(verdict("\n".join(head + numbers) + "\n"), wanted.get((sign, turn), "fails"), (problem, sign, turn))

    def test_a_motion_that_ends_before_the_time_asked_for_is_incomplete(self):
        """That nothing more strikes is what the problem asks, and a run that stopped has not shown it."""
        for problem in ("rod-10", "fold-2-above", "fold-3-above"):
            motion = Motion(problem, 0)
            rows = motion.rows(1e-3)
            last = motion.truth[-1]["t"] + motion.touch
            cut = [row for row in rows if row[0] <= (last + rows[-1][0]) / 2]
            self.assertLess(len(cut), len(rows))
            self.assertEqual(verdict(motion.text(rows)), "exact")
            early = judged(motion.text(cut))
            self.assertEqual(early["verdict"], "incomplete", early)
            self.assertIn("s are asked for", early["findings"][0])
            said = motion.text(cut).replace("\n", "\n# ended: nothing approaches\n", 1)
            self.assertEqual(verdict(said), "exact")

    def test_a_long_run_needs_the_energy_at_its_end(self):
        text = truth_of("long")
        energy = float(text.split("# energy: ")[1].split()[0])
        without = "".join(line + "\n" for line in text.splitlines() if "energy:" not in line)
        off = text.replace(f"# energy: {energy!r}", f"# energy: {0.9 * energy!r}")
        self.assertEqual([found["verdict"] for found in scored(text, without, off)], ["exact", "incomplete", "fails"])

    def test_a_motion_before_any_impact_has_no_scores(self):
        motion = Motion("rod-10", 2)
        text = motion.text([row for row in motion.rows(1e-3) if row[0] < motion.touch][:2])
        found = judged(text)
        self.assertEqual((found["verdict"], found["law_error"], found["velocity_error"]), ("fails", None, None))

    def test_a_list_without_the_line_of_its_end_is_incomplete_where_the_end_is_asked_for(self):
        whole = truth_of("fold-2-above")
        cut = self.write("cut.csv", whole.replace("# ended: nothing approaches\n", ""))
        self.assertEqual(verdict(self.read("cut.csv")), "incomplete")
        for require, status in (("coarse", 1), ("1e-2", 1), ("incomplete", 0)):
            self.assertEqual(run("benchmark", "score", cut, "--require", require).returncode, status, require)
        self.write("wrong.csv", whole.replace("nothing approaches", "so be it"))
        self.refused("must be nothing approaches", "benchmark", "score", "wrong.csv")

    def test_the_simulator_answers_the_compliant_problem_with_a_time_history(self):
        scene = self.write("scene.toml", Asked(SIMULATED).statement["scene_toml"])
        # Rows lie close where a contact ends: what each of them has of the impulse counts, however little.
        for digits in ("9", "10", "11", "12"):
            printed("simulate", scene, "--planar", "--digits", digits, "--history", self.path("history.csv"))
            file = judged(self.read("history.csv"), options=("--problem", SIMULATED, "--columns", "q0=beta0,q1=beta1,q2=beta2,q3=beta3"))
            self.assertEqual(file["verdict"], "exact", file)
            self.assertLess(file["error"], 1e-10, digits)

    def test_the_long_run_is_followed_to_its_end_whatever_impacts_it_has(self):
        code = Code("long", 1)
        rows = code.rows(1 / 200)
        self.assertGreater(code.impacts, 60)
        self.assertEqual(verdict(code.text(rows)), "exact")
        for spoilt in (rows[:-40], [row[:4] + [v * (1 - 1e-4) ** (row[0] / 10) for v in row[4:]] for row in rows]):
            self.assertNotIn(verdict(code.text(spoilt)), ("exact", "sharp"))

    def test_a_file_that_begins_right_after_the_first_impact_has_that_impact(self):
        motion = Motion("rod-10", 0)
        rows = motion.rows(1 / 500)
        rows[0] = motion.row(motion.pieces[1])
        self.assertEqual(verdict(motion.text(rows)), "exact")

    def test_a_planar_problem_takes_a_file_in_space(self):
        motion = Motion("rod-10", 1)
        lines = ["# problem: rod-10", "t,x,y,z,q0,q1,q2,q3,vx,vy,vz,wx,wy,wz"]
        for t, x, z, phi, vx, vz, omega in motion.rows(1 / 500):
            lines.append(",".join(map(repr, (t, x, 0.0, z, math.cos(phi / 2), 0.0, -math.sin(phi / 2), 0.0, vx, 0.0,
                                             vz, 0.0, -omega, 0.0))))
        self.assertEqual(verdict("\n".join(lines) + "\n"), "exact")

    def test_numbers_with_the_digits_of_a_float_score_as_such(self):
        motion = Motion("rod-10", 1)
        rows = [[float(f"{v:.7e}") for v in row] for row in motion.rows(1 / 500)]
        file = judged(motion.text(rows))
        self.assertLess(file["error"], 1e-5)
        self.assertGreater(file["error"], 1e-9)

    def test_a_declared_law_is_the_one_that_judges_and_without_one_that_which_fits_best(self):
        text = truth_of("friction-reversal", "moreau")
        for law, wanted in (("moreau", "exact"), ("Newton, Moreau", "exact"), ("newton routh", "fails"), ("stronge", "fails")):
            self.assertEqual(judged(text.replace("# law: newton moreau", f"# law: {law}"))["verdict"], wanted, law)
        file = judged(truth_of("friction-reversal", "poisson").replace("# law: poisson routh\n", ""))
        self.assertEqual((file["law"], file["law_declared"], file["verdict"]), ("poisson routh", False, "exact"))

    def delayed(self, step, gap, order):
        """The exact motion, whose impacts' velocities err by step^order."""
        motion = Motion("rod-45", gap)
        for piece in motion.pieces[1:]:
            piece.velocity[2] *= 1 + (1 + gap / 10) * step ** order
        return motion.text(motion.rows(step), engine="some engine", step=step, settings="tuned")

    def test_files_with_several_steps_give_the_order_of_convergence_from_the_worst_phase(self):
        for order in (1, 2):
            files = [self.write(f"{n}_{gap}.csv", self.delayed(1 / n, gap, order)) for n in (100, 200, 400) for gap in (2, 0)]  # the worst phase first
            report = told("benchmark", "score", *files)
            group, = report["problems"]
            self.assertAlmostEqual(group["order"], order, delta=0.02)
            self.assertEqual([step["files"] for step in group["steps"]], [2, 2, 2])
            for n, step in zip((100, 200, 400), group["steps"]):
                worst = max(file[error] for file in report["files"] if f"/{n}_" in file["file"]
                            for error in ("velocity_error", "angular_velocity_error", "time_error"))
                self.assertEqual(step["motion_error"], worst)

    def test_many_files_take_a_line_each_then_the_order_and_details_on_demand(self):
        files = [self.write(f"{n}_{gap}.csv", self.delayed(1 / n, gap, 1)) for gap in (2, 0) for n in (400, 100, 200)]
        text = printed("benchmark", "score", *files)
        lines = re.findall(r"^  (\d+)_(\d)\.csv +\S+ +(\S+)  (\S+) +(\S+)", text, re.M)
        self.assertEqual([line[:2] for line in lines], [(n, gap) for n in ("100", "200", "400") for gap in "20"])
        judged = {file["file"].split("/")[-1][:-4]: file for file in told("benchmark", "score", *files)["files"]}
        for n, gap, error, of, verdict in lines:
            file = judged[f"{n}_{gap}"]
            self.assertEqual((float(error), of, verdict), (file["error"], file["decided_by"], file["verdict"]))
        words = re.search(r"rod-45, some engine, tuned: order 1.00 ± (\S+) with 3 steps", re.sub(r"\n  ", " ", text))
        self.assertLess(float(words[1]), 0.1)  # the starts differ by a fifth
        self.assertNotIn("is off, error", text)
        self.assertRegex(" ".join(printed("benchmark", "score", *files, "--details").split()), r"velocity of impact 1 \(lines \d+ to \d+\) is off, error")
        self.assertEqual(printed("benchmark", "score", files[0]), printed("benchmark", "score", files[0], "--details"))

    def test_a_step_at_which_an_impact_is_missing_has_no_error_and_no_part_in_the_order(self):
        files = [self.write(f"{n}.csv", self.delayed(1 / n, 0, 1)) for n in (100, 200, 400)]
        lost = "\n".join(line for line in self.delayed(1 / 50, 0, 1).splitlines() if not re.match(r"0\.[01]", line)) + "\n"
        files += [self.write("lost.csv", lost)]
        group, = told("benchmark", "score", *files)["problems"]
        self.assertIsNone(group["steps"][0]["motion_error"])
        self.assertAlmostEqual(group["order"], 1, delta=0.02)

    @unittest.skipUnless(shutil.which("gnuplot"), "no gnuplot here")
    def test_the_picture_of_several_steps_is_of_errors_over_steps(self):
        files = [self.write(f"{n}.csv", self.delayed(1 / n, 0, 2)) for n in (100, 200)]
        printed("benchmark", "score", *files, "--plot", self.path("p.svg"), "--plot-script")
        report = told("benchmark", "score", *files)["problems"][0]["steps"]
        drawn = re.findall(r"^([\d.e-]+) ([\d.e-]+)$", self.read("p.gnuplot"), re.M)[:2]
        self.assertEqual([float(step) for step, _ in drawn], [step["step"] for step in report])
        for (_, error), step in zip(drawn, report):  # JSON has two digits, rounded up
            self.assertTrue(0 <= step["motion_error"] - float(error) < 0.1 * float(error), (error, step))
        self.assertIn("step [s]", self.read("p.svg"))

    def test_a_step_may_be_written_as_a_fraction(self):
        motion = Motion("flat", 1)
        for file in scored(*(motion.text(motion.rows(1 / 500), step=text) for text in ("1/500", "0.002", "0.002 s"))):
            self.assertAlmostEqual(file["step"], 0.002, delta=1e-15)

    def test_the_exit_status_is_1_where_a_file_does_worse_than_required(self):
        good = self.write("good.csv", Motion("rod-10").text(Motion("rod-10").rows(1 / 500)))
        bad = self.write("bad.csv", self.delayed(1 / 30, 0, 2))
        for require, files, status in (("exact", [good], 0), ("exact", [good, bad], 1), ("coarse", [bad], 0),
                                       ("sharp", [bad], 1), ("1e-2", [bad], 0), ("1e-5", [bad, good], 1)):
            self.assertEqual(run("benchmark", "score", *files, "--require", require).returncode, status, require)
        self.assertEqual(run("benchmark", "score", bad).returncode, 0)
        self.assertRegex(run("benchmark", "score", good, bad, "--require", "sharp").stderr,
                         r"\Aclatter: \S*bad.csv: \w+ by \S+, off by \S+; asked for sharp\n\Z")
        self.refused("coarse, incomplete, or a largest error such as 1e-3", "benchmark", "score", bad, "--require", "fine")

    FLAGS = ("--angle", "25", "--speed", "1.3", "--impacts", "3")

    def exact(self):
        """The motion of a scene of one's own, from the impact sequence."""
        motion = Motion("rod-10")
        scene = told("sequence", *self.FLAGS)
        start = motion.pieces[0]
        angle = math.radians(25)
        start.position, start.velocity = [0.0, 0.0, math.sin(angle) / 2], [0.0, 0.0, -1.3]
        start.attitude = (math.cos(angle / 2), 0.0, -math.sin(angle / 2), 0.0)
        motion.pieces, motion.law = [start], None
        for impact in scene["impacts"]:
            motion.strike(impact["start"], impact["velocity_after"], tuple(impact["angular_velocity_after"]))
        return motion, 1.1 * scene["impacts"][-1]["start"]

    def test_any_scene_is_compared_with_a_foreign_run(self):
        motion, end = self.exact()
        path = self.write("run.csv", motion.text(motion.rows(1 / 400, end)))
        scene = self.write("scene.toml", "[drop]\nangle_deg = 25\nspeed = 1.3\n[world]\ngravity = 0\n[body]\nradius = 0\n"
                           "[run]\nimpacts = 3\n")
        for what in ((*self.FLAGS,), (scene,)):
            self.assertEqual(told("compare", *what, "--against", path, "--require", "exact")["files"][0]["found"], 3)
        done = run("compare", "--angle", "26", "--speed", "1.3", "--impacts", "3", "--against", path, "--require", "good")
        self.assertEqual(done.returncode, 1)
        fall = ("--angle", "25", "--height", "0.6", "--impacts", "3")
        head = run("sequence", *fall).stdout.splitlines()[1:5]
        self.assertRegex(head[2] + head[3], r"at 2\.\d+ m/s")
        self.assertEqual(run("compare", *fall, "--against", path).stdout.splitlines()[1:5], head)
        for columns in ("omega=vz", "x=z"):  # a column of the file is one of the reader's
            self.refused(f"column {columns.split('=')[1]} is taken for", "compare", *self.FLAGS, "--against", path, "--columns", columns)
        self.each_refused({"--columns t=time": "--columns", "--require good": "--require", "--details": "--details"}, "compare", "rod-10")

    def test_a_run_of_a_scene_has_its_first_finding_and_a_picture(self):
        motion, end = self.exact()
        path = self.write("run.csv", motion.text(motion.rows(1 / 400, end)))
        other = ("--angle", "26", "--speed", "1.3", "--impacts", "3", "--against", path)
        count = len(told("compare", *other)["files"][0]["findings"])
        self.assertGreater(count, 1)
        short, whole = (printed("compare", *other, *more) for more in ((), ("--details",)))
        self.assertIn(f"run.csv: {count} findings in all, by --details", short)
        self.assertLess(short.count("impact 1 ("), whole.count("impact 1 ("))
        printed("compare", *other, "--plot", self.path("p.svg"), "--plot-script")
        self.assertIn("run.csv: fails", self.read("p.gnuplot"))

    def test_impacts_that_rounding_decides_are_no_truth(self):
        path = self.write("run.csv", Code("box", 0).text(Code("box", 0).rows(1 / 200)))
        elastic = ("--body", "box", "--size", "0.2x0.1x0.1", "--angle", "25", "--speed", "1.5", "--gravity", "9.81",
                   "--impacts", "100")
        known = sum(impact["predictable"] for impact in told("sequence", *elastic)["impacts"])
        self.assertLess(known, 100)
        report = told("compare", *elastic, "--against", path)
        self.assertEqual(report["files"][0]["expected"], known)
        self.assertIn("rounding", report["message"])

    def test_a_box_in_space_is_compared_with_a_foreign_run(self):
        motion = Motion("corner", 0)
        path = self.write("run.csv", motion.text(motion.rows(1 / 400)))
        printed("compare", self.write("scene.toml", motion.statement["scene_toml"]), "--against", path, "--require", "1e-8")

    def test_a_malformed_file_is_refused_in_one_line_with_row_and_column(self):
        head = "# problem: rod-10\n"
        rows = "t,x,z,phi,vx,vz,omega\n0,0,0.1,0.1745,0,-1.5,0\n0.01,0,0.09,0.1745,0,-1.5,0\n"
        cases = (
            (rows, "no line \"# problem: ID\""), ("# problem: rod-1O\n" + rows, "run.csv:1:1: problem"),
            (head + rows.replace("vz", "v_z"), "run.csv:2:1: no column vz"),
            (head + rows.replace("0.01", "0.0"), "run.csv:4:1: t = 0.0: must be later"),
            (head + "# step: fast\n" + rows, "run.csv:2:1: step = fast: must be"),
            (head + "# law: coulomb\n" + rows, "run.csv:2:1: law = coulomb"),
            (head + "# law: poisson moreau\n" + rows, "run.csv:2:1: law = poisson moreau"),
            (head + head + rows, "run.csv:2:1: problem is given twice"),
            (head.replace("rod-10", "corner") + rows, "moves in space"),
            (head + rows.splitlines()[0] + "\n0,0,0.1,0.1745,0,-1.5,0\n", "must be followed by more rows"),
            (head + "t,place,Pn,Pt,V,Omega\n0,c,1,0,1,1\n", "run.csv:3:3: place = c: must be one of a, b"),
            (head + "t,place,Pn,Pt,V,Omega\n1,a,1,0,1,1\n0,b,1,0,1,1\n", "run.csv:4:1: t = 0: must be no earlier"))
        for text, words in cases:
            self.write("run.csv", text)
            self.refused(words, "benchmark", "score", "run.csv")

    def test_a_strangers_file_is_scored_by_the_program_alone(self):
        program = shutil.copy(PROGRAM, self.path("clatter"))
        motion = Motion("thick-rod", 1)
        self.write("run.csv", motion.text(motion.rows(1 / 200)))
        done = subprocess.run([program, "benchmark", "score", "run.csv", "--require", "exact"], cwd=self.folder,
                              env={"PATH": "/usr/bin:/bin"}, capture_output=True, text=True, timeout=3600)
        self.assertEqual(done.returncode, 0, done.stderr)


class ManyFiles(EmptyFolder):
    def setUp(self):
        super().setUp()
        self.code = StepCode("box", 1, 1 / 960)
        for folder in ("good", "bad"):
            Path(self.path(folder)).mkdir()
            self.write(f"{folder}/box.csv", self.code.text(step="1/960", engine=folder))

    def test_files_of_one_name_are_told_apart_by_their_folders(self):
        text = printed("benchmark", "score", self.path("good/box.csv"), self.path("bad/box.csv"), "--plot", self.path("p.svg"), "--plot-script")
        for where in (text, self.read("p.gnuplot")):
            self.assertIn("good/box.csv", where)
            self.assertIn("bad/box.csv", where)
        self.assertNotIn("good/", printed("benchmark", "score", self.path("good/box.csv")))

    def test_files_of_several_problems_stand_below_a_table_by_problem(self):
        files = [self.path(f"{folder}/box.csv") for folder in ("good", "bad")]
        exact = Motion("rod-10", 1)
        files += [self.write(name, exact.text(rows)) for name, rows in (("right.csv", exact.rows(1 / 500)), ("early.csv", exact.rows(1 / 500)[:100]))]
        text = printed("benchmark", "score", *files)
        rows = re.findall(r"^  (\S.*?) {2,}(\d+)  (\w+) +(\w+)(?: +(\S+) in (\d+))?$", text, re.M)
        self.assertEqual([row[:2] for row in rows], [("box, bad", "1"), ("box, good", "1"), ("rod-10", "2")])
        self.assertEqual(rows[-1][2:], ("exact", "incomplete", "", ""))
        self.assertLess(text.index("commonest cause"), text.index("likely cause"))
        self.assertNotIn("causes in", text)
        self.assertNotIn("commonest", printed("benchmark", "score", *files[:2]))

    def test_what_cannot_be_read_is_listed_below_the_others(self):
        self.write("nan.csv", self.code.text().replace("0.0,", "nan,", 1))
        done = run("benchmark", "score", "good/box.csv", "nan.csv", "none.csv", cwd=self.folder)
        self.assertEqual(done.returncode, 2)
        self.assertIn("box.csv", done.stdout)
        for words in ("nan.csv:", "none.csv: cannot be read"):
            self.assertIn("not judged: " + words, done.stdout)
            self.assertIn("clatter: " + words, done.stderr)
        self.assertEqual(run("benchmark", "score", "nan.csv", "none.csv", cwd=self.folder).stdout, "")

    def test_a_step_that_is_longer_than_the_rows_are_apart_is_not_believed(self):
        found = judged(self.code.text(step="1/96"))
        self.assertIn("step 0.0104 s: rows are 0.00104 s apart, less than the step", " ".join(found["findings"]))
        self.assertAlmostEqual(found["step"], 1 / 960, delta=1e-12)
        names, believed = ([cause["cause"] for cause in one["causes"]] for one in (found, judged(self.code.text(step="1/960"))))
        self.assertEqual(names, believed)

    def test_a_word_for_showing_a_problem_is_not_taken_for_scoring(self):
        self.refused("did you mean show?", "benchmark", "export", "box")
