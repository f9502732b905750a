// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/measured/track_impacts.hpp"

#include <algorithm>
#include <cmath>

#include "analytic/base/errors.hpp"
#include "analytic/space/first_contact.hpp"

namespace clatter::validation::inline measured {
namespace {

using analytic::space::FirstContact;
using analytic::space::FreeFlight;
using analytic::space::PrincipalAxes;
using analytic::space::State;

constexpr double bar = 3;  // standard deviations

Matrix3 gyration(const TrackedBody& body, const Quaternion& attitude) {
  const Matrix3 axes = attitude.toRotationMatrix();
  return axes * (body.core().inertia / body.core().mass) * axes.transpose();
}

/// Rows: derivative of the touching point's velocity by position, attitude, velocity and angular velocity.
Eigen::Matrix<double, 3, 12> point_velocity_map(const State& state, const Vector3& arm) {
  Eigen::Matrix<double, 3, 12> map = Eigen::Matrix<double, 3, 12>::Zero();
  map.block<3, 3>(0, 3) = -cross_matrix(state.angular_velocity) * cross_matrix(arm);
  map.block<3, 3>(0, 6) = Matrix3::Identity();
  map.block<3, 3>(0, 9) = -cross_matrix(arm);
  return map;
}

void add_lever(const TrackedBody& body, TrackImpact& impact, double tolerance) {
  impact.lever_miss = lever(body, impact, impact.arm);
  const Vector3 jump = impact.after.state.velocity - impact.before.state.velocity;
  const StateCovariance both = impact.before.covariance + impact.after.covariance;
  Eigen::Matrix<double, 3, 12> map = Eigen::Matrix<double, 3, 12>::Zero();
  map.block<3, 3>(0, 3) = cross_matrix(jump) * cross_matrix(impact.arm);
  map.block<3, 3>(0, 6) = cross_matrix(impact.arm);
  map.block<3, 3>(0, 9) = -gyration(body, impact.before.state.attitude);
  const double spread = std::sqrt((map * both * map.transpose()).trace());
  impact.lever_error = bar * spread / (jump.norm() * body.reach());
  impact.is_point = impact.lever_miss <= tolerance + impact.lever_error && impact.approach > 0;
  double least = impact.lever_miss;
  impact.momentum_corner = impact.corner;
  for (std::size_t i = 0; i < body.core().vertices.size(); ++i) {
    const Vector3 arm = body.arm(impact.before.state.attitude, static_cast<int>(i));
    if (arm.z() >= 0) continue;  // the ground cannot reach it
    const double miss = lever(body, impact, arm);
    if (miss < least) impact.momentum_corner = static_cast<int>(i);
    least = std::min(least, miss);
  }
}

/// Derivative of the touching point's height by position, attitude, velocity and angular velocity.
Eigen::Matrix<double, 1, 12> height_map(const Vector3& arm) {
  Eigen::Matrix<double, 1, 12> map = Eigen::Matrix<double, 1, 12>::Zero();
  map(2) = 1;
  map.segment<3>(3) = arm.cross(Vector3::UnitZ()).transpose();
  return map;
}

void add_ratios(TrackImpact& impact, double ground_error) {
  const State &before = impact.before.state, &after = impact.after.state;
  const Vector3 u = before.velocity + before.angular_velocity.cross(impact.arm);
  const Vector3 w = after.velocity + after.angular_velocity.cross(impact.arm);
  impact.approach = -u.z();
  impact.slip = u.head<2>().norm();
  impact.restitution = w.z() / impact.approach;
  const Eigen::Matrix<double, 3, 12> start = point_velocity_map(before, impact.arm),
                                     end = point_velocity_map(after, impact.arm);
  // The arm is common to both: its error, that of the attitude before, enters through both velocities.
  Eigen::Matrix<double, 1, 12> by_before = impact.restitution * start.row(2);
  by_before.segment<3>(3) += end.row(2).segment<3>(3);
  Eigen::Matrix<double, 1, 12> by_after = end.row(2);
  by_after.segment<3>(3).setZero();
  // A touch dt later: the arm turns with the body, and both velocities are those of another time.
  const Vector3 turned = before.angular_velocity.cross(impact.arm);
  const double by_time = after.angular_velocity.cross(turned).z() +
                         impact.restitution * before.angular_velocity.cross(turned).z() -
                         (1 + impact.restitution) * impact.gravity;
  // The pose before settles the moment of the touch.
  by_before += by_time / impact.approach * height_map(impact.arm);
  impact.restitution_error = std::sqrt((by_before * impact.before.covariance * by_before.transpose())(0) +
                                       (by_after * impact.after.covariance * by_after.transpose())(0) +
                                       std::pow(by_time * ground_error / impact.approach, 2)) /
                             impact.approach;
  const Vector3 jump = after.velocity - before.velocity;
  const double tangential = jump.head<2>().norm();
  impact.impulse_ratio = tangential / jump.z();
  Vector3 by_jump(0, 0, -impact.impulse_ratio / jump.z());
  if (tangential > 0) by_jump.head<2>() = jump.head<2>() / (tangential * jump.z());
  const Matrix3 spread = impact.before.covariance.block<3, 3>(6, 6) + impact.after.covariance.block<3, 3>(6, 6);
  impact.impulse_ratio_error = std::sqrt(by_jump.dot(spread * by_jump));
  const double along = u.head<2>().dot(w.head<2>());
  impact.slips_throughout = along > 0.5 * u.head<2>().norm() * w.head<2>().norm();
}

MeasuredState calibrated(const TrackedBody& body, MeasuredState measured) {
  measured.state.attitude = body.attitude(measured.state.attitude);
  return measured;
}

}  // namespace

double lever(const TrackedBody& body, const TrackImpact& impact, const Vector3& arm) {
  const State &before = impact.before.state, &after = impact.after.state;
  const Vector3 jump = after.velocity - before.velocity;
  const Vector3 twist = after.angular_velocity - before.angular_velocity;
  return (arm.cross(jump) - gyration(body, before.attitude) * twist).norm() / (jump.norm() * body.reach());
}

std::optional<double> contact_time(const TrackedBody& body, const FlightFit& flight, double start, double until) {
  State state = flight.state_at(start);
  state.attitude = body.attitude(state.attitude);
  state.position.z() -= body.calibration().ground + body.calibration().rounding;
  try {
    const FreeFlight free(PrincipalAxes(body.core().inertia), state, std::max(0.0, flight.gravity()));
    const double lowest =
        state.position.z() +
        (state.attitude * body.core().vertices[static_cast<std::size_t>(body.lowest(state.attitude))]).z();
    if (!(lowest > 0)) return std::nullopt;
    const FirstContact contact = analytic::space::first_contact(body.core(), free, {});
    if (contact.end != analytic::FlightEnd::contact || !(start + contact.time <= until)) return std::nullopt;
    return start + contact.time;
  } catch (const analytic::NumericalError&) {
    return std::nullopt;
  }
}

TrackImpact measured_impact(const Meeting& meeting, const TrackedBody& body, double ground_error,
                            double lever_tolerance) {
  TrackImpact impact;
  impact.number = meeting.number;
  const FlightFit& before = meeting.before;
  const double frame = (before.last() - before.first()) / std::max(1, before.frames() - 1);
  impact.time =
      contact_time(body, before, before.last() - 2 * frame, meeting.after.first() + frame).value_or(meeting.time);
  impact.between = meeting.between;
  impact.gravity = meeting.after.gravity();
  impact.before = calibrated(body, before.at(impact.time));
  impact.after = calibrated(body, meeting.after.at(impact.time));
  const Quaternion& attitude = impact.before.state.attitude;
  impact.corner = body.lowest(attitude);
  impact.arm = body.arm(attitude, impact.corner);
  impact.angle = std::acos(std::clamp(-impact.arm.z() / impact.arm.norm(), -1.0, 1.0));
  const State met = before.state_at(meeting.time);
  const Quaternion met_attitude = body.attitude(met.attitude);
  impact.height = met.position.z() + body.arm(met_attitude, body.lowest(met_attitude)).z() - body.calibration().ground;
  const double fall =
      std::fabs((impact.before.state.velocity + impact.before.state.angular_velocity.cross(impact.arm)).z());
  const auto height = height_map(impact.arm);
  const double low_error = std::sqrt((height * impact.before.covariance * height.transpose())(0));
  impact.time_error = std::hypot(ground_error, low_error) / std::max(fall, 1e-3);
  add_ratios(impact, ground_error);
  add_lever(body, impact, lever_tolerance);
  return impact;
}

}  // namespace clatter::validation::inline measured
