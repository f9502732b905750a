// SPDX-License-Identifier: GPL-3.0-or-later
// The situation: all that the two models need. SI units, angles in degrees.
import { BODIES, uniformBody, type Body, type BodyName } from "./body";

export const QUANTITIES = ["angle", "tilt", "orientation", "q0", "q1", "q2", "q3", "speed", "height", "vx", "vy", "vz",
  "wx", "wy", "wz", "gravity", "e", "friction", "stiffness", "damping", "impacts",
  "mass", "length", "radius", "width", "thickness"] as const;
export type Quantity = (typeof QUANTITIES)[number];

/** How the attitude at the first touch is given: an inclination; with a tilt before it; a box's face, edge or corner that
 *  points down; Euler parameters, body to world, scalar first. */
export const TURNS = ["plane", "tilted", "orientation", "attitude"] as const;
/** What is given of the motion: the speed at the first touch, the height of release, or the velocity at the touch. */
export const DROPS = ["speed", "height", "velocity"] as const;

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
  speed: 1, height: 1, vx: 0, vy: 0, vz: -1, wx: 0, wy: 0, wz: 0, gravity: 0, e: 1, friction: 0,
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
    case "speed": case "height": return drop === quantity;
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
