// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/evidence/extreme_cases.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "analytic/law/viscoelastic.hpp"
#include "numeric/mesh/generators.hpp"
#include "validation/evidence/oracles.hpp"

namespace clatter::validation {
namespace {

using numeric::ImpactNumbers;
using numeric::Outcome;
using numeric::Simulation;

/// Powers of two by which the units of a scene have been multiplied.
struct UnitScale {
  double length = 1, mass = 1, time = 1;
};

/// Worst difference of the impacts' numbers, each relative to the size of its kind at the impact, and the largest
/// error estimate of `run` in the same measure: starts, durations, impulses, peak forces, velocities, energies.
struct RunDistance {
  double error = 0;
  double estimate = 0;  ///< infinite if the model says that it does not know
};

/// What the elastic energy may drift by in each impact: 10⁻⁴ of the digits asked for is the tolerance of a step, and a
/// contact takes tens of steps.
constexpr double drift_per_impact = 1e-8;
constexpr double promised = 1e-6;
/// Estimates of errors are right to about this factor (tests/numeric/drop/error_estimates_test.cpp).
constexpr double estimate_factor = 10;
/// Shares of the cell's time after which the run and the oracle's run are ended; its estimates take as long as it.
constexpr double run_share = 0.35, oracle_share = 0.9;
/// Another method, far more accurate.
constexpr numeric::Method oracle_method = numeric::Method::rkck;
constexpr int oracle_digits = 10;
/// About 500 impacts: below half a second of a slow machine.
constexpr long evaluations_of_long_runs = 400'000;

GoesOn until(const CellClock& clock, double share) {
  return [&clock, share] { return clock.within(share); };
}

double radius_of(const ContinuousCase& scene) { return scene.size.norm() / 2; }

double bound_of(const RunDistance& distance) { return std::clamp(estimate_factor * distance.estimate, promised, 1.0); }

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

class ScaledComparison {
 public:
  ScaledComparison(const UnitScale& unit) : unit_(unit) {}

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
double worst_over(const Simulation& run, const auto& measure) {
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

/// The run as what a cell shows: ends early by exception.
/// @throws EndedEarly for any outcome but no-further-impact, impact-limit and at-rest, or without an impact.
Simulation require_case(const ContinuousCase& scene, const ContinuousRun& how, const GoesOn& goes_on,
                        CellMeasure& measure) {
  Simulation run;
  measure.seconds = timed([&] { run = run_case(scene, how, goes_on); });
  measure.evaluations = run.force_evaluations;
  measure.outcome = outcome_name(run);
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

/// @param run in units multiplied by `scale`; @param truth in units of 1
RunDistance distance_of(const Simulation& run, const Simulation& truth, const UnitScale& scale, double radius) {
  ScaledComparison comparison(scale);
  if (run.impacts.size() != truth.impacts.size()) return {infinite, infinite};
  for (std::size_t i = 0; i < run.impacts.size(); ++i) {
    const Sizes size = sizes_of(truth.impacts[i].value, 1, radius);
    comparison.impact(run.impacts[i].value, run.impacts[i].error, truth.impacts[i].value, size);
  }
  return comparison.result;
}

/// Against another method at four digits more, on the scene in units of 1; the ledger of energy counts too.
CellMeasure by_other_method(const ContinuousCase& unit, const UnitScale& scale, bool planar, const CellClock& clock) {
  CellMeasure measure{.bound = promised, .oracle = "energy ledger"};
  const Simulation run = require_case(scaled(unit, scale), {.planar = planar}, until(clock, run_share), measure);
  measure.error = worst_ledger_gap(run);
  const Simulation truth =
      run_case(unit, {.planar = planar, .method = oracle_method, .digits = oracle_digits, .estimates = false},
               until(clock, oracle_share));
  const bool found_all = std::all_of(truth.impacts.begin(), truth.impacts.end(),
                                     [](const numeric::ImpactRecord& row) { return row.value.impulse.z() > 0; });
  if (truth.outcome != run.outcome || truth.impacts.size() != run.impacts.size() || !found_all) return measure;
  const RunDistance distance = distance_of(run, truth, scale, radius_of(unit));
  measure.oracle = "Cash-Karp at 10 digits, ledger";
  measure.error = std::max(measure.error, distance.error);
  measure.bound = bound_of(distance);
  return measure;
}

/// Flat landing without damping: half a sine; with it: the exact restitution.  Speeds relative to that of approach.
CellMeasure by_flat_landing(ContinuousCase scene, bool planar, const CellClock& clock) {
  scene.ground.area = numeric::AreaMeasure::projected;  // the sides of the box then bear nothing
  CellMeasure measure{.oracle = "restitution's equation at 64 bits"};
  const Simulation run = require_case(scene, {.planar = planar}, until(clock, run_share), measure);
  const numeric::ImpactRecord& row = run.impacts.at(0);
  const double speed = -scene.velocity.z();
  const double s = scene.ground.damping / scene.ground.stiffness * speed;
  const double e = static_cast<double>(exact_restitution(static_cast<long double>(s)));
  measure.error =
      std::max({std::fabs(row.value.velocity_after.z() / speed - e),
                std::fabs(row.value.impulse.z() / (scene.mass * speed) - (1 + e)) / (1 + e), worst_ledger_gap(run)});
  if (scene.ground.damping == 0) {
    measure.oracle = "half sine";
    const bool upright = scene.angle_deg == 90;
    const double area = (upright ? scene.size.z() : scene.size.x()) * scene.size.y();
    const double rate = std::sqrt(scene.ground.stiffness * area / scene.mass);
    measure.error = std::max({measure.error, std::fabs(row.value.duration * rate / std::numbers::pi - 1),
                              std::fabs(row.value.peak_force / (scene.mass * speed * rate) - 1)});
  }
  measure.bound = promised;
  return measure;
}

/// c_G that gives this restitution at 1 m/s.
double damping_for(double restitution, double stiffness) {
  return analytic::damping_of_restitution(restitution) * stiffness;
}

/// The scene of an axis at a value; false if it is none of the continuous model.
bool case_on_axis(const std::string& axis, double value, ContinuousCase& scene) {
  if (axis == "angle") scene.angle_deg = value;
  else if (axis == "stiffness") scene.ground.stiffness = value;
  else if (axis == "damping") scene.ground.damping = value;
  else if (axis == "friction") {
    scene.angle_deg = 45;
    scene.velocity.x() = 0.5;
    scene.ground.static_friction = scene.ground.sliding_friction = value;
  } else if (axis == "speed") scene.velocity.z() = -value;
  else if (axis == "gravity") scene.gravity = value;
  else return axis == "size" || axis == "mass" || axis == "restitution" || axis == "impacts";
  return true;
}

CellMeasure continuous_cell(const std::string& axis, double value, bool planar, const CellClock& clock) {
  ContinuousCase scene;
  case_on_axis(axis, value, scene);
  if (axis == "restitution") {
    scene.angle_deg = 0;
    scene.ground.damping = damping_for(value, scene.ground.stiffness);
    return by_flat_landing(scene, planar, clock);
  }
  if (axis == "impacts")
    return kept_energy(static_cast<int>(value), evaluations_of_long_runs, planar, until(clock, oracle_share));
  if (axis == "angle" && (value == 0 || value == 90)) return by_flat_landing(scene, planar, clock);
  UnitScale scale;
  if (axis == "size") scale.length = value;
  if (axis == "mass") scale.mass = value;
  if (axis == "size" || axis == "mass") scene.gravity = 9.81;
  return by_other_method(scene, scale, planar, clock);
}

}  // namespace

std::vector<ExtremeCase> continuous_cases(const MapAxis& axis) {
  std::vector<ExtremeCase> cases;
  ContinuousCase any;
  if (!case_on_axis(axis.name, 1, any)) return cases;
  for (const ModelLevel model : {ModelLevel::planar, ModelLevel::spatial}) {
    add_cases(cases, axis, model,
              [name = axis.name, planar = model == ModelLevel::planar](double value, const CellClock& clock) {
                return continuous_cell(name, value, planar, clock);
              });
  }
  return cases;
}

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

double worst_ledger_gap(const Simulation& run) {
  return worst_over(run, [](const numeric::ImpactRecord& row) { return std::fabs(row.ledger_gap); });
}

CellMeasure kept_energy(int impacts, long evaluation_limit, bool planar, const GoesOn& goes_on) {
  const ContinuousCase scene{.gravity = 9.81, .impacts = impacts, .evaluation_limit = evaluation_limit};
  CellMeasure measure{.bound = drift_per_impact * impacts, .oracle = "energy kept"};
  const Simulation run = require_case(scene, {.planar = planar, .estimates = false}, goes_on, measure);
  measure.error = worst_over(
      run, [&](const numeric::ImpactRecord& row) { return std::fabs(row.value.energy_after / run.energy_start - 1); });
  return measure;
}

}  // namespace clatter::validation
