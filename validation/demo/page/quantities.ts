// SPDX-License-Identifier: GPL-3.0-or-later
// The sliders: what they are called, their range and scale. The program, not the page, says which numbers are allowed.
import type { Quantity } from "./parameters";

export interface QuantitySpec {
  label: string;
  symbol?: string;
  unit: string;
  min: number;
  max: number;
  /** Of a linear slider. */
  step: number;
  /** Logarithmic; "zero" has the number 0 at its left end. */
  scale: "linear" | "log" | "zero";
  /** Of which model alone this is a number, if not of both. */
  model?: "discrete" | "continuous";
}

const linear = (label: string, unit: string, min: number, max: number, step: number): QuantitySpec =>
  ({ label, unit, min, max, step, scale: "linear" });

/** Parts of a vector: fields without a slider. */
function parts<Name extends Quantity>(names: readonly Name[], unit: string, most: number): Record<Name, QuantitySpec> {
  return Object.fromEntries(names.map((name) => [name, linear(name, unit, -most, most, 0.01)])) as Record<Name, QuantitySpec>;
}

export const SPECS: Readonly<Record<Quantity, QuantitySpec>> = {
  angle: linear("Angle", "°", 0, 90, 0.1),
  tilt: linear("Tilt before", "°", -180, 180, 0.5),
  orientation: linear("Part that points down", "", 1, 26, 1),
  ...parts(["q0", "q1", "q2", "q3"], "", 1),
  speed: linear("Speed", "m/s", 0.1, 10, 0.1),
  height: linear("Height", "m", 0.1, 3, 0.01),
  ...parts(["vx", "vy", "vz"], "m/s", 10),
  ...parts(["wx", "wy", "wz"], "rad/s", 100),
  gravity: linear("Gravity", "m/s²", 0, 25, 0.01),
  e: { ...linear("Restitution", "", 0, 1, 0.01), symbol: "e" },
  friction: { ...linear("Friction", "", 0, 1, 0.005), symbol: "μ" },
  stiffness: {
    label: "Stiffness", symbol: "k", unit: "N/m³", min: 1e6, max: 1e12, step: 0, scale: "log", model: "continuous",
  },
  damping: {
    label: "Damping", symbol: "c", unit: "N·s/m⁴", min: 1e3, max: 1e11, step: 0, scale: "zero", model: "continuous",
  },
  impacts: linear("Impacts, at most", "", 1, 20, 1),
  mass: { label: "Mass", unit: "kg", min: 0.01, max: 100, step: 0, scale: "log" },
  length: { label: "Length", unit: "m", min: 0.01, max: 10, step: 0, scale: "log" },
  radius: { label: "Radius", unit: "m", min: 0.001, max: 1, step: 0, scale: "log" },
  width: { label: "Width", unit: "m", min: 0.001, max: 1, step: 0, scale: "log" },
  thickness: { label: "Thickness", unit: "m", min: 0.001, max: 1, step: 0, scale: "log" },
};

/** What the program calls these quantities in its messages. */
const BLAMED: Readonly<Record<string, Quantity>> = {
  restitution: "e", static_friction: "friction", sliding_friction: "friction", size: "length", attitude: "q0",
  velocity: "vx", angular_velocity: "wx",
};

export function blamedQuantity(name: string | undefined): Quantity | undefined {
  if (name === undefined) return undefined;
  return Object.hasOwn(SPECS, name) ? (name as Quantity) : BLAMED[name];
}

/** Positions of a logarithmic slider. */
const TICKS = 600;

export function sliderRange(spec: QuantitySpec): { min: number; max: number; step: number } {
  return spec.scale === "linear" ? { min: spec.min, max: spec.max, step: spec.step } : { min: 0, max: TICKS, step: 1 };
}

export function toSlider(spec: QuantitySpec, value: number): number {
  if (spec.scale === "linear") return value;
  if (!(value > 0)) return 0;
  const part = Math.log(value / spec.min) / Math.log(spec.max / spec.min);
  return Math.round(Math.min(1, Math.max(spec.scale === "zero" ? 1 / TICKS : 0, part)) * TICKS);
}

export function fromSlider(spec: QuantitySpec, position: number): number {
  if (spec.scale === "linear") return Number(position.toFixed(6));
  if (spec.scale === "zero" && position === 0) return 0;
  return Number((spec.min * (spec.max / spec.min) ** (position / TICKS)).toPrecision(3));
}

/** As a number field takes it; large numbers with an exponent. */
export function fieldText(value: number): string {
  const text = Math.abs(value) >= 1e5 ? value.toExponential().replace("e+", "e") : String(value);
  return text;
}
