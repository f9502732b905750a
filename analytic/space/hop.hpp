// SPDX-License-Identifier: GPL-3.0-or-later
// Height of a point that has just left the ground, as a series in time.
#pragma once

#include <array>
#include <optional>

#include "analytic/space/first_contact.hpp"

namespace clatter::analytic::space {

/// h(t) = t (u + t C(t)), with C from the Taylor series of e = Aᵀ z and ω at t = 0 (Euler's equations), so that a hop
/// keeps its relative accuracy however small its speed u beside V_z.
/// Domain: |ω| t <= 0.1, where 16 terms leave a few ulp.
class Hop {
 public:
  static constexpr double largest_turn = 0.1;  ///< [rad]

  /// Of the point at `place` (body frame), which leaves with the normal velocity `speed`.
  Hop(const Body& body, const FreeFlight& flight, const Vector3& place, double speed);

  struct Value {
    double quotient = 0;  ///< h/t [m/s]
    double slope = 0;     ///< its derivative [m/s²]
  };
  [[nodiscard]] Value at(double time) const;
  /// h′ [m/s].
  [[nodiscard]] double velocity(double time) const;

 private:
  static constexpr std::size_t terms = 16;
  double speed_;
  std::array<double, terms> bends_{};  ///< of C
};

/// The place whose height is that of the touching point during a hop: a vertex; the centre of a level rim that stays
/// level, since the body turns about the vertical alone.  The lowest point of another rim is at no one place.
[[nodiscard]] std::optional<Vector3> hopping_place(const Body& body, const FreeFlight& flight, int point);

}  // namespace clatter::analytic::space
