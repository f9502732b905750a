// SPDX-License-Identifier: GPL-3.0-or-later
// The sequence of impacts as a strip of pictures: the discrete model's above, those of the continuous one below.
import type { Impact } from "./answers";
import { lowestPlace } from "./body";
import { byId, make, svg } from "./dom";
import { significant } from "./format";
import { MODELS, type ModelName, type Motions } from "./frame";
import { touchRotation, type Motion } from "./motion";
import type { Pairing } from "./pairing";
import { sketch } from "./sketch";
import { cornersInWords } from "./words";

/** More pictures than these nobody looks at; they are as many as the page's own slider asks for. */
const MOST = 20;

export class Strip {
  private readonly rows = byId("strip-rows");

  constructor(private readonly onChoose: (model: ModelName, n: number) => void) {
    byId("strip-marks").append(...MODELS.map(arrowHead));
  }

  show(motions: Motions, pairing: Pairing | null, chosen: number): void {
    const focused = (document.activeElement as HTMLElement | null)?.dataset["strip"];
    this.rows.replaceChildren(...MODELS.flatMap((model) => {
      const motion = motions[model];
      if (!motion) return [];
      const cards = motion.impacts.slice(0, MOST).map((impact) => make("li", {}, this.card(model, motion, impact, pairing)));
      const rest = motion.impacts.length - MOST;
      if (rest > 0) cards.push(make("li", { class: "rest" }, `and ${rest} more in the table`));
      return [make("li", {}, make("p", { class: "name" }, make("span", { class: `swatch ${model}` }), `${model} model`),
        make("ol", { class: "cards" }, ...cards))];
    }));
    this.choose(chosen);
    if (focused) this.rows.querySelector<HTMLElement>(`[data-strip="${focused}"]`)?.focus();
  }

  choose(chosen: number): void {
    for (const card of this.rows.querySelectorAll<HTMLElement>("button[data-strip]")) {
      const isChosen = card.dataset["strip"] === `discrete-${chosen}`;
      card.setAttribute("aria-pressed", String(isChosen));
    }
  }

  private card(model: ModelName, motion: Motion, impact: Impact, pairing: Pairing | null): HTMLElement {
    const { n } = impact;
    const rotation = model === "discrete" ? touchRotation(impact) : motion.pose(impact.start).rotation;
    const strongest = Math.max(...motion.impacts.map(({ impulse }) => Math.hypot(...impulse)));
    const isUnknown = impact.predictable === false;
    const isAlone = pairing !== null && n > pairing.count;
    const where = impact.corners ? cornersInWords(impact.corners) : `end ${impact.end}`;
    const force = isUnknown ? "unpredictable" : `${significant(impact.impulse_normal, 3)} N·s`;
    const alone = isAlone ? ", not the same blow in both models" : "";
    const button = make("button", {
      type: "button", "data-strip": `${model}-${n}`, class: [isUnknown ? "unpredictable" : "", isAlone ? "alone" : ""].join(" ").trim(),
    }, make("b", {}, `${n}${isUnknown ? "?" : ""}`), make("span", {}, force),
    make("span", { class: "spoken" }, ` impact of the ${model} model, ${where}${alone}`));
    button.append(sketch({ model, body: motion.body, rotation, struck: lowestPlace(motion.body, rotation), impulse: impact.impulse, strongest }));
    button.addEventListener("click", () => this.onChoose(model, n));
    return button;
  }
}

function arrowHead(model: ModelName): SVGElement {
  const marker = svg("marker", { id: `tip-${model}`, viewBox: "0 0 6 6", refX: 4, refY: 3, markerWidth: 4, markerHeight: 4, orient: "auto" });
  marker.append(svg("path", { d: "M0,0L6,3L0,6Z" }));
  return marker;
}
