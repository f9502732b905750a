// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/compare/random_scenes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analytic/law/viscoelastic.hpp"
#include "numeric/mesh/mesh.hpp"
#include "validation/compare/comparison.hpp"
#include "validation/output/number.hpp"

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

/// Ground of random stiffness, damping by a restitution at the speed of the drop, and friction up to `most_friction`.
void choose_ground(Uniform& random, double most_friction, Scene& scene) {
  numeric::Ground& ground = scene.world.ground;
  ground.stiffness = random.logarithmic(1e6, 1e12);
  const double restitution = random.one_in(3) ? 1 : random(0.3, 1);
  ground.damping = ground.stiffness * analytic::damping_of_restitution(restitution) / scene.speed;
  ground.static_friction = ground.sliding_friction = random.one_in(3) ? 0 : random(0, most_friction);
  ground.area = random.one_in(2) ? numeric::AreaMeasure::surface : numeric::AreaMeasure::projected;
}

/// compare(scene's number) of each scene, until the run is ended; false if it was.
bool for_each_scene(const RandomScenes& scenes, const auto& compare) {
  for (int index = 0; index < scenes.count; ++index) {
    if (!scenes.goes_on()) return false;
    compare(index);
  }
  return true;
}

Comparison compared(Scene scene, const numeric::Body& body, int impacts) {
  scene.request.impacts = impacts;
  scene.request.error_estimates = false;
  scene.accuracy.evaluation_limit = 100'000;  // soft grounds may hold a body for thousands of oscillations
  return compare_models(scene, body);
}

using numeric::Vector3;

constexpr double rounding = 1e-12;  ///< of a number's scale: smaller gaps are chance

std::vector<double> list_of(const Vector3& v) { return {v.x(), v.y(), v.z()}; }

Vector3 in_cube(Uniform& random) {
  const double x = random(-1, 1), y = random(-1, 1), z = random(-1, 1);
  return {x, y, z};
}

Vector3 box_size(Uniform& random) {
  const double length = random.logarithmic(0.05, 2), width = random(0.1, 1), thickness = random.logarithmic(0.03, 1);
  return {length, length * width, length * thickness};
}

numeric::Body with_mass(numeric::Mesh mesh, double mass) {
  const double scale = mass / mass_properties(mesh).mass;
  for (numeric::Element& element : mesh.elements) element.density *= scale;
  return numeric::Body(mesh);
}

/// A tetrahedron whose corners are those of a cube, each moved.
numeric::Body tetrahedron(Uniform& random, double size, double mass) {
  numeric::Mesh mesh;
  for (const Vector3& corner : {Vector3(1, 1, 1), Vector3(-1, -1, 1), Vector3(-1, 1, -1), Vector3(1, -1, -1)})
    mesh.nodes.emplace_back(size / 3 * (corner + 0.4 * in_cube(random)));
  numeric::Element whole;
  std::copy_n(std::array{0, 1, 2, 3}.begin(), 4, whole.nodes.begin());
  mesh.elements.push_back(whole);
  return with_mass(std::move(mesh), mass);
}

/// An L of three bricks in the x–z plane: a corner, an arm along x and one along z.
numeric::Body corner_piece(Uniform& random, const Vector3& size, double mass) {
  const double xs[] = {0, size.x() * random(0.2, 0.6), size.x()}, ys[] = {0, size.y()},
               zs[] = {0, size.z() * random(0.2, 0.6), size.z()};
  numeric::Mesh mesh;
  for (const double z : zs) {
    for (const double y : ys) {
      for (const double x : xs) mesh.nodes.emplace_back(x, y, z);
    }
  }
  const auto brick = [&](int i, int k) {
    const int low = i + 6 * k, high = low + 6;
    mesh.elements.push_back({.shape = numeric::ElementShape::hexahedron,
                             .nodes = {low, low + 1, low + 4, low + 3, high, high + 1, high + 4, high + 3}});
  };
  brick(0, 0);
  brick(1, 0);
  brick(0, 1);
  // The node that no brick has, at the far ends of both arms.
  std::vector<int> place(mesh.nodes.size());
  std::vector<Vector3> used;
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i) {
    place[i] = static_cast<int>(used.size());
    if (i != 14 && i != 17) used.push_back(mesh.nodes[i]);
  }
  mesh.nodes = used;
  for (numeric::Element& element : mesh.elements) {
    for (int& node : element.nodes) node = place[static_cast<std::size_t>(node)];
  }
  return with_mass(std::move(mesh), mass);
}

numeric::Body choose_body(Uniform& random, int index, BodyScene& body) {
  const Vector3 size = box_size(random);
  body.mass = random.logarithmic(0.01, 10);
  body.size = size;
  body.shape = index % 4 < 2 ? BodyScene::Shape::box : BodyScene::Shape::mesh;
  if (index % 4 == 1) body.centre = list_of(0.3 * in_cube(random).cwiseProduct(size));
  if (index % 4 == 2) return tetrahedron(random, size.x(), body.mass);
  if (index % 4 == 3) return corner_piece(random, size, body.mass);
  Scene scene;
  scene.body = body;
  return scene.make_body();
}

void choose_drop(Uniform& random, double size, Scene& scene) {
  scene.speed = random.logarithmic(0.3, 10);
  const double across = random.one_in(2) ? 0 : 0.7 * scene.speed,
               spin = random.one_in(2) ? 0 : 0.4 * scene.speed / size;
  const double turn = random(0, 6.283185307179586), slope = random(-1, 1), roll = random(0, 6.283185307179586);
  const double upright = std::sqrt((1 + slope) / 2), over = std::sqrt((1 - slope) / 2);
  scene.attitude = {upright * std::cos(turn), upright * std::sin(turn), over * std::cos(roll), over * std::sin(roll)};
  scene.velocity = {across * random(-1, 1), across * random(-1, 1), -scene.speed};
  scene.angular_velocity = list_of(spin * in_cube(random));
  scene.world.gravity = random.one_in(3) ? 0 : random(1, 20);
}

/// Bars over gaps of the impact's numbers.
void take_bars(const Comparison& comparison, const ComparedImpact& impact, RandomSpaceResult& result,
               std::vector<double>& ratios) {
  for (const auto& [name, heading, q] : comparison.discrete.quantities) {
    const NumberPair pair{impact, q};
    const double gap = std::fabs(pair.miss()), bar = pair.bar() + impact.discrete_error[q];
    const double scale = comparison.discrete.scales[q];
    if (gap > rounding * scale) ratios.push_back(bar / gap);
    result.largest_bar = std::max(result.largest_bar, bar / scale);
  }
  result.farthest = std::max(result.farthest, impact.bars_off());
}

void judge(const Comparison& comparison, int index, RandomSpaceResult& result, std::vector<double>& ratios) {
  for (std::size_t i = 0; i < comparison.discrete.impacts.size(); ++i) {
    const SequenceImpact& discrete = comparison.discrete.impacts[i];
    const ComparedImpact& impact = comparison.impacts[i];
    if (!discrete.predictable || discrete.is_group) break;
    ++result.impacts;
    if (impact.has_landing()) take_bars(comparison, impact, result, ratios);
    if (impact.has_landing() && impact.bars_off() <= 1) ++result.within;
    else result.unsettled.push_back({.scene = index, .n = impact.n, .explanation = impact.explanation});
  }
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
  choose_ground(random, 0.8, scene);
  return scene;
}

RandomScenesResult run_random_scenes(const RandomScenes& scenes) {
  RandomScenesResult result;
  std::vector<double> ratios;
  std::size_t covered = 0;
  const auto take = [&](double gap, double bar) {
    ++result.samples;
    if (gap <= bar) ++covered;
    if (gap > 0) ratios.push_back(bar / gap);
    result.farthest = std::max(result.farthest, gap / bar);
  };
  result.complete = for_each_scene(scenes, [&](int index) {
    const Scene scene = random_scene(scenes.seed, index);
    const Comparison comparison = compared(scene, scene.make_body(), scenes.impacts);
    bool any = false;
    for (const ComparedImpact& impact : comparison.impacts) {
      if (!impact.has_landing()) continue;
      any = true;
      for (const auto& [name, heading, q] : comparison.discrete.quantities) {
        if (counts(impact, q)) take(std::fabs(impact.limit->value[q] - (*impact.discrete)[q]), impact.limit->error[q]);
      }
    }
    result.with_limit += any ? 1 : 0;
  });
  if (result.samples > 0) result.covered = static_cast<double>(covered) / static_cast<double>(result.samples);
  result.median_bar = upper_median(ratios);
  return result;
}

SpaceScene random_space_scene(std::uint64_t seed, int index) {
  Uniform random(seed, index);
  Scene scene;
  scene.path = fmt::format("random scene {} in space of family {}", index, seed);
  numeric::Body body = choose_body(random, index, scene.body);
  choose_drop(random, 2 * body.radius(), scene);
  choose_ground(random, 1, scene);
  return {std::move(scene), std::move(body)};
}

RandomSpaceResult run_random_space_scenes(const RandomScenes& scenes) {
  RandomSpaceResult result;
  std::vector<double> ratios;
  result.complete = for_each_scene(scenes, [&](int index) {
    const SpaceScene drop = random_space_scene(scenes.seed, index);
    judge(compared(drop.scene, drop.body, scenes.impacts), index, result, ratios);
  });
  result.median_bar = upper_median(ratios);
  return result;
}

}  // namespace clatter::validation
