// SPDX-License-Identifier: GPL-3.0-or-later
// Bullet 3: btDiscreteDynamicsWorld with sequential impulses; built once in single and once in double precision.
#include <btBulletDynamicsCommon.h>

#include <memory>

#include "problem.hpp"

namespace {

btScalar real(double value) { return static_cast<btScalar>(value); }
btVector3 vector(const league::Vector3& v) { return {real(v[0]), real(v[1]), real(v[2])}; }
league::Vector3 array(const btVector3& v) { return {v.x(), v.y(), v.z()}; }

/// Tuned: a sphere for each point that can touch, as a capsule or box that lands flat gets one contact in a step.
std::unique_ptr<btCollisionShape> shape_of(const league::Problem& problem, btSphereShape& point) {
  if (problem.tuned()) {
    auto points = std::make_unique<btCompoundShape>();
    for (const league::Vector3& place : league::contact_points(problem)) {
      points->addChildShape(btTransform(btQuaternion::getIdentity(), vector(place)), &point);
    }
    return points;
  }
  if (problem.rod()) return std::make_unique<btCapsuleShapeX>(real(problem.radius), real(problem.length));
  return std::make_unique<btBoxShape>(
      btVector3(real(problem.length / 2), real(problem.width / 2), real(problem.height / 2)));
}

void use_tuned_settings(btDiscreteDynamicsWorld& world, btRigidBody& body) {
  btContactSolverInfo& solver = world.getSolverInfo();
  solver.m_restitutionVelocityThreshold = 0;  // btContactSolverInfo.h: no restitution below 0.2 m/s by default
  solver.m_numIterations = 100;
  // By default friction acts along one direction, which is arbitrary where nothing slips before the impact.
  solver.m_solverMode |= SOLVER_USE_2_FRICTION_DIRECTIONS;
  // Correction of overlaps by velocity (Baumgarte) adds energy to what bounces.
  solver.m_erp = 0;
  solver.m_erp2 = 0;
  // btCollisionObject.h: by default a contact is solved before the bodies touch, which takes the bounce's first part.
  body.setContactProcessingThreshold(0);
  body.setActivationState(DISABLE_DEACTIVATION);
}

void simulate(const league::Problem& problem, league::Trajectory& trajectory) {
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher(&configuration);
  btDbvtBroadphase broad_phase;
  btSequentialImpulseConstraintSolver solver;
  btDiscreteDynamicsWorld world(&dispatcher, &broad_phase, &solver, &configuration);
  world.setGravity(btVector3(0, 0, real(-problem.gravity)));
  btStaticPlaneShape plane(btVector3(0, 0, 1), 0);
  btRigidBody floor(btRigidBody::btRigidBodyConstructionInfo(0, nullptr, &plane));
  floor.setRestitution(1);  // coefficients of a contact are products
  floor.setFriction(1);
  world.addRigidBody(&floor);
  btSphereShape point(real(problem.radius));
  const auto shape = shape_of(problem, point);
  const btRigidBody::btRigidBodyConstructionInfo made_of(real(problem.mass), nullptr, shape.get(),
                                                         vector(problem.inertia));
  btRigidBody body(made_of);
  body.setRestitution(real(problem.restitution));
  body.setFriction(real(problem.friction));
  const auto& q = problem.attitude;
  const btTransform start(btQuaternion(real(q[1]), real(q[2]), real(q[3]), real(q[0])), vector(problem.position));
  body.setCenterOfMassTransform(start);  // turns the tensor of inertia, too
  body.setInterpolationWorldTransform(start);
  body.setLinearVelocity(vector(problem.velocity));
  body.setAngularVelocity(vector(problem.angular_velocity));
  world.addRigidBody(&body);
  if (problem.tuned()) use_tuned_settings(world, body);
  trajectory.record([&] { world.stepSimulation(real(problem.step), 0); },
                    [&] {
                      const btQuaternion at = body.getWorldTransform().getRotation();
                      trajectory.add_spatial(array(body.getWorldTransform().getOrigin()),
                                             {at.w(), at.x(), at.y(), at.z()}, array(body.getLinearVelocity()),
                                             array(body.getAngularVelocity()));
                    });
  world.removeRigidBody(&body);
  world.removeRigidBody(&floor);
}

}  // namespace

int main() {
  const int version = btGetVersion();
  const std::string precision = sizeof(btScalar) == 8 ? ", double precision" : ", single precision";
  return league::run_all({"Bullet" + precision, std::to_string(version / 100) + '.' + std::to_string(version % 100)},
                         simulate);
}
