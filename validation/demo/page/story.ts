// SPDX-License-Identifier: GPL-3.0-or-later
// The story that the build wrote into the page: each of its steps can be shown in the picture.
import { stateOf, assignUnlocked, type State } from "./state";

/** Without this code the steps' links open the page anew. */
export function setUpStory(state: State, onShow: () => void): void {
  for (const link of document.querySelectorAll<HTMLAnchorElement>("#story a[href^='#']")) {
    if (state.lock.includes("story")) link.removeAttribute("href");
    link.addEventListener("click", (event) => {
      event.preventDefault();
      if (state.lock.includes("story")) return;
      const wanted = stateOf(new URL(link.href).hash.slice(1));
      assignUnlocked(state, wanted.parameters);
      Object.assign(state, { impact: wanted.impact, time: NaN });
      onShow();
    });
  }
}
