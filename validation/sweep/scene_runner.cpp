// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/sweep/scene_runner.hpp"

#include <algorithm>
#include <new>

#include "validation/plan/planned_run.hpp"
#include "validation/scene/failure.hpp"
#include "validation/scene/shortfall.hpp"

namespace clatter::validation::inline sweep {
namespace {

const char* outcome_of(FailureKind kind) {
  switch (kind) {
    case FailureKind::bad_input: return "refused";
    case FailureKind::outside_model: return "outside-model";
    default: return "not-computed";
  }
}

}  // namespace

SweepBody make_sweep_body(const SweepPlan& plan, const Scene& scene) {
  if (plan.model == Model::discrete) return {DiscreteBody(scene), nullptr};
  return {{}, std::make_shared<const numeric::Body>(scene.make_body())};
}

SceneRunner::SceneRunner(const SweepPlan& plan, const SweepBody& body, std::function<bool()> stop)
    : plan_(plan), stop_(std::move(stop)), scene_(plan.scene), body_(body) {}

RangeRows SceneRunner::operator()(const SceneRange& range) {
  RangeRows rows;
  while (rows.scenes < range.count && !stop_() && append_scene(range.first + rows.scenes, rows.text)) ++rows.scenes;
  return rows;
}

void SceneRunner::renew_body() {
  bool same = !body_values_.empty();
  for (std::size_t i = 0; same && i < body_values_.size(); ++i) same = body_values_[i] == values_[plan_.body_axes[i]];
  if (same || plan_.body_axes.empty()) return;
  body_values_.clear();  // so that a body that cannot be made is tried again
  body_ = make_sweep_body(plan_, scene_);
  for (const std::size_t axis : plan_.body_axes) body_values_.push_back(values_[axis]);
}

/// In the plane or in space.
void SceneRunner::append_sequence(RowForm& form) {
  const analytic::SequenceOptions options{
      .impacts = scene_.request.impacts, .digits = scene_.accuracy.digits, .amplification = form.errors};
  const DiscreteDrop drop = body_.discrete->drop(scene_);
  if (const auto* const planar = std::get_if<analytic::Drop>(&drop)) {
    const analytic::Sequence sequence = impact_sequence(*planar, options);
    form.reason = shortfall(scene_, sequence);
    return append_rows(form, sequence, scene_.angle_deg);
  }
  const analytic::space::Sequence sequence = impact_sequence(std::get<analytic::space::Drop>(drop), options);
  form.reason = shortfall(scene_, sequence);
  append_rows(form, sequence, space_rows(scene_, sequence, body_.discrete->centre()));
}

bool SceneRunner::append_result(RowForm& form) {
  renew_body();
  if (plan_.model == Model::discrete) {
    append_sequence(form);
    return true;
  }
  const PlannedRun planned = run_to_digits(*body_.solid, scene_.world, scene_.start(*body_.solid), scene_.request,
                                           scene_.accuracy, {.progress = [this](int, long) { return !stop_(); }});
  if (planned.run.outcome == numeric::Outcome::interrupted) return false;
  form.reason = shortfall(scene_, planned);
  append_rows(form, planned.run);
  return true;
}

RowForm SceneRunner::form_of(const std::string& prefix, std::string& out) const {
  const numeric::Request& request = scene_.request;
  const bool both = request.error_estimates && request.amplification;
  return {.out = out,
          .prefix = prefix,
          .rows = plan_.rows,
          .in_space = plan_.in_space,
          .errors = plan_.model == Model::discrete ? both : request.error_estimates,
          .predictions = plan_.model == Model::discrete ? both : request.amplification,
          .reason = {}};
}

bool SceneRunner::append_scene(long long index, std::string& out) {
  plan_.points.at(index, values_);
  for (std::size_t i = 0; i < values_.size(); ++i) plan_.put[i](scene_, values_[i]);
  const std::string prefix = row_prefix(index, values_);
  RowForm form = form_of(prefix, out);
  const char* outcome = nullptr;
  try {
    return append_result(form);
  } catch (const std::bad_alloc&) {
    throw;  // not the scene's fault, and another time it may have enough
  } catch (...) {
    const Failure failure = current_failure();
    if (failure.kind == FailureKind::defect) throw;
    outcome = outcome_of(failure.kind);
    form.reason = failure.message;
  }
  append_failure(form, plan_.model, outcome);
  return true;
}

MakeCompute runners_of(const SweepPlan& plan, const SweepBody& body) {
  return [&plan, &body](std::function<bool()> stop) -> ComputeRange {
    const auto runner = std::make_shared<SceneRunner>(plan, body, std::move(stop));
    return [runner](const SceneRange& range) { return (*runner)(range); };
  };
}

long long range_size(const SweepPlan& plan) {
  if (plan.model == Model::continuous) return 1;
  return std::clamp(4096 / plan.scene.request.impacts, 1, 512);
}

}  // namespace clatter::validation::inline sweep
