# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs of the program, also in a folder of their own.  CLATTER_PROGRAM is the program, CLATTER_ROOT the source tree."""

import csv
import os
import subprocess
import tempfile
import unittest

PROGRAM = os.environ["CLATTER_PROGRAM"]
ROOT = os.environ["CLATTER_ROOT"]
CASES = os.path.join(ROOT, "validation", "cases")
TETRAHEDRON = """solid t
facet normal 0 0 0 outer loop vertex 0 0 0 vertex 0 1 0 vertex 1 0 0 endloop endfacet
facet normal 0 0 0 outer loop vertex 0 0 0 vertex 1 0 0 vertex 0 0 1 endloop endfacet
facet normal 0 0 0 outer loop vertex 0 0 0 vertex 0 0 1 vertex 0 1 0 endloop endfacet
facet normal 0 0 0 outer loop vertex 1 0 0 vertex 0 1 0 vertex 0 0 1 endloop endfacet
endsolid t
"""
MESHED = ("[drop]\nangle_deg = 10\n[body]\nshape = 'mesh'\nmass = 1\ninertia = [0.1, 0.1, 0.1]\ncentre = [0.25, 0.25, 0.25]\n"
          "mesh = { file = 'body.stl' }\n[ground]\nstiffness = 1e8\n[run]\nimpacts = 1\ndigits = 3\n")


def case(name):
    return os.path.join(CASES, name + ".toml")


def run(*arguments, **options):
    return subprocess.run([PROGRAM, *arguments], **{"capture_output": True, "text": True, "timeout": 3000, **options})


def records(text):
    """Rows of a CSV text, without the comments above them."""
    return list(csv.DictReader(line for line in text.splitlines(True) if not line.startswith("#")))


class EmptyFolder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def path(self, name):
        return os.path.join(self.folder, name)

    def write(self, name, text):
        with open(self.path(name), "w", encoding="utf-8") as file:
            file.write(text)
        return self.path(name)

    def read(self, name):
        with open(self.path(name), encoding="utf-8") as file:
            return file.read()


class Folder(EmptyFolder):
    """With a scene and its mesh, in which the program runs."""

    def setUp(self):
        super().setUp()
        self.write("scene.toml", MESHED)
        self.write("body.stl", TETRAHEDRON)

    def contents(self):
        """Names with what is below them: a link's target, a file's text."""
        found = {}
        for folder, folders, files in os.walk(self.folder):
            for name in folders + files:
                path = os.path.join(folder, name)
                found[path] = os.readlink(path) if os.path.islink(path) else self.read(path) if os.path.isfile(path) else None
        return found

    def run_program(self, *arguments, **options):
        return run(*arguments, **{"cwd": self.folder, **options})

    def refused(self, words, *arguments, status=2, **options):
        """One line that says so, and nothing has changed."""
        before = self.contents()
        done = self.run_program(*arguments, **options)
        self.assertEqual(done.returncode, status, (arguments, done.stderr))
        self.assertRegex(done.stderr, r"\Aclatter: [^\n]+\n\Z", arguments)
        self.assertIn(words, done.stderr, arguments)
        self.assertEqual(self.contents(), before, arguments)
