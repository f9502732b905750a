# SPDX-License-Identifier: GPL-3.0-or-later
"""What all pictures share: tables of the program, one look, curves in panels, and SVG with the same bytes every time."""

import csv
import io
import json
import re

import matplotlib
import numpy as np
from matplotlib.backends.backend_svg import FigureCanvasSVG
from matplotlib.colors import LinearSegmentedColormap
from matplotlib.figure import Figure

from look import (BETA, BLUE, CONTINUOUS, DIGITS, DISCRETE, GAMMA, GREEN, GREY, GROUND, INK, LOOK, ORANGE, PALETTE, PINK, RED, SKY, SPEED,  # noqa: F401
                  logarithmic, superscript)

STYLES = {
    "line": {},
    "dashed": {"linestyle": (0, (4, 2)), "linewidth": 1.2},
    "dotted": {"linestyle": (0, (1, 1.5)), "linewidth": 1.5},
    "points": {"linestyle": "none", "marker": "o", "markersize": 3.6, "markerfacecolor": "white", "markeredgewidth": 0.9},
    "squares": {"linestyle": "none", "marker": "s", "markersize": 3.8, "markerfacecolor": "white", "markeredgewidth": 0.9},
    "crosses": {"linestyle": "none", "marker": "x", "markersize": 4, "markeredgewidth": 1},
}


class Table:
    """A CSV file of the program: columns by name, as numbers (NaN: no value) where they all are, and what its head says
    of each plot: axes, curves, legend."""

    def __init__(self, columns, plots=()):
        self.columns, self.plots = columns, plots

    @classmethod
    def read(cls, path):
        lines = path.read_text(encoding="utf-8").splitlines()
        plots = [json.loads(line.removeprefix("# plot: ")) for line in lines if line.startswith("# plot: ")]
        rows = list(csv.DictReader(line for line in lines if not line.startswith("#")))
        return cls({name: as_column([row[name] for row in rows]) for name in rows[0]}, plots)

    def __getitem__(self, name):
        return self.columns[name]

    def where(self, chosen):
        """The rows that an array of truth values chooses."""
        return Table({name: column[chosen] for name, column in self.columns.items()})


def as_column(cells):
    try:
        return np.array([float(cell) if cell else np.nan for cell in cells])
    except ValueError:
        return np.array(cells)


def new_figure(width, height):
    """A figure of this many inches that keeps its labels apart."""
    figure = Figure(figsize=(width, height), layout="constrained")
    figure.get_layout_engine().set(w_pad=0.08, h_pad=0.08)
    return figure


def points_of(table, plot, curve):
    """x and y of a curve, both there where it is drawn as points.  A line that ends keeps a gap."""
    chosen = np.ones(len(table[curve["x"]]), dtype=bool)
    for column, value in curve.get("where", {}).items():
        chosen &= table[column] == value
    x, y = table[curve["x"]][chosen], table[curve["y"]][chosen]
    if curve["style"] in ("points", "squares", "crosses"):
        x, y = x[np.isfinite(y)], y[np.isfinite(y)]
    return x * plot["x_factor"], y


def draw_segments(axes, table, curve):
    """Each row a line from (x, y) to (x_end, y_end), the darker the later."""
    chosen = np.logical_and.reduce([table[column] == value for column, value in curve["where"].items()])
    ends = [table[curve[name]][chosen] for name in ("x", "y", "x_end", "y_end")]
    shades = LinearSegmentedColormap.from_list("later", ["#c6dbef", BLUE, "#08306b"])
    last = len(ends[0]) - 1
    for i, (x, y, x_end, y_end) in enumerate(zip(*ends)):
        axes.plot([x, x_end], [y, y_end], color=shades(i / last), label=curve["legend"] if i == last else None)


def draw_curves(axes, table, plot, only=(-np.inf, np.inf)):
    for curve in plot["curves"]:
        label = curve.get("legend")
        if curve["style"] == "segments":
            draw_segments(axes, table, curve)
            continue
        x, y = points_of(table, plot, curve)
        inside = (x >= only[0]) & (x <= only[1])
        x, y = x[inside], y[inside]
        if curve["style"] == "bars":
            bars = axes.bar(x, y, 0.6, color=curve["colour"], label=label)
            axes.bar_label(bars, fmt="%.3g", fontsize=7, padding=1)
        else:
            axes.plot(x, y, color=curve["colour"], label=label, markevery=curve.get("every", 1), **STYLES[curve["style"]])


def draw_plot(axes, table, plot):
    """A panel as the program describes it."""
    draw_curves(axes, table, plot)
    axes.set(xlim=plot["x"], ylim=plot["y"], xlabel=plot["x_label"], ylabel=plot["y_label"])
    if plot["equal_scales"]:
        axes.set_aspect("equal")
    if "zoom" in plot:
        draw_zoom(axes, table, plot)
    axes.set_title(plot["title"], loc="left")


def draw_zoom(axes, table, plot):
    """The panel's curves once more, over a part of the x axis, in a window with the panel's units."""
    zoom = plot["zoom"]
    window = axes.inset_axes(zoom["place"])
    draw_curves(window, table, plot, zoom["x"])
    window.set_xlim(zoom["x"])
    window.tick_params(labelsize=7)
    window.set_title(zoom["title"], fontsize=7, pad=2)
    window.set_ylim(0, None)


def panel_legend(axes, options=None):
    """Above the panel unless the options say where."""
    count = len(axes.get_legend_handles_labels()[0])
    axes.legend(**(options or {"loc": "lower right", "bbox_to_anchor": (1, 1), "ncols": count}))


def common_legend(figure, handles_labels, columns):
    """One legend below all panels."""
    handles, labels = handles_labels
    inches = 0.08 + 0.18 * -(-len(labels) // columns)
    bottom = inches / figure.get_figheight()
    figure.get_layout_engine().set(rect=(0, bottom, 1, 1 - bottom))
    figure.legend(handles, labels, loc="lower center", ncols=columns)


def with_look(draw):
    """`draw` with the look of all pictures, whatever the reader's own settings are."""
    def drawn(*arguments):
        with matplotlib.rc_context():
            matplotlib.rcdefaults()
            matplotlib.rcParams.update(LOOK)
            return draw(*arguments)
    drawn.__doc__ = draw.__doc__
    return drawn


@with_look
def svg(figure):
    """The figure as the text of an SVG file: the same bytes for the same data."""
    text = io.StringIO()
    FigureCanvasSVG(figure).print_svg(text, metadata={"Date": None, "Creator": None})
    plain = re.sub(r"<[^>]*>", lambda tag: shortened(tag[0]), re.sub(r" *\n *(<!--.*?-->)?", "\n", text.getvalue()))
    return numbered(plain)


def numbered(text):
    """Names of shapes by their order: matplotlib makes them from positions to the last bit, in which two runs may differ."""
    names = {}
    return re.sub(r'(?<=["#])[phm][0-9a-f]{10}(?=[")])', lambda name: names.setdefault(name[0], f"{name[0][0]}{len(names)}"), text)


def shortened(tag):
    """To a hundredth of a point, which is finer than any screen; no turns by nothing."""
    tag = re.sub(r"\d+\.\d{3,}", lambda number: f"{float(number[0]):.2f}".rstrip("0").rstrip("."), tag)
    return re.sub(r' transform="rotate\(-0 [^"]*"', "", tag)
