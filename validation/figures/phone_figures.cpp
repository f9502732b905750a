// Figs. 19 to 24: the paper's phone.
#include <fmt/format.h>

#include <cmath>

#include "analytic/sequence.hpp"
#include "validation/figures/figures.hpp"
#include "validation/figures/history_panels.hpp"
#include "validation/scene/discrete_scene.hpp"

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
  if (damped) return {"phone-damped", "validation/cases/phone-damped.toml", {.digits = 9}};
  return {"phone-elastic",
          "validation/cases/phone-elastic.toml --planar (in space it is not predictable after impact 2)",
          {.digits = 9, .planar = true}};
}

FigurePlot over_time(const std::string& title, Range2 times) {
  return {.title = title,
          .x_label = "time since the first touch-down [s]",
          .y_label = "",
          .curves = {},
          .x = times,
          .y = {}};
}

/// The end of impact 2 with some room around the first two.
Range2 first_two(const numeric::Simulation& run) {
  const numeric::ImpactNumbers& second = run.impacts.at(1).value;
  return {-1e-3, second.start + second.duration + 1e-3};
}

}  // namespace

Figure figure_phone_history(CaseRuns& case_runs, bool damped) {
  const PhoneCase phone = phone_case(damped);
  Figure figure{.number = damped ? 21 : 19,
                .title = fmt::format("impacts of the {} phone over time", damped ? "damped" : "elastic"),
                .scene = phone.scene,
                .columns = {},
                .rows = {},
                .plots = {}};
  add_history_columns(figure);
  const RecordedRun& recorded = case_runs.history(phone.name, phone.options);
  for (const numeric::HistorySample& s : recorded.samples) add_history_row(figure, {}, s);
  add_history_panels(figure, over_time("all impacts", {}));
  add_history_panels(figure, over_time("first two impacts", first_two(recorded.run)));
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
                  {"amplification", "1", "growth of a relative error of the start"}},
      .rows = {},
      .plots = {}};
  const numeric::Simulation& run = case_runs.history(phone.name, phone.options).run;
  for (std::size_t i = 0; i < run.impacts.size(); ++i) {
    const numeric::ImpactNumbers& n = run.impacts[i].value;
    const double interval = i == 0 ? no_number : n.start - run.impacts[i - 1].value.start;
    figure.rows.push_back(
        {static_cast<double>(i + 1), n.peak_force, n.start, interval, n.duration, run.impacts[i].amplification});
  }
  const double last = static_cast<double>(run.impacts.size()) + 0.6;
  figure.plots = {{.title = "",
                   .x_label = "impact",
                   .y_label = "peak normal force [N]",
                   .curves = {{.x = "impact", .y = "peak_force", .legend = "", .style = Style::bars, .where = {}}},
                   .x = {0.4, last},
                   .y = {0, no_number}},
                  {.title = "",
                   .x_label = "impact",
                   .y_label = "elapsed time [s]",
                   .curves = {{.x = "impact", .y = "start", .legend = "", .style = Style::bars, .where = {}}},
                   .x = {0.4, last},
                   .y = {0, no_number}}};
  return figure;
}

Figure figure_phone_energies(CaseRuns& case_runs) {
  Figure figure{.number = 23,
                .title = "energies of the damped phone in its first two impacts",
                .scene = "validation/cases/phone-damped.toml",
                .columns = {{"time", "s", "since the first touch-down"},
                            {"E", "J", "total energy"},
                            {"E_translation", "J", "translational kinetic energy"},
                            {"E_rotation", "J", "rotational kinetic energy"},
                            {"E_potential", "J", "potential energy"}},
                .rows = {},
                .plots = {}};
  const RecordedRun& recorded = case_runs.history("phone-damped", phone_case(true).options);
  const Range2 times = first_two(recorded.run);
  for (const numeric::HistorySample& s : recorded.samples) {
    if (s.time < 0 || s.time > times.high) continue;
    figure.rows.push_back({s.time, s.energy_total(), s.energy_translation, s.energy_rotation, s.energy_potential});
  }
  figure.plots = {energy_panel(
      over_time("", times),
      {{"E", "total"}, {"E_translation", "translation"}, {"E_rotation", "rotation"}, {"E_potential", "potential"}})};
  return figure;
}

Figure figure_phone_over_angle(CaseRuns& case_runs) {
  const std::string name = "phone-sweep";
  Figure figure{.number = 24,
                .title = "first impact of the damped phone over the contact angle",
                .scene = "validation/cases/phone-sweep.toml",
                .columns = {{"theta", "deg", "contact angle"},
                            {"Vn", "m/s", "normal velocity of the mass centre after the impact"},
                            {"Omega", "rad/s", "angular velocity after the impact"},
                            {"peak_force", "N", "largest normal force"},
                            {"loss", "J", "energy lost in the impact"},
                            {"touches", "1", "places that came down in it; 2: the second impact has merged into it"},
                            {"Vn_discrete", "m/s", "normal velocity, discrete model of the corner"},
                            {"Omega_discrete", "rad/s", "angular velocity, discrete model of the corner"}},
                .rows = {},
                .plots = {}};
  const Scene scene = scene_of_case(name, {});
  const numeric::Body body = scene.make_body();
  for (const SweptSimulation& swept : case_runs.sweep(name)) {
    const numeric::ImpactRecord& first = swept.run.impacts.at(0);
    const numeric::ImpactNumbers& n = first.value;
    const auto discrete =
        impact_sequence(discrete_drop(scene.at(swept.value), body), {.impacts = 1, .amplification = false})
            .rows[0]
            .impact;
    figure.rows.push_back({swept.value, n.velocity_after.z(), n.angular_velocity_after.y(), n.peak_force, n.energy_loss,
                           static_cast<double>(first.touches), discrete.after.normal, discrete.after.angular});
  }
  struct Panel {
    std::string continuous, discrete, label;  // no discrete column: empty
  };
  const Panel panels[] = {{"Vn", "Vn_discrete", "post-impact Vₙ [m/s]"},
                          {"Omega", "Omega_discrete", "post-impact Ω [rad/s]"},
                          {"peak_force", "", "peak normal force [N]"},
                          {"loss", "", "energy loss [J]"}};
  for (const auto& [continuous, discrete, label] : panels) {
    FigurePlot plot{
        .title = "", .x_label = "impact contact angle θ [°]", .y_label = label, .curves = {}, .x = {0, 90}, .y = {}};
    if (!discrete.empty()) {
      plot.curves.push_back({.x = "theta", .y = discrete, .legend = "discrete, corner", .where = {}});
    }
    plot.curves.push_back({.x = "theta", .y = continuous, .legend = "continuous", .style = Style::points, .where = {}});
    figure.plots.push_back(plot);
  }
  return figure;
}

}  // namespace clatter::validation
