// SPDX-License-Identifier: GPL-3.0-or-later
// Panels and switches that only show the state: what is hidden, how the models are laid out, the lecture, and what is printed.
import { byId, press, say } from "./dom";
import { PANELS, isFixed, type State } from "./state";

export function hidePanels({ hide }: State): void {
  for (const panel of [...PANELS, "controls"]) byId(panel === "story" ? "story" : `panel-${panel}`).hidden = hide.includes(panel);
  const hidesAnswers = hide.includes("answers");
  for (const id of ["answers-print", "lesson-print", "lecture", "print"]) byId(id).hidden = hidesAnswers;
  // Nor does paper tell: a handout ends at its fold.
  document.body.classList.toggle("no-answers", hidesAnswers);
  document.body.classList.toggle("no-controls", hide.includes("controls"));
}

/** One panel at a time, or all of them; on paper all. */
export class Tabs {
  private readonly buttons = [...document.querySelectorAll<HTMLButtonElement>("#tabs button")];

  constructor(private readonly state: State, private readonly onChoose: () => void) {
    for (const button of this.buttons) {
      button.hidden = state.hide.includes(button.dataset["tab"] ?? "");
      button.addEventListener("click", () => this.choose(button.dataset["tab"] ?? ""));
    }
    this.show();
  }

  /** A panel that says nothing of this situation is not offered. */
  setUsable(panel: string, isUsable: boolean): void {
    byId(`panel-${panel}`).classList.toggle("unused", !isUsable);
    for (const button of this.buttons) if (button.dataset["tab"] === panel) button.hidden = !isUsable || this.state.hide.includes(panel);
    if (!isUsable && this.state.tab === panel) this.choose("strip");
  }

  private choose(tab: string): void {
    this.state.tab = tab;
    this.show();
    this.onChoose();
  }

  private show(): void {
    const { tab } = this.state;
    press(this.buttons, ({ dataset }) => dataset["tab"] === tab);
    for (const panel of document.querySelectorAll<HTMLElement>("#results > section")) {
      panel.classList.toggle("aside", tab !== "all" && panel.dataset["tab"] !== tab);
    }
  }
}

/** On a narrow screen what is not always needed opens by a button. */
export function setUpOpening(): void {
  for (const button of document.querySelectorAll<HTMLButtonElement>("button[data-opens]")) {
    button.addEventListener("click", () => {
      const isOpen = byId(button.dataset["opens"] ?? "").classList.toggle("open");
      button.setAttribute("aria-expanded", String(isOpen));
    });
  }
}

/** @return shows the layout of the state */
export function setUpLayout(state: State, onChange: () => void): () => void {
  const buttons = [...document.querySelectorAll<HTMLButtonElement>("button[data-layout]")];
  const show = (): void => {
    byId("stage").dataset["layout"] = state.layout;
    press(buttons, ({ dataset }) => dataset["layout"] === state.layout);
  };
  for (const button of buttons) {
    button.disabled = state.lock.includes("layout");
    button.addEventListener("click", () => {
      state.layout = button.dataset["layout"] as State["layout"];
      show();
      onChange();
    });
  }
  show();
  return show;
}

/** The touch that a handout asks about, with the body near to the ground [s]. */
const BEFORE = -1e-4;
const SHEETS = ["handout", "lesson", "exercises", "answers"];

/**
 * All of it; or a page for a class: the drop, its blows and questions, with the picture before the drop; or a sheet of words alone.
 * What a link lets nobody change no question asks to change.
 * @param moment the chosen impact and the time of the picture
 * @param put shows them
 */
export function setUpPrinting(state: State, moment: () => [number, number], put: (n: number, time: number) => void): void {
  let before: [number, number] | null = null;
  const { parameters: { turn }, lock } = state;
  const canTilt = !isFixed(state) && !lock.includes("angle") && (turn === "plane" || turn === "tilted");
  byId("handout-try").textContent = canTilt ? "Halve the angle. What happens to the time between the first two blows? Guess, then try."
    : "Where does the body strike, blow by blow, and how long is it between two blows? Draw it, then step from blow to blow.";
  byId("print").addEventListener("click", () => print());
  for (const sheet of SHEETS) {
    byId(`${sheet}-print`).addEventListener("click", () => {
      document.body.classList.add(sheet);
      if (sheet === "handout") {
        before = moment();
        put(1, BEFORE);
      }
      print();
    });
  }
  addEventListener("afterprint", () => {
    document.body.classList.remove(...SHEETS);
    if (before) put(...before);
    before = null;
  });
}

export function setUpLecture(onVoting: (on: boolean) => void, onChange: () => void): void {
  const button = byId<HTMLButtonElement>("lecture");
  const show = (on: boolean): void => {
    document.body.classList.toggle("lecture", on);
    button.setAttribute("aria-pressed", String(on));
    button.textContent = on ? "End the lecture" : "Lecture";
    onVoting(on);
    onChange();
  };
  button.addEventListener("click", () => {
    const on = !document.body.classList.contains("lecture");
    show(on);
    // Not every browser has a full screen to give; the layout is what counts.
    if (on) void document.documentElement.requestFullscreen?.().catch(() => undefined);
    else if (document.fullscreenElement) void document.exitFullscreen();
  });
  document.addEventListener("fullscreenchange", () => { if (!document.fullscreenElement) show(false); });
  document.addEventListener("keydown", ({ key }) => { if (key === "Escape" && document.body.classList.contains("lecture")) show(false); });
}

/** Until leaving is offered [ms]. */
const PATIENCE = 2000;

export class Waiting {
  private readonly button = byId<HTMLButtonElement>("leave-continuous");
  private timer = 0;

  constructor(leave: () => void) {
    this.button.addEventListener("click", leave);
  }

  show(busy: boolean): void {
    clearTimeout(this.timer);
    this.button.hidden = true;
    say("spinner", busy ? "continuous model: computing…" : "");
    if (!busy) return;
    this.timer = window.setTimeout(() => {
      say("spinner", "continuous model: computing takes longer, the discrete one is shown");
      this.button.hidden = false;
    }, PATIENCE);
  }
}
