// SPDX-License-Identifier: GPL-3.0-or-later
// The situation: all that the two models need, what follows from that, and the scenes to choose from. SI units, angles in degrees.
import { BODIES, centreHeight, uniformBody, type Body, type BodyName } from "./body";
import { normalised, planeRotation, product, turnAbout, type Rotation, type Vector } from "./rotation";

export const QUANTITIES = ["angle", "tilt", "orientation", "q0", "q1", "q2", "q3", "speed", "height", "clearance", "vx", "vy", "vz",
  "wx", "wy", "wz", "gravity", "e", "friction", "stiffness", "damping", "impacts",
  "mass", "length", "radius", "width", "thickness"] as const;
export type Quantity = (typeof QUANTITIES)[number];

/** How the attitude at the first touch is given: an inclination; with a tilt before it; a box's face, edge or corner that
 *  points down; Euler parameters, body to world, scalar first. */
export const TURNS = ["plane", "tilted", "orientation", "attitude"] as const;
/** What is given of the motion: the speed at the first touch, the height of release or that of the lowest point then, or the velocity at the touch. */
export const DROPS = ["speed", "height", "clearance", "velocity"] as const;

export interface Choices {
  body: BodyName;
  turn: (typeof TURNS)[number];
  drop: (typeof DROPS)[number];
  /** The body turns at the first touch, by wx, wy, wz, world components. */
  spinning: boolean;
  /** The ground's damping is that which gives the coefficient of restitution e. */
  follow: boolean;
  /** Restitution and friction of the discrete model are the ground's: e follows from its damping. */
  ofGround: boolean;
  planar: boolean;
}

export interface Parameters extends Record<Quantity, number>, Choices {
  /** Arguments of a scene file that the page has no control for, as texts. */
  extra: Readonly<Record<string, string>>;
}

export const DEFAULT_PARAMETERS: Parameters = {
  body: "rod", turn: "plane", drop: "speed", spinning: false, angle: 10, tilt: 0, orientation: 19, q0: 1, q1: 0, q2: 0, q3: 0,
  speed: 1, height: 1, clearance: 1, vx: 0, vy: 0, vz: -1, wx: 0, wy: 0, wz: 0, gravity: 0, e: 1, friction: 0,
  stiffness: 1e10, damping: 0, follow: true, ofGround: false, impacts: 6, planar: true,
  mass: 1, length: 1, radius: 0, width: 0.07, thickness: 0.01, extra: {},
};

/** A uniform body of these sizes; the program's answer says more of one whose mass or inertia is given. */
export function bodyOf(parameters: Parameters): Body {
  const { mass, length, radius, width, thickness } = parameters;
  if (parameters.body === "own-rod") return uniformBody({ shape: "rod", mass, length, radius, width: 0, thickness: 0 });
  if (parameters.body === "own-box") return uniformBody({ shape: "box", mass, length, radius: 0, width, thickness });
  return uniformBody(BODIES[parameters.body].size);
}

/** About the long axis, before the inclination [°]. */
export function tiltOf({ turn, tilt }: Parameters): number {
  return turn === "tilted" ? tilt : 0;
}

/** A size means something only for a body of one's own, a height only if it is what is given. */
export function isUsed(parameters: Parameters, quantity: Quantity): boolean {
  const { turn, drop, body } = parameters;
  switch (quantity) {
    case "angle": return turn === "plane" || turn === "tilted";
    case "tilt": return turn === "tilted";
    case "orientation": return turn === "orientation";
    case "q0": case "q1": case "q2": case "q3": return turn === "attitude";
    case "speed": case "height": case "clearance": return drop === quantity;
    case "vx": case "vy": case "vz": return drop === "velocity";
    case "wx": case "wy": case "wz": return parameters.spinning;
    case "mass": case "length": return body.startsWith("own");
    case "radius": return body === "own-rod";
    case "width": case "thickness": return body === "own-box";
    default: return true;
  }
}

/** Whether nothing that is given takes the body out of the plane of x and z. */
export function isInPlane(parameters: Parameters): boolean {
  const { turn, tilt, q1, q3, drop, vy, spinning, wx, wz, extra } = parameters;
  const turned = turn === "plane" || (turn === "tilted" && tilt === 0) || (turn === "attitude" && q1 === 0 && q3 === 0);
  const moved = !(drop === "velocity" && vy !== 0) && !(spinning && (wx !== 0 || wz !== 0));
  return turned && moved && !("centre" in extra) && !("inertia" in extra);
}

/** A thin rod without friction that comes straight down: its angles follow from G and e alone. */
export function isThinRod(parameters: Parameters): boolean {
  const { body, radius, friction, ofGround, drop, vx, spinning, turn, extra } = parameters;
  const isThin = body === "rod" || (body === "own-rod" && radius === 0);
  const comesDown = !spinning && !(drop === "velocity" && vx !== 0) && (turn === "plane" || turn === "tilted");
  return isThin && friction === 0 && !ofGround && comesDown && isInPlane(parameters) && Object.keys(extra).length === 0;
}

/** Chooses a body; one's own starts with sizes that make sense for its shape. */
export function setBody(parameters: Parameters, name: BodyName): void {
  parameters.body = name;
  const { mass, length, radius, width, thickness } = BODIES[name].size;
  Object.assign(parameters, { mass, length, radius, width, thickness });
  if (BODIES[name].size.shape !== "box" && parameters.turn === "orientation") parameters.turn = "plane";
}

const DEGREE = Math.PI / 180;

/** Signs of the coordinates of a box's 6 faces, 12 edges and 8 corners, in the order of the program's numbers. */
const PARTS: readonly Vector[] = (() => {
  const signs = [-1, 0, 1];
  const all = signs.flatMap((x) => signs.flatMap((y) => signs.map((z): Vector => [x, y, z])));
  const size = (part: Vector): number => part.filter((sign) => sign !== 0).length;
  const axis = (part: Vector): number => part.findIndex((sign) => sign !== 0);
  const faces = all.filter((part) => size(part) === 1).sort((a, b) => axis(a) - axis(b));
  return [...faces, ...all.filter((part) => size(part) === 2), ...all.filter((part) => size(part) === 3)];
})();

/** "corner -x-y-z" of an orientation; "" if there is none of this number. */
export function orientationName(orientation: number): string {
  const part = PARTS[orientation - 1];
  if (!part) return "";
  const kind = ["", "face", "edge", "corner"][part.filter((sign) => sign !== 0).length] ?? "";
  return `${kind} ${part.map((sign, i) => (sign === 0 ? "" : (sign < 0 ? "−" : "+") + "xyz".charAt(i))).join("")}`;
}

export function attitudeOf(parameters: Parameters, body: Body): Rotation {
  const { turn, angle, tilt, orientation, q0, q1, q2, q3 } = parameters;
  switch (turn) {
    case "plane": return planeRotation(angle * DEGREE);
    case "tilted": return product(planeRotation(angle * DEGREE), turnAbout(0, tilt * DEGREE));
    case "orientation": return turnedDown(PARTS[orientation - 1] ?? [0, 0, -1], body);
    case "attitude": return normalised([q0, q1, q2, q3]);
  }
}

/** The shortest turn that puts a part of a box right below its geometric centre. */
function turnedDown([x, y, z]: Vector, { length, width, thickness }: Body): Rotation {
  const [a, b, c] = [x * length, y * width, z * thickness];
  const across = Math.hypot(a, b);
  if (across === 0) return c < 0 ? [1, 0, 0, 0] : [0, 1, 0, 0];
  const half = Math.atan2(across, -c) / 2;
  const part = Math.sin(half) / across;
  return [Math.cos(half), -b * part, a * part, 0];
}

/** The least coefficient of restitution that the page gives the ground a damping for. */
export const LEAST = 0.05;

/**
 * Of the exact relation for one frictionless contact whose depth is one number, s = (c_G/k_G) v:
 *     ln[(1 + s)/(1 − s e)] − s (1 + e) = 0,   negative below the root of s and of e, positive or no number beyond it.
 */
const residual = (s: number, e: number): number => Math.log1p(s) - Math.log1p(-s * e) - s * (1 + e);

/** Where a function stops being negative, by halves. */
function rootOf(f: (x: number) => number, low: number, high: number): number {
  for (let i = 0; i < 100; i++) {
    const middle = (low + high) / 2;
    if (f(middle) < 0) low = middle;
    else high = middle;
  }
  return low;
}

function dampingFor(e: number, stiffness: number, speed: number): number {
  if (!(e < 1) || !(speed > 0)) return 0;
  // The relation has its root below 1/e; at e = 0 damping would have to be infinite.
  const wanted = Math.max(e, LEAST);
  const s = rootOf((guess) => residual(guess, wanted), 1e-9, (1 - 1e-12) / wanted);
  return Number(((s * stiffness) / speed).toPrecision(4));
}

/** Downward speed of the centre of mass at the first touch [m/s]; 0 if the body is not released above that. */
export function firstSpeed(parameters: Parameters): number {
  if (parameters.drop === "speed") return parameters.speed;
  if (parameters.drop === "velocity") return Math.max(0, -parameters.vz);
  const body = bodyOf(parameters);
  const fall = parameters.drop === "clearance" ? parameters.clearance : parameters.height - centreHeight(body, attitudeOf(parameters, body));
  return Math.sqrt(Math.max(0, 2 * parameters.gravity * fall));
}

/** The coefficient of restitution that damping gives at a speed, to the digits that a control shows. */
function restitutionFor(damping: number, stiffness: number, speed: number): number {
  const s = (damping / stiffness) * speed;
  return s > 0 ? Number(rootOf((e) => residual(s, e), 0, Math.min(1, 1 / s)).toPrecision(3)) : 1;
}

/** The coefficient of restitution of the first impact: as given, or as the ground gives it. */
export function restitutionOf(parameters: Parameters): number {
  if (!parameters.ofGround) return parameters.e;
  return restitutionFor(parameters.damping, parameters.stiffness, firstSpeed(parameters));
}

/** Damping of the ground that the continuous model gets [N s/m⁴]. */
export function dampingOf(parameters: Parameters): number {
  if (!parameters.follow) return parameters.damping;
  return dampingFor(parameters.e, parameters.stiffness, firstSpeed(parameters));
}

export interface Scene {
  name: string;
  title: string;
  parameters: Parameters;
}

function scene(name: string, title: string, body: BodyName, changes: Partial<Parameters>): Scene {
  const parameters = { ...DEFAULT_PARAMETERS };
  setBody(parameters, body);
  return { name, title, parameters: Object.assign(parameters, changes) };
}

const FALL: Partial<Parameters> = { drop: "height", gravity: 9.81 };
const PHONE: Partial<Parameters> = { drop: "height", height: 1, gravity: 9.81, stiffness: 1e8, follow: false, ofGround: true };

export const SCENES: readonly Scene[] = [
  scene("rod", "Elastic rod", "rod", {}),
  scene("rod-gravity", "Rod, gravity, e = 0.8", "rod", { gravity: 9.81, e: 0.8 }),
  scene("thick-rod", "Thick rod", "thick-rod", { gravity: 9.81, e: 0.9 }),
  scene("phone-damped", "Phone, damped", "phone", { ...PHONE, friction: 0.075, damping: 1e7 }),
  scene("phone-elastic", "Phone, elastic", "phone", { ...PHONE, damping: 0 }),
  scene("phone-corner", "Phone on its corner", "phone", {
    ...PHONE, turn: "tilted", angle: 30, tilt: 40, friction: 0.075, damping: 1e7, impacts: 3,
  }),
  scene("coin", "Coin, nearly flat", "coin", { ...FALL, height: 0.1, angle: 87, e: 0.6, stiffness: 1e12 }),
  scene("tube", "Tube with lids", "tube", { ...FALL, height: 0.3, angle: 15, e: 0.6, stiffness: 1e9 }),
  scene("die", "Die on its corner", "die", { ...FALL, turn: "tilted", height: 0.2, angle: 35, tilt: 30, e: 0.5, friction: 0.25, stiffness: 1e12, impacts: 3 }),
  scene("plate", "Steel plate", "plate", { ...FALL, height: 0.2, angle: 6, e: 0.4, stiffness: 1e11 }),
  scene("box-edge", "Box along an edge", "own-box", {
    turn: "orientation", orientation: 8, drop: "velocity", vx: 0.2, vy: 0.1, vz: -2, spinning: true, wx: 1, wy: 2, wz: 0,
    gravity: 9.81, e: 0.8, friction: 0.3, stiffness: 1e9, impacts: 3,
  }),
];
