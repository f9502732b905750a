// SPDX-License-Identifier: GPL-3.0-or-later
// Scenes of a sweep computed one after the other.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "numeric/body.hpp"
#include "validation/scene/discrete_scene.hpp"
#include "validation/sweep/rows.hpp"
#include "validation/sweep/sweep_plan.hpp"
#include "validation/sweep/sweep_run.hpp"

namespace clatter::validation::inline sweep {

/// The body as the sweep's model wants it.
struct SweepBody {
  std::optional<DiscreteBody> discrete;
  std::shared_ptr<const numeric::Body> solid;
};
/// The body of one scene of the plan, swept sizes and all.  @throws as Scene::make_body and DiscreteBody.
[[nodiscard]] SweepBody make_sweep_body(const SweepPlan& plan, const Scene& scene);

/// One thread's part in a sweep.  A scene that the model refuses or cannot compute is a row whose outcome is "refused"
/// (speed and spin do not bring the contact down, a size is out of range, ...), "outside-model" (jamming, ...) or
/// "not-computed".
class SceneRunner {
 public:
  /// @param body of all scenes, where no key of the body is swept
  /// @param stop ends the run when it returns true; asked before each scene and during long ones
  SceneRunner(const SweepPlan& plan, const SweepBody& body, std::function<bool()> stop);
  SceneRunner(const SceneRunner&) = delete;
  SceneRunner& operator=(const SceneRunner&) = delete;

  [[nodiscard]] RangeRows operator()(const SceneRange& range);

 private:
  /// False if it was stopped; then nothing is appended.
  bool append_scene(long long index, std::string& out);
  bool append_result(RowForm& form);
  void append_sequence(RowForm& form);
  [[nodiscard]] RowForm form_of(const std::string& prefix, std::string& out) const;
  void renew_body();

  const SweepPlan& plan_;
  std::function<bool()> stop_;
  Scene scene_;
  SweepBody body_;
  std::vector<double> values_;
  std::vector<double> body_values_;  ///< of the body axes that body_ was made with
};

/// A runner for each thread.
[[nodiscard]] MakeCompute runners_of(const SweepPlan& plan, const SweepBody& body);
/// Scenes handed out at a time: some milliseconds' work.
[[nodiscard]] long long range_size(const SweepPlan& plan);

}  // namespace clatter::validation::inline sweep
