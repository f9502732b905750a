// SPDX-License-Identifier: GPL-3.0-or-later
// The numbers of the picture: both models at the moment that is shown, aligned by blow, and what lies between them. Never does a moment
// before a blow of the one stand beside one after it of the other.
import type { Impact } from "./api";
import { seenAngle, type Body } from "./body";
import { byId } from "./dom";
import { fixed, significant } from "./format";
import { MODELS, type ModelName, type Motions } from "./frame";
import type { Pairing } from "./models";
import { pointMotion, shownTime, type Energies, type Pose } from "./motion";

const DEGREES = 180 / Math.PI;

const speedOf = (body: Body, pose: Pose, end: -1 | 1): number => Math.hypot(...pointMotion(body, pose, [(end * body.length) / 2, 0, 0]).velocity);

/** The rows of the table; `turn`: after which the quantity is the same again. */
const QUANTITIES: readonly { decimals: number; of(pose: Pose, body: Body): number; turn?: number }[] = [
  { decimals: 2, of: ({ centre }) => centre[2] * 1e3 },
  { decimals: 3, of: ({ inclination }, body) => seenAngle(body, inclination * DEGREES), turn: 360 },
  { decimals: 4, of: ({ velocity }) => velocity[2] },
  { decimals: 4, of: ({ spin }) => spin[1] },
  { decimals: 4, of: (pose, body) => speedOf(body, pose, -1) },
  { decimals: 4, of: (pose, body) => speedOf(body, pose, 1) },
];

/** Into a row of a table, by columns after its head. */
function write(table: string, row: number, column: number, text: string): void {
  const cell = byId<HTMLTableElement>(table).tBodies[0]?.rows[row]?.cells[column + 1];
  if (cell) cell.textContent = text;
}

export function showNumbers(motions: Motions, { title, times, comparable }: Moment): void {
  byId("numbers-title").textContent = title;
  const poses = MODELS.map((model) => {
    const [motion, time] = [motions[model], times[model]];
    return motion && time !== null ? { body: motion.body, pose: motion.pose(time) } : null;
  });
  QUANTITIES.forEach(({ decimals, of, turn }, row) => {
    const [a = null, b = null] = poses.map((shown) => shown && within(of(shown.pose, shown.body), turn));
    const difference = a === null || b === null || !comparable ? null : within(b - a, turn);
    [a, b, difference].forEach((value, column) => write("numbers-table", row, column, value === null ? "–" : fixed(value, decimals)));
  });
}

const PARTS = ["translation", "rotation", "potential", "ground", "lost"] as const;

/** One bar a model, and a column of the table; its parts add up to the energy at the start. */
export function showEnergies(model: ModelName, energies: Energies | null, isOver: boolean): void {
  const bar = byId(`energy-${model}`);
  bar.classList.toggle("empty", energies === null);
  bar.classList.toggle("over", isOver);
  byId(`energy-name-${model}`).textContent = isOver ? `${model}, ends here` : model;
  const column = MODELS.indexOf(model);
  const sum = energies ? PARTS.reduce((all, part) => all + energies[part], 0) : 0;
  const strip = bar.querySelectorAll<HTMLElement>(".strip span");
  PARTS.forEach((part, row) => {
    // Rounding leaves losses such as −1e-16.
    const value = energies ? Math.max(0, energies[part]) : 0;
    strip[row]?.style.setProperty("flex-grow", String(sum > 0 ? value / sum : 0));
    write("energy-table", row, column, energies ? amount(value, sum) : "–");
  });
  write("energy-table", PARTS.length, column, energies ? significant(sum, 4) : "–");
}

/** To the last place of the total, so that the parts visibly add up. */
function amount(value: number, sum: number): string {
  return value.toFixed(sum > 0 ? Math.min(9, Math.max(0, 3 - Math.floor(Math.log10(sum)))) : 3);
}

/** The angle between −180° and 180° that is the same. */
function within(value: number, turn: number | undefined): number {
  return turn === undefined ? value : value - turn * Math.round(value / turn);
}

export interface Moment {
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
