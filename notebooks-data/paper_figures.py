# SPDX-License-Identifier: GPL-3.0-or-later
"""The paper's figures: the panels that the head of figures/figure_NN.csv describes, side by side."""

from plotting import GROUND, INK, SPEED, common_legend, draw_plot, new_figure, panel_legend

LEGENDS = {"": None, "beside": {"loc": "center left", "bbox_to_anchor": (1.02, 0.5)}}


def size_of(plots):
    """Width and height of a panel in inches."""
    if len(plots) == 1:
        return (6.4, 3.6) if plots[0]["legend_place"] == "beside" else (4.8, 3.3)
    if plots[0]["equal_scales"]:
        return 3.8, 3.6
    if plots[0]["curves"][0]["style"] == "bars":
        return 3.4, 2.6
    return (3.9, 2.9) if "zoom" in plots[0] else (3.8, 2.6)


def draw_panels(number, table):
    plots = table.plots
    columns = min(len(plots), 2)
    rows = -(-len(plots) // columns)
    width, height = size_of(plots)
    figure = new_figure(columns * width, rows * height)
    grid = figure.add_gridspec(rows, columns)
    drawn = [figure.add_subplot(grid[divmod(place, columns)]) for place in range(len(plots))]
    for axes, plot in zip(drawn, plots):
        draw_plot(axes, table, plot)
    if number == 8:
        draw_speeds(drawn, table)
    names = [set(axes.get_legend_handles_labels()[1]) for axes in drawn]
    if len(plots) > 1 and all(own <= names[0] for own in names):
        common_legend(figure, drawn[0].get_legend_handles_labels(), 3 if number == 8 else 4)
    else:
        for axes, plot in zip(drawn, plots):
            panel_legend(axes, LEGENDS.get(plot["legend_place"], {"loc": plot["legend_place"]}))
    return figure


def draw_speeds(panels, table):
    """Fig. 8: the velocity of the centre after each impact, and the ground."""
    for place, axes in enumerate(panels):
        rows = table.where(table["panel"] == place + 1)
        arrow(axes, rows, 0, -0.65, SPEED, "V₁")
        if rows["impacts"][-1] == 2:
            arrow(axes, rows, -1, 0.65, INK, "V₂")
        axes.axhline(0, color=GROUND, linewidth=2)


def arrow(axes, rows, row, x, colour, sign):
    """The velocity of the centre, half as long as the rod if it is 1, from the centre's height."""
    start, velocity = rows["z_centre"][row], rows["V_centre"][row]
    axes.annotate("", (x, start + velocity / 2), (x, start), zorder=5, annotation_clip=False,
                  arrowprops={"arrowstyle": "-|>", "color": colour, "linewidth": 2, "shrinkA": 0, "shrinkB": 0})
    axes.plot([x], [start], color=colour, marker="_", markersize=10, linewidth=2, label=f"velocity {sign} of the centre")
