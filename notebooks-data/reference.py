#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Builds the reference, pages that open offline, from headers, keys, columns and --help.  A warning is an error.

Usage: reference.py PROGRAM FOLDER    (then open FOLDER/html/index.html)
"""

import argparse
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent
INPUT = ("analytic", "numeric", "notebooks-data/reference")


def printed(program, *arguments):
    return subprocess.run([program, *arguments], check=True, capture_output=True, text=True).stdout


def commands(program):
    """Their names, in the order of --help."""
    listed = printed(program, "--help").split("Subcommands:\n")[1].split("\n\n")[0]
    return [line.split()[0] for line in listed.splitlines() if line.startswith("  ") and not line.startswith("   ")]


def command_page(program):
    parts = ["# Commands {#commands}\n"]
    for name in ["", *commands(program)]:
        arguments = [name] if name else []
        parts.append(f"## clatter {name}\n\n~~~~{{.txt}}\n{printed(program, *arguments, '--help')}~~~~\n")
    return "\n".join(parts)


def table_page(program, title, command):
    """A command's table as a page: its name is the page's."""
    table = "\n".join(line for line in printed(program, command, "--format", "markdown").splitlines() if line.startswith("|"))
    return f"# {title} {{#{command}}}\n\n{table}\n"


def pages(program):
    yield "commands.md", command_page(program)
    yield "keys.md", table_page(program, "Keys of scenes", "keys")
    yield "columns.md", table_page(program, "Columns", "columns")


def build(program, folder):
    """@raise CalledProcessError: doxygen found a warning."""
    folder.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as scratch:
        for name, text in pages(program):
            (Path(scratch) / name).write_text(text, encoding="utf-8")
        settings = (HERE / "reference" / "Doxyfile").read_text(encoding="utf-8")
        inputs = " ".join(f'"{path}"' for path in [*(ROOT / name for name in INPUT), scratch])
        settings += (f'PROJECT_NUMBER = {printed(program, "--version").split()[1]}\nINPUT = {inputs}\n'
                     f'OUTPUT_DIRECTORY = "{folder}"\nEXAMPLE_PATH = "{ROOT / "tests/install"}"\n'
                     f'STRIP_FROM_PATH = "{ROOT}" "{scratch}"\n')
        subprocess.run(["doxygen", "-"], input=settings, text=True, check=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=Path)
    parser.add_argument("folder", type=Path)
    given = parser.parse_args()
    try:
        build(given.program.resolve(), given.folder.resolve())
    except (OSError, subprocess.CalledProcessError) as error:
        sys.exit(f"reference.py: {error}")


if __name__ == "__main__":
    main()
