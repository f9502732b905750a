// SPDX-License-Identifier: GPL-3.0-or-later
// The history of a drop at a uniform rate, from its dense solution.
#pragma once

#include <vector>

#include "numeric/body.hpp"
#include "validation/shock/shock_rows.hpp"

namespace clatter::validation {

/// One instant.  World frame unless it says otherwise.
struct HistoryInstant {
  double time = 0;   ///< after the first touch-down [s]
  int impact = 0;    ///< of a flight, that of the impact before it
  int peak_of = -1;  ///< a mark: the probe whose peak this is; -1: none
  bool in_contact = false;
  Vector3 force = Vector3::Zero();                 ///< of contact [N]
  Vector3 torque = Vector3::Zero();                ///< of that about the centre of mass [N·m]
  Vector3 angular_acceleration = Vector3::Zero();  ///< [rad/s²]
  /// Where the line of action of the force meets the ground [m]; NaN without a normal force.
  double action_x = 0, action_y = 0;
  double indentation = 0;                ///< of the deepest point, < 0 above the ground [m]
  double pressure = 0;                   ///< largest, (k_G + c_G δ̇) δ, of the body's points below the ground [Pa]
  std::vector<Vector3> specific_forces;  ///< of each probe, body axes [m/s²]
};

/// Largest (k_G + c_G δ̇) δ >= 0 over the body's points below the ground, each face with its full area: of a product of
/// two linear functions it lies on an edge, where it is a quadratic's.
[[nodiscard]] double largest_pressure(const numeric::Body& body, const numeric::MotionState& state,
                                      const numeric::Ground& ground);

/// From 0 to the end of the last piece by steps of 1/rate, and in between an instant for the peak of each row.  Pieces
/// are polynomials of degree 8 through the method's own steps.  Most instants: 10⁷.
/// @param rate  [Hz]
/// @throws std::domain_error if there were more.
[[nodiscard]] std::vector<HistoryInstant> uniform_history(const ContinuousShock& shock, const numeric::Body& body,
                                                          const numeric::Ground& ground,
                                                          const std::vector<Vector3>& places, double rate);

}  // namespace clatter::validation
