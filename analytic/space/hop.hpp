// Height of a point that has just left the ground, as a series in time.
#pragma once

#include <array>

#include "analytic/space/first_contact.hpp"

namespace clatter::analytic::space {

/// h(t) = t (u + t C(t)), with C from the Taylor series of e = Aᵀ z and ω at t = 0 (Euler's equations), so that a hop
/// keeps its relative accuracy however small its speed u beside V_z.
/// Domain: |ω| t <= 0.1, where 16 terms leave a few ulp.
class Hop {
 public:
  static constexpr double largest_turn = 0.1;  ///< [rad]

  Hop(const Body& body, const FreeFlight& flight, const Touch& touch);

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

}  // namespace clatter::analytic::space
