// SPDX-License-Identifier: GPL-3.0-or-later
// What `clatter simulate` says, and its pictures.
#pragma once

#include <vector>

#include "numeric/body/body.hpp"
#include "numeric/drop/history.hpp"
#include "validation/output/picture.hpp"
#include "validation/output/report.hpp"
#include "validation/plan/planned_run.hpp"
#include "validation/run/history_file.hpp"
#include "validation/scene/scene.hpp"

namespace clatter::validation {

[[nodiscard]] std::vector<Column> simulation_columns();
/// A row for each impact.
[[nodiscard]] Report simulation_report(const Scene& scene, const PlannedRun& planned);

/// A sweep: the scene with its value and its run, one after the other.
struct SweptRun {
  double value;
  Scene scene;
  PlannedRun planned;
};
/// A row for each impact of each run, with the swept value in the first column; in tables the first impacts alone.
[[nodiscard]] Report sweep_report(const Scene& scene, const std::vector<SweptRun>& runs);

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
