// SPDX-License-Identifier: GPL-3.0-or-later
// What both models' motions have in common: where the body is at a time, and where its energy is.
import type { Impact } from "./answers";
import { centreHeight, type Body } from "./body";
import { FreeRotation } from "./free_rotation";
import { cross, inclinationOf, plus, product, rotate, rotateBack, turnAbout, type Rotation, type Vector } from "./rotation";

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

/** Where the middle of an end is, and how fast it moves. */
export function endMotion(body: Body, pose: Pose, end: "a" | "b"): { place: Vector; velocity: Vector } {
  return pointMotion(body, pose, [end === "a" ? -body.length / 2 : body.length / 2, 0, 0]);
}

/** Of a point of the body, given from its geometric centre in axes of the body. */
export function pointMotion(body: Body, pose: Pose, point: Vector): { place: Vector; velocity: Vector } {
  const from = rotate(pose.rotation, plus(point, body.centre, -1));
  return { place: plus(pose.centre, from), velocity: plus(pose.velocity, cross(pose.spin, from)) };
}

export function energyOfRotation(body: Body, { rotation, spin }: Pose): number {
  const [x, y, z] = rotateBack(rotation, spin);
  const [xx, yy, zz, xy, xz, yz] = body.inertia;
  return (xx * x * x + yy * y * y + zz * z * z) / 2 + xy * x * y + xz * x * z + yz * y * z;
}

/** How long before the first touch the picture starts: at the release from rest, if there was one; and where slow motion does. */
export function leadIn(impacts: readonly Impact[], speed: number, gravity: number, length: number): { begin: number; near: number } {
  const near = -slowLead(impacts, speed, gravity, length);
  // A fall that takes longer than this is better begun on its way.
  const fall = gravity > 0 ? Math.max(0, speed) / gravity : 0;
  return { begin: fall > 0 && fall < LONGEST_FALL ? Math.min(near, -fall) : near, near };
}

const LONGEST_FALL = 1.5; // s

function slowLead(impacts: readonly Impact[], speed: number, gravity: number, length: number): number {
  const last = impacts[impacts.length - 1];
  const span = last ? last.start + last.duration : 0;
  const crossing = (0.4 * length) / Math.max(speed, 1e-9);
  const lead = Math.min(Math.max(0.3 * span, 0.1 * crossing), crossing);
  return gravity > 0 ? Math.min(lead, Math.max(0, speed) / gravity) : lead;
}

/** Until when the flight after the last impact is shown: for a while, but never into the ground. */
export function leadOut(body: Body, from: number, begin: number, pose: (time: number) => Pose): number {
  const span = Math.max(0.5 * from, -begin);
  const steps = 60;
  for (let i = 1; i <= steps; i++) {
    const { centre, rotation } = pose(from + (span * i) / steps);
    if (centre[2] < centreHeight(body, rotation) - 1e-9) return from + (span * (i - 1)) / steps;
  }
  return from + span;
}

/** A free flight before or after a known pose. */
export class Flight {
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
