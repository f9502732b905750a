// SPDX-License-Identifier: GPL-3.0-or-later
// A run of the continuous model as a picture.
#pragma once

#include <vector>

#include "numeric/body.hpp"
#include "numeric/drop/history.hpp"
#include "validation/output/picture.hpp"
#include "validation/run/time_window.hpp"
#include "validation/simulate/simulation_report.hpp"

namespace clatter::validation {

/// Keeps of each sample from the first touch-down on what the picture shows: some 80 bytes.
class PictureHistory : public numeric::HistoryRecorder {
 public:
  explicit PictureHistory(const numeric::Body& body) : body_(body) {}
  void record(const numeric::HistorySample& sample) override;
  [[nodiscard]] const std::vector<std::vector<double>>& rows() const { return rows_; }

 private:
  const numeric::Body& body_;
  std::vector<std::vector<double>> rows_;
};

/// Passes samples on to several recorders.
class HistoryFan : public numeric::HistoryRecorder {
 public:
  void add(numeric::HistoryRecorder& recorder) { recorders_.push_back(&recorder); }
  void record(const numeric::HistorySample& sample) override {
    for (numeric::HistoryRecorder* recorder : recorders_) recorder->record(sample);
  }
  [[nodiscard]] bool is_empty() const { return recorders_.empty(); }

 private:
  std::vector<numeric::HistoryRecorder*> recorders_;
};

/// Heights, contact force and energies over time, as far as the window goes.
[[nodiscard]] Picture simulation_picture(const Scene& scene, const PictureHistory& history, const TimeWindow& window);

/// What each impact of each value left, the first six: normal velocity, angular velocity, impulse, energy loss.
[[nodiscard]] Picture sweep_picture(const Scene& scene, const std::vector<SweptRun>& runs);

}  // namespace clatter::validation
