// SPDX-License-Identifier: GPL-3.0-or-later
// Figs. 19 to 24: the paper's phone.
#include <fmt/format.h>

#include <tuple>

#include "analytic/plane/sequence.hpp"
#include "validation/evidence/figure.hpp"
#include "validation/output/bad_input.hpp"
#include "validation/run/discrete_scene.hpp"

namespace clatter::validation {
namespace {

using Style = FigureCurve::Style;

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
