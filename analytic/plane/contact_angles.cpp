// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/plane/contact_angles.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "analytic/base/angle.hpp"
#include "analytic/base/errors.hpp"
#include "analytic/base/limits.hpp"
#include "analytic/plane/body_motion.hpp"

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
    for (int i = 0; i < 3; ++i) result_.impulse[i] = result_.velocity[i] = result_.angular[i] = missing;
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

namespace {

/// The decisions on both sides of a boundary.
struct Sides {
  ContactAngles below;  ///< the impact happens
  ContactAngles above;  ///< it does not
};

const ContactAngle& angle_of(const ContactAngles& angles, ImpactNumber impact) {
  return impact == ImpactNumber::second ? angles.beta : angles.gamma;
}

/// At a fold the contact below it vanishes, so that the next one, if any, comes a finite time later.
BoundaryKind kind_of(const ContactAngle& below, const ContactAngle& above) {
  const bool jumps = !(std::fabs(above.time - below.time) <= 1e-5 * below.time);
  if (above.next == NextImpact::none || jumps) return BoundaryKind::fold;
  return above.next == NextImpact::beyond_upright ? BoundaryKind::upright : BoundaryKind::order;
}

/// Rounding margin of the clearance over the rate at which it opens with θ; not finite at the upright, beyond which
/// there is nothing to see.
double fold_uncertainty(double theta, ImpactNumber impact, const RodParameters& parameters) {
  const double apart = std::min(1e-6, (pi / 2 - theta) / 2);
  const auto clearance_at = [&](double t) {
    return angle_of(contact_angles(Angle::from_radians(t), parameters), impact).clearance;
  };
  const double rate = (clearance_at(theta + 2 * apart) - clearance_at(theta + apart)) / apart;
  constexpr double margin = 16 * std::numeric_limits<double>::epsilon();  // of a height of order L
  return margin / rate;
}

RegimeBoundary describe(const Sides& sides, ImpactNumber impact, const RodParameters& parameters) {
  if (impact == ImpactNumber::third && sides.above.impacts() < 2) {  // it is lost with the second, and as that is
    RegimeBoundary boundary = describe(sides, ImpactNumber::second, parameters);
    boundary.gamma = sides.below.gamma.angle;
    return boundary;
  }
  const ContactAngle& below = angle_of(sides.below, impact);
  const ContactAngle& above = angle_of(sides.above, impact);
  const double theta = sides.below.theta.radians;
  RegimeBoundary boundary{.kind = kind_of(below, above), .theta = theta, .gamma = missing, .uncertainty = missing};
  // At a fold the angle of closest approach is the double root itself, free of its square root error; below it the two
  // roots are as close as that.
  constexpr double close = 1e-3;
  if (boundary.kind == BoundaryKind::fold && !(std::fabs(above.closest_angle - below.angle) <= close))
    boundary.kind = BoundaryKind::stop;
  const double angle = boundary.kind == BoundaryKind::fold ? above.closest_angle : below.angle;
  boundary.beta = impact == ImpactNumber::second ? angle : sides.above.beta.angle;
  if (impact == ImpactNumber::third) boundary.gamma = angle;
  if (boundary.kind == BoundaryKind::fold) boundary.uncertainty = fold_uncertainty(theta, impact, parameters);
  if (!(boundary.uncertainty >= 0 && boundary.uncertainty < 1))
    boundary.uncertainty = sides.above.theta.radians - theta;
  return boundary;
}

Sides bisect(Sides sides, ImpactNumber impact, const RodParameters& parameters) {
  const int number = static_cast<int>(impact);
  for (;;) {
    const double low = sides.below.theta.radians;
    const double high = sides.above.theta.radians;
    const double middle = std::midpoint(low, high);
    if (!(middle > low && middle < high)) return sides;
    const ContactAngles angles = contact_angles(Angle::from_radians(middle), parameters);
    (angles.impacts() >= number ? sides.below : sides.above) = angles;
  }
}

}  // namespace

RegimeBoundary regime_boundary(ImpactNumber impact, const RodParameters& parameters) {
  const int number = static_cast<int>(impact);
  const auto at = [&](double degrees) { return contact_angles(Angle::from_degrees(degrees), parameters); };
  constexpr double step = 0.25;  // degrees; regimes narrower than this are not looked for
  ContactAngles below = at(step / 1024);
  RegimeBoundary boundary{.beta = missing, .gamma = missing};
  if (below.impacts() < number) return boundary;
  for (double degrees = step; degrees <= 90; degrees += step) {
    const ContactAngles here = at(degrees);
    if (here.impacts() < number) return describe(bisect({below, here}, impact, parameters), impact, parameters);
    below = here;
  }
  boundary.kind = BoundaryKind::always;
  boundary.theta = pi / 2;
  return boundary;
}

}  // namespace clatter::analytic
