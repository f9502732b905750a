# SPDX-License-Identifier: GPL-3.0-or-later
"""The programs that the launcher builds first print what the whole one prints, or leave a scene to the next with nothing written."""

import os
import subprocess
import unittest
from concurrent.futures import ThreadPoolExecutor

from run_folder import CASES, PROGRAM

LEFT = 75  # validation/program/program.hpp
CASE = sorted(file.removesuffix(".toml") for file in os.listdir(CASES) if file.endswith(".toml"))
COMMANDS = [[], ["--help"], ["--version"], ["explain", "--help"], ["sequence", "--angle", "95"], ["sequence", "no-such-case"],
            ["sequence", "--angle", "10"], ["explain", "2", "--angle", "10"], ["sequence", "--angle", "10", "--tilt", "5"],
            *(["sequence", case, "--format", "json"] for case in CASE), *(["explain", "1", case] for case in CASE)]
IN_PLANE = {"rod-10", "rod-45", "rod-damped", "phone-damped"}


def answer(suffix, command):
    done = subprocess.run([PROGRAM + suffix, *command], capture_output=True, text=True, check=False)
    return done.returncode, done.stdout, done.stderr


class FirstPrograms(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        with ThreadPoolExecutor(2) as several:
            cls.answers = {suffix: list(several.map(lambda command, suffix=suffix: answer(suffix, command), COMMANDS))
                           for suffix in ("", "-first", "-plane")}

    def test_the_first_program_prints_what_the_whole_one_prints(self):
        for command, whole, first in zip(COMMANDS, self.answers[""], self.answers["-first"], strict=True):
            self.assertEqual(first, whole, command)

    def test_the_program_in_the_plane_does_so_or_leaves_with_nothing_written(self):
        left = [command for command, plane in zip(COMMANDS, self.answers["-plane"], strict=True) if plane[0] == LEFT]
        for command, whole, plane in zip(COMMANDS, self.answers[""], self.answers["-plane"], strict=True):
            self.assertEqual(plane, (LEFT, "", "") if command in left else whole, command)
        self.assertIn(["sequence", "--angle", "10", "--tilt", "5"], left)
        for command in left:
            self.assertTrue("--tilt" in command or set(command) & set(CASE) - IN_PLANE, command)
