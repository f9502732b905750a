// SPDX-License-Identifier: GPL-3.0-or-later
// Infinitely many impacts of a body in space in a finite time: where they end.
#pragma once

#include <optional>
#include <vector>

#include "analytic/plane/accumulation.hpp"
#include "analytic/space/sequence/impact_rows.hpp"

namespace clatter::analytic::space {

/// Bouncing of a body that does not turn, or of a ball without slip or friction: after an impact with rebound speed w
/// that leaves the body so, flight times form a geometric series. Remaining time 2w/(g(1−e)), normal impulse m (1+e)
/// w/(1−e), tangential impulse by the friction law until slip stops.  Nothing if the body turns otherwise, is elastic,
/// has no gravity, or would be turned.
[[nodiscard]] std::optional<Tail> bouncing_tail(const Drop& drop, const ImpactRow& last);

/// Recognises accumulations of one corner, of an edge or of corners in turn, by accumulation.hpp: impacts whose corners
/// repeat with a period, summed over each period, shrink geometrically in the limit.
class SpaceAccumulation {
 public:
  /// @param damping_loss as in Accumulation::Event
  void add(const ImpactRow& row, double damping_loss);
  /// The tail, if it is known to the tolerance.  Its end_time counts from the last impact; tangential impulse and
  /// moment keep the ratio to the normal impulse that they had in the last period.
  [[nodiscard]] std::optional<Tail> extrapolate(const Accumulation::Tolerance& tolerance) const;
  /// Ratio of the moment about the centre of mass to the normal impulse over the last period, world frame [m].
  [[nodiscard]] Vector3 lever(const Tail& tail) const;

 private:
  struct Event {
    std::vector<int> corners;
    ImpactMode mode;
    double flight_time, damping_loss;
    Vector3 impulse, moment;
  };
  /// Impacts from the end backwards that involve at most eight corners, as many as accumulation.hpp tells apart.
  [[nodiscard]] std::size_t first_of_last_eight(std::vector<int>& labels) const;
  [[nodiscard]] std::optional<Tail> vanishing_hops(const Accumulation::Tolerance& tolerance) const;
  [[nodiscard]] std::size_t last_round(const Tail& tail) const;

  std::vector<Event> events_;
};

/// Impacts of corners that come down again and again beside others that stay on the ground: what lies between two of
/// them, contacts and hops, repeats with a period, and shrinks geometrically in the limit.  From three periods, the
/// last of duration T and change D of the state (attitude, V, ω), with the ratio r of the last two durations,
///     remaining time T r/(1 − r),   remaining change D r/(1 − r),                                          (1)
/// whose errors are twice what the period before would have had them otherwise, and of the attitude what the order of
/// turns changes, the square of the turn.
class Rattling {
 public:
  /// A corner that has been on the ground since the last impact that was added, and strikes or stays.
  void touch(int corner);
  /// Beside corners that stay, those of `row` that come down have struck.
  void add(const ImpactRow& row);
  void forget() { rounds_.clear(), touched_.clear(); }

  struct Tolerance {
    double relative;    ///< of the remaining time
    double resolution;  ///< rounding of heights [m]
  };
  /// The tail, if it is known to the tolerance, or as well as the next durations are: these err by the resolution over
  /// the approach speed.  Its end_time counts from the last impact.
  [[nodiscard]] std::optional<Tail> extrapolate(const Drop& drop, const Tolerance& tolerance) const;

 private:
  struct Round {
    std::vector<int> arrived, touched;  ///< ascending
    double time, approach_speed;
    State after;
  };
  [[nodiscard]] bool repeats(std::size_t period) const;
  [[nodiscard]] std::optional<Tail> extrapolate(const Drop& drop, const Tolerance& tolerance, std::size_t period) const;

  std::vector<Round> rounds_;
  std::vector<int> touched_;  ///< since the last round
};

/// Whether no other point reaches the ground before twice the remaining time has passed, whatever the impulses to come
/// do.
/// @param now the state after the last impact
[[nodiscard]] bool undisturbed(const Drop& drop, const State& now, const Tail& tail);

/// Velocities at the end of an extrapolated tail, whose end_time counts from the last impact, from those after it: at
/// rest but for sliding and spinning about the vertical with three corners or more, otherwise the corners stay on the
/// ground while the body turns.
void end_state(const Drop& drop, const ImpactRow& last, const Vector3& lever, Tail& tail);

/// Whether slip during the tail goes on as it was: the corner sticks each time, or slips far too fast to stop.
[[nodiscard]] bool keeps_slipping(const Drop& drop, const ImpactRow& last, const Tail& tail);

/// Adds to the errors of an extrapolated end those of the impact that it is extrapolated from.
/// @param tail  end_time since the first impact
void add_errors(const Drop& drop, const ImpactRow& last, Tail& tail);

/// Bounds on the errors of a state at which corners stay on the ground, from those of an earlier one since which
/// nothing else can have reached the ground, but the order of impacts is open: those, and four times what has happened
/// since.
/// @param since  time and impulses since then
[[nodiscard]] StateErrors errors_since(const Drop& drop, const State& known, const StateErrors& errors,
                                       const Tail& since);

}  // namespace clatter::analytic::space
