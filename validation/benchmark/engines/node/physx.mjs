// SPDX-License-Identifier: GPL-3.0-or-later
// PhysX 5: single precision, impulses.  The rod is a capsule over a plane.
import { readFileSync } from 'node:fs';
import { runAll, versionOf } from './problem.mjs';

// The package is built for browsers alone: it finds a window and no Node.js, and is handed its binary.
const wasmBinary = readFileSync(new URL('./node_modules/physx-js-webidl/physx-js-webidl.wasm', import.meta.url));
const node = globalThis.process;
globalThis.window = globalThis;
globalThis.process = undefined;
const { default: load } = await import('physx-js-webidl');
const physx = await load({ wasmBinary });
globalThis.process = node;

const vector = ([x, y, z]) => new physx.PxVec3(x, y, z);
const rotation = ([w, x, y, z]) => new physx.PxQuat(x, y, z, w);
const array = ({ x, y, z }) => [x, y, z];
const foundation = physx.CreateFoundation(physx.PHYSICS_VERSION, new physx.PxDefaultAllocator(), new physx.PxDefaultErrorCallback());
const scale = new physx.PxTolerancesScale();
const physics = physx.CreatePhysics(physx.PHYSICS_VERSION, foundation, scale);
const contactOffset = 1e-5;

function makeScene(problem) {
  const description = new physx.PxSceneDesc(scale);
  description.gravity = vector([0, 0, -problem.gravity]);
  description.cpuDispatcher = physx.DefaultCpuDispatcherCreate(0);
  description.filterShader = physx.DefaultFilterShader();
  if (problem.tuned) {
    description.bounceThresholdVelocity = 1e-6;  // PxSceneDesc.h: 0.2 of the scale's speed of 10 m/s by default
    description.solverType = physx.PxSolverTypeEnum.eTGS;
  }
  return physics.createScene(description);
}

function addShape(problem, actor, geometry, material) {
  const flags = new physx.PxShapeFlags(physx.PxShapeFlagEnum.eSIMULATION_SHAPE);
  const shape = physics.createShape(geometry, material, true, flags);
  shape.setSimulationFilterData(new physx.PxFilterData(1, 1, 0, 0));
  if (problem.tuned) {  // PxShape.h: contacts begin 0.02 m before bodies touch by default
    shape.setContactOffset(contactOffset);
    shape.setRestOffset(0);
  }
  actor.attachShape(shape);
}

function addBody(problem, scene, material) {
  const body = physics.createRigidDynamic(new physx.PxTransform(vector(problem.position), rotation(problem.attitude)));
  const geometry = problem.rod
    ? new physx.PxCapsuleGeometry(problem.radius, problem.length / 2)
    : new physx.PxBoxGeometry(problem.length / 2, problem.width / 2, problem.height / 2);
  addShape(problem, body, geometry, material);
  body.setMass(problem.mass);
  body.setMassSpaceInertiaTensor(vector(problem.inertia));
  body.setCMassLocalPose(new physx.PxTransform(vector([0, 0, 0]), rotation([1, 0, 0, 0])));
  body.setLinearDamping(0);
  body.setAngularDamping(0);  // 0.05/s by default
  body.setMaxAngularVelocity(1e4);
  if (problem.tuned) {
    body.setMaxDepenetrationVelocity(1e-6);  // overlaps are left alone
    body.setSolverIterationCounts(32, 8);    // 4 and 1 by default
    body.setSleepThreshold(0);
  }
  scene.addActor(body);
  body.setLinearVelocity(vector(problem.velocity));
  body.setAngularVelocity(vector(problem.angular_velocity));
  return body;
}

function simulate(problem, trajectory) {
  const scene = makeScene(problem);
  const material = physics.createMaterial(problem.friction, problem.friction, problem.restitution);
  const upright = rotation([Math.SQRT1_2, 0, -Math.SQRT1_2, 0]);  // a plane's normal is its x axis
  const floor = physics.createRigidStatic(new physx.PxTransform(vector([0, 0, 0]), upright));
  addShape(problem, floor, new physx.PxPlaneGeometry(), material);
  scene.addActor(floor);
  const body = addBody(problem, scene, material);
  trajectory.recordSpatial(() => {
    scene.simulate(problem.step);
    scene.fetchResults(true);
  }, () => {
    const { p, q } = body.getGlobalPose();
    const position = array(p), attitude = [q.w, q.x, q.y, q.z];
    const velocity = array(body.getLinearVelocity());
    return { position, attitude, velocity, spin: array(body.getAngularVelocity()) };
  });
  scene.release();
}

await runAll({ name: 'PhysX', version: `${versionOf('physx-js-webidl')} (PhysX 5.6.1)` }, simulate);
