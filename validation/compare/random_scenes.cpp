// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/compare/random_scenes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analytic/law/viscoelastic.hpp"
#include "validation/compare/comparison.hpp"
#include "validation/compare/uniform.hpp"

namespace clatter::validation {
namespace {

void choose_body(Uniform& random, BodyScene& body) {
  body.mass = random.logarithmic(0.01, 10);
  if (random.one_in(2)) {
    body.shape = BodyScene::Shape::rod;
    body.length = random.logarithmic(0.05, 2);
    body.radius = body.length * random.logarithmic(0.005, 0.2);
    body.sectors = 4 * static_cast<int>(random(1, 5));
    body.rings = body.layers = 1;
    return;
  }
  body.shape = BodyScene::Shape::box;
  const double length = random.logarithmic(0.05, 2);
  body.size = {length, length * random(0.1, 1), length * random.logarithmic(0.03, 1)};
}

/// Whether the number is a sample at all.
bool counts(const ComparedImpact& impact, std::size_t q) {
  if (impact.n == 1 && q < 2) return false;
  return (*impact.discrete)[q] != 0;
}

void summarise(RandomScenesResult& result) {
  std::vector<double> ratios;
  std::size_t covered = 0;
  for (const LimitSample& sample : result.samples) {
    if (sample.gap <= sample.bar) ++covered;
    if (sample.gap > 0) ratios.push_back(sample.bar / sample.gap);
    result.farthest = std::max(result.farthest, sample.gap / sample.bar);
  }
  if (result.samples.empty()) return;
  result.covered = static_cast<double>(covered) / static_cast<double>(result.samples.size());
  if (ratios.empty()) return;
  const auto middle = ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2);
  std::nth_element(ratios.begin(), middle, ratios.end());
  result.median_bar = *middle;
}

}  // namespace

Scene random_scene(std::uint64_t seed, int index) {
  Uniform random(seed, index);
  Scene scene;
  scene.path = fmt::format("random scene {} of family {}", index, seed);
  choose_body(random, scene.body);
  const double size = scene.body.shape == BodyScene::Shape::rod ? scene.body.length : scene.body.size.x();
  scene.angle_deg = random(3, 87);
  scene.speed = random.logarithmic(0.3, 10);
  scene.tangential_velocity = random.one_in(2) ? 0 : random(-1, 1) * scene.speed;
  scene.spin = random.one_in(2) ? 0 : random(-0.5, 0.5) * scene.speed / size;
  scene.world.gravity = random.one_in(3) ? 0 : random(1, 20);
  scene.world.ground.stiffness = random.logarithmic(1e6, 1e12);
  const double restitution = random.one_in(3) ? 1 : random(0.3, 1);
  scene.world.ground.damping =
      scene.world.ground.stiffness * analytic::damping_of_restitution(restitution) / scene.speed;
  const double friction = random.one_in(3) ? 0 : random(0, 0.8);
  scene.world.ground.static_friction = scene.world.ground.sliding_friction = friction;
  scene.world.ground.area = random.one_in(2) ? numeric::AreaMeasure::surface : numeric::AreaMeasure::projected;
  return scene;
}

RandomScenesResult run_random_scenes(const RandomScenes& scenes) {
  RandomScenesResult result;
  for (int index = 0; index < scenes.count; ++index) {
    result.complete = scenes.goes_on();
    if (!result.complete) break;
    Scene scene = random_scene(scenes.seed, index);
    scene.request.impacts = scenes.impacts;
    scene.request.error_estimates = false;
    scene.accuracy.evaluation_limit = 100'000;  // soft grounds may hold a body for thousands of oscillations
    const Comparison comparison = compare_models(scene, scene.make_body());
    bool any = false;
    for (const ComparedImpact& impact : comparison.impacts) {
      if (!impact.has_landing()) continue;
      any = true;
      for (const auto& [name, heading, q] : comparison.discrete.quantities) {
        if (!counts(impact, q)) continue;
        const double gap = std::fabs(impact.limit->value[q] - (*impact.discrete)[q]);
        result.samples.push_back({gap, impact.limit->error[q]});
      }
    }
    result.with_limit += any ? 1 : 0;
  }
  summarise(result);
  return result;
}

}  // namespace clatter::validation
