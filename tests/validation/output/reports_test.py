# SPDX-License-Identifier: GPL-3.0-or-later
"""What the output of all commands has in common: the same rows in every form, tables for a terminal, a version, help that can
be followed."""

import functools
import json
import os
import pty
import re
import shutil
import subprocess
import unittest
from pathlib import Path

import run_folder
from run_folder import PROGRAM, ROOT, EmptyFolder, commands, records, run

TERMINAL = 80  # columns
FORMS = ("table", "csv", "json", "markdown", "latex")
PLAIN = ["sequence", "--angle", "33", "--gravity", "9.81", "--friction", "0.1", "--impacts", "4"]
PHONE = ["simulate", "phone-damped", "--impacts", "2"]
SWEEP = ["sweep", "phone-damped", "--model", "discrete", "--set", "drop.angle_deg=10:50:20"]
# Those that print rows, with tables of all kinds: long texts, many columns, vectors.  Each with the name of its rows in JSON.
COMMANDS = [
    (PLAIN, "impacts"), (["sequence", "phone-corner", "--impacts", "3"], "impacts"),
    (["sequence", "--angle", "10", "--gravity", "9.81", "--restitution", "0.5", "--friction", "0.3", "--impacts", "60"], "impacts"),
    (["sequence", "--angle", "90", "--radius", "0.1", "--gravity", "9.81", "--restitution", "0.5"], "impacts"),
    (["angles", "--gravity-number", "1", "--as-printed", "--step", "30"], "rows"), (["angles"], "rows"), (["angles", "--regimes"], "rows"),
    (["atlas", "phone"], "rows"), (["explain", "2", "--angle", "10", "--gravity", "9.81", "--friction", "0.2"], "steps"),
    (["gradient", "--angle", "33", "--gravity", "9.81", "--friction", "0.1", "--impacts", "2"], "gradients"), (PHONE, "impacts"),
    (["simulate", "phone-corner", "--impacts", "2"], "impacts"), (["simulate", "phone-sweep", "--impacts", "1", "--digits", "3"], "runs"),
    (["compare", "phone-damped", "--impacts", "1"], "impacts"),
    *((["compare", name], "impacts") for name in ("rod-10", "rod-from-2m", "every-key")),
    (["shock", "phone-damped", "--impacts", "1", "--probe", "tip:0.05,0,0", "--no-sensitivity", "--frequencies", "100:1000:3"], "impacts"),
    (["shock", "--ground", "--body", "box", "--size", "0.1x0.06x0.02", "--angle", "0", "--measured-e", "1", "--indentation", "1e-6"], "solutions"),
    (["shock", "--ground", "--floor", "wood", "--footprint", "1e-4"], "solutions"), (SWEEP, "rows"),
    (["sweep", "phone-damped", "--set", "drop.angle_deg=5,40", "--set", "drop.spin=0,1", "--rows", "impact"], "rows"),
    (["sweep", "phone-corner", "--set", "drop.orientation=1,20", "--model", "discrete", "--rows", "impact"], "rows"),
    (["verify", "--only", "C1", "C5", "E8", "F24", "M10"], "checks"), (["plan", "phone-damped", "--impacts", "1"], "rungs"),
    (["verify", "--extremes", "--only", "restitution", "--seconds", "600"], "cells"), (["measured", "fit", "square-drops"], "fits"),
    (["measured", "predict", "square-drops"], "drops"), (["measured", "score", "square-drops"], "scores"), (["benchmark", "list"], "problems"),
    (["benchmark", "truth", "corner"], "impacts"), (["help", "keys"], "keys"), (["help", "columns"], "columns"),
]


@functools.lru_cache(maxsize=None)
def printed(*arguments):
    return run_folder.printed(*arguments, status=(0, 1, 3))


def in_form(command, form):
    return printed(*command, "--format", form)


def data_of(command):
    return json.loads(in_form(command, "json"))


def rows_of(command):
    return records(in_form(command, "csv"))


def too_long(text):
    return [line for line in text.splitlines() if len(line) > TERMINAL]


def version():
    return printed("--version").split()[1]


def named(command):
    """By the last of its words: "tradeoff" of plan --tradeoff."""
    return command[len(command) > 1 and command[:2] in commands()].lstrip("-")


class Forms(EmptyFolder):
    def test_every_command_that_prints_rows_prints_them_in_every_form(self):
        for command, rows in COMMANDS:
            with self.subTest(command=command):
                texts = {form: in_form(command, form) for form in FORMS}
                data = json.loads(texts["json"])
                self.assertGreater(len(data[rows]), 0)
                self.assertGreaterEqual(len(records(texts["csv"])), len(data[rows]))
                if command[0] != "explain":  # which has equations, not a table
                    self.assertRegex(texts["markdown"], r"[|:]---")
                    self.assertIn("\\begin{tabular}", texts["latex"])
                self.assertEqual(len(set(texts.values())), len(FORMS))

    def test_csv_and_json_of_every_command_carry_the_version_that_their_names_follow(self):
        self.assertRegex(printed("--version"), r"^clatter \d+\.\d+\.\d+\n$")
        self.write("run.csv", in_form(["benchmark", "truth", "rod-10"], "csv"))
        for command in [*(command for command, _ in COMMANDS), ["benchmark", "show", "rod-10"], ["benchmark", "score", self.path("run.csv")],
                        ["compare", "rod-10", "--against", self.path("run.csv")]]:
            with self.subTest(command=command):
                self.assertEqual(data_of(command)["clatter"], version())
                self.assertRegex(in_form(command, "csv"), rf"\A# clatter {re.escape(version())}, {named(command)}( \w+)?: ")
        printed(*PHONE, "--history", self.path("history.csv"))
        self.assertRegex(self.read("history.csv"), rf"(?m)^# clatter {version()}")

    def test_csv_names_the_unit_of_each_column_that_has_one(self):
        units = next(line for line in in_form(PHONE, "csv").splitlines() if line.startswith("# units: "))
        listed = {}
        for part in units[len("# units: "):].split("; "):
            names, unit = re.fullmatch(r"(.*) \[(.*)\]", part).groups()
            listed.update((name, unit) for name in names.split(", "))
        explained = {row["column"]: row["unit"] for row in rows_of(["help", "columns", "--only", "simulate"])}
        self.assertEqual(listed, {name: unit for name, unit in explained.items() if unit and not name.endswith("_error")})

    def test_every_column_of_every_command_is_explained(self):
        explained = {}
        for row in rows_of(["help", "columns"]):
            self.assertTrue(row["meaning"], row)
            explained.setdefault(row["command"], set()).add(row["column"])
        for command, _ in COMMANDS:
            with self.subTest(command=command):
                name = "-".join(command[:2]) if command[0] == "measured" else named(command)
                if name in explained:
                    # A sweep's own columns are the swept keys, and those of impacts are explained with their models.
                    own = set() if "--rows" in command else set(rows_of(command)[0]) - {"angle_deg", "drop.angle_deg"}
                    self.assertEqual(own - explained[name], set())
                else:
                    self.assertIn(name, ("keys", "columns", "benchmark"))

    def test_the_names_of_csv_are_those_of_json_with_errors_and_parts_of_vectors_spelt_out(self):
        for command in (PLAIN, PHONE, ["sequence", "phone-corner", "--impacts", "3"]):
            for row, impact in zip(rows_of(command), data_of(command)["impacts"], strict=True):
                spelt = {}
                for ending, fields in (("", impact), ("_error", impact["error_estimate"])):
                    for key, value in fields.items():
                        if isinstance(value, list):
                            parts = "xyz" if len(value) == 3 else ("q0", "q1", "q2", "q3")
                            spelt.update({f"{key}_{part}{ending}": number for part, number in zip(parts, value)})
                        elif not isinstance(value, dict):
                            spelt[key + ending] = value
                self.assertEqual(set(row), set(spelt))
                for key, value in spelt.items():
                    if isinstance(value, bool):
                        self.assertEqual(row[key], "true" if value else "false", key)
                    elif isinstance(value, (int, float)) or key.endswith("_error"):
                        self.assertEqual(float(row[key]) if row[key] else None, value, key)
                for number in ("start", "contact_angle_deg", "approach_speed", "impulse_normal", "velocity_after_z", "energy_loss"):
                    self.assertGreaterEqual(float(row[number + "_error"]), 0, number)

    def test_json_has_the_promised_keys_and_no_nan(self):
        keys = ("n start duration end inclination_deg contact_angle_deg approach_speed restitution impulse_normal impulse_tangential "
                "impulse_ratio mode impulse peak_force peak_time velocity_after angular_velocity_after energy_before energy_after "
                "energy_loss error_estimate amplification predictable").split()
        for command, model, more in ((PLAIN, "discrete", []), (PHONE, "continuous", ["indentation", "work_damping", "work_friction", "touches"])):
            data = json.loads(in_form(command, "json"), parse_constant=self.fail)
            self.assertEqual(data["model"], model)
            self.assertLessEqual({"clatter", "scene", "impacts", "outcome", "message", "total_normal_impulse", "cost"}, set(data))
            self.assertEqual(set(data["cost"]), {"force_evaluations", "root_evaluations"})
            for impact in data["impacts"]:
                self.assertLessEqual({*keys, *more}, set(impact))
                self.assertEqual(impact["peak_force"] is None, model == "discrete")
            self.assertAlmostEqual(data["total_normal_impulse"], sum(impact["impulse_normal"] for impact in data["impacts"]))

    def test_the_angles_of_the_json_are_degrees(self):
        # 30-digit values of an independent computation (validation/oracles/reference).
        for impact, angle in zip(data_of(["sequence", "--angle", "10"])["impacts"], [10, 5.08198288305537, 10.5479772399858], strict=True):
            self.assertAlmostEqual(impact["contact_angle_deg"], angle, delta=1e-13)  # their last digit
            self.assertAlmostEqual(abs(impact["inclination_deg"]), angle, delta=1e-13)
        for name in ("inclination_deg", "contact_angle_deg"):
            self.assertAlmostEqual(data_of(PHONE)["impacts"][0][name], 10, delta=1e-12)  # rounding of the attitude

    def test_errors_have_two_significant_digits_in_every_form(self):
        def errors(name, value, within):
            if isinstance(value, dict):
                return [error for key, part in value.items() for error in errors(key, part, key == "error_estimate" or within)]
            if isinstance(value, list):
                return [error for part in value for error in errors(name, part, within)]
            return [(name, value)] if (within or name.endswith("_error")) and isinstance(value, float) else []

        for command, _ in COMMANDS:
            with self.subTest(command=command):
                found = errors("", data_of(command), False)
                for row in rows_of(command):
                    found += [(key, float(cell)) for key, cell in row.items() if key.endswith("_error") and cell]
                if command[0] in ("sequence", "angles", "simulate", "compare", "sweep"):
                    self.assertGreater(len(found), 5)
                for key, error in found:
                    self.assertEqual(float(f"{error:.1e}"), error, key)

    def test_both_models_give_the_energy_loss_in_joule_in_tables_and_data(self):
        # A flat landing with e < 1 loses (1 - e^2) of its kinetic energy m v^2/2.
        flat = ["sequence", "--angle", "0", "--body", "box", "--size", "1x1x0.1", "--restitution", "0.5", "--mass", "2", "--speed", "3",
                "--impacts", "1"]
        simulated = data_of(PHONE)["impacts"][0]
        self.assertAlmostEqual(simulated["energy_loss"], simulated["energy_before"] - simulated["energy_after"], delta=1e-5)
        for command, loss in ((flat, (1 - 0.5 ** 2) * 2 * 3 ** 2 / 2), (PHONE, simulated["energy_loss"])):
            self.assertAlmostEqual(data_of(command)["impacts"][0]["energy_loss"], loss)
            lines = printed(*command).splitlines()
            head = next(i for i, line in enumerate(lines) if " loss" in line)
            self.assertTrue(lines[head + 1].rstrip().endswith("J"), lines[head + 1])
            shown = next(line for line in lines[head + 3:] if line.split()[0] == "1").split()[-1]
            self.assertAlmostEqual(float(shown), loss, delta=2e-3 * loss)

    def test_figures_are_written_in_the_form_that_is_asked_for(self):
        for form, extension in (("csv", "csv"), ("json", "json"), ("markdown", "md"), ("latex", "tex"), ("table", "txt")):
            printed("verify", "--figures", "--only", "7", "--output", self.folder, "--format", form)
            self.assertGreater(os.path.getsize(self.path("figure_07." + extension)), 1000)
        data, rows = json.loads(self.read("figure_07.json")), self.records("figure_07.csv")
        self.assertEqual((len(rows), list(rows[0])), (len(data["rows"]), list(data["rows"][0])))
        self.assertIn(f"# clatter {version()}", self.read("figure_07.csv"))


class Tables(unittest.TestCase):
    def test_no_table_is_wider_than_a_terminal_and_ascii_is_ascii(self):
        for command in [*(command for command, _ in COMMANDS), ["explain", "9", "--angle", "10"]]:
            with self.subTest(command=command):
                table, plain = in_form(command, "table"), printed(*command, "--format", "table", "--ascii")
                self.assertEqual((too_long(table), too_long(plain), plain.isascii()), ([], [], True))
                self.assertNotRegex(table, r"\bnan\b")
        for name in sorted(name for name in os.listdir(run_folder.CASES) if name.endswith(".toml")):
            self.assertEqual(too_long(printed("simulate", name[:-5])), [], name)

    def test_a_folded_text_keeps_all_its_words_in_their_order(self):
        command = ["sweep", "rod-45", "--model", "discrete", "--set", "impact.impulse_ratio=0,5"]
        reason = rows_of(command)[1]["reason"]
        block = in_form(command, "table").split("index  reason")[1]
        self.assertGreater(len(reason), TERMINAL)
        self.assertIn("1 " + reason, " ".join(block.split("─\n")[1].split("\n\n")[0].split()))

    def test_columns_are_paragraphs_with_every_word(self):
        shown = " ".join(printed("help", "columns").split())
        for row in rows_of(["help", "columns"]):
            unit = f" [{row['unit']}]" if row["unit"] else ""
            self.assertIn(" ".join(f"{row['column']}{unit}: {row['meaning']}".split()), shown)

    def test_every_digit_that_was_asked_for_and_is_known_is_printed(self):
        for command in (["sequence", "phone-corner", "--impacts", "2", "--digits", "12"], ["simulate", "phone-corner", "--impacts", "2", "--digits", "6"],
                        ["sequence", "--angle", "10", "--restitution", "0.8", "--impulse-ratio", "0.1", "--digits", "12"]):
            table, digits = printed(*command), int(command[-1])
            for impact in data_of(command)["impacts"]:
                number = impact["impulse_normal"]
                if impact["error_estimate"]["impulse_normal"] <= 0.04 * 10 ** -digits * number:
                    self.assertIn(f"{number:.{digits - 1}e}".split("e")[0].replace(".", ""), table.replace("0.", "").replace(".", ""), command)

    def test_an_impact_takes_at_most_two_kilobytes_in_any_form(self):
        few, many, largest = 4000, 20000, 2048
        for scene in (["--angle", "10"], ["--body", "box", "--size", "0.1x0.06x0.02", "--angle", "30", "--tilt", "20"]):
            command = ["sequence", *scene, "--gravity", "9.81", "--restitution", "1"]
            for form in FORMS:
                with self.subTest(scene=scene, form=form):
                    sizes = [memory(*command, "--impacts", str(count), "--format", form) for count in (few, many)]
                    self.assertLessEqual((sizes[1] - sizes[0]) / (many - few), largest)
            texts = {form: printed(*command, "--impacts", "40", "--format", form) for form in FORMS}
            self.assertEqual([row["n"] for row in records(texts["csv"])], [str(n) for n in range(1, 41)])
            for form in ("markdown", "latex", "table"):  # rows written one by one are those of the whole report
                numbers = [line.strip("| ").replace("?", " ").split()[0] for line in texts[form].splitlines() if line.strip("| ")[:1].isdigit()]
                self.assertEqual(sorted(set(map(int, numbers[:40]))), list(range(1, 41)), form)


def memory(*arguments):
    """Largest resident size of a run [bytes]."""
    with subprocess.Popen([PROGRAM, *arguments], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as running:
        _, _, usage = os.wait4(running.pid, 0)
        running.returncode = 0
    return 1024 * usage.ru_maxrss


class Help(EmptyFolder):
    """Who installed the program has no source tree."""

    def test_help_fits_a_terminal_and_names_no_path_of_the_source(self):
        self.assertGreater(len(commands()), 15)
        texts = {name: printed(*words) for name, words in {"": [], "--help": ["--help"], **{" ".join(words): [*words, "--help"] for words in commands()}}.items()}
        for name, text in texts.items():
            self.assertEqual(too_long(text), [], name)
        for name, text in {**texts, "man": printed("man")}.items():
            self.assertNotRegex(text, r"\b(validation|notebooks-data|tests|analytic|numeric)/", name)

    def test_a_plan_and_the_verification_name_commands_that_run_in_any_folder(self):
        line = re.search(r"Run it: clatter (.*)", re.sub(r"\n +", " ", printed("plan", "phone-damped", "--impacts", "1"))).group(1)
        checks = re.findall(r'^command = "clatter (.*)"', Path(ROOT, "validation/evidence/checks.toml").read_text(encoding="utf-8"), re.M)
        self.assertGreater(len(checks), 40)
        for command in [line, *checks]:
            self.assertNotRegex(command, r"[.]toml|/cases/")
        self.assertEqual(self.run_program(*line.split()).returncode, 0)

    def test_no_foreign_text_reaches_a_terminal_as_a_command(self):
        """Engines name themselves, bodies their source, columns their header, files their path."""
        evil = "\x1b]0;owned\x07\x1b[2J"
        measured = os.path.join(ROOT, "validation", "measured", "square-drops")
        self.write("run.csv", f"# problem: rod-10\n# engine: {evil}\nt,place,Pn,Pt,V,Omega\n0,a,0.5,0,0,1\n")
        self.write("head.csv", f"# problem: rod-10\nt{evil},place{evil}\n0,a\n")
        self.write(f"s{evil}.toml", "[drop]\nangle_deg = 10\n[sweep]\n")
        shutil.copy(measured + ".csv", self.path("sq.csv"))
        self.write("sq.toml", f"[source]\ntext = {json.dumps(evil)}\nlicence = 'x'\n" +
                   Path(measured + ".toml").read_text(encoding="utf-8").split("[source]")[0])
        self.write("mesh.toml", "[drop]\nangle_deg = 10\n[body]\nshape = 'mesh'\nmass = 1\nmesh = { file = \"no\\u001b[2J.stl\" }\n")
        for command in (["benchmark", "score", "run.csv"], ["benchmark", "score", "head.csv"], ["measured", "fit", "sq.csv"],
                        ["sequence", f"s{evil}.toml"], ["simulate", f"s{evil}.toml"], ["plan", f"s{evil}.toml"], ["sequence", "mesh.toml"],
                        ["sequence", evil], ["sequence", f"--{evil}"], [evil]):
            for form in FORMS:
                done = self.run_program(*command, "--format", form)
                self.assertNotRegex(done.stdout + done.stderr, "[\x00-\x09\x0b-\x1f\x7f-\x9f]", (command, form))

    def test_every_example_of_the_help_works_in_an_empty_folder(self):
        slow = {"verify", "verify --extremes", "plan --tradeoff", "demo"}  # the same commands run in tests of their own
        tried = 0
        for name in (" ".join(words) for words in commands()):
            text = re.sub(r" \\\n +", " ", printed(*name.split(), "--help"))  # as a shell joins the lines
            if "not in this build" in text:
                continue
            example = re.search(r"Example: clatter (.*)", text)
            self.assertIsNotNone(example, name)
            words = re.split(r" \(| > | \| ", example[1])[0].split()
            if name in slow or "--plot" in words and not shutil.which("gnuplot") or "run.csv" in example[1]:
                continue
            with self.subTest(command=name):
                os.mkdir(self.path(str(tried)))
                if name == "benchmark":
                    self.write(f"{tried}/{words[2]}", in_form(["benchmark", "truth", "rod-10"], "csv"))
                done = self.run_program(*words, cwd=self.path(str(tried)))
                self.assertEqual(done.returncode, 0, (words, done.stderr))
                tried += 1
        self.assertGreater(tried, 12)


def on_terminal(arguments, **settings):
    """What the program writes to a terminal."""
    leader, follower = pty.openpty()
    environment = {name: value for name, value in os.environ.items() if name not in ("NO_COLOR", "TERM")} | {"TERM": "xterm"} | settings
    with subprocess.Popen([PROGRAM, *arguments], stdout=follower, stderr=subprocess.DEVNULL, env=environment):
        os.close(follower)
        pieces = []
        try:
            while piece := os.read(leader, 65536):
                pieces.append(piece)
        except OSError:  # Linux says so when the other end is closed
            pass
    os.close(leader)
    return b"".join(pieces).decode().replace("\r\n", "\n")


class Colours(unittest.TestCase):
    TABLE = ["sequence", "--angle", "10"]

    def test_the_head_is_dim_and_the_numbers_are_not(self):
        head, rest = on_terminal(self.TABLE).split("\033[0m", 1)
        self.assertTrue(head.startswith("\033[2mclatter"))
        self.assertIn("at most 6 impacts", head)
        self.assertNotIn("\033", rest)
        self.assertIn("0.511569", rest)

    def test_what_cannot_be_predicted_is_bold_and_without_colours_the_text_is_the_same(self):
        tumbling = ["simulate", "phone-elastic", "--impacts", "4", "--digits", "6"]  # what follows impact 2 is "?"
        shown = on_terminal(tumbling)
        self.assertIn("\033[1m?\033[0m", shown)
        self.assertEqual(re.sub(r"\033\[\d*m", "", shown), run(*tumbling).stdout)

    def test_there_are_none_where_nobody_wants_them(self):
        for text in (run(*self.TABLE).stdout, on_terminal(self.TABLE, NO_COLOR="1"), on_terminal(self.TABLE, TERM="dumb"),
                     on_terminal([*self.TABLE, "--format", "csv"]), on_terminal([*self.TABLE, "--ascii"]), on_terminal(["help", "keys"])):
            self.assertNotIn("\033", text)
