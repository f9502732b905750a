// SPDX-License-Identifier: GPL-3.0-or-later
// Vectors, rotations by Euler parameters, and how a body turns in flight.

export type Vector = [number, number, number];
/** Euler parameters, the scalar first. */
export type Rotation = [number, number, number, number];
/** xx, yy, zz, xy, xz, yz about the centre of mass, axes of the body [kg m²]. */
export type Inertia = readonly [number, number, number, number, number, number];

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

interface Turning {
  rotation: Rotation;
  /** World components [rad/s]. */
  spin: Vector;
}

interface State {
  rotation: Rotation;
  /** Axes of the body [rad/s]. */
  rate: Vector;
}

const STEP = 0.03; // turned by a step [rad]
const MOST_STEPS = 20_000;

/**
 * For the picture alone: no number of a table comes from here.
 *     I ω̇ = −ω × I ω,   q̇ = q (0, ω)/2   in axes of the body, by the classical Runge–Kutta method.
 */
export class FreeRotation {
  private readonly states: State[];
  private readonly step: number;

  /** From a time on, for a while that may be negative [s]. */
  constructor(inertia: Inertia, start: Turning, span: number) {
    const count = Math.min(MOST_STEPS, Math.max(1, Math.ceil((Math.hypot(...start.spin) * Math.abs(span)) / STEP)));
    this.step = span / count;
    let state: State = { rotation: start.rotation, rate: rotateBack(start.rotation, start.spin) };
    this.states = [state];
    const derivative = derivativeOf(inertia);
    for (let i = 0; i < count; i++) this.states.push((state = next(state, this.step, derivative)));
  }

  /** So long after the start; beyond the span as at its end. */
  at(time: number): Turning {
    const last = this.states.length - 1;
    const place = this.step === 0 ? 0 : Math.min(last, Math.max(0, time / this.step));
    const row = Math.min(last - 1, Math.floor(place));
    const [a, b] = [this.states[row] as State, this.states[row + 1] as State];
    const part = place - row;
    const rotation = slerp(a.rotation, b.rotation, part);
    const rate = plus(plus([0, 0, 0], a.rate, 1 - part), b.rate, part);
    return { rotation, spin: rotate(rotation, rate) };
  }
}

type Derivative = (state: State) => { turn: Rotation; rate: Vector };

function derivativeOf(inertia: Inertia): Derivative {
  const inverse = inverseOf(inertia);
  return ({ rotation, rate }) => {
    const [x, y, z] = cross(rate, times(inertia, rate));
    const turn = product(rotation, [0, ...rate]).map((part) => part / 2) as Rotation;
    return { turn, rate: times(inverse, [-x, -y, -z]) };
  };
}

function next(state: State, step: number, derivative: Derivative): State {
  const moved = ({ turn, rate }: ReturnType<Derivative>, by: number): State => ({
    rotation: state.rotation.map((part, i) => part + by * (turn[i] ?? 0)) as Rotation, rate: plus(state.rate, rate, by),
  });
  const a = derivative(state);
  const b = derivative(moved(a, step / 2));
  const c = derivative(moved(b, step / 2));
  const d = derivative(moved(c, step));
  const turn = a.turn.map((part, i) => (part + 2 * (b.turn[i] ?? 0) + 2 * (c.turn[i] ?? 0) + (d.turn[i] ?? 0)) / 6) as Rotation;
  const rate = plus(plus(plus(a.rate, b.rate, 2), c.rate, 2), d.rate);
  const end = moved({ turn, rate: [rate[0] / 6, rate[1] / 6, rate[2] / 6] }, step);
  return { rotation: normalised(end.rotation), rate: end.rate };
}

export function times([xx, yy, zz, xy, xz, yz]: Inertia, [x, y, z]: Vector): Vector {
  return [xx * x + xy * y + xz * z, xy * x + yy * y + yz * z, xz * x + yz * y + zz * z];
}

/** A thin rod has no inertia about its axis, and no rate about it either: any small one serves. */
function inverseOf([a, yy, zz, xy, xz, yz]: Inertia): Inertia {
  const xx = Math.max(a, 1e-6 * yy);
  const minors: Inertia = [yy * zz - yz * yz, xx * zz - xz * xz, xx * yy - xy * xy, xz * yz - xy * zz, xy * yz - xz * yy, xy * xz - yz * xx];
  const determinant = xx * minors[0] + xy * minors[3] + xz * minors[4];
  return minors.map((minor) => minor / determinant) as unknown as Inertia;
}
