// SPDX-License-Identifier: GPL-3.0-or-later
// DART: boxed LCP with Newton's restitution.  The rod is two spheres: its own detector has no capsule.
#include <dart/collision/ode/ode.hpp>
#include <dart/dart.hpp>

#include "problem.hpp"

namespace {

using namespace dart::dynamics;
using dart::constraint::ContactConstraint;

Eigen::Vector3d vector(const league::Vector3& v) { return {v[0], v[1], v[2]}; }
league::Vector3 array(const Eigen::Vector3d& v) { return {v[0], v[1], v[2]}; }

void add_shape(BodyNode* body, const ShapePtr& shape, const Eigen::Vector3d& place, double restitution,
               double friction) {
  ShapeNode* node = body->createShapeNodeWith<CollisionAspect, DynamicsAspect>(shape);
  node->setRelativeTranslation(place);
  node->getDynamicsAspect()->setRestitutionCoeff(restitution);
  node->getDynamicsAspect()->setFrictionCoeff(friction);
}

SkeletonPtr make_floor() {
  const SkeletonPtr floor = Skeleton::create("floor");
  BodyNode* body = floor->createJointAndBodyNodePair<WeldJoint>().second;
  // Restitution of a contact is the product, friction the smaller coefficient.
  add_shape(body, std::make_shared<BoxShape>(Eigen::Vector3d(20, 20, 4)), {0, 0, -2}, 1, 1);
  return floor;
}

SkeletonPtr make_body(const league::Problem& problem) {
  const SkeletonPtr skeleton = Skeleton::create("body");
  const auto [joint, body] = skeleton->createJointAndBodyNodePair<FreeJoint>();
  const double e = problem.restitution, mu = problem.friction;
  if (problem.rod()) {
    for (const league::Vector3& point : league::contact_points(problem))
      add_shape(body, std::make_shared<SphereShape>(problem.radius), vector(point), e, mu);
  } else {
    const Eigen::Vector3d size(problem.length, problem.width, problem.height);
    add_shape(body, std::make_shared<BoxShape>(size), Eigen::Vector3d::Zero(), e, mu);
  }
  body->setInertia(Inertia(problem.mass, Eigen::Vector3d::Zero(), vector(problem.inertia).asDiagonal()));
  const auto& q = problem.attitude;
  Eigen::Isometry3d start = Eigen::Isometry3d::Identity();
  start.linear() = Eigen::Quaterniond(q[0], q[1], q[2], q[3]).toRotationMatrix();
  start.translation() = vector(problem.position);
  joint->setTransform(start);
  joint->setLinearVelocity(vector(problem.velocity));
  joint->setAngularVelocity(vector(problem.angular_velocity));
  return skeleton;
}

/// The default is Dantzig's method, which finds friction from the normal impulse without friction.
std::unique_ptr<dart::constraint::ConstraintSolver> tuned_solver() {
  auto iterations = std::make_shared<dart::constraint::PgsBoxedLcpSolver>();
  iterations->setOption({1000, 1e-12, 1e-12, 1e-12, false});  // 30, 1e-6, 1e-3, 1e-9, false by default
  auto solver = std::make_unique<dart::constraint::BoxedLcpConstraintSolver>(iterations);
  // The default is FCL, which turns spheres into meshes; exact shapes are chosen like this.
  solver->setCollisionDetector(dart::collision::OdeCollisionDetector::create());
  return solver;
}

void choose_settings(const league::Problem& problem, dart::simulation::World& world) {
  // These two belong to the class, not to a world.
  static const double error_reduction = ContactConstraint::getErrorReductionParameter();
  static const double force_mixing = ContactConstraint::getConstraintForceMixing();
  ContactConstraint::setErrorReductionParameter(problem.tuned() ? 0 : error_reduction);
  ContactConstraint::setConstraintForceMixing(problem.tuned() ? 1e-9 : force_mixing);  // ContactConstraint.hpp
  if (problem.tuned()) world.setConstraintSolver(tuned_solver());
}

void simulate(const league::Problem& problem, league::Trajectory& trajectory) {
  const auto world = dart::simulation::World::create();
  world->setGravity(Eigen::Vector3d(0, 0, -problem.gravity));
  world->setTimeStep(problem.step);
  const SkeletonPtr skeleton = make_body(problem);
  world->addSkeleton(make_floor());
  world->addSkeleton(skeleton);
  choose_settings(problem, *world);
  const BodyNode* body = skeleton->getBodyNode(0);
  trajectory.record([&] { world->step(); },
                    [&] {
                      const Eigen::Isometry3d at = body->getWorldTransform();
                      const Eigen::Quaterniond q(at.linear());
                      trajectory.add_spatial(array(at.translation()), {q.w(), q.x(), q.y(), q.z()},
                                             array(body->getLinearVelocity()), array(body->getAngularVelocity()));
                    });
}

}  // namespace

int main() { return league::run_all({"DART", DART_VERSION}, simulate); }
