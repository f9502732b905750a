// SPDX-License-Identifier: GPL-3.0-or-later
// Chipmunk 7: impulses with Newton's restitution, one step of semi-implicit Euler.  The rod is a segment, the box a
// polygon.
#include <chipmunk/chipmunk.h>

#include "problem.hpp"

namespace {

void use_tuned_settings(cpSpace* space) {
  // cpSpace.h: 10 iterations, slop 0.1 and a bias that removes 10 % of an overlap in 1/60 s are the defaults.
  cpSpaceSetIterations(space, 100);
  cpSpaceSetCollisionSlop(space, 0);
  cpSpaceSetCollisionBias(space, 1.0);  // the part of an overlap that remains after a second: overlaps are left alone
}

void simulate(const league::Problem& problem, league::Trajectory& trajectory) {
  problem.require_plane();
  cpSpace* space = cpSpaceNew();
  cpSpaceSetGravity(space, cpv(0, -problem.gravity));
  if (problem.tuned()) use_tuned_settings(space);
  // Coefficients of a contact are products, so the floor has 1.
  cpShape* floor = cpSpaceAddShape(space, cpBoxShapeNew2(cpSpaceGetStaticBody(space), cpBBNew(-100, -10, 100, 0), 0));
  cpShapeSetElasticity(floor, 1);
  cpShapeSetFriction(floor, 1);
  cpBody* body = cpSpaceAddBody(space, cpBodyNew(problem.mass, problem.planar_inertia()));
  const double half = problem.length / 2;
  cpShape* shape = problem.rod() ? cpSegmentShapeNew(body, cpv(-half, 0), cpv(half, 0), problem.radius)
                                 : cpBoxShapeNew(body, problem.length, problem.height, 0);
  cpSpaceAddShape(space, shape);
  cpShapeSetElasticity(shape, problem.restitution);
  cpShapeSetFriction(shape, problem.friction);
  cpBodySetPosition(body, cpv(problem.position[0], problem.position[2]));
  cpBodySetAngle(body, problem.phi());
  cpBodySetVelocity(body, cpv(problem.velocity[0], problem.velocity[2]));
  cpBodySetAngularVelocity(body, problem.omega());
  trajectory.record([&] { cpSpaceStep(space, problem.step); },
                    [&] {
                      const cpVect p = cpBodyGetPosition(body), v = cpBodyGetVelocity(body);
                      trajectory.add_planar(p.x, p.y, cpBodyGetAngle(body), v.x, v.y, cpBodyGetAngularVelocity(body));
                    });
  cpSpaceRemoveShape(space, shape);
  cpShapeFree(shape);
  cpSpaceRemoveBody(space, body);
  cpBodyFree(body);
  cpSpaceRemoveShape(space, floor);
  cpShapeFree(floor);
  cpSpaceFree(space);
}

}  // namespace

int main() { return league::run_all({"Chipmunk", cpVersionString}, simulate); }
