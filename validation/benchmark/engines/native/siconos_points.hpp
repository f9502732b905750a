// SPDX-License-Identifier: GPL-3.0-or-later
// A body of the plane as Siconos sees it: three coordinates, and the heights of its points above the floor as
// relations.
#pragma once

#include <SiconosKernel.hpp>

#include "problem.hpp"

namespace league {

/// Height z + px sin(phi) + pz cos(phi) of a point of the body, and its place x + px cos(phi) - pz sin(phi) along the
/// floor where there is friction, with their derivatives by (x, z, phi).
class PointOverFloor : public LagrangianScleronomousR {
 public:
  PointOverFloor(const Vector3& point, bool friction) : x_(point[0]), z_(point[2]), friction_(friction) {}

  void computeh(const BlockVector& q, BlockVector&, SiconosVector& y) override {
    const double s = std::sin(q(2)), c = std::cos(q(2));
    y(0) = q(1) + x_ * s + z_ * c;
    if (friction_) y(1) = q(0) + x_ * c - z_ * s;
  }

  void computeJachq(const BlockVector& q, BlockVector&) override {
    const double s = std::sin(q(2)), c = std::cos(q(2));
    SimpleMatrix& jacobian = matrix(_jachq);
    jacobian(0, 1) = 1;
    jacobian(0, 2) = x_ * c - z_ * s;
    if (!friction_) return;
    jacobian(1, 0) = 1;
    jacobian(1, 2) = -x_ * s - z_ * c;
  }

  void computeDotJachq(const BlockVector& q, BlockVector&, const BlockVector& velocity) override {
    const double s = std::sin(q(2)), c = std::cos(q(2));
    SimpleMatrix& derivative = matrix(_dotjachq);
    derivative(0, 2) = (-x_ * s - z_ * c) * velocity(2);
    if (friction_) derivative(1, 2) = (-x_ * c + z_ * s) * velocity(2);
  }

 private:
  SimpleMatrix& matrix(SP::SimpleMatrix& stored) const {
    if (!stored || stored->size(0) == 0) stored = std::make_shared<SimpleMatrix>(friction_ ? 2 : 1, 3);
    stored->zero();
    return *stored;
  }

  double x_, z_;
  bool friction_;
};

/// The body under its weight.  `System` is LagrangianDS or LagrangianLinearTIDS.
template <class System>
std::shared_ptr<System> falling_body(const Problem& problem) {
  const auto q = std::make_shared<SiconosVector>(3), v = std::make_shared<SiconosVector>(3);
  const auto force = std::make_shared<SiconosVector>(3);
  const auto mass = std::make_shared<SimpleMatrix>(3, 3);
  mass->zero();
  (*mass)(0, 0) = (*mass)(1, 1) = problem.mass;
  (*mass)(2, 2) = problem.planar_inertia();
  force->zero();
  (*force)(1) = -problem.mass * problem.gravity;
  (*q)(0) = problem.position[0];
  (*q)(1) = problem.position[2] - problem.radius;  // the points have no radius
  (*q)(2) = problem.phi();
  (*v)(0) = problem.velocity[0];
  (*v)(1) = problem.velocity[2];
  (*v)(2) = problem.omega();
  const auto body = std::make_shared<System>(q, v, mass);
  body->setFExtPtr(force);
  return body;
}

template <class System>
SP::NonSmoothDynamicalSystem over_floor(const Problem& problem, const std::shared_ptr<System>& body) {
  const auto world = std::make_shared<NonSmoothDynamicalSystem>(0, problem.steps() * problem.step);
  world->insertDynamicalSystem(body);
  const bool friction = problem.friction > 0;
  for (const Vector3& point : contact_points(problem)) {
    SP::NonSmoothLaw law;
    if (friction) {
      law = std::make_shared<NewtonImpactFrictionNSL>(problem.restitution, 0, problem.friction, 2);
    } else {
      law = std::make_shared<NewtonImpactNSL>(problem.restitution);
    }
    world->link(std::make_shared<Interaction>(law, std::make_shared<PointOverFloor>(point, friction)), body);
  }
  return world;
}

inline void add_row(const Problem& problem, LagrangianDS& body, Trajectory& trajectory) {
  const SiconosVector &q = *body.q(), &v = *body.velocity();
  trajectory.add_planar(q(0), q(1) + problem.radius, q(2), v(0), v(1), v(2));
}

}  // namespace league
