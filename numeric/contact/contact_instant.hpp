// SPDX-License-Identifier: GPL-3.0-or-later
// An instant of a contact, between the load and the friction that it meets.
#pragma once

#include "numeric/contact/contact_system.hpp"

namespace clatter::numeric {

[[nodiscard]] inline Vector3 along(const GroundView& view, const AlongGround& vector) {
  return vector.east * view.east + vector.north * view.north;
}

/// All that is known at an instant but the friction force.
struct ContactSystem::Instant {
  const GroundView& view;
  const ContactLoad& load;
  const LoadRates& rates;
  Vector3 normal;
  Vector3 centre;    ///< of pressure
  Vector3 moment;    ///< of the normal load, body frame
  double rise;       ///< vertical acceleration of the centre of mass
  AlongGround slip;  ///< velocity of the pressure centre

  struct Changes {
    double force;  ///< dF_n/dt
    Vector3 first_moment;
  };
  /// Rates of F_n and ∫f_n u for an angular acceleration, by δ̈ = −(V̇_z + h·u).
  [[nodiscard]] Changes changes(const Ground& ground, const Vector3& acceleration) const {
    const Vector3& omega = view.angular_velocity;
    const Vector3 h = normal.cross(acceleration) + normal.dot(omega) * omega - omega.squaredNorm() * normal;
    const double k = ground.stiffness, c = ground.damping;
    const LoadIntegrals& l = rates.load;
    const RateIntegrals& r = rates.rates;
    return {k * r.rate + c * (r.rate_squared - rise * l.depth - h.dot(l.depth_position)) + rates.force_by_area,
            k * r.rate_position +
                c * (r.rate_squared_position - rise * l.depth_position - r.depth_position_squared * h) +
                rates.first_moment_by_area};
  }
  /// What an angular acceleration adds to them, by the dampers alone.
  [[nodiscard]] Changes response(const Ground& ground, const Vector3& acceleration) const {
    const Vector3 h = normal.cross(acceleration);
    return {-ground.damping * h.dot(rates.load.depth_position),
            -ground.damping * (rates.rates.depth_position_squared * h)};
  }
  /// F_n ċ, ċ being the velocity at which the pressure centre runs over the body: finite where F_n fades.
  [[nodiscard]] Vector3 wander(const Changes& change) const { return change.first_moment - centre * change.force; }
};

/// Friction's resultant, its moment about the centre of mass (body frame) and the power that it dissipates.
struct ContactSystem::Friction {
  AlongGround force;
  Vector3 moment = Vector3::Zero();
  double power = 0;
  AlongGround hold;  ///< see ContactDiagnosis
};

}  // namespace clatter::numeric
