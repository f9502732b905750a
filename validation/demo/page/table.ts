// SPDX-License-Identifier: GPL-3.0-or-later
// The impact table of both models, and its CSV.
import type { Bars, Impact } from "./api";
import { byId, make } from "./dom";
import { cut, digitsLeft, significant, withKinds } from "./format";
import { MODELS, type ModelName } from "./frame";
import { growth, type Impacts, type Pairing } from "./models";
import { CONTINUOUS_DIGITS } from "./requests";

interface Column {
  title: string;
  /** The program's name of it, where only that tells it from its neighbour: with friction. */
  rubbing?: string;
  needsFriction?: true;
  /** A blow of the discrete model has none. */
  ofContinuous?: true;
  unit: string;
  value: (impact: Impact) => number | null;
  /** Its error bar, in the same unit. */
  error: (bars: Bars) => number | null | undefined;
  /** In place of a value. */
  words?: (impact: Impact) => string;
}

const COLUMNS: readonly Column[] = [
  { title: "Impulse", rubbing: "Pₙ", unit: "N·s", value: (i) => i.impulse_normal, error: (bars) => bars.impulse_normal },
  { title: "Pₜ", needsFriction: true, unit: "N·s", value: (i) => i.impulse_tangential, error: (bars) => bars.impulse_tangential },
  { title: "mode", needsFriction: true, unit: "", value: () => null, error: () => null, words: ({ mode }) => mode ?? "–" },
  { title: "Time", unit: "s", value: (i) => i.start, error: (bars) => bars.start },
  { title: "Angle", unit: "°", value: (i) => i.contact_angle_deg, error: (bars) => bars.contact_angle_deg },
  { title: "Velocity after", unit: "m/s", value: (i) => i.velocity_after[2], error: (bars) => bars.velocity_after?.[2] },
  {
    title: "Spin after", unit: "rad/s", value: (i) => i.angular_velocity_after[1],
    error: (bars) => bars.angular_velocity_after?.[1],
  },
  {
    // An elastic impact loses nothing; rounding and the step control leave a trace that would look like a loss.
    title: "Energy lost", unit: "J", value: (i) => (Math.abs(i.energy_loss) < 1e-5 * Math.abs(i.energy_before) ? 0 : i.energy_loss),
    error: (bars) => bars.energy_loss,
  },
  { title: "Lasts", ofContinuous: true, unit: "ms", value: (i) => (i.peak_force === null ? null : i.duration * 1e3), error: (bars) => (bars.duration ?? 0) * 1e3 },
  { title: "Peak force", ofContinuous: true, unit: "N", value: (i) => i.peak_force, error: (bars) => bars.peak_force },
];

const DIGITS: Readonly<Record<ModelName, number>> = { discrete: 6, continuous: CONTINUOUS_DIGITS };

export class ImpactTable {
  private readonly table = byId("impact-table");
  private readonly body = make("tbody");
  private readonly notes = byId("pairing");
  /** Of each column, whatever the model. */
  private largest: number[] = [];
  private readonly head = make("tr");
  private rubs = false;
  private lasts = true;

  constructor(private readonly onChoose: (model: ModelName, n: number) => void) {
    this.showHead();
    this.table.append(make("thead", {}, this.head), this.body);
  }

  private get columns(): readonly Column[] {
    return COLUMNS.filter(({ needsFriction, ofContinuous }) => (this.rubs || !needsFriction) && (this.lasts || !ofContinuous));
  }

  private showHead(): void {
    const heads = this.columns.map(({ title, rubbing, unit }) =>
      make("th", { scope: "col" }, (this.rubs && rubbing) || title, make("span", { class: "unit" }, unit)));
    const first = ["Impact", "Model", "Where"].map((title) => make("th", { scope: "col" }, title));
    this.head.replaceChildren(...first, ...heads);
    this.table.classList.toggle("rubs", this.rubs);
  }

  /** Rows of one impact stand together where it is the same in both models. */
  show(impacts: Impacts, pairing: Pairing | null, chosen: number): void {
    const paired = pairing?.count ?? 0;
    const all = MODELS.flatMap((model) => impacts[model] ?? []);
    const rubs = all.some(({ mode = "frictionless" }) => mode !== "frictionless");
    const lasts = all.some(({ peak_force: peak }) => peak !== null) || !document.body.classList.contains("discrete-only");
    if (rubs !== this.rubs || lasts !== this.lasts) {
      [this.rubs, this.lasts] = [rubs, lasts];
      this.showHead();
    }
    this.largest = this.columns.map(({ value }) => Math.max(0, ...all.map((impact) => Math.abs(value(impact) ?? 0))));
    const groups = Array.from({ length: paired }, (_, i) => MODELS.map((model) => ({ model, impact: impacts[model]?.[i] })));
    for (const model of MODELS) for (const impact of impacts[model]?.slice(paired) ?? []) groups.push([{ model, impact }]);
    // Rows that are replaced while the focus is on one of their buttons would lose it.
    const focused = (document.activeElement as HTMLElement | null)?.dataset["choose"];
    this.body.replaceChildren(...groups.flatMap((group) => this.rows(group, chosen)));
    if (focused) this.body.querySelector<HTMLElement>(`[data-choose="${focused}"]`)?.focus();
    const lines = [pairingInWords(impacts, pairing), ...MODELS.map((model) => unpredictableInWords(impacts[model] ?? [], model))];
    this.notes.replaceChildren(...lines.filter(Boolean).map((line) => make("p", {}, line)));
  }

  choose(chosen: number): void {
    for (const row of this.body.rows) {
      const isChosen = Number(row.dataset["impact"]) === chosen;
      row.classList.toggle("chosen", isChosen);
      row.querySelector("button")?.setAttribute("aria-pressed", String(isChosen));
    }
  }

  private rows(group: { model: ModelName; impact: Impact | undefined }[], chosen: number): HTMLTableRowElement[] {
    return group.flatMap(({ model, impact }, i) => {
      if (!impact) return [];
      const { n } = impact;
      // The chosen impact is the discrete model's, and the other's only where it is the same.
      const isOther = model === "continuous" && group.length === 1;
      const marks = [n === chosen && !isOther ? "chosen" : "", impact.predictable === false ? "unpredictable" : ""].filter(Boolean);
      const row = make("tr", { "data-impact": isOther ? "" : n, "data-model": model, class: marks.join(" ") });
      if (i === 0) row.append(this.button(n, n === chosen && !isOther, group.length, model));
      const where = (impact.corners ?? impact.end).replace(/-(?=[xyz])/g, "−");
      row.append(make("td", {}, make("span", { class: `swatch ${model}` }), model), make("td", {}, where));
      row.append(...this.columns.map((column, place) => cell(column, beyondRounding(column.value(impact), this.largest[place]), impact, model)));
      row.addEventListener("click", () => this.onChoose(model, n));
      return [row];
    });
  }

  private button(n: number, isChosen: boolean, rows: number, model: ModelName): HTMLElement {
    const alone = rows > 1 ? "" : ` of the ${model} model`;
    const choose = rows > 1 || model === "discrete" ? String(n) : `${model}-${n}`;
    const label = model === "continuous" ? `Show impact ${n}${alone}` : `Explain impact ${n}${alone}`;
    const button = make("button", {
      type: "button", "data-choose": choose, "aria-pressed": String(isChosen), "aria-label": label,
    }, String(n));
    return make("th", { scope: "rowgroup", rowspan: rows }, button);
  }
}

/** "Impact 3 is not the same in both models: …; nor are those that follow." */
function pairingInWords({ discrete, continuous }: Impacts, pairing: Pairing | null): string {
  if (!pairing?.reason) return "";
  const next = pairing.count + 1;
  const follow = Math.max(discrete?.length ?? 0, continuous?.length ?? 0) > next ? "; nor are those that follow" : "";
  return `Impact ${next} is not the same in both models: ${pairing.reason.replace(/-(?=[xyz])/g, "−")}${follow}.`;
}

function unpredictableInWords(impacts: readonly Impact[], model: ModelName): string {
  const first = impacts.find(({ predictable }) => predictable === false);
  return first ? `?: in the ${model} model impact ${first.n} cannot be predicted, nor what follows${growth(first)}.` : "";
}

/** Digits that the error bar takes away fade. */
function cell({ title, error, words }: Column, value: number | null, impact: Impact, model: ModelName): HTMLElement {
  if (impact.predictable === false) return make("td", { class: "number", "data-column": title, title: "Cannot be predicted" }, "?");
  if (words) return make("td", { class: "number", "data-column": title }, words(impact));
  const bar = (impact.error_estimate && error(impact.error_estimate)) ?? 0;
  const left = digitsLeft(value ?? 0, bar);
  const told = left < DIGITS[model] ? { title: `± ${significant(bar, 2)}` } : {};
  return make("td", { class: "number", "data-column": title, ...told }, ...withKinds(cut(significant(value, DIGITS[model]), [left]), ["", "lost"]));
}

/** Rounding leaves a trace of what is zero by symmetry. */
function beyondRounding(value: number | null, largest = 0): number | null {
  return value !== null && Math.abs(value) < 1e-12 * largest ? 0 : value;
}

const CSV: readonly [string, (impact: Impact) => number | string | null][] = [
  ["n", (i) => i.n], ["end", (i) => i.end], ["corners", (i) => i.corners ?? ""],
  ["predictable", (i) => String(i.predictable !== false)], ["start_s", (i) => i.start], ["duration_s", (i) => i.duration],
  ["inclination_deg", (i) => i.inclination_deg], ["contact_angle_deg", (i) => i.program_angle_deg ?? i.contact_angle_deg],
  ["approach_speed_m_s", (i) => i.approach_speed], ["restitution", (i) => i.restitution],
  ["impulse_normal_N_s", (i) => i.impulse_normal], ["impulse_tangential_N_s", (i) => i.impulse_tangential],
  ["peak_force_N", (i) => i.peak_force], ["velocity_x_m_s", (i) => i.velocity_after[0]], ["velocity_y_m_s", (i) => i.velocity_after[1]],
  ["velocity_z_m_s", (i) => i.velocity_after[2]], ["spin_rad_s", (i) => i.angular_velocity_after[1]],
  ["spin_x_rad_s", (i) => i.angular_velocity_after[0]], ["spin_z_rad_s", (i) => i.angular_velocity_after[2]],
  ["energy_before_J", (i) => i.energy_before], ["energy_after_J", (i) => i.energy_after], ["energy_loss_J", (i) => i.energy_loss],
  ["mode", (i) => i.mode ?? ""],
];

/** All digits that the program gave; a number that a model does not have is empty. */
export function csvOf(impacts: Impacts): string {
  const rows = MODELS.flatMap((model) =>
    (impacts[model] ?? []).map((impact) => [model, ...CSV.map(([, value]) => value(impact) ?? "")].join(",")));
  return [["model", ...CSV.map(([name]) => name)].join(","), ...rows].join("\n") + "\n";
}
