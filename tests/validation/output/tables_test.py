# SPDX-License-Identifier: GPL-3.0-or-later
"""What every command's output has in common: tables for a terminal, a version in every form, help that can be followed."""

import csv
import io
import json
import os
import re
import shutil
import tempfile
import unittest

from run_folder import ROOT, run

TERMINAL = 80  # columns

# Commands that print rows, with tables of all kinds: long texts, many columns, vectors.
COMMANDS = [
    ["sequence", "--angle", "10"], ["sequence", "phone-corner", "--impacts", "3"], ["angles", "--as-printed", "--step", "30"],
    ["regimes"], ["explain", "2", "--angle", "10"], ["simulate", "phone-corner", "--impacts", "2"],
    ["simulate", "phone-sweep", "--impacts", "2", "--digits", "4"], ["compare", "rod-10"], ["compare", "phone-damped", "--impacts", "1"],
    ["sweep", "phone-damped", "--set", "drop.angle_deg=5,40"],
    ["sweep", "phone-damped", "--set", "drop.angle_deg=5,40", "--set", "drop.spin=0,1", "--rows", "impact"],
    ["sweep", "phone-corner", "--set", "drop.orientation=1,20", "--model", "discrete", "--rows", "impact"],
    ["verify", "--only", "E1", "C3"], ["plan", "phone-damped", "--impacts", "1"],
    ["extremes", "--only", "restitution", "--seconds", "600"],
    ["measured", "fit", "square-drops"], ["measured", "predict", "square-drops"], ["measured", "score", "square-drops"],
    ["benchmark", "list"], ["benchmark", "truth", "corner"], ["keys"], ["columns"],
]


def printed(*arguments, statuses=(0,)):
    done = run(*arguments)
    assert done.returncode in statuses, (arguments, done.stderr)
    return done.stdout


def version():
    return printed("--version").split()[1]


class Tables(unittest.TestCase):
    def test_no_table_is_wider_than_a_terminal(self):
        for command in COMMANDS:
            with self.subTest(command=command):
                text = printed(*command, "--format", "table", statuses=(0, 1, 3))
                self.assertEqual([line for line in text.splitlines() if len(line) > TERMINAL], [])

    def test_nor_in_plain_characters_which_are_wider(self):
        for command in COMMANDS[:5] + COMMANDS[-4:]:
            with self.subTest(command=command):
                text = printed(*command, "--format", "table", "--ascii")
                self.assertEqual([line for line in text.splitlines() if len(line) > TERMINAL], [])

    def test_a_folded_text_keeps_all_its_words_in_their_order(self):
        arguments = ["sweep", "rod-45", "--model", "discrete", "--set", "impact.impulse_ratio=0,5"]
        rows = list(csv.DictReader(io.StringIO(printed(*arguments, "--format", "csv", "--bare"))))
        block = printed(*arguments, "--format", "table").split("index  reason")[1]
        shown = " ".join(block.split("─\n")[1].split("\n\n")[0].split())
        self.assertGreater(len(rows[1]["reason"]), TERMINAL)
        self.assertIn("1 " + rows[1]["reason"], shown)

    def test_columns_are_paragraphs_with_every_word(self):
        rows = list(csv.DictReader(io.StringIO(printed("columns", "--format", "csv", "--bare"))))
        shown = " ".join(printed("columns").split())
        for row in rows:
            unit = f" [{row['unit']}]" if row["unit"] else ""
            self.assertIn(" ".join(f"{row['column']}{unit}: {row['meaning']}".split()), shown)

    def test_help_fits_a_terminal(self):
        names = re.findall(r"^  (\w+) ", printed("--help").split("Subcommands:\n")[1].split("\n\n")[0], re.M)
        self.assertGreater(len(names), 15)
        for arguments in ([], ["--help"], *([name, "--help"] for name in names)):
            with self.subTest(arguments):
                self.assertEqual([line for line in printed(*arguments).splitlines() if len(line) > TERMINAL], [])

    def test_the_bare_program_says_what_to_begin_with(self):
        text = printed()
        self.assertIn("clatter sequence --angle 10", text)
        self.assertLess(len(text.splitlines()), 20)

    def test_a_table_in_blocks_shows_every_column_of_every_row_and_names_the_row_in_each(self):
        arguments = ["sweep", "phone-damped", "--set", "drop.angle_deg=5,40,70", "--set", "run.impacts=2"]
        rows = list(csv.DictReader(io.StringIO(printed(*arguments, "--format", "csv", "--bare"))))
        table = printed(*arguments, "--format", "table")
        parts = [part for part in re.split(r"\n(?=\s*index )", table) if "─" in part]
        headings = [next(line for line in part.splitlines() if line.split()[:1] == ["index"]).split() for part in parts]
        self.assertGreater(len(parts), 1)
        for part in parts:
            body = [line.split() for line in part.split("─\n")[1].splitlines()]
            self.assertEqual([row[0] for row in body[:3]], [row["index"] for row in rows])
        for name in ("total_normal_impulse", "largest_peak_force", "last_start", "drop.angle_deg", "outcome"):
            self.assertEqual(sum(name in names for names in headings), 1, name)
            part, names = next(pair for pair in zip(parts, headings) if name in pair[1])
            for line, row in zip(part.split("─\n")[1].splitlines(), rows):
                shown = line.split()[names.index(name)]
                if name == "outcome":
                    self.assertEqual(shown, row[name])
                else:
                    self.assertAlmostEqual(float(shown) / float(row[name]), 1, delta=1e-5)


class Version(unittest.TestCase):
    def test_every_digit_that_was_asked_for_and_is_known_is_printed(self):
        for command, quantity in ((["sequence", "phone-corner", "--impacts", "2", "--digits", "12"], "impulse_normal"),
                                  (["sequence", "--angle", "10", "--restitution", "0.8", "--impulse-ratio", "0.1", "--digits", "12"],
                                   "impulse_normal"),
                                  (["simulate", "phone-corner", "--impacts", "2", "--digits", "6"], "impulse_normal")):
            result = json.loads(printed(*command, "--format", "json"))
            table = printed(*command)
            digits = int(command[-1])
            for impact in result["impacts"]:
                if not impact["error_estimate"][quantity] <= 0.04 * 10 ** -digits * impact[quantity]:
                    continue
                self.assertIn(f"{impact[quantity]:.{digits - 1}e}".split("e")[0].replace(".", ""),
                              table.replace("0.", "").replace(".", ""), (command, quantity))

    def test_csv_and_json_of_every_command_carry_the_version_that_their_names_follow(self):
        for command in [*COMMANDS, ["benchmark", "show", "rod-10"]]:
            with self.subTest(command=command):
                data = json.loads(printed(*command, "--format", "json", statuses=(0, 1, 3)))
                self.assertEqual(data["clatter"], version())
                first = printed(*command, "--format", "csv", statuses=(0, 1, 3)).split("\n", 1)[0]
                self.assertRegex(first, rf"^# clatter {re.escape(version())}, {command[0]}( \w+)?: ")

    def test_so_do_files_and_scores(self):
        with tempfile.TemporaryDirectory() as folder:
            run_file = os.path.join(folder, "run.csv")
            with open(run_file, "w", encoding="utf-8") as file:
                file.write(printed("benchmark", "truth", "rod-10", "--format", "csv"))
            for command in (["benchmark", "score", run_file], ["compare", "rod-10", "--against", run_file]):
                self.assertEqual(json.loads(printed(*command, "--format", "json"))["clatter"], version())
                self.assertIn(f"# clatter {version()}, {command[0]}: ", printed(*command, "--format", "csv"))
            history = os.path.join(folder, "history.csv")
            printed("simulate", "phone-damped", "--impacts", "1", "--history", history)
            printed("figures", "--only", "9", "--output", folder)
            for path in (history, os.path.join(folder, "figure_09.csv")):
                with open(path, encoding="utf-8") as file:
                    comments = [line for line in file if line.startswith("#")]
                self.assertTrue(any(line.startswith(f"# clatter {version()}") for line in comments), path)


class Help(unittest.TestCase):
    """Who installed the program has no source tree."""

    def commands(self):
        listed = printed("--help").split("Subcommands:\n")[1].split("\n\n")[0]
        return [line.split()[0] for line in listed.splitlines() if re.match(r"  \S", line)]

    def test_no_help_text_names_a_path_of_the_source(self):
        texts = {name: printed(name, "--help") for name in self.commands()}
        self.assertGreater(len(texts), 15)
        texts["man"] += printed("man")
        for name, text in texts.items():
            self.assertNotRegex(text, r"\b(validation|notebooks-data|tests|analytic|numeric)/", name)

    def test_a_plan_and_the_verification_name_commands_that_run_in_any_folder(self):
        line = re.search(r"Run it: clatter (.*)", re.sub(r"\n +", " ", printed("plan", "phone-damped", "--impacts", "1"))).group(1)
        checks = re.findall(r'^command = "clatter (.*)"', open(os.path.join(ROOT, "validation", "evidence", "checks.toml"),
                                                               encoding="utf-8").read(), re.M)
        self.assertGreater(len(checks), 40)
        for command in [line, *checks]:
            self.assertNotRegex(command, r"[.]toml|/cases/")
        with tempfile.TemporaryDirectory() as folder:
            done = run(*line.split(), cwd=folder)
            self.assertEqual(done.returncode, 0, done.stderr)

    def test_no_foreign_text_reaches_a_terminal_as_a_command(self):
        """Engines name themselves, bodies their source, columns their header, files their path."""
        with tempfile.TemporaryDirectory() as folder:
            evil = "\x1b]0;owned\x07\x1b[2J"
            def write(name, text):
                with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
                    file.write(text)
            write("run.csv", f"# problem: rod-10\n# engine: {evil}\nt,place,Pn,Pt,V,Omega\n0,a,0.5,0,0,1\n")
            write("head.csv", f"# problem: rod-10\nt{evil},place{evil}\n0,a\n")
            write(f"s{evil}.toml", "[drop]\nangle_deg = 10\n[sweep]\n")
            write("sq.toml", "[source]\ntext = \"" + evil.replace("\x1b", "\\u001b").replace("\x07", "\\u0007") + "\"\nlicence = 'x'\n" +
                  open(os.path.join(ROOT, "validation", "measured", "square-drops.toml"), encoding="utf-8").read().split("[source]")[0])
            shutil.copy(os.path.join(ROOT, "validation", "measured", "square-drops.csv"), os.path.join(folder, "sq.csv"))
            write("mesh.toml", f"[drop]\nangle_deg = 10\n[body]\nshape = 'mesh'\nmass = 1\nmesh = {{ file = 'no\\u001b[2J.stl' }}\n"
                  .replace("'no\\u001b[2J.stl'", '"no\\u001b[2J.stl"'))
            for command in (["benchmark", "score", "run.csv"], ["benchmark", "score", "head.csv"], ["measured", "fit", "sq.csv"],
                            ["sequence", f"s{evil}.toml"], ["simulate", f"s{evil}.toml"], ["plan", f"s{evil}.toml"], ["sequence", "mesh.toml"],
                            ["sequence", evil], ["sequence", f"--{evil}"], [evil]):
                for form in ("table", "csv", "json", "markdown", "latex"):
                    done = run(*command, "--format", form, cwd=folder)
                    for text in (done.stdout, done.stderr):
                        self.assertNotRegex(text, "[\x00-\x09\x0b-\x1f\x7f-\x9f]", (command, form))

    def test_every_example_of_the_help_works_in_an_empty_folder(self):
        slow = {"verify", "tradeoff", "extremes", "demo"}  # the same commands run in tests of their own
        done = 0
        for name in self.commands():
            text = re.sub(r" \\\n +", " ", printed(name, "--help"))  # as a shell joins the lines
            if "not in this build" in text:
                continue
            example = re.search(r"Example: clatter (.*)", text)
            self.assertIsNotNone(example, name)
            words = re.split(r" \(| > | \| ", example[1])[0].split()
            needs_gnuplot = "--plot" in words and not shutil.which("gnuplot")
            if name in slow or needs_gnuplot or "run.csv" in example[1]:
                continue
            with self.subTest(command=name), tempfile.TemporaryDirectory() as folder:
                if name == "benchmark":
                    with open(os.path.join(folder, words[2]), "w", encoding="utf-8") as file:
                        file.write(printed("benchmark", "truth", "rod-10", "--format", "csv"))
                result = run(*words, cwd=folder)
                self.assertEqual(result.returncode, 0, (words, result.stderr))
                done += 1
        self.assertGreater(done, 12)
