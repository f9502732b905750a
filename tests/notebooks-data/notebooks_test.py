# SPDX-License-Identifier: GPL-3.0-or-later
"""The notebooks as committed: what a reader on the web sees, and the numbers of the solutions against other oracles.

That the outputs are those of the program is judged by notebooks.py --check, which runs the cells.
"""

import os
import re
import unittest
from pathlib import Path

import nbformat

from oracles import ORACLES

FOLDER = Path(os.environ["CLATTER_ROOT"]) / "notebooks-data" / "notebooks"
LECTURES = sorted(FOLDER.glob("[0-9]*.ipynb"), key=lambda path: int(path.name.split("_")[0]))
SOLUTIONS = FOLDER / "solutions.ipynb"
LARGEST = 400_000  # bytes of a notebook
NUMBER = re.compile(r"\*\*(-?[0-9][^*]*)\*\*")


def cells(path, kind):
    return [cell for cell in nbformat.read(path, as_version=4).cells if cell.cell_type == kind]


def headings(path):
    """(level, text) of each."""
    return [(len(found[1]), found[2]) for cell in cells(path, "markdown")
            for found in re.finditer(r"(?m)^(#+) (.*)$", cell.source)]


def solutions():
    """Exercise to (numbers in bold, numbers printed), as texts with units."""
    found = {}
    for cell in nbformat.read(SOLUTIONS, as_version=4).cells:
        heading = re.match(r"## (\d+\.\d)", cell.source)
        if cell.cell_type == "markdown" and heading:
            found[heading[1]] = (NUMBER.findall(cell.source), [])
        if cell.cell_type == "code":
            printed = "".join(output.text for output in cell.outputs if output.get("name") == "stdout")
            for exercise, number in re.findall(r"(?m)^(\d+\.\d): (.*)$", printed):
                found[exercise][1].append(number)
    return found


class Lectures(unittest.TestCase):
    def test_there_are_fifteen_and_each_has_its_parts(self):
        self.assertEqual([path.name.split("_")[0] for path in LECTURES], [str(number) for number in range(1, 16)])
        for path in LECTURES:
            with self.subTest(notebook=path.name):
                found = headings(path)
                self.assertEqual(found[0][0], 1)
                self.assertTrue(found[0][1].startswith(path.name.split("_")[0] + ". "))
                sections = [text for level, text in found if level == 2]
                self.assertEqual(sections[0], "Predict first")
                self.assertEqual(sections[-2:], ["What we have seen", "Exercises"])

    def test_they_are_executed_without_errors_or_complaints_small_have_pictures_and_name_no_place_of_a_machine(self):
        for path in [*LECTURES, SOLUTIONS]:
            with self.subTest(notebook=path.name):
                code = cells(path, "code")
                outputs = [output for cell in code for output in cell.outputs]
                self.assertEqual([cell.execution_count for cell in code], list(range(1, len(code) + 1)))
                self.assertEqual([output for output in outputs if output.output_type == "error" or output.get("name") == "stderr"], [])
                self.assertLess(path.stat().st_size, LARGEST)
                self.assertNotRegex(path.read_text(encoding="utf-8"), r"/(home|tmp|work|root)/")
                self.assertTrue(sum("image/png" in output.get("data", {}) for output in outputs) >= 2 or path == SOLUTIONS)

    def test_every_exercise_has_a_solution_and_an_oracle(self):
        exercises = {number for path in LECTURES for cell in cells(path, "markdown")
                     for number in re.findall(r"\*\*(\d+\.\d)\*\*", cell.source)}
        self.assertEqual(len(exercises), 3 * len(LECTURES))
        self.assertEqual(set(solutions()), exercises)
        self.assertEqual(set(ORACLES), exercises)

    def test_the_prose_says_what_the_code_prints_and_that_is_right(self):
        for exercise, (prose, code) in solutions().items():
            expected, tolerance = ORACLES[exercise]
            with self.subTest(exercise=exercise):
                self.assertTrue(code)
                self.assertEqual(prose, code)
                for number, value in zip((float(text.split()[0]) for text in code), expected(), strict=True):
                    self.assertTrue(abs(number - value) <= tolerance * abs(value), f"{number} against {value}")
