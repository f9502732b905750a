// SPDX-License-Identifier: GPL-3.0-or-later
// For a lecture: the picture alone, large, with the guess as a vote by show of hands.
import { byId } from "./dom";

export function setUpLecture(onVoting: (on: boolean) => void, onChange: () => void): void {
  const button = byId<HTMLButtonElement>("lecture");
  const show = (on: boolean): void => {
    document.body.classList.toggle("lecture", on);
    button.setAttribute("aria-pressed", String(on));
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
