// SPDX-License-Identifier: GPL-3.0-or-later
// Torque-free rotation of a rigid body in closed form.
#pragma once

#include <variant>

#include "numeric/motion/elliptic_rotation.hpp"
#include "numeric/motion/motion_state.hpp"
#include "numeric/motion/rotation.hpp"
#include "numeric/motion/steady_precession.hpp"

namespace clatter::numeric {

/// Solution of I ω̇′ + ω′ × I ω′ = 0 with β̇ = ½ β ω′ from the given start.
/// Elementary for rotation about a principal axis and for a body with two equal principal moments, in Jacobi's
/// elliptic functions and an elliptic integral of the third kind otherwise.
/// Accuracy: a few eps times the number of radians turned, in units of 1 and of |ω|.
class FreeRotation {
 public:
  /// `inertia` about the centre of mass, body frame, symmetric positive definite, principal moments satisfying the
  /// triangle inequality up to rounding [kg·m²].
  /// @throws std::domain_error if it is not, or a number is not finite, or the attitude is zero.
  FreeRotation(const Matrix3& inertia, const Rotation& start);

  /// The rotation after `time` [s], of either sign.  No allocation.  Beyond 2⁵³ turns the phase has no digit
  /// left, but the attitude is still unit and the energy right.
  /// @throws std::domain_error if `time` is not a number.
  [[nodiscard]] Rotation at(double time) const;

  /// Bounds over all times, from energy and momentum: |ω| [rad/s] and |ω̇| [rad/s²].
  [[nodiscard]] double largest_speed() const;
  [[nodiscard]] double largest_acceleration() const;

 private:
  double rate_;  ///< power of two by which times are multiplied and velocities divided [1/s]
  std::variant<SteadyPrecession, EllipticRotation> rotation_;
};

}  // namespace clatter::numeric
