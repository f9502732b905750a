// SPDX-License-Identifier: GPL-3.0-or-later
// Both models' answers to the situation, and the motions that follow from them.
import { Latest, type ApiError, type Impact, type SequenceAnswer, type SimulateAnswer } from "./api";
import { CONTINUOUS_RADIUS, hasUpperSide, lowestPoints, seenAngle, uniformBody, type Body, type Size } from "./body";
import { significant } from "./format";
import type { ModelName, Motions } from "./frame";
import { ContinuousMotion, DiscreteMotion, touchRotation } from "./motion";
import { bodyOf, isInPlane, type Parameters } from "./parameters";
import { TimeWarp } from "./playback";
import { dropOf, keyOf, sequenceRequest, simulateRequest } from "./requests";
import { rotateBack, type Vector } from "./rotation";
import { outcomeInWords } from "./words";

export type Impacts = Record<ModelName, readonly Impact[] | null>;

/** Until a situation stands still for so long, the slower model is not asked [ms]. */
const CONTINUOUS_DELAY = 150;

export class Models {
  readonly motions: Motions = { discrete: null, continuous: null };
  discrete: SequenceAnswer | null = null;
  /** Of which drop the discrete model's answer is. */
  discreteOf = "";
  continuous: SimulateAnswer | null = null;
  /** Of which situation the continuous model's answer is. */
  private continuousOf = "";
  private body: Body | null = null;
  /** Which situation it refused last. */
  private refusedOf = "";
  /** The situation that the discrete model has answered or refused last; until then the other one's answer is kept back. */
  private toldOf = "";
  private keptBack: (() => void) | null = null;
  private readonly sequence: Latest<SequenceAnswer, Parameters>;
  private readonly simulation: Latest<SimulateAnswer, Parameters>;

  /**
   * @param onError a model refused a situation, or (null) no longer does
   * @param onBusy the continuous model is being computed
   */
  constructor(
    private readonly onAnswer: () => void, private readonly onError: (model: ModelName, error: ApiError | null) => void,
    onBusy: (busy: boolean) => void,
  ) {
    this.sequence = new Latest<SequenceAnswer, Parameters>(
      0, (answer, parameters) => this.onSequence(answer, parameters), (error, parameters) => {
        onError("discrete", error);
        this.goOn(keyOf(simulateRequest(parameters)));
      });
    this.simulation = new Latest<SimulateAnswer, Parameters>(
      CONTINUOUS_DELAY, (answer, parameters) => this.onSimulation(answer, parameters),
      (error, parameters) => {
        this.refusedOf = keyOf(simulateRequest(parameters));
        onError("continuous", error);
      }, onBusy);
  }

  ask(parameters: Parameters, both: boolean): void {
    this.keptBack = null;
    this.sequence.ask(sequenceRequest(parameters), { ...parameters });
    if (both) return this.simulation.ask(simulateRequest(parameters), { ...parameters });
    this.simulation.leave();
    this.continuousOf = "";
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
    this.onError("discrete", null);
    if (this.refusedOf !== key) this.onError("continuous", null);
    const body = { ...bodyOf(parameters), ...answer.body };
    this.discrete = { ...answer, impacts: answer.impacts.map((impact) => asSeen(body, impact)) };
    this.discreteOf = dropOf(parameters);
    this.body = body;
    this.motions.discrete = answer.impacts.length
      ? new DiscreteMotion(body, this.discrete.impacts, parameters.gravity, spinOf(parameters)) : null;
    if (this.continuousOf !== key) {
      // What the other model said belongs to another situation.
      this.motions.continuous = null;
      this.continuous = null;
    }
    this.onAnswer();
    this.goOn(key);
  }

  /** What the other model said meanwhile of the same situation follows. */
  private goOn(key: string): void {
    this.toldOf = key;
    this.keptBack?.();
  }

  private onSimulation(answer: SimulateAnswer, parameters: Parameters): void {
    const key = keyOf(simulateRequest(parameters));
    this.keptBack = key === this.toldOf ? null : () => this.onSimulation(answer, parameters);
    if (this.keptBack) return;
    this.continuousOf = key;
    this.onError("continuous", null);
    const given = bodyOf(parameters);
    const impacts = answer.impacts.map((impact) => asSeen(given, named(given, impact, isInPlane(parameters))));
    this.continuous = { ...answer, impacts };
    this.motions.continuous = answer.history.t.length > 1
      ? new ContinuousMotion(
        { ...continuousBody(given), ...answer.body }, impacts, answer.history, parameters.gravity) : null;
    this.onAnswer();
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

/** Of the body's upright against the ground: what slants less stands on its end, and both sides touch. */
const SLANT = 1e-9;

export interface Pairing {
  /** Impacts 1 to count are the same blow in both models. */
  count: number;
  /** Why the next ones are not, one clause; empty if there are none. */
  reason: string;
}

function pairingOf(body: Size, discrete: SequenceAnswer, continuous: SequenceAnswer): Pairing {
  const most = Math.max(discrete.impacts.length, continuous.impacts.length);
  for (let i = 0; i < most; i++) {
    const reason = reasonAgainst(body, discrete, continuous, i);
    if (reason) return { count: i, reason };
  }
  return { count: most, reason: "" };
}

function reasonAgainst(body: Size, discrete: SequenceAnswer, continuous: SequenceAnswer, i: number): string {
  const [a, b] = [discrete.impacts[i], continuous.impacts[i]];
  if (!a) return `the discrete sequence has ended: ${ending(discrete.outcome)}`;
  if (!b) return `the continuous run has ended: ${ending(continuous.outcome)}`;
  if (a.predictable === false) return `beyond the predictable in the discrete model${growth(a)}`;
  if (b.predictable === false) return `beyond the predictable in the continuous model${growth(b)}`;
  if ((b.touches ?? 1) > 1 && (a.touches ?? 1) === 1 && a.end !== "both") {
    return "in the continuous model another place touches before the first contact has ended";
  }
  const [first, second] = a.corners ? [sorted(a.corners.split(" ")), struckNames(body, b)] : [a.end, b.end];
  return first === second ? "" : `${first} strikes in the discrete model, ${second} in the continuous one`;
}

function ending(outcome: string): string {
  return outcomeInWords(outcome).replace(/\.$/, "").toLowerCase();
}

export function growth({ amplification }: Impact): string {
  return amplification ? `: an error of the start has grown ${significant(amplification, 2)} times` : "";
}

/** Of the corners that are lowest at the touch, or of the ends of a rod. */
function struckNames(body: Size, impact: Impact): string {
  return sorted(lowestPoints(body, touchRotation(impact)).map(({ name }) => name));
}

/** What strikes in the plane: ends a and b, or those of the upper side, where the body has turned over. */
function endInPlane(body: Size, impact: Impact): string {
  const isOver = hasUpperSide(body) && rotateBack(touchRotation(impact), [0, 0, -1])[2] > SLANT;
  if (!isOver) return impact.end;
  return impact.end === "both" ? "a-top+b-top" : `${impact.end}-top`;
}

function sorted(names: string[]): string {
  return [...names].sort().join(" ");
}
