// SPDX-License-Identifier: GPL-3.0-or-later
// What the picture shows at one time: the bodies of both models, the blow, and the speeds of the ends.
import type { Impact } from "./api";
import { extentOf, isDisc, longHalf, lowestPlace, type Body } from "./body";
import { significant } from "./format";
import { hasEnded, pointMotion, shownTime, type Motion, type Pose } from "./motion";
import type { Orbit } from "./orbit";
import { patchOf, type Patch } from "./patch";
import { plus, rotate, type Rotation, type Vector } from "./rotation";

export const MODELS = ["discrete", "continuous"] as const;
export type ModelName = (typeof MODELS)[number];

export interface Arrow {
  model: ModelName;
  kind: "blow" | "speed";
  from: Vector;
  /** In metres of the picture. */
  vector: Vector;
  isPast?: boolean;
}

/** An angle between the body and the ground where it struck, in the plane of motion. */
export interface Arc {
  at: Vector;
  radius: number;
  /** From the ground, to the side where the body lies [rad]. */
  angle: number;
  toRight: boolean;
}

interface Label {
  model: ModelName;
  kind: "blow" | "end" | "angle" | "held" | "over";
  place: Vector;
  text: string;
  /** Beside its place, outwards, or below it, instead of above it. */
  aside?: "left" | "right" | "below";
}

export interface Frame {
  side: boolean;
  /** Of the picture, or side by side of each model's part. */
  bounds: Record<ModelName, Bounds>;
  /** Whether a body leaves the plane of x and z: then it is looked at from higher up. */
  inSpace: boolean;
  figures: { model: ModelName; body: Body; pose: Pose; isOver?: boolean }[];
  /** Where the body was at the blows until now; or where a hand's tremor would have brought it, what stands out of that and what does not. */
  ghosts: { model: ModelName; body: Body; pose: Pose; tone?: "fan" | "aside" }[];
  arcs: Arc[];
  /** Where the continuous model presses on the ground. */
  patch: Patch | null;
  arrows: Arrow[];
  labels: Label[];
}

export interface Bounds {
  left: number;
  right: number;
  top: number;
  /** Of the middle, along y. */
  depth: number;
  /** How far a body reaches from there towards the eye. */
  deep: number;
}

export interface Motions {
  discrete: Motion | null;
  continuous: Motion | null;
}

/** Sizes that turn impulses, forces and speeds into lengths: the same for a whole run. */
export interface Scales {
  impulse: number;
  force: number;
  speed: number;
}

const STAYS = 0.02; // an impulse, of the whole motion; then it fades
const BLOW_LENGTH = 0.3; // of the largest blow, in lengths of the body
const SPEED_LENGTH = 0.22; // of the largest speed of an end

export function scalesOf(motions: Motions): Scales {
  const impacts = [motions.discrete, motions.continuous].flatMap((motion) => motion?.impacts ?? []);
  const motion = motions.discrete ?? motions.continuous;
  const length = motion ? extentOf(motion.body) : 1;
  const largest = (values: number[]): number => Math.max(1e-12, ...values.map(Math.abs));
  const speeds = impacts.flatMap(({ velocity_after, angular_velocity_after, approach_speed }) =>
    [approach_speed, Math.abs(velocity_after[2]) + (Math.abs(angular_velocity_after[1]) * length) / 2]);
  return {
    impulse: (BLOW_LENGTH * length) / largest(impacts.map((impact) => impact.impulse_normal)),
    force: (BLOW_LENGTH * length) / largest(impacts.map((impact) => impact.peak_force ?? 0)),
    speed: (SPEED_LENGTH * length) / largest(speeds),
  };
}

/**
 * What has to be in view at a time: the bodies and the ground below them. The camera so follows a body that bounces high,
 * and comes close again for the clattering.
 */
function boundsOf(figures: Frame["figures"]): Bounds {
  const bounds = { left: Infinity, right: -Infinity, top: 0, depth: 0, deep: 0 };
  for (const { body, pose } of figures) {
    // Perspective makes the near corner of a broad body stick out.
    const half = Math.max(body.length / 2 + 0.2 * body.width, 0.6 * body.width, 0.6 * body.thickness, 1.2 * body.radius);
    bounds.left = Math.min(bounds.left, pose.centre[0] - half);
    bounds.right = Math.max(bounds.right, pose.centre[0] + half);
    const diagonal = Math.hypot(body.length, body.width, body.thickness, 2 * body.radius);
    bounds.top = Math.max(bounds.top, 1.1 * half, pose.centre[2] + Math.max(half, diagonal / 2) * 1.15);
    bounds.deep = Math.max(bounds.deep, body.width / 2, body.radius);
    bounds.depth += pose.centre[1] / figures.length;
  }
  return figures.length ? bounds : { left: -0.5, right: 0.5, top: 0.5, depth: 0, deep: 0 };
}

/** Side by side each model stands in the middle of its part, both in the same size. */
function boundsOfParts(figures: Frame["figures"], side: boolean): Frame["bounds"] {
  const all = boundsOf(figures);
  if (!side) return { discrete: all, continuous: all };
  const own = (model: ModelName): Bounds => {
    const only = figures.filter((figure) => figure.model === model);
    return only.length ? boundsOf(only) : all;
  };
  const parts = { discrete: own("discrete"), continuous: own("continuous") };
  const half = Math.max(...Object.values(parts).map(({ left, right }) => (right - left) / 2));
  const top = Math.max(parts.discrete.top, parts.continuous.top);
  const sized = ({ left, right, depth, deep }: Bounds): Bounds =>
    ({ left: (left + right) / 2 - half, right: (left + right) / 2 + half, top, depth, deep });
  return { discrete: sized(parts.discrete), continuous: sized(parts.continuous) };
}

/** Whether the axis across the plane of motion is turned out of its place. */
function leavesPlane({ pose }: Frame["figures"][number]): boolean {
  return Math.abs(Math.abs(rotate(pose.rotation, [0, 1, 0])[1]) - 1) > 1e-3;
}

/** The last impact that has begun at a time; null while the body still falls. */
export function impactAt(impacts: readonly Impact[], time: number): Impact | null {
  let last: Impact | null = null;
  for (const impact of impacts) if (impact.start <= time) last = impact;
  return last;
}

export function frameAt(motions: Motions, time: number, scales: Scales, side: boolean, traces: boolean): Frame {
  const frame: Frame = { side, bounds: boundsOfParts([], side), inSpace: false, figures: [], ghosts: [], arcs: [], patch: null, arrows: [], labels: [] };
  for (const model of [...MODELS].reverse()) {
    const motion = motions[model];
    if (!motion) continue;
    const pose = motion.pose(shownTime(motion, time));
    frame.figures.push({ model, body: motion.body, pose, isOver: hasEnded(motion, time) });
    if (hasEnded(motion, time)) {
      const [x, y, z] = pose.centre;
      frame.labels.push({ model, kind: "over", text: `${model} model ends here`, place: [x, y, z + 0.12 * extentOf(motion.body)] });
      continue;
    }
    if (model === "continuous" && pose.inContact) frame.patch = patchOf(motion.body, pose);
    // In the overlay two sets of speeds and names would lie on each other.
    if (side || model === "discrete" || !motions.discrete) addEnds(frame, model, motion.body, pose, scales.speed);
    addBlow(frame, model, motion, pose, time, scales, side || !motions.discrete);
    if (traces && (model === "discrete" || side || !motions.discrete)) addTraces(frame, model, motion, time, scales);
  }
  frame.bounds = boundsOfParts(frame.figures, side);
  frame.inSpace = frame.figures.some(leavesPlane);
  if (traces && !frame.inSpace && motions.discrete && !side && !hasEnded(motions.discrete, time)) addArc(frame, motions.discrete, time);
  return frame;
}

function addEnds(frame: Frame, model: ModelName, body: Body, pose: Pose, scale: number): void {
  const half = longHalf(body);
  for (const [end, side] of [["a", -1], ["b", 1]] as const) {
    const { place, velocity } = pointMotion(body, pose, half.map((part) => side * part) as Vector);
    const vector = velocity.map((v) => v * scale) as Vector;
    frame.arrows.push({ model, kind: "speed", from: place, vector });
    // The ends of a disc are its faces; what moves up and down are its sides.
    if (isDisc(body)) continue;
    const [cx, cy, cz] = pose.centre;
    const out = 1.07;
    frame.labels.push({
      model, kind: "end", text: end,
      place: [cx + (place[0] - cx) * out, cy + (place[1] - cy) * out, cz + (place[2] - cz) * out],
    });
  }
}

function addBlow(frame: Frame, model: ModelName, motion: Motion, pose: Pose, time: number, scales: Scales, side: boolean): void {
  const impact = impactAt(motion.impacts, time);
  if (!impact) return;
  const [x, y, z] = struckPoint(motion, impact);
  const pressing = model === "continuous" && pose.inContact;
  // In the overlay the impulses of both models would lie on each other; a force only while it acts.
  if (model === "continuous" && !pressing && !side) return;
  const [vector, text] = pressing
    ? [pose.force.map((f) => f * scales.force) as Vector, `${significant(pose.force[2], 3)} N`]
    : [impact.impulse.map((part) => part * scales.impulse) as Vector,
      `${significant(impact.impulse_normal, 3)} N·s`];
  const length = extentOf(motion.body);
  const outwards = x < pose.centre[0] ? -1 : 1;
  // In the overlay the force stands beside the discrete model's impulse.
  const isSecond = model === "continuous" && !side;
  const from: Vector = [isSecond ? x + 0.03 * outwards * length : x, y, z];
  frame.arrows.push({ model, kind: "blow", from, vector, isPast: !pressing && time > impact.start + Math.max(impact.duration, STAYS * (motion.end - motion.begin)) });
  if (Math.hypot(...vector) < 0.02 * length) return;
  const label: Label = { model, kind: "blow", text, place: [from[0] + vector[0], from[1] + vector[1], from[2] + vector[2]] };
  frame.labels.push(isSecond ? { ...label, aside: outwards < 0 ? "left" : "right" } : label);
}

/** Silhouettes at the blows, and the impulses of those before the last one. */
function addTraces(frame: Frame, model: ModelName, motion: Motion, time: number, scales: Scales): void {
  const past = motion.impacts.filter(({ start }) => start <= time);
  past.forEach((impact, i) => {
    frame.ghosts.push({ model, body: motion.body, pose: motion.pose(impact.start) });
    if (i < past.length - 1) frame.arrows.push({ model, kind: "blow", from: struckPoint(motion, impact), vector: impact.impulse.map((part) => part * scales.impulse) as Vector, isPast: true });
  });
}

const ARC = 0.26; // radius, in lengths of the body
const ROOMY = 25; // between the body and the ground there is room for a text [degrees]
const ANGLE_NAMES = ["θ", "β", "γ"];

/** θ, β, γ at the last blow. */
function addArc(frame: Frame, motion: Motion, time: number): void {
  const impact = impactAt(motion.impacts, time);
  if (!impact || impact.contact_angle_deg < 0.5 || impact.contact_angle_deg > 89) return;
  const at = struckPoint(motion, impact);
  const toRight = motion.pose(impact.start).centre[0] > at[0];
  const radius = ARC * extentOf(motion.body);
  const angle = (impact.contact_angle_deg * Math.PI) / 180;
  frame.arcs.push({ at, radius, angle, toRight });
  const out = toRight ? radius : -radius;
  const name = ANGLE_NAMES[impact.n - 1];
  const text = `${name ? `${name} = ` : ""}${significant(impact.contact_angle_deg, 3)}°`;
  const label = { model: "discrete", kind: "angle", text } as const;
  if (impact.contact_angle_deg > ROOMY) {
    const place: Vector = [at[0] + out * Math.cos(angle / 2), at[1], radius * Math.sin(angle / 2)];
    frame.labels.push({ ...label, place, aside: toRight ? "right" : "left" });
  } else {
    // The body would cover it: it stands on the ground before the body.
    const deep = Math.max(motion.body.width / 2, motion.body.radius);
    frame.labels.push({ ...label, place: [at[0] + 1.25 * out, at[1] - deep, 0], aside: "below" });
  }
}

/** The body in the hand, `over` a place of the ground: nothing moves, and the picture stays as it was when it was taken. */
export function heldFrame(body: Body, rotation: Rotation, height: number, text: string, over: readonly [number, number] = [0, 0], taken?: Frame): Frame {
  const [x, y] = over;
  const pose: Pose = { centre: [x, y, height], rotation, velocity: [0, 0, 0], spin: [0, 0, 0], inclination: 0, force: [0, 0, 0], inContact: false };
  const figures: Frame["figures"] = [{ model: "discrete", body, pose }];
  const length = extentOf(body);
  const bounds = { left: -0.9 * length, right: 0.9 * length, top: Math.max(1.5 * length, height + 0.6 * length), depth: 0, deep: Math.max(body.width / 2, body.radius) };
  const frame: Frame = {
    side: false, bounds: taken?.bounds ?? { discrete: bounds, continuous: bounds }, inSpace: taken?.inSpace ?? leavesPlane({ model: "discrete", body, pose }), figures, ghosts: [], arcs: [], patch: null, arrows: [],
    labels: [{ model: "discrete", kind: "held", place: [x, y, height + 0.3 * length], text }],
  };
  addEnds(frame, "discrete", body, pose, 0);
  return frame;
}

function struckPoint(motion: Motion, impact: Impact): Vector {
  const { centre, rotation } = motion.pose(impact.start);
  const [x, y] = plus(centre, lowestPlace(motion.body, rotation));
  return [x, y, 0];
}

/** Place in the picture, from its upper left corner [px]. */
export interface Projection {
  x: number;
  y: number;
}

export interface View {
  resize(width: number, height: number): void;
  draw(frame: Frame, orbit: Orbit): void;
  project(model: ModelName, point: Vector, side: boolean): Projection;
}
