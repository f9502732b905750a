// SPDX-License-Identifier: GPL-3.0-or-later
// The attitude that the situation gives, for the picture and for the height of a fall.
import type { Body } from "./body";
import type { Parameters } from "./parameters";
import { normalised, product, turnAbout, planeRotation, type Rotation, type Vector } from "./rotation";

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
