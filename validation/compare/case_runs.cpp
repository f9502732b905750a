// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/compare/case_runs.hpp"

#include <fmt/format.h>

#include <functional>

#include "validation/output/bad_input.hpp"
#include "validation/run/history_file.hpp"

namespace clatter::validation {
namespace {

/// ∫F_z dt of what it records.
class ForceIntegral {
 public:
  void operator()(const numeric::HistorySample& sample) {
    impulse_ += (sample.time - time_) * (sample.force.z() + force_) / 2;
    time_ = sample.time;
    force_ = sample.force.z();
  }
  [[nodiscard]] double impulse() const { return impulse_; }

 private:
  double time_ = 0, force_ = 0, impulse_ = 0;
};

constexpr int fall_points = 20;

}  // namespace

double RecordedRun::force_impulse() const {
  ForceIntegral integral;
  for (const numeric::HistorySample& sample : samples) integral(sample);
  return integral.impulse();
}

std::string RunOptions::key() const {
  return fmt::format("{}/{}/{}/{}/{}/{}", digits, impacts, planar, static_cast<int>(method), step,
                     static_cast<int>(area));
}

Scene scene_of_case(const std::string& name, const RunOptions& options, const std::vector<SceneOverride>& changes) {
  Scene scene = case_scene(name, changes);
  if (options.digits > 0) scene.accuracy.digits = options.digits;
  if (options.impacts > 0) scene.request.impacts = options.impacts;
  if (options.planar) scene.world.planar = true;
  if (options.method != numeric::Method::automatic) scene.accuracy.method = options.method;
  if (options.step > 0) scene.accuracy.step = options.step;
  if (options.area != numeric::AreaMeasure::surface) scene.world.ground.area = options.area;
  scene.request.error_estimates = false;
  return scene;
}

Scene CaseRuns::scene(const std::string& name, const RunOptions& options) const {
  return scene_of_case(name, options, changes);
}

template <class Result>
const Result& CaseRuns::once(Made<Result>& made, const std::string& key, const std::function<Result()>& make) {
  std::shared_ptr<typename Made<Result>::Entry> entry;
  {
    const std::lock_guard lock(mutex_);
    auto& place = made.entries[key];
    if (!place) place = std::make_shared<typename Made<Result>::Entry>();
    entry = place;
  }
  std::call_once(entry->made, [&] { entry->result = make(); });
  return entry->result;
}

const numeric::Simulation& CaseRuns::run(const std::string& name, const RunOptions& options) {
  return once<numeric::Simulation>(runs_, name + options.key(), [&] {
    const Scene scene = this->scene(name, options);
    const numeric::Body body = scene.make_body();
    return numeric::simulate(body, scene.world, scene.start(body), scene.request, scene.accuracy);
  });
}

const RecordedRun& CaseRuns::history(const std::string& name, const RunOptions& options) {
  return once<RecordedRun>(histories_, name + options.key(), [&] {
    Scene scene = this->scene(name, options);
    const numeric::Body body = scene.make_body();
    RecordedRun recorded;
    const auto list = [&](const numeric::HistorySample& sample) { recorded.samples.push_back(sample); };
    double fall = 0;
    const numeric::MotionState start = scene.start(body, &fall);
    record_fall(list, body, scene.world, start, fall, fall_points);
    recorded.run = numeric::simulate(body, scene.world, start, scene.request, scene.accuracy, {.history = list});
    return recorded;
  });
}

const std::vector<SweptSimulation>& CaseRuns::sweep(const std::string& name, const RunOptions& options) {
  return once<std::vector<SweptSimulation>>(sweeps_, name + options.key(), [&] {
    Scene scene = this->scene(name, options);
    for (const SceneOverride& change : changes) {
      if (!scene.sweep && !scene_of_case(name, options, {change}).sweep)
        throw BadInput(fmt::format("{}: must be left out where {} varies it", change.flag, name));
    }
    scene.request.amplification = false;
    const numeric::Body body = scene.make_body();
    std::vector<SweptSimulation> swept;
    for (const double value : scene.sweep->values()) {
      const Scene one = scene.at(value);
      ForceIntegral force;
      numeric::Simulation run =
          numeric::simulate(body, one.world, one.start(body), one.request, one.accuracy, {.history = std::ref(force)});
      swept.push_back({value, std::move(run), force.impulse()});
    }
    return swept;
  });
}

const Comparison& CaseRuns::comparison(const std::string& name, int impacts) {
  return once<Comparison>(comparisons_, fmt::format("{}/{}", name, impacts), [&] {
    Scene scene = this->scene(name);
    if (impacts > 0) scene.request.impacts = impacts;
    return compare_models(scene, scene.make_body());
  });
}

const std::vector<SweptComparison>& CaseRuns::swept_comparison(const std::string& name) {
  return once<std::vector<SweptComparison>>(swept_comparisons_, name, [&] {
    const Scene scene = this->scene(name);
    const numeric::Body body = scene.make_body();
    std::vector<SweptComparison> swept;
    for (const double value : scene.sweep->values()) swept.push_back({value, compare_models(scene.at(value), body)});
    return swept;
  });
}

}  // namespace clatter::validation
