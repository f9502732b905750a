// SPDX-License-Identifier: GPL-3.0-or-later
// The requests that the page makes.
import { dampingOf } from "./restitution";
import { bodyOf, isInPlane, type Parameters } from "./parameters";

export type Path = "sequence" | "angles" | "explain" | "simulate" | "compare" | "scene" | "file";
export type Argument = string | number | boolean | number[];
export interface Request {
  path: Path;
  body: { [key: string]: Argument };
}

/** Digits asked of the continuous model: what the table shows, and a time history of moderate length. */
export const CONTINUOUS_DIGITS = 4;

/** Of contact forces, at most, about a second: a body that gravity keeps on a damped ground would be followed for minutes. */
const EVALUATIONS = 100_000;

/** A request as one text: the path, a blank, and the body with its keys sorted. */
export function keyOf({ path, body }: Request): string {
  return `${path} ${canonical(body)}`;
}

function canonical(body: Request["body"]): string {
  return JSON.stringify(Object.fromEntries(Object.entries(body).sort(([a], [b]) => (a < b ? -1 : 1))));
}

export function sequenceRequest(parameters: Parameters): Request {
  const body = { ...drop(parameters), ...shape(parameters) };
  return { path: "sequence", body: { ...body, ...law(parameters), ...extraOfDiscrete(parameters) } };
}

/** Beside an impact's own restitution and friction no ground is named, and so none of its frictions. */
function extraOfDiscrete({ ofGround, extra }: Parameters): Request["body"] {
  return Object.fromEntries(Object.entries(extra).filter(([name]) => ofGround || !name.endsWith("_friction")));
}

/** Fewer digits in the equations than the program's six: they are to be read. */
export function explainRequest(parameters: Parameters, impact: number): Request {
  const { body } = sequenceRequest(parameters);
  return { path: "explain", body: { ...body, impact, digits: 4 } };
}

export function simulateRequest(parameters: Parameters): Request {
  const body = { ...drop(parameters), ...shape(parameters), ...ground(parameters) };
  const run = { digits: CONTINUOUS_DIGITS, planar: parameters.planar && isInPlane(parameters), history: true, evaluation_limit: EVALUATIONS };
  // A law that relates a coefficient goes with it, in the scene of either model.
  const law = "restitution_law" in parameters.extra ? { restitution: parameters.e } : {};
  return { path: "simulate", body: { ...body, ...run, ...law, ...parameters.extra } };
}

/** A scene file of what both models are asked. */
export function fileRequest(parameters: Parameters): Request {
  const both = { ...sequenceRequest(parameters).body, ...ground(parameters), ...parameters.extra };
  return { path: "file", body: parameters.planar && isInPlane(parameters) ? { ...both, planar: true } : both };
}

export function sceneRequest(name: string, text: string): Request {
  return { path: "scene", body: { name, text } };
}

/** What the discrete model takes: the ground, or restitution and friction of their own. */
function law(parameters: Parameters): Request["body"] {
  if (parameters.ofGround) return ground(parameters);
  const { e, friction: coefficient } = parameters;
  return coefficient === 0 ? { restitution: e } : { restitution: e, friction: coefficient };
}

function ground(parameters: Parameters): Request["body"] {
  const { stiffness, friction: coefficient } = parameters;
  const damping = dampingOf(parameters);
  return {
    stiffness, ...(damping === 0 ? {} : { damping }),
    ...(coefficient === 0 ? {} : { static_friction: coefficient, sliding_friction: coefficient }),
  };
}

/** G = g L/v², the one number by which gravity enters the map of contact angles. */
export function gravityNumber(parameters: Parameters, speed: number): number {
  return (parameters.gravity * bodyOf(parameters).length) / speed ** 2;
}

export function anglesRequest(gravity: number, e: number, from: number, to: number, count: number): Request {
  return { path: "angles", body: { from, to, count, gravity_number: gravity, restitution: e } };
}

function drop(parameters: Parameters): Request["body"] {
  const { gravity, impacts } = parameters;
  return { ...attitude(parameters), ...motion(parameters), gravity, impacts };
}

function attitude({ turn, angle, tilt, orientation, q0, q1, q2, q3 }: Parameters): Request["body"] {
  switch (turn) {
    case "plane": return { angle };
    case "tilted": return { angle, tilt };
    case "orientation": return { orientation };
    case "attitude": return { attitude: [q0, q1, q2, q3] };
  }
}

function motion(parameters: Parameters): Request["body"] {
  const { drop: given, speed, height, vx, vy, vz, spinning, wx, wy, wz } = parameters;
  const moved = given === "velocity" ? { velocity: [vx, vy, vz] } : given === "height" ? { height } : { speed };
  return spinning ? { ...moved, angular_velocity: [wx, wy, wz] } : moved;
}

function shape(parameters: Parameters): Request["body"] {
  const { shape: kind, mass, length, radius, width, thickness, isHollow, inertia } = bodyOf(parameters);
  if (kind === "box") return { body: "box", mass, size: [length, width, thickness] };
  return { body: "rod", mass, length, radius, ...(isHollow ? { inertia: inertia.join(",") } : {}) };
}
