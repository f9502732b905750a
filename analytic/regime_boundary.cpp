// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "analytic/detail/limits.hpp"

#include "analytic/contact_angles.hpp"

namespace clatter::analytic {

using detail::missing;

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
  const ContactAngle& below = angle_of(sides.below, impact);
  const ContactAngle& above = angle_of(sides.above, impact);
  const double theta = sides.below.theta.radians;
  RegimeBoundary boundary{.kind = kind_of(below, above), .theta = theta, .gamma = missing, .uncertainty = missing};
  // At a fold the angle of closest approach is the double root itself, free of its square root error.
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
    if (here.impacts() < number) {
      return describe(bisect({below, here}, impact, parameters), impact, parameters);
    }
    below = here;
  }
  boundary.kind = BoundaryKind::always;
  boundary.theta = pi / 2;
  return boundary;
}

}  // namespace clatter::analytic
