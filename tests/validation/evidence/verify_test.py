# SPDX-License-Identifier: GPL-3.0-or-later
"""`clatter compare`, `verify` and `figures` as their users meet them."""

import csv
import json
import math
import os
import re
import tempfile
import tomllib
import unittest
from pathlib import Path

from run_folder import ROOT, EmptyFolder, run

FIGURES = os.path.join(ROOT, "notebooks-data", "figures")
# Under the sanitizers, which cost a factor of ten, other tests run the same code.
UNLESS_SLOW = unittest.skipIf(os.environ.get("CLATTER_SLOW") == "1", "takes long in this build")
NUMBERS = [7, 8, 9, 10, 11, 12, 14, 15, 16, 17, 19, 20, 21, 22, 23, 24]


class Compare(EmptyFolder):
    @UNLESS_SLOW
    def test_cases_without_a_check_of_their_own_agree_where_the_ground_gives_the_law(self):
        """Some come to rest, which no restitution of a damped ground does."""
        for name, status in {"phone-corner": 0, "coin": 1, "cube": 1, "die": 1, "needle": 1, "tube": 1}.items():
            done = run("compare", name)
            self.assertEqual((done.returncode, "the law of [impact]" in done.stdout), (status, status == 1), name)


class Verify(EmptyFolder):
    @classmethod
    def setUpClass(cls):
        cls.quick = run("verify", "--quick", "--format", "json")

    def test_the_quick_set_passes_and_answers_every_claim_and_erratum(self):
        self.assertEqual(self.quick.returncode, 0, self.quick.stdout)
        result = json.loads(self.quick.stdout)
        self.assertEqual(result["failed"], 0)
        checks = {check["id"]: check for check in result["checks"]}
        for name in [f"C{i}" for i in range(1, 21)] + [f"E{i}" for i in range(1, 12)]:
            self.assertIn(checks[name]["answer"], ("holds", "refuted", "ambiguous") if name[0] == "C" else ("misprint",))
            self.assertIsInstance(checks[name]["number"], (int, float))
        for check in checks.values():
            self.assertLessEqual(check["measured_error"], check["tolerance"])

    def test_every_erratum_shows_the_printed_form_and_the_right_one_with_the_number_of_each(self):
        errata = {check["id"]: check for check in json.loads(self.quick.stdout)["checks"] if check["id"][0] == "E"}
        c, s = math.sqrt(3) / 2, 0.5
        omega = 12 * (c - 0.2 * s) / (1 + 3 * c * c - 0.6 * s * c)
        # Closed forms, and values of an independent 60-digit computation, to the digits given there.
        for name, right, delta in (("E1", omega, 1e-14), ("E2", 3.1820, 5e-5), ("E5", 86.701384197437, 1e-12), ("E6", 27.577809606636, 1e-12),
                                   ("E7", -0.2, 1e-15), ("E8", 6, 0), ("E9", 1, 1e-14), ("E10", 1, 1e-9),
                                   ("E11", math.sqrt(2 * 9.81 * (2 - 0.51 * math.sqrt(0.5))), 1e-9)):
            self.assertAlmostEqual(errata[name]["right_value"], right, delta=delta, msg=name)
        for name, printed, delta in (("E1", -omega, 1e-14), ("E2", 25.99, 5e-3), ("E5", 90, 0), ("E6", 27, 0), ("E8", 7, 0), ("E11", 1, 0)):
            self.assertAlmostEqual(errata[name]["printed_value"], printed, delta=delta, msg=name)
        # An elastic end leaves as fast as it came; v_rn has the other sign than the velocity.
        self.assertAlmostEqual(errata["E4"]["printed_value"], -errata["E4"]["right_value"], delta=1e-14)
        self.assertAlmostEqual(errata["E3"]["right_value"], 2 * errata["E4"]["printed_value"], delta=1e-14)  # at twice the speed
        said = " ".join(run("verify", "--only", *errata).stdout.split())
        for name, check in errata.items():
            self.assertEqual(check["expected_answer"], "misprint")
            for key in ("place", "printed", "right", "compared"):
                self.assertIn(check[key], said, name)
            self.assertEqual(check["printed_value"] is None, name == "E7")

    @UNLESS_SLOW
    def test_every_command_in_the_table_runs(self):
        for command in sorted({check["command"] for check in json.loads(self.quick.stdout)["checks"]}):
            if not command.startswith("clatter verify"):
                words = command.replace("DIR", self.folder).replace("FILE", self.path("history.csv")).split()
                done = run(*words[1:], cwd=ROOT)
                self.assertEqual(done.returncode, 0, f"{command}: {done.stderr}")

    def test_what_cannot_be_is_one_line(self):
        self.write("file", "")
        self.each_refused({"verify --only C21": "C2", "verify --only": "--only", "verify --quick --only C1": "--quick",
                           "verify --html /no/such/folder/x.html": "--html", "verify --only C1 ''": "--only", "verify --fast": "--fast",
                           "figures": "--output", "figures --output": "--output", "figures --output file": "--output",
                           "figures --output . --only 13": "--only", "figures --output . --only x": "--only"})
        self.refused("gnuplot-nox", "verify", "--only", "C1", "--html", "page.html", env={**os.environ, "PATH": "/nonexistent"})


class Faults(unittest.TestCase):
    def test_each_check_and_figure_has_a_tolerance_with_a_reason_and_a_seeded_fault_that_turns_it_red(self):
        checks, faults = (tomllib.loads(Path(ROOT, path).read_text(encoding="utf-8"))
                          for path in ("validation/evidence/checks.toml", "tests/seeded_faults/faults.toml"))
        ids = {check["id"] for check in checks["check"]}
        self.assertEqual({check for fault in faults.values() for check in fault.get("turns_red", "").split()}, ids)
        self.assertLessEqual({f"F{number}" for number in NUMBERS}, ids)
        for check in checks["check"]:
            self.assertTrue(0 < check["tolerance"] <= 5.000001 * check["seen"] and check["reason"], check["id"])


def read_figure(path):
    lines = Path(path).read_text(encoding="utf-8").splitlines()
    names, *rows = csv.reader(line for line in lines if not line.startswith("#"))
    return [line for line in lines if line.startswith("#")], names, [[float(cell) if cell else None for cell in row] for row in rows]


class Figures(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        cls.run_result = run("verify", "--figures", "--output", os.path.join(cls.folder.name, "new", "folder"))

    def path(self, number):
        return os.path.join(self.folder.name, "new", "folder", f"figure_{number:02}.csv")

    def test_the_head_of_each_figures_file_says_quantity_unit_scene_command_and_version(self):
        self.assertEqual(self.run_result.returncode, 0, self.run_result.stderr)
        self.assertEqual(sorted(os.listdir(os.path.dirname(self.path(7)))), [f"figure_{n:02}.csv" for n in NUMBERS])
        for number in NUMBERS:
            head, names, _ = read_figure(self.path(number))
            self.assertTrue(head[0].startswith(f"# Figure {number}: "))
            self.assertTrue(head[1].startswith("# scene: "))
            self.assertEqual(head[2], f"# command: clatter verify --figures --only {number} --output DIR")
            self.assertRegex(head[3], r"^# clatter \d+\.\d+\.\d+$")
            for name, line in zip(names, head[-len(names):], strict=True):
                self.assertRegex(line, rf"^# {re.escape(name)} \[[^\]]+\]: ..")
            for line in head[4:-len(names)]:
                self.assertTrue(line.startswith("# plot: {"), line)

    def test_the_head_and_json_say_how_each_panel_is_drawn_curve_by_curve(self):
        with tempfile.TemporaryDirectory() as folder:
            self.assertEqual(run("verify", "--figures", "--only", "17", "24", "--output", folder, "--format", "json").returncode, 0)
            for number, where in ((17, {"variant": {1, 2}}), (24, {"touches": {1, 2}})):
                head, names, rows = read_figure(self.path(number))
                plots = [json.loads(line.removeprefix("# plot: ")) for line in head if line.startswith("# plot: ")]
                self.assertEqual(len(plots), 4)
                self.assertEqual(json.loads(Path(folder, f"figure_{number}.json").read_text(encoding="utf-8"))["plots"], plots)
                for plot in plots:
                    self.assertRegex(plot["x_label"] + plot["y_label"], r"^\S.* \[\S+\]\S.* \[\S+\]$")
                    for curve in plot["curves"]:
                        self.assertLessEqual({curve["x"], curve["y"], *curve.get("where", {})}, set(names))
                        self.assertRegex(curve["colour"], r"^#[0-9a-f]{6}$")
                for column, values in where.items():
                    chosen = {curve["where"][column] for plot in plots for curve in plot["curves"] if "where" in curve}
                    self.assertEqual(chosen, values)
                    self.assertEqual({row[names.index(column)] for row in rows}, values)

    def test_the_files_in_the_tree_are_what_the_program_writes(self):
        """To a millionth of each column's range: another machine rounds differently, and errors grow over impacts."""
        for number in NUMBERS:
            head, names, rows = read_figure(self.path(number))
            kept_head, kept_names, kept_rows = read_figure(os.path.join(FIGURES, f"figure_{number:02}.csv"))
            self.assertEqual((head, names, len(rows)), (kept_head, kept_names, len(kept_rows)), number)
            for column, name in enumerate(names):
                values = [row[column] for row in kept_rows if row[column] is not None]
                # The losses of Fig. 14 are zero but for rounding and the method's error (1e-9 J): they have no range.
                tolerance = 1e-6 * max(1e-3, max(map(abs, values)))
                for row, kept in zip(rows, kept_rows):
                    self.assertEqual(row[column] is None, kept[column] is None, (number, name))
                    if kept[column] is not None:
                        self.assertLessEqual(abs(row[column] - kept[column]), tolerance, (number, name))
