// SPDX-License-Identifier: GPL-3.0-or-later
// Where an event lies within a step of a contact.
#pragma once

#include <functional>

#include "numeric/stepping/contact_scales.hpp"
#include "numeric/stepping/contact_step.hpp"

namespace clatter::numeric {

/// Events are roots of the numerical solution: the step is repeated with the length that ends on the event.
class EventLocator {
 public:
  explicit EventLocator(ContactStep& step) : step_(step) {}

  void begin(const ContactScales& scales) { scales_ = scales; }

  /// Length of the step from `now` at whose end `indicator` has just fallen to 0 [s].  `at_root`, given at the end of
  /// the whole step of length h, gets that instant; both stay where the indicator does not fall through 0.
  double fall(const std::function<double(const ContactInstant&)>& indicator, const ContactInstant& now, double h,
              ContactInstant& at_root);

  /// The same where the deepest vertex is just out of the ground, by Newton's method in a bracket.
  double lift_off(const ContactInstant& now, double h, ContactInstant& at_root);

 private:
  ContactStep& step_;
  ContactScales scales_;
  ContactInstant trial_;
};

}  // namespace clatter::numeric
