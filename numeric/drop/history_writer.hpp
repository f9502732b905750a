// SPDX-License-Identifier: GPL-3.0-or-later
// Turns instants of contacts and flights into history samples.
#pragma once

#include "numeric/drop/history.hpp"
#include "numeric/motion/free_flight.hpp"
#include "numeric/stepping/contact_run.hpp"

namespace clatter::numeric {

class HistoryWriter {
 public:
  /// `recorder` may be null: then nothing is done.
  HistoryWriter(const Body& body, double gravity, HistoryRecorder* recorder)
      : body_(body), gravity_(gravity), recorder_(recorder) {}

  /// An instant of the contact that began at `start` [s].
  void contact(const ContactSystem& system, const ContactInstant& at, double start);
  /// Points of the flight that began at `start` and lasts `duration` [s], its ends left to the contacts.
  void flight(const FreeFlight& flight, double start, double duration);

 private:
  [[nodiscard]] HistorySample sample(double time, const MotionState& state) const;

  const Body& body_;
  double gravity_;
  HistoryRecorder* recorder_;
};

}  // namespace clatter::numeric
