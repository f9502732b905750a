// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "validation/evidence/extreme_cases.hpp"
#include "validation/evidence/oracles.hpp"

namespace clatter::validation {
namespace {

using analytic::Angle;
using analytic::Drop;
using analytic::FrictionKind;
using analytic::Sequence;

/// contact_angles.hpp errs by (2 + 2κ) ulp, by 12 times that with e < 1 or μ_i ≠ 0.
constexpr double closed_form_ulps = 24;
/// A law of motion has up to ten roundings on the way from the state to the row, on terms that its size counts once.
constexpr double law_ulps = 32;
/// Energies of impact and flight are off by this many eps each, all to one side.
constexpr double energy_ulps_per_impact = 8;

/// An impact that does not happen, or one too few.
constexpr double wrong_decision = 2;

/// At a fold the condition is infinite and no digit is left.
double bound_of(const RodError& off) { return std::fmin(closed_form_ulps * (1 + off.condition) * eps, 1); }

const double jamming_angle = std::atan(2.0) * analytic::degrees_per_radian;

// --- closed form

CellMeasure closed_form(const RodStart& start) {
  CellMeasure measure{.oracle = exact_rod_oracle};
  analytic::ContactAngles angles;
  measure.seconds = timed([&] { angles = contact_angles(Angle::from_degrees(start.angle_deg), start.parameters); });
  const RodError off = rod_error(start, rod_impacts(angles));
  measure.error = off.ends_rightly ? std::fmin(off.error, 1) : wrong_decision;
  measure.bound = bound_of(off);
  measure.outcome = fmt::format("{} impact{}", angles.impacts(), angles.impacts() == 1 ? "" : "s");
  measure.evaluations = angles.beta.evaluations + angles.gamma.evaluations;
  return measure;
}

/// The rod of the closed form on an axis at a value; false if the axis is none of its.
bool rod_on_axis(const std::string& axis, double value, RodStart& start) {
  start.angle_deg = 20;
  if (axis == "angle") start.angle_deg = value;
  else if (axis == "restitution") start.parameters.restitution = value;
  else if (axis == "ratio") start = {jamming_angle, {.gravity_number = 0, .restitution = 1, .impulse_ratio = value}};
  else if (axis == "speed") start.parameters.gravity_number = 9.81 / value / value;
  else if (axis == "gravity") start.parameters.gravity_number = value;
  else return false;
  return true;
}

// --- discrete

Drop rod_drop(double angle_deg, double gravity) {
  return {.body = analytic::make_rod({}),
          .inclination = Angle::from_degrees(angle_deg),
          .velocity = {.normal = -1, .tangential = 0, .angular = 0},
          .gravity = gravity,
          .law = {}};
}

Sequence sequence_of(const Drop& drop, int impacts, CellMeasure& measure) {
  return timed_sequence(drop, {.impacts = impacts, .digits = 6, .amplification = false}, measure);
}

CellMeasure by_laws(const Drop& drop) {
  const double impulse = drop.body.mass * std::fabs(drop.velocity.normal);
  const double rounding = eps + std::numeric_limits<double>::denorm_min() / impulse;
  CellMeasure measure{.bound = std::fmin(law_ulps * rounding, 1), .oracle = retrace_oracle};
  measure.error = retrace(drop, sequence_of(drop, 6, measure)).residual;
  return measure;
}

/// The general path of the model, which a body of any shape takes, on the rod whose impacts are known.
CellMeasure by_exact_rod(const RodStart& start) {
  Drop drop = rod_drop(start.angle_deg, start.parameters.gravity_number);
  drop.body.uniform_thin_rod = false;
  drop.law.restitution = start.parameters.restitution;
  CellMeasure measure{.bound = law_ulps * eps, .oracle = retrace_oracle};
  const Sequence sequence = sequence_of(drop, 3, measure);
  measure.error = retrace(drop, sequence).residual;
  const RodImpacts impacts = rod_impacts(sequence);
  if (impacts.count == 0) return measure;  // lands flat
  const RodError off = rod_error(start, impacts);
  measure.oracle = exact_rod_oracle;
  measure.error = std::max(measure.error, off.ends_rightly ? std::fmin(off.error, 1) : wrong_decision);
  measure.bound = std::max(measure.bound, bound_of(off));
  return measure;
}

/// Restitution of a ground with springs and dampers against its equation, and the laws of motion.
CellMeasure by_restitution(double damping_per_stiffness) {
  Drop drop = rod_drop(20, 9.81);
  drop.law = {.law = analytic::RestitutionLaw::viscoelastic, .damping_per_stiffness = damping_per_stiffness};
  CellMeasure measure{.bound = law_ulps * eps, .oracle = "restitution's equation at 64 bits"};
  const Sequence sequence = sequence_of(drop, 3, measure);
  const analytic::Impact& first = sequence.rows.at(0).impact;
  const long double exact = exact_restitution(static_cast<long double>(damping_per_stiffness) * first.approach_speed);
  const double off = static_cast<double>(std::fabs(first.restitution() - exact) / exact);
  measure.error = std::max(off, retrace(drop, sequence).residual);
  return measure;
}

/// Energy after n impacts.
CellMeasure by_energy(int impacts) {
  Drop drop = rod_drop(20, 9.81);
  CellMeasure measure{.bound = energy_ulps_per_impact * eps * impacts, .oracle = "energy kept"};
  const Retrace found = retrace(drop, sequence_of(drop, impacts, measure));
  measure.error = std::max(found.energy_drift, found.momentum_drift);
  return measure;
}

/// The drop of an axis that is judged by the laws of motion alone; false if the axis is none of these.
bool drop_on_axis(const std::string& axis, double value, Drop& drop) {
  if (axis == "ratio") {
    drop = rod_drop(jamming_angle, 9.81);
    drop.law = {.friction = FrictionKind::impulse_ratio, .friction_value = value};
  } else if (axis == "friction") {
    drop = rod_drop(jamming_angle, 9.81);
    drop.velocity.tangential = 1;
    // Newton's and Poisson's laws may create energy where slip stops.
    drop.law = {.restitution = 0.9,
                .law = analytic::RestitutionLaw::stronge,
                .friction = FrictionKind::coulomb,
                .friction_value = value};
  } else if (axis == "speed") {
    drop = rod_drop(20, 9.81);
    drop.velocity.normal = -value;
  } else if (axis == "gravity") {
    drop = rod_drop(20, value);
  } else if (axis == "size") {
    drop = rod_drop(20, 9.81 * value);
    drop.body = analytic::make_rod({.length = value, .radius = 0.01 * value});
    drop.velocity.normal = -value;
  } else if (axis == "mass") {
    drop = rod_drop(20, 9.81);
    drop.body = analytic::make_rod({.mass = value, .length = 1, .radius = 0.01});
  } else {
    return false;
  }
  return true;
}

CellMeasure discrete_cell(const std::string& axis, double value) {
  if (axis == "angle") return by_exact_rod({.angle_deg = value});
  if (axis == "restitution")
    return by_exact_rod({20, {.gravity_number = 9.81, .restitution = value, .impulse_ratio = 0}});
  if (axis == "damping") return by_restitution(value / 1e9);
  if (axis == "stiffness") return by_restitution(1e7 / value);
  if (axis == "impacts") return by_energy(static_cast<int>(value));
  Drop drop;
  if (!drop_on_axis(axis, value, drop)) throw std::logic_error("the discrete model has no axis " + axis);
  return by_laws(drop);
}

}  // namespace

std::vector<ExtremeCase> discrete_cases(const MapAxis& axis) {
  std::vector<ExtremeCase> cases;
  RodStart any;
  if (rod_on_axis(axis.name, 1, any)) {
    add_cases(cases, axis, ModelLevel::closed_form, [name = axis.name](double value, const CellClock&) {
      RodStart start;
      rod_on_axis(name, value, start);
      return closed_form(start);
    });
  }
  add_cases(cases, axis, ModelLevel::discrete,
            [name = axis.name](double value, const CellClock&) { return discrete_cell(name, value); });
  return cases;
}

}  // namespace clatter::validation
