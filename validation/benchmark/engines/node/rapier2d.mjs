// SPDX-License-Identifier: GPL-3.0-or-later
// Rapier 2D: single precision, soft contacts.  The rod is a capsule over a half-space.
import RAPIER from '@dimforge/rapier2d-compat';
import { requirePlane, runAll, versionOf } from './problem.mjs';

function useTunedSettings(world) {
  world.numSolverIterations = 16;  // integration_parameters.d.ts: 4 by default
  const parameters = world.integrationParameters;
  parameters.contact_natural_frequency = 1e-3;  // overlaps are left alone; their correction adds energy
  parameters.normalizedPredictionDistance = 0;  // 0.02 m by default: contacts before bodies touch
  parameters.normalizedAllowedLinearError = 0;
}

function simulate(problem, trajectory) {
  requirePlane(problem);
  const world = new RAPIER.World({ x: 0, y: -problem.gravity });
  world.timestep = problem.step;
  if (problem.tuned) useTunedSettings(world);
  const rule = RAPIER.CoefficientCombineRule.Min;  // coefficients of a contact are averages by default
  world.createCollider(RAPIER.ColliderDesc.halfspace({ x: 0, y: 1 }).setRestitution(1).setFriction(1));
  const [x, , z] = problem.position;
  const body = world.createRigidBody(RAPIER.RigidBodyDesc.dynamic()
    .setTranslation(x, z).setRotation(problem.phi)
    .setLinvel(problem.velocity[0], problem.velocity[2]).setAngvel(problem.omega)
    .setCanSleep(!problem.tuned)
    .setAdditionalMassProperties(problem.mass, { x: 0, y: 0 }, problem.inertia[1]));
  const shape = problem.rod
    ? RAPIER.ColliderDesc.capsule(problem.length / 2, problem.radius).setRotation(Math.PI / 2)
    : RAPIER.ColliderDesc.cuboid(problem.length / 2, problem.height / 2);
  world.createCollider(shape.setDensity(0).setRestitution(problem.restitution).setFriction(problem.friction)
    .setRestitutionCombineRule(rule).setFrictionCombineRule(rule), body);
  trajectory.recordPlanar(() => world.step(), () => {
    const p = body.translation(), v = body.linvel();
    return [p.x, p.y, body.rotation(), v.x, v.y, body.angvel()];
  });
  world.free();
}

await RAPIER.init();
await runAll({ name: 'Rapier 2D', version: versionOf('@dimforge/rapier2d-compat') }, simulate);
