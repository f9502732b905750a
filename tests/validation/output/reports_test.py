# SPDX-License-Identifier: GPL-3.0-or-later
"""Forms of output: every command that prints rows prints them as table, CSV, JSON, Markdown and LaTeX."""

import json
import os
import re
import tempfile
import unittest

from run_folder import CASES, records, run

SQUARES = os.path.join(os.environ["CLATTER_ROOT"], "validation", "measured", "square-drops.csv")
PHONE = os.path.join(CASES, "phone-damped.toml")
FORMS = ("table", "csv", "json", "markdown", "latex")
# Each with the name of its rows in JSON.
COMMANDS = {
    "sequence": (["sequence", "--angle", "33", "--gravity", "9.81", "--friction", "0.1", "--impacts", "4"], "impacts"),
    "angles": (["angles", "--gravity-number", "0.1"], "rows"),
    "regimes": (["regimes"], "rows"),
    "atlas": (["atlas", "phone"], "rows"),
    "explain": (["explain", "2", "--angle", "10"], "steps"),
    "gradient": (["gradient", "--angle", "33", "--gravity", "9.81", "--friction", "0.1", "--impacts", "2"], "gradients"),
    "simulate": (["simulate", PHONE, "--impacts", "2"], "impacts"),
    "compare": (["compare", PHONE, "--impacts", "1"], "impacts"),
    "shock": (["shock", PHONE, "--impacts", "1", "--probe", "tip:0.05,0,0", "--no-sensitivity", "--frequencies",
               "100:1000:3"], "impacts"),
    "ground": (["ground", "--body", "box", "--size", "0.1x0.06x0.02", "--angle", "0", "--measured-e", "1",
                "--indentation", "1e-6"], "solutions"),
    "sweep": (["sweep", PHONE, "--model", "discrete", "--set", "drop.angle_deg=10:50:20"], "rows"),
    "verify": (["verify", "--only", "E1"], "checks"),
    "plan": (["plan", PHONE, "--impacts", "1"], "rungs"),
    "extremes": (["extremes", "--only", "restitution", "--seconds", "600"], "cells"),
    "measured-fit": (["measured", "fit", SQUARES], "fits"),
    "measured-predict": (["measured", "predict", SQUARES], "drops"),
    "measured-score": (["measured", "score", SQUARES], "scores"),
    "keys": (["keys"], "keys"),
    "columns": (["columns"], "columns"),
}


def lines_of(text):
    return text.splitlines(True)


class Forms(unittest.TestCase):
    def printed(self, *arguments):
        result = run(*arguments)
        self.assertEqual(result.returncode, 0, (arguments, result.stderr))
        return result.stdout

    def test_every_command_that_prints_rows_prints_them_in_every_form(self):
        for name, (command, rows) in COMMANDS.items():
            with self.subTest(name):
                texts = {form: self.printed(*command, "--format", form) for form in FORMS}
                data = json.loads(texts["json"])
                self.assertIn("clatter", data)
                self.assertGreater(len(data[rows]), 0)
                self.assertGreaterEqual(len(records(texts["csv"])), len(data[rows]))
                if name != "explain":  # which has equations, not a table
                    self.assertIn("|---", texts["markdown"].replace(":---", "|---"))
                    self.assertIn("\\begin{tabular}", texts["latex"])
                self.assertEqual(len(set(texts.values())), len(FORMS))

    def test_comments_of_csv_stand_above_the_data_alone_and_bare_csv_has_none(self):
        for name, (command, _) in COMMANDS.items():
            with self.subTest(name):
                full = lines_of(self.printed(*command, "--format", "csv"))
                bare = lines_of(self.printed(*command, "--format", "csv", "--bare"))
                comments = [line.startswith("#") for line in full]
                self.assertEqual(comments, sorted(comments, reverse=True))
                self.assertTrue(comments[0])
                self.assertFalse(any(line.startswith("#") for line in bare))
                self.assertEqual(bare[0], full[comments.count(True)])

    def test_csv_names_the_unit_of_each_column_that_has_one(self):
        text = self.printed("simulate", PHONE, "--impacts", "1", "--format", "csv")
        units = next(line for line in lines_of(text) if line.startswith("# units: "))
        listed = {}
        for part in units[len("# units: "):].strip().split("; "):
            names, unit = re.fullmatch(r"(.*) \[(.*)\]", part).groups()
            listed.update((name, unit) for name in names.split(", "))
        explained = {row["column"]: row["unit"] for row in records(self.printed("columns", "--only", "simulate", "--format", "csv"))}
        self.assertEqual(listed, {name: unit for name, unit in explained.items() if unit and not name.endswith("_error")})

    def test_every_column_of_every_command_is_explained(self):
        explained = {}
        for row in records(self.printed("columns", "--format", "csv")):
            self.assertTrue(row["meaning"], row)
            explained.setdefault(row["command"], set()).add(row["column"])
        for name, (command, _) in COMMANDS.items():
            if name in ("keys", "columns"):
                continue
            found = set(records(self.printed(*command, "--format", "csv"))[0])
            with self.subTest(name):
                # A sweep's own columns are the swept keys; the sums of peaks are the continuous model's.
                self.assertEqual(found - explained[name] - {"drop.angle_deg"}, set())

    def test_the_names_of_csv_are_those_of_json_with_errors_and_parts_of_vectors_spelt_out(self):
        for name in ("sequence", "simulate"):
            command, _ = COMMANDS[name]
            data = json.loads(self.printed(*command, "--format", "json"))["impacts"]
            for row, impact in zip(records(self.printed(*command, "--format", "csv")), data):
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
                    if isinstance(value, (int, float)) and not isinstance(value, bool):
                        self.assertEqual(float(row[key]), value, key)

    def test_each_number_that_is_computed_has_an_error_beside_it(self):
        numbers = {"start", "contact_angle_deg", "approach_speed", "impulse_normal", "velocity_after_z", "energy_loss"}
        for name in ("sequence", "simulate"):
            for row in records(self.printed(*COMMANDS[name][0], "--format", "csv")):
                for number in numbers:
                    self.assertGreaterEqual(float(row[number + "_error"]), 0, (name, number))

    def test_errors_have_two_significant_digits_in_every_form(self):
        def errors(name, value, within):
            if isinstance(value, dict):
                return [error for key, part in value.items() for error in errors(key, part, key == "error_estimate" or within)]
            if isinstance(value, list):
                return [error for part in value for error in errors(name, part, within)]
            is_error = (within or name.endswith("_error")) and isinstance(value, float)
            return [(name, value)] if is_error else []

        for name, (command, _) in COMMANDS.items():
            found = errors("", json.loads(self.printed(*command, "--format", "json")), False)
            for row in records(self.printed(*command, "--format", "csv")):
                found += [(key, float(cell)) for key, cell in row.items() if key.endswith("_error") and cell]
            if name in ("sequence", "angles", "regimes", "simulate", "compare", "sweep"):
                self.assertGreater(len(found), 5, name)
            for key, error in found:
                self.assertEqual(float(f"{error:.1e}"), error, (name, key))

    def test_both_models_give_the_energy_loss_in_joule_in_tables_and_data(self):
        # A flat landing with e < 1 loses (1 - e^2) of its kinetic energy m v^2/2.
        command = ["sequence", "--angle", "0", "--body", "box", "--size", "1x1x0.1", "--restitution", "0.5", "--mass", "2",
                   "--speed", "3", "--impacts", "1"]
        loss = (1 - 0.5 ** 2) * 2 * 3 ** 2 / 2
        self.assertAlmostEqual(json.loads(self.printed(*command, "--format", "json"))["impacts"][0]["energy_loss"], loss)
        data = json.loads(self.printed(*COMMANDS["simulate"][0], "--format", "json"))["impacts"][0]
        self.assertAlmostEqual(data["energy_loss"], data["energy_before"] - data["energy_after"], delta=1e-5)
        for table, expected in ((self.printed(*command), loss),
                                (self.printed(*COMMANDS["simulate"][0]), data["energy_loss"])):
            lines = table.splitlines()
            head = next(i for i, line in enumerate(lines) if " loss" in line)
            self.assertTrue(lines[head + 1].rstrip().endswith("J"), lines[head + 1])
            shown = next(line for line in lines[head + 3:] if line.split()[0] == "1").split()[-1]
            self.assertAlmostEqual(float(shown), expected, delta=2e-3 * expected)

    def test_a_sweep_has_the_same_rows_in_every_form(self):
        command = COMMANDS["sweep"][0]
        rows = records(self.printed(*command))
        data = json.loads(self.printed(*command, "--format", "json"))["rows"]
        self.assertEqual((len(rows), len(data)), (3, 3))
        for row, fields in zip(rows, data):
            self.assertEqual(float(row["total_normal_impulse"]), fields["total_normal_impulse"])
            self.assertEqual(fields["predictable"], row["predictable"] == "true")

    def test_figures_are_written_in_the_form_that_is_asked_for(self):
        with tempfile.TemporaryDirectory() as folder:
            for form, extension in (("csv", "csv"), ("json", "json"), ("markdown", "md"), ("latex", "tex"), ("table", "txt")):
                self.printed("figures", "--only", "7", "--output", folder, "--format", form)
                self.assertGreater(os.path.getsize(os.path.join(folder, "figure_07." + extension)), 1000)
            with open(os.path.join(folder, "figure_07.json"), encoding="utf-8") as file:
                data = json.load(file)
            with open(os.path.join(folder, "figure_07.csv"), encoding="utf-8") as file:
                rows = records(file.read())
            self.assertEqual(len(rows), len(data["rows"]))
            self.assertEqual(list(rows[0]), list(data["rows"][0]))

    def test_columns_of_an_unknown_command_get_the_nearest_and_status_2(self):
        result = run("columns", "--only", "sequnce")
        self.assertEqual((result.returncode, result.stdout, len(result.stderr.splitlines())), (2, "", 1))
        self.assertIn("sequence", result.stderr)
