// SPDX-License-Identifier: GPL-3.0-or-later
// Handing on what is shown, as a link.
import { byId } from "./dom";
import { copyText } from "./files";
import { addressOf, type State } from "./state";

export function setUpSharing(state: State, sync: () => void, onAskFirst: (asks: boolean) => void): void {
  const button = byId<HTMLButtonElement>("copy-link");
  const done = byId("copied");
  button.addEventListener("click", () => {
    sync();
    const link = addressOf(state);
    // Where a browser does not let a page write to the clipboard, the link is shown instead.
    void copyText(link).then((copied) => {
      done.textContent = copied ? "Link copied" : link;
      setTimeout(() => { done.textContent = ""; }, copied ? 2500 : 20_000);
    });
  });
  const askFirst = byId<HTMLInputElement>("ask-first");
  askFirst.checked = state.predict;
  askFirst.disabled = state.lock.includes("predict");
  askFirst.addEventListener("change", () => {
    state.predict = askFirst.checked;
    onAskFirst(askFirst.checked);
  });
}
