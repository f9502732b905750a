// SPDX-License-Identifier: GPL-3.0-or-later
// Which moments of the two models may stand beside each other: never one before its blow beside one after it.
import type { Impact } from "./answers";
import { fixed } from "./format";
import { MODELS, type ModelName, type Motions } from "./frame";
import { shownTime } from "./motion";
import type { Pairing } from "./pairing";

export interface Moment {
  /** What is shown, in words. */
  title: string;
  /** Of each model [s]; null where it has none. */
  times: Record<ModelName, number | null>;
  /** Whether the difference of the two means something. */
  comparable: boolean;
}

const endOf = ({ start, duration }: Impact): number => start + duration;

/** Blows that have begun at a time, and those that are over. */
function counts(impacts: readonly Impact[], time: number): { begun: number; over: number } {
  return { begun: impacts.filter(({ start }) => start <= time).length, over: impacts.filter((impact) => endOf(impact) <= time).length };
}

export function momentAt({ discrete, continuous }: Motions, pairing: Pairing | null, time: number): Moment {
  const at = `${fixed(time * 1e3, 2)} ms`;
  const times = { discrete: discrete && shownTime(discrete, time), continuous: continuous && shownTime(continuous, time) };
  const ended = MODELS.filter((model) => times[model] !== null && times[model] < time - 1e-12);
  if (ended.length) return { title: `At ${at}: the ${ended.join(" and the ")} model ends here`, times, comparable: false };
  if (!discrete || !continuous || !pairing) return { title: `At ${at}`, times, comparable: false };
  const [a, b] = [counts(discrete.impacts, time), counts(continuous.impacts, time)];
  const n = Math.max(a.begun, b.begun);
  const isUnderWay = a.over < n || b.over < n;
  const [one, other] = [discrete.impacts[n - 1], continuous.impacts[n - 1]];
  if (n > 0 && n <= pairing.count && one && other && (isUnderWay || time === one.start)) {
    return { title: `Just after blow ${n}, each model at the end of its own`, times: { discrete: one.start, continuous: endOf(other) }, comparable: true };
  }
  const same = n <= pairing.count && !isUnderWay;
  if (!same) return { title: `At ${at}: the models have parted, they have no blow ${pairing.count + 1} in common`, times, comparable: false };
  return { title: n === 0 ? `At ${at}, before the first blow` : `At ${at}, in the flight after blow ${n}`, times, comparable: true };
}
