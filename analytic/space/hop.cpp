#include "analytic/space/hop.hpp"

namespace clatter::analytic::space {

Hop::Hop(const Body& body, const FreeFlight& flight, const Touch& touch) : speed_(touch.normal_velocity) {
  const Vector3& r = body.vertices[static_cast<std::size_t>(touch.point)];
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
  for (std::size_t k = 0; k < terms; ++k) bends_[k] = e[k + 2].dot(r);
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

}  // namespace clatter::analytic::space
