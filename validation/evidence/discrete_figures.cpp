// SPDX-License-Identifier: GPL-3.0-or-later
// Figs. 7 to 12: the thin rod's first three impacts, in 7 and 9 to 12 with the continuous model of a very thin rod on a
// very stiff ground as points.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>
#include <utility>

#include "analytic/plane/contact_angles.hpp"
#include "validation/evidence/figure.hpp"

namespace clatter::validation {
namespace {

using analytic::Angle;
using analytic::ContactAngles;
using analytic::degrees_per_radian;
using Style = FigureCurve::Style;

constexpr double last_angle = 60;
constexpr double line_step = 0.25, point_step = 5;

/// Angles and impulses of the first three impacts; NaN where an impact does not happen.
struct FirstImpacts {
  double beta = no_number, gamma = no_number;
  double impulse[3] = {no_number, no_number, no_number};
};

FirstImpacts discrete(double theta_deg, double gravity_number) {
  const ContactAngles angles = contact_angles(Angle::from_degrees(theta_deg), {.gravity_number = gravity_number});
  FirstImpacts first;
  for (int i = 0; i < angles.impacts(); ++i) first.impulse[i] = angles.impulse[i];
  if (angles.impacts() > 1) first.beta = angles.beta.angle * degrees_per_radian;
  if (angles.impacts() > 2) first.gamma = angles.gamma.angle * degrees_per_radian;
  return first;
}

/// β and γ are angles of the other end, up to the upright and in the first turn.
bool is_other_end(const numeric::ImpactRecord& before, const numeric::ImpactRecord& impact) {
  const double flight = impact.value.start - before.value.start;
  const double turned = std::fabs(before.value.angular_velocity_after.y()) * flight;
  return impact.end != before.end && std::fabs(impact.value.inclination) <= analytic::pi / 2 && turned <= analytic::pi;
}

/// Radius 1e-4 m on a ground so stiff that indentations are far below it: the thin rod to about 1e-4.
FirstImpacts continuous(double theta_deg, double gravity) {
  Scene scene;
  scene.angle_deg = theta_deg;
  scene.body.radius = 1e-4;
  scene.body.layers = 1;
  scene.world.ground.stiffness = 1e30;
  scene.world.gravity = gravity;
  scene.request.impacts = 3;
  scene.world.planar = true;
  scene.request.error_estimates = scene.request.amplification = false;
  const numeric::Body body = scene.make_body();
  const numeric::Simulation run =
      numeric::simulate(body, scene.world, scene.start(body), scene.request, scene.accuracy);
  FirstImpacts first;
  for (std::size_t i = 0; i < run.impacts.size(); ++i) {
    const numeric::ImpactRecord& impact = run.impacts[i];
    if (i > 0 && !is_other_end(run.impacts[i - 1], impact)) break;
    first.impulse[i] = impact.value.impulse.z();
    if (i == 1) first.beta = impact.value.contact_angle * degrees_per_radian;
    if (i == 2) first.gamma = impact.value.contact_angle * degrees_per_radian;
  }
  return first;
}

/// Which numbers a figure shows, by gravity number.
struct Wanted {
  bool beta = false, gamma = false;
  int impulses = 0;
  std::vector<double> gravity_numbers{0};
};

/// The end of columns' names: "" without gravity, else _G0_1 and the like.
std::string suffix(double gravity_number) {
  std::string text = gravity_number == 0 ? "" : fmt::format("_G{}", gravity_number);
  std::replace(text.begin(), text.end(), '.', '_');
  return text;
}

std::string words(double gravity_number) {
  return gravity_number == 0 ? "no gravity" : fmt::format("G = {}", gravity_number);
}

struct ShownNumber {
  std::string name, unit, quantity, sign;
  const char* colour;
};

std::vector<ShownNumber> numbers_of(const Wanted& wanted) {
  const std::string angle = "contact angle of the ", impulse = "normal impulse of the ";
  std::vector<ShownNumber> numbers;
  if (wanted.beta) numbers.push_back({"beta", "deg", angle + "second impact", "β", palette::beta});
  if (wanted.gamma) numbers.push_back({"gamma", "deg", angle + "third impact", "γ", palette::gamma});
  const std::vector<ShownNumber> impulses{{"P1", "m |v_n|", impulse + "first impact", "P₁", palette::ink},
                                          {"P2", "m |v_n|", impulse + "second impact", "P₂", palette::beta},
                                          {"P3", "m |v_n|", impulse + "third impact", "P₃", palette::gamma}};
  numbers.insert(numbers.end(), impulses.begin(), impulses.begin() + wanted.impulses);
  return numbers;
}

void add_columns(Figure& figure, const Wanted& wanted, double gravity_number) {
  for (const ShownNumber& number : numbers_of(wanted)) {
    const std::string base = number.name + suffix(gravity_number);
    figure.columns.push_back({base, number.unit, number.quantity + ", discrete model, " + words(gravity_number)});
    figure.columns.push_back(
        {base + "_continuous", number.unit,
         number.quantity + ", continuous model of a rod of radius 1e-4 m, " + words(gravity_number)});
  }
}

/// Lines for the discrete model, points for the continuous one, and one name for all points.
std::vector<FigureCurve> curves_of(const Wanted& wanted) {
  std::vector<FigureCurve> curves;
  const std::size_t gravities = wanted.gravity_numbers.size();
  for (const ShownNumber& number : numbers_of(wanted)) {
    const bool is_any_gravity = gravities > 1 && number.name == "P1";  // the first impact knows no gravity
    for (std::size_t g = 0; g < (is_any_gravity ? 1 : gravities); ++g) {
      const double gravity_number = wanted.gravity_numbers[g];
      const std::string of_gravity = is_any_gravity ? ", any G" : fmt::format(", G = {}", gravity_number);
      curves.push_back({.x = "theta",
                        .y = number.name + suffix(gravity_number),
                        .legend = number.sign + (gravities == 1 ? ", discrete model" : of_gravity),
                        .style = std::array{Style::line, Style::dashed, Style::dotted}[g],
                        .colour = number.colour});
    }
  }
  for (std::size_t i = 0, lines = curves.size(); i < lines; ++i) {
    FigureCurve points{.x = "theta", .y = curves[i].y + "_continuous", .style = Style::points};
    if (i + 1 == lines) points.legend = "continuous model";
    points.colour = palette::continuous;
    curves.push_back(points);
  }
  return curves;
}

void add_numbers(std::vector<double>& row, const Wanted& wanted, const FirstImpacts& line, const FirstImpacts& point) {
  if (wanted.beta) row.insert(row.end(), {line.beta, point.beta});
  if (wanted.gamma) row.insert(row.end(), {line.gamma, point.gamma});
  for (int i = 0; i < wanted.impulses; ++i) row.insert(row.end(), {line.impulse[i], point.impulse[i]});
}

/// Even steps, and finer ones where a branch ends, since the curves are vertical there.
std::vector<double> line_angles(const Wanted& wanted) {
  std::set<double> angles;
  for (int i = 0; i <= static_cast<int>(last_angle / line_step); ++i) angles.insert(i * line_step);
  for (const double gravity_number : wanted.gravity_numbers) {
    for (const analytic::ImpactNumber impact : {analytic::ImpactNumber::second, analytic::ImpactNumber::third}) {
      const double end = regime_boundary(impact, {.gravity_number = gravity_number}).theta * degrees_per_radian;
      for (const double before : {0.1, 0.03, 0.01, 0.003, 0.001, 1e-6}) {
        if (end - before > 0 && end < last_angle) angles.insert(end - before);
      }
    }
  }
  return {angles.begin(), angles.end()};
}

/// What tells the figures apart.
struct Kind {
  int number;
  const char* title;
  Wanted wanted;
  FigurePlot axes;
};

const std::vector<Kind> kinds{
    {7,
     "contact angle of the second impact over that of the first",
     {.beta = true},
     {.y_label = "contact angle β", .y = {0, 90}, .legend_place = "upper left"}},
    {9,
     "normal impulses of the first and the second impact",
     {.impulses = 2},
     {.y_label = "normal impulse P₁, P₂", .y = {0, 1.2}, .legend_place = "lower left"}},
    {10,
     "contact angles of the second and the third impact",
     {.beta = true, .gamma = true},
     {.y_label = "contact angle β, γ", .y = {0, 90}, .legend_place = "upper left"}},
    {11,
     "contact angles with and without gravity, G = g L/v_n^2",
     {.beta = true, .gamma = true, .gravity_numbers = {0, 0.1, 9.81}},
     {.y_label = "contact angle β, γ", .y = {0, 90}, .legend_place = "beside"}},
    {12,
     "normal impulses with and without gravity, G = g L/v_n^2",
     {.impulses = 3, .gravity_numbers = {0, 0.1, 9.81}},
     {.y_label = "normal impulse P₁, P₂, P₃", .y = {0, no_number}, .legend_place = "beside"}}};

// Fig. 8: where the thin rod is between its first two impacts, below, at and above the fold of β.

constexpr int instants = 9;                                 // in each panel, both ends of the flight included
constexpr double turned_beyond_upright = analytic::pi / 6;  // at the last instant of a rod that takes off

/// Two cases of the paper's (a): the centre still moves down after impact 1 below 54.7356°, and up above it (E7); or
/// these.
std::vector<std::pair<std::string, Angle>> panels(const std::vector<double>& angles_deg) {
  std::vector<std::pair<std::string, Angle>> given;
  for (const double angle : angles_deg)
    given.emplace_back(fmt::format("({})", given.size() + 1), Angle::from_degrees(angle));
  if (!given.empty()) return given;
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
  plot.curves = {
      {.x = "x_a",
       .y = "z_a",
       .legend = "rod, later darker",
       .style = Style::segments,
       .where = flight,
       .x_end = "x_b",
       .y_end = "z_b"},
      {.x = "x_a", .y = "z_a", .legend = "end a", .style = Style::points, .where = flight, .colour = ink},
      {.x = "x_b", .y = "z_b", .legend = "end b", .style = Style::squares, .where = flight, .colour = palette::ochre}};
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

Figure figure_of_impacts(int number, const std::vector<double>& gravity_numbers) {
  const Kind& kind = *std::ranges::find(kinds, number, &Kind::number);
  Wanted wanted = kind.wanted;
  if (!gravity_numbers.empty()) wanted.gravity_numbers = gravity_numbers;
  Figure figure{.number = number,
                .title = kind.title,
                .scene = "thin rod, m = L = |v_n| = 1, omega = 0, e = 1, no friction; points: continuous model",
                .columns = {{"theta", "deg", "contact angle of the first impact"}}};
  for (const double gravity_number : wanted.gravity_numbers) add_columns(figure, wanted, gravity_number);
  FigurePlot plot = kind.axes;
  plot.x_label = figure.label("initial contact angle θ", "theta");
  plot.y_label = figure.label(plot.y_label, figure.columns[1].name);
  plot.curves = curves_of(wanted);
  plot.x = {0, last_angle};
  for (const double theta : line_angles(wanted)) {
    const bool with_point = theta > 0 && std::fmod(theta, point_step) == 0;
    std::vector<double>& row = figure.rows.emplace_back(std::vector<double>{theta});
    for (const double gravity_number : wanted.gravity_numbers) {
      add_numbers(row, wanted, discrete(theta, gravity_number),
                  with_point ? continuous(theta, gravity_number) : FirstImpacts{});
    }
  }
  figure.plots = {plot};
  return figure;
}

Figure figure_rod_positions(const std::vector<double>& angles_deg) {
  Figure figure{.number = 8,
                .title = "positions of the rod from the first impact to the second, below, at and above the fold",
                .scene = "thin rod, m = L = |v_n| = 1, omega = 0, e = 1, no friction, no gravity; discrete model",
                .columns = position_columns};
  double number = 1;
  for (const auto& [letter, theta] : panels(angles_deg)) {
    add_rows(figure, number, theta);
    add_panel(figure, number, letter);
    ++number;
  }
  return figure;
}

}  // namespace clatter::validation
