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

}  // namespace clatter::analytic::space
