// SPDX-License-Identifier: GPL-3.0-or-later
// A run of the continuous model as a picture.
#pragma once

#include <vector>

#include "numeric/body/body.hpp"
#include "numeric/drop/history.hpp"
#include "validation/output/picture.hpp"
#include "validation/run/history_file.hpp"
#include "validation/simulate/simulation_report.hpp"

namespace clatter::validation {

/// Keeps of each sample from the first touch-down on what the picture shows: some 80 bytes.
class PictureHistory {
 public:
  explicit PictureHistory(const numeric::Body& body) : body_(body) {}
  void add(const numeric::HistorySample& sample);
  [[nodiscard]] const std::vector<std::vector<double>>& rows() const { return rows_; }

 private:
  const numeric::Body& body_;
  std::vector<std::vector<double>> rows_;
};

/// Heights, contact force and energies over time, as far as the window goes.
[[nodiscard]] Picture simulation_picture(const Scene& scene, const PictureHistory& history, const TimeWindow& window);

/// What each impact of each value left, the first six: normal velocity, angular velocity, impulse, energy loss.
[[nodiscard]] Picture sweep_picture(const Scene& scene, const std::vector<SweptRun>& runs);

}  // namespace clatter::validation
