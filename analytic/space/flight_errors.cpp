// SPDX-License-Identifier: GPL-3.0-or-later
// Growth of errors along a flight, up to the touch that ends it.
#include <algorithm>
#include <cmath>

#include "analytic/detail/limits.hpp"
#include "analytic/space/cross_matrix.hpp"
#include "analytic/space/error_growth.hpp"
#include "analytic/space/small_change.hpp"

namespace clatter::analytic::space {

using detail::epsilon;

ErrorGrowth::Jacobian ErrorGrowth::flight_jacobian(const FreeFlight& flight, double time) const {
  const State& start = flight.start();
  const double speed = start.angular_velocity.norm();
  const double step = speed > 0 ? relative_step * speed / (1 + speed * time) : relative_step / time;
  const PrincipalAxes principal(body_.inertia);
  const State now = flight.at(time);
  Matrix3 of_attitude, of_velocity;
  for (int k = 0; k < 3; ++k) {
    const State plus = FreeFlight(principal, shifted(start, 6 + k, step), gravity_).at(time);
    const State minus = FreeFlight(principal, shifted(start, 6 + k, -step), gravity_).at(time);
    of_attitude.col(k) = small_rotation(plus.attitude, minus.attitude) / (2 * step);
    of_velocity.col(k) = (plus.angular_velocity - minus.angular_velocity) / (2 * step);
  }
  // A turn of attitude and ω together turns the whole motion.
  const Matrix3 turn = cross_matrix(start.angular_velocity);
  Jacobian j = Jacobian::Identity();
  j.block<3, 3>(1, 1) = Matrix3::Identity() + of_attitude * turn;
  j.block<3, 3>(1, 7) = of_attitude;
  j.block<3, 3>(7, 1) = -cross_matrix(now.angular_velocity) + of_velocity * turn;
  j.block<3, 3>(7, 7) = of_velocity;
  return j;
}

void ErrorGrowth::fly(const FreeFlight& flight, const FirstContact& contact, const Vector3& from_place,
                      const Vector3& to_place) {
  if (!predictable_ || !(contact.time > 0)) {
    predictable_ = false;
    return;
  }
  const double t = contact.time;
  const State now = flight.at(t);
  Jacobian j = flight_jacobian(flight, t);
  const Vector3 from = flight.start().attitude * from_place, to = now.attitude * to_place;
  Eigen::Matrix<double, 1, size> height = -cross_matrix(to).row(2) * j.middleRows(1, 3);
  height.segment<3>(1) += cross_matrix(from).row(2);
  height[6] += t;
  const Eigen::Matrix<double, 1, size> shift = -height / contact.normal_velocity;
  const Vector3 body_velocity = now.attitude.conjugate() * now.angular_velocity;
  const Vector3 acceleration = now.attitude * (inverse_inertia_ * (body_.inertia * body_velocity).cross(body_velocity));
  j.row(0) += shift;
  j.middleRows(1, 3) += now.angular_velocity * shift;
  j.row(6) -= gravity_ * shift;
  j.bottomRows(3) += acceleration * shift;
  advance(j);
  const double size_of_height = body_.reach() + t * (flight.start().velocity.norm() + gravity_ * t);
  const double turned_by = 1 + 1e-3 * flight.rotation().fastest() * t;
  Deviations d;
  d << epsilon * t + 2 * epsilon * size_of_height / std::fabs(contact.normal_velocity),
      Vector3::Constant(2 * epsilon * turned_by), Vector3::Constant(epsilon * (now.velocity.norm() + gravity_ * t)),
      Vector3::Constant(2 * epsilon * now.angular_velocity.norm());
  add(d);
  // First order holds while the shift of the touch changes h′ little.
  Eigen::MatrixXd time = Eigen::MatrixXd::Zero(1, size), angle = Eigen::MatrixXd::Zero(3, size);
  time(0, 0) = 1;
  angle.block<3, 3>(0, 1) = Matrix3::Identity();
  const double late = bound(time);
  if (!(late * std::fabs(contact.acceleration) <= first_order * std::fabs(contact.normal_velocity)) ||
      !(bound(angle) <= first_order) || contact.within_margin) {
    predictable_ = false;
  }
  if (predictable_) check_others(flight, contact);
}

/// Height of a point that neither departed nor arrived: error of attitude and of the parabola.
double ErrorGrowth::height_bound(double time) const {
  Eigen::MatrixXd angle = Eigen::MatrixXd::Zero(3, size), fall = Eigen::MatrixXd::Zero(1, size);
  angle.block<3, 3>(0, 1) = Matrix3::Identity();
  fall(0, 6) = time;
  return 2 * body_.reach() * bound(angle) + bound(fall);
}

/// No other point may be so near the ground that the errors let it arrive first.
void ErrorGrowth::check_others(const FreeFlight& flight, const FirstContact& contact) {
  const double errs = height_bound(contact.time);
  if (!(contact.near_miss.clearance > errs)) predictable_ = false;
  const PointHeights heights(body_, flight);
  const FlightMoment moment = heights.moment(contact.time);
  for (int i = 0; i < heights.count(); ++i) {
    if (std::find(contact.together.begin(), contact.together.end(), i) != contact.together.end()) continue;
    const PointHeight h = heights.at(i, moment);
    if (h.velocity < 0 && !(h.height > errs)) predictable_ = false;
  }
}

void ErrorGrowth::end_without_contact(const FirstContact& contact) {
  if (!(contact.near_miss.clearance > height_bound(contact.near_miss.time))) predictable_ = false;
}

}  // namespace clatter::analytic::space
