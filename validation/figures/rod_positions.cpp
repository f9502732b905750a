// SPDX-License-Identifier: GPL-3.0-or-later
// Fig. 8: where the thin rod is between its first two impacts, below, at and above the fold of β.
#include <fmt/format.h>

#include <cmath>

#include "analytic/plane/contact_angles.hpp"
#include "validation/figures/figures.hpp"

namespace clatter::validation::inline figures {
namespace {

using analytic::Angle;
using analytic::ContactAngles;
using analytic::degrees_per_radian;
using Style = FigureCurve::Style;

constexpr int instants = 9;                                 // in each panel, both ends of the flight included
constexpr double turned_beyond_upright = analytic::pi / 6;  // at the last instant of a rod that takes off

/// Two cases of the paper's (a): the centre still moves down after impact 1 below 54.7356°, and up above it (E7).
std::vector<std::pair<std::string, Angle>> panels() {
  const Angle fold = Angle::from_radians(regime_boundary(analytic::ImpactNumber::second, {}).theta);
  return {{"(a1)", Angle::from_degrees(45)},
          {"(a2)", Angle::from_degrees(56.5)},
          {"(b)", fold},
          {"(c)", Angle::from_degrees(65)}};
}

/// What a row says besides panel and θ.
struct Position {
  int impacts;  ///< so far
  double time, inclination, height, velocity, angular;
};

void add_row(Figure& figure, double panel, double theta, const Position& p) {
  const double x = std::cos(p.inclination) / 2, z = std::sin(p.inclination) / 2;
  figure.rows.push_back({panel, theta * degrees_per_radian, static_cast<double>(p.impacts), p.time,
                         p.inclination * degrees_per_radian, -x, p.height - z, 0, p.height, x, p.height + z, p.velocity,
                         p.angular, p.velocity + p.angular * x, p.velocity - p.angular * x});
}

/// The flight after impact 1 at even instants; at its end, if there is an impact 2, the rod before and after it.
void add_rows(Figure& figure, double panel, const Angle& theta) {
  const ContactAngles angles = contact_angles(theta, {});
  const bool strikes = angles.impacts() > 1;
  const double velocity = angles.velocity[0], angular = angles.angular[0], start = theta.radians;
  const double last = strikes ? -angles.beta.angle : -analytic::pi / 2 - turned_beyond_upright;
  const double duration = strikes ? angles.beta.time : (start - last) / angular;
  for (int i = 0; i < instants; ++i) {
    const double time = duration * i / (instants - 1);
    const double inclination = i + 1 == instants ? last : start - angular * time;
    add_row(figure, panel, start, {1, time, inclination, theta.sine / 2 + velocity * time, velocity, angular});
  }
  if (!strikes) return;
  add_row(figure, panel, start,
          {2, duration, last, theta.sine / 2 + velocity * duration, angles.velocity[1], angles.angular[1]});
}

std::string signed_text(double value) { return (value < 0 ? "−" : "+") + fmt::format("{:.2f}", std::fabs(value)); }

/// The rods and their ends of the rows of a panel, all but the last after impact 1; the speeds of the centre above it.
void add_panel(Figure& figure, double number, const std::string& letter) {
  const auto value = [&](const std::vector<double>& row, const char* name) {
    return row[column_index(figure.columns, name)];
  };
  const std::vector<double>&first = figure.rows[figure.rows.size() - instants], &last = figure.rows.back();
  FigurePlot plot{
      .title = fmt::format("{} θ = {:g}°:  V₁ = {} |vₙ|", letter, std::round(1e3 * value(first, "theta")) / 1e3,
                           signed_text(value(first, "V_centre"))),
      .x_label = figure.label("x", "x_a"),
      .y_label = figure.label("z", "z_a"),
      .x = {-0.8, 0.8},
      .y = {-0.1, 1.3},
      .equal_scales = true};
  if (value(last, "impacts") == 2) plot.title += fmt::format(",  V₂ = {} |vₙ|", signed_text(value(last, "V_centre")));
  const RowFilter flight{{"panel", number}, {"impacts", 1}};
  plot.curves = {{.x = "x_a",
                  .y = "z_a",
                  .legend = "rod, later darker",
                  .style = Style::segments,
                  .where = flight,
                  .x_end = "x_b",
                  .y_end = "z_b"},
                 {.x = "x_a", .y = "z_a", .legend = "end a", .style = Style::points, .where = flight, .colour = ink},
                 {.x = "x_b", .y = "z_b", .legend = "end b", .style = Style::squares, .where = flight, .colour = red}};
  figure.plots.push_back(plot);
}

const std::vector<FigureColumn> position_columns{{"panel", "1", "1: (a1), 2: (a2), 3: (b), 4: (c)"},
                                                 {"theta", "deg", "contact angle of the first impact"},
                                                 {"impacts", "1", "impacts so far; 2: just after the second one"},
                                                 {"time", "L/|v_n|", "since the first impact"},
                                                 {"inclination", "deg", "of the rod; positive: end a is the lower one"},
                                                 {"x_a", "L", "of end a, which strikes first"},
                                                 {"z_a", "L", "height of end a"},
                                                 {"x_centre", "L", "of the mass centre"},
                                                 {"z_centre", "L", "height of the mass centre"},
                                                 {"x_b", "L", "of end b"},
                                                 {"z_b", "L", "height of end b"},
                                                 {"V_centre", "|v_n|", "normal velocity of the mass centre"},
                                                 {"Omega", "|v_n|/L", "angular velocity; positive: clockwise"},
                                                 {"V_a", "|v_n|", "normal velocity of end a"},
                                                 {"V_b", "|v_n|", "normal velocity of end b"}};

}  // namespace

Figure figure_rod_positions() {
  Figure figure{.number = 8,
                .title = "positions of the rod from the first impact to the second, below, at and above the fold",
                .scene = "thin rod, m = L = |v_n| = 1, omega = 0, e = 1, no friction, no gravity; discrete model",
                .columns = position_columns};
  double number = 1;
  for (const auto& [letter, theta] : panels()) {
    add_rows(figure, number, theta);
    add_panel(figure, number, letter);
    ++number;
  }
  return figure;
}

}  // namespace clatter::validation::inline figures
