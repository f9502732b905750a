// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/space/free_rotation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace clatter::analytic::space {
namespace {

using Extended = long double;
using ExtendedVector = Eigen::Matrix<Extended, 3, 1>;

/// World components to body axes, with an attitude that is unit to the rounding of a double only.
ExtendedVector to_body(const Quaternion& attitude, const Vector3& v) {
  const Eigen::Quaternion<Extended> q = attitude.cast<Extended>();
  const ExtendedVector u = q.vec();
  const ExtendedVector w = v.cast<Extended>();
  const ExtendedVector t = 2 * w.cross(u);
  return w + (q.w() * t + t.cross(u)) / q.squaredNorm();
}

/// The shortest rotation from the unit vector m to axis 3, m₃ > −1.
Quaternion shortest_to_third(const Vector3& m) { return Quaternion(1 + m[2], m[1], -m[0], 0).normalized(); }

/// Its inverse applied to a vector.
Vector3 from_third(const Vector3& m, const Vector3& x) {
  const Vector3 across(-m[1], m[0], 0);
  const Vector3 turned = across.cross(x);
  return x + turned + across.cross(turned) / (1 + m[2]);
}

}  // namespace

FreeRotation::FreeRotation(const PrincipalAxes& principal, const Quaternion& attitude, const Vector3& angular_velocity)
    : start_(attitude.normalized()) {
  const ExtendedVector body = to_body(attitude, angular_velocity);
  const ExtendedVector along = principal.axes.transpose() * body;
  const PrincipalVelocity velocity{along[0], along[1], along[2]};
  start_vertical_ = (start_.conjugate() * Vector3::UnitZ()).normalized();
  speed_ = body.norm();
  fastest_ = static_cast<double>(speed_);
  if (speed_ > 0) axis_ = (body / speed_).cast<double>();
  if (ThetaRotation::is_steady(principal, velocity)) return;

  theta_.emplace(principal, velocity);
  const Vector3& i = theta_->moments();
  inverse_moments_ = theta_->momentum() * i.cwiseInverse();
  coefficients_ = {(i[1] - i[2]) / i[0], (i[2] - i[0]) / i[1], (i[0] - i[1]) / i[2]};
  // γ of a symmetric bilinear ω̇(ω, ω) with these coefficients.
  acceleration_factor_ = coefficients_.cwiseAbs().maxCoeff() * std::numbers::sqrt2 / 2;
  // |ω|² is linear in sn², so that its largest value lies at an end.
  const Vector3 w = theta_->amplitudes().cwiseProduct(inverse_moments_);
  const double third = theta_->least_third() * inverse_moments_[2];
  fastest_ =
      std::fmax(std::hypot(w[0], w[2]), std::hypot(w[1], third)) * (1 + 8 * std::numeric_limits<double>::epsilon());
  axes_ = theta_->axes().cast<double>();
  axis_ = axes_.col(2);
  axis_speed_ = std::fmax(w[0], w[1]) * (1 + 8 * std::numeric_limits<double>::epsilon());
  axes_attitude_ = Quaternion(axes_).normalized();
  const ThetaRotation::Moment now = theta_->at(0);
  const Quaternion spin = Quaternion(Eigen::AngleAxisd(std::atan2(now.sine, now.cosine), Vector3::UnitZ()));
  frame_ = (start_ * axes_attitude_ * (spin * shortest_to_third(now.momentum)).conjugate()).normalized();
  frame_vertical_ = (frame_.conjugate() * Vector3::UnitZ()).normalized();
}

FreeRotation::Spin FreeRotation::spin(double time) const {
  const ThetaRotation::Moment now = theta_->at(time);
  const Vector3& g = frame_vertical_;
  const Vector3 turned(now.cosine * g[0] + now.sine * g[1], now.cosine * g[1] - now.sine * g[0], g[2]);
  return {from_third(now.momentum, turned), inverse_moments_.cwiseProduct(now.momentum)};
}

Quaternion FreeRotation::attitude(double time) const {
  if (!theta_) {
    const double half = static_cast<double>(std::remainder(speed_ * time, 4 * std::numbers::pi_v<Extended>)) / 2;
    const Vector3 v = std::sin(half) * axis_;
    return (start_ * Quaternion(std::cos(half), v[0], v[1], v[2])).normalized();
  }
  const ThetaRotation::Moment now = theta_->at(time);
  const Quaternion spin = Quaternion(Eigen::AngleAxisd(std::atan2(now.sine, now.cosine), Vector3::UnitZ()));
  return (frame_ * spin * shortest_to_third(now.momentum) * axes_attitude_.conjugate()).normalized();
}

Vector3 FreeRotation::angular_velocity(double time) const {
  if (!theta_) return static_cast<double>(speed_) * axis_;
  return axes_ * inverse_moments_.cwiseProduct(theta_->at(time).momentum);
}

Vertical FreeRotation::vertical(double time) const {
  if (!theta_) return steady_vertical(time);
  const auto [e, w] = spin(time);
  const Vector3 acceleration(coefficients_[0] * w[1] * w[2], coefficients_[1] * w[2] * w[0],
                             coefficients_[2] * w[0] * w[1]);
  const Vector3 rate = e.cross(w);
  return {axes_ * e, axes_ * rate, axes_ * (rate.cross(w) + e.cross(acceleration))};
}

/// e turns about −axis.
Vertical FreeRotation::steady_vertical(double time) const {
  const double speed = static_cast<double>(speed_);
  const double angle = static_cast<double>(std::remainder(speed_ * time, 2 * std::numbers::pi_v<Extended>));
  const double s = std::sin(angle), half = std::sin(angle / 2);
  const Vector3 across = start_vertical_.cross(axis_);
  const Vector3 e = start_vertical_ + s * across + 2 * half * half * across.cross(axis_);
  const Vector3 rate = speed * e.cross(axis_);
  return {e, rate, speed * rate.cross(axis_)};
}

double FreeRotation::depth(const Vector3& place) const {
  const double reach = place.norm();
  if (!(speed_ > 0)) return -start_vertical_.dot(place);
  double lowest, highest, vertical;  // of the cosines: r with the momentum, and the vertical with the momentum
  if (theta_) {
    const Vector3 r = axes_.transpose() * place;
    const Vector3& m = theta_->amplitudes();
    const double swing = std::hypot(r[0] * m[0], r[1] * m[1]);
    const double ends[2] = {r[2] * m[2], r[2] * theta_->least_third()};
    lowest = std::min(ends[0], ends[1]) - swing;
    highest = std::max(ends[0], ends[1]) + swing;
    vertical = frame_vertical_[2];
  } else {
    lowest = highest = place.dot(axis_);
    vertical = start_vertical_.dot(axis_);
  }
  // The lowest r·z for an angle δ between r and the momentum is |r| cos(χ + δ); χ + δ = π is the deepest.
  const double chi = std::acos(std::clamp(vertical, -1.0, 1.0));
  const auto angle = [&](double cosine) { return reach > 0 ? std::acos(std::clamp(cosine / reach, -1.0, 1.0)) : 0; };
  const double nearest = std::clamp(std::numbers::pi - chi, angle(highest), angle(lowest));
  return -reach * std::cos(chi + nearest) + 16 * std::numeric_limits<double>::epsilon() * reach;
}

}  // namespace clatter::analytic::space
