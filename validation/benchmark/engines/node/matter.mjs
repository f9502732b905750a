// SPDX-License-Identifier: GPL-3.0-or-later
// matter-js: positions and their differences (Verlet) in pixels and milliseconds.  The rod is a thin rectangle.
import Matter from 'matter-js';
import { requirePlane, runAll, versionOf } from './problem.mjs';

const { Bodies, Body, Composite, Engine, Resolver } = Matter;
const pixels = 1000;  // for a metre
const usual = { ...Resolver };

function chooseSettings(engine, tuned) {
  Object.assign(Resolver, usual);
  if (!tuned) return;
  // Resolver.js: no restitution below _restingThresh (2 pixels in 1/60 s), and overlaps pushed apart by position.
  Resolver._restingThresh = Resolver._restingThreshTangent = 1e-9;
  Resolver._positionDampen = 0;
  engine.velocityIterations = 50;
  engine.positionIterations = 1;
}

function makeBody(problem, surface) {
  const height = (problem.rod ? 2 * problem.radius : problem.height) * pixels;
  const body = Bodies.rectangle(0, 0, problem.length * pixels, height, surface);
  Body.setMass(body, problem.mass);
  Body.setInertia(body, problem.inertia[1] * pixels ** 2);
  // y points down.  A thin rectangle's corner is lower than the rod's end by radius * cos(phi), not by the radius.
  const corner = problem.rod ? problem.radius * (Math.cos(problem.phi) - 1) : 0;
  Body.setPosition(body, { x: problem.position[0] * pixels, y: -(problem.position[2] + corner) * pixels });
  Body.setAngle(body, -problem.phi);
  // Velocities are ways in 1/60 s, whatever the step.
  const base = Body._baseDelta / 1000;
  body.deltaTime = problem.step * 1000;
  Body.setVelocity(body, { x: problem.velocity[0] * pixels * base, y: -problem.velocity[2] * pixels * base });
  Body.setAngularVelocity(body, -problem.omega * base);
  return { body, corner, base };
}

function simulate(problem, trajectory) {
  requirePlane(problem);
  const engine = Engine.create({ gravity: { x: 0, y: 0 } });  // weight is a force: the engine's own has units of its own
  chooseSettings(engine, problem.tuned);
  const surface = { restitution: problem.restitution, friction: problem.friction, frictionStatic: 0, frictionAir: 0 };
  if (problem.tuned) surface.slop = 0;  // 0.05 pixels by default
  const floor = Bodies.rectangle(0, 500, 200000, 1000, { ...surface, isStatic: true });
  const { body, corner, base } = makeBody(problem, surface);
  Composite.add(engine.world, [floor, body]);
  const weight = problem.gravity * pixels * 1e-6 * problem.mass;
  trajectory.recordPlanar(() => {
    body.force.y += weight;
    Engine.update(engine, problem.step * 1000);
  }, () => {
    const v = Body.getVelocity(body), unit = 1 / (base * pixels);
    return [body.position.x / pixels, -body.position.y / pixels - corner, -body.angle, v.x * unit, -v.y * unit,
            -Body.getAngularVelocity(body) / base];
  });
}

await runAll({ name: 'matter-js', version: versionOf('matter-js') }, simulate);
