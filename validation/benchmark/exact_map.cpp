// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/benchmark/exact_map.hpp"

#include <cmath>
#include <numbers>

#include "analytic/base/errors.hpp"
#include "analytic/space/simultaneous.hpp"

namespace clatter::validation::inline benchmark {
namespace {

namespace space = analytic::space;
using space::Matrix3;
using space::State;
using space::Vector3;

/// Slip in a direction all through the impact, and what it leaves.
struct Slip {
  Vector3 impulse, after;
  double across;  ///< of the slip left over, across the direction
};

Slip slip_along(double angle, const Matrix3& w, const Vector3& v, const analytic::ImpactLaw& law) {
  const Vector3 direction(std::cos(angle), std::sin(angle), 0);
  const Vector3 rate = w * (Vector3::UnitZ() - law.friction_value * direction);
  const double normal = -(1 + law.restitution) * v.z() / rate.z();
  const Vector3 after = v + normal * rate;
  return {normal * (Vector3::UnitZ() - law.friction_value * direction), after, direction.cross(after).z()};
}

bool goes_along(const Slip& slip, double angle) {
  return slip.impulse.z() > 0 && slip.after.x() * std::cos(angle) + slip.after.y() * std::sin(angle) >= 0;
}

Matrix3 inverse_inertia(const Reference& reference, const State& state) {
  const Matrix3 turned = state.attitude.toRotationMatrix();
  return turned * reference.body.inertia.inverse() * turned.transpose();
}

State moreau_map(const Reference& reference, const analytic::ImpactLaw& law, const State& before, const Vector3& arm) {
  const Vector3 velocity = before.velocity + before.angular_velocity.cross(arm);
  State after = before;
  if (!(velocity.z() < 0)) return after;
  const Matrix3 inverse = inverse_inertia(reference, before);
  const Vector3 impulse =
      moreau_impulse(space::inverse_contact_inertia(reference.body.mass, inverse, arm), velocity, law);
  after.velocity += impulse / reference.body.mass;
  after.angular_velocity += inverse * arm.cross(impulse);
  return after;
}

}  // namespace

Vector3 moreau_impulse(const Matrix3& w, const Vector3& v, const analytic::ImpactLaw& law) {
  const Vector3 sticking = w.ldlt().solve(Vector3(-v.x(), -v.y(), -(1 + law.restitution) * v.z()));
  if (sticking.head<2>().norm() <= law.friction_value * sticking.z()) return sticking;
  constexpr int parts = 720;
  const double part = 2 * std::numbers::pi / parts;
  // In the plane the direction is exactly 0 or π.
  for (const double angle : {0.0, std::numbers::pi}) {
    const Slip slip = slip_along(angle, w, v, law);
    if (std::fabs(slip.across) <= 1e-15 * v.norm() && goes_along(slip, angle)) {
      return {slip.impulse.x(), 0, slip.impulse.z()};
    }
  }
  for (int i = 0; i < parts; ++i) {
    double low = i * part, high = (i + 1) * part;
    const bool is_left = slip_along(low, w, v, law).across > 0;
    if (is_left == (slip_along(high, w, v, law).across > 0) || !goes_along(slip_along(low, w, v, law), low)) continue;
    for (int k = 0; k < 60; ++k) {
      const double middle = (low + high) / 2;
      (is_left == (slip_along(middle, w, v, law).across > 0) ? low : high) = middle;
    }
    return slip_along(low, w, v, law).impulse;
  }
  throw analytic::NumericalError("no direction of slip satisfies Moreau's law");
}

State exact_map(const Reference& reference, const DeclaredLaw& law, const State& before,
                const std::vector<int>& points) {
  const std::vector<Vector3> arms = reference.arms(before.attitude);
  std::vector<space::Corner> corners;
  for (const int point : points) {
    corners.push_back({point, before.attitude.conjugate() * arms[static_cast<std::size_t>(point)]});
  }
  if (law.is_moreau && points.size() == 1) {
    return moreau_map(reference, law.law.law, before, arms[static_cast<std::size_t>(points.front())]);
  }
  State after = before;
  if (points.size() == 1) {
    const space::Impact impact = strike(reference.body, before, corners.front().place, law.law);
    after.velocity = impact.velocity_after;
    after.angular_velocity = impact.angular_velocity_after;
  } else {
    const space::GroupImpact impact = strike_together(reference.body, before, corners, law.law);
    after.velocity = impact.velocity_after;
    after.angular_velocity = impact.angular_velocity_after;
  }
  return after;
}

}  // namespace clatter::validation::inline benchmark
