# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures of the league: error of the velocities over the step, and over the time of a run."""

import math

from plotting import BLUE, GREEN, GREY, ORANGE, RED, STYLES, common_legend, logarithmic, new_figure, with_look

SETTINGS = {"default": (RED, "o", "the engine's own settings"), "tuned": (BLUE, "s", "tuned")}
LAW_MARKS = {"o": "x", "s": "+"}  # so that colour is not all that tells the settings apart
SECONDS = {"1/60": 1 / 60, "1/240": 1 / 240, "1/960": 1 / 960}
ACROSS = 5
KINDS = {"native": (BLUE, "from Debian"), "node": (ORANGE, "from npm"), "program": (GREEN, "this program")}
SHOWN = 1e-4  # smaller errors are drawn there
COLUMNS = {"velocities": "line", "law_error": "dotted"}
LIMITS = (1e-17, 3.0)


def medians(league, engine, settings, column="velocities"):
    """Steps and errors where there are any."""
    steps = league.STEPS if league.last_step(engine) else ("",)
    pairs = [(step, league.median(engine, settings, step, column)) for step in steps]
    return [(step, max(error, LIMITS[0])) for step, error in pairs if error is not None]


def draw_steps(panel, league, engine):
    for settings, (colour, mark, words) in SETTINGS.items():
        for column, style in COLUMNS.items():
            points = medians(league, engine, settings, column)
            look = {"color": colour, "markersize": 3.5, "markerfacecolor": "white" if settings == "default" else colour} | STYLES[style]
            look["marker"] = mark if style == "line" else LAW_MARKS[mark]
            label = f"V and Ω, {words}" if style == "line" else f"law, {words}"
            if points and points[0][0]:
                panel.plot([SECONDS[step] for step, _ in points], [error for _, error in points], label=label, **look)
            elif points:
                panel.axhline(points[0][1], color=colour, **STYLES["dashed" if style == "line" else "dotted"])


@with_look
def against_step(league):
    """A panel for each engine, in the order of the table."""
    engines = league.ranked()
    down = -(-len(engines) // ACROSS)
    figure = new_figure(9.6, 1.5 * down + 0.6)
    panels = figure.subplots(down, ACROSS, sharex=True, sharey=True, squeeze=False).ravel()
    for panel, engine in zip(panels, engines):
        draw_steps(panel, league, engine)
        logarithmic(panel.xaxis)
        logarithmic(panel.yaxis, 5)
        panel.set_xticks(list(SECONDS.values()), list(SECONDS))
        panel.set_title(engine["name"], loc="left")
        panel.set_ylim(LIMITS)
    for panel in panels[len(engines):]:
        panel.set_visible(False)
    for panel in panels[max(0, len(engines) - ACROSS):len(engines)]:
        panel.tick_params(labelbottom=True)
        panel.set_xlabel("time step [s]")
    figure.supylabel("error, median of the problems, worst of the starting heights", fontsize=9)
    with_steps = next(panel for panel, engine in zip(panels, engines) if league.last_step(engine))
    common_legend(figure, with_steps.get_legend_handles_labels(), 4)
    return figure


@with_look
def against_cost(league):
    """A panel for each of the settings; a line goes through an engine's three steps, its name stands at the right."""
    figure = new_figure(9.6, 7.2)
    panels = figure.subplots(2, 1, sharex=True)
    for panel, (settings, (_, _, words)) in zip(panels, SETTINGS.items()):
        ends = [end for engine in league.engines if (end := draw_costs(panel, league, engine, settings))]
        logarithmic(panel.xaxis)
        logarithmic(panel.yaxis)
        panel.set(ylabel=f"error of V and Ω [–] (least: {SHOWN:.0e})", ylim=(SHOWN / 2, LIMITS[1]))
        panel.set_title(words, loc="left")
        write_names(panel, ends)
    panels[1].set_xlabel("time of the steps for a second of motion [s]")
    for colour, words in KINDS.values():
        panels[0].plot([], [], color=colour, marker="o", markersize=3, label=words)
    common_legend(figure, panels[0].get_legend_handles_labels(), len(KINDS))
    return figure


def draw_costs(panel, league, engine, settings):
    """@return the engine's name, colour and last point, None without points."""
    points = [(league.cost(engine, settings, step), max(error, SHOWN)) for step, error in medians(league, engine, settings)]
    points = [point for point in points if math.isfinite(point[0])]
    if not points:
        return None
    colour = KINDS[engine["adapter"]][0]
    panel.plot(*zip(*points), color=colour, marker="o", markersize=2.5, linewidth=0.7)
    return engine["name"], colour, points[-1]


def write_names(panel, ends):
    """A column of names at the right, in the order of their points' heights, each with a thin line to its point."""
    ends = sorted(ends, key=lambda end: end[2][1])
    for place, (name, colour, (x, y)) in enumerate(ends):
        at = (place + 0.5) / len(ends)
        panel.annotate(name, (x, y), (1.06, at), textcoords="axes fraction", fontsize=7, va="center", color=colour,
                       arrowprops={"arrowstyle": "-", "color": GREY, "linewidth": 0.3, "shrinkA": 0, "shrinkB": 2})
