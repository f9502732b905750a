// SPDX-License-Identifier: GPL-3.0-or-later
// Play, pause, scrub, and step from impact to impact.
import { byId, make } from "./dom";
import { fixed, significant } from "./format";
import { RATES } from "./state";

export interface TransportActions {
  toggle(): void;
  step(direction: 1 | -1): void;
  scrub(progress: number): void;
  setRate(rate: number): void;
  setSlow(slow: boolean): void;
  playReal(): void;
}

const SCRUBBER_STEPS = 1000;

export class Transport {
  private readonly play = byId<HTMLButtonElement>("play");
  private readonly scrubber = byId<HTMLInputElement>("scrubber");
  private readonly marks = byId("impact-marks");
  private readonly time = byId("time");
  private readonly rate = byId<HTMLSelectElement>("rate");
  private readonly slow = byId<HTMLInputElement>("slow");
  private readonly pace = byId("pace");

  constructor(private readonly actions: TransportActions) {
    this.rate.append(...RATES.map((rate) => make("option", { value: rate }, rate === 1 ? "usual" : `${rate === 0.25 ? "¼" : rate === 0.5 ? "½" : rate} times`)));
    this.play.addEventListener("click", () => actions.toggle());
    byId("real").addEventListener("click", () => actions.playReal());
    byId("previous").addEventListener("click", () => actions.step(-1));
    byId("next").addEventListener("click", () => actions.step(1));
    this.scrubber.max = String(SCRUBBER_STEPS);
    this.scrubber.addEventListener("input", () => actions.scrub(Number(this.scrubber.value) / SCRUBBER_STEPS));
    this.rate.addEventListener("change", () => actions.setRate(Number(this.rate.value)));
    this.slow.addEventListener("change", () => actions.setSlow(this.slow.checked));
    document.addEventListener("keydown", (event) => this.onKey(event));
  }

  setSettings(rate: number, slow: boolean, lock: readonly string[]): void {
    this.rate.value = String(rate);
    this.slow.checked = slow;
    this.rate.disabled = lock.includes("rate");
    this.slow.disabled = lock.includes("slow");
  }

  setMarks(marks: readonly { place: number; name: string }[]): void {
    this.marks.replaceChildren(...marks.map(({ place, name }, i) => {
      const mark = make("span", {}, name);
      mark.style.left = `${(100 * place).toFixed(2)}%`;
      // Numbers of impacts that nearly coincide would cover each other.
      if (i > 0 && place - (marks[i - 1]?.place ?? 0) < 0.025) mark.textContent = "";
      return mark;
    }));
  }

  show(time: number, progress: number, playing: boolean, slowness: number): void {
    const pace = slowness < 1.05 && slowness > 0.95 ? "as fast as it happens" : slowness > 1 ? `${significant(slowness, 2)} times slower than life` : `${significant(1 / slowness, 2)} times faster than life`;
    if (this.pace.textContent !== pace) this.pace.textContent = pace;
    this.scrubber.value = String(Math.round(progress * SCRUBBER_STEPS));
    this.scrubber.setAttribute("aria-valuetext", `${fixed(time * 1e3, 1)} ms`);
    this.time.textContent = `${fixed(time * 1e3, Math.abs(time) < 0.1 ? 2 : 1)} ms`;
    this.play.setAttribute("aria-label", playing ? "Pause" : "Play");
    this.play.classList.toggle("playing", playing);
  }

  /** Space plays, arrows step, unless the key means something to the element that has the focus. */
  private onKey(event: KeyboardEvent): void {
    if (event.altKey || event.ctrlKey || event.metaKey) return;
    const target = event.target as HTMLElement;
    const takesKeys = /^(INPUT|SELECT|TEXTAREA)$/.test(target.tagName);
    const isCheckbox = target instanceof HTMLInputElement && target.type === "checkbox";
    const scrolls = target.getAttribute("tabindex") === "0" && target.id !== "stage";
    if (event.key === " " && !/^(SELECT|BUTTON|SUMMARY|A)$/.test(target.tagName) && !isCheckbox) {
      event.preventDefault();
      this.actions.toggle();
    } else if (event.key === "r" && !takesKeys) {
      this.actions.playReal();
    } else if (!event.shiftKey && (event.key === "ArrowRight" || event.key === "ArrowLeft") && (!takesKeys || isCheckbox) && !scrolls) {
      event.preventDefault();
      this.actions.step(event.key === "ArrowRight" ? 1 : -1);
    }
  }
}
