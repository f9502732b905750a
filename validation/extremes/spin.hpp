// SPDX-License-Identifier: GPL-3.0-or-later
// Torque-free rotation over very many turns, from one turn integrated in extended precision.
#pragma once

#include <array>

#include "numeric/motion/motion_state.hpp"
#include "validation/oracles/free_top.hpp"

namespace clatter::validation::inline extremes {

/// A freely turning body whose momentum is not along an axis of inertia.
///
/// Its angular velocity is periodic, and over each period T the attitude turns about the fixed momentum by the same
/// angle ψ.  One period, integrated by Taylor series in long double, gives T and ψ to about 1e-18, and with them the
/// attitude after any number of periods.  Nothing of the models' code is used.
class PeriodicSpin {
 public:
  /// `moments` along the body's axes, `angular_velocity` with no component along axis 2 and some along 1 and 3.
  PeriodicSpin(const std::array<double, 3>& moments, const std::array<double, 3>& angular_velocity);

  [[nodiscard]] long double period() const { return period_; }
  /// Largest difference of a component of the attitude's Euler parameters and of ω/|ω| from the exact ones at `time`.
  [[nodiscard]] double error(const numeric::Rotation& rotation, double time) const;

 private:
  using Top = oracle::Top<long double>;
  [[nodiscard]] Top advance(Top top, long double time) const;
  void find_period();
  void find_angle();

  Top start_;
  std::array<long double, 3> axis_{};  ///< of the momentum, world
  long double longest_step_ = 0, period_ = 0, angle_ = 0;
};

}  // namespace clatter::validation::inline extremes
