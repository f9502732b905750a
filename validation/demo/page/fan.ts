// SPDX-License-Identifier: GPL-3.0-or-later
// Where prediction ends: no hand holds an angle to the last digit. The same drop, by the discrete model, for tilts that are spread evenly
// over what a hand's tremor makes of the one that is wanted: shares of what happens, and the digits that all have in common.
import { ask, type Impact, type SequenceAnswer } from "./api";
import { byId, make, press, say } from "./dom";
import { cut, digitsLeft, sharedDigits, significant, withKinds } from "./format";
import type { Frame } from "./frame";
import { spinOf } from "./models";
import { DiscreteMotion, touchRotation } from "./motion";
import { bodyOf, isInPlane, type Parameters } from "./parameters";
import { sequenceRequest } from "./requests";
import { product, turnAbout, type Rotation } from "./rotation";
import type { State } from "./state";
import { outcomeInWords, placeInWords } from "./words";

const IN_PLANE = 41; // tilts
const IN_SPACE = 61;
/** The situation stands still for so long before it is asked for [ms]. */
const DELAY = 300;
/** Of the picture: beyond this fewer silhouettes are drawn [ms a frame]. */
const SLUGGISH = 28;

interface Tilt {
  /** What strikes, blow by blow, and how it ends, if that is known. */
  course: string[];
  impacts: readonly Impact[];
  motion: DiscreteMotion;
  /** How much later than the wanted one it touches, let go at the same moment [s]. */
  late: number;
}

/** Small turns about horizontal axes: in the plane about the one across it, in space over a disc, evenly by its area. */
function turnsWithin(tremor: number, inPlane: boolean): Rotation[] {
  if (inPlane) return Array.from({ length: IN_PLANE }, (_, i) => turnAbout(1, tremor * ((2 * i + 1) / IN_PLANE - 1)));
  return Array.from({ length: IN_SPACE }, (_, i) => {
    const half = (tremor * Math.sqrt((i + 0.5) / IN_SPACE)) / 2;
    const way = (i + 0.5) * Math.PI * (3 - Math.sqrt(5));
    return [Math.cos(half), Math.sin(half) * Math.cos(way), Math.sin(half) * Math.sin(way), 0];
  });
}

const placeOf = ({ corners, end }: Impact): string => corners ?? end;

function courseOf({ impacts, outcome }: SequenceAnswer): string[] {
  return [...impacts.map(placeOf), ...(outcome === "impact-limit" ? [] : [`, ${outcome}`])];
}

/** From rest to the first touch [s]. */
function fallOf({ velocity_after, impulse }: Impact, mass: number, { drop, gravity }: Parameters): number {
  return drop === "height" && gravity > 0 ? (impulse[2] / mass - velocity_after[2]) / gravity : 0;
}

/** The first blow that is not the same for all, from 1; null if there is none. */
function partingOf(tilts: readonly Tilt[]): number | null {
  const most = Math.max(0, ...tilts.map(({ course }) => course.length));
  for (let n = 0; n < most; n++) if (new Set(tilts.map(({ course }) => course[n])).size > 1) return n + 1;
  return null;
}

function tiltOf(own: SequenceAnswer, wanted: SequenceAnswer, parameters: Parameters): Tilt {
  const body = { ...bodyOf(parameters), ...wanted.body };
  const fall = (answer: SequenceAnswer): number => fallOf(answer.impacts[0] as Impact, body.mass, parameters);
  return {
    course: courseOf(own), impacts: own.impacts, late: fall(own) - fall(wanted),
    motion: new DiscreteMotion(body, own.impacts, parameters.gravity, spinOf(parameters)),
  };
}

const MOST_ROWS = 12;
const MOST_SHARES = 6;
/** All that a double has. */
const ALL_DIGITS = 15;
const DEGREE = Math.PI / 180;

export class FanPanel {
  private readonly tremor = byId<HTMLSelectElement>("tremor");
  private readonly shown = byId<HTMLInputElement>("fan-shown");
  /** The drop that is wanted, and those that a hand makes of it. */
  private wanted: Tilt | null = null;
  private tilts: Tilt[] = [];
  private parting: number | null = null;
  private asked = 0;
  /** Where drawing takes long, only every n-th silhouette is shown. */
  private stride = 1;
  private drawnAt = 0;
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

  update(): void {
    const { parameters, tremor, hide } = this.state;
    if (hide.includes("fan")) return;
    byId("panel-fan").setAttribute("aria-busy", "true");
    byId("panel-fan").classList.add("computing");
    say("fan-said", "computing …");
    this.wanted = null;
    this.tilts = [];
    void this.ask(parameters, tremor * DEGREE);
  }

  /** @param tremor to either side [rad] */
  private async ask(situation: Parameters, tremor: number): Promise<void> {
    const parameters = { ...situation };
    this.asked += 1;
    const { asked } = this;
    await new Promise((resume) => setTimeout(resume, DELAY));
    const isOld = (): boolean => asked !== this.asked;
    if (isOld()) return;
    const request = sequenceRequest(parameters);
    const answer = await ask<SequenceAnswer>(request).catch(() => null);
    const first = answer?.impacts[0];
    const tilts: Tilt[] = [];
    const { angle: _angle, tilt: _tilt, orientation: _orientation, ...others } = request.body;
    for (const turn of answer && first ? turnsWithin(tremor, isInPlane(parameters)) : []) {
      const attitude = product(turn, touchRotation(first as Impact)).join(",");
      // A tilt that the program refuses, such as one at which a body would jam, has no course.
      const own = await ask<SequenceAnswer>({ path: "sequence", body: { ...others, attitude } }).catch(() => null);
      if (isOld()) return;
      if (own?.impacts.length) tilts.push(tiltOf(own, answer as SequenceAnswer, parameters));
    }
    if (isOld()) return;
    this.wanted = answer && first ? tiltOf(answer, answer, parameters) : null;
    this.tilts = tilts;
    this.parting = partingOf([...tilts, ...(this.wanted ? [this.wanted] : [])]);
    this.show();
  }

  /** Silhouettes at a time; those of the chosen course in the model's colour, the others in grey. */
  ghosts(time: number, playing: boolean): Frame["ghosts"] {
    if (!this.state.fan) return [];
    const now = performance.now();
    if (!playing) this.stride = 1;
    else if (now - this.drawnAt > SLUGGISH && now - this.drawnAt < 500) this.stride = Math.min(8, this.stride + 1);
    this.drawnAt = now;
    return this.tilts.filter((_tilt, i) => i % this.stride === 0).flatMap((tilt) => {
      const { motion, late } = tilt;
      if (time - late > motion.end) return [];
      const tone = this.stepOf(tilt) === this.chosen ? "fan" as const : "aside" as const;
      return [{ model: "discrete" as const, body: motion.body, pose: motion.pose(time - late), tone }];
    });
  }

  private stepOf({ course }: Tilt): string | undefined {
    const { parting } = this;
    return parting === null ? "" : course[parting - 1];
  }

  private show(): void {
    const { tilts, wanted, parting } = this;
    byId("panel-fan").setAttribute("aria-busy", "false");
    byId("panel-fan").classList.remove("computing");
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
    for (const tilt of this.parting === null ? [] : this.tilts) counts.set(this.stepOf(tilt), (counts.get(this.stepOf(tilt)) ?? 0) + 1);
    const shares = [...counts].sort(([, a], [, b]) => b - a).slice(0, MOST_SHARES);
    byId("fan-shares").replaceChildren(...shares.map(([step, count]) => {
      const part = count / this.tilts.length;
      const button = make("button", { type: "button", "aria-pressed": String(step === this.chosen), style: `--part:${part}` },
        make("b", {}, percent(part)), make("span", {}, stepInWords(step)));
      button.addEventListener("click", () => {
        this.chosen = step;
        press(byId("fan-shares").querySelectorAll("button"), (other) => other === button);
        this.onChange();
      });
      return make("li", {}, button);
    }));
  }

  /** A blow of the drop that is wanted, and what the others have of it. */
  private row(impact: Impact, i: number): HTMLElement {
    const { tilts, wanted } = this;
    const alike = tilts.filter(({ course }) => course.slice(0, i + 1).every((step, k) => step === wanted?.course[k]));
    const { impulse_normal: value, error_estimate: bars, amplification } = impact;
    const exact = impact.predictable === false ? 0 : Math.min(ALL_DIGITS, digitsLeft(value, bars?.impulse_normal));
    const hands = [value, ...tilts.map(({ impacts }) => impacts[i]?.impulse_normal ?? NaN)];
    const hand = alike.length === tilts.length ? Math.min(exact, sharedDigits(hands, ALL_DIGITS)) : 0;
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
