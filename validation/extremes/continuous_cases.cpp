// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "analytic/law/viscoelastic.hpp"
#include "validation/extremes/continuous.hpp"
#include "validation/extremes/exact_rod.hpp"
#include "validation/extremes/extreme_cases.hpp"

namespace clatter::validation::inline extremes {
namespace {

using numeric::Simulation;

constexpr int digits_asked = 6;
constexpr double promised = 1e-6;
/// Estimates of errors are right to about this factor (tests/numeric/estimates_test.cpp).
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

/// Against another method at four digits more, on the scene in units of 1; the ledger of energy counts too.
CellMeasure by_other_method(const ContinuousCase& unit, const UnitScale& scale, bool planar, const CellClock& clock) {
  CellMeasure measure{.bound = promised, .oracle = "energy ledger", .outcome = {}};
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
  CellMeasure measure{.oracle = "restitution's equation at 64 bits", .outcome = {}};
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

/// Energy after n elastic impacts, and that no fewer were found.
CellMeasure by_energy(ContinuousCase scene, int impacts, bool planar, const CellClock& clock) {
  scene.impacts = impacts;
  scene.gravity = 9.81;
  scene.evaluation_limit = evaluations_of_long_runs;
  CellMeasure measure{.bound = drift_per_impact * impacts, .oracle = "energy kept", .outcome = {}};
  const Simulation run =
      require_case(scene, {.planar = planar, .estimates = false}, until(clock, oracle_share), measure);
  measure.error = worst_energy_drift(run);
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
  if (axis == "impacts") return by_energy(scene, static_cast<int>(value), planar, clock);
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
    for (const AxisValue& at : axis.values) {
      cases.push_back({axis.name, at.value, at.label, model,
                       [name = axis.name, value = at.value, planar = model == ModelLevel::planar](
                           const CellClock& clock) { return continuous_cell(name, value, planar, clock); }});
    }
  }
  return cases;
}

}  // namespace clatter::validation::inline extremes
