// SPDX-License-Identifier: GPL-3.0-or-later
// ODE: contact joints with Newton's restitution, dWorldQuickStep.  (dWorldStep bounds friction by an earlier normal
// force.)
#include <ode/ode.h>

#include "problem.hpp"

namespace {

struct Contacts {
  const league::Problem& problem;
  dWorldID world;
  dJointGroupID group;
};

void join(void* data, dGeomID one, dGeomID other) {
  const auto& contacts = *static_cast<Contacts*>(data);
  dContact found[8];
  const int count = dCollide(one, other, 8, &found[0].geom, sizeof(dContact));
  for (int i = 0; i < count; ++i) {
    dSurfaceParameters& surface = found[i].surface;
    // Without dContactApprox1 `mu` is a force, not a coefficient (manual, "Contact").
    surface.mode = dContactBounce | dContactApprox1;
    surface.mu = contacts.problem.friction;
    surface.bounce = contacts.problem.restitution;
    // The interface has no default; 0.1 m/s is the value of the manual's and the demos' examples.
    surface.bounce_vel = contacts.problem.tuned() ? 0 : 0.1;
    dJointAttach(dJointCreateContact(contacts.world, contacts.group, &found[i]), dGeomGetBody(one),
                 dGeomGetBody(other));
  }
}

dGeomID add_shape(const league::Problem& problem, dSpaceID space, dBodyID body) {
  if (!problem.rod()) {
    const dGeomID box = dCreateBox(space, problem.length, problem.width, problem.height);
    dGeomSetBody(box, body);
    return box;
  }
  const dGeomID capsule = dCreateCapsule(space, problem.radius, problem.length);
  dGeomSetBody(capsule, body);
  dMatrix3 turned;  // a capsule lies along its z axis, the rod along x
  dRFromAxisAndAngle(turned, 0, 1, 0, M_PI / 2);
  dGeomSetOffsetRotation(capsule, turned);
  return capsule;
}

dBodyID add_body(const league::Problem& problem, dWorldID world) {
  const dBodyID body = dBodyCreate(world);
  dMass mass;
  dMassSetParameters(&mass, problem.mass, 0, 0, 0, problem.inertia[0], problem.inertia[1], problem.inertia[2], 0, 0, 0);
  dBodySetMass(body, &mass);
  const auto &p = problem.position, &v = problem.velocity, &w = problem.angular_velocity;
  dBodySetPosition(body, p[0], p[1], p[2]);
  dBodySetQuaternion(body, problem.attitude.data());
  dBodySetLinearVel(body, v[0], v[1], v[2]);
  dBodySetAngularVel(body, w[0], w[1], w[2]);
  return body;
}

void simulate(const league::Problem& problem, league::Trajectory& trajectory) {
  dRandSetSeed(0);  // dWorldQuickStep takes its constraints in random order
  const dWorldID world = dWorldCreate();
  const dSpaceID space = dHashSpaceCreate(nullptr);
  const dJointGroupID group = dJointGroupCreate(0);
  dWorldSetGravity(world, 0, 0, -problem.gravity);
  if (problem.tuned()) {
    dWorldSetQuickStepNumIterations(world, 200);  // 20 by default
    // Manual, "ERP and CFM": 0.2 and 1e-10 in double precision by default.
    dWorldSetERP(world, 0);
    dWorldSetCFM(world, 0);
  }
  dCreatePlane(space, 0, 0, 1, 0);
  const dBodyID body = add_body(problem, world);
  add_shape(problem, space, body);
  Contacts contacts{problem, world, group};
  trajectory.record(
      [&] {
        dSpaceCollide(space, &contacts, join);
        dWorldQuickStep(world, problem.step);
        dJointGroupEmpty(group);
      },
      [&] {
        const dReal *p = dBodyGetPosition(body), *q = dBodyGetQuaternion(body), *v = dBodyGetLinearVel(body),
                    *w = dBodyGetAngularVel(body);
        trajectory.add_spatial({p[0], p[1], p[2]}, {q[0], q[1], q[2], q[3]}, {v[0], v[1], v[2]}, {w[0], w[1], w[2]});
      });
  dJointGroupDestroy(group);
  dSpaceDestroy(space);
  dWorldDestroy(world);
}

}  // namespace

int main() {
  dInitODE2(0);
  const int status = league::run_all({"ODE", dODE_VERSION}, simulate);
  dCloseODE();
  return status;
}
