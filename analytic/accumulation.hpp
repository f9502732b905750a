// Infinitely many impacts in a finite time: where they end.
#pragma once

#include <optional>
#include <vector>

#include "analytic/body_motion.hpp"
#include "analytic/sequence.hpp"

namespace clatter::analytic {

/// Flat and upright bouncing: after an impact with rebound speed w of a body that does not turn and
/// that the next impacts leave so, flight times form a geometric series. Remaining time 2w/(g(1−e)),
/// normal impulse m (1+e) w/(1−e), tangential impulse by the friction law until slip stops.
/// Nothing if the body turns, is elastic, has no gravity, or would be turned by friction.
[[nodiscard]] std::optional<Tail> bouncing_tail(const BodyMotion& motion, const ImpactLaw& law,
                                                double gravity, const BodyMotion::Strike& last);

/// Recognises an accumulation from the flight times and impulses of the impacts so far.
///
/// Impacts whose vertices repeat with a period of 1 to 4 are summed over each period; if the sums
/// shrink geometrically, Aitken's extrapolation gives their limit, and its last change the error.
class Accumulation {
 public:
  struct Event {
    VertexSet vertices = 0;
    double flight_time = 0;  ///< of the flight that led to this impact
    double normal_impulse = 0;
    double tangential_impulse = 0;
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

  std::vector<Event> events_;
};

}  // namespace clatter::analytic
