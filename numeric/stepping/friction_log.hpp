// SPDX-License-Identifier: GPL-3.0-or-later
// The phases of friction that a contact went through, and their common name.
#pragma once

#include <vector>

#include "numeric/contact/contact_system.hpp"
#include "numeric/stepping/contact_scales.hpp"
#include "numeric/stepping/friction_mode.hpp"

namespace clatter::numeric {

/// Notes the phases of slip and stick that mattered: slip by its work or its part of the normal impulse, stick by its
/// time.  (A sticking end slips for an instant when the force on it fades; such a phase names nothing.)
class FrictionLog {
 public:
  /// What has summed up since touch-down.
  struct Sums {
    double time = 0;     ///< [s]
    double work = 0;     ///< of friction [J]
    double impulse = 0;  ///< normal [N·s]
  };

  FrictionLog();
  void begin(const ContactScales& scales, double mass);
  void open(const Sums& sums) { start_ = sums; }
  /// Notes the phase that was opened last, if it mattered.
  void close(const FrictionPhase& phase, const Sums& sums);
  /// Of a contact with Coulomb friction.  Slip that turns back at once is reverse_slip, whatever else there is.
  [[nodiscard]] FrictionMode mode() const;

 private:
  struct Entry {
    FrictionPhase::Kind kind;
    AlongGround direction;  ///< of slip when it began
  };

  std::vector<Entry> entries_;  ///< neighbours differ in kind or in the direction of slip
  Sums start_;                  ///< of the current phase
  double least_work_ = 0, least_impulse_ = 0, least_time_ = 0;
};

}  // namespace clatter::numeric
