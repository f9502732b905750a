# SPDX-License-Identifier: GPL-3.0-or-later
"""What all notebooks share: the look of the pictures, and answers in a form that a test can read.

    from clatter.lecture import answer, plt

A picture with axes that have no name, or with nothing that tells its curves apart, is an error of the cell.
"""

import csv
from importlib import resources

import matplotlib.pyplot as plt  # type: ignore[import]
import numpy as np

from clatter.look import (BETA, BLUE, CONTINUOUS, DISCRETE, GAMMA, GREEN, GREY, GROUND, INK, LOOK, ORANGE, PALETTE, PINK, RED, ROTATION, SKY,
                          TRANSLATION, logarithmic)

__all__ = ["BETA", "BLUE", "CONTINUOUS", "DISCRETE", "GAMMA", "GREEN", "GREY", "GROUND", "INK", "ORANGE", "PALETTE", "PINK", "RED", "ROTATION",
           "SKY", "TRANSLATION", "answer", "costs", "logarithmic", "np", "plt"]

plt.rcParams.update(LOOK)
plt.rcParams.update({"figure.figsize": (6.4, 3.2), "figure.dpi": 110, "figure.constrained_layout.use": True})
np.set_printoptions(precision=6, suppress=True)


def check_pictures() -> None:
    """Each picture's axes have names (shared ones once), and a legend or words tell its curves apart."""
    for figure in map(plt.figure, plt.get_fignums()):
        plain = [axes for axes in figure.axes if axes.axison]
        words = figure.legends or any(axes.get_legend() or axes.texts or axes.get_title() for axes in plain)
        named = all(any(other.get_xlabel() for other in [axes, *axes.get_shared_x_axes().get_siblings(axes)]) and
                    any(other.get_ylabel() for other in [axes, *axes.get_shared_y_axes().get_siblings(axes)]) for axes in plain)
        if plain and not (named and words):
            raise ValueError("a picture's axes have no name, or nothing tells its curves apart")


def _prepare_notebook() -> None:
    """Pictures as PNG, since not every reader of notebooks shows SVG; without the version of matplotlib in them."""
    try:
        from IPython import get_ipython  # type: ignore[import]
        from matplotlib_inline.backend_inline import set_matplotlib_formats  # type: ignore[import]
    except ImportError:
        return  # a script
    shell = get_ipython()
    if shell is not None:
        set_matplotlib_formats("png", metadata={"Software": None})
        shell.events.callbacks["post_execute"].insert(0, check_pictures)


_prepare_notebook()


def costs() -> list[dict[str, str]]:
    """What each model and method costs on the scenes that plans are made from, measured once."""
    text = resources.files("clatter").joinpath("tradeoff.csv").read_text(encoding="utf-8")
    return list(csv.DictReader(line for line in text.splitlines() if not line.startswith("#")))


def answer(exercise: str, value: float, digits: int = 6, unit: str = "") -> None:
    """Prints the number that answers an exercise: "1.2: 54.7356 °"."""
    print(f"{exercise}: {value:.{digits}g} {unit}".rstrip())
