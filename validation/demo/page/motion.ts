// What both models' motions have in common: where the body is at a time, and where its energy is.
import { centreHeight, type Body } from "./body";
import type { Impact } from "./answers";

export type Vector = [number, number, number];
/** Euler parameters, the scalar first. */
export type Rotation = [number, number, number, number];

export interface Pose {
  centre: Vector;
  rotation: Rotation;
  velocity: Vector;
  spin: Vector;
  /** In the plane of motion: > 0 if end a is lower [rad]. */
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
  readonly end: number;
  pose(time: number): Pose;
  energies(time: number): Energies;
}

/** Rotation about the axis across the plane of motion; an inclination is the negative of its angle. */
export function planeRotation(inclination: number): Rotation {
  return [Math.cos(inclination / 2), 0, -Math.sin(inclination / 2), 0];
}

export function rotate([w, x, y, z]: Rotation, [a, b, c]: Vector): Vector {
  const tx = 2 * (y * c - z * b);
  const ty = 2 * (z * a - x * c);
  const tz = 2 * (x * b - y * a);
  return [a + w * tx + y * tz - z * ty, b + w * ty + z * tx - x * tz, c + w * tz + x * ty - y * tx];
}

/** Where the middle of an end is, and how fast it moves. */
export function endMotion(body: Body, pose: Pose, end: "a" | "b"): { place: Vector; velocity: Vector } {
  const along = end === "a" ? -body.length / 2 : body.length / 2;
  const [x, y, z] = rotate(pose.rotation, [along, 0, 0]);
  const [cx, cy, cz] = pose.centre;
  const [vx, vy, vz] = pose.velocity;
  const [wx, wy, wz] = pose.spin;
  return {
    place: [cx + x, cy + y, cz + z],
    velocity: [vx + wy * z - wz * y, vy + wz * x - wx * z, vz + wx * y - wy * x],
  };
}

/** How long before the first touch the picture starts: a part of the whole, but not before a release from rest. */
export function leadIn(impacts: readonly Impact[], speed: number, gravity: number, length: number): number {
  const last = impacts[impacts.length - 1];
  const span = last ? last.start + last.duration : 0;
  const crossing = (0.4 * length) / Math.max(speed, 1e-9);
  const lead = Math.min(Math.max(0.3 * span, 0.1 * crossing), crossing);
  return gravity > 0 ? Math.min(lead, speed / gravity) : lead;
}

/** Until when the flight after the last impact is shown: for a while, but never into the ground. */
export function leadOut(body: Body, from: number, begin: number, pose: (time: number) => Pose): number {
  const span = Math.max(0.5 * from, -begin);
  const steps = 60;
  for (let i = 1; i <= steps; i++) {
    const { centre, inclination } = pose(from + (span * i) / steps);
    if (centre[2] < centreHeight(body, inclination) - 1e-9) return from + (span * (i - 1)) / steps;
  }
  return from + span;
}

/** Free flight in the plane, so long before or after a known pose. */
export function coast(known: Pose, gravity: number, time: number): Pose {
  const [x, y, z] = known.centre;
  const [vx, vy, vz] = known.velocity;
  const [c, , s] = planeRotation(-known.spin[1] * time);
  const [a, b, d, e] = known.rotation;
  return {
    ...known,
    rotation: [c * a - s * d, c * b + s * e, c * d + s * a, c * e - s * b],
    inclination: known.inclination - known.spin[1] * time,
    centre: [x + vx * time, y + vy * time, z + vz * time - (gravity * time * time) / 2],
    velocity: [vx, vy, vz - gravity * time],
    force: [0, 0, 0],
    inContact: false,
  };
}
