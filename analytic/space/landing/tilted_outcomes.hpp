// SPDX-License-Identifier: GPL-3.0-or-later
// What small tilts make of corners that strike the ground at once.
//
// A tilt however small makes the corners strike in some order, which can decide the outcome.  A tilt g (horizontal, one
// unit long, towards where corners lie higher) raises the corner at r by g·r, less that of the lowest.  In the limit of
// no tilt, in a time t that is scaled with it, the places r are fixed and between strikes
//     h_i(t) = h_i + v_i t,   the next to strike: the least h_i/(−v_i) of those that approach.            (1)
// The velocities v_i depend on the order of strikes alone.  So heights and times are linear in g as long as the order
// is the same: a sector of tilts g = (1 − s) g₀ + s g₁, 0 <= s <= 1, is known by the heights at its ends, and the
// corner that strikes next changes where two times are equal,
//     s = d₀/(d₀ + d₁),   d the differences of the two corners' times at the ends.                       (2)
// There the sector is split: every outcome is found with the sectors that it has.  Corners that touch the ground at the
// same time for all tilts of a sector, as those of a plastic landing or of a rattling edge in the end do, strike by the
// rules of strike_together(): the tilt does not say in which order.
//
// The tilts of a round end that lies level, whose outcomes vary continuously, are sampled.
#pragma once

#include <span>
#include <vector>

#include "analytic/space/landing/striking_body.hpp"

namespace clatter::analytic::space {

/// Directions of tilts, counter-clockwise from `from`.
struct TiltSector {
  double from = 0;   ///< [rad]
  double width = 0;  ///< [rad]
};

/// What the tilts of one or more sectors make of it.
struct TiltedOutcome {
  double tilt_direction = 0;        ///< of the middle of the widest sector: in which corners lie higher [rad]
  double share = 0;                 ///< of all directions of the tilt
  std::vector<TiltSector> sectors;  ///< that have it; of a level rim those around single directions
  GroupImpact impact;               ///< in the widest sector; is_whole: one corner alone struck
};

/// Largest less least of the outcomes, component by component, world frame.
struct OutcomeRange {
  Vector3 velocity = Vector3::Zero();          ///< of the centre of mass [m/s]
  Vector3 angular_velocity = Vector3::Zero();  ///< [rad/s]
  double energy_loss = 0;                      ///< [J]
};

struct OutcomeSet {
  std::vector<TiltedOutcome> outcomes;  ///< distinct to 1e-6 of the velocities, the largest share first
  /// Whether outcomes vary continuously with the direction of the tilt (level rim): `outcomes` are then those of single
  /// directions, and the spreads hold to 2e-3 of themselves.
  bool varies = false;
  /// Share of the directions whose strikes were not followed to their end: more of them than TiltEffort allows, or one
  /// that cannot be computed.
  double open_share = 0;
  /// Share of the directions with the outcome of strike_together(), which is a convention: 0 where no tilt gives it.
  double convention_share = 0;
  OutcomeRange range;
  double velocity_spread = 0;          ///< largest distance between two V, that of strike_together() included [m/s]
  double angular_velocity_spread = 0;  ///< the same for Ω [rad/s]

  [[nodiscard]] bool is_complete() const { return open_share <= 1e-9; }
};

/// At most so many strikes in all.
struct TiltEffort {
  std::size_t strikes = 10'000;
  /// Strikes among them with all of an edge or a face, which rubs: each takes as long as thirty of a corner.
  std::size_t rubs = 10'000;
};

/// Every outcome that small tilts in all directions give, but for those of sectors below 1e-9 rad: heights below 1e-9
/// of the body and approaches below 1e-10 of the first are none.  The widest sectors are followed first.
/// @throws as strike_together()
[[nodiscard]] OutcomeSet tilted_outcomes(const Body& body, const State& before, std::span<const Corner> touching,
                                         const ImpactLaw& law, const TiltEffort& most = {});

}  // namespace clatter::analytic::space
