// SPDX-License-Identifier: GPL-3.0-or-later
// Three or more contacts in space, in the limit of a flat landing: a billiard in a cone of the mass metric.
//
// Without gravity and friction and in the limit of no tilt, the corners at r_i have heights and normal velocities
//     h_i = z + r_i·q,   v_i = V + r_i·w,                                                                     (1)
// w the rate of the slope q.  A strike at corner i, the earliest that reaches h_i = 0 with v_i < 0, gives
//     P = (1 + e)(−v_i)/G_ii m,   v_j += G_ij P/m,   G_ij = 1 + r_i·N r_j,                                      (2)
// N the mobility.  All v_i begin as −|v|.  The approach u = −v_i/|v| of a strike depends on the order of the corners
// alone, and heights are linear in the tilt as long as the order is the same: directions of the tilt fall into sectors
// of one order and constant numbers, cut where two corners arrive at once, which is linear in the tilt.  All sectors
// are found by cutting them, none by sampling.
// Two at once: the second strike of a face's opposite corner, r_j = −r_i, has u = 1 + (1 + e)(λ − 1)/(λ + 1), with
// λ = r_i·N r_i; with e = 0 the corners beside it come before.  Source: the page "Close to flat" of the reference.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

namespace clatter::analytic::near_flat {

/// What touches the ground when the body lies flat on it.
struct Footprint {
  std::vector<Eigen::Vector2d> corners;  ///< at least two, from the point below the centre of mass [m]
  /// N [1/m²]: a vertical impulse P at r changes the rate of the slope by N r P/m.  For axes of symmetry x, y it is
  /// diag(m/I_y, m/I_x).
  Eigen::Matrix2d mobility = Eigen::Matrix2d::Identity();

  /// @throws std::domain_error naming the field, its value and what is allowed: 2 to 256 corners; N symmetric and
  ///         positive definite; all finite.
  void validate() const;
};

/// N from the inertia about the centre of mass, axes x and y of the footprint, z up.
[[nodiscard]] Eigen::Matrix2d slope_mobility(double mass, const Eigen::Matrix3d& inertia);

/// One strike.
struct CornerStrike {
  int corner = 0;       ///< into Footprint::corners
  double approach = 1;  ///< u: velocity change of the corner over that of the flat drop, (1 + e)|v|
  double impulse = 0;   ///< P/(m |v|)
};

/// Directions of the tilt in which the corners strike in one order.
struct TiltSector {
  double from = 0, to = 0;  ///< directions in which the body is higher, from < to <= from + 2π [rad]
  std::vector<CornerStrike> strikes;
  bool goes_on = false;  ///< not followed to its end

  [[nodiscard]] double share() const;  ///< of all directions
  /// The hardest strike: index into `strikes` of the largest approach, the first of equal ones.
  [[nodiscard]] std::size_t hardest() const;
};

struct TiltSectors {
  std::vector<TiltSector> sectors;  ///< counter-clockwise; neighbours differ
  double open_share = 0;            ///< of the directions, in sectors below 1e-9 rad: not followed
};

/// All sectors, each followed for at most `most` strikes, with 50 digits: numbers are exact to 1 ulp for the footprint
/// as given, and so is the order wherever two arrivals differ by more than 1e-40 of their time.  Beyond 100 000 strikes
/// in all the sectors that are left end as they are (`goes_on`).
/// With e = 0 corners that touch without a velocity and are pushed down strike in the order of their speed.
/// @throws std::domain_error as validate(); for a restitution outside [0, 1]
[[nodiscard]] TiltSectors tilt_sectors(const Footprint& footprint, double restitution, int most = 200);

/// Strikes of one direction of the tilt, at most `most`; the last one's end is none of all if they are as many.
[[nodiscard]] std::vector<CornerStrike> strikes_of_tilt(const Footprint& footprint, double restitution,
                                                        double direction, int most);

/// Restitution up to which tilts have infinitely many strikes, in no time.
struct CriticalRestitution {
  double restitution = 0;
  double error = 0;        ///< bound
  std::vector<int> cycle;  ///< corners that strike in turn for ever just below it
};

/// e_c of a footprint: the largest e for which a direction of the tilt, of 16, has strikes that go on, found on a grid
/// of 128 restitutions and refined.  A cycle of corners multiplies (V, w) by a matrix of e; the cycle contracts for
/// ever as long as its leading eigenvalue is real, and e_c is where two eigenvalues meet, a root of the discriminant,
/// which has an error of 1e-15.  Where the cycle ends for another reason the error is that of the bisection, 1e-4.
/// Nothing: no direction has infinitely many, at any e > 0 of the grid.
[[nodiscard]] std::optional<CriticalRestitution> critical_restitution(const Footprint& footprint);

}  // namespace clatter::analytic::near_flat
