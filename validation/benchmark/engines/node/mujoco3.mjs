// SPDX-License-Identifier: GPL-3.0-or-later
// MuJoCo 3: double precision, soft contacts without a coefficient of restitution.
// default: its own contact.  tuned: a spring and a damper (negative solref) that return the coefficient of restitution.
import load from '@mujoco/mujoco';
import { runAll, versionOf } from './problem.mjs';

const mujoco = await load();
const contactSteps = 10;  // that long a tuned contact lasts

/** Angle w t by which a damped oscillator's force is zero again; `damping` is the part of the critical one, below 1. */
function contactAngle(damping) {
  const rest = Math.sqrt(1 - damping ** 2);
  return (Math.PI - Math.atan2(2 * damping * rest, 1 - 2 * damping ** 2)) / rest;
}

/** Damping at which a spring and damper that do not pull return `restitution`: e = exp(-d w t), Schwager and Poeschel
 *  (2007), "Coefficient of restitution and linear-dashpot model revisited". */
function dampingFor(restitution) {
  let low = 0, high = 1 - 1e-9;
  for (let i = 0; i < 200; ++i) {
    const middle = (low + high) / 2;
    if (Math.exp(-middle * contactAngle(middle)) > restitution) low = middle; else high = middle;
  }
  return restitution < 1 ? low : 0;
}

function contactSettings(problem) {
  if (!problem.tuned) return '';
  // Modeling, "Solver parameters": solref = (-stiffness, -damping) per unit of mass; the impedance near 1 makes it so.
  const damping = dampingFor(problem.restitution);
  const frequency = contactAngle(damping) / (contactSteps * problem.step);
  return `solref="${-(frequency ** 2)} ${-2 * damping * frequency}" solimp="0.9999 0.9999 0.001"`;
}

function modelOf(problem) {
  const friction = problem.friction > 0;
  const surface = `condim="${friction ? 3 : 1}" friction="${friction ? problem.friction : 1e-5} 0 0"`;
  const half = [problem.length, problem.width, problem.height].map(extent => extent / 2);
  const shape = problem.rod
    ? `type="capsule" fromto="${-half[0]} 0 0 ${half[0]} 0 0" size="${problem.radius}"`
    : `type="box" size="${half.join(' ')}"`;
  const options = problem.tuned ? 'integrator="RK4" tolerance="1e-12" iterations="200" cone="elliptic"' : '';
  return `<mujoco><option timestep="${problem.step}" gravity="0 0 ${-problem.gravity}" ${options}/><worldbody>
<geom type="plane" size="100 100 1" priority="1" ${surface} ${contactSettings(problem)}/>
<body pos="${problem.position.join(' ')}" quat="${problem.attitude.join(' ')}"><freejoint/>
<inertial pos="0 0 0" mass="${problem.mass}" diaginertia="${problem.inertia.join(' ')}"/>
<geom ${shape} ${surface}/></body></worldbody></mujoco>`;
}

/** `v` turned by the quaternion `q`, or back. */
function turned([w, x, y, z], v, back = false) {
  const s = back ? -1 : 1;
  const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
  const axis = [s * x, s * y, s * z], once = cross(axis, v), twice = cross(axis, once);
  return v.map((value, i) => value + 2 * (w * once[i] + twice[i]));
}

function simulate(problem, trajectory) {
  const model = mujoco.MjModel.from_xml_string(modelOf(problem));
  const data = new mujoco.MjData(model);
  // A free joint turns with angular velocities in the body's axes.
  const start = [...problem.velocity, ...turned(problem.attitude, problem.angular_velocity, true)];
  start.forEach((value, i) => { data.qvel[i] = value; });
  trajectory.recordSpatial(() => mujoco.mj_step(model, data), () => {
    const [x, y, z, ...attitude] = data.qpos, v = [...data.qvel];
    return { position: [x, y, z], attitude, velocity: v.slice(0, 3), spin: turned(attitude, v.slice(3)) };
  });
  data.delete();
  model.delete();
}

await runAll({ name: 'MuJoCo 3', version: versionOf('@mujoco/mujoco'), law: 'newton routh' }, simulate);
