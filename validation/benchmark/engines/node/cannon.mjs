// SPDX-License-Identifier: GPL-3.0-or-later
// cannon-es: double precision, soft contacts (SPOOK).  It has no capsule: the rod is two spheres over a plane.
import * as CANNON from 'cannon-es';
import { contactPoints, runAll, versionOf } from './problem.mjs';

const { Body, Box, ContactMaterial, Material, Plane, Sphere, Vec3, World } = CANNON;
const array = ({ x, y, z }) => [x, y, z];

function addShapes(problem, body) {
  if (problem.rod) {
    for (const point of contactPoints(problem)) body.addShape(new Sphere(problem.radius), new Vec3(...point));
  } else {
    body.addShape(new Box(new Vec3(problem.length / 2, problem.width / 2, problem.height / 2)));
  }
}

function makeBody(problem, material) {
  const body = new Body({ mass: problem.mass, material, linearDamping: 0, angularDamping: 0 });
  addShapes(problem, body);
  body.updateMassProperties = () => {};  // would take the inertia from the shapes
  body.inertia.set(...problem.inertia);
  body.invInertia.set(...problem.inertia.map(moment => 1 / moment));
  const [w, x, y, z] = problem.attitude;
  body.position.set(...problem.position);
  body.quaternion.set(x, y, z, w);
  body.velocity.set(...problem.velocity);
  body.angularVelocity.set(...problem.angular_velocity);
  body.updateInertiaWorld(true);
  return body;
}

function simulate(problem, trajectory) {
  const world = new World({ gravity: new Vec3(0, 0, -problem.gravity), allowSleep: !problem.tuned });
  const material = new Material();
  const contact = new ContactMaterial(material, material, { restitution: problem.restitution, friction: problem.friction });
  if (problem.tuned) {
    contact.contactEquationStiffness = 1e12;  // ContactMaterial: 1e7 by default
    world.solver.iterations = 100;  // GSSolver: 10 by default
    world.solver.tolerance = 0;
  }
  world.addContactMaterial(contact);
  const floor = new Body({ mass: 0, material, shape: new Plane() });  // its normal is z
  world.addBody(floor);
  const body = makeBody(problem, material);
  world.addBody(body);
  trajectory.recordSpatial(() => world.step(problem.step), () => ({
    position: array(body.position),
    attitude: [body.quaternion.w, body.quaternion.x, body.quaternion.y, body.quaternion.z],
    velocity: array(body.velocity), spin: array(body.angularVelocity),
  }));
}

await runAll({ name: 'cannon-es', version: versionOf('cannon-es') }, simulate);
