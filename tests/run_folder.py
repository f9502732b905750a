# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs of the program, also in a folder of their own.  CLATTER_PROGRAM is the program, CLATTER_ROOT the source tree."""

import csv
import json
import os
import re
import shlex
import subprocess
import tempfile
import unittest
from pathlib import Path

from waiting import until

PROGRAM = os.environ["CLATTER_PROGRAM"]
ROOT = os.environ["CLATTER_ROOT"]
CASES = os.path.join(ROOT, "validation", "cases")
MPIRUN = [os.environ.get("CLATTER_MPIEXEC", ""), "--allow-run-as-root", "--oversubscribe", "-n"]
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


def printed(*arguments, status=(0,), **options):
    """What a run prints that ends with one of these statuses."""
    done = run(*arguments, **options)
    if done.returncode not in status:
        raise AssertionError((arguments, done.returncode, done.stderr))
    return done.stdout


def json_of(*arguments, **options):
    return json.loads(printed(*arguments, "--format", "json", **options))


def commands():
    """The words of each command and of its forms, such as ["plan", "--tradeoff"], as the manual page has them."""
    return [name.replace("\\", "").split() for name in re.findall(r"^\.SH clatter (.+)$", printed("man"), re.M)]


def records(text):
    """Rows of a CSV text, without the comments above them."""
    return list(csv.DictReader(line for line in text.splitlines(True) if not line.startswith("#")))


def rows_of(*arguments, **options):
    return records(printed(*arguments, "--format", "csv", **options))


def stl(triangles):
    """An STL file of triangles of three corners each, counterclockwise seen from outside."""
    facets = ("".join("vertex %r %r %r\n" % tuple(corner) for corner in triangle) for triangle in triangles)
    return "solid body\n" + "".join(f"facet normal 0 0 0\nouter loop\n{facet}endloop\nendfacet\n" for facet in facets) + "endsolid body\n"


class EmptyFolder(unittest.TestCase):
    """In which the program runs."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def path(self, name):
        return os.path.join(self.folder, name)

    def write(self, name, text):
        Path(self.path(name)).write_text(text, encoding="utf-8")
        return self.path(name)

    def read(self, name):
        return Path(self.path(name)).read_text(encoding="utf-8")

    def bytes(self, name):
        return Path(self.path(name)).read_bytes()

    def stopped(self, number, output, *command):
        """Status and words of a run that a signal stops once the part of its output has more than a head, or a part left by
        another has grown."""
        part = self.path(output + ".part")
        size = os.path.getsize(part) if os.path.exists(part) else 0
        with subprocess.Popen([PROGRAM, *command, "--output", output], cwd=self.folder, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
                              text=True) as process:
            until(lambda: process.poll() is not None or os.path.exists(part) and os.path.getsize(part) > size + 20000)
            process.send_signal(number)
            words = process.communicate()[1]
        return process.returncode, words

    def records(self, name):
        return records(self.read(name))

    def contents(self):
        """Names with what is below them: a link's target, a file's text."""
        found = {}
        for folder, folders, files in os.walk(self.folder):
            for name in folders + files:
                path = os.path.join(folder, name)
                found[path] = os.readlink(path) if os.path.islink(path) else os.path.isfile(path) and Path(path).read_bytes()
        return found

    def run_program(self, *arguments, **options):
        return run(*arguments, **{"cwd": self.folder, **options})

    def json_of(self, *arguments, status=(0, 3), **options):
        return json_of(*arguments, status=status, **{"cwd": self.folder, **options})

    def refused(self, words, *arguments, status=2, **options):
        """One line that says so, and nothing has changed."""
        before = self.contents()
        done = self.run_program(*arguments, **options)
        self.assertEqual((done.returncode, done.stdout or ""), (status, ""), (arguments, done.stderr))
        self.assertRegex(done.stderr, r"\Aclatter: [^\n]+\n\Z", arguments)
        self.assertIn(words, done.stderr, arguments)
        self.assertEqual(self.contents(), before, arguments)
        return done.stderr

    def each_refused(self, table, *command, **options):
        """Arguments, as one types them or apart, and what is said of them."""
        for arguments, words in table.items():
            with self.subTest(arguments):
                self.refused(words, *command, *(shlex.split(arguments) if isinstance(arguments, str) else arguments), **options)


class Folder(EmptyFolder):
    """With a scene and its mesh."""

    def setUp(self):
        super().setUp()
        self.write("scene.toml", MESHED)
        self.write("body.stl", TETRAHEDRON)
