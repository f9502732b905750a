// The requests that the page makes. Both the page and its build use them, so that the keys of an offline copy agree.
import { CONTINUOUS_RADIUS } from "./body";
import { dampingOf } from "./restitution";
import { bodyOf, type Parameters } from "./state";

export type Path = "sequence" | "angles" | "explain" | "simulate";
export type Json = string | number | boolean | null | Json[] | { [key: string]: Json };
export interface Request {
  path: Path;
  body: { [key: string]: Json };
}

/** Digits asked of the continuous model: what the table shows, and a time history of moderate length. */
export const CONTINUOUS_DIGITS = 4;

/** A request as one text: the path, a blank, and the body with its keys sorted. */
export function keyOf({ path, body }: Request): string {
  return `${path} ${canonical(body)}`;
}

export function canonical(body: Request["body"]): string {
  return JSON.stringify(Object.fromEntries(Object.entries(body).sort(([a], [b]) => (a < b ? -1 : 1))));
}

export function sequenceRequest(parameters: Parameters): Request {
  const body = { ...drop(parameters), ...shape(parameters, 0), restitution: parameters.e };
  return { path: "sequence", body: parameters.friction === 0 ? body : { ...body, friction: parameters.friction } };
}

/** Fewer digits in the equations than the program's six: they are to be read. */
export function explainRequest(parameters: Parameters, impact: number): Request {
  const { body } = sequenceRequest(parameters);
  return { path: "explain", body: { ...body, impact, digits: 4 } };
}

export function simulateRequest(parameters: Parameters): Request {
  const { stiffness, friction, planar } = parameters;
  const body: Request["body"] = {
    ...drop(parameters), ...shape(parameters, CONTINUOUS_RADIUS), stiffness, digits: CONTINUOUS_DIGITS, planar, history: true,
  };
  const damping = dampingOf(parameters);
  if (damping !== 0) body["damping"] = damping;
  if (friction !== 0) Object.assign(body, { static_friction: friction, sliding_friction: friction });
  return { path: "simulate", body };
}

/** G = g L/v², the one number by which gravity enters the map of contact angles. */
export function gravityNumber(parameters: Parameters, speed: number): number {
  return (parameters.gravity * bodyOf(parameters).length) / speed ** 2;
}

export function anglesRequest(gravity: number, e: number, from: number, to: number, count: number): Request {
  return { path: "angles", body: { from, to, count, gravity_number: gravity, restitution: e } };
}

function drop(parameters: Parameters): Request["body"] {
  const { angle, gravity, impacts } = parameters;
  return { angle, gravity, impacts, [parameters.drop]: parameters[parameters.drop] };
}

function shape(parameters: Parameters, leastRadius: number): Request["body"] {
  const { shape: kind, mass, length, radius, width, thickness } = bodyOf(parameters);
  if (kind === "box") return { body: "box", mass, size: [length, width, thickness] };
  return { body: "rod", mass, length, radius: radius === 0 ? leastRadius : radius };
}
