// SPDX-License-Identifier: GPL-3.0-or-later
// The scenes of an offline copy and the requests whose answers it has to hold.
import { type BodyName } from "./body";
import { MAP_RANGE } from "./map_range";
import { anglesRequest, canonical, explainRequest, gravityNumber, keyOf, sequenceRequest, simulateRequest } from "./requests";
import { firstSpeed, restitutionOf } from "./restitution";
import { DEFAULT_PARAMETERS, setBody, type Parameters } from "./parameters";

export interface Scene {
  name: string;
  title: string;
  parameters: Parameters;
}

interface OfflineScene extends Scene {
  angles: number[];
  requests: { path: string; body: unknown; key: string }[];
}

function scene(name: string, title: string, body: BodyName, changes: Partial<Parameters>): Scene {
  const parameters = { ...DEFAULT_PARAMETERS };
  setBody(parameters, body);
  return { name, title, parameters: Object.assign(parameters, changes) };
}

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
  scene("box-edge", "Box along an edge", "own-box", {
    turn: "orientation", orientation: 8, drop: "velocity", vx: 0.2, vy: 0.1, vz: -2, spinning: true, wx: 1, wy: 2, wz: 0,
    gravity: 9.81, e: 0.8, friction: 0.3, stiffness: 1e9, impacts: 3,
  }),
];

/** So much of a scene fits into an offline copy of 2 MB: a phone's contacts and flights take many samples. */
const OFFLINE: Readonly<Record<string, { angles: number[]; impacts: number }>> = {
  rod: { angles: [5, 10, 15, 20, 25, 30, 45, 60], impacts: 3 },
  "rod-gravity": { angles: [5, 10, 20, 45], impacts: 3 },
  "thick-rod": { angles: [10, 30], impacts: 3 },
  "phone-damped": { angles: [10, 20, 30], impacts: 3 },
  "phone-elastic": { angles: [10, 30], impacts: 2 },
  "phone-corner": { angles: [30], impacts: 2 },
};
const EXPLAINED_IMPACTS = 2;

export function offlineScenes(): OfflineScene[] {
  return SCENES.filter(({ name }) => name in OFFLINE).map(({ name, title, parameters: online }) => {
    const { angles, impacts } = OFFLINE[name] ?? { angles: [], impacts: 3 };
    const parameters = { ...online, impacts, angle: angles.includes(online.angle) ? online.angle : (angles[0] ?? 10) };
    const { from, to, count } = MAP_RANGE;
    // The map is that of the thin rod: for other bodies it is not worth its room.
    const map = anglesRequest(gravityNumber(parameters, firstSpeed(parameters)), restitutionOf(parameters), from, to, count);
    const all = [
      ...(parameters.body === "rod" ? [map] : []),
      ...angles.flatMap((angle) => {
        const at = { ...parameters, angle };
        const explained = Array.from({ length: EXPLAINED_IMPACTS }, (_, i) => explainRequest(at, i + 1));
        return [sequenceRequest(at), simulateRequest(at), ...explained];
      }),
    ];
    const requests = all.map((request) => ({
      path: request.path, body: JSON.parse(canonical(request.body)) as unknown, key: keyOf(request),
    }));
    return { name, title, parameters, angles, requests };
  });
}
