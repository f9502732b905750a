// SPDX-License-Identifier: GPL-3.0-or-later
// Errors of an impact's numbers, and what the impact adds to them (error_growth.hpp).
#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "analytic/detail/limits.hpp"

#include "analytic/error_growth.hpp"

namespace clatter::analytic {

using detail::epsilon;

namespace {

/// The other outermost vertex of a flat landing.
ContactPoint partner(const BodyMotion& motion, VertexSet vertices, int reference) {
  const double x = motion.contact_point(reference).tangential;
  ContactPoint farthest = motion.contact_point(reference);
  for (int i = 0; i < motion.body().vertex_count; ++i) {
    const ContactPoint d = motion.contact_point(i);
    if ((vertices >> i & 1) != 0 && std::fabs(d.tangential - x) > std::fabs(farthest.tangential - x)) farthest = d;
  }
  return farthest;
}

StruckState struck_state(const BodyMotion& motion, const ImpactLaw& law, const ImpactRow& row) {
  const int vertex = motion.local_departure().reference;
  const ContactPoint d = motion.contact_point(vertex);
  const bool flat = std::popcount(row.vertices) > 1;
  const double u = flat ? normal_velocity(row.before, d) : -row.impact.approach_speed;
  return {.body = motion.turned_body(),
          .law = law,
          .before = row.before,
          .contact = {u, row.impact.slip_before},
          .place = d,
          .second = flat ? partner(motion, row.vertices, vertex) : ContactPoint{},
          .flat = flat};
}

/// Relative rounding of P_n from that of A − (P_t/P_n) B.
double impulse_rounding(const StruckState& struck, const Impact& impact) {
  if (struck.flat) return 2 * epsilon;
  const ContactInertia inertia = contact_inertia(struck.body.gyration_square, struck.place);
  const double coupled = inertia.coupling * impact.impulse_ratio();
  return 2 * epsilon * (inertia.normal + std::fabs(coupled)) / std::fabs(inertia.normal - coupled);
}

/// Size of the parts that make up P_t: with Coulomb's law those before and after slip has stopped.
double tangential_size(const StruckState& struck, const Impact& impact) {
  const bool parts = struck.law.friction == FrictionKind::coulomb;
  return std::fmax(std::fabs(impact.tangential_impulse), parts ? struck.law.friction_value * impact.normal_impulse : 0);
}

}  // namespace

RowErrors RowErrors::unknown() {
  constexpr double none = std::numeric_limits<double>::infinity();
  return {.predictable = false,
          .relative = none,
          .start = none,
          .inclination = none,
          .contact_angle = none,
          .approach_speed = none,
          .restitution = none,
          .normal_impulse = none,
          .tangential_impulse = none,
          .impulse_ratio = none,
          .after = {.normal = none, .tangential = none, .angular = none},
          .energy_before = none,
          .energy_after = none,
          .energy_loss = none};
}

double ErrorGrowth::amplification(const ImpactDerivatives& d, const ImpactRow& row) const {
  double largest = 0;
  for (const StateVector* of : {&of_angle_, &of_speed_}) {
    double of_impulse = 0;
    for (std::size_t i = 0; i < state_size; ++i) of_impulse += d.normal[i] * (*of)[i];
    const auto compare = [&](double change, double value) {
      if (change != 0) largest = std::fmax(largest, std::fabs(change / value));
    };
    compare((*of)[at_time], row.start);
    compare((*of)[at_angle], row.contact_angle);
    compare(of_impulse, row.impact.normal_impulse);
  }
  return largest;
}

/// The numbers of the row before the errors have gone through the impact.
void ErrorGrowth::fill(const BodyMotion& motion, const StruckState& struck, const ImpactDerivatives& d,
                       ImpactRow& row) const {
  const Impact& impact = row.impact;
  const double u = struck.contact.normal, w = impact.separation_speed;
  const double of_impulse = impulse_rounding(struck, impact);
  const double gravity = motion.local_departure().gravity;
  StateVector time{}, angle{}, approach{}, loss{}, restitution{}, ratio{};
  time[at_time] = angle[at_angle] = approach[at_normal] = 1;
  for (std::size_t i = 0; i < state_size; ++i) {
    const double of_u = i == at_normal ? 1 : 0, of_s = i == at_slip ? 1 : 0;
    loss[i] = -(d.normal[i] * (u + w) + impact.normal_impulse * (of_u + d.state[at_normal][i]) +
                d.tangential[i] * (impact.slip_before + impact.slip_after) +
                impact.tangential_impulse * (of_s + d.state[at_slip][i])) /
              2;
    restitution[i] = -d.state[at_normal][i] / u + w / (u * u) * of_u;
    ratio[i] = (d.tangential[i] - impact.impulse_ratio() * d.normal[i]) / impact.normal_impulse;
  }
  RowErrors& e = row.error;
  e.start = row.start == 0 ? 0 : bound(time, epsilon * row.start);
  e.inclination = bound(angle, epsilon * std::fabs(row.inclination));
  e.contact_angle = bound(angle, epsilon * row.contact_angle);
  e.approach_speed = bound(approach, epsilon * std::fabs(u));
  e.normal_impulse = bound(d.normal, of_impulse * impact.normal_impulse);
  e.tangential_impulse = bound(d.tangential, of_impulse * tangential_size(struck, impact));
  if (impact.normal_impulse > 0) {
    e.restitution = bound(restitution, 4 * epsilon);
    e.impulse_ratio = bound(ratio, 2 * of_impulse * std::fabs(impact.impulse_ratio()));
  }
  const double size = std::fabs(row.energy_before) + std::fabs(row.energy_after);
  e.energy_before = bound(MotionGradients(struck.body, struck.place, row.before, gravity).energy, 2 * epsilon * size);
  e.energy_loss = bound(loss, of_impulse * (impact.normal_impulse * (std::fabs(u) + w) +
                                            std::fabs(impact.tangential_impulse) *
                                                (std::fabs(impact.slip_before) + std::fabs(impact.slip_after))));
}

void ErrorGrowth::add_rounding(const StruckState& struck, const Impact& impact) {
  const double push = impact.slip_after - impact.slip_before;
  const double mass = struck.body.mass, square = struck.body.gyration_square;
  const double of_impulse = impulse_rounding(struck, impact);
  StateVector of_jump{};
  of_jump[at_normal] = impact.separation_speed;
  of_jump[at_slip] = impact.slip_after == 0 ? 0 : push;
  of_jump[at_turn] = impact.after.angular - struck.before.angular;
  of_jump[at_sum] = impact.normal_impulse;
  for (double& entry : of_jump) entry *= of_impulse;
  factor_.add(of_jump);
  const double moment = struck.flat ? std::fabs(struck.before.angular)
                                    : (tangential_size(struck, impact) * std::fabs(struck.place.normal) +
                                       std::fabs(impact.normal_impulse * struck.place.tangential)) /
                                          (mass * square);
  // Where slip stops during restitution is the difference of two impulses.
  const bool stops = impact.mode == ImpactMode::slip_stick || impact.mode == ImpactMode::reverse_slip;
  if (stops && struck.law.law != RestitutionLaw::newton && !struck.flat) {
    const ContactInertia inertia = contact_inertia(square, struck.place);
    factor_.add(at_normal, 4 * epsilon *
                               (inertia.normal * impact.normal_impulse +
                                std::fabs(inertia.coupling) * tangential_size(struck, impact)) /
                               mass);
  }
  if (impact.slip_after != 0) {
    factor_.add(at_slip, 2 * epsilon * (std::fabs(impact.slip_before) + std::fabs(push)));
  }
  factor_.add(at_turn, 2 * epsilon * (std::fabs(struck.before.angular) + moment));
  factor_.add(at_sum, epsilon * total_impulse_);
}

void ErrorGrowth::strike(const BodyMotion& motion, const ImpactLaw& law, ImpactRow& row) {
  row.error = RowErrors::unknown();
  total_impulse_ += row.impact.normal_impulse;
  if (!predictable_) return;
  row.error.predictable = true;
  const StruckState struck = struck_state(motion, law, row);
  if (!(row.impact.approach_speed > 0)) {  // an arrival that rounding has turned into a departure
    predictable_ = false;
    row.error = RowErrors::unknown();
    return;
  }
  const ImpactDerivatives d = impact_derivatives(struck, row.impact.mode);
  fill(motion, struck, d, row);
  row.amplification = amplification(d, row);
  advance(d.state);
  add_rounding(struck, row.impact);
  const PlanarVelocity& after = row.impact.after;
  const MotionGradients moves(struck.body, struck.place, after, motion.local_departure().gravity);
  StateVector turn{};
  turn[at_turn] = 1;
  row.error.after = {
      .normal = bound(moves.normal, 2 * epsilon * (std::fabs(row.before.normal) + std::fabs(after.normal))),
      .tangential =
          bound(moves.tangential, 2 * epsilon * (std::fabs(row.before.tangential) + std::fabs(after.tangential))),
      .angular = bound(turn, epsilon * std::fabs(after.angular))};
  const auto relative = [](double error, double value) { return error > 0 ? error / std::fabs(value) : 0; };
  row.error.relative =
      std::max({relative(row.error.start, row.start), relative(row.error.contact_angle, row.contact_angle),
                relative(row.error.normal_impulse, row.impact.normal_impulse)});
  row.error.energy_after =
      bound(moves.energy, 2 * epsilon * (std::fabs(row.energy_before) + std::fabs(row.energy_after)));
}

}  // namespace clatter::analytic
