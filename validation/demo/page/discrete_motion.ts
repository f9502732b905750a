// The discrete model between its impacts: the centre of mass on a parabola, the spin constant.
import { centreHeight, momentOfInertia, type Body } from "./body";
import type { Impact } from "./answers";
import { coast, leadIn, leadOut, planeRotation, type Energies, type Motion, type Pose, type Vector } from "./motion";

const DEGREE = Math.PI / 180;

interface Flight {
  start: number;
  /** Just after the impact that it begins with. */
  pose: Pose;
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
    let before: Impact | null = null;
    for (const impact of impacts) {
      if (before) x += before.velocity_after[0] * (impact.start - before.start);
      before = impact;
      const { inclination_deg, velocity_after: velocity, angular_velocity_after: spin } = impact;
      this.flights.push({ start: impact.start, pose: poseOf(body, inclination_deg * DEGREE, x, velocity, spin) });
    }
    const speed = first.approach_speed;
    this.touch = poseOf(body, first.inclination_deg * DEGREE, 0, [0, 0, -speed], [0, 0, 0]);
    this.total = first.energy_before;
    this.begin = -leadIn(impacts, speed, gravity, body.length);
    this.end = leadOut(body, (before ?? first).start, this.begin, (time) => this.pose(time));
  }

  pose(time: number): Pose {
    if (time < 0) return coast(this.touch, this.gravity, time);
    let flight = this.flights[0] as Flight;
    for (const next of this.flights) if (next.start <= time) flight = next;
    return coast(flight.pose, this.gravity, time - flight.start);
  }

  energies(time: number): Energies {
    const { centre, velocity, spin } = this.pose(time);
    const { mass } = this.body;
    const translation = (mass * (velocity[0] ** 2 + velocity[2] ** 2)) / 2;
    const rotation = (momentOfInertia(this.body) * spin[1] ** 2) / 2;
    const potential = mass * this.gravity * centre[2];
    return { translation, rotation, potential, ground: 0, lost: this.total - translation - rotation - potential };
  }
}

function poseOf(body: Body, inclination: number, x: number, velocity: Vector, spin: Vector): Pose {
  return {
    centre: [x, 0, centreHeight(body, inclination)], rotation: planeRotation(inclination), inclination, velocity, spin,
    force: [0, 0, 0], inContact: false,
  };
}
