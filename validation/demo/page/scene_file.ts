// SPDX-License-Identifier: GPL-3.0-or-later
// Scene files: opened by a button, dropped on the page or pasted, and given back as a file or by the clipboard.
import type { FileAnswer, SceneAnswer } from "./answers";
import { ApiError, ask } from "./api";
import { byId } from "./dom";
import type { Parameters } from "./parameters";
import { fileRequest, sceneRequest, parametersOf } from "./requests";
import { copyText, download } from "./sharing";
import { assignUnlocked, type State } from "./state";

const FILE_NAME = "scene.toml";

export class SceneFile {
  private readonly said = byId("file-said");
  private readonly error = byId("file-error");
  /** Of several that are opened in a row the last one counts. */
  private opened = 0;

  constructor(private readonly state: State, private readonly onOpen: () => void) {
    const locked = state.lock.includes("scene") || state.lock.includes("file");
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
    input.addEventListener("change", () => {
      const [file] = input.files ?? [];
      if (file) void file.text().then((text) => this.open(file.name, text));
      input.value = "";
    });
    this.takeDrops();
    this.takePastes();
  }

  private takeDrops(): void {
    const show = (dropping: boolean): void => { document.body.classList.toggle("dropping", dropping); };
    document.addEventListener("dragover", (event) => { event.preventDefault(); show(true); });
    document.addEventListener("dragleave", (event) => { if (!event.relatedTarget) show(false); });
    document.addEventListener("drop", (event) => {
      event.preventDefault();
      show(false);
      const [file] = event.dataTransfer?.files ?? [];
      const text = event.dataTransfer?.getData("text/plain") ?? "";
      if (file) void file.text().then((read) => this.open(file.name, read));
      else if (text.trim()) void this.open("dropped text", text);
    });
  }

  /** Into a field a text is pasted as everywhere. */
  private takePastes(): void {
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
      const answer = await ask<SceneAnswer>(sceneRequest(name, text));
      if (turn !== this.opened) return "";
      const kept = assignUnlocked(this.state, parametersOf(answer.arguments));
      this.onOpen();
      const locked = kept.length ? [`locked, and kept: ${kept.join(", ")}`] : [];
      return [`Opened ${name}`, ...answer.notes, ...locked].join("; ");
    });
  }

  private async give(hand: (text: string) => Promise<string>): Promise<void> {
    const situation: Parameters = { ...this.state.parameters };
    await this.attempt(async () => hand((await ask<FileAnswer>(fileRequest(situation))).file));
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
