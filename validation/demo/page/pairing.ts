// SPDX-License-Identifier: GPL-3.0-or-later
// Which impacts of the two models are the same blow: the n-th of both, while everything before was the same, the same end or
// corner strikes, and neither is beyond prediction.
import type { Impact, SequenceAnswer } from "./answers";
import { hasUpperSide, lowestPoints, type Size } from "./body";
import { significant } from "./format";
import { touchRotation } from "./motion";
import { rotateBack } from "./rotation";
import { outcomeInWords } from "./words";

/** Of the body's upright against the ground: what slants less stands on its end, and both sides touch. */
const SLANT = 1e-9;

export interface Pairing {
  /** Impacts 1 to count are the same blow in both models. */
  count: number;
  /** Why the next ones are not, one clause; empty if there are none. */
  reason: string;
}

export function pairingOf(body: Size, discrete: SequenceAnswer, continuous: SequenceAnswer): Pairing {
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
export function struckNames(body: Size, impact: Impact): string {
  return sorted(lowestPoints(body, touchRotation(impact)).map(({ name }) => name));
}

/** What strikes in the plane: ends a and b, or those of the upper side, where the body has turned over. */
export function endInPlane(body: Size, impact: Impact): string {
  const isOver = hasUpperSide(body) && rotateBack(touchRotation(impact), [0, 0, -1])[2] > SLANT;
  if (!isOver) return impact.end;
  return impact.end === "both" ? "a-top+b-top" : `${impact.end}-top`;
}

function sorted(names: string[]): string {
  return [...names].sort().join(" ");
}
