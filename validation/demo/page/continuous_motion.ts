// SPDX-License-Identifier: GPL-3.0-or-later
// The continuous model between the samples of its time history: every step of a contact, some 20 of a flight.
import { extentOf, type Body } from "./body";
import type { History, Impact } from "./answers";
import { Flight, leadIn, leadOut, type Energies, type Motion, type Pose } from "./motion";
import { inclinationOf, slerp, type Rotation, type Vector } from "./rotation";

export class ContinuousMotion implements Motion {
  readonly begin: number;
  readonly near: number;
  readonly end: number;
  private readonly total: number;
  private readonly last: number;
  private readonly fall: Flight;
  private readonly after: Flight;

  constructor(
    readonly body: Body, readonly impacts: readonly Impact[], readonly history: History, private readonly gravity: number,
  ) {
    const { t } = history;
    // The history of a drop from a height begins with its fall, at a negative time.
    const touch = Math.max(0, t.findIndex((time) => time >= 0));
    this.last = t.length - 1;
    this.total = at(history.energy_total, 0);
    const falling = this.sample(touch, 0);
    ({ begin: this.begin, near: this.near } = leadIn(impacts, -falling.velocity[2], gravity, extentOf(body)));
    this.fall = new Flight(body, falling, gravity, this.begin);
    const released = this.sample(this.last, 0);
    const stop = at(t, this.last);
    this.after = new Flight(body, released, gravity, Math.max(0.5 * stop, -this.near));
    // A body that still touches has no simple motion past its history.
    this.end = released.inContact ? stop : leadOut(body, stop, this.near, (time) => this.after.pose(time - stop));
  }

  pose(time: number): Pose {
    const { t } = this.history;
    if (time < 0) return this.fall.pose(time);
    if (time > at(t, this.last)) return this.after.pose(time - at(t, this.last));
    const row = rowBefore(t, time);
    return this.sample(row, fraction(t, row, time));
  }

  energies(time: number): Energies {
    const { history } = this;
    const known = Math.min(Math.max(time, 0), at(history.t, this.last));
    const row = rowBefore(history.t, known);
    const part = fraction(history.t, row, known);
    const value = (column: number[]): number => mix(at(column, row), at(column, row + 1), part);
    const lost = this.total - value(history.energy_total);
    const rotation = time < 0 ? 0 : value(history.energy_rotation);
    const ground = time < 0 ? 0 : value(history.energy_ground);
    // Of the height by the place: between the samples of a flight it is not linear.
    const potential = this.body.mass * this.gravity * this.pose(time).centre[2];
    return { translation: this.total - lost - rotation - ground - potential, rotation, potential, ground, lost };
  }

  private sample(row: number, part: number): Pose {
    const h = this.history;
    const dt = at(h.t, row + 1) - at(h.t, row);
    // Cubic in position with the velocities at both samples: exact on the parabola of a flight.
    const place = (p: number[], v: number[]): number =>
      hermite(at(p, row), at(v, row) * dt, at(p, row + 1), at(v, row + 1) * dt, part);
    const value = (column: number[]): number => mix(at(column, row), at(column, row + 1), part);
    const rotation = slerp(rotationAt(h, row), rotationAt(h, row + 1), part);
    return {
      centre: [place(h.x, h.vx), place(h.y, h.vy), place(h.z, h.vz)],
      rotation, inclination: inclinationOf(rotation),
      velocity: [value(h.vx), value(h.vy), value(h.vz)],
      spin: [value(h.wx), value(h.wy), value(h.wz)],
      force: [value(h.fx), value(h.fy), value(h.fz)] as Vector,
      inContact: at(h.in_contact, row) !== 0,
    };
  }
}

/** Column entry; past the last sample the last one goes on. */
function at(column: number[], row: number): number {
  return column[Math.min(row, column.length - 1)] ?? 0;
}

/** The last row that is not after a time. */
function rowBefore(times: number[], time: number): number {
  let low = 0;
  let high = times.length - 1;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if ((times[middle] ?? 0) <= time) low = middle;
    else high = middle;
  }
  return low;
}

function fraction(times: number[], row: number, time: number): number {
  const span = at(times, row + 1) - at(times, row);
  return span > 0 ? Math.min(1, Math.max(0, (time - at(times, row)) / span)) : 0;
}

function mix(a: number, b: number, part: number): number {
  return a + (b - a) * part;
}

function hermite(p: number, v: number, q: number, w: number, s: number): number {
  const r = 1 - s;
  return p * (1 + 2 * s) * r * r + v * s * r * r + q * s * s * (1 + 2 * r) - w * s * s * r;
}

function rotationAt(h: History, row: number): Rotation {
  return [at(h.beta0, row), at(h.beta1, row), at(h.beta2, row), at(h.beta3, row)];
}
