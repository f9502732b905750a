# SPDX-License-Identifier: GPL-3.0-or-later
"""`clatter extremes` as its users meet it.  Costs are measured, not judged."""

import csv
import json
import os
import re
import tempfile
import unittest
import xml.etree.ElementTree

from run_folder import run

PATIENCE = ["--seconds", "600"]  # so that no test depends on a time


def extremes(*arguments):
    return run("extremes", *arguments)


class Extremes(unittest.TestCase):
    def run_well(self, *arguments):
        run = extremes(*arguments, *PATIENCE)
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        return run.stdout

    def test_the_table_fits_80_columns_and_has_its_notes(self):
        text = self.run_well("--only", "angle", "restitution", "size")
        self.assertLessEqual(max(map(len, text.splitlines())), 80)
        self.assertIn("slowest cell", text)
        self.assertIn("bad-input", text)
        self.assertNotRegex(text, r"\bnan\b")

    def test_ascii_is_ascii(self):
        self.assertTrue(self.run_well("--only", "angle", "ratio", "--ascii").isascii())

    def test_csv_and_json_have_every_cell(self):
        cells = json.loads(self.run_well("--only", "angle", "--format", "json"))["cells"]
        lines = [line for line in self.run_well("--only", "angle", "--format", "csv").splitlines() if not line.startswith("#")]
        rows = list(csv.DictReader(lines))
        self.assertEqual(len(rows), len(cells))
        self.assertEqual({row["model"] for row in rows}, {"closed form", "discrete", "planar", "spatial"})
        for cell in cells:
            self.assertEqual(cell["error"] is None, cell["verdict"] != "number", cell)
            self.assertEqual(cell["reason"] is None, cell["verdict"] == "number", cell)

    def test_regions_name_both_ends(self):
        result = json.loads(self.run_well("--only", "restitution", "--format", "json"))
        self.assertEqual(result["failures"], [])
        first = [region for region in result["regions"] if region["model"] == "closed form"]
        self.assertEqual(first[0]["from"], 0)
        self.assertGreater(first[-1]["to"], 1)

    def test_the_picture_is_well_formed_svg_with_a_cell_for_each(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "map.svg")
            cells = json.loads(self.run_well("--only", "ratio", "--format", "json", "--plot", path))["cells"]
            root = xml.etree.ElementTree.parse(path).getroot()
            titles = root.findall(".//{http://www.w3.org/2000/svg}title")
            self.assertEqual(len(titles), len(cells))

    def test_the_same_digits_each_time(self):
        def digits():
            return [cell["digits"] for cell in json.loads(self.run_well("--only", "gravity", "--format", "json"))["cells"]]
        self.assertEqual(digits(), digits())

    def test_an_unknown_quantity_gets_the_nearest_and_status_2(self):
        run = extremes("--only", "angel")
        self.assertEqual((run.returncode, run.stdout), (2, ""))
        self.assertRegex(run.stderr, r"angel.*angle")
        self.assertEqual(len(run.stderr.splitlines()), 1)

    def test_bad_arguments_have_one_line_and_status_2(self):
        for arguments in (["--quick", "--only", "angle"], ["--seed", "x"], ["--seconds", "0"], ["--plot", "/no/such/folder/x.svg"],
                          ["--plot", "same", "--output", "same"], ["--format", "jsn"]):
            run = extremes(*arguments)
            self.assertEqual((run.returncode, run.stdout), (2, ""), arguments)
            self.assertEqual(len(run.stderr.splitlines()), 1)

    def test_help_lists_the_quantities(self):
        text = extremes("--help").stdout
        self.assertTrue(re.search("angle, stiffness, damping, restitution", text))
        self.assertLessEqual(max(map(len, text.splitlines())), 80)
