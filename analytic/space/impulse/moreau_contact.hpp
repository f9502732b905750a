// SPDX-License-Identifier: GPL-3.0-or-later
// The impulse of one corner with friction judged by the slip after the impact.
#pragma once

#include <optional>

#include "analytic/space/impulse/contact_impulse.hpp"

namespace clatter::analytic::space {

/// Newton's restitution and Coulomb's cone for the velocity after the impact,
///     v′ = v + W P,   v′_n = −e v_n,   |P_t| <= μ P_n,   P_t = −μ P_n s,  s = v′_t/|v′_t|,  where v′_t ≠ 0.     (1)
/// Source: J. J. Moreau, Unilateral contact and dry friction in finite freedom dynamics (1988), without tangential
/// restitution.  On the plane v′_n = −e v_n P_n = (r − k·P_t)/W_nn and v′_t = q + M P_t are linear in P_t, with r =
/// −(1+e) v_n and k = W_nt.  The corner sticks if P_t = −M⁻¹q lies in the cone; otherwise the direction s solves
///     (W_nn − μ k·s)(s × q) = μ r (s × M s),                                                                      (2)
/// a polynomial of fourth degree in exp(iθ), with W_nn > μ k·s and s·(q − μ P_n M s) >= 0.
class MoreauContact {
 public:
  /// @param is_face  whether friction leaves the normal motion alone, k = 0
  MoreauContact(const Contact& contact, bool is_face, double friction, double restitution);

  /// Where several directions solve (2), as can be for μ k near W_nn, that which leaves the least energy, as an
  /// ambiguous path.  Accuracy: rounding of W and v times the condition of (2).
  /// @throws NumericalError where none does in double precision.
  [[nodiscard]] ContactImpulse impulse() const;
  /// From (1), linearised about `result`, which impulse() gave.
  void derive(const ContactImpulse& result, ImpulseSlopes& slopes) const;

 private:
  struct Slip {
    Vector3 impulse;
    Vector2 after;
  };
  [[nodiscard]] std::optional<Slip> slip_along(double angle) const;
  [[nodiscard]] double refined(double angle) const;
  [[nodiscard]] ContactImpulse result_of(const Vector3& impulse, const Vector2& slip, PathKind path) const;

  const Contact& contact_;
  double friction_, restitution_;
  double rise_;       ///< r
  Vector2 coupling_;  ///< k
  Vector2 q_;         ///< v′_t without friction
  Matrix2 m_;         ///< M
};

}  // namespace clatter::analytic::space
