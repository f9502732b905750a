// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/extremes/continuous.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "numeric/mesh/generators.hpp"
#include "validation/extremes/cell.hpp"
#include "validation/record/names.hpp"

namespace clatter::validation::inline extremes {
namespace {

using numeric::ImpactNumbers;
using numeric::Outcome;
using numeric::Simulation;

constexpr double degree = 3.14159265358979323846 / 180;

/// How the numbers of an impact scale with the units, and the size that each kind has there.
struct Sizes {
  double time, impulse, force, speed, rate, energy;
};

Sizes sizes_of(const ImpactNumbers& n, double mass_unit, double radius) {
  const double speed = std::max({n.approach_speed, n.velocity_after.norm(), n.angular_velocity_after.norm() * radius});
  return {.time = n.duration,
          .impulse = std::max(n.impulse.norm(), mass_unit * std::numeric_limits<double>::min()),
          .force = n.peak_force,
          .speed = speed,
          .rate = speed / radius,
          .energy = std::max(n.energy_before, n.energy_after)};
}

class Comparison {
 public:
  Comparison(const UnitScale& unit) : unit_(unit) {}

  void impact(const ImpactNumbers& n, const ImpactNumbers& error, const ImpactNumbers& truth, const Sizes& size) {
    const double speed = unit_.length / unit_.time;
    const double impulse = unit_.mass * speed;
    add(n.start, error.start, truth.start, unit_.time, std::max(truth.start, size.time));
    add(n.duration, error.duration, truth.duration, unit_.time, size.time);
    add(n.peak_force, error.peak_force, truth.peak_force, impulse / unit_.time, size.force);
    add(n.energy_after, error.energy_after, truth.energy_after, impulse * speed, size.energy);
    for (int i = 0; i < 3; ++i) {
      add(n.impulse[i], error.impulse[i], truth.impulse[i], impulse, size.impulse);
      add(n.velocity_after[i], error.velocity_after[i], truth.velocity_after[i], speed, size.speed);
      add(n.angular_velocity_after[i], error.angular_velocity_after[i], truth.angular_velocity_after[i], 1 / unit_.time,
          size.rate);
    }
  }

  RunDistance result;

 private:
  void add(double value, double estimate, double truth, double unit, double size) {
    const double off = value / unit == truth ? 0 : std::fabs(value / unit - truth) / size;
    if (!(off <= result.error)) result.error = std::isfinite(off) ? off : infinite;
    const double part = estimate == 0 ? 0 : estimate / unit / size;
    if (!(part <= result.estimate)) result.estimate = std::isfinite(part) ? part : infinite;
  }

  const UnitScale& unit_;
};

/// Infinite where one is no number.
template <class Measure>
double worst_of(const Simulation& run, const Measure& measure) {
  double worst = 0;
  for (const numeric::ImpactRecord& row : run.impacts) {
    const double value = measure(row);
    if (!(value <= worst)) worst = std::isfinite(value) ? value : infinite;
  }
  return worst;
}

bool has_ended_well(Outcome outcome) {
  return outcome == Outcome::no_further_impact || outcome == Outcome::impact_limit || outcome == Outcome::at_rest ||
         outcome == Outcome::sustained_contact;
}

}  // namespace

Simulation run_case(const ContinuousCase& scene, const ContinuousRun& how, const GoesOn& goes_on) {
  const numeric::Body body(numeric::box_mesh({.size = scene.size, .mass = scene.mass}));
  const numeric::World world{.ground = scene.ground, .gravity = scene.gravity, .planar = how.planar};
  const numeric::Request request{.impacts = scene.impacts, .error_estimates = how.estimates, .amplification = false};
  const numeric::Accuracy accuracy{
      .method = how.method, .digits = how.digits, .evaluation_limit = scene.evaluation_limit};
  const numeric::Observer observer{.progress = [&](int, long) { return goes_on(); }};
  const numeric::Drop drop{.inclination = scene.angle_deg * degree, .velocity = scene.velocity};
  return simulate(body, world, touching_state(body, drop), request, accuracy, observer);
}

Simulation require_case(const ContinuousCase& scene, const ContinuousRun& how, const GoesOn& goes_on,
                        CellMeasure& measure) {
  Simulation run;
  measure.seconds = timed([&] { run = run_case(scene, how, goes_on); });
  measure.evaluations = run.force_evaluations;
  measure.outcome = outcome_name(run.outcome);
  const std::string reached = fmt::format("{} ({} impacts before)", run.message, run.impacts.size());
  if (run.outcome == Outcome::interrupted) throw EndedEarly(CellVerdict::time_limit, measure.outcome, reached);
  if (!has_ended_well(run.outcome)) throw EndedEarly(CellVerdict::ended_early, measure.outcome, reached);
  if (run.impacts.empty()) throw EndedEarly(CellVerdict::broken, measure.outcome, "a drop without an impact");
  return run;
}

ContinuousCase scaled(const ContinuousCase& scene, const UnitScale& by) {
  ContinuousCase out = scene;
  out.size *= by.length;
  out.mass *= by.mass;
  out.velocity *= by.length / by.time;
  out.gravity *= by.length / by.time / by.time;
  const double stress = by.mass / by.time / by.time / by.length;  // N/m²; in steps that do not overflow
  out.ground.stiffness *= stress / by.length;
  out.ground.damping *= stress / by.length * by.time / by.length;
  return out;
}

RunDistance distance_of(const Simulation& run, const Simulation& truth, const UnitScale& scale, double radius) {
  Comparison comparison(scale);
  if (run.impacts.size() != truth.impacts.size()) return {infinite, infinite};
  for (std::size_t i = 0; i < run.impacts.size(); ++i) {
    const Sizes size = sizes_of(truth.impacts[i].value, 1, radius);
    comparison.impact(run.impacts[i].value, run.impacts[i].error, truth.impacts[i].value, size);
  }
  return comparison.result;
}

double worst_ledger_gap(const Simulation& run) {
  return worst_of(run, [](const numeric::ImpactRecord& row) { return std::fabs(row.ledger_gap); });
}

double worst_energy_drift(const Simulation& run) {
  return worst_of(
      run, [&](const numeric::ImpactRecord& row) { return std::fabs(row.value.energy_after / run.energy_start - 1); });
}

}  // namespace clatter::validation::inline extremes
