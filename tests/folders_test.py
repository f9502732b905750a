#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Includes between the folders of a room point one way: a file includes from its own folder and from those below it."""

import re
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent

# The folders of each room from the bottom up; "." is the room's own folder.  A room that is not listed is not checked.
ORDERS = {
    "analytic": ("detail", ".", "space"),
    "numeric": ("base", "mesh", "surface", "files", "body", "motion", "contact", "stepping", "drop", "."),
    "validation": ("embedded", "output", "oracles", "record", "tables", "scene", "benchmark", "compare",
                   "figures", "plan", "sweep", "tradeoff", "measured", "verify", "extremes", "explain",
                   "reports", "demo", "cli"),
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


class Folders(unittest.TestCase):
    def test_no_folder_includes_from_a_folder_above_it(self):
        for room, order in ORDERS.items():
            with self.subTest(room=room):
                self.assertEqual(upward(ROOT, room, order), [])

    def test_the_two_models_include_nothing_of_one_another(self):
        for room, other in (("analytic", "numeric"), ("numeric", "analytic")):
            for path in sorted((ROOT / room).rglob("*.[ch]pp")):
                rooms = {of for _, of, _ in INCLUDE.findall(path.read_text(encoding="utf-8"))}
                self.assertFalse(rooms & {other, "validation"}, path)

    def test_the_includes_of_every_folder_are_seen(self):
        for room, order in ORDERS.items():
            self.assertEqual({folder for _, folder, _, _ in arrows(ROOT, room)} | {order[0]}, set(order))


if __name__ == "__main__":
    unittest.main()
