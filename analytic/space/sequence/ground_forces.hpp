// SPDX-License-Identifier: GPL-3.0-or-later
// Forces of the ground on one or two corners that stay on it.
//
// With f_i the force on the corner at r_i from the centre of mass, W_ij = 1/m − [r_i]× I⁻¹ [r_j]× and
//     a_i⁰ = −g ẑ + [I⁻¹ (Iω × ω)] × r_i + ω × (ω × r_i),
// the corners accelerate with
//     a_i = a_i⁰ + Σ_j W_ij f_j.                                                                        (1)
// A corner that sticks has a_i = 0.  One that slips in direction s_i has a_i·ẑ = 0 and f_i = N_i (ẑ − μ s_i).  That
// gives the forces, but for the part along an edge both corners of which stick: there only its sum is known.
// Slip has one solution if the normal inverse inertias G_ij = ẑ·W_ij (ẑ − μ s_j) are a P-matrix.
#pragma once

#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "analytic/space/sequence/impact_rows.hpp"

namespace clatter::analytic::space {

/// A vertex on the ground.
struct GroundPoint {
  int index = 0;
  Vector3 place;  ///< Corner::place
  bool sticks = false;
  bool begins = false;  ///< to slip: its velocity does not say yet in which direction
  bool across = false;  ///< to slip across its edge, as the other corner does
  double angle = 0;     ///< of its slip, or next to it, from the x axis [rad]
};

/// Forces and accelerations at a moment.
struct GroundForces {
  std::vector<Vector3> of_points;      ///< f_i [N]
  Vector3 turning;                     ///< ω̇ [rad/s²]
  std::vector<Vector3> accelerations;  ///< of the corners [m/s²]
  bool is_unique = true;               ///< G is a P-matrix
};

/// The forces on a body of its drop.
class GroundLaw {
 public:
  explicit GroundLaw(const Drop& drop);

  [[nodiscard]] double friction() const { return friction_; }
  /// By (1).
  [[nodiscard]] GroundForces forces(const State& s, std::span<const GroundPoint> points) const;
  /// The state after impulses that stop the corners' normal velocity, without friction, and all of that of corners that
  /// stick: of the velocities possible thereafter those nearest in the metric of the kinetic energy.
  [[nodiscard]] State stopped(State s, std::span<const GroundPoint> points) const;
  /// μN − |f_t| of a corner that sticks; of an edge both corners of which do, what friction along it has left [N].
  [[nodiscard]] double friction_left(const State& s, std::span<const GroundPoint> points, const GroundForces& f) const;

  /// What friction has to do at a corner of an edge both corners of which stick.
  struct EdgeLoad {
    Vector3 along, across;     ///< unit vector of the edge; the friction across it [N]
    double limit, left, room;  ///< μN, that less the friction across, most friction along beside it [N]
  };
  [[nodiscard]] std::array<EdgeLoad, 2> edge_loads(const State& s, std::span<const GroundPoint> points,
                                                   const GroundForces& f) const;

 private:
  /// The corners of a body and what forces on them do, W.
  struct Arms;
  [[nodiscard]] Arms arms(const State& s, std::span<const GroundPoint> points) const;

  const Drop& drop_;
  double friction_;
  Matrix3 inverse_inertia_;
};

/// Its part along the ground.
[[nodiscard]] inline Vector3 horizontal(const Vector3& v) { return {v.x(), v.y(), 0}; }

/// The unit vector along the ground in this direction.
[[nodiscard]] inline Vector3 slip_at(double angle) { return {std::cos(angle), std::sin(angle), 0}; }

/// From the first corner to the second, along the ground [m].
[[nodiscard]] Vector3 edge_of(const State& s, std::span<const GroundPoint> points);

/// Velocity of the corner along the ground [m/s].
[[nodiscard]] Vector3 slip_of(const State& s, const GroundPoint& point);

// The numbers in which a body moves some corners of which stay on the ground.

/// Attitude (w, x, y, z), angular velocity, horizontal velocity and place of the first corner on the ground.
using GroundMotion = Eigen::Matrix<double, 11, 1>;

/// The velocity of the first corner along the ground.
[[nodiscard]] inline auto slip_in(GroundMotion& y) { return y.segment<2>(7); }
[[nodiscard]] inline Vector3 slip_in(const GroundMotion& y) { return {y[7], y[8], 0}; }

[[nodiscard]] State state_of(const GroundMotion& y, std::span<const GroundPoint> points);

/// Their rate of change under these forces; that of a first corner that sticks is zero.
[[nodiscard]] GroundMotion rate_of(const GroundMotion& y, std::span<const GroundPoint> points, const GroundForces& f);

/// Velocity of a corner along the ground: that of the first to its last digit, however small [m/s].
[[nodiscard]] Vector3 slip_of(const GroundMotion& y, std::span<const GroundPoint> points, const GroundPoint& point);

/// The sizes by which changes are judged.
struct MotionScale {
  double reach;  ///< [m]
  double speed;  ///< [m/s]

  /// The largest of the changes of attitude and velocities, each over its size; the place of the corner decides
  /// nothing.
  [[nodiscard]] double largest(const GroundMotion& change) const;
};

}  // namespace clatter::analytic::space
