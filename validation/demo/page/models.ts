// SPDX-License-Identifier: GPL-3.0-or-later
// Both models' answers to the situation, and the motions that follow from them.
import type { Impact, SequenceAnswer, SimulateAnswer } from "./answers";
import { Latest, type ApiError } from "./api";
import { CONTINUOUS_RADIUS, seenAngle, uniformBody, type Body } from "./body";
import type { Motions } from "./frame";
import { ContinuousMotion, DiscreteMotion } from "./motion";
import { endInPlane, pairingOf, struckNames, type Pairing } from "./pairing";
import { bodyOf, isInPlane, type Parameters } from "./parameters";
import { TimeWarp } from "./playback";
import { keyOf, sequenceRequest, simulateRequest } from "./requests";
import type { Vector } from "./rotation";

export type Impacts = Record<"discrete" | "continuous", readonly Impact[] | null>;

/** Until a situation stands still for so long, the slower model is not asked [ms]. */
const CONTINUOUS_DELAY = 150;

export interface ModelEvents {
  /** There is an answer to show. */
  onAnswer(): void;
  /** A model refused a situation, or (null) no longer does. */
  onError(model: "discrete" | "continuous", error: ApiError | null): void;
  /** The continuous model is being computed. */
  onBusy(busy: boolean): void;
}

export class Models {
  readonly motions: Motions = { discrete: null, continuous: null };
  discrete: SequenceAnswer | null = null;
  continuous: SimulateAnswer | null = null;
  /** Of which situation the continuous model's answer is. */
  private continuousOf = "";
  private body: Body | null = null;
  /** Which situation it refused last. */
  private refusedOf = "";
  private readonly sequence: Latest<SequenceAnswer, Parameters>;
  private readonly simulation: Latest<SimulateAnswer, Parameters>;

  constructor(private readonly events: ModelEvents) {
    this.sequence = new Latest<SequenceAnswer, Parameters>(
      0, (answer, parameters) => this.onSequence(answer, parameters), (error) => events.onError("discrete", error));
    this.simulation = new Latest<SimulateAnswer, Parameters>(
      CONTINUOUS_DELAY, (answer, parameters) => this.onSimulation(answer, parameters),
      (error, parameters) => {
        this.refusedOf = keyOf(simulateRequest(parameters));
        events.onError("continuous", error);
      }, (busy) => events.onBusy(busy));
  }

  ask(parameters: Parameters): void {
    this.sequence.ask(sequenceRequest(parameters), { ...parameters });
    this.askContinuous(parameters);
  }

  /** The continuous model takes too long for who waits; it can be asked for again. */
  leaveContinuous(): void {
    this.simulation.leave();
  }

  askContinuous(parameters: Parameters): void {
    this.simulation.ask(simulateRequest(parameters), { ...parameters });
  }

  get impacts(): Impacts {
    return { discrete: this.discrete?.impacts ?? null, continuous: this.continuous?.impacts ?? null };
  }

  /** Which impacts of the two models are the same; null while one of them has none. */
  get pairing(): Pairing | null {
    const { discrete, continuous } = this;
    if (!discrete || !continuous || !this.body) return null;
    return pairingOf(this.body, discrete, continuous);
  }

  /** The impacts to step through: the discrete model's, or the other's if it has none. */
  get steps(): readonly Impact[] {
    return this.discrete?.impacts ?? this.continuous?.impacts ?? [];
  }

  /** Playback of both motions; null before the first answer. */
  warp(slow: boolean): TimeWarp | null {
    const motions = [this.motions.discrete, this.motions.continuous].filter((motion) => motion !== null);
    if (!motions.length) return null;
    const contacts = motions.flatMap((motion) => motion.impacts.map(({ start, duration }) => ({ start, end: start + duration })));
    const least = (name: "begin" | "near"): number => Math.min(...motions.map((motion) => motion[name]));
    return TimeWarp.slow(least("begin"), least("near"), Math.max(...motions.map((motion) => motion.end)), contacts, slow);
  }

  private onSequence(answer: SequenceAnswer, parameters: Parameters): void {
    const key = keyOf(simulateRequest(parameters));
    this.events.onError("discrete", null);
    if (this.refusedOf !== key) this.events.onError("continuous", null);
    const body = { ...bodyOf(parameters), ...answer.body };
    this.discrete = { ...answer, impacts: answer.impacts.map((impact) => asSeen(body, impact)) };
    this.body = body;
    this.motions.discrete = answer.impacts.length
      ? new DiscreteMotion(body, this.discrete.impacts, parameters.gravity, spinOf(parameters)) : null;
    if (this.continuousOf !== key) {
      // What the other model said belongs to another situation.
      this.motions.continuous = null;
      this.continuous = null;
    }
    this.events.onAnswer();
  }

  private onSimulation(answer: SimulateAnswer, parameters: Parameters): void {
    this.continuousOf = keyOf(simulateRequest(parameters));
    this.events.onError("continuous", null);
    const given = bodyOf(parameters);
    const impacts = answer.impacts.map((impact) => asSeen(given, named(given, impact, isInPlane(parameters))));
    this.continuous = { ...answer, impacts };
    this.motions.continuous = answer.history.t.length > 1
      ? new ContinuousMotion(
        { ...continuousBody(given), ...answer.body }, impacts, answer.history, parameters.gravity) : null;
    this.events.onAnswer();
  }
}

/** An impact of the continuous model, which names ends and corners in any case, with the discrete model's names. */
function named(body: Body, { corners: _both, ...impact }: Impact, inPlane: boolean): Impact {
  // In space an end is not enough to say what strikes.
  return inPlane ? { ...impact, end: endInPlane(body, impact) } : { ...impact, corners: struckNames(body, impact) };
}

function asSeen(body: Body, impact: Impact): Impact {
  return { ...impact, program_angle_deg: impact.contact_angle_deg, contact_angle_deg: seenAngle(body, impact.contact_angle_deg) };
}

function continuousBody(body: Body): Body {
  return body.shape === "rod" && body.radius === 0 ? uniformBody({ ...body, radius: CONTINUOUS_RADIUS * body.length }) : body;
}

export function spinOf({ spinning, wx, wy, wz }: Parameters): Vector {
  return spinning ? [wx, wy, wz] : [0, 0, 0];
}
