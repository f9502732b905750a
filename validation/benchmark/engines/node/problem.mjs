// SPDX-License-Identifier: GPL-3.0-or-later
// What every adapter for Node.js shares: a run as flat numbers, the trajectory it returns, and the loop around both.
// The keys of a run, the frame and the report are those of native/problem.hpp.
import { readFileSync, writeFileSync } from 'node:fs';

/** The engine has no means to express a problem; the text says which is missing. */
export class Unsupported extends Error {}

const WORDS = new Set(['problem', 'shape', 'settings', 'output']);

function readProblem(line) {
  const pairs = line.trim().split(/\s+/).map(pair => pair.split(/=(.*)/s, 2));
  const value = (key, text) => WORDS.has(key) ? text : text.includes(',') ? text.split(',').map(Number) : Number(text);
  const problem = Object.fromEntries(pairs.map(([key, text]) => [key, value(key, text)]));
  return {
    ...problem,
    tuned: problem.settings === 'tuned',
    rod: problem.shape === 'rod',
    /** Counter-clockwise angle of the body's x axis on the page [rad]; y points into the page. */
    phi: -2 * Math.atan2(problem.attitude[2], problem.attitude[0]),
    omega: -problem.angular_velocity[1],
  };
}

/** Where the body can touch the floor, in its own axes: the rod's ends or the box's corners, those of its middle plane
 *  if the problem is one of the plane. */
export function contactPoints({ rod, space, length, width, height }) {
  const [x, y, z] = [length / 2, width / 2, height / 2];
  if (rod) return [[-x, 0, 0], [x, 0, 0]];
  return [-z, z].flatMap(high => (space ? [-y, y] : [0]).flatMap(deep => [-x, x].map(along => [along, deep, high])));
}

export function requirePlane(problem) {
  if (problem.space) throw new Unsupported('an engine of the plane');
}

/** Rows of one run. */
class Trajectory {
  constructor(problem) {
    this.problem = problem;
    this.rows = [];
    this.seconds = 0;
  }

  /** Rows at the start and after each step.  `sample` returns [x, z, phi, vx, vz, omega]. */
  recordPlanar(step, sample) {
    this.#record(step, () => this.#addPlanar(sample()));
  }

  /** `sample` returns {position, attitude (scalar first), velocity, spin}, all in the world frame, spin too.  For a
   *  problem of the plane the row keeps what lies in the plane. */
  recordSpatial(step, sample) {
    this.#record(step, () => {
      const { position: [x, y, z], attitude: q, velocity: v, spin } = sample();
      if (this.problem.space) {
        this.rows.push([this.#time(), x, y, z - this.problem.radius, ...q, ...v, ...spin]);
      } else {
        const phi = Math.atan2(2 * (q[1] * q[3] - q[0] * q[2]), 1 - 2 * (q[2] ** 2 + q[3] ** 2));
        this.#addPlanar([x, z, phi, v[0], v[2], -spin[1]]);
      }
    });
  }

  write(engine) {
    const { problem } = this;
    const heads = { engine: engine.name, version: engine.version, problem: problem.problem, step: problem.step,
                    settings: problem.settings, law: engine.law ?? 'newton moreau' };
    const columns = problem.space ? 't,x,y,z,q0,q1,q2,q3,vx,vy,vz,wx,wy,wz' : 't,x,z,phi,vx,vz,omega';
    const lines = [...Object.entries(heads).map(([key, value]) => `# ${key}: ${value}`), columns, ...this.rows.map(row => row.join(','))];
    writeFileSync(problem.output, lines.join('\n') + '\n');
  }

  #addPlanar([x, z, phi, vx, vz, omega]) {
    const turn = 2 * Math.PI;
    if (this.rows.length) phi += turn * Math.round((this.rows.at(-1)[3] - phi) / turn);
    this.rows.push([this.#time(), x, z - this.problem.radius, phi, vx, vz, omega]);
  }

  #time() {
    return this.problem.start + this.rows.length * this.problem.step;
  }

  #record(step, addRow) {
    const { duration, step: length } = this.problem;
    addRow();
    for (let i = 0; i < Math.ceil(duration / length - 1e-9); ++i) {
      const before = process.hrtime.bigint();
      step();
      this.seconds += Number(process.hrtime.bigint() - before) / 1e9;
      addRow();
    }
  }
}

/** The version that is installed of a package. */
export function versionOf(name) {
  return JSON.parse(readFileSync(new URL(`./node_modules/${name}/package.json`, import.meta.url))).version;
}

/** Reads the runs, hands each to `simulate(problem, trajectory)` and reports. */
export async function runAll(engine, simulate) {
  // Engines print notes of their own; standard output holds the report alone.
  console.log = console.info = console.warn = () => {};
  for (const line of readFileSync(0, 'utf8').split('\n').filter(text => text.trim())) {
    const problem = readProblem(line);
    try {
      const trajectory = new Trajectory(problem);
      await simulate(problem, trajectory);
      trajectory.write(engine);
      process.stdout.write(`done ${problem.output} ${trajectory.seconds}\n`);
    } catch (error) {
      if (!(error instanceof Unsupported)) throw error;
      process.stdout.write(`cannot ${problem.output} ${error.message}\n`);
    }
  }
}
