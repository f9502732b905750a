// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/motion/free_rotation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace clatter::numeric {
namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();
constexpr double equal_moments = 4 * eps;        // relative to the larger one
constexpr double negligible = 1e-120;            // part of |ω| whose square might underflow
constexpr double bound_rounding = 1 + 16 * eps;  // what the bounds and at() may be off
constexpr double largest_phase = 1e300;          // keeps angles finite

/// Largest power of two <= size; 1 for zero.
double power_of_two(double size) { return size > 0 ? std::ldexp(1.0, std::ilogb(size)) : 1; }

/// Unit attitude, and the velocity in units of `rate`.
Rotation scaled(const Rotation& start, double rate) {
  if (!start.angular_velocity.allFinite()) {
    throw std::domain_error("angular velocity must be finite");
  }
  const double norm = start.attitude.coeffs().stableNorm();
  if (!(norm > 0 && std::isfinite(norm))) {
    throw std::domain_error("attitude must be a finite quaternion other than zero");
  }
  return {Eigen::Quaterniond(start.attitude.coeffs() / norm), start.angular_velocity / rate};
}

/// Of a body whose moments other than `distinct` are equal.  The precession is the momentum divided
/// by their moment: as ω − σ s it would lose what a thin rod's fast spin leaves of it.
SteadyPrecession symmetric(const PrincipalAxes& body, const Rotation& start, int distinct) {
  const double across = (body.moments.sum() - body.moments[distinct]) / 2;
  const double ratio = body.moments[distinct] / across;
  const double difference = (across - body.moments[distinct]) / across;
  const Vector3 along = body.axes.transpose() * start.angular_velocity;
  Vector3 precession = along;
  precession[distinct] *= ratio;
  return SteadyPrecession(start, {.precession = body.axes * precession,
                                  .spin_axis = body.axes.col(distinct),
                                  .spin = difference * along[distinct]});
}

std::variant<SteadyPrecession, EllipticRotation> solve(PrincipalAxes body, const Rotation& start) {
  const Vector3 along = body.axes.transpose() * start.angular_velocity;
  if ((along.array().abs() > negligible).count() < 2) return SteadyPrecession(start);
  body.moments /= power_of_two(body.moments[2]);
  const auto equal = [&](int i, int j) { return body.moments[j] - body.moments[i] <= equal_moments * body.moments[j]; };
  if (equal(0, 1)) return symmetric(body, start, 2);
  if (equal(1, 2)) return symmetric(body, start, 0);
  return EllipticRotation(body, start);
}

}  // namespace

FreeRotation::FreeRotation(const Matrix3& inertia, const Rotation& start)
    : rate_(power_of_two(start.angular_velocity.cwiseAbs().maxCoeff())),
      rotation_(solve(principal_axes(inertia), scaled(start, rate_))) {}

Rotation FreeRotation::at(double time) const {
  if (std::isnan(time)) throw std::domain_error("time is not a number");
  const double phase = std::clamp(rate_ * time, -largest_phase, largest_phase);
  Rotation result = std::visit([&](const auto& rotation) { return rotation.at(phase); }, rotation_);
  result.angular_velocity *= rate_;
  return result;
}

double FreeRotation::largest_speed() const {
  return rate_ * bound_rounding * std::visit([](const auto& rotation) { return rotation.largest_speed(); }, rotation_);
}

double FreeRotation::largest_acceleration() const {
  return rate_ * rate_ * bound_rounding *
         std::visit([](const auto& rotation) { return rotation.largest_acceleration(); }, rotation_);
}

}  // namespace clatter::numeric
