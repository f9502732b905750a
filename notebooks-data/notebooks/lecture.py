"""What all notebooks share: the look of the pictures, and answers in a form that a test can read.

    from lecture import answer, plt
"""

import sys
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from matplotlib_inline.backend_inline import set_matplotlib_formats

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

from plotting import BLUE, GREEN, GREY, INK, LOOK, ORANGE, PALETTE, PINK, RED, SKY  # noqa: E402, F401

# Pictures as SVG whose bytes depend on the data alone.
set_matplotlib_formats("svg", metadata={"Date": None, "Creator": None})
plt.rcParams.update(LOOK)
plt.rcParams.update({"figure.figsize": (6.4, 3.2), "figure.constrained_layout.use": True})
np.set_printoptions(precision=6, suppress=True)


def answer(exercise, value, digits=6, unit=""):
    """Prints the number that answers an exercise: "1.2: 54.7356 °"."""
    print(f"{exercise}: {value:.{digits}g} {unit}".rstrip())
