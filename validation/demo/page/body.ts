// The falling body: sizes, inertia, and where its ends are. Lengths in m, masses in kg.

export type BodyName = "rod" | "thick-rod" | "phone" | "own-rod" | "own-box";

export interface Body {
  readonly shape: "rod" | "box";
  readonly mass: number;
  readonly length: number;
  /** Of a rod; 0 is the thin rod of the discrete model. */
  readonly radius: number;
  /** Of a box: across the plane of motion, and upright at an inclination of 0. */
  readonly width: number;
  readonly thickness: number;
}

/** The continuous model needs a body with a volume: the thin rod gets the radius of the paper's mesh. */
export const CONTINUOUS_RADIUS = 0.01;

export const BODIES: Readonly<Record<BodyName, { title: string; body: Body }>> = {
  rod: { title: "Thin rod, 1 m", body: { shape: "rod", mass: 1, length: 1, radius: 0, width: 0, thickness: 0 } },
  "thick-rod": {
    title: "Thick rod, 1 m",
    body: { shape: "rod", mass: 1, length: 1, radius: 0.05, width: 0, thickness: 0 },
  },
  phone: {
    title: "Phone, 106 mm",
    body: { shape: "box", mass: 0.08814, length: 0.10566, radius: 0, width: 0.04394, thickness: 0.01905 },
  },
  "own-rod": {
    title: "Rod of your own",
    body: { shape: "rod", mass: 1, length: 1, radius: 0.02, width: 0, thickness: 0 },
  },
  "own-box": {
    title: "Box of your own",
    body: { shape: "box", mass: 0.2, length: 0.15, radius: 0, width: 0.07, thickness: 0.01 },
  },
};

export function halfThickness(body: Body): number {
  return body.shape === "rod" ? body.radius : body.thickness / 2;
}

/** Moment of inertia about the axis across the plane of motion [kg m²]. */
export function momentOfInertia(body: Body): number {
  const across = body.shape === "rod" ? 3 * body.radius ** 2 : body.thickness ** 2;
  return (body.mass * (across + body.length ** 2)) / 12;
}

/** Height of the centre of mass over the lowest point of the body at an inclination [rad] in the plane. */
export function centreHeight(body: Body, inclination: number): number {
  return (body.length / 2) * Math.abs(Math.sin(inclination)) + halfThickness(body) * Math.abs(Math.cos(inclination));
}

/** Horizontal distance from the centre of mass to the lowest point of an end at an inclination [rad], in the plane. */
export function contactPoint(body: Body, end: "a" | "b", inclination: number): number {
  const along = end === "a" ? -body.length / 2 : body.length / 2;
  const c = Math.cos(inclination);
  const across = c >= 0 ? -halfThickness(body) : halfThickness(body);
  return along * c - across * Math.sin(inclination);
}
