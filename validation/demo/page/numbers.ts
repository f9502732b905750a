// SPDX-License-Identifier: GPL-3.0-or-later
// The numbers of the picture: both models at the moment that is shown, aligned by blow, and what lies between them.
import { seenAngle } from "./body";
import { byId, make } from "./dom";
import { fixed } from "./format";
import type { Motions } from "./frame";
import type { Moment } from "./moment";
import { endMotion, type Motion } from "./motion";

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
