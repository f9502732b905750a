// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/plan/model_hierarchy.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "analytic/base/errors.hpp"
#include "validation/plan/closed_form.hpp"
#include "validation/plan/symmetry.hpp"
#include "validation/run/discrete_scene.hpp"
#include "validation/scene/names.hpp"

namespace clatter::validation {
namespace {

using numeric::Method;
using numeric::Simulation;

std::string reason_words(const Scene& scene) {
  const std::string reason = reason_in_space(scene);
  return reason.empty() ? "" : ": " + reason;
}

std::size_t index(ModelLevel level) { return static_cast<std::size_t>(level); }

}  // namespace

const char* level_name(ModelLevel level) {
  switch (level) {
    case ModelLevel::closed_form: return "closed form";
    case ModelLevel::discrete: return "discrete";
    case ModelLevel::discrete_in_space: return "discrete 3D";
    case ModelLevel::planar: return "planar";
    case ModelLevel::spatial: return "spatial";
  }
  return "";
}

const char* level_assumption(ModelLevel level) {
  switch (level) {
    case ModelLevel::closed_form: return "the rod is thin, and nothing strikes after the third impact";
    case ModelLevel::discrete:
    case ModelLevel::discrete_in_space: return "contacts take no time and no depth";
    case ModelLevel::planar: return "the body stays in the plane of its motion";
    case ModelLevel::spatial: return "the body is rigid, the ground a bed of springs and dampers";
  }
  return "";
}

const char* part_name(Part part) {
  switch (part) {
    case Part::friction: return "friction";
    case Part::damping: return "damping";
    case Part::gravity_in_contact: return "gravity during contact";
    case Part::unmerged_faces: return "elements of flat faces";
  }
  return "";
}

bool has_part(const Scene& scene, Part part) {
  switch (part) {
    case Part::friction: return scene.world.ground.has_friction();
    case Part::damping: return scene.world.ground.damping > 0;
    case Part::gravity_in_contact: return scene.world.gravity > 0 && scene.world.gravity_in_contact;
    case Part::unmerged_faces: return !scene.body.merge;
  }
  return false;
}

Scene without(Scene scene, Part part) {
  switch (part) {
    case Part::friction: scene.world.ground.static_friction = scene.world.ground.sliding_friction = 0; break;
    case Part::damping: scene.world.ground.damping = 0; break;
    case Part::gravity_in_contact: scene.world.gravity_in_contact = false; break;
    case Part::unmerged_faces: scene.body.merge = true; break;
  }
  return scene;
}

Scene limited(Scene scene) {
  constexpr long evaluations_per_run = 2'000'000;
  scene.accuracy.evaluation_limit = std::min(scene.accuracy.evaluation_limit, evaluations_per_run);
  return scene;
}

ModelHierarchy::ModelHierarchy(Scene scene, numeric::Observer observer)
    : scene_(std::move(scene)), observer_(std::move(observer)), body_(scene_.make_body()), start_(scene_.start(body_)) {
  find_discrete();
  against_[index(ModelLevel::closed_form)] = find_closed_form();
  against_[index(ModelLevel::planar)] = reason_against_planar();
}

/// The drop in the plane, or else in space.
void ModelHierarchy::find_discrete() {
  std::string &in_plane = against_[index(ModelLevel::discrete)],
              &in_space = against_[index(ModelLevel::discrete_in_space)];
  try {
    const DiscreteDrop drop = DiscreteBody(scene_, body_).drop(scene_);
    if (const auto* const planar = std::get_if<analytic::Drop>(&drop)) {
      drop_ = *planar;
      in_space = "the drop stays in its plane, where the discrete model gives the same";
      return;
    }
    space_drop_ = std::get<analytic::space::Drop>(drop);
    in_plane = "the discrete model is planar: the body moves in space" + reason_words(scene_);
  } catch (const analytic::OutsideModelError& error) {
    in_plane = in_space = error.what();
  }
}

/// The same rod without its radius.
std::string ModelHierarchy::find_closed_form() {
  if (scene_.body.shape != BodyScene::Shape::rod) return "it is for a thin rod";
  if (!drop_) return against(ModelLevel::discrete);
  if (!scene_.body.centre.empty() || !scene_.body.inertia.empty()) return "it is for a uniform rod";
  if (scene_.world.ground.has_friction()) return "it has no friction";
  analytic::Drop thin = *drop_;
  thin.body = analytic::make_rod({.mass = scene_.body.mass, .length = scene_.body.length, .radius = 0});
  if (scene_.world.ground.damping == 0) thin.law = {};
  const std::string reason = reason_against_closed_form(thin);
  if (reason.empty()) thin_rod_ = thin;
  return reason;
}

std::string ModelHierarchy::reason_against_planar() const {
  if (scene_.world.planar || is_mirror_image(body_, start_)) return "";
  return "the body is not its own mirror image in the plane of its motion";
}

Simulation ModelHierarchy::simulate(const LevelSetting& setting, int impacts) const {
  return simulate(setting, {.impacts = impacts, .error_estimates = false, .amplification = false});
}

Simulation ModelHierarchy::simulate(const LevelSetting& setting, const numeric::Request& request) const {
  numeric::World world = scene_.world;
  world.planar = setting.level == ModelLevel::planar;
  numeric::Accuracy accuracy = scene_.accuracy;
  accuracy.method = setting.method;
  accuracy.tolerance = setting.step > 0 ? 0 : setting.tolerance;
  accuracy.step = setting.step;
  return numeric::simulate(body_, world, start_, request, accuracy, observer_);
}

LevelResult ModelHierarchy::run(const LevelSetting& setting, int impacts) const {
  if (setting.level == ModelLevel::closed_form) {
    const analytic::Sequence sequence = closed_form_sequence(*thin_rod_, impacts);
    return {motion_rows(run_of(sequence)), 0, sequence.message};
  }
  if (setting.level == ModelLevel::discrete) {
    const analytic::Sequence sequence = impact_sequence(*drop_, {.impacts = impacts, .amplification = false});
    return {motion_rows(run_of(sequence)), sequence.root_evaluations, sequence.message};
  }
  if (setting.level == ModelLevel::discrete_in_space) {
    const analytic::space::Sequence sequence =
        impact_sequence(*space_drop_, {.impacts = impacts, .amplification = false});
    return {motion_rows(run_of(sequence)), sequence.evaluations, sequence.message};
  }
  const Simulation run = simulate(setting, impacts);
  return {motion_rows(run_of(run)), run.force_evaluations, std::string(outcome_name(run.outcome)) + ": " + run.message};
}

Truth true_values(const ModelHierarchy& hierarchy, double trusted) {
  Truth truth;
  truth.setting = {.level = hierarchy.full(), .method = Method::rk8pd, .tolerance = numeric::least_tolerance};
  const int impacts = hierarchy.scene().request.impacts;
  const Simulation run = hierarchy.simulate(truth.setting, impacts);
  if (is_cut_short(run.outcome)) truth.cut_short = fmt::format("{}: {}", outcome_name(run.outcome), run.message);
  if (run.impacts.empty()) return truth;
  LevelSetting coarser = truth.setting;
  coarser.tolerance *= 30;
  const Simulation other = hierarchy.simulate(coarser, impacts);
  truth.sizes = motion_sizes(run, run.impacts.size(), hierarchy.body());
  truth.contact_time = run.impacts[0].value.duration;
  const auto rows = motion_rows(run_of(run)), others = motion_rows(run_of(other));
  for (std::size_t i = 0; i < std::min(rows.size(), others.size()); ++i) {
    const double error = row_distance(rows[i], others[i], truth.sizes);
    if (!(error <= trusted) || run.impacts[i].end != other.impacts[i].end) break;
    truth.error = std::max(truth.error, error);
    truth.rows.push_back(rows[i]);
  }
  if (!truth.rows.empty()) truth.sizes = motion_sizes(run, truth.rows.size(), hierarchy.body());
  return truth;
}

}  // namespace clatter::validation
