"""What all notebooks share: the look of the pictures, and answers in a form that a test can read.

    from lecture import answer, plt

A picture with axes that have no name, or with nothing that tells its curves apart, is an error of the cell.
"""

import json
import shutil
import subprocess
import sys
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from IPython import get_ipython
from matplotlib_inline.backend_inline import set_matplotlib_formats

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

from plotting import BLUE, GREEN, GREY, INK, LOOK, ORANGE, PALETTE, PINK, RED, SKY, logarithmic  # noqa: E402, F401

# PNG, since not every reader of notebooks shows SVG; without the version of matplotlib in it.
set_matplotlib_formats("png", metadata={"Software": None})
plt.rcParams.update(LOOK)
plt.rcParams.update({"figure.figsize": (6.4, 3.2), "figure.dpi": 110, "figure.constrained_layout.use": True})
np.set_printoptions(precision=6, suppress=True)


def check_pictures():
    """Each picture's axes have names (shared ones once), and a legend or words tell its curves apart."""
    for figure in map(plt.figure, plt.get_fignums()):
        plain = [axes for axes in figure.axes if axes.axison]
        words = figure.legends or any(axes.get_legend() or axes.texts or axes.get_title() for axes in plain)
        named = all(any(other.get_xlabel() for other in [axes, *axes.get_shared_x_axes().get_siblings(axes)]) and
                    any(other.get_ylabel() for other in [axes, *axes.get_shared_y_axes().get_siblings(axes)]) for axes in plain)
        if plain and not (named and words):
            raise ValueError("a picture's axes have no name, or nothing tells its curves apart")


get_ipython().events.callbacks["post_execute"].insert(0, check_pictures)


def says(*arguments):
    """What the program says to this command in JSON."""
    root = Path(__file__).resolve().parent.parent.parent
    built = root / "build" / "dev" / "validation" / "clatter"
    program = str(built) if built.exists() else shutil.which("clatter")
    done = subprocess.run([program, *map(str, arguments), "--format", "json"], capture_output=True, text=True, check=True, cwd=root)
    return json.loads(done.stdout)


def measured(action, name, *arguments):
    """What `clatter measured` says of the tracked drops that come with the program."""
    return says("measured", action, f"validation/measured/{name}.csv", *arguments)


def answer(exercise, value, digits=6, unit=""):
    """Prints the number that answers an exercise: "1.2: 54.7356 °"."""
    print(f"{exercise}: {value:.{digits}g} {unit}".rstrip())
