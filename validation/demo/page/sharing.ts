// SPDX-License-Identifier: GPL-3.0-or-later
// Handing on what is shown: as a link, or as the page itself with the scene in it.
import { byId, make } from "./dom";
import { addressOf, type State } from "./state";

/** The page as it came, before anything on it was changed. */
const source = document.documentElement.outerHTML;

function pageWith(state: State): string {
  const fragment = new URL(addressOf(state)).hash.slice(1).replace(/&/g, "&amp;").replace(/"/g, "&quot;");
  return `<!doctype html>\n${source.replace(/(name="clatter-scene" content=")[^"]*/, (_all, before: string) => before + fragment)}\n`;
}

export function setUpSharing(state: State, sync: () => void, onAskFirst: (asks: boolean) => void): void {
  const button = byId<HTMLButtonElement>("copy-link");
  const done = byId("copied");
  button.addEventListener("click", () => {
    sync();
    const link = addressOf(state);
    // Where a browser does not let a page write to the clipboard, the link is shown instead.
    void copyText(link).then((copied) => {
      const isLocal = location.protocol === "file:";
      done.textContent = !copied ? link : isLocal ? "Link copied: it opens this file on this computer. For others save the page" : "Link copied";
      setTimeout(() => { done.textContent = ""; }, copied && !isLocal ? 2500 : 20_000);
    });
  });
  byId("save-page").addEventListener("click", () => {
    sync();
    download("clatter.html", pageWith(state), "text/html");
  });
  const askFirst = byId<HTMLInputElement>("ask-first");
  askFirst.checked = state.predict;
  askFirst.disabled = state.lock.includes("predict");
  askFirst.addEventListener("change", () => {
    state.predict = askFirst.checked;
    onAskFirst(askFirst.checked);
  });
}

export function download(name: string, content: BlobPart, type: string): void {
  const url = URL.createObjectURL(new Blob([content], { type }));
  make("a", { href: url, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(url), 10_000);
}

/** Not every browser lets a page write to the clipboard. */
export async function copyText(text: string): Promise<boolean> {
  try {
    await navigator.clipboard.writeText(text);
    return true;
  } catch {
    return false;
  }
}
