#include "analytic/step_jacobians.hpp"

#include <cmath>

#include "analytic/detail/small_angle.hpp"

namespace clatter::analytic {
namespace {

/// An impact whose state differs from the one given.
struct Shift {
  double angle = 0, normal = 0, slip = 0, turn = 0;
};

/// d of a vertex when the body is inclined by `angle` more: d_t′ = −d_n, d_n′ = d_t.
ContactPoint inclined(const ContactPoint& d, double angle) {
  const double s = std::sin(angle), c = std::cos(angle);
  return {.tangential = d.tangential * c - d.normal * s, .normal = d.normal * c + d.tangential * s};
}

ImpactResponse point_response(const StruckState& struck, const Shift& by) {
  const ContactPoint d = inclined(struck.place, by.angle);
  const ContactVelocity contact{struck.contact.normal + by.normal, struck.contact.slip + by.slip};
  const double turn = struck.before.angular + by.turn;
  const PlanarVelocity before{.normal = contact.normal + turn * d.tangential,
                              .tangential = contact.slip - turn * d.normal,
                              .angular = turn};
  const Impact impact = strike(struck.body, before, contact, d, struck.law);
  const double mass = struck.body.mass;
  const double normal = impact.normal_impulse / mass, tangential = impact.tangential_impulse / mass;
  const ContactInertia inertia = contact_inertia(struck.body.gyration_square, d);
  return {.normal = impact.normal_impulse,
          .tangential = impact.tangential_impulse,
          .separation = impact.separation_speed,
          .push = inertia.tangential * tangential - inertia.coupling * normal,
          .turn = (tangential * d.normal - normal * d.tangential) / struck.body.gyration_square};
}

/// A flat landing keeps its inclination.
ImpactResponse flat_response(const StruckState& struck, const Shift& by, const Impact& as_it_was) {
  const ContactPoint& d = struck.place;
  const double u = struck.contact.normal + by.normal, s = struck.contact.slip + by.slip;
  const double turn = struck.before.angular + by.turn;
  const PlanarVelocity before{
      .normal = u + turn * d.tangential, .tangential = s - turn * d.normal, .angular = turn};
  const Impact impact =
      strike_flat(struck.body, before, d, struck.second, struck.law).value_or(as_it_was);
  return {.normal = impact.normal_impulse,
          .tangential = impact.tangential_impulse,
          .separation = normal_velocity(impact.after, d),
          .push = impact.slip_after - s,
          .turn = impact.after.angular - turn};
}

ImpactResponse response(const StruckState& struck, const Shift& by, const Impact& as_it_was) {
  return struck.flat ? flat_response(struck, by, as_it_was) : point_response(struck, by);
}

bool sticks(const Impact& impact) {
  return impact.mode == ImpactMode::stick || impact.mode == ImpactMode::slip_stick;
}

}  // namespace

ImpactDerivatives impact_derivatives(const StruckState& struck, const Impact& impact) {
  constexpr double part = 1e-5;  // errors: its square, and rounding over it
  const double speed = std::fabs(struck.contact.normal);
  const double reach = std::hypot(struck.place.tangential, struck.place.normal);
  const double slip = std::fmax(std::fabs(struck.contact.slip), speed);
  const double turn = std::fmax(std::fabs(struck.before.angular), speed / reach);
  const struct {
    std::size_t index;
    double step;
    double Shift::*member;
  } directions[] = {{at_angle, struck.flat ? 0 : part, &Shift::angle},
                    {at_normal, part * speed, &Shift::normal},
                    {at_slip, part * slip, &Shift::slip},
                    {at_turn, struck.flat ? part * turn : 0, &Shift::turn}};
  ImpactDerivatives d;
  for (std::size_t i = 0; i < state_size; ++i) d.state[i][i] = 1;
  for (const auto& [index, step, member] : directions) {
    if (!(step > 0)) continue;
    Shift up, down;
    up.*member = step;
    down.*member = -step;
    const ImpactResponse more = response(struck, up, impact), less = response(struck, down, impact);
    const auto slope = [&](double ImpactResponse::*of) {
      return (more.*of - less.*of) / (2 * step);
    };
    d.normal[index] = slope(&ImpactResponse::normal);
    d.tangential[index] = slope(&ImpactResponse::tangential);
    d.state[at_normal][index] = slope(&ImpactResponse::separation);
    d.state[at_slip][index] += slope(&ImpactResponse::push);
    d.state[at_turn][index] += slope(&ImpactResponse::turn);
    d.state[at_sum][index] += d.normal[index];
  }
  if (sticks(impact) && !struck.flat) d.state[at_slip] = {};
  return d;
}

StateVector height_gradient(const FlownState& flown, int vertex, double time) {
  const Departure& from = flown.departure;
  const ContactPoint d = flown.body.contact_point(vertex, from.sine, from.cosine);
  const ContactPoint offset = from.offset(flown.body, from.reference, vertex);
  const double turned = from.angular * time;
  const double vers = detail::versine(turned), sine = std::sin(turned);
  StateVector gradient{};
  gradient[at_angle] = offset.tangential - d.tangential * vers -
                       d.normal * detail::sine_deficit(turned) + turned * offset.normal;
  gradient[at_normal] = time;
  gradient[at_turn] = -time * (offset.tangential - d.tangential * vers + d.normal * sine);
  return gradient;
}

FlightDerivatives flight_derivatives(const FlownState& flown) {
  const Departure& from = flown.departure;
  const int vertex = flown.arrival.vertex;
  const double time = flown.arrival.time, rate = from.angular, turned = rate * time;
  const ContactPoint d = flown.body.contact_point(vertex, from.sine, from.cosine);
  const ContactPoint offset = from.offset(flown.body, from.reference, vertex);
  const double vers = detail::versine(turned), sine = std::sin(turned);
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
  f.of_time[at_slip] = -rate * rate * to.tangential;
  for (std::size_t i = 0; i < state_size; ++i) f.state[i][i] = 1;
  f.state[at_angle][at_turn] = -time;
  f.state[at_normal][at_angle] = rate * up;
  f.state[at_normal][at_turn] = -along - turned * to.normal;
  f.state[at_slip][at_angle] = rate * along;
  f.state[at_slip][at_turn] = up - turned * to.tangential;
  const StateVector height = height_gradient(flown, vertex, time);
  for (std::size_t i = 0; i < state_size; ++i) {
    for (std::size_t k = 0; k < state_size; ++k)
      f.state[i][k] -= f.of_time[i] * height[k] / f.velocity;
  }
  return f;
}

MotionGradients::MotionGradients(const PlanarBody& body, const ContactPoint& d,
                                 const PlanarVelocity& v, double gravity) {
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
