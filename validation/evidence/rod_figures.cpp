// SPDX-License-Identifier: GPL-3.0-or-later
// Fig. 8: where the thin rod is between its first two impacts, below, at and above the fold of β.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <tuple>

#include "analytic/plane/contact_angles.hpp"
#include "analytic/plane/sequence.hpp"
#include "validation/evidence/figure.hpp"
#include "validation/run/discrete_scene.hpp"

namespace clatter::validation {
namespace {

using analytic::Angle;
using analytic::ContactAngles;
using analytic::degrees_per_radian;
using Style = FigureCurve::Style;

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

// Figs. 14 to 17: the paper's rod in the continuous model, with the discrete model for the thin rod (Eq. 9) and for
// the real rim.

namespace {

using Style = FigureCurve::Style;

/// What Figs. 14 and 15 show of a first impact.
struct FirstImpact {
  double normal_velocity = no_number, tangential_velocity = no_number, angular_velocity = no_number,
         impulse = no_number, loss = no_number;
};

FirstImpact of(const analytic::Drop& drop) {
  const analytic::Sequence sequence = impact_sequence(drop, {.impacts = 1, .amplification = false});
  const analytic::Impact& impact = sequence.rows[0].impact;
  return {impact.after.normal, impact.after.tangential, impact.after.angular, impact.normal_impulse,
          impact.energy_loss};
}

FirstImpact of(const numeric::Simulation& run) {
  if (run.impacts.empty()) return {};
  const numeric::ImpactNumbers& n = run.impacts[0].value;
  return {n.velocity_after.z(), n.velocity_after.x(), n.angular_velocity_after.y(), n.impulse.z(), n.energy_loss};
}

analytic::Drop planar_drop_of(const Scene& scene) { return std::get<analytic::Drop>(discrete_drop(scene)); }

/// The thin rod of Eq. 9 in the scene's place.
FirstImpact thin_rod(const Scene& scene, const analytic::ImpactLaw& law) {
  analytic::Drop drop = planar_drop_of(scene);
  drop.body = analytic::make_rod({.mass = scene.body.mass, .length = scene.body.length, .radius = 0});
  drop.law = law;
  return of(drop);
}

struct ShownRodNumber {
  const char *name, *unit, *quantity, *label;
  double FirstImpact::*value;
};
constexpr ShownRodNumber normal_velocity{"Vn", "m/s", "normal velocity of the mass centre after the impact",
                                         "post-impact Vₙ", &FirstImpact::normal_velocity};
constexpr ShownRodNumber tangential_velocity{"Vt", "m/s", "tangential velocity of the mass centre after the impact",
                                             "post-impact Vₜ", &FirstImpact::tangential_velocity};
constexpr ShownRodNumber angular_velocity{"Omega", "rad/s", "angular velocity after the impact", "post-impact Ω",
                                          &FirstImpact::angular_velocity};
constexpr ShownRodNumber impulse{"Pn", "N s", "normal impulse", "normal impulse Pₙ", &FirstImpact::impulse};
constexpr ShownRodNumber loss{"loss", "J", "energy lost in the impact", "energy loss", &FirstImpact::loss};

/// One kind of result: suffix of the columns and how it is drawn.
struct Source {
  const char *suffix, *words, *legend;
};

/// A panel for each number, two discrete models as lines and the continuous one as points.
/// @param axes  of all panels
/// @param every  so many points of the continuous model are drawn as one
void add_panels(Figure& figure, const std::vector<ShownRodNumber>& numbers, const std::vector<Source>& sources,
                const FigurePlot& axes, int every) {
  for (const ShownRodNumber& number : numbers) {
    FigurePlot plot = axes;
    for (std::size_t i = 0; i < sources.size(); ++i) {
      const std::string name = std::string(number.name) + "_" + sources[i].suffix;
      figure.columns.push_back({name, number.unit, std::string(number.quantity) + ", " + sources[i].words});
      plot.curves.push_back({.x = figure.columns[0].name,
                             .y = name,
                             .legend = sources[i].legend,
                             .style = std::array{Style::line, Style::dashed, Style::points}[i],
                             .colour = std::array{palette::sky, palette::discrete, palette::continuous}[i],
                             .every = i == 2 ? every : 1});
    }
    plot.y_label = figure.label(number.label, plot.curves[0].y);
    figure.plots.push_back(plot);
  }
}

/// The panels by the paper's letters.
void letter(Figure& figure, const std::vector<const char*>& letters) {
  for (std::size_t i = 0; i < letters.size(); ++i) figure.plots[i].title = letters[i];
}

void add_row(Figure& figure, double x, const std::vector<ShownRodNumber>& numbers,
             const std::vector<FirstImpact>& sources) {
  std::vector<double>& row = figure.rows.emplace_back(std::vector<double>{x});
  for (const ShownRodNumber& number : numbers) {
    for (const FirstImpact& source : sources) row.push_back(source.*number.value);
  }
}

/// More digits than the case asks for make shorter steps, so that the courses are drawn as smooth as they are.
const RunOptions smooth{.digits = 9};

const std::vector<double> contact_frictions{0.1, 0.3, 0.5, 0.7};

}  // namespace

Figure figure_rod_over_angle(CaseRuns& case_runs) {
  const std::string name = "rod-sweep";
  Figure figure{.number = 14,
                .title = "first impact of the rod over the contact angle, no friction",
                .scene = "rod-sweep",
                .columns = {{"theta", "deg", "contact angle"}}};
  const std::vector<ShownRodNumber> numbers{normal_velocity, angular_velocity, impulse, loss};
  add_panels(figure, numbers,
             {{"thin", "discrete model of the thin rod, Eqs. 9 to 11", "thin rod, Eqs. 9–11"},
              {"rim", "discrete model with the rim as contact point", "rim"},
              {"continuous", "continuous model", "continuous"}},
             {.x_label = figure.label("impact contact angle θ", "theta"), .x = {-2, 92}}, 3);
  letter(figure, {"(a)", "(b)", "(c)", "(d)"});
  figure.plots[0].y = {-0.7, 1.1};
  figure.plots[1].y = {-0.2, 4};
  figure.plots[2].y = {0, 2.1};
  figure.plots[3].y = {-0.05, 0.05};  // the losses are zero to nine digits
  const Scene scene = case_runs.scene(name);
  const auto thin = [&](double angle) { return thin_rod(scene.at(angle), planar_drop_of(scene.at(angle)).law); };
  for (const SweptSimulation& swept : case_runs.sweep(name)) {
    add_row(figure, swept.value, numbers,
            {thin(swept.value), of(planar_drop_of(scene.at(swept.value))), of(swept.run)});
    // The limit of small angles, beside the flat landing: the jump is one of the models, not of the drawing.
    if (swept.value == 0) add_row(figure, 1e-9, numbers, {thin(1e-9), of(planar_drop_of(scene.at(1e-9))), {}});
  }
  return figure;
}

Figure figure_rod_over_friction(CaseRuns& case_runs) {
  const std::string name = "rod-friction-sweep";
  Figure figure{.number = 15,
                .title = "first impact of the rod at 45 degrees over friction",
                .scene = "rod-friction-sweep",
                .columns = {{"mu", "1", "friction coefficient; impulse ratio of Eq. 9"}}};
  const std::vector<ShownRodNumber> numbers{normal_velocity, tangential_velocity, angular_velocity, impulse, loss};
  add_panels(figure, numbers,
             {{"eq9", "Eq. 9 with mu as the impulse ratio", "Eq. 9"},
              {"coulomb", "discrete model at the rim, Coulomb friction", "rim, Coulomb"},
              {"continuous", "continuous model", "continuous"}},
             {.x_label = figure.label("impulse ratio μᵢ, friction coefficient μ", "mu"), .x = {-0.02, 0.82}}, 1);
  std::swap(figure.plots[1], figure.plots[2]);  // the caption's (b) is Ω, the text's Vₜ
  letter(figure, {"(a)", "(b) caption", "(b) text", "(c)", "(d)"});
  figure.columns.push_back({"ratio_continuous", "1", "impulse ratio that came out of the continuous model"});
  const Scene scene = case_runs.scene(name);
  for (const SweptSimulation& swept : case_runs.sweep(name)) {
    const analytic::ImpactLaw as_given{.friction = analytic::FrictionKind::impulse_ratio,
                                       .friction_value = swept.value};
    add_row(figure, swept.value, numbers,
            {thin_rod(scene.at(swept.value), as_given), of(planar_drop_of(scene.at(swept.value))), of(swept.run)});
    const bool strikes = !swept.run.impacts.empty();
    const numeric::Vector3 p = strikes ? swept.run.impacts[0].value.impulse : numeric::Vector3::Zero();
    figure.rows.back().push_back(strikes ? p.x() / p.z() : no_number);
  }
  return figure;
}

Figure figure_rod_contact(CaseRuns& case_runs) {
  Figure figure{.number = 16,
                .title = "course of the rod's first contact at 45 degrees for four frictions",
                .scene = "rod-friction-01, -03, -05, -07",
                .columns = {{"mu", "1", "friction coefficient"},
                            {"time", "s", "since touch-down"},
                            {"point_vn", "m/s", "normal velocity of the contact point"},
                            {"point_vt", "m/s", "tangential velocity of the contact point"},
                            {"Fn", "N", "normal contact force"},
                            {"Ft", "N", "tangential contact force"}}};
  for (const double mu : contact_frictions) {
    const auto& samples = case_runs.history(fmt::format("rod-friction-0{}", std::lround(10 * mu)), smooth).samples;
    for (const numeric::HistorySample& s : samples) {
      if (!s.in_contact) continue;
      figure.rows.push_back({mu, s.time, s.point_velocity.z(), s.point_velocity.x(), s.force.z(), s.force.x()});
    }
  }
  for (const auto& [column, words] : {std::pair{"point_vn", "contact point vₙ"},
                                      {"point_vt", "contact point vₜ"},
                                      {"Fn", "normal force Fₙ"},
                                      {"Ft", "tangential force Fₜ"}}) {
    FigurePlot plot{.x_label = "time [ms]", .y_label = figure.label(words, column), .x_factor = 1e3};
    for (const double mu : contact_frictions)
      plot.curves.push_back({.x = "time", .y = column, .legend = fmt::format("μ = {}", mu), .where = {{"mu", mu}}});
    figure.plots.push_back(plot);
  }
  letter(figure, {"(a)", "(b)", "(c)", "(d)"});
  return figure;
}

Figure figure_rod_sequence(CaseRuns& case_runs) {
  Figure figure{.number = 17,
                .title = "several impacts of the damped rod with friction, by the text and by the caption",
                .scene = "rod-at-1ms (text, v_n = -1), rod-from-2m (caption, z_c = 2)",
                .columns = {{"variant", "1", "1: the text's 1 m/s; 2: the caption's drop from 2 m"}}};
  add_history_columns(figure);
  double variant = 1;
  for (const auto& [name, caption, legend] :
       {std::tuple{"rod-at-1ms", " text", "impact at 1 m/s"}, {"rod-from-2m", " caption", "drop from 2 m"}}) {
    for (const numeric::HistorySample& s : case_runs.history(name, smooth).samples)
      add_history_row(figure, {variant}, s);
    add_history_panels(figure, caption, legend, {{"variant", variant}});
    ++variant;
  }
  return figure;
}

}  // namespace clatter::validation
