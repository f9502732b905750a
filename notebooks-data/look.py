# SPDX-License-Identifier: GPL-3.0-or-later
"""Colours, fonts and axes of all pictures; installed as clatter.look."""

import math
from typing import Any

import matplotlib  # type: ignore[import]
from matplotlib.ticker import FuncFormatter, LogLocator, NullLocator  # type: ignore[import]

#: Colours that colour-blind eyes can tell apart.
BLUE, RED, GREEN, PINK, ORANGE, SKY = PALETTE = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9")
INK, GREY = "#222222", "#777777"
#: What a colour means wherever it means one thing.
DISCRETE, CONTINUOUS, GROUND, BETA, GAMMA = BLUE, RED, GREEN, BLUE, PINK
TRANSLATION, ROTATION, POTENTIAL, SPEED = ORANGE, "#7a2a5b", SKY, ORANGE
#: Right digits, two a class from 0 on: dark for few, told apart by lightness alone.
DIGITS = ("#440154", "#46327e", "#365c8d", "#277f8e", "#1fa187", "#4ac16d", "#a0da39", "#fde725")

LOOK = {
    "font.size": 9, "font.sans-serif": ["DejaVu Sans"], "axes.titlesize": 9, "legend.fontsize": 8, "legend.frameon": False, "legend.handlelength": 1.8,
    "legend.columnspacing": 1.2, "legend.borderaxespad": 0.2, "axes.prop_cycle": matplotlib.cycler(color=PALETTE),
    "axes.grid": True, "axes.axisbelow": True, "grid.color": "#dddddd", "grid.linewidth": 0.6, "axes.edgecolor": "#444444",
    "axes.spines.top": False, "axes.spines.right": False, "lines.linewidth": 1.5, "hatch.linewidth": 0.5,
    # Text stays text; ids do not depend on the run; points that a reader could not tell apart are left out.
    "svg.fonttype": "none", "svg.hashsalt": "clatter", "path.simplify": True, "path.simplify_threshold": 0.3,
}


def superscript(value: float, _: object = None) -> str:
    """10⁻³ as text of its own, which needs no mathematical fonts."""
    exponent = round(math.log10(value))
    return "10" + str(exponent).translate(str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"))


def logarithmic(axis: Any, ticks: int = 6) -> None:
    """Powers of ten along `axis`, at most so many."""
    axis.axes.set(**{f"{axis.axis_name}scale": "log"})
    axis.set_major_locator(LogLocator(numticks=ticks))
    axis.set_major_formatter(FuncFormatter(superscript))
    axis.set_minor_locator(NullLocator())
