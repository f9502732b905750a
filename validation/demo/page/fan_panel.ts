// SPDX-License-Identifier: GPL-3.0-or-later
// What a hand's tremor leaves of the prediction: shares of what happens, and the digits that all tilts have in common.
import type { Impact } from "./answers";
import { cut, digitsLeft, withKinds } from "./digits";
import { byId, make, say } from "./dom";
import { Fan, placeOf, type Tilt } from "./fan";
import { significant } from "./format";
import type { Frame } from "./frame";
import type { State } from "./state";
import { outcomeInWords, placeInWords } from "./words";

const MOST_ROWS = 12;
const MOST_SHARES = 6;
/** All that a double has. */
const ALL_DIGITS = 15;
const DEGREE = Math.PI / 180;

export class FanPanel {
  private readonly tremor = byId<HTMLSelectElement>("tremor");
  private readonly shown = byId<HTMLInputElement>("fan-shown");
  private readonly fan = new Fan(() => this.show());
  /** The next step of the course by which drops stand out. */
  private chosen: string | undefined;

  constructor(private readonly state: State, private readonly onChange: () => void) {
    this.tremor.value = String(state.tremor);
    this.shown.checked = state.fan;
    this.tremor.addEventListener("change", () => {
      state.tremor = Number(this.tremor.value);
      this.update();
      onChange();
    });
    this.shown.addEventListener("change", () => { state.fan = this.shown.checked; onChange(); });
  }

  /** The situation changed. */
  update(): void {
    const { parameters, tremor, hide } = this.state;
    if (hide.includes("fan")) return;
    byId("panel-fan").setAttribute("aria-busy", "true");
    this.fan.wanted = null;
    this.fan.tilts = [];
    void this.fan.ask(parameters, tremor * DEGREE);
  }

  ghosts(time: number, playing: boolean): Frame["ghosts"] {
    if (!this.state.fan) return [];
    return this.fan.ghosts(time, playing, (tilt) => this.stepOf(tilt) === this.chosen);
  }

  /** What happens where the drops part. */
  private stepOf({ course }: Tilt): string | undefined {
    const { parting } = this.fan;
    return parting === null ? "" : course[parting - 1];
  }

  private show(): void {
    const { tilts, wanted, parting } = this.fan;
    byId("panel-fan").setAttribute("aria-busy", "false");
    this.chosen = wanted ? this.stepOf(wanted) : undefined;
    const within = `Of ${tilts.length} drops that a hand lets go within ${this.state.tremor}°`;
    const same = parting === null ? " all strike the same places, one after the other."
      : parting === 1 ? " not all strike with the same place. The first blow is struck by:" : ` all are alike up to blow ${parting - 1}. Blow ${parting} is struck by:`;
    say("fan-said", tilts.length ? within + same : "");
    this.showShares();
    byId("fan-rows").replaceChildren(...(wanted?.impacts ?? []).slice(0, MOST_ROWS).map((impact, i) => this.row(impact, i)));
    this.onChange();
  }

  private showShares(): void {
    const counts = new Map<string | undefined, number>();
    for (const tilt of this.fan.parting === null ? [] : this.fan.tilts) counts.set(this.stepOf(tilt), (counts.get(this.stepOf(tilt)) ?? 0) + 1);
    const shares = [...counts].sort(([, a], [, b]) => b - a).slice(0, MOST_SHARES);
    byId("fan-shares").replaceChildren(...shares.map(([step, count]) => {
      const part = count / this.fan.tilts.length;
      const button = make("button", { type: "button", "aria-pressed": String(step === this.chosen), style: `--part:${part}` },
        make("b", {}, percent(part)), make("span", {}, stepInWords(step)));
      button.addEventListener("click", () => {
        this.chosen = step;
        for (const other of byId("fan-shares").querySelectorAll("button")) other.setAttribute("aria-pressed", String(other === button));
        this.onChange();
      });
      return make("li", {}, button);
    }));
  }

  /** A blow of the drop that is wanted, and what the others have of it. */
  private row(impact: Impact, i: number): HTMLElement {
    const { tilts, wanted } = this.fan;
    const alike = tilts.filter(({ course }) => course.slice(0, i + 1).every((step, k) => step === wanted?.course[k]));
    const apart = Math.max(...alike.map(({ impacts }) => Math.abs((impacts[i]?.impulse_normal ?? NaN) - impact.impulse_normal)));
    const { impulse_normal: value, error_estimate: bars, amplification } = impact;
    const exact = impact.predictable === false ? 0 : Math.min(ALL_DIGITS, digitsLeft(value, bars?.impulse_normal));
    const hand = alike.length === tilts.length ? Math.min(exact, digitsLeft(value, apart)) : 0;
    const digits = withKinds(cut(significant(value, ALL_DIGITS), [hand, exact]), ["", "exact", "lost"]);
    const said = make("span", { class: "spoken" }, ` ${hand} digits for every tilt, ${exact} for the exact one`);
    return make("tr", {}, make("th", { scope: "row" }, String(impact.n)),
      make("td", { class: "number digits" }, ...digits, said), make("td", {}, placeInWords(placeOf(impact))),
      make("td", { class: "number" }, percent(alike.length / tilts.length)),
      make("td", { class: "number" }, amplification ? `${significant(amplification, 2)} times` : "–"));
  }
}

const percent = (part: number): string => `${significant(100 * part, part === 1 ? 3 : 2)} %`;

function stepInWords(step: string | undefined): string {
  if (step === undefined) return "more blows than were asked for";
  return step.startsWith(", ") ? `none: ${outcomeInWords(step.slice(2)).toLowerCase()}` : placeInWords(step);
}
