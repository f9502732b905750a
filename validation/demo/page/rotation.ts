// SPDX-License-Identifier: GPL-3.0-or-later
// Vectors, and rotations by Euler parameters.

export type Vector = [number, number, number];
/** Euler parameters, the scalar first. */
export type Rotation = [number, number, number, number];

export function rotate([w, x, y, z]: Rotation, [a, b, c]: Vector): Vector {
  const tx = 2 * (y * c - z * b);
  const ty = 2 * (z * a - x * c);
  const tz = 2 * (x * b - y * a);
  return [a + w * tx + y * tz - z * ty, b + w * ty + z * tx - x * tz, c + w * tz + x * ty - y * tx];
}

/** From the world to the body. */
export function rotateBack([w, x, y, z]: Rotation, vector: Vector): Vector {
  return rotate([w, -x, -y, -z], vector);
}

/** First the second, then the first. */
export function product([a, b, c, d]: Rotation, [e, f, g, h]: Rotation): Rotation {
  return [a * e - b * f - c * g - d * h, a * f + b * e + c * h - d * g, a * g - b * h + c * e + d * f, a * h + b * g - c * f + d * e];
}

/** About one of the axes, by an angle [rad]. */
export function turnAbout(axis: 0 | 1 | 2, angle: number): Rotation {
  const turn: Rotation = [Math.cos(angle / 2), 0, 0, 0];
  turn[axis + 1] = Math.sin(angle / 2);
  return turn;
}

/** About the axis across the plane of motion; an inclination is the negative of its angle [rad]. */
export function planeRotation(inclination: number): Rotation {
  return turnAbout(1, -inclination);
}

export function normalised(rotation: Rotation): Rotation {
  const norm = Math.hypot(...rotation);
  return rotation.map((part) => part / norm) as Rotation;
}

/** How far the long axis leans: > 0 if end a is lower; in the plane of motion also past the upright [rad]. */
export function inclinationOf(rotation: Rotation): number {
  const [x, , z] = rotate(rotation, [1, 0, 0]);
  const isInPlane = Math.hypot(rotation[1], rotation[3]) < 1e-9;
  return isInPlane ? Math.atan2(z, x) : Math.asin(Math.max(-1, Math.min(1, z)));
}

export function slerp(a: Rotation, b: Rotation, part: number): Rotation {
  const dot = a.reduce((sum, value, i) => sum + value * (b[i] ?? 0), 0);
  const angle = Math.acos(Math.min(1, Math.abs(dot)));
  const [p, q] = angle < 1e-6 ? [1 - part, part] : [Math.sin((1 - part) * angle), Math.sin(part * angle)];
  const sign = dot < 0 ? -1 : 1;
  return normalised(a.map((value, i) => p * value + sign * q * (b[i] ?? 0)) as Rotation);
}

export function cross([a, b, c]: Vector, [d, e, f]: Vector): Vector {
  return [b * f - c * e, c * d - a * f, a * e - b * d];
}

export function plus([a, b, c]: Vector, [d, e, f]: Vector, times = 1): Vector {
  return [a + times * d, b + times * e, c + times * f];
}
