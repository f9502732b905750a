#include "numeric/motion/newton_euler.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

namespace clatter::numeric {

NewtonEuler::NewtonEuler(double mass, const Matrix3& inertia) : mass_(mass), inertia_(inertia), factors_(inertia) {
  if (!(mass > 0 && std::isfinite(mass))) {
    throw std::domain_error("mass = " + std::to_string(mass) + ": must be positive and finite");
  }
  if (!(inertia.allFinite() && factors_.info() == Eigen::Success)) {
    throw std::domain_error("inertia must be finite and positive definite");
  }
}

Acceleration NewtonEuler::acceleration(const Vector3& angular_velocity, const BodyWrench& wrench) const {
  const Vector3 gyroscopic = angular_velocity.cross(inertia_ * angular_velocity);
  return {.linear = wrench.force / mass_, .angular = factors_.solve(wrench.moment - gyroscopic)};
}

}  // namespace clatter::numeric
