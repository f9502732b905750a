#include "validation/sweep/scene_runner.hpp"

#include <new>
#include <stdexcept>

#include "analytic/errors.hpp"
#include "numeric/errors.hpp"
#include "validation/compare/discrete_scene.hpp"
#include "validation/plan/planned_run.hpp"
#include "validation/scene/bad_input.hpp"
#include "validation/sweep/rows.hpp"

namespace clatter::validation {

SweepBody make_sweep_body(const SweepPlan& plan, const SimulationScene& scene) {
  if (plan.model == Model::discrete) return {nominal_body(scene), nullptr};
  return {{}, std::make_shared<const numeric::Body>(scene.make_body())};
}

SceneRunner::SceneRunner(const SweepPlan& plan, const SweepBody& body, std::function<bool()> stop)
    : plan_(plan), stop_(std::move(stop)), scene_(plan.scene), body_(body) {
  scene_.options.progress = [this](int, long) { return !stop_(); };
}

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

bool SceneRunner::append_result(const std::string& prefix, std::string& out) {
  renew_body();
  if (plan_.model == Model::discrete) {
    const analytic::Sequence sequence =
        analytic::impact_sequence(impact_drop(scene_, body_.planar), {.impacts = scene_.options.impacts,
                                                                      .digits = scene_.options.digits,
                                                                      .amplification = scene_.options.amplification});
    append_rows(out, prefix, plan_.rows, sequence, scene_.angle_deg);
    return true;
  }
  const numeric::Simulation run =
      run_to_digits(*body_.solid, scene_.ground, scene_.start(*body_.solid), scene_.options).run;
  if (run.outcome == numeric::Outcome::interrupted) return false;
  append_rows(out, prefix, plan_.rows, run);
  return true;
}

bool SceneRunner::append_scene(long long index, std::string& out) {
  plan_.points.at(index, values_);
  for (std::size_t i = 0; i < values_.size(); ++i) plan_.put[i](scene_, values_[i]);
  const std::string prefix = row_prefix(index, values_);
  const char* outcome = nullptr;
  try {
    return append_result(prefix, out);
  } catch (const std::bad_alloc&) {
    throw;  // not the scene's fault, and another time it may have enough
  } catch (const analytic::OutsideModelError&) {
    outcome = "outside-model";
  } catch (const BadInput&) {
    outcome = "refused";
  } catch (const numeric::MeshError&) {
    outcome = "refused";
  } catch (const std::logic_error&) {  // domain_error of the library: a scene it refuses
    outcome = "refused";
  } catch (const std::exception&) {
    outcome = "not-computed";
  }
  append_failure(out, prefix, plan_, outcome);
  return true;
}

}  // namespace clatter::validation
