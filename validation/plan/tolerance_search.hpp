// SPDX-License-Identifier: GPL-3.0-or-later
// The loosest tolerance of a continuous level that keeps to an error.
#pragma once

#include <vector>

#include "validation/plan/model_hierarchy.hpp"

namespace clatter::validation {

/// Tolerances are tried by half decades: 1e-4, 3e-5, … down to the smallest allowed.  Above 1e-4 a run is not cheaper:
/// events cost the most.
inline constexpr int tolerance_steps = 20;
[[nodiscard]] double half_decade(int index);

/// A method and tolerance that the measured table predicts to serve.
struct PredictedSetting {
  numeric::Method method = numeric::Method::rkck;
  int index = 0;           ///< of half_decade
  double evaluations = 0;  ///< over those of rkck at CostTable::pilot_tolerance
};
/// The loosest tolerance of a method whose predicted error is a third of `asked`, or the smallest tolerance.
/// @param error_constant of the scene: error over tolerance of rkck
[[nodiscard]] PredictedSetting predicted_setting(numeric::Method method, double error_constant, double asked);
/// The cheaper one of rkck and rk8pd.
[[nodiscard]] PredictedSetting cheapest_by_table(double error_constant, double asked);

struct FoundSetting {
  LevelSetting setting;
  double error = 0;  ///< against the reference, relative
  long evaluations = 0;
  bool serves = false;                   ///< error <= what was asked
  std::vector<MotionNumbers> reference;  ///< rows of the finest run
  std::vector<double> errors;            ///< of each row; where nothing serves, of the finest setting
};

/// Finds it by trial: the measured table says where to begin, runs against a finer one where to stop.
class ToleranceSearch {
 public:
  /// @param error_constant error over tolerance of rkck
  /// @param pilot_evaluations of rkck at CostTable::pilot_tolerance
  ToleranceSearch(const ModelHierarchy& hierarchy, ModelLevel level, int impacts, const MotionNumbers& sizes,
                  double error_constant, double pilot_evaluations);

  /// The cheapest setting with error <= asked.
  [[nodiscard]] FoundSetting cheapest(double asked);
  [[nodiscard]] long evaluations_spent() const { return spent_; }

 private:
  struct Trial {
    LevelResult result;
    double error = 0;
    std::vector<double> errors;
    bool known = false;
  };
  void find_reference(double asked, int index);
  Trial& trial(numeric::Method method, int index);
  void descend(const PredictedSetting& start, double asked, FoundSetting& best);
  void take(numeric::Method method, int index, double asked, FoundSetting& best);

  const ModelHierarchy& hierarchy_;
  ModelLevel level_;
  int impacts_;
  MotionNumbers sizes_;
  double error_constant_, pilot_evaluations_;
  std::vector<MotionNumbers> reference_;
  std::vector<double> reference_errors_;  ///< of each row, where no run is two decades finer than the trials
  Trial trials_[2][tolerance_steps];
  long spent_ = 0;
};

}  // namespace clatter::validation
