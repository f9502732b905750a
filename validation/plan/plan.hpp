// SPDX-License-Identifier: GPL-3.0-or-later
// The smallest model, and the loosest setting of it, that gives the digits asked for: `clatter plan`.
#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "validation/output/report.hpp"
#include "validation/plan/model_hierarchy.hpp"
#include "validation/scene/argument.hpp"

namespace clatter::validation {

/// What is asked for.
struct PlanTarget {
  /// The digits of every time, angle, impulse and velocity of every impact, relative to the sequence's sizes
  /// (motion_sizes): error <= 10^−digits.
  int digits = 6;
  /// The run may take this long [ms]; the most accurate that fits is chosen if the digits do not fit.
  std::optional<double> within_ms = std::nullopt;
  bool most_accurate = false;  ///< choose that in any case; needs within_ms
};

/// One level as it was weighed: how it would be run, what that costs and delivers.
struct WeighedLevel {
  ModelLevel level = ModelLevel::spatial;
  std::string against = {};  ///< why it does not apply; empty: it does
  LevelSetting setting = {};
  double error = std::numeric_limits<double>::quiet_NaN();  ///< relative; NaN: not known
  double evaluations = 0;                                   ///< of the contact force
  double seconds = 0;
  /// What the level's assumption brings, by the model's own account, relative; NaN: no account.
  double assumption_error = std::numeric_limits<double>::quiet_NaN();
  bool serves = false;
};

/// A part of the scene that could be left out.
struct WeighedPart {
  Part part = Part::friction;
  double error = 0;  ///< what leaving it out changes, relative; infinite: too much to be tried
  bool left_out = false;
};

struct Plan {
  PlanTarget target;
  double asked = 0;  ///< relative error
  Scene scene;       ///< without what is left out
  LevelSetting choice;
  bool serves = false;                                      ///< whether the choice is expected to meet what was asked
  double error = std::numeric_limits<double>::quiet_NaN();  ///< predicted, relative; NaN: nothing could be planned
  double evaluations = 0;
  double seconds = 0;
  /// The same of a continuous choice with the error estimates and the growth of errors that the scene asks for; 0: it
  /// asks for neither.
  double evaluations_with_estimates = 0, seconds_with_estimates = 0;
  /// What `clatter simulate` took, measured once, with all the runs by which it finds its own setting and errors.
  double simulate_seconds = 0;
  long simulate_evaluations = 0;
  int impacts = 0;              ///< that happen, at most as many as the scene asks for
  int known_impacts = 0;        ///< the first impacts, which can be had to what was asked by the full level
  int predictable_impacts = 0;  ///< those before which errors out of the plane have not outgrown what was asked
  double growth_out_of_plane = std::numeric_limits<double>::quiet_NaN();  ///< of a small error, until the last impact
  double error_constant = 0;  ///< error over tolerance of rkck, from the pilot runs
  std::vector<WeighedLevel> levels;
  std::vector<WeighedPart> parts;
  long planning_evaluations = 0;     ///< of all runs of the planning
  std::string pilot_ending;          ///< how the finest pilot run ended
  std::vector<SceneOverride> given;  ///< flags that changed the scene, for command_line()
  bool cut_short = false;            ///< because a number could not be computed or a limit was reached
};

/// Plans the scene.
///
/// Pilot runs of the full level with rkck at tolerances 1e-4, 1e-6 and 1e-8 give the impacts, the evaluations that they
/// take and the scene's error constant C (error over tolerance); with the measured table (CostTable) these give error
/// and evaluations of every method and tolerance.  The levels without contact times are run, which is cheap, and
/// compared with the pilot.  The setting of the continuous level is then checked against a finer run and moved by half
/// decades of the tolerance until its error lies just below what is asked.
/// Only counts decide, never times, unless `within_ms` is given: the plan is the same on every machine.
/// `observer` looks on the runs of the continuous model.
[[nodiscard]] Plan make_plan(const Scene& scene, const PlanTarget& target, const numeric::Observer& observer = {});

/// The command line that runs the plan's choice.
[[nodiscard]] std::string command_line(const Plan& plan);

// What `clatter plan` says.

/// What was asked of a plan, beside its scene.
struct PlanRequest {
  std::optional<double> within;               ///< [ms]
  std::function<bool(const char*)> is_given;  ///< whether the argument is ("digits")
};
[[nodiscard]] Argument within_argument(std::optional<double>& within);
/// @throws BadInput where an argument is given that the plan chooses or a sweep.
[[nodiscard]] PlanTarget plan_target(const Scene& scene, const PlanRequest& request);

/// @throws BadInput for a scene on a slope, one that ends at a time, or one that begins without an impact.
void require_counted_impacts(const Scene& scene, const char* command);

/// A row for each model of the hierarchy.
[[nodiscard]] Report plan_report(const Scene& scene, const Plan& plan);

/// Why the plan does not give what was asked, one sentence; empty: it does.
[[nodiscard]] std::string plan_shortfall(const Plan& plan);

}  // namespace clatter::validation
