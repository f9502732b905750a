// SPDX-License-Identifier: GPL-3.0-or-later
// Random bodies that strike with a corner.
#pragma once

#include <Eigen/LU>
#include <random>

#include "analytic/space/impulse/impact.hpp"

namespace clatter::oracle {

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double uniform(double low, double high) { return std::uniform_real_distribution<>(low, high)(engine_); }
  int whole(int low, int high) { return std::uniform_int_distribution<>(low, high)(engine_); }
  analytic::space::Vector3 vector(double size) {
    return {uniform(-size, size), uniform(-size, size), uniform(-size, size)};
  }
  analytic::space::Quaternion attitude() {
    std::normal_distribution<> normal;
    return analytic::space::Quaternion(normal(engine_), normal(engine_), normal(engine_), normal(engine_)).normalized();
  }

 private:
  std::mt19937_64 engine_;
};

struct Collision {
  analytic::space::Body body;
  analytic::space::State before;
  analytic::space::Vector3 place;
};

/// A body of any inertia that a solid can have, its corner on the ground with approach.
inline Collision random_collision(Random& random) {
  using namespace analytic::space;
  Collision c;
  const Vector3 squares = random.vector(1).cwiseAbs2() + Vector3::Constant(0.003);
  const double mass = random.uniform(0.1, 3), size = random.uniform(0.05, 2);
  const Vector3 principal =
      mass * size * size * Vector3(squares.y() + squares.z(), squares.z() + squares.x(), squares.x() + squares.y()) / 3;
  const Matrix3 axes = random.attitude().toRotationMatrix();
  c.body = {.mass = mass, .inertia = axes * principal.asDiagonal() * axes.transpose(), .vertices = {}, .rims = {}};
  c.place = axes * (random.vector(1).cwiseProduct(squares.cwiseSqrt()) * (2 * size));
  do {
    c.before.attitude = random.attitude();
    c.before.velocity = random.vector(2);
    c.before.angular_velocity = random.vector(2 / size);
  } while (!(contact_velocity(c.before, c.place).value.z() < -0.01));
  return c;
}

inline analytic::space::Contact contact_of(const Collision& c) {
  using namespace analytic::space;
  const Matrix3 axes = c.before.attitude.toRotationMatrix();
  const Matrix3 inverse = axes * c.body.inertia.inverse() * axes.transpose();
  const auto velocity = contact_velocity(c.before, c.place);
  return {.inverse_inertia = inverse_contact_inertia(c.body.mass, inverse, axes * c.place),
          .velocity = velocity.value,
          .velocity_scale = velocity.scale};
}

/// Coulomb friction μ in [0, most] with one of the four restitution laws.
inline analytic::ImpactLaw random_law(Random& random, double most) {
  using analytic::RestitutionLaw;
  analytic::ImpactLaw law;
  law.friction = analytic::FrictionKind::coulomb;
  law.friction_value = random.uniform(0, most);
  law.law = static_cast<RestitutionLaw>(random.whole(0, 3));
  if (law.law == RestitutionLaw::viscoelastic) law.damping_per_stiffness = random.uniform(0, 1);
  else law.restitution = random.uniform(0, 1);
  return law;
}

}  // namespace clatter::oracle
