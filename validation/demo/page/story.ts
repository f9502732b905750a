// SPDX-License-Identifier: GPL-3.0-or-later
// The story that the build wrote into the page. Once it is asked for, the picture stays while one scrolls: the step that comes up is put
// there as it is before the drop, asks for a guess, plays, and tells what happened when the picture has shown it.
import type { Impact } from "./api";
import { byId } from "./dom";
import { assignUnlocked, stateOf, type State } from "./state";

interface Teller {
  /** A new situation in the picture, before the drop. */
  onEnter(): void;
  onPlay(): void;
  /** The picture stays at a time. */
  onStop(time: number): void;
  /** The picture at an impact. */
  onShow(): void;
}

/** The line of the window that a step has to reach: below the picture. */
const LINE = "-74% 0px -25% 0px";

/** What a step's link says. */
function linkOf(step: HTMLElement): string {
  return new URL((step.querySelector("a") as HTMLAnchorElement).href).hash.slice(1);
}

export class Story {
  private readonly steps = [...document.querySelectorAll<HTMLElement>("#story li")];
  private readonly button = byId<HTMLButtonElement>("story-start");
  private readonly watcher = new IntersectionObserver((seen) => this.arrived(seen), { rootMargin: LINE });
  private current: HTMLElement | null = null;
  /** Of the current step; the drop that it tells of. */
  private impacts: readonly Impact[] | null = null;
  private n = 1;
  /** The guessed step plays on, and the next one asks about what comes. */
  private mustStop = false;
  /** What the reader had before the story. */
  private own: State | null = null;

  constructor(private readonly state: State, private readonly teller: Teller) {
    this.button.addEventListener("click", () => this.tell(!document.body.classList.contains("telling")));
    for (const step of this.steps) {
      const link = step.querySelector("a") as HTMLAnchorElement;
      if (this.isLocked) link.removeAttribute("href");
      link.addEventListener("click", (event) => {
        event.preventDefault();
        if (this.isLocked) return;
        this.put(step);
        this.reveal(step);
        this.bringUp(step);
        teller.onShow();
      });
      step.addEventListener("focusin", () => { if (!this.isLocked) this.enter(step); });
      for (const choice of step.querySelectorAll("button")) choice.addEventListener("click", () => this.guess(step, choice));
    }
  }

  /** The drop that the picture now has. */
  setImpacts(impacts: readonly Impact[]): void {
    this.impacts = impacts;
  }

  /** What the picture shows; once that is the blow that the step tells of, or the end, it tells. */
  seen(time: number, ended: boolean): void {
    const step = this.current;
    if (!step || !this.impacts) return;
    const [blow, next] = this.impacts.slice(this.n - 1);
    if (step.dataset["state"] === "waits" && (blow ? time >= blow.start : ended)) this.reveal(step);
    const stop = blow && next ? (blow.start + next.start) / 2 : Infinity;
    if (!this.mustStop || time < stop) return;
    this.mustStop = false;
    this.teller.onStop(stop);
  }

  /** Whether the step after this one asks about the same drop, and has not told. */
  private asksOn(step: HTMLElement): boolean {
    const next = this.steps[this.steps.indexOf(step) + 1];
    const dropOf = (one: HTMLElement): string => linkOf(one).replace(/&impact=.*/, "");
    return next !== undefined && dropOf(next) === dropOf(step) && next.dataset["state"] !== "tells";
  }

  private get isLocked(): boolean {
    return this.state.lock.includes("story");
  }

  private tell(on: boolean): void {
    document.body.classList.toggle("telling", on);
    this.button.setAttribute("aria-expanded", String(on));
    this.button.textContent = on ? "End the story" : "Tell it";
    this.watcher.disconnect();
    this.current = null;
    this.mark();
    if (this.isLocked) return;
    if (on) this.own = { ...this.state, parameters: { ...this.state.parameters } };
    else if (this.own) this.giveBack(this.own);
    if (!on) return;
    for (const step of this.steps) {
      step.dataset["state"] ??= "asks";
      this.watcher.observe(step);
    }
    if (this.steps[0]) this.bringUp(this.steps[0]);
  }

  private giveBack({ parameters, impact, time }: State): void {
    Object.assign(this.state.parameters, parameters);
    Object.assign(this.state, { impact, time });
    this.teller.onShow();
  }

  private arrived(seen: IntersectionObserverEntry[]): void {
    const step = seen.find(({ isIntersecting }) => isIntersecting)?.target;
    if (step) this.enter(step as HTMLElement);
  }

  private enter(step: HTMLElement): void {
    if (this.current === step || !document.body.classList.contains("telling")) return;
    this.put(step);
    this.teller.onEnter();
  }

  /** The step's situation into the page's. */
  private put(step: HTMLElement): void {
    this.current = step;
    this.impacts = null;
    this.mustStop = false;
    const wanted = stateOf(linkOf(step));
    this.n = wanted.impact;
    assignUnlocked(this.state, wanted.parameters);
    Object.assign(this.state, { impact: wanted.impact, time: NaN });
    this.mark();
  }

  private guess(step: HTMLElement, choice: HTMLButtonElement): void {
    if (step.dataset["state"] !== "asks") return;
    this.enter(step);
    this.bringUp(step);
    choice.dataset["chosen"] = "";
    step.dataset["state"] = "waits";
    this.say(step, "Watch …");
    this.mark();
    this.mustStop = this.asksOn(step);
    this.teller.onPlay();
  }

  /** Else the one that stands there now would come back as soon as something moves. */
  private bringUp(step: HTMLElement): void {
    step.scrollIntoView({ block: "end" });
  }

  private reveal(step: HTMLElement): void {
    const chosen = step.querySelector<HTMLElement>("[data-chosen]");
    const right = step.querySelector<HTMLElement>("[data-right]");
    if (chosen && step.dataset["state"] === "waits") this.say(step, chosen === right ? "You guessed it." : `A surprise: ${right?.textContent?.toLowerCase() ?? ""}.`);
    if (step.dataset["state"]) step.dataset["state"] = "tells";
    this.mark();
  }

  private say(step: HTMLElement, words: string): void {
    const line = step.querySelector(".verdict");
    if (line) line.textContent = words;
  }

  /** Which step the picture shows; while that asks, or the next one about the same drop, nothing else on the page may tell. */
  private mark(): void {
    for (const step of this.steps) step.toggleAttribute("data-current", step === this.current && document.body.classList.contains("telling"));
    const state = this.current?.dataset["state"];
    document.body.classList.toggle("asking", document.body.classList.contains("telling") && (state === "asks" || state === "waits" || (this.current !== null && this.asksOn(this.current))));
  }
}
