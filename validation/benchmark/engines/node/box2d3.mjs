// SPDX-License-Identifier: GPL-3.0-or-later
// Box2D 3: single precision, soft contacts in sub-steps with a restitution pass.  The rod is a capsule.
import load from './node_modules/box2d3-wasm/build/dist/es/compat/Box2D.compat.mjs';
import { requirePlane, runAll, versionOf } from './problem.mjs';

const box2d = await load();
const subSteps = 4;  // the manual's recommendation

function vector(x, y) {
  const v = new box2d.b2Vec2();
  v.x = x;
  v.y = y;
  return v;
}

/** b2MakeRot approximates sine and cosine, 0.09 degrees off at 10 degrees: the argument that gives `angle` is sought. */
function rotation(angle) {
  let argument = angle;
  for (let i = 0; i < 20; ++i) {
    const { s, c } = box2d.b2MakeRot(argument);
    argument += angle - Math.atan2(s, c);
  }
  return box2d.b2MakeRot(argument);
}

function makeWorld(problem) {
  const definition = box2d.b2DefaultWorldDef();
  definition.gravity = vector(0, -problem.gravity);
  if (problem.tuned) {
    definition.restitutionThreshold = 0;  // box2d/types.h: no restitution below 1 m/s by default
    definition.enableSleep = false;
    definition.enableContinuous = false;
  }
  const world = box2d.b2CreateWorld(definition);
  const surface = box2d.b2DefaultShapeDef();
  surface.material.friction = 1;     // of a contact: the root of the product
  surface.material.restitution = 0;  // of a contact: the larger one
  const floor = box2d.b2CreateBody(world, box2d.b2DefaultBodyDef());
  box2d.b2CreatePolygonShape(floor, surface, box2d.b2MakeOffsetBox(100, 10, vector(0, -10), box2d.b2MakeRot(0)));
  return world;
}

function makeBody(problem, world) {
  const definition = box2d.b2DefaultBodyDef();
  definition.type = box2d.b2BodyType.b2_dynamicBody;
  definition.position = vector(problem.position[0], problem.position[2]);
  definition.rotation = rotation(problem.phi);
  definition.linearVelocity = vector(problem.velocity[0], problem.velocity[2]);
  definition.angularVelocity = problem.omega;
  const body = box2d.b2CreateBody(world, definition);
  const surface = box2d.b2DefaultShapeDef();
  surface.density = 1;
  surface.material.friction = problem.friction ** 2;
  surface.material.restitution = problem.restitution;
  if (problem.rod) {
    const capsule = new box2d.b2Capsule();
    capsule.center1 = vector(-problem.length / 2, 0);
    capsule.center2 = vector(problem.length / 2, 0);
    capsule.radius = problem.radius;
    box2d.b2CreateCapsuleShape(body, surface, capsule);
  } else {
    box2d.b2CreatePolygonShape(body, surface, box2d.b2MakeBox(problem.length / 2, problem.height / 2));
  }
  const mass = box2d.b2Body_GetMassData(body);
  mass.mass = problem.mass;
  mass.center = vector(0, 0);
  mass.rotationalInertia = problem.inertia[1];
  box2d.b2Body_SetMassData(body, mass);
  return body;
}

function simulate(problem, trajectory) {
  requirePlane(problem);
  const world = makeWorld(problem);
  const body = makeBody(problem, world);
  trajectory.recordPlanar(() => box2d.b2World_Step(world, problem.step, subSteps), () => {
    const p = box2d.b2Body_GetPosition(body), q = box2d.b2Body_GetRotation(body);
    const v = box2d.b2Body_GetLinearVelocity(body);
    return [p.x, p.y, Math.atan2(q.s, q.c), v.x, v.y, box2d.b2Body_GetAngularVelocity(body)];
  });
  box2d.b2DestroyWorld(world);
}

const { major, minor, revision } = box2d.b2GetVersion?.() ?? {};
const version = `${versionOf('box2d3-wasm')}${major === undefined ? '' : ` (Box2D ${major}.${minor}.${revision})`}`;
await runAll({ name: 'Box2D 3', version }, simulate);
