// SPDX-License-Identifier: GPL-3.0-or-later
// How long the steps of a contact are.
#pragma once

#include <optional>

#include "numeric/stepping/contact_result.hpp"
#include "numeric/stepping/step_events.hpp"
#include "numeric/stepping/stepper.hpp"

namespace clatter::numeric {

struct StepSettings {
  double tolerance = 1e-10;  ///< of an adaptive method: local error <= tolerance × scale, per step
  double step_cap = 1;       ///< of an adaptive method: factor of the longest step and of the first one
  /// Length of the steps of a fixed-step method [s], at most a quarter of scales.time; 0: scales.time /
  /// steps_per_contact.
  double step = 0;
  double first_step = 0;  ///< length of the first fixed step [s], at most `step`; 0: as the others
  double steps_per_contact = 300;
};

/// Chooses the length of each step of a contact.  An adaptive method with an error estimate ε of order q, scaled by the
/// tolerance times the contact's scales, repeats steps with ε > 1, and goes on with h × 0.9 ε^(−1/q), within bounds.
class StepControl {
 public:
  explicit StepControl(ContactStep& step) : step_(step) {}

  /// For a contact of these scales, which ends at `evaluation_limit` evaluations of the system.
  void begin(const StepSettings& settings, const ContactScales& scales, long evaluation_limit);

  /// Steps from `now` until one is accurate enough and has stepped over no touch; `trial` gets its end.
  /// @return why there is none; nothing where there is one.
  [[nodiscard]] std::optional<ContactEnding> find(const ContactInstant& now, const TouchCounter& touches,
                                                  ContactInstant& trial);

  /// Length of the step found last [s].
  [[nodiscard]] double taken() const { return taken_; }
  /// Length of a fixed step [s]; 0: the method is adaptive.
  [[nodiscard]] double fixed() const { return fixed_; }

 private:
  void weigh_errors();
  [[nodiscard]] double error() const;
  [[nodiscard]] bool stepped_over(const ContactInstant& now, const TouchCounter& touches,
                                  const ContactInstant& trial) const;

  ContactStep& step_;
  StepSettings settings_;
  ContactScales scales_;
  ContactState weights_;  ///< of the components' errors: the error allowed per step
  long evaluation_limit_ = 0;
  double next_ = 0;  ///< length to try next [s]
  double taken_ = 0, fixed_ = 0;
};

}  // namespace clatter::numeric
