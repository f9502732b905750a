# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures that the paper lacks: contact angles and regimes at a glance, the fold, cost against error, the extremes."""

import itertools
from dataclasses import dataclass
from typing import Callable

import numpy as np
from matplotlib.patches import Patch, Polygon

from plotting import (BETA, BLUE, CONTINUOUS, DIGITS, DISCRETE, GAMMA, GREY, GROUND, INK, PALETTE, SPEED, STYLES, Table, common_legend, logarithmic, new_figure,
                      panel_legend)
from sources import Source


@dataclass(frozen=True)
class Picture:
    file: str  # in notebooks-data
    draw: Callable  # from that folder to a figure
    sources: tuple = ()

    def renewed(self, program, data, check):
        """Data files that do not hold what the program prints, with what it prints."""
        return {path: text for source in self.sources for path, text in source.renewed(program, data / "figures", check).items()}


def contact_angles(data):
    """β and γ over θ with and without gravity, and where each ends."""
    table = Table.read(data / "figures" / "figure_11.csv")
    figure = new_figure(6.4, 4.2)
    axes = figure.subplots()
    axes.plot([0, 90], [0, 90], color=GREY, linewidth=0.8, label="equal to θ")
    for name, sign, colour in (("beta", "β", BETA), ("gamma", "γ", GAMMA)):
        for suffix, words, style in (("", "no gravity", "line"), ("_G0_1", "G = 0.1", "dashed")):
            axes.plot(table["theta"], table[name + suffix], color=colour, label=f"{sign}, {words}", **STYLES[style])
        there = np.isfinite(table[f"{name}_continuous"])
        axes.plot(table["theta"][there], table[f"{name}_continuous"][there], color=CONTINUOUS,
                  label="continuous model" if name == "gamma" else None, **STYLES["points"])
        last = np.flatnonzero(np.isfinite(table[name]))[-1]
        x, y = table["theta"][last], table[name][last]
        axes.annotate(f"{x:.2f}°", (x, y), (-6, 0), textcoords="offset points", ha="right", va="center", color=colour)
    equal = np.degrees(np.arccos(1 / np.sqrt(3)))
    axes.annotate(f"β = θ = {equal:.2f}°", (equal, equal), (-12, 14), textcoords="offset points", ha="right",
                  arrowprops={"arrowstyle": "-", "color": GREY})
    axes.set(xlim=(0, 60), ylim=(0, 90), xlabel="contact angle θ of the first impact [°]",
             ylabel="contact angle β of the second, γ of the third [°]")
    panel_legend(axes, {"loc": "upper left"})
    return figure


def conventions(_):
    """Angles, ends and signs, drawn at a rod's first impact."""
    theta, half = np.radians(28), 1.0
    a, b = np.zeros(2), 2 * half * np.array([np.cos(theta), np.sin(theta)])
    centre = (a + b) / 2
    figure = new_figure(6.4, 3.2)
    axes = figure.subplots()
    axes.axhline(0, color=GROUND, linewidth=2)
    axes.plot(*zip(a, b), color=INK, linewidth=5, solid_capstyle="round")
    axes.plot(*centre, color="white", marker="o", markersize=5)
    for at, end, name in ((centre, (0, -0.36), "$V_n<0$"), (centre, (0.42, 0), "$V_t>0$")):
        write_arrow(axes, at, end, SPEED, name)
    for end, name in (((0, 0.75), "$P_n>0$"), ((0.4, 0), "$P_t>0$")):
        write_arrow(axes, a, end, DISCRETE, name)
    write_arrow(axes, np.array([-1.15, 0.35]), (0.35, 0), GREY, "x")
    write_arrow(axes, np.array([-1.15, 0.35]), (0, 0.35), GREY, "z")
    turn = np.radians(np.linspace(150, 40, 60))
    around = centre + 0.42 * np.stack([np.cos(turn), np.sin(turn)], axis=-1)
    axes.plot(*around[:-2].T, color=SPEED)
    axes.annotate("", around[-1], around[-4], arrowprops={"arrowstyle": "-|>", "color": SPEED, "shrinkA": 0, "shrinkB": 0})
    axes.annotate("Ω > 0", centre + [0.05, 0.47], ha="center", va="bottom", color=SPEED)
    arc = np.linspace(0, theta, 30)
    axes.plot(0.62 * np.cos(arc), 0.62 * np.sin(arc), color=INK, linewidth=1)
    axes.annotate("θ", 0.7 * np.array([np.cos(theta / 2), np.sin(theta / 2)]), ha="center", va="center")
    axes.annotate("end a", a + [-0.06, 0.03], ha="right", va="bottom")
    axes.annotate("end b", b + [0.06, 0.0], ha="left", va="center")
    for (start, end), words, shift in ((((0, -0.22), (centre[0], -0.22)), "$|d_t|$", (0, -0.05)),):
        axes.annotate("", end, start, arrowprops={"arrowstyle": "<->", "color": GREY, "shrinkA": 0, "shrinkB": 0})
        axes.annotate(words, (np.add(start, end) / 2) + shift, ha="center", va="top", color=GREY)
    axes.plot([centre[0]] * 2, [-0.26, centre[1]], color=GREY, **STYLES["dotted"] | {"linewidth": 0.8})
    axes.annotate("ground, z = 0", (2.2, -0.03), ha="right", va="top", color=GROUND)
    axes.set(aspect="equal", xlim=(-1.3, 2.35), ylim=(-0.5, 1.25), xticks=(), yticks=())
    axes.grid(False)
    for side in axes.spines.values():
        side.set_visible(False)
    return figure


def write_arrow(axes, start, by, colour, name):
    end = np.add(start, by)
    axes.annotate("", end, start, arrowprops={"arrowstyle": "-|>", "color": colour, "linewidth": 1.5, "shrinkA": 0, "shrinkB": 0})
    upright = by[0] == 0
    axes.annotate(name, end, (4, 0) if upright else (0, 4), textcoords="offset points", ha="left" if upright else "center",
                  va="center" if upright else "bottom", color=colour)


THETA_2, THETA_3 = "theta_2_deg", "theta_3_deg"
REGIMES = (Source("regimes_restitution.csv",
                  ("angles", "--regimes", "--over", "restitution", "--from", "0.01", "--to", "1", "--step", "0.01"),
                  ("restitution", THETA_2, "kind_2", THETA_3)),
           Source("regimes_gravity.csv",
                  ("angles", "--regimes", "--over", "gravity-number", "--from", "0.001", "--to", "100", "--count", "101", "--log"),
                  ("gravity-number", THETA_2, "kind_2", THETA_3)))
KINDS = {"fold": ("end b grazes", "line"), "upright": ("β reaches 90°", "dashed"), "order": ("end a comes first", "dotted")}


def regimes(data):
    """How many impacts, with β and γ up to 90°: over restitution and over gravity."""
    figure = new_figure(8.4, 4)
    panels = figure.subplots(1, 2, sharey=True)
    for axes, source, label in zip(panels, REGIMES, ("restitution coefficient e [–]", "gravity number G = g L/vₙ² [–]")):
        table = Table.read(data / "figures" / source.file)
        x, second, third = table[source.columns[0]], table[THETA_2], np.nan_to_num(table[THETA_3])
        for low, high, colour, name in ((0, third, "#fbd9bd", "three impacts"), (third, second, "#bfdcee", "two impacts"),
                                        (second, 90, "#eeeeee", "one impact")):
            axes.fill_between(x, low, high, color=colour, linewidth=0, label=name)
        for kind, (words, style) in KINDS.items():
            axes.plot(x, np.where(table["kind_2"] == kind, second, np.nan), color=BETA, label=f"θ₂: {words}", **STYLES[style])
        axes.plot(x, np.where(third < second, third, np.nan), color=GAMMA, label="θ₃: no third impact above")
        axes.set(xlim=(x[0], x[-1]), ylim=(0, 90), xlabel=label, ylabel="contact angle θ of the first impact [°]")
        axes.label_outer()
    logarithmic(panels[1].xaxis)
    panels[0].set_title("(a) no gravity", loc="left")
    panels[1].set_title("(b) e = 1", loc="left")
    common_legend(figure, panels[1].get_legend_handles_labels(), 4)
    return figure


def slope(theta):
    """K of Eq. 12."""
    return (1 - 3 * np.cos(theta)**2) / (6 * np.cos(theta))


def height(theta, beta):
    """f(θ + β) of Eq. 12: twice the height of end b over the rod's length when its contact angle is β [rad]."""
    return np.sin(theta) + slope(theta) * (theta + beta) - np.sin(beta)


def bisected(function, low, high):
    """Where a function changes its sign."""
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if (function(middle) > 0) == (function(low) > 0) else (low, middle)
    return low


def fold(_):
    """Why the second impact ends, and why a bracket from 0° to 90° misses some of the last ones."""
    low, high = np.radians([50, 60])
    # The lowest point of end b is at cos β = K; the fold is where it is on the ground.
    end = bisected(lambda theta: height(theta, np.arccos(slope(theta))), low, high)
    upright = bisected(lambda theta: height(theta, np.pi / 2), low, high)
    half = (end - upright) / 2
    figure = new_figure(8.4, 4.6)
    left, right = figure.subplots(1, 2)
    draw_heights(left, {np.radians(56): "", np.radians(57.5): "", end: "fold", np.radians(60): "no root"})
    left.set(xlim=(30, 120), ylim=(-0.08, 0.25))
    left.set_title("(a)", loc="left")
    draw_heights(right, {upright - half: "sign changes", upright: "f = 0 at 90°", upright + half: "root, no change",
                         end: "fold", end + half: "no root"})
    right.set(xlim=(76, 97), ylim=(-0.003, 0.005))
    right.set_title("(b) near the fold", loc="left")
    return figure


def draw_heights(axes, thetas):
    """f over β for each θ, with its first root, which is the second impact."""
    beta = np.radians(np.linspace(30, 120, 361))
    axes.axhline(0, color=INK, linewidth=1)
    for (theta, note), colour in zip(thetas.items(), PALETTE):
        label = f"θ = {round(np.degrees(theta), 3):g}°" + (f": {note}" if note else "")
        axes.plot(np.degrees(beta), height(theta, beta), color=colour, label=label)
        lowest = np.arccos(slope(theta))
        if note != "no root":
            root = lowest if note == "fold" else bisected(lambda b, at=theta: height(at, b), 0, lowest)
            axes.plot(np.degrees(root), 0, color=colour, **STYLES["points"] | {"markerfacecolor": colour, "markersize": 5})
    axes.plot([], [], color=GREY, label="second impact", **STYLES["points"] | {"markerfacecolor": GREY, "markersize": 5})
    axes.axvline(90, color=GREY, label="end of the bracket", **STYLES["dotted"])
    axes.set(xlabel="contact angle β = φ − θ [°]", ylabel="f(φ), Eq. 12: 2 z/L of end b [–]")
    panel_legend(axes, {"loc": "upper left", "bbox_to_anchor": (0, -0.16), "ncols": 2})


METHODS = ("tvd-rk3", "rk4", "rkf45", "rkck", "rk8pd")


def error_against_cost(data):
    """Cost and true error of every model, method and tolerance, a panel for each scene."""
    table = Table.read(data / "tradeoff.csv")
    table = table.where((table["mesh"] == "") & (np.nan_to_num(table["error"]) > 0))
    scenes = list(dict.fromkeys(table["scene"]))
    figure = new_figure(9.6, 5.4)
    panels = figure.subplots(2, 4, sharex=True, sharey=True)
    for axes, scene in zip(panels.flat, scenes):
        draw_costs(axes, table.where(table["scene"] == scene))
        axes.set_title(scene, loc="left")
        axes.set(xlabel="cost [ms]", ylabel="largest relative error [–]", ylim=(1e-14, 10))
        axes.label_outer()
    logarithmic(axes.xaxis)
    logarithmic(axes.yaxis, 5)
    common_legend(figure, panels[0, 0].get_legend_handles_labels(), 9)
    return figure


def draw_costs(axes, table):
    for method, colour in zip(METHODS, PALETTE):
        for model, style in (("planar", "line"), ("spatial", "dashed")):
            rows = table.where((table["method"] == method) & (table["model"] == model))
            axes.plot(1e3 * rows["seconds"], rows["error"], color=colour, label=method if model == "planar" else None,
                      **STYLES[style] | {"linewidth": 1})
    axes.plot([], [], color=INK, label="planar model")
    axes.plot([], [], color=INK, label="spatial model", **STYLES["dashed"])
    for model, marker in (("discrete", "D"), ("closed form", "x")):
        rows = table.where(table["model"] == model)
        axes.plot(1e3 * rows["seconds"], rows["error"], color=INK, marker=marker, markersize=4, linestyle="none",
                  label=f"{model} model" if model == "discrete" else model)


EXTREMES = Source("extremes.csv", ("verify", "--extremes", "--quick"), ("axis", "model", "label", "verdict", "digits"), same_everywhere=False)
MODELS = ("closed form", "discrete", "discrete 3D", "planar", "spatial")
AXES = {"angle": "θ [°]", "stiffness": "k_G [N/m³]", "damping": "c_G [N·s/m⁴]", "restitution": "e [–]", "ratio": "μᵢ [–]",
        "friction": "μ [–]", "speed": "speed [m/s]", "gravity": "g [m/s²]", "size": "size [× L]", "mass": "mass [× m]",
        "turns": "turns in a flight [–]", "impacts": "impacts in a run [–]", "disc": "disc off level [rad]",
        "needle": "needle off level [rad]", "slenderness": "length over diameter [–]", "bounces": "e, flat bounces [–]",
        "hops": "e, hops of a rim [–]", "squares": "tracked squares, arm [°]", "cubes": "tracked cubes, arm [°]"}
BOUNDS = (0, 2, 4, 6, 8, 10, 12, 14, 17)  # of the classes of right digits, as in the picture of `clatter verify --extremes`
HATCHES = {"bad-input": ("////", "bad input"), "ended-early": ("---", "run ends early"), "not-computed": ("\\\\\\\\", "not computed"),
           "outside-model": ("xxx", "outside the model")}


def extremes_map(data):
    """Right digits of each model from the low to the high end of each quantity; hatched where there is no number."""
    table = Table.read(data / "figures" / EXTREMES.file)
    figure = new_figure(10.4, 6.8)
    panels = figure.subplots(1, len(MODELS), sharey=True)
    names = []
    for place, (axis, words) in enumerate(AXES.items()):
        rows = table.where(table["axis"] == axis)
        names.append(f"{words}: {rows['label'][0]} … {rows['label'][-1]}")
        for axes, model in zip(panels, MODELS):
            draw_strip(axes, place, rows.where(rows["model"] == model))
    for axes, model in zip(panels, MODELS):
        axes.set_title(model, loc="left")
        axes.set(xlim=(0, 1), ylim=(len(AXES) - 0.4, -0.6), xticks=(0, 1), xticklabels=("low", "high"), xlabel="rank of the value [–]")
        axes.grid(False)
        axes.tick_params(axis="y", left=False)
    panels[0].set_yticks(range(len(AXES)), names)
    panels[0].set_ylabel("quantity, its ends [unit]")
    classes = [Patch(facecolor=shade, label=f"{low}–{min(high, 16)} digits") for shade, low, high in zip(DIGITS, BOUNDS, BOUNDS[1:])]
    refusals = [Patch(facecolor="white", edgecolor=GREY, hatch=hatch, label=words) for hatch, words in HATCHES.values()]
    refusals.append(Patch(facecolor="none", label="blank: does not apply"))
    common_legend(figure, (classes + refusals, [patch.get_label() for patch in classes + refusals]), 5)
    return figure


def draw_strip(axes, place, rows):
    """A strip from left to right; neighbours of one class are one box."""
    def kind(i):
        verdict = {"time-limit": "ended-early"}.get(rows["verdict"][i], rows["verdict"][i])
        return verdict if verdict in HATCHES else np.searchsorted(BOUNDS, rows["digits"][i], side="right") - 1

    count = len(rows["axis"])
    for what, run in itertools.groupby(range(count), key=kind):
        run = list(run)
        refused = what in HATCHES
        axes.broken_barh([(run[0] / count, len(run) / count)], (place - 0.38, 0.76),
                         facecolor="white" if refused else DIGITS[what], edgecolor=GREY if refused else "none", linewidth=0.4,
                         hatch=HATCHES[what][0] if refused else None, clip_on=False)


CORNERS = Source("corner_sequence.csv", ("sequence", "phone-corner"),
                 ("n", "corners", "place_x", "place_y", "place_z", "attitude_q0", "attitude_q1", "attitude_q2", "attitude_q3",
                  "start", "impulse_normal"))
VIEW = np.radians([-60, 0])  # azimuth and elevation from which the drop is seen: level, so that heights are true
FACES = [(axis, side) for axis in range(3) for side in (-1, 1)]


def rotation(q):
    """Body to world, Euler parameters with the scalar first."""
    w, v = q[0], np.array(q[1:])
    cross = np.array([[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]])
    return (w * w - v @ v) * np.eye(3) + 2 * np.outer(v, v) + 2 * w * cross


def seen(points):
    """Coordinates on the page of points [m]: to the right, upwards [mm]."""
    azimuth, elevation = VIEW
    right = np.array([-np.sin(azimuth), np.cos(azimuth), 0])
    towards = np.array([np.cos(azimuth) * np.cos(elevation), np.sin(azimuth) * np.cos(elevation), np.sin(elevation)])
    return 1e3 * np.stack([points @ right, points @ np.cross(towards, right)], axis=-1), towards


def corner_sequence(data):
    """A phone on its corner: its attitude at each impact, the corner that strikes and the impulse."""
    table = Table.read(data / "figures" / CORNERS.file)
    figure = new_figure(9.6, 3.6)
    axes = figure.subplots()
    axes.axhline(0, color=GROUND, linewidth=0.8)
    for i in range(len(table["n"])):
        place = np.array([table[f"place_{axis}"][i] for axis in "xyz"])
        attitude = rotation([table[f"attitude_q{k}"][i] for k in range(4)])
        corner = 140 * i - seen(-attitude @ place)[0][0]
        draw_struck_box(axes, place, attitude, corner, table["impulse_normal"][i] / max(table["impulse_normal"]))
        axes.annotate(f"impact {table['n'][i]:.0f}, corner {table['corners'][i]}\n{1e3 * table['start'][i]:.3g} ms, "
                      f"{table['impulse_normal'][i]:.3g} N·s", (140 * i, -8), ha="center", va="top")
    axes.set(aspect="equal", xlim=(-75, 140 * i + 75), ylim=(-34, 125), xlabel="across, one drop beside the other [mm]",
             ylabel="height [mm]")
    axes.plot([], [], color=DISCRETE, marker="o", markersize=4, label="corner that strikes, and its normal impulse Pₙ")
    panel_legend(axes)
    axes.grid(False)
    return figure


def draw_struck_box(axes, place, attitude, at, impulse):
    """The box of which `place` is a corner, that corner on the ground at `at`; hidden edges are thin."""
    half = np.abs(place)
    towards = seen(np.zeros(3))[1]
    for axis, side in sorted(FACES, key=lambda face: face[1] * attitude[:, face[0]] @ towards):
        others = [other for other in range(3) if other != axis]
        corners = np.zeros((4, 3))
        corners[:, axis] = side * half[axis]
        for other, signs in zip(others, ([-1, 1, 1, -1], [-1, -1, 1, 1])):
            corners[:, other] = np.array(signs) * half[other]
        page = seen((corners - place) @ attitude.T)[0] + [at, 0]
        hidden = side * attitude[:, axis] @ towards < 0
        axes.add_patch(Polygon(page, facecolor="none" if hidden else BLUE + "30", edgecolor=GREY if hidden else INK,
                               linewidth=0.5 if hidden else 1, linestyle=":" if hidden else "-"))
    axes.annotate("", (at, 60 * impulse), (at, 0), arrowprops={"arrowstyle": "-|>", "color": DISCRETE, "linewidth": 1.5})
    axes.plot(at, 0, color=DISCRETE, marker="o", markersize=4)


PICTURES = {"contact_angles": Picture("contact_angles.svg", contact_angles),
            "conventions": Picture("figures/conventions.svg", conventions),
            "regimes": Picture("figures/regimes.svg", regimes, REGIMES),
            "corner_sequence": Picture("figures/corner_sequence.svg", corner_sequence, (CORNERS,)),
            "fold": Picture("figures/fold.svg", fold),
            "error_against_cost": Picture("figures/error_against_cost.svg", error_against_cost),
            "extremes_map": Picture("figures/extremes_map.svg", extremes_map, (EXTREMES,))}
