// SPDX-License-Identifier: GPL-3.0-or-later
// The largest normal force of a contact.
#pragma once

#include "numeric/stepping/contact_step.hpp"

namespace clatter::numeric {

class ForcePeak {
 public:
  explicit ForcePeak(ContactStep& step) : step_(step) {}

  void begin() { force_ = time_ = 0; }

  /// Looks for a larger force in the accepted step from `now` to `next`: at its end, and at a maximum of F_n inside it.
  /// That of the cubic through the forces and their rates at both ends gives its time, which a secant of the rate then
  /// mends once; the force is that of the numerical solution there, and its error of second order in the time's.
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

}  // namespace clatter::numeric
