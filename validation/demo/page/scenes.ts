// SPDX-License-Identifier: GPL-3.0-or-later
// The scenes to choose from.
import type { BodyName } from "./body";
import { DEFAULT_PARAMETERS, setBody, type Parameters } from "./parameters";

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
