// SPDX-License-Identifier: GPL-3.0-or-later
// A body as faces, for pictures that are drawn in lines.
import { THINNEST, type Body } from "./body";
import { cross, plus, rotate, type Rotation, type Vector } from "./rotation";

/** Corners of the faces of a box, or of a rod the rectangle that shows its outline to an eye that looks along
 *  `look`; only faces that are turned towards that eye. World axes, from the geometric centre. */
export function facesOf(body: Body, rotation: Rotation, look: Vector): Vector[][] {
  if (body.shape === "rod") return [rodOutline(body, rotation, look), ...discs(body, rotation, look)];
  const half: Vector = [body.length / 2, body.width / 2, body.thickness / 2];
  return [0, 1, 2].flatMap((axis) => [-1, 1].map((sign) => faceOf(half, axis, sign)))
    .map((face) => ({ normal: rotate(rotation, face.normal), corners: face.corners.map((corner) => rotate(rotation, corner)) }))
    .filter(({ normal }) => dot(normal, look) < 0)
    .map(({ corners }) => corners);
}

function faceOf(half: Vector, axis: number, sign: number): { normal: Vector; corners: Vector[] } {
  const [u, v] = [(axis + 1) % 3, (axis + 2) % 3];
  const corner = (a: number, b: number): Vector => {
    const place: Vector = [0, 0, 0];
    place[axis] = sign * (half[axis] ?? 0);
    place[u] = a * (half[u] ?? 0);
    place[v] = b * (half[v] ?? 0);
    return place;
  };
  const normal: Vector = [0, 0, 0];
  normal[axis] = sign;
  return { normal, corners: [corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1)] };
}

/** The end of a thick rod that is turned towards the eye. */
function discs(body: Body, rotation: Rotation, look: Vector): Vector[][] {
  if (body.radius < 0.03 * body.length) return [];
  return [-1, 1].filter((side) => side * dot(rotate(rotation, [1, 0, 0]), look) < 0).map((side) => Array.from({ length: 24 }, (_none, i) => {
    const turn = (i * Math.PI) / 12;
    return rotate(rotation, [(side * body.length) / 2, body.radius * Math.cos(turn), body.radius * Math.sin(turn)]);
  }));
}

function rodOutline(body: Body, rotation: Rotation, look: Vector): Vector[] {
  const along = rotate(rotation, [body.length / 2, 0, 0]);
  const side = cross(along, look);
  const size = Math.hypot(...side) || 1;
  const across = plus([0, 0, 0], side, Math.max(body.radius, THINNEST * body.length) / size);
  const back = plus([0, 0, 0], along, -1);
  return [plus(back, across, -1), plus(along, across, -1), plus(along, across), plus(back, across)];
}

function dot(a: Vector, b: Vector): number {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
