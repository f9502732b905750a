// SPDX-License-Identifier: GPL-3.0-or-later
// planck: Box2D 2 in JavaScript, double precision.  It has no capsule that moves: the rod is two circles.
import * as planck from 'planck';
import { contactPoints, requirePlane, runAll, versionOf } from './problem.mjs';

const { Box, Circle, Settings, Vec2, World } = planck;
const usualThreshold = Settings.velocityThreshold;

function addFloor(world) {
  // Polygons have a skin of polygonRadius, in which contacts begin; the floor is lowered by that much.
  const shape = new Box(100, 10, Vec2(0, -10 - Settings.polygonRadius), 0);
  world.createBody().createFixture({ shape, friction: 1, restitution: 0 });  // of a contact: root of the product; larger one
}

function addShapes(problem, body) {
  const surface = { density: 0, friction: problem.friction ** 2, restitution: problem.restitution };
  if (problem.rod || problem.tuned) {  // a box's corners as circles have no skin
    for (const [x, , z] of contactPoints(problem)) {
      body.createFixture({ shape: new Circle(Vec2(x, z), problem.radius), ...surface });
    }
  } else {
    const [half, high] = [problem.length, problem.height].map(extent => extent / 2 - Settings.polygonRadius);
    body.createFixture({ shape: new Box(half, high), ...surface });
  }
}

function simulate(problem, trajectory) {
  requirePlane(problem);
  Settings.velocityThreshold = problem.tuned ? 0 : usualThreshold;  // Settings.ts: no restitution below 1 m/s by default
  const world = new World({ gravity: Vec2(0, -problem.gravity), allowSleep: !problem.tuned });
  addFloor(world);
  const body = world.createBody({
    type: 'dynamic', position: Vec2(problem.position[0], problem.position[2]), angle: problem.phi,
    linearVelocity: Vec2(problem.velocity[0], problem.velocity[2]), angularVelocity: problem.omega,
  });
  addShapes(problem, body);
  body.setMassData({ mass: problem.mass, center: Vec2(0, 0), I: problem.inertia[1] });
  const velocityIterations = problem.tuned ? 50 : 8, positionIterations = 3;  // 8 and 3 are World.step's own
  trajectory.recordPlanar(() => world.step(problem.step, velocityIterations, positionIterations), () => {
    const p = body.getPosition(), v = body.getLinearVelocity();
    return [p.x, p.y, body.getAngle(), v.x, v.y, body.getAngularVelocity()];
  });
}

await runAll({ name: 'planck', version: versionOf('planck') }, simulate);
