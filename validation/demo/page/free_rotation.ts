// SPDX-License-Identifier: GPL-3.0-or-later
// Rotation of a body in flight, for the picture alone: no number of a table comes from here.
//     I ω̇ = −ω × I ω,   q̇ = q (0, ω)/2   in axes of the body, by the classical Runge–Kutta method.
import type { Inertia } from "./body";
import { cross, normalised, plus, product, rotate, rotateBack, slerp, type Rotation, type Vector } from "./rotation";

export interface Turning {
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
