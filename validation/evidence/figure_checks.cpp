// SPDX-License-Identifier: GPL-3.0-or-later
// The figures of the paper: does what they show obey the laws that it must?
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "validation/evidence/check.hpp"
#include "validation/evidence/figure.hpp"

namespace clatter::validation {
namespace {

using numeric::HistorySample;
using numeric::ImpactNumbers;
using numeric::Simulation;

/// Worst distance of the points of the continuous model from the lines of the discrete one, over the largest value of
/// each column; no number where one model has an impact and the other has not.
Measured distance_of_points(const Figure& figure) {
  WorstError worst;
  int points = 0;
  for (std::size_t column = 1; column + 1 < figure.columns.size(); column += 2) {
    double scale = 0;
    for (const auto& row : figure.rows) scale = std::isfinite(row[column]) ? std::max(scale, row[column]) : scale;
    for (const auto& row : figure.rows) {
      const bool is_point = row[0] > 0 && std::fmod(row[0], 5.0) == 0;
      if (!is_point || (!std::isfinite(row[column]) && !std::isfinite(row[column + 1]))) continue;
      worst.take(std::fabs(row[column] - row[column + 1]) / scale);
      ++points;
    }
  }
  return {static_cast<double>(points), worst.value(), Finding::holds,
          fmt::format("points on lines; worst {} of the range off", number(worst.value(), 2))};
}

Measure points_on_lines(int number_of_figure) {
  return [=](CaseRuns& case_runs) { return distance_of_points(make_figure(number_of_figure, case_runs)); };
}

/// V² + Ω²/12 is 1 at every instant, before and after the second impact; at that impact end b is on the ground, and at
/// all instants both ends are on it or above.
Measured figure_8(CaseRuns& case_runs) {
  const Figure figure = make_figure(8, case_runs);
  const auto value = [&](const std::vector<double>& row, const char* name) {
    return row[column_index(figure.columns, name)];
  };
  WorstError worst;
  double least = 0, most = 0;
  for (const auto& row : figure.rows) {
    const double velocity = value(row, "V_centre"), omega = value(row, "Omega");
    const double below = -std::min(value(row, "z_a"), value(row, "z_b"));
    const double gap = value(row, "impacts") > 1 ? std::fabs(value(row, "z_b")) : 0;
    worst.take(worst_of({std::fabs(velocity * velocity + omega * omega / 12 - 1), below, gap}));
    if (value(row, "panel") == 1) least = std::min(least, velocity);
    if (value(row, "panel") == 2 && value(row, "impacts") == 1) most = velocity;
  }
  return {most, worst.value(), Finding::holds,
          fmt::format("the centre moves up after impact 1 at 56.5°, with {} |vₙ| down at 45°", number(-least, 4))};
}

/// ½mV² + ½IΩ² after the first impact [J].
double kinetic_energy_after(const numeric::Body& body, const ImpactNumbers& n) {
  const double omega = n.angular_velocity_after.y();
  return (body.mass() * n.velocity_after.squaredNorm() + body.inertia()(1, 1) * omega * omega) / 2;
}

/// ½mV² + ½IΩ² after the impact is ½mv² before it: from the velocities alone.
Measured figure_14(CaseRuns& case_runs) {
  const Scene scene = scene_of_case("rod-sweep", {});
  const numeric::Body body = scene.make_body();
  WorstError worst;
  double least = 1;
  for (const SweptSimulation& swept : case_runs.sweep("rod-sweep")) {
    const ImpactNumbers& n = swept.run.impacts.at(0).value;
    const double before = body.mass() * scene.speed * scene.speed / 2;
    worst.take(std::fabs(kinetic_energy_after(body, n) / before - 1));
    least = std::min(least, n.velocity_after.z());
  }
  return {least, worst.value(), Finding::holds, "least Vₙ over the angle; 91 angles"};
}

/// What friction dissipates is what the velocities lack.
Measured figure_15(CaseRuns& case_runs) {
  const Scene scene = scene_of_case("rod-friction-sweep", {});
  const numeric::Body body = scene.make_body();
  WorstError worst;
  double most = 0;
  for (const SweptSimulation& swept : case_runs.sweep("rod-friction-sweep")) {
    const ImpactNumbers& n = swept.run.impacts.at(0).value;
    const double before = body.mass() * scene.speed * scene.speed / 2, lost = before - kinetic_energy_after(body, n);
    worst.take(std::fabs(lost - n.work_friction) / before);
    most = std::max(most, lost);
  }
  return {most, worst.value(), Finding::holds, "largest loss over friction; friction's own work accounts for it"};
}

/// |F_t| = μ F_n while the point slides: μ = 0.1, 0.3, 0.5.
Measured figure_16(CaseRuns& case_runs) {
  WorstError worst;
  double peak = 0;
  for (const auto& [name, mu] :
       {std::pair{"rod-friction-01", 0.1}, {"rod-friction-03", 0.3}, {"rod-friction-05", 0.5}}) {
    for (const HistorySample& s : case_runs.history(name).samples) {
      if (!s.in_contact || !(s.force.z() > 0)) continue;
      worst.take(std::fabs(std::fabs(s.force.x()) / (mu * s.force.z()) - 1));
      peak = std::max(peak, s.force.z());
    }
  }
  return {peak, worst.value(), Finding::holds, "largest normal force for μ up to 0.5"};
}

/// Energy of the history at its ends against the works booked in between.
Measured energy_over_history(const RecordedRun& recorded) {
  double booked = 0;
  for (const auto& impact : recorded.run.impacts) {
    booked += impact.value.work_damping + impact.value.work_friction + impact.value.work_released;
  }
  const double begin = recorded.samples.front().energy_total(), end = recorded.samples.back().energy_total();
  return {(begin - end) / begin, std::fabs(begin - end - booked) / begin, Finding::holds,
          fmt::format("of the energy lost by the end of impact {}; dampers, friction and release account for it",
                      recorded.run.impacts.size())};
}

Measured figure_17(CaseRuns& case_runs) { return energy_over_history(case_runs.history("rod-from-2m")); }
Measured figure_23(CaseRuns& case_runs) {
  return energy_over_history(case_runs.history("phone-damped", {.impacts = 2}));
}

/// The total energy of every sample is that of the first.
Measured figure_19(CaseRuns& case_runs) {
  const auto& samples = case_runs.history("phone-elastic", {.planar = true}).samples;
  WorstError worst;
  for (const HistorySample& s : samples) {
    worst.take(std::fabs(s.energy_total() / samples.front().energy_total() - 1));
  }
  return {static_cast<double>(samples.size()), worst.value(), Finding::holds,
          "instants, with the energy of the ground's springs"};
}

/// Distance of the sum of the normal impulses, which the momentum defines, from the recorded force's integral.
double force_distance(const Simulation& run, double force_impulse) {
  return std::fabs(force_impulse / run.total_normal_impulse() - 1);
}

Measured force_balance(const RecordedRun& recorded) {
  return {recorded.run.total_normal_impulse(), force_distance(recorded.run, recorded.force_impulse()), Finding::holds,
          fmt::format("sum of the normal impulses of {} impacts", recorded.run.impacts.size())};
}

/// So short beside the contacts that the trapezoidal rule sums their forces to nine digits.
constexpr double force_step = 1e-6;

Measured figure_20(CaseRuns& case_runs) {
  return force_balance(case_runs.history("phone-elastic", {.planar = true, .step = force_step}));
}
Measured figure_21(CaseRuns& case_runs) {
  return force_balance(case_runs.history("phone-damped", {.step = force_step}));
}

/// Peaks of all impacts by another method at a tolerance 10⁴ times finer.
Measured figure_22(CaseRuns& case_runs) {
  const Simulation& run = case_runs.run("phone-damped");
  const Simulation& fine = case_runs.run("phone-damped", {.digits = 10, .method = numeric::Method::rkck});
  WorstError worst;
  for (std::size_t i = 0; i < std::min<std::size_t>(3, fine.impacts.size()); ++i) {
    worst.take(std::fabs(run.impacts.at(i).value.peak_force / fine.impacts[i].value.peak_force - 1));
  }
  return {run.impacts.at(1).value.peak_force, worst.value(), Finding::holds,
          "largest force of all; peaks of the first three impacts"};
}

Measured figure_24(CaseRuns& case_runs) {
  WorstError worst;
  double most = 0;
  for (const SweptSimulation& swept : case_runs.sweep("phone-sweep")) {
    worst.take(force_distance(swept.run, swept.force_impulse));
    most = std::max(most, swept.run.impacts.at(0).value.energy_loss);
  }
  return {most, worst.value(), Finding::holds, "largest loss over the angle; force over time of 84 drops"};
}

}  // namespace

CheckMeasures figure_measures() {
  return {{"F7", points_on_lines(7)},   {"F8", figure_8},
          {"F9", points_on_lines(9)},   {"F10", points_on_lines(10)},
          {"F11", points_on_lines(11)}, {"F12", points_on_lines(12)},
          {"F14", figure_14},           {"F15", figure_15},
          {"F16", figure_16},           {"F17", figure_17},
          {"F19", figure_19},           {"F20", figure_20},
          {"F21", figure_21},           {"F22", figure_22},
          {"F23", figure_23},           {"F24", figure_24}};
}

}  // namespace clatter::validation
