// SPDX-License-Identifier: GPL-3.0-or-later
// The numbers of the picture: both models at the moment that is shown, aligned by blow, and what lies between them. Never does a moment
// before a blow of the one stand beside one after it of the other.
import type { Impact } from "./answers";
import { seenAngle } from "./body";
import { byId, make } from "./dom";
import { fixed } from "./format";
import { MODELS, type Motions, type ModelName } from "./frame";
import { endMotion, shownTime, type Motion } from "./motion";
import type { Pairing } from "./pairing";

interface Shown {
  title: string;
  unit: string;
  decimals: number;
  of: (motion: Motion, time: number) => number;
  /** After which the quantity is the same again. */
  turn?: number;
}

const DEGREES = 180 / Math.PI;

const QUANTITIES: readonly Shown[] = [
  { title: "Centre’s height", unit: "mm", decimals: 2, of: (m, t) => m.pose(t).centre[2] * 1e3 },
  { title: "Inclination", unit: "°", decimals: 3, of: (m, t) => seenAngle(m.body, m.pose(t).inclination * DEGREES), turn: 360 },
  { title: "Velocity, up", unit: "m/s", decimals: 4, of: (m, t) => m.pose(t).velocity[2] },
  { title: "Spin", unit: "rad/s", decimals: 4, of: (m, t) => m.pose(t).spin[1] },
  { title: "Speed of end a", unit: "m/s", decimals: 4, of: (m, t) => Math.hypot(...endMotion(m.body, m.pose(t), "a").velocity) },
  { title: "Speed of end b", unit: "m/s", decimals: 4, of: (m, t) => Math.hypot(...endMotion(m.body, m.pose(t), "b").velocity) },
];

export class Numbers {
  private readonly cells = QUANTITIES.map(() => [make("td"), make("td"), make("td")] as const);

  constructor() {
    const head = ["Now", "discrete", "continuous", "difference"].map((title) => make("th", { scope: "col" }, title));
    const rows = QUANTITIES.map(({ title, unit }, i) =>
      make("tr", {}, make("th", { scope: "row" }, title, make("span", { class: "unit" }, unit)), ...(this.cells[i] ?? [])));
    byId("numbers-table").append(make("thead", {}, make("tr", {}, ...head)), make("tbody", {}, ...rows));
  }

  show({ discrete, continuous }: Motions, { title, times, comparable }: Moment): void {
    byId("numbers-title").textContent = title;
    QUANTITIES.forEach(({ decimals, of: value, turn }, i) => {
      const of = (motion: Motion, at: number): number => within(value(motion, at), turn);
      const a = discrete && times.discrete !== null ? of(discrete, times.discrete) : null;
      const b = continuous && times.continuous !== null ? of(continuous, times.continuous) : null;
      const [first, second, third] = this.cells[i] ?? [];
      if (first) first.textContent = a === null ? "–" : fixed(a, decimals);
      if (second) second.textContent = b === null ? "–" : fixed(b, decimals);
      if (third) third.textContent = a === null || b === null || !comparable ? "–" : fixed(within(b - a, turn), decimals);
    });
  }
}

/** The angle between −180° and 180° that is the same. */
function within(value: number, turn: number | undefined): number {
  return turn === undefined ? value : value - turn * Math.round(value / turn);
}

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
