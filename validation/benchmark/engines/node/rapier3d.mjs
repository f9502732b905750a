// SPDX-License-Identifier: GPL-3.0-or-later
// Rapier 3D: single precision, soft contacts.  The rod is a capsule over a half-space.
import RAPIER from '@dimforge/rapier3d-compat';
import { runAll, versionOf } from './problem.mjs';

const vector = ([x, y, z]) => ({ x, y, z });
const rotation = ([w, x, y, z]) => ({ x, y, z, w });
const array = ({ x, y, z }) => [x, y, z];

function useTunedSettings(world) {
  world.numSolverIterations = 16;  // integration_parameters.d.ts: 4 by default
  const parameters = world.integrationParameters;
  parameters.contact_natural_frequency = 1e-3;  // overlaps are left alone; their correction adds energy
  parameters.normalizedPredictionDistance = 0;  // 0.02 m by default: contacts before bodies touch
  parameters.normalizedAllowedLinearError = 0;
}

function shapeOf(problem) {
  if (!problem.rod) return RAPIER.ColliderDesc.cuboid(problem.length / 2, problem.width / 2, problem.height / 2);
  const half = Math.SQRT1_2;  // a capsule lies along y, the rod along x
  return RAPIER.ColliderDesc.capsule(problem.length / 2, problem.radius).setRotation({ x: 0, y: 0, z: half, w: half });
}

function simulate(problem, trajectory) {
  const world = new RAPIER.World({ x: 0, y: 0, z: -problem.gravity });
  world.timestep = problem.step;
  if (problem.tuned) useTunedSettings(world);
  const rule = RAPIER.CoefficientCombineRule.Min;  // coefficients of a contact are averages by default
  const floor = new RAPIER.ColliderDesc(new RAPIER.HalfSpace({ x: 0, y: 0, z: 1 }));
  world.createCollider(floor.setRestitution(1).setFriction(1));
  const body = world.createRigidBody(RAPIER.RigidBodyDesc.dynamic()
    .setTranslation(...problem.position).setRotation(rotation(problem.attitude))
    .setLinvel(...problem.velocity).setAngvel(vector(problem.angular_velocity))
    .setCanSleep(!problem.tuned)
    .setAdditionalMassProperties(problem.mass, vector([0, 0, 0]), vector(problem.inertia), rotation([1, 0, 0, 0])));
  world.createCollider(shapeOf(problem).setDensity(0)
    .setRestitution(problem.restitution).setFriction(problem.friction)
    .setRestitutionCombineRule(rule).setFrictionCombineRule(rule), body);
  trajectory.recordSpatial(() => world.step(), () => {
    const q = body.rotation();
    return { position: array(body.translation()), attitude: [q.w, q.x, q.y, q.z],
             velocity: array(body.linvel()), spin: array(body.angvel()) };
  });
  world.free();
}

await RAPIER.init();
await runAll({ name: 'Rapier 3D', version: versionOf('@dimforge/rapier3d-compat') }, simulate);
