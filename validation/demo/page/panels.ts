// Panels and switches that only show the state: what is hidden, how the models are laid out, what an offline copy lacks.
import { isOffline, offlineScenes } from "./api";
import { byId } from "./dom";
import { keyOf, sequenceRequest } from "./requests";
import { PANELS, type State } from "./state";

export function hidePanels(state: State): void {
  for (const panel of PANELS) byId(`panel-${panel}`).hidden = state.hide.includes(panel);
  byId("panel-controls").hidden = state.hide.includes("controls");
  document.body.classList.toggle("no-controls", state.hide.includes("controls"));
}

export function setUpLayout(state: State, onChange: () => void): void {
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
}

/** An offline copy shows what a link names if it holds that, else its first scene. */
export function goOffline(state: State): void {
  if (!isOffline) return;
  byId("offline").hidden = false;
  const holds = offlineScenes.some(({ answers }) => keyOf(sequenceRequest(state.parameters)) in answers);
  const [first] = offlineScenes;
  if (!holds && first) Object.assign(state.parameters, first.parameters);
}
