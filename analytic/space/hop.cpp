// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/space/hop.hpp"

#include <cmath>

#include "analytic/detail/limits.hpp"

namespace clatter::analytic::space {

Hop::Hop(const Body& body, const FreeFlight& flight, const Vector3& place, double speed) : speed_(speed) {
  const Matrix3& inertia = body.inertia;
  const Matrix3 inverse = inertia.inverse();
  std::array<Vector3, terms + 2> e, w, momentum;
  e[0] = flight.rotation().vertical(0).direction;
  w[0] = flight.rotation().angular_velocity(0);
  momentum[0] = inertia * w[0];
  for (std::size_t n = 0; n + 1 < e.size(); ++n) {
    Vector3 turn = Vector3::Zero(), torque = Vector3::Zero();
    for (std::size_t k = 0; k <= n; ++k) {
      turn += e[k].cross(w[n - k]);
      torque += momentum[k].cross(w[n - k]);
    }
    const double next = static_cast<double>(n + 1);
    e[n + 1] = turn / next;
    momentum[n + 1] = torque / next;
    w[n + 1] = inverse * momentum[n + 1];
  }
  for (std::size_t k = 0; k < terms; ++k) bends_[k] = e[k + 2].dot(place);
  bends_[0] -= flight.gravity() / 2;
}

Hop::Value Hop::at(double time) const {
  double bend = 0, slope = 0;
  for (std::size_t k = terms; k-- > 0;) {
    slope = slope * time + bend;
    bend = bend * time + bends_[k];
  }
  return {.quotient = speed_ + time * bend, .slope = bend + time * slope};
}

double Hop::velocity(double time) const {
  const Value value = at(time);
  return value.quotient + time * value.slope;
}

std::optional<Vector3> hopping_place(const Body& body, const FreeFlight& flight, int point) {
  const auto index = static_cast<std::size_t>(point);
  if (index < body.vertices.size()) return body.vertices[index];
  const Corner corner = touching_corner(body, flight.start().attitude, point);
  const Vector3& spin = flight.start().angular_velocity;
  const bool stays_level = corner.radius > 0 && spin.head<2>().norm() <= 64 * detail::epsilon * std::fabs(spin.z());
  return stays_level ? std::optional<Vector3>(corner.place) : std::nullopt;
}

}  // namespace clatter::analytic::space
