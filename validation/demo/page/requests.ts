// SPDX-License-Identifier: GPL-3.0-or-later
// The requests that the page makes, and a scene as their arguments.
import { DEFAULT_PARAMETERS, bodyOf, dampingOf, isInPlane, setBody, type Parameters, type Quantity } from "./parameters";

export type Path = "sequence" | "angles" | "explain" | "simulate" | "compare" | "scene" | "file";
export type Argument = string | number | boolean | readonly number[];
export interface Request {
  path: Path;
  body: { [key: string]: Argument };
}

/** Digits asked of the continuous model: what the table shows, and a time history of moderate length. */
export const CONTINUOUS_DIGITS = 4;

/** Of contact forces, at most, about a second: a body that gravity keeps on a damped ground would be followed for minutes. */
const EVALUATIONS = 100_000;

/** A request as one text: the path, and the body with its keys sorted. */
export function keyOf({ path, body }: Request): string {
  return JSON.stringify([path, Object.entries(body).sort(([a], [b]) => (a < b ? -1 : 1))]);
}

export function sequenceRequest(parameters: Parameters): Request {
  // Beside an impact's own restitution and friction no ground is named, and so none of its frictions.
  const extra = Object.entries(parameters.extra).filter(([name]) => parameters.ofGround || !name.endsWith("_friction"));
  return { path: "sequence", body: { ...drop(parameters), ...law(parameters), ...Object.fromEntries(extra) } };
}

/** What decides about the blows, however many of them are asked for. */
export function dropOf(parameters: Parameters): string {
  return keyOf(sequenceRequest({ ...parameters, impacts: 1 }));
}

/** Fewer digits in the equations than the program's six: they are to be read. */
export function explainRequest(parameters: Parameters, impact: number): Request {
  const { body } = sequenceRequest(parameters);
  return { path: "explain", body: { ...body, impact, digits: 4 } };
}

export function simulateRequest(parameters: Parameters): Request {
  const body = { ...drop(parameters), ...ground(parameters) };
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
  return { ...attitude(parameters), ...motion(parameters), gravity, impacts, ...shape(parameters) };
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
  const { drop: given, vx, vy, vz, spinning, wx, wy, wz } = parameters;
  const moved = given === "velocity" ? { velocity: [vx, vy, vz] } : { [given]: parameters[given] };
  return spinning ? { ...moved, angular_velocity: [wx, wy, wz] } : moved;
}

function shape(parameters: Parameters): Request["body"] {
  const { shape: kind, mass, length, radius, width, thickness, isHollow, inertia } = bodyOf(parameters);
  if (kind === "box") return { body: "box", mass, size: [length, width, thickness] };
  return { body: "rod", mass, length, radius, ...(isHollow ? { inertia: inertia.join(",") } : {}) };
}

export type SceneArguments = Readonly<Record<string, Argument>>;

/** The number that a text says; blank or no number: otherwise. */
export function numberOf(text: string | null | undefined, otherwise: number): number {
  return text == null || text.trim() === "" || !Number.isFinite(Number(text)) ? otherwise : Number(text);
}

/** Arguments that are taken one by one; what is left then has no control on the page. */
class Given extends Map<string, string> {
  take(name: string): string | undefined {
    const text = this.get(name);
    this.delete(name);
    return text;
  }

  number(name: string, otherwise: number): number {
    return numberOf(this.take(name), otherwise);
  }

  /** Numbers with "," or "x" between them, put in the places of these quantities. */
  list(name: string, parameters: Parameters, places: readonly Quantity[]): boolean {
    const text = this.take(name);
    text?.split(/[,x]/).forEach((part, i) => {
      const place = places[i];
      if (place) parameters[place] = numberOf(part, parameters[place]);
    });
    return text !== undefined;
  }
}

/** Without one of these `clatter simulate` refuses a scene, and the page draws the discrete model alone. */
export function namesGround(names: Iterable<string>): boolean {
  return [...names].some((name) => ["stiffness", "modulus", "floor", "curve"].includes(name));
}

/** The program's, where none is given. */
export function usualGravity({ drop }: Parameters): number {
  return drop === "height" || drop === "clearance" ? 9.81 : 0;
}

/** Without a ground in the scene the page keeps its own, whose damping follows from the restitution. */
export function parametersOf(given: SceneArguments): Parameters {
  const parameters: Parameters = { ...DEFAULT_PARAMETERS };
  const texts = Object.entries(given).map(([name, value]) => [name, Array.isArray(value) ? value.join(",") : String(value)] as const);
  const left = new Given(texts);
  setBody(parameters, left.take("body") === "box" ? "own-box" : "own-rod");
  for (const name of ["mass", "length", "radius"] as const) parameters[name] = left.number(name, parameters[name]);
  left.list("size", parameters, ["length", "width", "thickness"]);
  takeAttitude(left, parameters);
  takeMotion(left, parameters);
  parameters.gravity = left.number("gravity", usualGravity(parameters));
  parameters.impacts = left.number("impacts", DEFAULT_PARAMETERS.impacts);
  const restitutionLaw = left.take("restitution_law");
  parameters.ofGround = restitutionLaw === "viscoelastic";
  if (restitutionLaw !== undefined && !parameters.ofGround) left.set("restitution_law", restitutionLaw);
  parameters.e = left.number("restitution", 1);
  takeContact(left, parameters);
  parameters.planar = left.take("planar") === "true";
  parameters.extra = Object.fromEntries(left);
  // The page keeps a motion in a plane only where nothing takes it out; a file may do so anywhere.
  if (parameters.planar && !isInPlane(parameters)) parameters.extra = { ...parameters.extra, planar: "true" };
  return parameters;
}

function takeAttitude(left: Given, parameters: Parameters): void {
  if (left.has("orientation")) parameters.turn = "orientation";
  else if (left.has("attitude")) parameters.turn = "attitude";
  else if (left.has("tilt")) parameters.turn = "tilted";
  for (const name of ["angle", "tilt", "orientation"] as const) parameters[name] = left.number(name, parameters[name]);
  left.list("attitude", parameters, ["q0", "q1", "q2", "q3"]);
}

/** A velocity to the right beside a speed is a velocity, a spin in the plane one in space. */
function takeMotion(left: Given, parameters: Parameters): void {
  parameters.spinning = left.list("angular_velocity", parameters, ["wx", "wy", "wz"]);
  if (left.has("spin")) {
    parameters.spinning = true;
    parameters.wy = left.number("spin", 0);
  }
  parameters.drop = (["height", "clearance"] as const).find((name) => left.has(name)) ?? "speed";
  for (const name of ["speed", "height", "clearance"] as const) parameters[name] = left.number(name, parameters[name]);
  if (parameters.drop === "speed" && left.has("tangential_velocity")) {
    parameters.drop = "velocity";
    parameters.vx = left.number("tangential_velocity", 0);
    parameters.vz = -parameters.speed;
  }
  if (left.list("velocity", parameters, ["vx", "vy", "vz"])) parameters.drop = "velocity";
}

/** One friction serves both models; where they differ the ground's stay arguments of their own. */
function takeContact(left: Given, parameters: Parameters): void {
  const ratio = left.take("impulse_ratio");
  if (ratio !== undefined && Number(ratio) !== 0) left.set("impulse_ratio", ratio);
  const given = left.take("friction");
  parameters.friction = numberOf(given, 0);
  if (!left.has("stiffness")) return;
  parameters.stiffness = left.number("stiffness", DEFAULT_PARAMETERS.stiffness);
  parameters.damping = left.number("damping", 0);
  parameters.follow = false;
  const names = ["static_friction", "sliding_friction"] as const;
  const own = names.map((name) => left.number(name, 0));
  if (given === undefined && parameters.ofGround) parameters.friction = own[1] ?? 0;
  if (own.some((coefficient) => coefficient !== parameters.friction)) names.forEach((name, i) => left.set(name, String(own[i])));
}
