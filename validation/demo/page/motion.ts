// SPDX-License-Identifier: GPL-3.0-or-later
// Where the body of either model is at a time, and where its energy is: of the discrete one between its impacts, of the continuous one
// between the samples of its time history, every step of a contact and some 20 of a flight.
import type { History, Impact } from "./api";
import { centreHeight, extentOf, type Body } from "./body";
import {
  FreeRotation, cross, inclinationOf, planeRotation, plus, product, rotate, rotateBack, slerp, turnAbout, type Rotation, type Vector,
} from "./rotation";

export interface Pose {
  /** Of mass. */
  centre: Vector;
  rotation: Rotation;
  velocity: Vector;
  spin: Vector;
  /** > 0 if end a is lower; in the plane of motion also past the upright [rad]. */
  inclination: number;
  /** Force of the ground [N]; 0 in the discrete model, which knows impulses only. */
  force: Vector;
  inContact: boolean;
}

export interface Energies {
  translation: number;
  rotation: number;
  potential: number;
  ground: number;
  lost: number;
}

export interface Motion {
  readonly body: Body;
  readonly impacts: readonly Impact[];
  /** First and last time that can be shown, the touch of the first impact being 0 [s]. */
  readonly begin: number;
  /** From when on the fall is worth to be seen in slow motion. */
  readonly near: number;
  readonly end: number;
  pose(time: number): Pose;
  energies(time: number): Energies;
}

/** The time of a model that may be shown: it stops at its end. */
export function shownTime({ end }: Motion, time: number): number {
  return Math.min(time, end);
}

export function hasEnded({ end }: Motion, time: number): boolean {
  return time > end + 1e-12;
}

/** Where a point of the body is, and how fast it moves, given from its geometric centre in axes of the body. */
export function pointMotion(body: Body, pose: Pose, point: Vector): { place: Vector; velocity: Vector } {
  const from = rotate(pose.rotation, plus(point, body.centre, -1));
  return { place: plus(pose.centre, from), velocity: plus(pose.velocity, cross(pose.spin, from)) };
}

function energyOfRotation(body: Body, { rotation, spin }: Pose): number {
  const [x, y, z] = rotateBack(rotation, spin);
  const [xx, yy, zz, xy, xz, yz] = body.inertia;
  return (xx * x * x + yy * y * y + zz * z * z) / 2 + xy * x * y + xz * x * z + yz * y * z;
}

/** A fall that takes longer is better begun on its way [s]. */
const LONGEST_FALL = 1.5;

/** How long before the first touch the picture starts: at the release from rest, if there was one; and where slow motion does. */
function leadIn(impacts: readonly Impact[], speed: number, gravity: number, length: number): { begin: number; near: number } {
  const last = impacts[impacts.length - 1];
  const span = last ? last.start + last.duration : 0;
  const crossing = (0.4 * length) / Math.max(speed, 1e-9);
  const lead = Math.min(Math.max(0.3 * span, 0.1 * crossing), crossing);
  const fall = gravity > 0 ? Math.max(0, speed) / gravity : Infinity;
  const near = -Math.min(lead, fall);
  return { begin: fall > 0 && fall < LONGEST_FALL ? -fall : near, near };
}

/** Until when the flight after the last impact is shown: for a while, but never into the ground. */
function leadOut(body: Body, from: number, begin: number, pose: (time: number) => Pose): number {
  const span = Math.max(0.5 * from, -begin);
  const steps = 60;
  for (let i = 1; i <= steps; i++) {
    const { centre, rotation } = pose(from + (span * i) / steps);
    if (centre[2] < centreHeight(body, rotation) - 1e-9) return from + (span * (i - 1)) / steps;
  }
  return from + span;
}

/** A free flight before or after a known pose. */
class Flight {
  private readonly turning: FreeRotation | null;

  /** @param span how long it may last, negative before the pose [s] */
  constructor(body: Body, readonly known: Pose, private readonly gravity: number, span: number) {
    const [x, y, z] = rotateBack(known.rotation, known.spin);
    const isStill = x === 0 && y === 0 && z === 0;
    // About an axis of the body that lies across the plane of motion the spin is constant.
    const [, , , xy, , yz] = body.inertia;
    const isPlane = Math.hypot(x, z) <= 1e-9 * Math.abs(y) && xy === 0 && yz === 0;
    this.turning = isStill || isPlane ? null : new FreeRotation(body.inertia, known, span);
  }

  /** So long after the known pose. */
  pose(time: number): Pose {
    const { known } = this;
    const [vx, vy, vz] = known.velocity;
    const { rotation, spin } = this.turning?.at(time) ?? this.steady(time);
    return {
      rotation, spin, inclination: inclinationOf(rotation),
      centre: plus(plus(known.centre, known.velocity, time), [0, 0, (-this.gravity * time * time) / 2]),
      velocity: [vx, vy, vz - this.gravity * time], force: [0, 0, 0], inContact: false,
    };
  }

  private steady(time: number): { rotation: Rotation; spin: Vector } {
    const { rotation, spin } = this.known;
    const rate = rotateBack(rotation, spin)[1];
    return { rotation: rate === 0 ? rotation : product(rotation, turnAbout(1, rate * time)), spin };
  }
}

const DEGREE = Math.PI / 180;

interface Start {
  time: number;
  flight: Flight;
}

/** The centre of mass on a parabola, the rotation free. */
export class DiscreteMotion implements Motion {
  readonly begin: number;
  readonly near: number;
  readonly end: number;
  private readonly starts: Start[] = [];
  private readonly fall: Flight;
  private readonly total: number;

  /** @param spin before the first touch, world components [rad/s] */
  constructor(readonly body: Body, readonly impacts: readonly Impact[], private readonly gravity: number, spin: Vector) {
    const [first] = impacts;
    if (!first) throw new RangeError("a motion needs an impact");
    const velocity = plus(first.velocity_after, first.impulse, -1 / body.mass);
    this.total = first.energy_before;
    ({ begin: this.begin, near: this.near } = leadIn(impacts, -velocity[2], gravity, extentOf(body)));
    this.fall = new Flight(body, poseOf(body, first, [0, 0], velocity, spin), gravity, this.begin);
    this.addFlights();
    this.end = leadOut(body, impacts[impacts.length - 1]?.start ?? 0, this.near, (time) => this.pose(time));
  }

  pose(time: number): Pose {
    if (time < 0) return this.fall.pose(time);
    let start = this.starts[0] as Start;
    for (const next of this.starts) if (next.time <= time) start = next;
    return start.flight.pose(time - start.time);
  }

  energies(time: number): Energies {
    const pose = this.pose(time);
    const { mass } = this.body;
    const translation = (mass * pose.velocity.reduce((sum, v) => sum + v * v, 0)) / 2;
    const rotation = energyOfRotation(this.body, pose);
    const potential = mass * this.gravity * pose.centre[2];
    return { translation, rotation, potential, ground: 0, lost: this.total - translation - rotation - potential };
  }

  private addFlights(): void {
    let place: readonly [number, number] = [0, 0];
    this.impacts.forEach((impact, i) => {
      const { start: time, velocity_after: velocity, angular_velocity_after: spin } = impact;
      const next = this.impacts[i + 1];
      const lasts = next ? next.start - time : Math.max(0.5 * time, -this.near);
      const pose = poseOf(this.body, impact, place, velocity, spin);
      this.starts.push({ time, flight: new Flight(this.body, pose, this.gravity, lasts) });
      place = [place[0] + velocity[0] * lasts, place[1] + velocity[1] * lasts];
    });
  }
}

/** At the touch; in the plane an impact has an inclination alone. */
export function touchRotation({ attitude, inclination_deg }: Impact): Rotation {
  return attitude ?? planeRotation(inclination_deg * DEGREE);
}

function poseOf(body: Body, impact: Impact, [x, y]: readonly [number, number], velocity: Vector, spin: Vector): Pose {
  const rotation = touchRotation(impact);
  return {
    centre: [x, y, centreHeight(body, rotation)], rotation, inclination: inclinationOf(rotation), velocity, spin,
    force: [0, 0, 0], inContact: false,
  };
}

export class ContinuousMotion implements Motion {
  readonly begin: number;
  readonly near: number;
  readonly end: number;
  private readonly total: number;
  private readonly last: number;
  private readonly fall: Flight;
  private readonly after: Flight;

  constructor(
    readonly body: Body, readonly impacts: readonly Impact[], readonly history: History, private readonly gravity: number,
  ) {
    const { t } = history;
    // The history of a drop from a height begins with its fall, at a negative time.
    const touch = Math.max(0, t.findIndex((time) => time >= 0));
    this.last = t.length - 1;
    this.total = at(history.energy_total, 0);
    const falling = this.sample(touch, 0);
    ({ begin: this.begin, near: this.near } = leadIn(impacts, -falling.velocity[2], gravity, extentOf(body)));
    this.fall = new Flight(body, falling, gravity, this.begin);
    const released = this.sample(this.last, 0);
    const stop = at(t, this.last);
    this.after = new Flight(body, released, gravity, Math.max(0.5 * stop, -this.near));
    // A body that still touches has no simple motion past its history.
    this.end = released.inContact ? stop : leadOut(body, stop, this.near, (time) => this.after.pose(time - stop));
  }

  pose(time: number): Pose {
    const { t } = this.history;
    if (time < 0) return this.fall.pose(time);
    if (time > at(t, this.last)) return this.after.pose(time - at(t, this.last));
    const row = rowBefore(t, time);
    return this.sample(row, fraction(t, row, time));
  }

  energies(time: number): Energies {
    const { history } = this;
    const known = Math.min(Math.max(time, 0), at(history.t, this.last));
    const row = rowBefore(history.t, known);
    const part = fraction(history.t, row, known);
    const value = (column: number[]): number => mix(at(column, row), at(column, row + 1), part);
    const lost = this.total - value(history.energy_total);
    const rotation = time < 0 ? 0 : value(history.energy_rotation);
    const ground = time < 0 ? 0 : value(history.energy_ground);
    // Of the height by the place: between the samples of a flight it is not linear.
    const potential = this.body.mass * this.gravity * this.pose(time).centre[2];
    return { translation: this.total - lost - rotation - ground - potential, rotation, potential, ground, lost };
  }

  private sample(row: number, part: number): Pose {
    const h = this.history;
    const dt = at(h.t, row + 1) - at(h.t, row);
    // Cubic in position with the velocities at both samples: exact on the parabola of a flight.
    const place = (p: number[], v: number[]): number =>
      hermite(at(p, row), at(v, row) * dt, at(p, row + 1), at(v, row + 1) * dt, part);
    const value = (column: number[]): number => mix(at(column, row), at(column, row + 1), part);
    const rotation = slerp(rotationAt(h, row), rotationAt(h, row + 1), part);
    return {
      centre: [place(h.x, h.vx), place(h.y, h.vy), place(h.z, h.vz)],
      rotation, inclination: inclinationOf(rotation),
      velocity: [value(h.vx), value(h.vy), value(h.vz)],
      spin: [value(h.wx), value(h.wy), value(h.wz)],
      force: [value(h.fx), value(h.fy), value(h.fz)] as Vector,
      inContact: at(h.in_contact, row) !== 0,
    };
  }
}

/** Column entry; past the last sample the last one goes on. */
function at(column: number[], row: number): number {
  return column[Math.min(row, column.length - 1)] ?? 0;
}

/** The last row that is not after a time. */
function rowBefore(times: number[], time: number): number {
  let low = 0;
  let high = times.length - 1;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if ((times[middle] ?? 0) <= time) low = middle;
    else high = middle;
  }
  return low;
}

function fraction(times: number[], row: number, time: number): number {
  const span = at(times, row + 1) - at(times, row);
  return span > 0 ? Math.min(1, Math.max(0, (time - at(times, row)) / span)) : 0;
}

function mix(a: number, b: number, part: number): number {
  return a + (b - a) * part;
}

function hermite(p: number, v: number, q: number, w: number, s: number): number {
  const r = 1 - s;
  return p * (1 + 2 * s) * r * r + v * s * r * r + q * s * s * (1 + 2 * r) - w * s * s * r;
}

function rotationAt(h: History, row: number): Rotation {
  return [at(h.beta0, row), at(h.beta1, row), at(h.beta2, row), at(h.beta3, row)];
}
