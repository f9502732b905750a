// SPDX-License-Identifier: GPL-3.0-or-later
// Infinitely many impacts in a finite time: where they end.
#pragma once

#include <optional>
#include <vector>

#include "analytic/plane/body_motion.hpp"
#include "analytic/plane/impact_rows.hpp"

namespace clatter::analytic {

/// A face that slides while the ground gives it impulses.
struct SlidingFace {
  double mass = 1;    ///< [kg]
  double slip = 0;    ///< at the start [m/s]
  double normal = 0;  ///< sum of the normal impulses [N·s]
  double pull = 0;    ///< impulse of gravity along x meanwhile, in proportion to `normal` at every moment [N·s]
};
/// What friction gives it, and its slip at the end.
struct Slide {
  double impulse = 0;  ///< tangential [N·s]
  double slip = 0;     ///< [m/s]
};
/// By the law's friction, |impulse| <= μ `normal`, until slip stops; then it sticks if μ `normal` >= |`pull`|.
/// Nothing where slip against the pull turns round meanwhile and goes on: each impact then counts by itself.
[[nodiscard]] std::optional<Slide> slide(const ImpactLaw& law, const SlidingFace& face);

/// Whether friction cannot hold a body at rest against gravity along the ground.
[[nodiscard]] bool slides_down(const ImpactLaw& law, double gravity, double gravity_along);

/// Whether the ground can push on a face so that it stays level, when it has the tangential force `share` of the normal
/// one: the forces meet the centre of mass within the face.
[[nodiscard]] bool stays_level(const BodyMotion& motion, VertexSet face, double share);

/// Flat and upright bouncing: after an impact with rebound speed w of a body that does not turn and
/// that the next impacts leave so, flight times form a geometric series. Remaining time 2w/(g(1−e)),
/// normal impulse m (1+e) w/(1−e), tangential impulse by slide().
/// Nothing if the body turns, is elastic, has no gravity, or would be turned by friction.
[[nodiscard]] std::optional<Tail> bouncing_tail(const BodyMotion& motion, const ImpactLaw& law,
                                                const BodyMotion::Strike& last);

/// A level face without rebound, e = 0, whose two ends strike in turn at one instant: each impulse pushes the other end
/// down, by less than it came down before, so that the impulses that are left take all normal motion, −m V_n in sum,
/// and where the ends stick −m V_t.  With (b) of impact.hpp the other end gains, per impulse P_n/m,
///     1 + d_t d_t′/k², frictionless;   less B B′/C where both stick, |B|, |B′| <= μ C.
/// Nothing where that is not below zero, where no end approaches, or for another law or mode.
[[nodiscard]] std::optional<Tail> resting_tail(const BodyMotion& motion, const ImpactLaw& law,
                                               const BodyMotion::Strike& last);

/// Whether impacts by this law, however slow, take energy away in proportion to what there is.  Damped ground alone
/// does not, since e → 1 for slow contacts: bouncing on it lasts for ever, ever more slowly.
[[nodiscard]] bool may_accumulate(const ImpactLaw& law);

/// Accumulation::Event::damping_loss of an impact with this approach speed.
[[nodiscard]] double damping_loss(const ImpactLaw& law, double approach_speed);

/// Recognises an accumulation from the flight times and impulses of the impacts so far.
///
/// Near its end an accumulation of one vertex, or of the two of a face that rattles, is the same motion over and over
/// on a scale that shrinks.  Impacts whose vertices and modes repeat with a period are summed over each period; the
/// sums then shrink geometrically in the limit, Aitken's extrapolation gives their remainder, and what it changed last,
/// summed over the changes still to come, its error.  A rattling that never becomes periodic is followed until all that
/// remains is below the resolution of the sums that it would be added to.
///
/// On damped ground e → 1 for slow contacts, so that the ratio of a series that damping alone makes shrink goes to 1:
/// its sum is infinite.  There a series counts as geometric once friction is what makes it shrink.
class Accumulation {
 public:
  struct Event {
    VertexSet vertices = 0;
    ImpactMode mode = ImpactMode::frictionless;
    double flight_time = 0;  ///< of the flight that led to this impact
    double normal_impulse = 0;
    double tangential_impulse = 0;
    double damping_loss = 0;  ///< 1 − e of damped ground, which falls with the speed; 0 for a constant e
  };
  void add(const Event& event) { events_.push_back(event); }

  /// How well the remaining time and impulse must be known: relatively, or to the resolution that
  /// double precision leaves in the sums that they are added to.
  struct Tolerance {
    double relative = 0;
    double time = 0;     ///< [s]
    double impulse = 0;  ///< [N·s]
  };
  /// The tail, if it is known to the tolerance.  Its end_time counts from the last event.
  [[nodiscard]] std::optional<Tail> extrapolate(const Tolerance& tolerance) const;

 private:
  [[nodiscard]] bool repeats(int period) const;
  [[nodiscard]] double block(int period, int index, double Event::*quantity) const;
  [[nodiscard]] VertexSet vertices(int last) const;
  [[nodiscard]] std::optional<Tail> periodic(int period, const Tolerance& tolerance) const;
  [[nodiscard]] std::optional<Tail> vanishing(const Tolerance& tolerance) const;

  std::vector<Event> events_;
};

/// State at the end of an extrapolated tail, from the state after the last impact: a single vertex stays on the ground
/// while the body turns about it; with two, the face rests.
/// Errors: those of the impulses, and of the vertex's way during the tail.
/// @param mode  of the last impact: a face that sticks each time ends at rest
void end_state(const BodyMotion& motion, ImpactMode mode, Tail& tail);

/// Whether slip during the tail goes on as in the impacts that it was extrapolated from: it sticks each time, or is far
/// from changing its direction.
[[nodiscard]] bool keeps_its_mode(const BodyMotion& motion, const Tail& tail, ImpactMode mode);

}  // namespace clatter::analytic
