// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/motion/steady_precession.hpp"

#include <cmath>

namespace clatter::numeric {
namespace {

Eigen::Quaterniond turn(const Vector3& axis, double angle) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle, axis));
}

}  // namespace

SteadyPrecession::SteadyPrecession(const Rotation& start, const Rates& rates)
    : start_(start), precession_(rates.precession.norm()), spin_axis_(rates.spin_axis), spin_(rates.spin) {
  if (precession_ > 0) precession_axis_ = rates.precession / precession_;
}

Rotation SteadyPrecession::at(double time) const {
  const Eigen::Quaterniond precessed = start_.attitude * turn(precession_axis_, precession_ * time);
  if (spin_ == 0) return {precessed.normalized(), start_.angular_velocity};
  const Eigen::Quaterniond spin = turn(spin_axis_, spin_ * time);
  return {(precessed * spin).normalized(), spin.conjugate() * start_.angular_velocity};
}

double SteadyPrecession::largest_speed() const { return start_.angular_velocity.norm(); }

double SteadyPrecession::largest_acceleration() const {
  return std::fabs(spin_) * spin_axis_.cross(start_.angular_velocity).norm();
}

}  // namespace clatter::numeric
