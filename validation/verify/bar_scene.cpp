// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/verify/bar_scene.hpp"

#include <cmath>
#include <random>
#include <sstream>

namespace clatter::validation::inline verify {

using analytic::FrictionKind;

analytic::Drop BarScene::drop() const {
  const analytic::PlanarBody body =
      shape == BarShape::box
          ? analytic::make_box({.mass = mass, .length = length, .width = length, .thickness = 2 * half_thickness})
          : analytic::make_rod({.mass = mass, .length = length, .radius = half_thickness});
  return {.body = body,
          .inclination = analytic::Angle::from_degrees(degrees),
          .velocity = velocity,
          .gravity = gravity,
          .law = law};
}

std::string BarScene::words() const {
  std::ostringstream text;
  text.precision(17);
  text << (shape == BarShape::box ? "box " : "rod ") << length << " x " << half_thickness << " m, " << mass << " kg, "
       << degrees << " deg, " << velocity.normal << ' ' << velocity.tangential << " m/s, " << velocity.angular
       << " rad/s, g " << gravity << ", e " << law.restitution << " law " << static_cast<int>(law.law) << " damping "
       << law.damping_per_stiffness << " friction " << static_cast<int>(law.friction) << ' ' << law.friction_value
       << ", digits " << digits;
  return text.str();
}

BarScene random_bar_scene(unsigned family, int index) {
  std::seed_seq seed{family, static_cast<unsigned>(index)};
  std::mt19937_64 random(seed);
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * 0x1p-53 * static_cast<double>(random() >> 11);
  };
  const auto one_of = [&](unsigned n) { return static_cast<int>(random() % n); };
  BarScene scene;
  scene.shape = static_cast<BarShape>(one_of(3));
  scene.length = std::pow(10, uniform(-1.2, 0.3));
  scene.mass = std::pow(10, uniform(-1, 1));
  scene.half_thickness = scene.shape == BarShape::thin_rod ? 0 : uniform(0.02, 0.4) * scene.length;
  scene.degrees = uniform(0.5, 89.5);
  scene.velocity.normal = -uniform(0.5, 5);
  if (one_of(2) != 0) scene.velocity.tangential = uniform(-2, 2);
  if (one_of(2) != 0) scene.velocity.angular = uniform(-5, 5);
  scene.gravity = one_of(8) != 0 ? 9.81 * std::pow(10, uniform(-1, 1)) : 0;
  scene.law.restitution = one_of(3) != 0 ? uniform(0.001, 0.98) : std::pow(10, uniform(-3, -0.01));
  scene.law.law = static_cast<analytic::RestitutionLaw>(one_of(3));
  const int friction = one_of(4);
  if (friction == 1) scene.law.friction = FrictionKind::impulse_ratio, scene.law.friction_value = uniform(-0.2, 0.2);
  if (friction > 1) scene.law.friction = FrictionKind::coulomb, scene.law.friction_value = uniform(0.01, 0.8);
  scene.digits = 3 * (1 + one_of(4));
  return scene;
}

BarScene random_damped_bar_scene(unsigned family, int index) {
  BarScene scene = random_bar_scene(family, index);
  std::seed_seq seed{family, static_cast<unsigned>(index), 1u};
  std::mt19937_64 random(seed);
  const double damping_number = std::pow(10, -3 + 3.5 * 0x1p-53 * static_cast<double>(random() >> 11));
  scene.law.law = analytic::RestitutionLaw::viscoelastic;
  scene.law.restitution = 1;
  scene.law.damping_per_stiffness = damping_number / -scene.velocity.normal;
  return scene;
}

}  // namespace clatter::validation::inline verify
