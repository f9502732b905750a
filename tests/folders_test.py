# SPDX-License-Identifier: GPL-3.0-or-later
"""Includes point one way: a file includes from its own folder and from those below it, and no components include each
other in a circle.  A component is a header and the source of its name."""

import graphlib
import re
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent

# The folders of each room from the bottom up; "." is the room's own folder.  A room that is not listed is not checked.
ORDERS = {
    "analytic": ("base", "law", "near_flat", "plane", "space/flight", "space/impulse", "space/landing", "space/sequence",
                 "batch"),
    "numeric": ("base", "mesh", "surface", "files", "body", "motion", "contact", "stepping", "drop", "."),
    "validation": ("embedded", "oracles", "output", "scene", "run", "command", "sequence", "rod", "explain", "gradient", "atlas",
                   "benchmark", "compare", "plan", "simulate", "shock", "sweep", "report", "measured", "evidence", "demo",
                   "program"),
}
APART = {"benchmark/engines/native"}  # programs of their own, which include nothing from here
INCLUDE = re.compile(r'^\s*#include "((\w+)/(?:(.+)/)?[^/"]+)"', re.MULTILINE)


def folder_of(path, room):
    return str(path.parent.relative_to(room))


def arrows(root, room):
    """(including file, its folder, included header, its folder) of every include within the room."""
    for path in sorted((root / room).rglob("*.[ch]pp")):
        for header, of, folder in INCLUDE.findall(path.read_text(encoding="utf-8")):
            if of == room:
                yield path.relative_to(root), folder_of(path, root / room), header, folder or "."


def upward(root, room, order):
    """The includes that point up, in words, and the folders whose place is not known."""
    faults = [f"{room}/{folder} has no place in the order" for folder in sorted({folder_of(path, root / room)
              for path in (root / room).rglob("*.[ch]pp")} - set(order) - APART)]
    for path, folder, header, below in arrows(root, room):
        if folder in order and (below not in order or order.index(below) > order.index(folder)):
            faults.append(f"{path} includes {header}")
    return faults


def component_includes(root, rooms):
    """Component → the other components that its header or its source includes."""
    includes = {}
    for path in sorted(path for room in rooms for path in (root / room).rglob("*.[ch]pp")):
        of = includes.setdefault(path.relative_to(root).with_suffix("").as_posix(), set())
        of.update(header.removesuffix(".hpp") for header, *_ in INCLUDE.findall(path.read_text(encoding="utf-8")))
    return {of: to & includes.keys() - {of} for of, to in includes.items()}


def circle(includes):
    """Components each of which includes the next, and the last the first; none if there is no such circle."""
    try:
        graphlib.TopologicalSorter(includes).prepare()
    except graphlib.CycleError as error:
        return error.args[1]
    return []


class Tree(unittest.TestCase):
    def test_no_components_include_each_other_in_a_circle(self):
        self.assertEqual(circle(component_includes(ROOT, ORDERS)), [])

    def test_a_circle_is_found_through_headers_and_sources_of_one_name(self):
        files = {"a/one.hpp": "a/two.hpp", "a/two.cpp": "a/three.hpp", "a/two.hpp": "", "a/three.hpp": "a/one.hpp",
                 "a/apart.cpp": "a/one.hpp", "a/four.hpp": "", "a/four.cpp": "a/four.hpp"}
        with tempfile.TemporaryDirectory() as folder:
            (Path(folder) / "a").mkdir()
            for name, included in files.items():
                (Path(folder) / name).write_text(f'#include "{included}"\n' if included else "", encoding="utf-8")
            self.assertEqual(set(circle(component_includes(Path(folder), ["a"]))), {"a/one", "a/three", "a/two"})

    def test_every_test_of_validation_lies_in_the_folder_of_its_subject(self):
        tests = ROOT / "tests" / "validation"
        folders = {path.relative_to(tests).parent for path in tests.rglob("*") if path.is_file() and "__pycache__" not in path.parts}
        self.assertEqual([str(folder) for folder in folders if folder == Path(".") or not (ROOT / "validation" / folder).is_dir()], [])

    def test_no_folder_includes_from_a_folder_above_it(self):
        for room, order in ORDERS.items():
            with self.subTest(room=room):
                self.assertEqual(upward(ROOT, room, order), [])

    def test_no_room_includes_from_one_that_it_must_not_know(self):
        """The models nothing of one another, the program nothing of its tests, those of a model nothing of what compares both
        but oracles, which are of neither model."""
        apart = {"analytic": {"numeric", "validation", "tests"}, "numeric": {"analytic", "validation", "tests"}, "validation": {"tests"},
                 "tests/analytic": {"numeric", "validation"}, "tests/numeric": {"analytic", "validation"}}
        for folder, others in apart.items():
            for path in sorted((ROOT / folder).rglob("*.[ch]pp")):
                found = {header for header, of, _ in INCLUDE.findall(path.read_text(encoding="utf-8")) if of in others}
                self.assertEqual([one for one in found if folder[:6] != "tests/" or not one.startswith("validation/oracles/")], [], path)

    def test_oracles_include_no_formula_of_a_model(self):
        """Only the states and rows that a model takes and gives."""
        allowed = {"analytic/space/flight/body.hpp", "analytic/space/impulse/impulse_path.hpp", "analytic/space/sequence/sequence.hpp"}
        for path in sorted((ROOT / "validation" / "oracles").glob("*.hpp")):
            headers = {header for header, _, folder in INCLUDE.findall(path.read_text(encoding="utf-8")) if folder != "oracles"}
            self.assertLessEqual(headers, allowed, path)

    def test_the_includes_of_every_folder_are_seen(self):
        for room, order in ORDERS.items():
            self.assertEqual({folder for _, folder, _, _ in arrows(ROOT, room)} | {order[0]}, set(order))
