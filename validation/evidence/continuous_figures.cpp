// SPDX-License-Identifier: GPL-3.0-or-later
// Figs. 14 to 24: the paper's rod in the continuous model, with the discrete model for the thin rod (Eq. 9) and for the
// real rim, and its phone.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <tuple>

#include "analytic/plane/sequence.hpp"
#include "validation/evidence/figure.hpp"
#include "validation/output/bad_input.hpp"
#include "validation/run/discrete_scene.hpp"

namespace clatter::validation {
namespace {

using Style = FigureCurve::Style;

/// A column, its name in the legend and its colour.
struct EnergyCurve {
  const char *column, *legend, *colour;
};

/// `axes` with these energies of the figure over its column "time", from 0 on.
FigurePlot energy_panel(FigurePlot axes, const std::vector<EnergyCurve>& energies, const RowFilter& where = {}) {
  axes.y_label = "energy [J]";
  axes.y = {0, no_number};
  for (const auto& [column, legend, colour] : energies)
    axes.curves.push_back({.x = "time", .y = column, .legend = legend, .where = where, .colour = colour});
  return axes;
}

/// Adds columns for time, normal force and energies: total, kinetic, potential.
void add_history_columns(Figure& figure) {
  figure.columns.insert(figure.columns.end(), {{"time", "s", "since the first touch-down"},
                                               {"Fn", "N", "normal contact force"},
                                               {"E", "J", "total energy"},
                                               {"E_kinetic", "J", "kinetic energy"},
                                               {"E_potential", "J", "potential energy"}});
}

/// Adds a row: `front`, then the values of those columns.
void add_history_row(Figure& figure, std::vector<double> front, const numeric::HistorySample& s) {
  front.insert(front.end(),
               {s.time, s.force.z(), s.energy_total(), s.energy_translation + s.energy_rotation, s.energy_potential});
  figure.rows.push_back(std::move(front));
}

/// Adds two panels, force and energies over all the times.
/// @param caption  behind the titles "(a)" and "(b)"
/// @param force_legend  name of the force's curve
void add_history_panels(Figure& figure, const std::string& caption, const std::string& force_legend,
                        const RowFilter& where = {}) {
  const std::string time = figure.label("time", "time");
  figure.plots.push_back(
      {.title = "(a)" + caption,
       .x_label = time,
       .y_label = figure.label("normal contact force Fₙ", "Fn"),
       .curves = {{.x = "time", .y = "Fn", .legend = force_legend, .where = where, .colour = palette::continuous}},
       .y = {0, no_number}});
  figure.plots.push_back(energy_panel({.title = "(b)" + caption, .x_label = time},
                                      {{"E", "total", ink},
                                       {"E_kinetic", "kinetic", palette::translation},
                                       {"E_potential", "potential", palette::potential}},
                                      where));
}

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
constexpr ShownRodNumber rod_impulse{"Pn", "N s", "normal impulse", "normal impulse Pₙ", &FirstImpact::impulse};
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

/// More digits than the cases ask for make shorter steps, so that the courses are drawn as smooth as they are.
/// The elastic phone is kept in its plane: in space nothing after its second impact can be predicted.
struct PhoneCase {
  std::string name, scene;
  RunOptions options;
};

PhoneCase phone_case(bool damped) {
  if (damped) return {"phone-damped", "phone-damped", {.digits = 9}};
  return {"phone-elastic",
          "phone-elastic --planar (in space it is not predictable after impact 2)",
          {.digits = 9, .planar = true}};
}

constexpr Range2 first_two{-0.0005, 0.005};  // [s] of the first two impacts

void zoom(FigurePlot& plot, FigureZoom window) {
  window.x = first_two;
  window.title = "first two impacts";
  plot.zoom = window;
}

/// Numbers of the first impact; at small angles the second merges into it.
void add_panels_over_angle(Figure& figure) {
  struct Panel {
    const char *title, *column, *discrete, *words;  ///< no discrete column: empty
    Range2 y;
  };
  const Panel panels[] = {{"(a)", "Vn", "Vn_discrete", "post-impact Vₙ", {}},
                          {"(b)", "Omega", "Omega_discrete", "post-impact Ω", {}},
                          {"(c)", "peak_force", "", "peak normal force", {0, no_number}},
                          {"(d)", "loss", "", "energy loss", {0, no_number}}};
  for (const auto& [title, column, discrete, words, range] : panels) {
    FigurePlot plot{.title = title,
                    .x_label = figure.label("impact contact angle θ", "theta"),
                    .y_label = figure.label(words, column),
                    .x = {0, 90},
                    .y = range};
    if (*discrete)
      plot.curves = {{.x = "theta", .y = discrete, .legend = "discrete, corner", .colour = palette::discrete}};
    plot.curves.push_back({.x = "theta",
                           .y = column,
                           .legend = "continuous",
                           .style = Style::points,
                           .where = {{"touches", 1}},
                           .colour = palette::continuous,
                           .every = 2});
    plot.curves.push_back({.x = "theta",
                           .y = column,
                           .legend = "two impacts in one",
                           .style = Style::crosses,
                           .where = {{"touches", 2}},
                           .colour = palette::continuous});
    figure.plots.push_back(plot);
  }
}

const std::vector<FigureColumn> over_angle_columns{
    {"theta", "deg", "contact angle"},
    {"Vn", "m/s", "normal velocity of the mass centre after the impact"},
    {"Omega", "rad/s", "angular velocity after the impact"},
    {"peak_force", "N", "largest normal force"},
    {"loss", "J", "energy lost in the impact"},
    {"touches", "1", "places that came down in it; 2: the second impact has merged into it"},
    {"Vn_discrete", "m/s", "normal velocity, discrete model of the corner"},
    {"Omega_discrete", "rad/s", "angular velocity, discrete model of the corner"}};

}  // namespace

Figure figure_rod_over_angle(CaseRuns& case_runs) {
  const std::string name = "rod-sweep";
  Figure figure{.number = 14,
                .title = "first impact of the rod over the contact angle, no friction",
                .scene = "rod-sweep",
                .columns = {{"theta", "deg", "contact angle"}}};
  const std::vector<ShownRodNumber> numbers{normal_velocity, angular_velocity, rod_impulse, loss};
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
  const std::vector<ShownRodNumber> numbers{normal_velocity, tangential_velocity, angular_velocity, rod_impulse, loss};
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

Figure figure_phone_history(CaseRuns& case_runs, bool damped) {
  const PhoneCase phone = phone_case(damped);
  Figure figure{.number = damped ? 21 : 19,
                .title = fmt::format("impacts of the {} phone over time", damped ? "damped" : "elastic"),
                .scene = phone.scene};
  add_history_columns(figure);
  const RecordedRun& recorded = case_runs.history(phone.name, phone.options);
  for (const numeric::HistorySample& s : recorded.samples) add_history_row(figure, {}, s);
  add_history_panels(figure, "", "continuous model");
  if (damped) {
    zoom(figure.plots[0], {.left = 0.5, .bottom = 0.45, .width = 0.47, .height = 0.47});
    zoom(figure.plots[1], {.left = 0.52, .bottom = 0.56, .width = 0.46, .height = 0.38});
  } else {
    zoom(figure.plots[0], {.left = 0.3, .bottom = 0.6, .width = 0.5, .height = 0.34});
    figure.plots[0].y.high = 1150;  // room for the window
  }
  return figure;
}

Figure figure_phone_impacts(CaseRuns& case_runs, bool damped) {
  const PhoneCase phone = phone_case(damped);
  Figure figure{
      .number = damped ? 22 : 20,
      .title = fmt::format("peak force and time of each impact of the {} phone", damped ? "damped" : "elastic"),
      .scene = phone.scene,
      .columns = {{"impact", "1", "number of the impact"},
                  {"peak_force", "N", "largest normal force"},
                  {"start", "s", "time of the touch-down since the first one"},
                  {"interval", "s", "time since the touch-down before"},
                  {"duration", "s", "of the contact"},
                  {"amplification", "1", "growth of a relative error of the start"}}};
  const numeric::Simulation& run = case_runs.history(phone.name, phone.options).run;
  for (std::size_t i = 0; i < run.impacts.size(); ++i) {
    const numeric::ImpactNumbers& n = run.impacts[i].value;
    const double interval = i == 0 ? no_number : n.start - run.impacts[i - 1].value.start;
    figure.rows.push_back(
        {static_cast<double>(i + 1), n.peak_force, n.start, interval, n.duration, run.impacts[i].amplification});
  }
  for (const auto& [title, column, words] :
       {std::tuple{"(a)", "peak_force", "peak normal force"}, {"(b)", "start", "elapsed time"}}) {
    figure.plots.push_back({.title = title,
                            .x_label = figure.label("number of the impact", "impact"),
                            .y_label = figure.label(words, column),
                            .curves = {{.x = "impact",
                                        .y = column,
                                        .legend = "continuous model",
                                        .style = Style::bars,
                                        .colour = palette::continuous}},
                            .whole_x = true});
  }
  return figure;
}

Figure figure_phone_energies(CaseRuns& case_runs) {
  Figure figure{.number = 23,
                .title = "energies of the damped phone in its first two impacts",
                .scene = "phone-damped",
                .columns = {{"time", "s", "since the first touch-down"},
                            {"E", "J", "total energy"},
                            {"E_translation", "J", "translational kinetic energy"},
                            {"E_rotation", "J", "rotational kinetic energy"},
                            {"E_potential", "J", "potential energy"}}};
  const RecordedRun& recorded = case_runs.history("phone-damped", phone_case(true).options);
  if (recorded.run.impacts.size() < 2) throw BadInput("figure 23: this drop has no second impact");
  const numeric::ImpactNumbers& second = recorded.run.impacts[1].value;
  const double last = second.start + second.duration + 1e-3;
  for (const numeric::HistorySample& s : recorded.samples) {
    if (s.time < 0 || s.time > last) continue;
    figure.rows.push_back({s.time, s.energy_total(), s.energy_translation, s.energy_rotation, s.energy_potential});
  }
  figure.plots = {energy_panel({.x_label = "time [ms]", .x = {0, no_number}, .x_factor = 1e3},
                               {{"E", "total", ink},
                                {"E_translation", "translation", palette::translation},
                                {"E_rotation", "rotation", palette::rotation},
                                {"E_potential", "potential", palette::potential}})};
  return figure;
}

Figure figure_phone_over_angle(CaseRuns& case_runs) {
  const std::string name = "phone-sweep";
  Figure figure{.number = 24,
                .title = "first impact of the damped phone over the contact angle",
                .scene = "phone-sweep",
                .columns = over_angle_columns};
  const Scene scene = case_runs.scene(name);
  for (const SweptSimulation& swept : case_runs.sweep(name)) {
    if (swept.run.impacts.empty()) continue;
    const numeric::ImpactRecord& first = swept.run.impacts[0];
    const numeric::ImpactNumbers& n = first.value;
    const auto discrete = impact_sequence(std::get<analytic::Drop>(discrete_drop(scene.at(swept.value))),
                                          {.impacts = 1, .amplification = false})
                              .rows[0]
                              .impact;
    figure.rows.push_back({swept.value, n.velocity_after.z(), n.angular_velocity_after.y(), n.peak_force, n.energy_loss,
                           static_cast<double>(first.touches), discrete.after.normal, discrete.after.angular});
  }
  add_panels_over_angle(figure);
  return figure;
}

}  // namespace clatter::validation
