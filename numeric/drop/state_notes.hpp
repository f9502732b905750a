// SPDX-License-Identifier: GPL-3.0-or-later
// The states of a run at the times that were asked for.
#pragma once

#include <limits>
#include <utility>
#include <vector>

#include "numeric/drop/error_growth.hpp"
#include "numeric/drop/impact_record.hpp"
#include "numeric/drop/state_record.hpp"

namespace clatter::numeric {

/// Takes the states of a run, flight by flight and contact by contact, in the order of time.  `growth` is null where
/// amplification is not asked for.
class StateNotes {
 public:
  StateNotes(const Body& body, const Gravity& gravity, bool planar, const std::vector<double>& times);

  [[nodiscard]] bool are_complete() const { return next_ == records_.size(); }
  /// Whether one was asked for before `time`, of which nothing is known.
  [[nodiscard]] bool begin_before(double time) const { return !are_complete() && records_[next_].time < time; }
  /// A flight that began at `origin` and lasts `duration` [s], its end left out; `growth` is that until its beginning.
  void flight(const FreeFlight& flight, double origin, double duration, const ErrorGrowth* growth);
  /// A contact that begins at `origin`; `times` gets those that are left, from there on.
  void open_contact(double origin, const ErrorGrowth* growth, std::vector<double>& times);
  /// An instant of it, null where it is not known.
  void contact(const ContactSystem& system, const ContactInstant* at);
  /// The contact has ended with this amplification.
  void close_contact(double amplification);
  /// The contact that is open cannot be told from rounding.
  void forget_contact();
  /// All that is left, of a motion on the ground that began at `origin`.
  void ground(const GroundMotion& motion, double origin);
  /// The same of a body that lay on the ground like that from the beginning, without an impact.
  void ground_from_the_start(const GroundMotion& motion);

  [[nodiscard]] std::vector<StateRecord> take() { return std::move(records_); }

 private:
  StateRecord& note(const MotionState& state);

  const Body& body_;
  Gravity gravity_;
  bool planar_;
  std::vector<StateRecord> records_;
  std::size_t next_ = 0, opened_ = 0;  ///< record to fill next, and the first of the open contact
  int impacts_ = 0;
  double amplification_ = std::numeric_limits<double>::quiet_NaN();
};

}  // namespace clatter::numeric
