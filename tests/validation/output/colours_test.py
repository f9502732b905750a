# SPDX-License-Identifier: GPL-3.0-or-later
"""Colours of tables: on a terminal alone, and nothing but colours."""

import os
import pty
import re
import subprocess
import unittest

PROGRAM = os.environ["CLATTER_PROGRAM"]
ELASTIC_PHONE = ["simulate", "phone-elastic", "--impacts", "4", "--digits", "6"]  # tumbles: what follows impact 2 is "?"


def on_terminal(arguments, **settings):
    """What the program writes to a terminal."""
    leader, follower = pty.openpty()
    environment = {name: value for name, value in os.environ.items() if name not in ("NO_COLOR", "TERM")} | {"TERM": "xterm"} | settings
    process = subprocess.Popen([PROGRAM, *arguments], stdout=follower, stderr=subprocess.DEVNULL, env=environment)
    os.close(follower)
    pieces = []
    while True:
        try:
            piece = os.read(leader, 65536)
        except OSError:  # Linux says so when the other end is closed
            break
        if not piece:
            break
        pieces.append(piece)
    process.wait()
    os.close(leader)
    return b"".join(pieces).decode().replace("\r\n", "\n")


def plain(arguments):
    return subprocess.run([PROGRAM, *arguments], capture_output=True, text=True).stdout


class Colours(unittest.TestCase):
    def test_the_head_is_dim_and_the_numbers_are_not(self):
        text = on_terminal(["sequence", "--angle", "10"])
        head, rest = text.split("\033[0m", 1)
        self.assertTrue(head.startswith("\033[2mclatter"))
        self.assertIn("at most 6 impacts", head)
        self.assertNotIn("\033", rest)
        self.assertIn("0.511569", rest)

    def test_what_cannot_be_predicted_is_bold(self):
        self.assertIn("\033[1m?\033[0m", on_terminal(ELASTIC_PHONE))

    def test_without_the_colours_the_text_is_the_same(self):
        for arguments in (["sequence", "--angle", "10"], ELASTIC_PHONE):
            self.assertEqual(re.sub(r"\033\[\d*m", "", on_terminal(arguments)), plain(arguments))

    def test_there_are_none_where_nobody_wants_them(self):
        table = ["sequence", "--angle", "10"]
        for text in (plain(table), on_terminal(table, NO_COLOR="1"), on_terminal(table, TERM="dumb"),
                     on_terminal([*table, "--format", "csv"]), on_terminal([*table, "--ascii"]), on_terminal(["keys"])):
            self.assertNotIn("\033", text)
