// SPDX-License-Identifier: GPL-3.0-or-later
// Panels and switches that only show the state: what is hidden, how the models are laid out.
import { byId } from "./dom";
import { PANELS, type State } from "./state";

export function hidePanels(state: State): void {
  for (const panel of PANELS) {
    const box = document.getElementById(panel === "story" ? "story" : `panel-${panel}`);
    if (box) box.hidden = state.hide.includes(panel);
  }
  byId("panel-controls").hidden = state.hide.includes("controls");
  document.body.classList.toggle("no-controls", state.hide.includes("controls"));
}

/** @return shows the layout of the state */
export function setUpLayout(state: State, onChange: () => void): () => void {
  const buttons = [...document.querySelectorAll<HTMLButtonElement>("button[data-layout]")];
  const show = (): void => {
    byId("stage").dataset["layout"] = state.layout;
    for (const button of buttons) button.setAttribute("aria-pressed", String(state.layout === button.dataset["layout"]));
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

/**
 * All of it, or one page for a class: the drop, its blows and questions, with the picture before the drop.
 * @param moment the chosen impact and the time of the picture
 * @param put shows them
 */
export function setUpPrinting(moment: () => [number, number], put: (n: number, time: number) => void): void {
  let before: [number, number] | null = null;
  byId("print").addEventListener("click", () => print());
  byId("handout-print").addEventListener("click", () => {
    before = moment();
    put(1, -Infinity);
    document.body.classList.add("handout");
    print();
  });
  addEventListener("afterprint", () => {
    document.body.classList.remove("handout");
    if (before) put(...before);
    before = null;
  });
}
