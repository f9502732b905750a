// SPDX-License-Identifier: GPL-3.0-or-later
// What the program answers, as far as the page reads it.
import type { Rotation, Vector, Inertia } from "./rotation";

export interface Impact {
  n: number;
  start: number;
  duration: number;
  end: string;
  /** In space: names of the corners that strike, and the Euler parameters at the touch. */
  corners?: string;
  attitude?: Rotation;
  /** How many places touch one after the other, or corners at once. */
  touches?: number;
  inclination_deg: number;
  /** As one sees it, and as the program counts it. */
  contact_angle_deg: number;
  program_angle_deg?: number;
  approach_speed: number;
  restitution: number | null;
  impulse_normal: number;
  impulse_tangential: number;
  impulse: Vector;
  peak_force: number | null;
  velocity_after: Vector;
  angular_velocity_after: Vector;
  energy_before: number;
  energy_after: number;
  energy_loss: number;
  /** False if errors have grown so far that nothing can be said about this impact; by so many times. */
  predictable?: boolean;
  amplification?: number | null;
  error_estimate?: Bars;
}

/** Error bars, by the names of the numbers. */
export type Bars = Partial<Record<"start" | "contact_angle_deg" | "impulse_normal" | "duration" | "peak_force" | "energy_loss", number | null>
  & Record<"velocity_after" | "angular_velocity_after", Vector>>;

/** Columns of the time history that the page reads. */
export type History = Record<
  "t" | "x" | "y" | "z" | "beta0" | "beta1" | "beta2" | "beta3" | "vx" | "vy" | "vz" | "wx" | "wy" | "wz" | "fx" | "fy" | "fz"
  | "energy_rotation" | "energy_ground" | "energy_total" | "in_contact", number[]>;

export interface SequenceAnswer {
  body: { mass: number; centre: Vector; inertia: Inertia };
  impacts: Impact[];
  outcome: string;
  message: string;
  total_normal_impulse: number;
}

export interface SimulateAnswer extends SequenceAnswer {
  history: History;
}

export interface AngleRow {
  theta_deg: number;
  beta_deg: number | null;
  gamma_deg: number | null;
}

export interface AnglesAnswer {
  rows: AngleRow[];
}

export interface Equation {
  name: string;
  tex: string; // lines of an aligned environment
  words: string;
}

export interface ExplainAnswer {
  impact: number;
  steps: { title: string; text: string; laws: { symbolic: string; tex: string }[]; equations: Equation[] }[];
}

/** A scene file as arguments of the other requests. */
export interface SceneAnswer {
  arguments: Record<string, string | number | boolean | number[]>;
  notes: string[];
}

export interface FileAnswer {
  file: string;
}
