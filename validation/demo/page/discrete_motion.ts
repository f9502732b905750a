// The discrete model between its impacts: the centre of mass on a parabola, the spin constant.
import { centreHeight, momentOfInertia, type Body } from "./body";
import type { Impact } from "./answers";
import { fallBefore, leadIn, planeRotation, type Energies, type Motion, type Pose, type Vector } from "./motion";

const DEGREE = Math.PI / 180;

interface Flight {
  start: number;
  centre: Vector;
  inclination: number;
  velocity: Vector;
  spin: number;
}

export class DiscreteMotion implements Motion {
  readonly begin: number;
  readonly end: number;
  private readonly flights: Flight[] = [];
  private readonly touch: Pose;
  private readonly total: number;

  constructor(readonly body: Body, readonly impacts: readonly Impact[], private readonly gravity: number) {
    const first = impacts[0];
    if (!first) throw new RangeError("a motion needs an impact");
    let x = 0;
    let before: Flight | null = null;
    for (const impact of impacts) {
      if (before) x += before.velocity[0] * (impact.start - before.start);
      const inclination = impact.inclination_deg * DEGREE;
      before = {
        start: impact.start, centre: [x, 0, centreHeight(body, inclination)], inclination,
        velocity: impact.velocity_after, spin: impact.angular_velocity_after[1],
      };
      this.flights.push(before);
    }
    const inclination = first.inclination_deg * DEGREE;
    const speed = first.approach_speed;
    this.touch = {
      centre: [0, 0, centreHeight(body, inclination)], rotation: planeRotation(inclination), inclination,
      velocity: [0, 0, -speed], spin: [0, 0, 0], force: [0, 0, 0], inContact: false,
    };
    this.total = first.energy_before;
    this.begin = -leadIn(impacts, speed, gravity, body.length);
    this.end = this.leadOut();
  }

  pose(time: number): Pose {
    if (time < 0) return fallBefore(this.touch, this.gravity, time);
    const flight = this.flightAt(time);
    const dt = time - flight.start;
    const inclination = flight.inclination - flight.spin * dt;
    const [vx, , vz] = flight.velocity;
    return {
      centre: [
        flight.centre[0] + vx * dt, 0, flight.centre[2] + vz * dt - (this.gravity * dt * dt) / 2,
      ],
      rotation: planeRotation(inclination), inclination, velocity: [vx, 0, vz - this.gravity * dt],
      spin: [0, flight.spin, 0], force: [0, 0, 0], inContact: false,
    };
  }

  energies(time: number): Energies {
    const { centre, velocity, spin } = this.pose(time);
    const { mass } = this.body;
    const translation = (mass * (velocity[0] ** 2 + velocity[2] ** 2)) / 2;
    const rotation = (momentOfInertia(this.body) * spin[1] ** 2) / 2;
    const potential = mass * this.gravity * centre[2];
    return { translation, rotation, potential, ground: 0, lost: this.total - translation - rotation - potential };
  }

  private flightAt(time: number): Flight {
    let flight = this.flights[0] as Flight;
    for (const next of this.flights) if (next.start <= time) flight = next;
    return flight;
  }

  /** After the last impact the flight is shown for a while, but never into the ground. */
  private leadOut(): number {
    const last = this.flights[this.flights.length - 1] as Flight;
    const span = Math.max(0.5 * last.start, -this.begin);
    const steps = 60;
    for (let i = 1; i <= steps; i++) {
      const time = last.start + (span * i) / steps;
      const pose = this.pose(time);
      if (pose.centre[2] < centreHeight(this.body, pose.inclination) - 1e-9) return last.start + (span * (i - 1)) / steps;
    }
    return last.start + span;
  }
}
