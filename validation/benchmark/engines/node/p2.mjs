// SPDX-License-Identifier: GPL-3.0-or-later
// p2-es: double precision, soft contacts (SPOOK).  The rod is a capsule over a plane.
import * as p2 from 'p2-es';
import { requirePlane, runAll, versionOf } from './problem.mjs';

function useTunedSettings(world) {
  world.solver.iterations = 100;  // GSSolver: 10 iterations by default
  world.solver.tolerance = 0;
  world.setGlobalStiffness(1e12);  // Equation: 1e6 by default
  world.defaultContactMaterial.stiffness = 1e12;
}

function simulate(problem, trajectory) {
  requirePlane(problem);
  const world = new p2.World({ gravity: [0, -problem.gravity] });
  world.defaultContactMaterial.restitution = problem.restitution;
  world.defaultContactMaterial.friction = problem.friction;
  if (problem.tuned) useTunedSettings(world);
  const floor = new p2.Body({ mass: 0 });
  floor.addShape(new p2.Plane());
  world.addBody(floor);
  const body = new p2.Body({
    mass: problem.mass, position: [problem.position[0], problem.position[2]], angle: problem.phi,
    velocity: [problem.velocity[0], problem.velocity[2]], angularVelocity: problem.omega, damping: 0, angularDamping: 0,
  });
  body.addShape(problem.rod ? new p2.Capsule({ length: problem.length, radius: problem.radius })
                            : new p2.Box({ width: problem.length, height: problem.height }));
  body.updateMassProperties = () => {};  // would take the inertia from the shape
  body.inertia = problem.inertia[1];
  body.invInertia = 1 / problem.inertia[1];
  world.addBody(body);
  trajectory.recordPlanar(() => world.step(problem.step), () => {
    const { position, velocity } = body;
    return [position[0], position[1], body.angle, velocity[0], velocity[1], body.angularVelocity];
  });
}

await runAll({ name: 'p2-es', version: versionOf('p2-es') }, simulate);
