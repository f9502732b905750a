// SPDX-License-Identifier: GPL-3.0-or-later
// Where an event, or the largest force, lies within a step of a contact.
#pragma once

#include <functional>

#include "numeric/stepping/contact_result.hpp"
#include "numeric/stepping/stepper.hpp"

namespace clatter::numeric {

/// Events are roots of the numerical solution: the step is repeated with the length that ends on the event.
class EventLocator {
 public:
  explicit EventLocator(ContactStep& step) : step_(step) {}

  /// Events within steps of this tolerance.
  void begin(const ContactScales& scales, double tolerance) {
    scales_ = scales;
    tolerance_ = tolerance;
  }

  /// Length of the step from `now` at whose end `indicator` has just fallen to 0 [s].  `at_root`, given at the end of
  /// the whole step of length h, gets that instant; both stay where the indicator does not fall through 0.
  double fall(const std::function<double(const ContactInstant&)>& indicator, const ContactInstant& now, double h,
              ContactInstant& at_root);

  /// Length of the step from `now`, where F_n > high, at whose end F_n is from `low` to `high` [N]; `at_end` gets that
  /// instant.  Both stay where the search finds none.  For a step at whose end F_n is less than `low`.
  double fade(double low, double high, const ContactInstant& now, double h, ContactInstant& at_end);

  /// Length of the step from `now` at whose end the deepest vertex is just out of the ground, by Newton's method in
  /// a bracket; `at_root` as for fall().
  double lift_off(const ContactInstant& now, double h, ContactInstant& at_root);

 private:
  ContactStep& step_;
  ContactScales scales_;
  double tolerance_ = 0;
  ContactInstant trial_;
};

class ForcePeak {
 public:
  explicit ForcePeak(ContactStep& step) : step_(step) {}

  void begin(double force = 0) {
    force_ = force;
    time_ = 0;
  }

  /// Looks for a larger force in the accepted step from `now` to `next`: at its end, and at a maximum of F_n inside it.
  /// The peak of the cubic through the forces and their rates at both ends gives its time, which a secant of the rate
  /// then mends once; the force is that of the numerical solution there, and its error of second order in the time's.
  /// @return the instant of the largest force so far if that lies inside the step, else null.
  [[nodiscard]] const ContactInstant* look(const ContactInstant& now, const ContactInstant& next);

  [[nodiscard]] double force() const { return force_; }  ///< largest F_n so far [N]
  [[nodiscard]] double time() const { return time_; }    ///< of that, after touch-down [s]

 private:
  void note(const ContactInstant& at);

  ContactStep& step_;
  ContactInstant trial_, inside_;
  double force_ = 0, time_ = 0;
};

/// The largest depth of a vertex below the ground.
class DeepestPoint {
 public:
  explicit DeepestPoint(ContactStep& step) : step_(step) {}

  void begin(double depth = 0) { depth_ = depth; }

  /// Looks for a larger depth in the accepted step from `now` to `next`: at its end, and at a maximum inside it, which
  /// the cubic through the depths and their rates at both ends places.  The depth of the numerical solution there is
  /// carried on to the maximum by the parabola of its rate, so that its error is of third order in the time's.
  void look(const ContactInstant& now, const ContactInstant& next);

  [[nodiscard]] double depth() const { return depth_; }  ///< largest δ so far [m]

 private:
  ContactStep& step_;
  ContactInstant trial_;
  double depth_ = 0;
};

}  // namespace clatter::numeric
