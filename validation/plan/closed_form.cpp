// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/plan/closed_form.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "analytic/plane/contact_angles.hpp"
#include "analytic/plane/sequence.hpp"

namespace clatter::validation {
namespace {

using analytic::Drop;
using analytic::ImpactRow;
using analytic::PlanarVelocity;
using analytic::Sequence;

constexpr int most_impacts = 3;
constexpr analytic::VertexSet vertex_a = 1, vertex_b = 2;

double kinetic_energy(const Drop& drop, const PlanarVelocity& v) {
  const double mass = drop.body.mass;
  return 0.5 * mass *
         (v.normal * v.normal + v.tangential * v.tangential + drop.body.gyration_square * v.angular * v.angular);
}

/// The row of impact i from its contact angle, the velocity before it and what the impact did.
ImpactRow row_of(const Drop& drop, int i, double start, double angle, const PlanarVelocity& before,
                 const analytic::Impact& impact) {
  const bool end_a = i != 1;
  ImpactRow row;
  row.start = start;
  row.vertices = end_a ? vertex_a : vertex_b;
  row.inclination = end_a ? angle : -angle;
  row.contact_angle = angle;
  row.before = before;
  row.impact = impact;
  row.centre_height = drop.body.reach() * std::sin(angle);
  const double height = drop.body.mass * drop.gravity * row.centre_height;
  row.energy_before = kinetic_energy(drop, before) + height;
  row.energy_after = kinetic_energy(drop, impact.after) + height;
  row.amplification = std::numeric_limits<double>::quiet_NaN();
  row.error = analytic::RowErrors::unknown();
  return row;
}

/// Eqs. 8 and 9 at the end that strikes.
analytic::Impact strike_at(const Drop& drop, const ImpactRow& row) {
  const int vertex = row.vertices == vertex_a ? 0 : 1;
  const analytic::ContactPoint end =
      drop.body.contact_point(vertex, std::sin(row.inclination), std::cos(row.inclination));
  return analytic::strike(drop.body, row.before, end, drop.law);
}

/// Contact angles and times, in the drop's units.
struct Instants {
  int count = 1;
  double angle[most_impacts], time[most_impacts];
};

Instants instants_of(const Drop& drop, int impacts) {
  Instants at{.count = 1, .angle = {drop.inclination.radians, 0, 0}, .time = {0, 0, 0}};
  if (impacts == 1) return at;
  const double speed = -drop.velocity.normal, length = 2 * drop.body.reach();
  const analytic::ContactAngles angles =
      contact_angles(drop.inclination, {.gravity_number = drop.gravity * length / (speed * speed),
                                        .restitution = drop.law.restitution,
                                        .impulse_ratio = drop.law.friction_value});
  at.count = std::min(angles.impacts(), impacts);
  at.angle[1] = angles.beta.angle;
  at.angle[2] = angles.gamma.angle;
  at.time[1] = angles.beta.time * length / speed;
  at.time[2] = at.time[1] + angles.gamma.time * length / speed;
  return at;
}

}  // namespace

std::string reason_against_closed_form(const Drop& drop) {
  if (drop.body.vertex_count != 2) return "it is for a thin rod";
  if (drop.velocity.tangential != 0 || drop.velocity.angular != 0) return "it starts from a straight fall";
  if (drop.inclination.radians == 0) return "in it one end strikes first";
  if (drop.law.friction == analytic::FrictionKind::coulomb) return "it knows an impulse ratio, not Coulomb's law";
  if (drop.law.law == analytic::RestitutionLaw::viscoelastic && drop.law.damping_per_stiffness > 0)
    return "it has one coefficient of restitution, and damping makes it depend on the speed";
  return "";
}

Sequence closed_form_sequence(const Drop& drop, int impacts) {
  const Instants at = instants_of(drop, impacts);
  Sequence sequence;
  sequence.total_normal_impulse_error = std::numeric_limits<double>::infinity();
  PlanarVelocity velocity = drop.velocity;
  for (int i = 0; i < at.count; ++i) {
    if (i > 0) velocity.normal -= drop.gravity * (at.time[i] - at.time[i - 1]);
    ImpactRow row = row_of(drop, i, at.time[i], at.angle[i], velocity, {});
    row = row_of(drop, i, at.time[i], at.angle[i], velocity, strike_at(drop, row));
    sequence.total_normal_impulse += row.impact.normal_impulse;
    velocity = row.impact.after;
    sequence.rows.push_back(row);
  }
  sequence.outcome = at.count == impacts || at.count == most_impacts ? analytic::Outcome::impact_limit
                                                                     : analytic::Outcome::no_further_impact;
  sequence.message =
      at.count == most_impacts ? "the closed form ends with the third impact" : "the closed form has no further impact";
  if (at.count == impacts) sequence.message = "as many impacts as asked for";
  return sequence;
}

}  // namespace clatter::validation
