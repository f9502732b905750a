// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/space/impulse/impact.hpp"

#include <Eigen/LU>
#include <limits>

#include "analytic/base/errors.hpp"
#include "analytic/space/flight/body.hpp"
#include "analytic/space/impulse/impulse_path.hpp"

namespace clatter::analytic::space {

double Impact::restitution() const { return contact_before.z() < 0 ? -contact_after.z() / contact_before.z() : 0; }

Matrix3 inverse_contact_inertia(double mass, const Matrix3& inverse_inertia, const Vector3& arm) {
  const Matrix3 cross = cross_matrix(arm);
  const Matrix3 turning = cross * inverse_inertia * cross.transpose();
  return Matrix3::Identity() / mass + (turning + turning.transpose()) / 2;
}

ContactVelocity contact_velocity(const State& state, const Vector3& place) {
  const Vector3 arm = state.attitude * place;
  return {.value = state.velocity + state.angular_velocity.cross(arm),
          .scale = state.velocity.norm() + state.angular_velocity.norm() * arm.norm()};
}

Impact strike(const Body& body, const State& before, const Vector3& place, const ImpactLaw& law) {
  return strike(body, before, contact_velocity(before, place), place, law);
}

Impact strike(const Body& body, const State& before, const ContactVelocity& velocity, const Vector3& place,
              const ImpactLaw& law, ImpulseSlopes* slopes) {
  law.validate();
  const Vector3& v = velocity.value;
  Impact impact;
  impact.contact_before = impact.contact_after = v;
  impact.approach_speed = -v.z();
  impact.velocity_after = before.velocity;
  impact.angular_velocity_after = before.angular_velocity;
  impact.slip_stop_impulse = std::numeric_limits<double>::quiet_NaN();
  impact.least_slip = v.head<2>().norm();
  if (!v.allFinite()) throw NumericalError("the velocity of the corner is not finite");
  if (!(v.z() < 0)) return impact;

  // In body axes nothing cancels, however much a needle's moments differ.
  const Matrix3 axes = before.attitude.toRotationMatrix(), inverse_inertia = body.inertia.inverse();
  const Matrix3 turned = axes * inverse_contact_inertia(body.mass, inverse_inertia, place) * axes.transpose();
  const Matrix3 w = (turned + turned.transpose()) / 2;
  const ContactImpulse at_corner =
      contact_impulse({.inverse_inertia = w, .velocity = v, .velocity_scale = velocity.scale}, law, slopes);
  impact.impulse = at_corner.impulse;
  impact.contact_after = at_corner.velocity_after;
  impact.velocity_after += at_corner.impulse / body.mass;
  impact.angular_velocity_after += axes * (inverse_inertia * place.cross(axes.transpose() * at_corner.impulse));
  impact.compression_impulse = at_corner.compression_impulse;
  impact.slip_stop_impulse = at_corner.slip_stop_impulse;
  impact.least_slip = at_corner.least_slip;
  impact.energy_loss = -at_corner.impulse.dot(v + at_corner.velocity_after) / 2;
  impact.path = at_corner.path;
  impact.is_path_ambiguous = at_corner.is_path_ambiguous;
  return impact;
}

/// r of (1) in body.hpp with e = Aᵀ z, δe = −Aᵀ (δθ × z):
///     S δθ = −ρ/|v| A (S² − S²e (S²e)ᵀ/|v|²) Aᵀ (z × δθ),   v = S e.  ([z]×³ = −[z]× makes it a sphere's.)
Matrix3 shift_of_lowest_point(const Body& body, const Quaternion& attitude, int point) {
  const auto index = static_cast<std::size_t>(point);
  if (index < body.vertices.size()) return Matrix3::Zero();
  const Round round = body.round(point);
  const Matrix3 turning = cross_matrix(Vector3::UnitZ());
  if (body.sphere(point) != nullptr) return round.radius * turning * turning * turning;
  if (!round.is_rim()) {
    const Vector3 v = round.across(attitude.conjugate() * Vector3::UnitZ());
    const double size = v.norm();
    const Vector3 lowest = attitude * round.twice(v) / size;  // from the centre, upward, over ρ
    const Matrix3 axes = attitude.toRotationMatrix();
    const Matrix3 squares = axes * round.shares.cwiseAbs2().asDiagonal() * axes.transpose();
    return -round.radius / size * (squares - lowest * lowest.transpose()) * turning;
  }
  const Vector3 axis = attitude * round.axis, across = Vector3::UnitZ() - axis.z() * axis;
  const Vector3 along = axis.cross(across) / across.norm();  // of the rim: the one direction in which its point moves
  return -round.radius / across.norm() * along * along.transpose() * turning;
}

namespace {

/// δW of (3), and that of a place that moves by δr, for turns about the axes.
std::array<Matrix3, 3> turned_inertia(const Matrix3& w, const Matrix3& inverse_inertia, const Vector3& arm,
                                      const Matrix3& shift) {
  std::array<Matrix3, 3> turns;
  for (int k = 0; k < 3; ++k) {
    const Matrix3 turn = cross_matrix(Vector3::Unit(k)) * w;
    const Matrix3 moved = cross_matrix(shift.col(k)) * inverse_inertia * cross_matrix(arm).transpose();
    turns[k] = turn + turn.transpose() + moved + moved.transpose();
  }
  return turns;
}

}  // namespace

StrikeDerivatives strike_derivatives(const Body& body, const State& before, const Corner& corner,
                                     const Vector3& impulse, const ImpulseSlopes& slopes) {
  const Matrix3 axes = before.attitude.toRotationMatrix();
  const Matrix3 inverse_inertia = axes * body.inertia.inverse() * axes.transpose();
  const Vector3 arm = axes * corner.place;
  const Matrix3 lever = cross_matrix(arm), shift = shift_of_lowest_point(body, before.attitude, corner.index);
  const Matrix3 turning = cross_matrix(before.angular_velocity), pushed = cross_matrix(impulse);
  Eigen::Matrix<double, 3, 9> change;
  change << slopes.of_turns + slopes.of_velocity * turning * (shift - lever), slopes.of_velocity,
      -slopes.of_velocity * lever;
  StrikeDerivatives derivatives;
  derivatives << change, change / body.mass, inverse_inertia * lever * change;
  derivatives.middleRows<6>(3).rightCols<6>() += Eigen::Matrix<double, 6, 6>::Identity();
  const Vector3 gain = inverse_inertia * arm.cross(impulse);
  derivatives.bottomLeftCorner<3, 3>() += inverse_inertia * (lever * pushed - pushed * shift) - cross_matrix(gain);
  return derivatives;
}

Impact strike(const Body& body, const State& before, const ContactVelocity& velocity, const Corner& corner,
              const ImpactLaw& law, StrikeDerivatives& derivatives) {
  const Matrix3 axes = before.attitude.toRotationMatrix();
  const Matrix3 inverse_inertia = axes * body.inertia.inverse() * axes.transpose();
  const Vector3 arm = axes * corner.place;
  const Matrix3 shift = shift_of_lowest_point(body, before.attitude, corner.index);
  ImpulseSlopes slopes;
  slopes.turns = turned_inertia(inverse_contact_inertia(body.mass, inverse_inertia, arm), inverse_inertia, arm, shift);
  const Impact impact = strike(body, before, velocity, corner.place, law, &slopes);
  derivatives = strike_derivatives(body, before, corner, impact.impulse, slopes);
  return impact;
}

}  // namespace clatter::analytic::space
