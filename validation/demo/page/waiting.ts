// SPDX-License-Identifier: GPL-3.0-or-later
// While the continuous model is computed: the discrete one is shown, and who waits for long may leave the other.
import { byId, say } from "./dom";

/** Until leaving is offered [ms]. */
const PATIENCE = 2000;

export class Waiting {
  private readonly button = byId<HTMLButtonElement>("leave-continuous");
  private timer = 0;
  private isLeft = false;

  constructor(leave: () => void, compute: () => void) {
    this.button.addEventListener("click", () => {
      if (this.isLeft) return compute();
      leave();
      this.isLeft = true;
      this.offer("Compute it", "continuous model: left out");
    });
  }

  show(busy: boolean): void {
    clearTimeout(this.timer);
    this.isLeft = false;
    this.button.hidden = true;
    say("spinner", busy ? "continuous model: computing…" : "");
    if (busy) this.timer = window.setTimeout(() => this.offer("Leave it", "continuous model: computing takes longer, the discrete one is shown"), PATIENCE);
  }

  private offer(act: string, words: string): void {
    say("spinner", words);
    this.button.hidden = false;
    this.button.textContent = act;
  }
}
