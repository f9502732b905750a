// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/space/error_growth.hpp"

#include <gsl/gsl_linalg.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "analytic/detail/limits.hpp"
#include "analytic/space/cross_matrix.hpp"
#include "analytic/space/small_change.hpp"

namespace clatter::analytic::space {

using detail::epsilon;
using detail::infinite;

namespace {

/// Bounds are this many standard deviations of the errors assumed.
constexpr double deviations = 3;
/// Rounding of an impulse with friction, relative: half of what impact.hpp promises, as a standard deviation.
constexpr double friction_rounding = 5e-14;

}  // namespace

RowErrors RowErrors::unknown() {
  return {.predictable = false,
          .start = infinite,
          .attitude = infinite,
          .approach_speed = infinite,
          .impulse = infinite,
          .velocity_after = infinite,
          .angular_velocity_after = infinite,
          .energy_before = infinite,
          .energy_after = infinite};
}

ErrorGrowth::ErrorGrowth(const Body& body, const State& start, double gravity)
    : body_(body), gravity_(gravity), inverse_inertia_(body.inertia.inverse()), factor_(size, 0) {
  Deviations d;
  d << 0, Vector3::Constant(epsilon), epsilon * start.velocity.cwiseAbs(), epsilon * start.angular_velocity.cwiseAbs();
  add(d);
  of_drop_.setZero();
  for (int k = 0; k < 3; ++k) {
    of_drop_(1 + k, k) = 1;
    of_drop_(4 + k, 3 + k) = start.velocity.norm();
    of_drop_(7 + k, 6 + k) = start.angular_velocity.norm();
  }
}

void ErrorGrowth::add(const Deviations& d) { append(Jacobian(d.asDiagonal())); }

/// F Fᵀ = Rᵀ R with Fᵀ = Q R: F's columns are the rows of Fᵀ, as GSL stores them.
void ErrorGrowth::append(const Factor& columns) {
  Factor wider(size, factor_.cols() + columns.cols());
  wider << factor_, columns;
  if (wider.cols() > 2 * size) {
    double scales[size];
    gsl_matrix_view rows = gsl_matrix_view_array(wider.data(), static_cast<std::size_t>(wider.cols()), size);
    gsl_vector_view tau = gsl_vector_view_array(scales, size);
    gsl_linalg_QR_decomp(&rows.matrix, &tau.vector);
    wider.conservativeResize(Eigen::NoChange, size);
    for (int i = 0; i < size; ++i) wider.col(i).head(i).setZero();
  }
  factor_ = wider;
}

/// What rounding of the impulse, δP in each direction, does to the state: δV = δP/m, δω = I⁻¹ (r × δP).
ErrorGrowth::Factor ErrorGrowth::impulse_rounding(const ImpactRow& row) const {
  const double speed = row.before.velocity.norm() + row.before.angular_velocity.norm() * body_.reach();
  const double share = row.impact.path == PathKind::frictionless ? 8 * epsilon : friction_rounding;
  const double rounding = share * row.impact.impulse.norm() + 8 * epsilon * body_.mass * speed;
  const Matrix3 axes = row.before.attitude.toRotationMatrix();
  const Matrix3 lever = axes * inverse_inertia_ * axes.transpose() * cross_matrix(axes * row.corners.front().place);
  // The inverse inertia in world axes errs by its largest element.
  const double turning =
      2 * epsilon * inverse_inertia_.norm() * (axes * row.corners.front().place).cross(row.impact.impulse).norm();
  Factor columns = Factor::Zero(size, 6);
  columns.block<3, 3>(4, 0) = rounding / body_.mass * Matrix3::Identity();
  columns.block<3, 3>(7, 0) = rounding * lever;
  columns.block<3, 3>(7, 3) = turning * Matrix3::Identity();
  return columns;
}

void ErrorGrowth::advance(const Jacobian& jacobian) {
  factor_ = jacobian.lazyProduct(factor_).eval();
  of_drop_ = jacobian.lazyProduct(of_drop_).eval();
}

double ErrorGrowth::bound(const Eigen::MatrixXd& gradient) const {
  const double value = deviations * gradient.lazyProduct(factor_).norm();
  return std::isfinite(value) ? value : infinite;
}

/// Rows: P, V′, ω′; columns: δθ, V, ω.
Eigen::MatrixXd ErrorGrowth::strike_jacobian(const Strike& strike, const ImpactRow& row) const {
  const double reach = body_.reach();
  const double speed = row.impact.contact_before.norm();
  const double turning = row.before.angular_velocity.norm() * reach;
  // The lowest point of a rim moves by ρ for a turn by the rim's steepness.
  const double room = row.group ? 1 : steepness(body_, row.before.attitude, row.corners.front().index);
  const double steps[3] = {relative_step * std::fmin(room, speed / std::fmax(turning, speed)), relative_step * speed,
                           relative_step * speed / reach};
  Eigen::MatrixXd derivatives(9, 9);
  for (int k = 0; k < 9; ++k) {
    const double step = steps[k / 3];
    const Impact plus = strike(shifted(row.before, k, step)), minus = strike(shifted(row.before, k, -step));
    derivatives.col(k) << plus.impulse - minus.impulse, plus.velocity_after - minus.velocity_after,
        plus.angular_velocity_after - minus.angular_velocity_after;
    derivatives.col(k) /= 2 * step;
  }
  return derivatives;
}

std::pair<Eigen::MatrixXd, Eigen::MatrixXd> ErrorGrowth::energy_gradients(const ImpactRow& row, const Matrix3& inertia,
                                                                          const Eigen::MatrixXd& velocity,
                                                                          const Eigen::MatrixXd& turning) const {
  const State& before = row.before;
  const Vector3 arm = before.attitude * row.corners.front().place;
  const Vector3& w = before.angular_velocity;
  const Vector3 momentum = inertia * w, momentum_after = inertia * row.impact.angular_velocity_after;
  Eigen::MatrixXd energy = Eigen::MatrixXd::Zero(1, size), energy_after = energy;
  energy.block<1, 3>(0, 1) = momentum.cross(w).transpose() + body_.mass * gravity_ * cross_matrix(arm).row(2);
  energy.block<1, 3>(0, 4) = body_.mass * before.velocity.transpose();
  energy.block<1, 3>(0, 7) = momentum.transpose();
  energy_after.block<1, 3>(0, 1) = energy.block<1, 3>(0, 1) - momentum.cross(w).transpose() +
                                   momentum_after.cross(row.impact.angular_velocity_after).transpose();
  energy_after += body_.mass * row.impact.velocity_after.transpose().lazyProduct(velocity) +
                  momentum_after.transpose().lazyProduct(turning);
  return {energy, energy_after};
}

void ErrorGrowth::fill(const Eigen::MatrixXd& derivatives, ImpactRow& row) const {
  const State& before = row.before;
  const Vector3 arm = before.attitude * row.corners.front().place;
  const Matrix3 axes = before.attitude.toRotationMatrix(), inertia = axes * body_.inertia * axes.transpose();
  Eigen::MatrixXd time = Eigen::MatrixXd::Zero(1, size), approach = time;
  Eigen::MatrixXd angle = Eigen::MatrixXd::Zero(3, size), impulse = angle, velocity = angle, turning = angle;
  time(0, 0) = 1;
  angle.block<3, 3>(0, 1) = Matrix3::Identity();
  impulse.rightCols(9) = derivatives.topRows(3);
  velocity.rightCols(9) = derivatives.middleRows(3, 3);
  turning.rightCols(9) = derivatives.bottomRows(3);
  // u = V_z + (ω × r)_z.
  const Vector3& w = before.angular_velocity;
  approach.block<1, 3>(0, 1) = -(cross_matrix(w) * cross_matrix(arm)).row(2);
  approach(0, 6) = 1;
  approach.block<1, 3>(0, 7) = -cross_matrix(arm).row(2);
  const auto [energy, energy_after] = energy_gradients(row, inertia, velocity, turning);
  const Vector3 momentum_after = inertia * row.impact.angular_velocity_after;
  const Factor rounding = impulse_rounding(row);
  const double in_velocity = deviations * rounding.middleRows(4, 3).norm();
  const double in_turning = deviations * rounding.bottomRows(3).norm();
  const double size_of_energy = std::fabs(row.energy_before) + std::fabs(row.energy_after);
  RowErrors& e = row.error;
  e.predictable = true;
  e.start = row.start == 0 ? 0 : bound(time) + epsilon * row.start;
  e.attitude = bound(angle) + 4 * epsilon;
  e.approach_speed = bound(approach) + 4 * epsilon * (before.velocity.norm() + w.norm() * body_.reach());
  e.impulse = bound(impulse) + body_.mass * in_velocity;
  e.velocity_after = bound(velocity) + in_velocity + 4 * epsilon * before.velocity.norm();
  e.angular_velocity_after = bound(turning) + in_turning + 4 * epsilon * w.norm();
  e.energy_before = bound(energy) + 8 * epsilon * size_of_energy;
  e.energy_after = bound(energy_after) + 8 * epsilon * size_of_energy +
                   body_.mass * in_velocity * row.impact.velocity_after.norm() + in_turning * momentum_after.norm();
}

void ErrorGrowth::strike(const Strike& strike, ImpactRow& row) {
  row.error = RowErrors::unknown();
  row.amplification = std::numeric_limits<double>::quiet_NaN();
  const bool turns = row.before.angular_velocity.norm() > 0;
  if (row.group && row.start > 0 && turns) predictable_ = false;
  if (!predictable_) return;
  if (!(row.approach_speed > 0) || row.impact.impulse.norm() == 0) {
    predictable_ = false;
    return;
  }
  Eigen::MatrixXd derivatives;
  try {
    derivatives = strike_jacobian(strike, row);
  } catch (const std::runtime_error&) {  // a neighbour jams, or cannot be computed
    predictable_ = false;
    return;
  }
  if (!derivatives.allFinite()) {
    predictable_ = false;
    return;
  }
  fill(derivatives, row);
  const double of_time = row.start > 0 ? of_drop_.row(0).norm() / row.start : 0;
  const double of_impulse =
      derivatives.topRows(3).lazyProduct(of_drop_.bottomRows(9)).norm() / row.impact.impulse.norm();
  row.amplification = std::fmax(std::fmax(of_time, of_impulse), of_drop_.middleRows(1, 3).norm());

  Jacobian jacobian = Jacobian::Identity();
  jacobian.bottomRightCorner(6, 9) = derivatives.bottomRows(6);
  advance(jacobian);
  append(impulse_rounding(row));
  Deviations d;
  d << 0, Vector3::Constant(epsilon),
      Vector3::Constant(epsilon * (row.before.velocity.norm() + row.impact.velocity_after.norm())),
      Vector3::Constant(epsilon * (row.before.angular_velocity.norm() + row.impact.angular_velocity_after.norm()));
  add(d);
}

}  // namespace clatter::analytic::space
