"""The paper's figures: which columns of figures/figure_NN.csv each panel shows, and how."""

from matplotlib.colors import LinearSegmentedColormap

from plotting import (BLUE, GREEN, INK, PINK, RED, STYLES, Curve, Panel, common_legend, draw_panel, new_figure,
                      panel_legend)

BESIDE = {"loc": "center left", "bbox_to_anchor": (1.02, 0.5)}
MILLISECONDS = (1e3, "ms")
FIRST_TWO = (-0.0005, 0.005)  # [s] of the phone's first two impacts
NO_LOSS = (-0.05, 0.05)  # without friction and damping the losses are zero to nine digits


def both_models(columns, style_of):
    """Lines for the discrete model, points for the continuous one, and one name for all points."""
    lines = tuple(Curve(column, name, *style_of[column]) for column, name in columns.items())
    points = tuple(Curve(f"{line.y}_continuous", "", "points", line.colour) for line in lines[:-1])
    return lines + points + (Curve(f"{lines[-1].y}_continuous", "continuous model", "points", lines[-1].colour),)


def over_theta(columns, style_of, y_label, y_range, legend):
    return (Panel("", "theta", "initial contact angle θ", y_label, both_models(columns, style_of), (0, 60), y_range,
                  legend=legend),)


def with_gravity(names):
    """Columns of each number for three gravity numbers."""
    return {column + suffix: f"{sign}, {words}" for column, sign in names.items()
            for suffix, words in (("", "G = 0"), ("_G0_1", "G = 0.1"), ("_G9_81", "G = 9.81"))}


def styles_with_gravity(styles, colours):
    """One style for each number and one colour for each gravity number."""
    return {column + suffix: (style, colour) for column, style in styles.items()
            for suffix, colour in zip(("", "_G0_1", "_G9_81"), colours)}


def three_sources(x, x_label, x_range, names, numbers, every=1):
    """A panel for each number: two discrete models as lines, the continuous one as points."""
    (first, first_name), (second, second_name) = names.items()
    return tuple(Panel(letter, x, x_label, label,
                       (Curve(f"{column}_{first}", first_name), Curve(f"{column}_{second}", second_name, "dashed", RED),
                        Curve(f"{column}_continuous", "continuous", "points", INK, every=every)), x_range, y_range)
                 for letter, column, label, y_range in numbers)


def history(letters, force_name="continuous model", where=(), tops=(None, None), zooms=((), ())):
    """Force and energies over time."""
    energies = (("E", "total", INK), ("E_kinetic", "kinetic", BLUE), ("E_potential", "potential", RED))
    return (Panel(letters[0], "time", "time", "normal contact force Fₙ", (Curve("Fn", force_name, where=where),),
                  y_range=(0, tops[0]), zoom=zooms[0]),
            Panel(letters[1], "time", "time", "energy",
                  tuple(Curve(column, name, colour=colour, where=where) for column, name, colour in energies),
                  y_range=(0, tops[1]), zoom=zooms[1]))


def over_impacts():
    return tuple(Panel(letter, "impact", "number of the impact", label, (Curve(column, "continuous model", "bars"),))
                 for letter, column, label in (("(a)", "peak_force", "peak normal force"), ("(b)", "start", "elapsed time")))


def over_contact(numbers):
    """A curve for each coefficient of friction."""
    return tuple(Panel(letter, "time", "time", label,
                       tuple(Curve(column, f"μ = {mu}", colour=colour, where=("mu", mu))
                             for mu, colour in ((0.1, BLUE), (0.3, RED), (0.5, GREEN), (0.7, PINK))), x_unit=MILLISECONDS)
                 for letter, column, label in numbers)


def phone_over_angle(numbers):
    """Numbers of the first impact; at small angles the second merges into it."""
    marks = (("continuous", "points", INK, 1), ("two impacts in one", "crosses", RED, 2))
    return tuple(Panel(letter, "theta", "impact contact angle θ", label,
                       lines + tuple(Curve(column, name, style, colour, ("touches", touches), 2 if touches == 1 else 1)
                                     for name, style, colour, touches in marks), (0, 90), y_range)
                 for letter, column, label, y_range, lines in numbers)


#: Panels, how many stand side by side, and the size of one in inches.
PANELS = {
    7: (over_theta({"beta": "β, discrete model"}, {"beta": ("line", BLUE)}, "contact angle β", (0, 90),
                   {"loc": "upper left"}), 1, (4.8, 3.3)),
    9: (over_theta({"P1": "P₁, discrete model", "P2": "P₂, discrete model"}, {"P1": ("line", BLUE), "P2": ("line", RED)},
                   "normal impulse P₁, P₂", (0, 1.2), {"loc": "lower left"}), 1, (4.8, 3.3)),
    10: (over_theta({"beta": "β, discrete model", "gamma": "γ, discrete model"},
                    {"beta": ("line", BLUE), "gamma": ("line", RED)}, "contact angle β, γ", (0, 90), {"loc": "upper left"}),
         1, (4.8, 3.3)),
    11: (over_theta(with_gravity({"beta": "β", "gamma": "γ"}),
                    styles_with_gravity({"beta": "line", "gamma": "dashed"}, (INK, BLUE, RED)), "contact angle β, γ", (0, 90),
                    BESIDE), 1, (6.4, 3.6)),
    12: (over_theta({"P1": "P₁, any G"} | with_gravity({"P2": "P₂", "P3": "P₃"}),
                    {"P1": ("dotted", GREEN)} | styles_with_gravity({"P2": "line", "P3": "dashed"}, (INK, BLUE, RED)),
                    "normal impulse P₁, P₂, P₃", (0, None), BESIDE), 1, (6.4, 3.6)),
    14: (three_sources("theta", "impact contact angle θ", (-2, 92), {"thin": "thin rod, Eqs. 9–11", "rim": "rim"},
                       (("(a)", "Vn", "post-impact Vₙ", (-0.7, 1.1)), ("(b)", "Omega", "post-impact Ω", (-0.2, 4)),
                        ("(c)", "Pn", "normal impulse Pₙ", (0, 2.1)), ("(d)", "loss", "energy loss", NO_LOSS)), every=3),
         2, (3.8, 2.6)),
    15: (three_sources("mu", "impulse ratio μᵢ, friction coefficient μ", (-0.02, 0.82),
                       {"eq9": "Eq. 9", "coulomb": "rim, Coulomb"},
                       (("(a)", "Vn", "post-impact Vₙ", (None, None)), ("(b) caption", "Omega", "post-impact Ω", (None, None)),
                        ("(b) text", "Vt", "post-impact Vₜ", (None, None)), ("(c)", "Pn", "normal impulse Pₙ", (None, None)),
                        ("(d)", "loss", "energy loss", (None, None)))), 2, (3.8, 2.6)),
    16: (over_contact((("(a)", "point_vn", "contact point vₙ"), ("(b)", "point_vt", "contact point vₜ"),
                       ("(c)", "Fn", "normal force Fₙ"), ("(d)", "Ft", "tangential force Fₜ"))), 2, (3.8, 2.6)),
    17: (history(("(a) text", "(b) text"), "impact at 1 m/s", ("variant", 1))
         + history(("(a) caption", "(b) caption"), "drop from 2 m", ("variant", 2)), 2, (3.8, 2.6)),
    19: (history(("(a)", "(b)"), tops=(1150, None), zooms=(((0.3, 0.6, 0.5, 0.34), FIRST_TWO), ())), 2, (3.9, 2.9)),
    20: (over_impacts(), 2, (3.4, 2.6)),
    21: (history(("(a)", "(b)"), zooms=(((0.5, 0.45, 0.47, 0.47), FIRST_TWO), ((0.52, 0.56, 0.46, 0.38), FIRST_TWO))),
         2, (3.9, 2.9)),
    22: (over_impacts(), 2, (3.4, 2.6)),
    23: ((Panel("", "time", "time", "energy",
                (Curve("E", "total", colour=INK), Curve("E_translation", "translation"),
                 Curve("E_rotation", "rotation", colour=GREEN), Curve("E_potential", "potential", colour=RED)),
                (0, None), (0, None), MILLISECONDS),), 1, (4.8, 3.3)),
    24: (phone_over_angle((
        ("(a)", "Vn", "post-impact Vₙ", (None, None), (Curve("Vn_discrete", "discrete, corner"),)),
        ("(b)", "Omega", "post-impact Ω", (None, None), (Curve("Omega_discrete", "discrete, corner"),)),
        ("(c)", "peak_force", "peak normal force", (0, None), ()), ("(d)", "loss", "energy loss", (0, None), ()))),
         2, (3.8, 2.6)),
}


def draw_panels(number, table):
    panels, columns, (width, height) = PANELS[number]
    rows = -(-len(panels) // columns)
    figure = new_figure(columns * width, rows * height)
    grid = figure.add_gridspec(rows, columns)
    drawn = [figure.add_subplot(grid[divmod(place, columns)]) for place in range(len(panels))]
    for axes, panel in zip(drawn, panels):
        draw_panel(axes, table, panel)
    names = [set(axes.get_legend_handles_labels()[1]) for axes in drawn]
    if len(panels) > 1 and all(own <= names[0] for own in names):
        common_legend(figure, drawn[0].get_legend_handles_labels(), 4)
    else:
        for axes, panel in zip(drawn, panels):
            panel_legend(axes, panel.legend)
    return figure


POSITIONS = {1: "(a1)", 2: "(a2)", 3: "(b)", 4: "(c)"}


def draw_positions(table):
    """Fig. 8: the rod at several instants, later ones darker, and the velocity of its centre after each impact."""
    figure = new_figure(7.6, 7.2)
    for axes, (panel, letter) in zip(figure.subplots(2, 2).flat, POSITIONS.items()):
        rows = table.where(table["panel"] == panel)
        flight = rows.where(rows["impacts"] == 1)
        draw_rods(axes, flight)
        speeds = [arrow(axes, flight, 0, -0.65, GREEN, "V₁")]
        if rows["impacts"][-1] == 2:
            speeds.append(arrow(axes, rows, -1, 0.65, PINK, "V₂"))
        axes.axhline(0, color=INK, linewidth=2)
        axes.set(xlim=(-0.8, 0.8), ylim=(-0.1, 1.3), aspect="equal", xlabel=f"x [{table.unit('x_a')}]",
                 ylabel=f"z [{table.unit('z_a')}]")
        axes.set_title(f"{letter} θ = {round(flight['theta'][0], 3):g}°:  {',  '.join(speeds)}", loc="left")
        if panel == 1:
            common_legend(figure, axes.get_legend_handles_labels(), 3)
    return figure


def draw_rods(axes, flight):
    shades = LinearSegmentedColormap.from_list("time", ["#c6dbef", BLUE, "#08306b"])
    for i, part in enumerate(flight["time"] / flight["time"][-1]):
        axes.plot([flight["x_a"][i], flight["x_b"][i]], [flight["z_a"][i], flight["z_b"][i]], color=shades(part),
                  label={0: "rod at impact 1", 1: "at impact 2, or last"}.get(part))
    axes.plot(flight["x_a"], flight["z_a"], color=INK, label="end a", **STYLES["points"])
    axes.plot(flight["x_b"], flight["z_b"], color=RED, label="end b", **STYLES["squares"])


def arrow(axes, rows, row, x, colour, sign):
    """The velocity of the centre, half as long as the rod if it is 1, from the centre's height; its value in words."""
    start, velocity = rows["z_centre"][row], rows["V_centre"][row]
    axes.annotate("", (x, start + velocity / 2), (x, start), zorder=5, annotation_clip=False,
                  arrowprops={"arrowstyle": "-|>", "color": colour, "linewidth": 2, "shrinkA": 0, "shrinkB": 0})
    axes.plot([x], [start], color=colour, marker="_", markersize=10, linewidth=2, label=f"velocity {sign} of the centre")
    return f"{sign} = {velocity:+.2f} |vₙ|".replace("-", "−")
