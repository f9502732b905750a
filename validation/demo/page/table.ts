// The impact table of both models, and its CSV.
import type { Impact } from "./answers";
import { byId, make } from "./dom";
import { significant } from "./format";
import type { ModelName } from "./frame";
import { CONTINUOUS_DIGITS } from "./requests";

interface Column {
  title: string;
  unit: string;
  value: (impact: Impact) => number | null;
}

const COLUMNS: readonly Column[] = [
  { title: "Time", unit: "s", value: (i) => i.start },
  { title: "Angle", unit: "°", value: (i) => i.contact_angle_deg },
  { title: "Impulse", unit: "N·s", value: (i) => i.impulse_normal },
  { title: "Velocity after", unit: "m/s", value: (i) => i.velocity_after[2] },
  { title: "Spin after", unit: "rad/s", value: (i) => i.angular_velocity_after[1] },
  { title: "Lasts", unit: "ms", value: (i) => (i.peak_force === null ? null : i.duration * 1e3) },
  { title: "Peak force", unit: "N", value: (i) => i.peak_force },
  { title: "Energy lost", unit: "J", value: (i) => lossWithoutRounding(i) },
];

const DIGITS: Readonly<Record<ModelName, number>> = { discrete: 6, continuous: CONTINUOUS_DIGITS };

export type Impacts = Record<ModelName, readonly Impact[] | null>;

export class ImpactTable {
  private readonly table = byId("impact-table");
  private readonly body = make("tbody");

  constructor(private readonly onChoose: (n: number) => void) {
    const heads = COLUMNS.map(({ title, unit }) => make("th", { scope: "col" }, title, make("span", { class: "unit" }, unit)));
    const first = ["Impact", "Model", "End"].map((title) => make("th", { scope: "col" }, title));
    this.table.append(make("thead", {}, make("tr", {}, ...first, ...heads)), this.body);
  }

  show(impacts: Impacts, chosen: number): void {
    const count = Math.max(impacts.discrete?.length ?? 0, impacts.continuous?.length ?? 0);
    // Rows that are replaced while the focus is on one of their buttons would lose it.
    const focused = (document.activeElement as HTMLElement | null)?.dataset["choose"];
    this.body.replaceChildren(...Array.from({ length: count }, (_, i) => this.rows(impacts, i + 1, chosen)).flat());
    if (focused) this.body.querySelector<HTMLElement>(`[data-choose="${focused}"]`)?.focus();
  }

  choose(chosen: number): void {
    for (const row of this.body.rows) {
      const isChosen = Number(row.dataset["impact"]) === chosen;
      row.classList.toggle("chosen", isChosen);
      row.querySelector("button")?.setAttribute("aria-pressed", String(isChosen));
    }
  }

  private rows(impacts: Impacts, n: number, chosen: number): HTMLTableRowElement[] {
    const models = (["discrete", "continuous"] as const).filter((model) => impacts[model]?.[n - 1]);
    return models.map((model, i) => {
      const impact = impacts[model]?.[n - 1] as Impact;
      const row = make("tr", { "data-impact": n, "data-model": model, class: n === chosen ? "chosen" : "" });
      if (i === 0) {
        const button = make("button", {
          type: "button", "data-choose": n, "aria-pressed": String(n === chosen), "aria-label": `Explain impact ${n}`,
        }, String(n));
        row.append(make("th", { scope: "rowgroup", rowspan: models.length }, button));
      }
      row.append(make("td", {}, make("span", { class: `swatch ${model}` }), model), make("td", {}, impact.end));
      row.append(...COLUMNS.map(({ title, value }) => cell(title, value(impact), impact, model)));
      row.addEventListener("click", () => this.onChoose(n));
      return row;
    });
  }
}

function cell(title: string, value: number | null, impact: Impact, model: ModelName): HTMLElement {
  if (impact.predictable === false) return make("td", { class: "number", "data-column": title, title: "Cannot be predicted" }, "?");
  return make("td", { class: "number", "data-column": title }, significant(value, DIGITS[model]));
}

/** An elastic impact loses nothing; rounding and the step control leave a trace that would look like a loss. */
function lossWithoutRounding({ energy_loss, energy_before }: Impact): number {
  return Math.abs(energy_loss) < 1e-5 * Math.abs(energy_before) ? 0 : energy_loss;
}

const CSV: readonly [string, (impact: Impact) => number | string | null][] = [
  ["n", (i) => i.n], ["end", (i) => i.end], ["start_s", (i) => i.start], ["duration_s", (i) => i.duration],
  ["inclination_deg", (i) => i.inclination_deg], ["contact_angle_deg", (i) => i.contact_angle_deg],
  ["approach_speed_m_s", (i) => i.approach_speed], ["restitution", (i) => i.restitution],
  ["impulse_normal_N_s", (i) => i.impulse_normal], ["impulse_tangential_N_s", (i) => i.impulse_tangential],
  ["peak_force_N", (i) => i.peak_force], ["velocity_x_m_s", (i) => i.velocity_after[0]],
  ["velocity_z_m_s", (i) => i.velocity_after[2]], ["spin_rad_s", (i) => i.angular_velocity_after[1]],
  ["energy_before_J", (i) => i.energy_before], ["energy_after_J", (i) => i.energy_after], ["energy_loss_J", (i) => i.energy_loss],
];

/** All digits that the program gave; a number that a model does not have is empty. */
export function csvOf(impacts: Impacts): string {
  const rows = (["discrete", "continuous"] as const).flatMap((model) =>
    (impacts[model] ?? []).map((impact) => [model, ...CSV.map(([, value]) => value(impact) ?? "")].join(",")));
  return [["model", ...CSV.map(([name]) => name)].join(","), ...rows].join("\n") + "\n";
}

export function download(name: string, text: string): void {
  const url = URL.createObjectURL(new Blob([text], { type: "text/csv" }));
  make("a", { href: url, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(url), 10_000);
}
