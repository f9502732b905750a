// SPDX-License-Identifier: GPL-3.0-or-later
// Handing on what is shown: as a link, or as the page itself with the scene in it.
import { ApiError, ask } from "./api";
import { byId, make } from "./dom";
import type { Parameters } from "./parameters";
import { fileRequest, namesGround, parametersOf, type SceneArguments } from "./requests";
import { addressOf, assignUnlocked, isFixed, type State } from "./state";

/** The page as it came, before anything on it was changed, and without the script that it unpacked, which would run beside that of its copy. */
document.currentScript?.remove();
const source = document.documentElement.outerHTML;

/** What is not handed on: others see the drop from its beginning, and are asked first unless that is locked. */
const OWN = ["impact", "t", "predict"] as const;

export function setUpSharing(state: State, onAskFirst: (asks: boolean) => void): void {
  const button = byId<HTMLButtonElement>("copy-link");
  const done = byId("copied");
  button.addEventListener("click", () => {
    const link = addressOf(state, OWN);
    // Where a browser does not let a page write to the clipboard, the link is shown instead.
    void copyText(link).then((copied) => {
      const isLocal = location.protocol === "file:";
      done.textContent = !copied ? link : isLocal ? "Link copied: it opens this file on this computer. For others save the page" : "Link copied";
      setTimeout(() => { done.textContent = ""; }, copied && !isLocal ? 2500 : 20_000);
    });
  });
  byId("save-page").addEventListener("click", () => {
    const fragment = new URL(addressOf(state, OWN)).hash.slice(1).replace(/&/g, "&amp;").replace(/"/g, "&quot;");
    const page = source.replace(/(name="clatter-scene" content=")[^"]*/, (_all, before: string) => before + fragment);
    download("clatter.html", `<!doctype html>\n${page}\n`, "text/html");
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
async function copyText(text: string): Promise<boolean> {
  try {
    await navigator.clipboard.writeText(text);
    return true;
  } catch {
    return false;
  }
}

export const WITHOUT_GROUND = "the scene names no ground, without which the continuous model does not run (clatter simulate refuses it); its tick takes a ground that the page chooses";

const FILE_NAME = "scene.toml";

export class SceneFile {
  private readonly said = byId("file-said");
  private readonly error = byId("file-error");
  /** Of several that are opened in a row the last one counts. */
  private opened = 0;

  constructor(private readonly state: State, private readonly onOpen: (hasGround: boolean) => void) {
    const locked = isFixed(state) || state.lock.includes("scene") || state.lock.includes("file");
    const input = byId<HTMLInputElement>("scene-file");
    input.disabled = locked;
    byId("open").classList.toggle("disabled", locked);
    byId("download-scene").addEventListener("click", () => void this.give(async (text) => {
      download(FILE_NAME, text, "application/toml");
      return `Downloaded as ${FILE_NAME}`;
    }));
    byId("copy-scene").addEventListener("click", () => void this.give(async (text) =>
      (await copyText(text)) ? "Scene copied" : "The browser does not let the page copy; download it"));
    if (locked) return;
    const openFirst = (files: FileList | null | undefined): boolean => {
      const file = files?.[0];
      if (file) void file.text().then((text) => this.open(file.name, text));
      return file !== undefined;
    };
    input.addEventListener("change", () => {
      openFirst(input.files);
      input.value = "";
    });
    const show = (dropping: boolean): void => { document.body.classList.toggle("dropping", dropping); };
    document.addEventListener("dragover", (event) => { event.preventDefault(); show(true); });
    document.addEventListener("dragleave", (event) => { if (!event.relatedTarget) show(false); });
    document.addEventListener("drop", (event) => {
      event.preventDefault();
      show(false);
      const text = event.dataTransfer?.getData("text/plain") ?? "";
      if (!openFirst(event.dataTransfer?.files) && text.trim()) void this.open("dropped text", text);
    });
    // Into a field a text is pasted as everywhere.
    document.addEventListener("paste", (event) => {
      const text = event.clipboardData?.getData("text/plain") ?? "";
      if (/^(INPUT|TEXTAREA|SELECT)$/.test((event.target as HTMLElement).tagName) || !text.trim()) return;
      event.preventDefault();
      void this.open("pasted text", text);
    });
  }

  private async open(name: string, text: string): Promise<void> {
    const turn = ++this.opened;
    await this.attempt(async () => {
      const answer = await ask<{ arguments: SceneArguments; notes: string[] }>({ path: "scene", body: { name, text } });
      if (turn !== this.opened) return "";
      const kept = assignUnlocked(this.state, parametersOf(answer.arguments));
      const hasGround = namesGround(Object.keys(answer.arguments));
      this.onOpen(hasGround);
      const locked = kept.length ? [`locked, and kept: ${kept.join(", ")}`] : [];
      return [`Opened ${name}`, ...answer.notes, ...(hasGround || this.state.hide.includes("continuous") ? [] : [WITHOUT_GROUND]), ...locked].join("; ");
    });
  }

  private async give(hand: (text: string) => Promise<string>): Promise<void> {
    const situation: Parameters = { ...this.state.parameters };
    await this.attempt(async () => hand((await ask<{ file: string }>(fileRequest(situation))).file));
  }

  /** Says what was done, or in one line what was wrong. */
  private async attempt(act: () => Promise<string>): Promise<void> {
    let done = "";
    let wrong = "";
    try {
      done = await act();
    } catch (error) {
      if (!(error instanceof ApiError)) throw error;
      wrong = error.message;
    }
    this.said.textContent = done;
    this.error.textContent = wrong;
    this.error.hidden = wrong === "";
    if (wrong) this.error.scrollIntoView({ block: "center" });
  }
}
