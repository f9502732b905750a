// SPDX-License-Identifier: GPL-3.0-or-later
// The discrete model between its impacts: the centre of mass on a parabola, the rotation free.
import type { Impact } from "./answers";
import { centreHeight, extentOf, type Body } from "./body";
import { Flight, energyOfRotation, leadIn, leadOut, type Energies, type Motion, type Pose } from "./motion";
import { inclinationOf, planeRotation, plus, type Rotation, type Vector } from "./rotation";

const DEGREE = Math.PI / 180;

interface Start {
  time: number;
  flight: Flight;
}

export class DiscreteMotion implements Motion {
  readonly begin: number;
  readonly near: number;
  readonly end: number;
  private readonly starts: Start[] = [];
  private readonly fall: Flight;
  private readonly total: number;

  /** @param spin before the first touch, world components [rad/s] */
  constructor(readonly body: Body, readonly impacts: readonly Impact[], private readonly gravity: number, spin: Vector) {
    const [first] = impacts;
    if (!first) throw new RangeError("a motion needs an impact");
    const velocity = plus(first.velocity_after, first.impulse, -1 / body.mass);
    this.total = first.energy_before;
    ({ begin: this.begin, near: this.near } = leadIn(impacts, -velocity[2], gravity, extentOf(body)));
    this.fall = new Flight(body, poseOf(body, first, [0, 0], velocity, spin), gravity, this.begin);
    this.addFlights();
    this.end = leadOut(body, impacts[impacts.length - 1]?.start ?? 0, this.near, (time) => this.pose(time));
  }

  pose(time: number): Pose {
    if (time < 0) return this.fall.pose(time);
    let start = this.starts[0] as Start;
    for (const next of this.starts) if (next.time <= time) start = next;
    return start.flight.pose(time - start.time);
  }

  energies(time: number): Energies {
    const pose = this.pose(time);
    const { mass } = this.body;
    const translation = (mass * pose.velocity.reduce((sum, v) => sum + v * v, 0)) / 2;
    const rotation = energyOfRotation(this.body, pose);
    const potential = mass * this.gravity * pose.centre[2];
    return { translation, rotation, potential, ground: 0, lost: this.total - translation - rotation - potential };
  }

  private addFlights(): void {
    let place: readonly [number, number] = [0, 0];
    this.impacts.forEach((impact, i) => {
      const { start: time, velocity_after: velocity, angular_velocity_after: spin } = impact;
      const next = this.impacts[i + 1];
      const lasts = next ? next.start - time : Math.max(0.5 * time, -this.near);
      const pose = poseOf(this.body, impact, place, velocity, spin);
      this.starts.push({ time, flight: new Flight(this.body, pose, this.gravity, lasts) });
      place = [place[0] + velocity[0] * lasts, place[1] + velocity[1] * lasts];
    });
  }
}

/** At the touch; in the plane an impact has an inclination alone. */
export function touchRotation({ attitude, inclination_deg }: Impact): Rotation {
  return attitude ?? planeRotation(inclination_deg * DEGREE);
}

function poseOf(body: Body, impact: Impact, [x, y]: readonly [number, number], velocity: Vector, spin: Vector): Pose {
  const rotation = touchRotation(impact);
  return {
    centre: [x, y, centreHeight(body, rotation)], rotation, inclination: inclinationOf(rotation), velocity, spin,
    force: [0, 0, 0], inContact: false,
  };
}
