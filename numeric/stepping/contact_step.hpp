// SPDX-License-Identifier: GPL-3.0-or-later
// One step of a contact, and its ends.
#pragma once

#include <vector>

#include "numeric/stepping/stepper.hpp"

namespace clatter::numeric {

/// An instant of a contact.
struct ContactInstant {
  double time = 0;  ///< after touch-down [s]
  ContactState state = ContactState::Zero(), rate = ContactState::Zero();
  ContactDiagnosis diagnosis;
};

/// Takes steps of a contact, trial steps too, and keeps what the last one left.
class ContactStep {
 public:
  ContactStep(ContactSystem& system, Stepper& stepper);

  /// A step of length h [s] from `from` to `to`; false if a number of it is not finite.  No allocation.
  [[nodiscard]] bool take(const ContactInstant& from, double h, ContactInstant& to);

  /// Estimate of the last step's local error.
  [[nodiscard]] const ContactState& error() const { return error_; }
  /// Vertices below the ground at the end of the last step, repetitions allowed.
  [[nodiscard]] const std::vector<int>& submerged() const { return submerged_; }
  /// Order of the error estimate in h; 0: the method has a fixed step.
  [[nodiscard]] int error_order() const { return stepper_.error_order(); }
  [[nodiscard]] const ContactSystem& system() const { return system_; }

 private:
  ContactSystem& system_;
  Stepper& stepper_;
  ContactState error_;
  std::vector<int> submerged_;
};

}  // namespace clatter::numeric
