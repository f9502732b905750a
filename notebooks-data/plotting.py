"""What all pictures share: tables of the program, one look, curves in panels, and SVG with the same bytes every time."""

import csv
import io
import re
from dataclasses import dataclass

import matplotlib
import numpy as np
from matplotlib.backends.backend_svg import FigureCanvasSVG
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter, LogLocator, NullLocator

#: Colours that colour-blind eyes can tell apart.
BLUE, RED, GREEN, PINK, ORANGE, SKY = PALETTE = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9")
INK, GREY = "#222222", "#777777"

LOOK = {
    "font.size": 9, "font.sans-serif": ["DejaVu Sans"], "axes.titlesize": 9, "legend.fontsize": 8, "legend.frameon": False, "legend.handlelength": 1.8,
    "legend.columnspacing": 1.2, "legend.borderaxespad": 0.2, "axes.prop_cycle": matplotlib.cycler(color=PALETTE),
    "axes.grid": True, "axes.axisbelow": True, "grid.color": "#dddddd", "grid.linewidth": 0.6, "axes.edgecolor": "#444444",
    "axes.spines.top": False, "axes.spines.right": False, "lines.linewidth": 1.5, "hatch.linewidth": 0.5,
    # Text stays text; ids do not depend on the run; points that a reader could not tell apart are left out.
    "svg.fonttype": "none", "svg.hashsalt": "clatter", "path.simplify": True, "path.simplify_threshold": 0.3,
}
UNITS = {"deg": "°", "1": "–", "N s": "N·s", "m |v_n|": "m |vₙ|", "|v_n|": "|vₙ|", "|v_n|/L": "|vₙ|/L", "L/|v_n|": "L/|vₙ|"}
STYLES = {
    "line": {},
    "dashed": {"linestyle": (0, (4, 2)), "linewidth": 1.2},
    "dotted": {"linestyle": (0, (1, 1.5)), "linewidth": 1.5},
    "points": {"linestyle": "none", "marker": "o", "markersize": 3.6, "markerfacecolor": "white", "markeredgewidth": 0.9},
    "squares": {"linestyle": "none", "marker": "s", "markersize": 3.8, "markerfacecolor": "white", "markeredgewidth": 0.9},
    "crosses": {"linestyle": "none", "marker": "x", "markersize": 4, "markeredgewidth": 1},
}


class Table:
    """A CSV file of the program: columns by name, as numbers (NaN: no value) where they all are, and their units."""

    def __init__(self, columns, units):
        self.columns, self.units = columns, units

    @classmethod
    def read(cls, path):
        lines = path.read_text(encoding="utf-8").splitlines()
        # A head line of a column reads "# name [unit]: quantity".
        heads = (re.match(r"# (\w+) \[([^]]+)\]: ", line) for line in lines)
        units = {head[1]: UNITS.get(head[2], head[2]) for head in heads if head}
        rows = list(csv.DictReader(line for line in lines if not line.startswith("#")))
        return cls({name: as_column([row[name] for row in rows]) for name in rows[0]}, units)

    def __getitem__(self, name):
        return self.columns[name]

    def unit(self, name):
        return self.units[name]

    def where(self, chosen):
        """The rows that an array of truth values chooses."""
        return Table({name: column[chosen] for name, column in self.columns.items()}, self.units)


def as_column(cells):
    try:
        return np.array([float(cell) if cell else np.nan for cell in cells])
    except ValueError:
        return np.array(cells)


@dataclass(frozen=True)
class Curve:
    """One column over another.  `where` = (column, value): only those rows."""
    y: str
    legend: str = ""
    style: str = "line"  # of STYLES, or "bars"
    colour: str = BLUE
    where: tuple = ()
    every: int = 1  # a mark for each that many values; lines are whole


@dataclass(frozen=True)
class Panel:
    """Axes with the paper's letter.  The units come from the columns of the first curve."""
    letter: str
    x: str
    x_label: str
    y_label: str
    curves: tuple
    x_range: tuple = (None, None)
    y_range: tuple = (None, None)
    x_unit: tuple = ()  # (1e3, "ms"): the column times 1e3, in ms
    zoom: tuple = ()  # place (x, y, width, height in parts of the panel) and range of x of an inset
    legend: dict = None  # where it stands instead of above the panel


def new_figure(width, height):
    """A figure of this many inches that keeps its labels apart."""
    figure = Figure(figsize=(width, height), layout="constrained")
    figure.get_layout_engine().set(w_pad=0.08, h_pad=0.08)
    return figure


def points_of(table, panel, curve):
    """x and y of a curve where both are there.  A line that ends keeps a gap."""
    rows = table.where(table[curve.where[0]] == curve.where[1]) if curve.where else table
    x, y = rows[panel.x], rows[curve.y]
    if curve.style in ("points", "squares", "crosses"):
        x, y = x[np.isfinite(y)], y[np.isfinite(y)]
    return (x * panel.x_unit[0] if panel.x_unit else x), y


def draw_curves(axes, table, panel, only=(-np.inf, np.inf)):
    for curve in panel.curves:
        x, y = points_of(table, panel, curve)
        inside = (x >= only[0]) & (x <= only[1])
        x, y = x[inside], y[inside]
        if curve.style == "bars":
            bars = axes.bar(x, y, 0.6, color=curve.colour, label=curve.legend)
            axes.bar_label(bars, fmt="%.3g", fontsize=7, padding=1)
        else:
            axes.plot(x, y, color=curve.colour, label=curve.legend or None, markevery=curve.every, **STYLES[curve.style])


def draw_panel(axes, table, panel):
    draw_curves(axes, table, panel)
    axes.set(xlim=panel.x_range, ylim=panel.y_range, xlabel=f"{panel.x_label} [{(panel.x_unit or (1, table.unit(panel.x)))[1]}]",
             ylabel=f"{panel.y_label} [{table.unit(panel.curves[0].y)}]")
    if panel.zoom:
        draw_zoom(axes, table, panel)
    axes.set_title(panel.letter, loc="left")


def draw_zoom(axes, table, panel):
    """The panel's curves once more, over a part of the x axis, in a window with the panel's units."""
    place, times = panel.zoom
    window = axes.inset_axes(place)
    draw_curves(window, table, panel, times)
    window.set_xlim(times)
    window.tick_params(labelsize=7)
    window.set_title("first two impacts", fontsize=7, pad=2)
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


def superscript(value, _=None):
    """10⁻³ as text of its own, which needs no mathematical fonts."""
    exponent = round(np.log10(value))
    return "10" + str(exponent).translate(str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"))


def logarithmic(axis, ticks=6):
    """Powers of ten along `axis`, at most so many."""
    axis.axes.set(**{f"{axis.axis_name}scale": "log"})
    axis.set_major_locator(LogLocator(numticks=ticks))
    axis.set_major_formatter(FuncFormatter(superscript))
    axis.set_minor_locator(NullLocator())


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
