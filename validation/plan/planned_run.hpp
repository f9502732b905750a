// SPDX-License-Identifier: GPL-3.0-or-later
// A run of the continuous model whose method and tolerance follow from the digits asked for.
#pragma once

#include <string>
#include <vector>

#include "validation/plan/model_hierarchy.hpp"
#include "validation/run/motion_numbers.hpp"
#include "validation/scene/scene.hpp"

namespace clatter::validation {

// The loosest tolerance of a continuous level that keeps to an error.

/// Tolerances are tried by half decades: 1e-4, 3e-5, … down to the smallest allowed.  Above 1e-4 a run is not cheaper:
/// events cost the most.
inline constexpr int tolerance_steps = 20;
[[nodiscard]] double half_decade(int index);

struct PredictedSetting;

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

struct PlannedRun {
  numeric::Simulation run;
  bool planned = false;  ///< method and tolerance were chosen here
  double asked = 0;      ///< relative error, 10^−digits
  /// Largest estimated error of the motion's numbers (MotionNumbers) over `known_impacts`, relative to the sequence's
  /// sizes; NaN: there is no estimate, infinite: a second run goes another way.
  double achieved = 0;
  /// The first impacts, before rounding errors have grown beyond what is asked, or a second run goes another way;
  /// without amplification, before estimated errors are more than asked.
  int known_impacts = 0;
  std::vector<std::string>
      warnings;        ///< of what the run leaves out although the scene has it, and of bodies that go deep
  std::string deep{};  ///< which of them says that the body goes deep, but not below the ground; empty: none
  std::optional<FirstTouch> first_touch{};  ///< of a drop with a release
  MotionNumbers sizes{};  ///< of all impacts, against which a number counts as zero; 0 without impacts
};

/// Runs the scene.  With `run.method = "auto"`, no step and no tolerance, two pilot runs with rkck (at 1e-4 and 1e-6)
/// give the scene's error constant, the measured table (CostTable) the cheapest method and tolerance for the digits;
/// if the estimated errors are then larger than asked, and a tolerance is allowed that would serve, the run is repeated
/// with a tighter one, at most thrice.
/// The count of evaluations includes all of these.  Otherwise as numeric::simulate, with what facets may add to the
/// errors (add_facet_errors()).
/// `observer.history` takes the last run only, by a repetition that does not count.
/// @param body  scene.make_body()
/// @throws as numeric::simulate.
[[nodiscard]] PlannedRun run_to_digits(const Scene& scene, const numeric::Body& body,
                                       const numeric::Observer& observer = {});

/// As shortfall() of a sequence.
[[nodiscard]] std::string shortfall(const Scene& scene, const PlannedRun& planned);

}  // namespace clatter::validation
