// SPDX-License-Identifier: GPL-3.0-or-later
// The falling body: sizes, inertia, and where it touches the ground. Lengths in m, masses in kg.
import { plus, rotate, rotateBack, type Inertia, type Rotation, type Vector } from "./rotation";

export type BodyName = "rod" | "thick-rod" | "phone" | "coin" | "tube" | "die" | "plate" | "own-rod" | "own-box";
/** What is drawn on a body; both models know its sizes alone. */
export type Look = "phone" | "coin" | "tube" | "die";

export interface Size {
  readonly shape: "rod" | "box";
  readonly mass: number;
  readonly length: number;
  /** Of a rod; 0 is the thin rod of the discrete model. */
  readonly radius: number;
  /** Of a box: across the plane of motion, and upright at an inclination of 0. */
  readonly width: number;
  readonly thickness: number;
  readonly look?: Look;
  /** Of a rod: a thin wall around nothing. */
  readonly isHollow?: boolean;
}

export interface Body extends Size {
  /** Of mass, from the geometric centre, axes of the body. */
  readonly centre: Vector;
  readonly inertia: Inertia;
}

/** A rod without thickness still has to be seen: its radius in a picture, over its length. */
export const THINNEST = 0.008;
/** The continuous model needs a body with a volume: the thin rod gets the radius of the paper's mesh. */
export const CONTINUOUS_RADIUS = 0.01;

export const BODIES: Readonly<Record<BodyName, { title: string; size: Size }>> = {
  rod: { title: "Thin rod, 1 m", size: { shape: "rod", mass: 1, length: 1, radius: 0, width: 0, thickness: 0 } },
  "thick-rod": { title: "Thick rod, 1 m", size: { shape: "rod", mass: 1, length: 1, radius: 0.05, width: 0, thickness: 0 } },
  phone: {
    title: "Phone, 106 mm",
    size: { shape: "box", mass: 0.08814, length: 0.10566, radius: 0, width: 0.04394, thickness: 0.01905, look: "phone" },
  },
  coin: { title: "Coin, 23 mm", size: { shape: "rod", mass: 0.0075, length: 0.00233, radius: 0.011625, width: 0, thickness: 0, look: "coin" } },
  tube: { title: "Tube with lids, 30 cm", size: { shape: "rod", mass: 0.1934, length: 0.3, radius: 0.02, width: 0, thickness: 0, look: "tube", isHollow: true } },
  die: { title: "Die, 16 mm", size: { shape: "box", mass: 0.00483, length: 0.016, radius: 0, width: 0.016, thickness: 0.016, look: "die" } },
  plate: { title: "Steel plate, 20 cm", size: { shape: "box", mass: 0.942, length: 0.2, radius: 0, width: 0.2, thickness: 0.003 } },
  "own-rod": { title: "Rod of your own", size: { shape: "rod", mass: 1, length: 1, radius: 0, width: 0, thickness: 0 } },
  "own-box": { title: "Box of your own", size: { shape: "box", mass: 0.2, length: 0.15, radius: 0, width: 0.07, thickness: 0.01 } },
};

export function uniformBody(size: Size): Body {
  const { shape, mass, length, radius, width, thickness } = size;
  const around = (size.isHollow ? 6 : 3) * radius ** 2;
  const [x, y, z] = shape === "rod" ? [2 * around, around + length ** 2, around + length ** 2]
    : [width ** 2 + thickness ** 2, length ** 2 + thickness ** 2, length ** 2 + width ** 2];
  const part = mass / 12;
  return { ...size, centre: [0, 0, 0], inertia: [part * x, part * y, part * z, 0, 0, 0] };
}

/** The largest extent along an axis of the body. */
export function extentOf({ length, radius, width, thickness }: Size): number {
  return Math.max(length, 2 * radius, width, thickness);
}

/** A rod that is broader than long, as a coin. */
export function isDisc({ shape, length, radius }: Size): boolean {
  return shape === "rod" && 2 * radius > length;
}

/** An inclination as one sees it, and back: a disc that lies flat, whose axis the program's angle is of, leans by 0° [°]. */
export function seenAngle(body: Size, degrees: number): number {
  return isDisc(body) ? Number((90 - degrees).toPrecision(12)) : degrees;
}

/** Whether it can turn over, and strike with ends of its upper side. */
export function hasUpperSide({ shape, radius, thickness }: Size): boolean {
  return shape === "box" ? thickness > 0 : radius > 0;
}

/** The direction in which the body is long, within its plane of motion: from its middle to the one side, body axes [m]. */
export function longHalf(body: Size): Vector {
  return isDisc(body) ? [0, 0, body.radius] : [body.length / 2, 0, 0];
}

/** Corners of a box, from its geometric centre; their names are the signs of their coordinates, as in "-x+y-z". */
export function cornersOf(body: Size): { name: string; place: Vector }[] {
  const sides = [-1, 1];
  const name = (sign: number, axis: string): string => (sign < 0 ? "-" : "+") + axis;
  return sides.flatMap((x) => sides.flatMap((y) => sides.map((z) => ({
    name: name(x, "x") + name(y, "y") + name(z, "z"),
    place: [(x * body.length) / 2, (y * body.width) / 2, (z * body.thickness) / 2] as Vector,
  }))));
}

/** Lowest point of a rod's end: of a disc about the axis. */
function rimPoint(body: Size, end: -1 | 1, rotation: Rotation): Vector {
  const [, y, z] = rotateBack(rotation, [0, 0, -1]);
  const across = Math.hypot(y, z);
  const out = across > 0 ? body.radius / across : 0;
  return [(end * body.length) / 2, y * out, z * out];
}

/** Corners of a box, or of a rod the lowest point of each end, that are lowest, from the geometric centre, body axes. */
export function lowestPoints(body: Size, rotation: Rotation): { name: string; place: Vector }[] {
  const points = body.shape === "box" ? cornersOf(body)
    : [{ name: "a", place: rimPoint(body, -1, rotation) }, { name: "b", place: rimPoint(body, 1, rotation) }];
  const heights = points.map(({ place }) => rotate(rotation, place)[2]);
  const lowest = Math.min(...heights);
  return points.filter((_point, i) => (heights[i] ?? 0) <= lowest + 1e-6 * body.length);
}

/** The middle of the lowest points, from the centre of mass, world axes. */
export function lowestPlace(body: Body, rotation: Rotation): Vector {
  const points = lowestPoints(body, rotation);
  const middle = points.reduce((sum, { place }) => plus(sum, place, 1 / points.length), [0, 0, 0] as Vector);
  return rotate(rotation, plus(middle, body.centre, -1));
}

/** Height of the centre of mass over the lowest point of the body. */
export function centreHeight(body: Body, rotation: Rotation): number {
  return -lowestPlace(body, rotation)[2];
}

/** The geometric centre, for a centre of mass and a rotation. */
export function middleOf(body: Body, centre: Vector, rotation: Rotation): Vector {
  return plus(centre, rotate(rotation, body.centre), -1);
}
