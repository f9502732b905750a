// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/shock/discrete_shock.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

namespace clatter::validation {
namespace {

namespace space = analytic::space;

/// An impact of either kind of sequence: what it does to the body, and how well that is known.
struct Strike {
  double start = 0, start_error = 0;  ///< [s]
  Eigen::Quaterniond attitude;
  Vector3 delta_velocity, delta_omega;  ///< of the centre of mass [m/s] and the body [rad/s], world
  double velocity_error = 0, omega_error = 0;
  double attitude_error = 0;  ///< [rad]
  bool predictable = true;
};

Eigen::Quaterniond turned(double inclination) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(-inclination, Vector3::UnitY()));
}

Strike strike_of(const analytic::ImpactRow& row, const analytic::PlanarBody& body) {
  const analytic::PlanarVelocity &before = row.before, &after = row.impact.after;
  const double impulse_error = std::hypot(row.error.normal_impulse, row.error.tangential_impulse);
  const Vector3 spin(0, after.angular - before.angular, 0);
  const double gain = body.reach() / (body.mass * body.gyration_square);
  return {.start = row.start,
          .start_error = row.error.start,
          .attitude = turned(row.inclination),
          .delta_velocity = {after.tangential - before.tangential, 0, after.normal - before.normal},
          .delta_omega = spin,
          .velocity_error = impulse_error / body.mass,
          .omega_error = gain * impulse_error + 2 * spin.norm() * row.error.inclination,
          .attitude_error = row.error.inclination,
          .predictable = row.error.predictable};
}

/// Largest |I⁻¹ (r × p)| of unit impulses p at the corners that strike [1/(kg·m)]; a moment of inertia that vanishes is
/// that of a thin rod about itself, which no impulse at it turns.
double turning_gain(const space::Body& body, const std::vector<space::Corner>& corners) {
  const Eigen::SelfAdjointEigenSolver<numeric::Matrix3> axes(body.inertia);
  const Vector3 moments = axes.eigenvalues();
  Vector3 inverse = Vector3::Zero();
  for (int i = 0; i < 3; ++i) {
    if (moments[i] > 1e-14 * moments[2]) inverse[i] = 1 / moments[i];
  }
  double gain = 0;
  for (const space::Corner& corner : corners) {
    numeric::Matrix3 arm;
    const Vector3& r = corner.place;
    arm << 0, -r.z(), r.y(), r.z(), 0, -r.x(), -r.y(), r.x(), 0;
    gain = std::max(gain, (inverse.asDiagonal() * axes.eigenvectors().transpose() * arm).norm());
  }
  return gain;
}

Strike strike_of(const space::ImpactRow& row, const space::Body& body) {
  const Vector3 spin = row.impact.angular_velocity_after - row.before.angular_velocity;
  return {.start = row.start,
          .start_error = row.error.start,
          .attitude = row.before.attitude,
          .delta_velocity = row.impact.velocity_after - row.before.velocity,
          .delta_omega = spin,
          .velocity_error = row.error.impulse / body.mass,
          .omega_error = turning_gain(body, row.corners) * row.error.impulse + 2 * spin.norm() * row.error.attitude,
          .attitude_error = row.error.attitude,
          .predictable = row.error.predictable};
}

std::vector<Strike> strikes_of(const DiscreteDrop& drop, const DiscreteSequence& sequence) {
  std::vector<Strike> strikes;
  if (const auto* const plane = std::get_if<analytic::Sequence>(&sequence)) {
    for (const auto& row : plane->rows) strikes.push_back(strike_of(row, std::get<analytic::Drop>(drop).body));
  } else {
    const auto& rows = std::get<space::Sequence>(sequence).rows;
    for (const auto& row : rows) strikes.push_back(strike_of(row, std::get<space::Drop>(drop).body));
  }
  return strikes;
}

ShockRow row_of(const Strike& strike, const Vector3& r) {
  constexpr double rounding = 8 * std::numeric_limits<double>::epsilon();
  const Vector3 arm = strike.attitude * r;
  ShockRow row;
  row.start = strike.start;
  row.predictable = strike.predictable;
  ShockNumbers &value = row.value, &error = row.error;
  value.delta_v = strike.delta_velocity + strike.delta_omega.cross(arm);
  value.delta_v_size = value.delta_v.norm();
  row.delta_v_body = strike.attitude.conjugate() * value.delta_v;
  row.start_error = strike.start_error;
  value.delta_omega = strike.delta_omega;
  value.delta_omega_size = value.delta_omega.norm();
  const double turn = value.delta_omega_size * arm.norm();
  error = {};
  error.delta_omega_size = strike.omega_error + rounding * value.delta_omega_size;
  error.delta_v_size = strike.velocity_error + arm.norm() * strike.omega_error + turn * strike.attitude_error +
                       rounding * (strike.delta_velocity.norm() + turn);
  if (!strike.predictable) error = ShockNumbers::unknown();
  error.delta_v = Vector3::Constant(error.delta_v_size);
  error.delta_omega = Vector3::Constant(error.delta_omega_size);
  return row;
}

}  // namespace

std::vector<ShockRow> discrete_shock(const DiscreteDrop& drop, const DiscreteSequence& sequence,
                                     const std::vector<Vector3>& places) {
  std::vector<ShockRow> rows;
  int impact = 0;
  for (const Strike& strike : strikes_of(drop, sequence)) {
    ++impact;
    for (std::size_t i = 0; i < places.size(); ++i) {
      rows.push_back(row_of(strike, places[i]));
      rows.back().impact = impact;
      rows.back().probe = i;
    }
  }
  return rows;
}

}  // namespace clatter::validation
