// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/contact_angles.hpp"

#include <cmath>

#include "analytic/body_motion.hpp"
#include "analytic/detail/limits.hpp"
#include "analytic/detail/require.hpp"
#include "analytic/detail/small_angle.hpp"

namespace clatter::analytic {

using detail::missing;

namespace {

using detail::require;

constexpr VertexSet end_a = 1;
constexpr VertexSet end_b = 2;

const PlanarBody& unit_rod() {
  static const PlanarBody rod = make_rod({});
  return rod;
}

ImpactLaw impact_law(const RodParameters& parameters) {
  return {.restitution = parameters.restitution,
          .friction = FrictionKind::impulse_ratio,
          .friction_value = parameters.impulse_ratio};
}

/// Reads a flight as the decision about the next contact angle.
ContactAngle decide(const Flight& flight, const Departure& departure, int other_end) {
  ContactAngle result{.clearance = flight.near_miss.clearance,
                      .closest_angle = std::fabs(departure.inclination - departure.angular * flight.near_miss.time),
                      .evaluations = flight.evaluations};
  if (flight.end == FlightEnd::stays_touching) {
    result.next = NextImpact::stays_touching;
  } else if (flight.end == FlightEnd::no_contact) {
    result.next = NextImpact::none;
    result.within_margin = flight.near_miss.within_margin();
  } else {
    result.time = flight.arrival.time;
    result.within_margin = flight.arrival.within_margin || flight.near_miss.within_margin();
    result.angle = std::fabs(flight.arrival.inclination);  // counted on, whole turns included
    result.next = flight.arrival.vertex != other_end ? NextImpact::same_end
                  : result.angle <= pi / 2           ? NextImpact::other_end
                                                     : NextImpact::beyond_upright;
  }
  return result;
}

/// 2 − ΣP = 1 − V₃ − G (T₁ + T₂), with 1 − V₃ = 2 sin²(deviation/2) where the frame has come round.
double impulse_deficit(const BodyMotion& motion, const ContactAngles& angles, double gravity) {
  const ElasticFrame& frame = motion.frame();
  const double fall = gravity * (angles.beta.time + angles.gamma.time);
  if (frame.speed == 1 && frame.sextant == 0) {
    return detail::versine(frame.deviation) - (motion.remainder().normal + fall);
  }
  return 2 - angles.impulse[0] - angles.impulse[1] - angles.impulse[2];
}

/// The chain of three impacts.
class Chain {
 public:
  Chain(const Angle& theta, const RodParameters& parameters)
      : parameters_(parameters), law_(impact_law(parameters)),
        motion_(unit_rod(), theta, {.normal = -1}, parameters.gravity_number) {
    result_.theta = theta;
    for (int i = 0; i < 3; ++i) {
      result_.impulse[i] = result_.velocity[i] = result_.angular[i] = missing;
    }
    result_.gamma_minus_theta = result_.impulse_deficit = missing;
  }

  ContactAngles run() {
    strike(0, end_a);
    result_.beta = fly(1);
    if (result_.beta.next != NextImpact::other_end) return result_;
    strike(1, end_b);
    result_.gamma = fly(0);
    if (result_.gamma.next != NextImpact::other_end) return result_;
    strike(2, end_a);
    result_.impulse_deficit = impulse_deficit(motion_, result_, parameters_.gravity_number);
    result_.gamma_minus_theta = motion_.elastic_offset().value_or(result_.gamma.angle - result_.theta.radians);
    return result_;
  }

 private:
  void strike(int number, VertexSet end) {
    const Impact impact = motion_.strike(end, law_).impact;
    result_.impulse[number] = impact.normal_impulse;
    result_.velocity[number] = impact.after.normal;
    result_.angular[number] = impact.after.angular;
  }

  ContactAngle fly(int other_end) {
    const Departure departure = motion_.departure();
    return decide(motion_.fly(), departure, other_end);
  }

  const RodParameters& parameters_;
  ImpactLaw law_;
  BodyMotion motion_;
  ContactAngles result_;
};

void require_contact_angle(const Angle& theta) {
  require(theta.radians >= 0 && theta.radians <= pi / 2, "theta", theta.radians, "between 0 and π/2");
}

}  // namespace

void RodParameters::validate() const {
  require(gravity_number >= 0 && std::isfinite(gravity_number), "gravity number", gravity_number,
          "at least 0 and finite");
  require(restitution >= 0 && restitution <= 1, "restitution", restitution, "between 0 and 1");
  require(std::isfinite(impulse_ratio), "impulse ratio", impulse_ratio, "finite");
}

int ContactAngles::impacts() const {
  return 1 + (beta.next == NextImpact::other_end) + (gamma.next == NextImpact::other_end);
}

ContactAngles contact_angles(const Angle& theta, const RodParameters& parameters) {
  parameters.validate();
  require_contact_angle(theta);
  return Chain(theta, parameters).run();
}

ContactAngle contact_angle_as_printed(const Angle& theta, double signed_gravity_number) {
  require_contact_angle(theta);
  require(std::isfinite(signed_gravity_number), "gravity number", signed_gravity_number, "finite");
  BodyMotion motion(unit_rod(), theta, {.normal = -1}, 0);
  motion.strike(end_a, {});
  Departure departure = motion.departure();
  departure.gravity = -signed_gravity_number / 2;  // turns − G φ²/Ω² into + (G/2) φ²/Ω²
  const VertexHeight height = vertex_height(unit_rod(), departure, 1);
  if (height.height == 0 && height.velocity < 0) return {.next = NextImpact::other_end};  // flat
  const FirstRoot root = first_root(height, 2 * pi / height.rate);
  ContactAngle result{.next = NextImpact::none, .evaluations = root.evaluations};
  if (!root.time) return result;
  result.time = *root.time;
  result.angle = height.rate * result.time - theta.radians;
  result.within_margin = root.within_margin;
  result.next = result.angle <= pi / 2 ? NextImpact::other_end : NextImpact::beyond_upright;
  return result;
}

}  // namespace clatter::analytic
