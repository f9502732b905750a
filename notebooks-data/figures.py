#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws every figure of the paper from the program's own numbers, and pictures that the paper lacks.

    figures.py PROGRAM                   renews the data of the extra pictures and writes all SVG files
    figures.py PROGRAM --check           says which are not what it would write, and changes nothing
    figures.py PROGRAM --only 7 regimes  these alone

In a notebook: `%matplotlib inline`, then figures.draw(10) or figures.draw("regimes"); figures.names() lists them.
Data and specification of the paper's figures, figures/figure_NN.csv, are those of `clatter verify --figures`; documents.py renews
them.
"""

import argparse
import subprocess
import sys
from pathlib import Path

from paper_figures import draw_panels
from pictures import PICTURES
from plotting import Table, svg, with_look

DATA = Path(__file__).resolve().parent
FIGURES = DATA / "figures"


def names():
    """Numbers of the paper's figures and names of the extra pictures."""
    return sorted(int(file.stem[-2:]) for file in FIGURES.glob("figure_??.csv")) + list(PICTURES)


def table(number):
    """The data of a figure of the paper."""
    return Table.read(FIGURES / f"figure_{number:02}.csv")


@with_look
def draw(name):
    """A matplotlib figure: the paper's by its number, another picture by its name."""
    if name in PICTURES:
        return PICTURES[name].draw(DATA)
    if name not in names():
        raise ValueError(f"no picture {name!r}; there are {', '.join(map(str, names()))}")
    return draw_panels(name, table(name))


def path(name):
    """The SVG file of a picture."""
    if name in PICTURES:
        return DATA / PICTURES[name].file
    return FIGURES / f"figure_{name:02}.svg"


class Arguments(argparse.ArgumentParser):
    def error(self, message):
        self.exit(2, f"figures.py: {message}\n")


def arguments():
    parser = Arguments(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", metavar="PROGRAM", help="the program clatter")
    parser.add_argument("--check", action="store_true", help="write nothing; status 1 if a file is not what would be written")
    parser.add_argument("--only", nargs="+", metavar="NAME", help=f"of {', '.join(map(str, names()))}")
    given = parser.parse_args()
    by_text = {str(name): name for name in names()}
    unknown = [name for name in given.only or [] if name not in by_text]
    if unknown:
        parser.error(f"--only {unknown[0]}: no such picture; there are {', '.join(by_text)}")
    given.names = [by_text[name] for name in given.only or by_text]
    return given


def written(texts, check):
    """The files that do not hold these texts; they then do, unless this is a check."""
    old = [file for file, text in texts.items() if not file.exists() or file.read_text(encoding="utf-8") != text]
    for file in [] if check else old:
        file.write_text(texts[file], encoding="utf-8")
    return old


def renewed(name, program, check):
    """Data and picture of this name that are, or were, not what is to be written."""
    data = PICTURES[name].renewed(program, DATA, check) if name in PICTURES else {}
    return written(data, check) + written({path(name): svg(draw(name))}, check)


def main():
    given = arguments()
    try:
        old = [file for name in given.names for file in renewed(name, given.program, given.check)]
    except OSError as error:
        print(f"figures.py: {error.filename}: {error.strerror}", file=sys.stderr)
        return 2
    except subprocess.CalledProcessError as error:
        print(f"figures.py: {' '.join(map(str, error.cmd))}: {(error.stderr or 'failed').strip()}", file=sys.stderr)
        return 3
    for file in old if given.check else []:
        print(f"{file.relative_to(DATA.parent)} is not what would be written; run notebooks-data/figures.py")
    return 1 if given.check and old else 0


if __name__ == "__main__":
    sys.exit(main())
