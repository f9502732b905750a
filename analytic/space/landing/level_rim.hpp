// SPDX-License-Identifier: GPL-3.0-or-later
// A round end that lands level: all of its rim touches at once.
//
// With x the horizontal offset from the rim's centre, |x| = ρ, the rim's points move up at
//     v(x) = w + a·x,   w = V_z + (ω × c)_z,   a = (−ω_y, ω_x),                                       (1)
// c from the centre of mass to the rim's centre.  The rules of simultaneous.hpp, in closed form for a circle:
//   as a whole   V_z, ω_x, ω_y → −e times themselves if the pressure point lies in the disc |x| <= ρ, and, should only
//                an arc approach (e = 0), on that arc's side of its chord, v(x) <= 0; where friction alone asks for
//                pushes outside the disc, they act at its rim, and the rest tilts the body (face_friction.hpp);
//   otherwise    the point of the rim that approaches fastest, x = −ρ a/|a|, strikes as a corner, then the one that is
//                fastest thereafter, until none approaches.  Where all are equally fast to rounding and pushes alone
//                cannot turn them back, the one nearest to the pressure point strikes.
//
// A small tilt raises x by H + g·x.  The lowest point, x = −ρ g/|g|, strikes; in the time t scaled with the tilt the
// rim touches again where
//     H + w t = ρ |g + a t|,   H = ρ |g|   =>   t = 2 H (w − ρ g·a/|g|)/(ρ² a² − w²), if that is > 0.  (2)
// Rebounds that have become slower than 1e-4 of the first approach accumulate: the rim then rolls, its lowest point
// struck without rebound at every 0.02 rad, until no other point would touch.
#pragma once

#include <span>

#include "analytic/space/landing/striking_body.hpp"

namespace clatter::analytic::space {

/// The level rim among the touching corners, or null.
/// @throws std::domain_error if it touches together with another corner
[[nodiscard]] const Corner* level_rim(std::span<const Corner> touching);

class LevelRim {
 public:
  /// All but `rim` must outlive this.
  LevelRim(const Body& body, const State& before, const Corner& rim, const ImpactLaw& law);

  /// As rebound_as_a_whole().
  [[nodiscard]] std::optional<GroupImpact> rebound_as_a_whole() const;
  /// As strike_together().
  [[nodiscard]] GroupImpact strike() const;
  /// The impact that a small tilt gives.
  /// @param direction  in which points lie higher [rad]
  [[nodiscard]] GroupImpact tilted(double direction) const;
  /// Largest distance of a point of the rim from the centre of mass [m].
  [[nodiscard]] double reach() const { return std::hypot(arm_.head<2>().norm() + radius_, arm_.z()); }

 private:
  /// w and a of (1).
  struct Motion {
    double rise;
    Vector2 slope;
    [[nodiscard]] double at(const Vector2& x) const { return rise + slope.dot(x); }
  };
  [[nodiscard]] Motion motion() const;
  [[nodiscard]] double slowest_rise(const Motion& m) const { return m.rise - radius_ * m.slope.norm(); }
  [[nodiscard]] bool whole();
  void one_after_the_other();
  void strike_at(const Vector2& x, const ImpactLaw& law);
  [[nodiscard]] bool touches_again(Vector2& tilt) const;
  enum class Rolling { ends, goes_on, falls_flat };
  [[nodiscard]] Rolling roll(Vector2& tilt) const;

  StrikingBody struck_;
  int index_;
  double radius_;
  Vector3 arm_;
  double rounding_;
};

/// A state in which the rim lies level to rounding, with that rounding taken away: the rim level to an ulp, and no turn
/// about horizontal axes that is rounding of the spin.  Otherwise rounding would grow from bounce to bounce.
[[nodiscard]] State levelled(const Body& body, const State& state, const Corner& rim);

}  // namespace clatter::analytic::space
