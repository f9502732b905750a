// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/plane/step_jacobians.hpp"

#include <cmath>
#include <limits>

#include "analytic/law/coulomb_path.hpp"

namespace clatter::analytic {

StateVector product(const StateMatrix& jacobian, const StateVector& vector) {
  StateVector result{};
  for (std::size_t i = 0; i < state_size; ++i) {
    for (std::size_t j = 0; j < state_size; ++j) result[i] += jacobian[i][j] * vector[j];
  }
  return result;
}

namespace {

/// What an impact does, as functions of the state before it.
struct ImpactResponse {
  ImpactDual normal;      ///< P_n [N·s]
  ImpactDual tangential;  ///< P_t [N·s]
  ImpactDual separation;  ///< u after it [m/s]
  ImpactDual push;        ///< change of s [m/s]
  ImpactDual turn;        ///< change of Ω [rad/s]
};

/// Where ImpactDual has the derivative with respect to a number of the state.
constexpr std::size_t slot(std::size_t index) { return index - at_angle; }

ImpactDual variable(StateIndex index, double value) {
  ImpactDual number(value);
  number.slope[slot(index)] = 1;
  return number;
}

ImpactDual of_angle(double value, double slope) {
  ImpactDual number(value);
  number.slope[slot(at_angle)] = slope;
  return number;
}

ImpactResponse point_response(const StruckState& struck) {
  const double mass = struck.body.mass, square = struck.body.gyration_square;
  const ContactPoint& d = struck.place;
  // d_t′ = −d_n, d_n′ = d_t, and with them A′ = −2B, B′ = A − C, C′ = 2B.
  const ImpactDual along = of_angle(d.tangential, -d.normal), up = of_angle(d.normal, d.tangential);
  const auto [a, b, c] = contact_inertia(square, d);
  const ImpactDual coupling = of_angle(b, a - c), tangential = of_angle(c, 2 * b);
  const ImpactDual approach = -variable(at_normal, struck.contact.normal);
  const PathEnd<ImpactDual> end = point_impulse<ImpactDual>(
      {.normal = of_angle(a, -2 * b), .normal_coupling = coupling, .slip_drift = coupling, .tangential = tangential},
      {.approach_speed = approach,
       .slip = variable(at_slip, struck.contact.slip),
       .restitution = restitution_at(struck.law, approach)},
      struck.law);
  return {.normal = mass * end.normal_impulse,
          .tangential = mass * end.tangential_impulse,
          .separation = end.separation_speed,
          .push = tangential * end.tangential_impulse - coupling * end.normal_impulse,
          .turn = (end.tangential_impulse * up - end.normal_impulse * along) / square};
}

/// A flat landing keeps its inclination.
ImpactResponse flat_response(const StruckState& struck) {
  const double mass = struck.body.mass;
  const ContactPoint& d = struck.place;
  const ImpactDual turning = variable(at_turn, struck.before.angular);
  const ImpactDual normal = variable(at_normal, struck.contact.normal);
  const ImpactDual approach = -(normal + turning * d.tangential);
  const ImpactDual e =
      restitution_at(struck.law, pressure_centre_speed(approach, turning, struck.body.gyration_square));
  const PathEnd<ImpactDual> end = flat_impulse<ImpactDual>(
      {.approach_speed = approach, .slip = variable(at_slip, struck.contact.slip), .restitution = e},
      turning * d.normal, struck.law);
  return {.normal = mass * end.normal_impulse,
          .tangential = mass * end.tangential_impulse,
          .separation = -e * normal,
          .push = end.tangential_impulse - (1 + e) * turning * d.normal,
          .turn = -(1 + e) * turning};
}

/// A flat landing from the contact velocity of its vertex and Ω.
struct LandedFlat {
  Impact impact;
  double separation;  ///< of the vertex

  LandedFlat(const StruckState& struck, const ContactVelocity& contact, double turning, const ImpactLaw& law) {
    const ContactPoint& d = struck.place;
    const PlanarVelocity before{.normal = contact.normal + turning * d.tangential,
                                .tangential = contact.slip - turning * d.normal,
                                .angular = turning};
    impact = strike_flat(struck.body, before, d, struck.second, law).value_or(Impact{});
    separation = normal_velocity(impact.after, d);
  }
};

/// Whether friction tilts the landing, or limits its rebound.
bool has_no_closed_form(const StruckState& struck) {
  if (!struck.flat || !struck.law.rubs()) return false;
  const Impact impact = LandedFlat(struck, struck.contact, struck.before.angular, struck.law).impact;
  return impact.tilts || impact.is_limited;
}

constexpr double difference_step = 1e-6;

/// The derivatives of a flat landing by differences; it keeps its inclination.
ImpactDerivatives derivatives_by_differences(const StruckState& struck) {
  ImpactDerivatives d;
  for (const std::size_t i : {at_time, at_angle, at_sum}) d.state[i][i] = 1;
  const double speed = std::hypot(struck.contact.normal, struck.contact.slip);
  const double reach = std::hypot(struck.place.normal, struck.place.tangential);
  for (std::size_t i = at_normal; i <= at_turn; ++i) {
    const double step = difference_step * (i == at_turn ? speed / reach : speed);
    const auto landed = [&](double by) {
      const ContactVelocity contact{struck.contact.normal + (i == at_normal ? by : 0),
                                    struck.contact.slip + (i == at_slip ? by : 0)};
      return LandedFlat(struck, contact, struck.before.angular + (i == at_turn ? by : 0), struck.law);
    };
    const LandedFlat more = landed(step), less = landed(-step);
    const auto slope = [&](double a, double b) { return (a - b) / (2 * step); };
    d.normal[i] = d.state[at_sum][i] = slope(more.impact.normal_impulse, less.impact.normal_impulse);
    d.tangential[i] = slope(more.impact.tangential_impulse, less.impact.tangential_impulse);
    d.state[at_normal][i] = slope(more.separation, less.separation);
    d.state[at_slip][i] = slope(more.impact.slip_after, less.impact.slip_after);
    d.state[at_turn][i] = slope(more.impact.after.angular, less.impact.after.angular);
  }
  return d;
}

bool sticks(ImpactMode mode) { return mode == ImpactMode::stick || mode == ImpactMode::slip_stick; }

}  // namespace

ImpactDerivatives impact_derivatives(const StruckState& struck, ImpactMode mode) {
  if (has_no_closed_form(struck)) return derivatives_by_differences(struck);
  const ImpactResponse response = struck.flat ? flat_response(struck) : point_response(struck);
  ImpactDerivatives d;
  for (std::size_t i = 0; i < state_size; ++i) d.state[i][i] = 1;
  for (std::size_t i = at_angle; i <= at_turn; ++i) {
    d.normal[i] = response.normal.slope[slot(i)];
    d.tangential[i] = response.tangential.slope[slot(i)];
    d.state[at_normal][i] = response.separation.slope[slot(i)];
    d.state[at_slip][i] += response.push.slope[slot(i)];
    d.state[at_turn][i] += response.turn.slope[slot(i)];
    d.state[at_sum][i] = d.normal[i];
  }
  if (sticks(mode) && !struck.flat) d.state[at_slip] = {};
  return d;
}

namespace {

/// @param push_of_friction |P_t| over the friction, per unit mass
void set_parts(const StruckState& struck, double push_of_friction, LawColumn& column) {
  const ContactPoint& d = struck.place;
  const double square = struck.body.gyration_square;
  const auto [a, b, c] = contact_inertia(square, d);
  column.part = struck.body.mass * push_of_friction + std::fabs(column.normal) + std::fabs(column.tangential);
  const double push = column.part / struck.body.mass;
  column.parts[at_normal] = (a + std::fabs(b)) * push;
  column.parts[at_slip] = (c + std::fabs(b)) * push;
  column.parts[at_turn] = (std::fabs(d.normal) + std::fabs(d.tangential)) / square * push;
  column.parts[at_sum] = column.part;
}

LawDerivatives law_derivatives_by_differences(const StruckState& struck) {
  const auto column = [&](double ImpactLaw::*number, double highest) {
    const double low = std::fmax(struck.law.*number - difference_step, 0),
                 high = std::fmin(struck.law.*number + difference_step, highest);
    const auto landed = [&](double value) {
      ImpactLaw law = struck.law;
      law.*number = value;
      return LandedFlat(struck, struck.contact, struck.before.angular, law);
    };
    const LandedFlat more = landed(high), less = landed(low);
    const auto slope = [&](double a, double b) { return (a - b) / (high - low); };
    LawColumn one{.normal = slope(more.impact.normal_impulse, less.impact.normal_impulse),
                  .tangential = slope(more.impact.tangential_impulse, less.impact.tangential_impulse)};
    one.state[at_normal] = slope(more.separation, less.separation);
    one.state[at_slip] = slope(more.impact.slip_after, less.impact.slip_after);
    one.state[at_turn] = slope(more.impact.after.angular, less.impact.after.angular);
    one.state[at_sum] = one.normal;
    set_parts(struck, more.impact.normal_impulse / struck.body.mass, one);
    return one;
  };
  return {.restitution = column(&ImpactLaw::restitution, 1),
          .friction = column(&ImpactLaw::friction_value, std::numeric_limits<double>::infinity())};
}

}  // namespace

LawDerivatives law_derivatives(const StruckState& struck, ImpactMode mode) {
  if (has_no_closed_form(struck)) return law_derivatives_by_differences(struck);
  using Number = detail::Dual<2>;          // of e and of the friction
  constexpr double from_above = 0x1p-400;  // friction without which impulses and velocities are the same
  ImpactLaw law = struck.law;
  if (law.friction == FrictionKind::none) law.friction = FrictionKind::coulomb;
  if (law.friction_value == 0) law.friction_value = from_above;
  // A path with λ times the friction is that of the friction given, with the tangential impulse in units of λ.
  const Number scale(1, {0, 1 / law.friction_value});
  const ContactPoint& d = struck.place;
  const double square = struck.body.gyration_square, turning = struck.before.angular * d.normal;
  const auto [a, b, c] = contact_inertia(square, d);
  const bool is_damped = law.law == RestitutionLaw::viscoelastic;
  const double approach =
      struck.flat ? -(struck.contact.normal + struck.before.angular * d.tangential) : -struck.contact.normal;
  const double damped =
      restitution_at(law, struck.flat ? pressure_centre_speed(approach, struck.before.angular, square) : approach);
  const Number e(is_damped ? damped : law.restitution, {is_damped ? 0.0 : 1.0, 0});
  PathStart<Number> start{.approach_speed = approach, .slip = struck.contact.slip, .restitution = e};
  const PathCoefficients<Number> path{
      .normal = a, .normal_coupling = b * scale, .slip_drift = b, .tangential = c * scale};
  if (struck.flat) start.slip = start.slip / scale;  // whose path has its own coefficients
  const PathEnd<Number> end =
      struck.flat ? flat_impulse<Number>(start, turning / scale, law) : point_impulse<Number>(path, start, law);
  const Number tangential = scale * end.tangential_impulse;
  const Number separation = struck.flat ? -e * struck.contact.normal : end.separation_speed;
  const Number push = struck.flat ? tangential - (1 + e) * turning : c * tangential - b * end.normal_impulse;
  const Number turn = struck.flat ? -(1 + e) * struck.before.angular
                                  : (tangential * d.normal - end.normal_impulse * d.tangential) / square;
  const auto column = [&](std::size_t i) {
    LawColumn one{.normal = struck.body.mass * end.normal_impulse.slope[i],
                  .tangential = struck.body.mass * tangential.slope[i]};
    one.state[at_normal] = separation.slope[i];
    one.state[at_slip] = sticks(mode) && !struck.flat ? 0 : push.slope[i];
    one.state[at_turn] = turn.slope[i];
    one.state[at_sum] = one.normal;
    set_parts(struck, i == 1 ? std::fabs(end.tangential_impulse.value) / law.friction_value : 0, one);
    return one;
  };
  return {.restitution = column(0), .friction = column(1)};
}

StateVector height_gradient(const FlownState& flown, int vertex, const Moment& moment) {
  const Departure& from = flown.departure;
  const ContactPoint d = flown.body.contact_point(vertex, from.sine, from.cosine);
  const ContactPoint offset = from.offset(flown.body, from.reference, vertex);
  const double sense = from.angular < 0 ? -1 : 1;
  const double along = offset.tangential - d.tangential * moment.turn.versine;
  StateVector gradient{};
  gradient[at_angle] = along + sense * (moment.turn.angle * offset.normal - d.normal * moment.turn.sine_deficit);
  gradient[at_normal] = moment.time;
  gradient[at_turn] = -moment.time * (along + sense * d.normal * moment.turn.sine);
  return gradient;
}

FlightDerivatives flight_derivatives(const FlownState& flown, const Moment& touch) {
  const Departure& from = flown.departure;
  const int vertex = flown.arrival.vertex;
  const double time = touch.time, rate = from.angular, turned = rate * time;
  const ContactPoint d = flown.body.contact_point(vertex, from.sine, from.cosine);
  const ContactPoint offset = from.offset(flown.body, from.reference, vertex);
  const double vers = touch.turn.versine, sine = rate < 0 ? -touch.turn.sine : touch.turn.sine;
  const ContactPoint to{.tangential = d.tangential + (d.normal * sine - d.tangential * vers),
                        .normal = d.normal - (d.tangential * sine + d.normal * vers)};
  // d_t and d_n of the arriving vertex at the touch, from those of the departing one before.
  const double along = offset.tangential + d.normal * sine - d.tangential * vers;
  const double up = offset.normal - d.tangential * sine - d.normal * vers;

  FlightDerivatives f;
  f.velocity = from.rebound_speed - from.gravity * time - rate * along;
  f.acceleration = -from.gravity - rate * rate * to.normal;
  f.of_time[at_time] = 1;
  f.of_time[at_angle] = -rate;
  f.of_time[at_normal] = f.acceleration;
  f.of_time[at_slip] = from.gravity_along - rate * rate * to.tangential;
  for (std::size_t i = 0; i < state_size; ++i) f.state[i][i] = 1;
  f.state[at_angle][at_turn] = -time;
  f.state[at_normal][at_angle] = rate * up;
  f.state[at_normal][at_turn] = -along - turned * to.normal;
  f.state[at_slip][at_angle] = rate * along;
  f.state[at_slip][at_turn] = up - turned * to.tangential;
  const StateVector height = height_gradient(flown, vertex, touch);
  for (std::size_t i = 0; i < state_size; ++i) {
    for (std::size_t k = 0; k < state_size; ++k) f.state[i][k] -= f.of_time[i] * height[k] / f.velocity;
  }
  return f;
}

MotionGradients::MotionGradients(const PlanarBody& body, const ContactPoint& d, const PlanarVelocity& v,
                                 double gravity) {
  normal[at_angle] = -v.angular * d.normal;
  normal[at_normal] = 1;
  normal[at_turn] = d.tangential;
  tangential[at_angle] = -v.angular * d.tangential;
  tangential[at_slip] = 1;
  tangential[at_turn] = -d.normal;
  for (std::size_t i = 0; i < state_size; ++i) {
    energy[i] = body.mass * (v.normal * normal[i] + v.tangential * tangential[i]);
  }
  energy[at_turn] += body.mass * body.gyration_square * v.angular;
  energy[at_angle] -= body.mass * gravity * d.tangential;
}

}  // namespace clatter::analytic
