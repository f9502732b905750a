// What the program answers, as far as the page reads it.

export interface Impact {
  n: number;
  start: number;
  duration: number;
  end: string;
  inclination_deg: number;
  contact_angle_deg: number;
  approach_speed: number;
  restitution: number | null;
  impulse_normal: number;
  impulse_tangential: number;
  peak_force: number | null;
  velocity_after: [number, number, number];
  angular_velocity_after: [number, number, number];
  energy_before: number;
  energy_after: number;
  energy_loss: number;
  /** Of the continuous model: false if nothing can be said about this impact. */
  predictable?: boolean;
}

/** Columns of the time history that the page reads. */
export type History = Record<
  "t" | "x" | "y" | "z" | "beta0" | "beta1" | "beta2" | "beta3" | "vx" | "vy" | "vz" | "wx" | "wy" | "wz" | "fx" | "fy" | "fz"
  | "energy_rotation" | "energy_ground" | "energy_total" | "in_contact", number[]>;

export interface SequenceAnswer {
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
  steps: { title: string; text: string; equations: Equation[] }[];
}
