// SPDX-License-Identifier: GPL-3.0-or-later
// Before the first answer: what does the reader expect? A guess that is tested teaches more than a table that is read.
import type { Impact } from "./answers";
import { byId } from "./dom";
import { significant } from "./format";
import { comparison } from "./words";

type Guess = "harder" | "same" | "softer";

/** Blows that differ by less are "about the same". */
const ALIKE = 0.1;

export class Prediction {
  private readonly card = byId("prediction");
  private readonly question = byId("prediction-question");
  private readonly reveal = byId("prediction-reveal");

  private guess: Guess | null = null;
  private impacts: readonly Impact[] = [];

  constructor(private readonly onAnswered: () => void) {
    for (const button of this.card.querySelectorAll<HTMLButtonElement>("button[data-guess]")) {
      button.addEventListener("click", () => {
        this.guess = button.dataset["guess"] as Guess;
        this.close();
        this.tell();
      });
    }
    byId("prediction-skip").addEventListener("click", () => this.close());
  }

  get isOpen(): boolean {
    return !this.card.hidden;
  }

  /** The impacts of the situation; a guess can come before them, and is void for another situation. */
  setImpacts(impacts: readonly Impact[]): void {
    const isAnother = this.impacts.length > 0 && impacts !== this.impacts;
    this.impacts = impacts;
    if (isAnother) this.guess = null;
    this.tell();
  }

  open(): void {
    this.card.hidden = false;
    this.question.hidden = false;
    this.guess = null;
    this.tell();
    document.body.classList.add("predicting");
  }

  /** Without an answer and without what follows one. */
  dismiss(): void {
    if (this.isOpen) this.close();
  }

  private tell(): void {
    this.reveal.textContent = this.guess && this.impacts.length ? revealed(this.guess, this.impacts) : "";
  }

  private close(): void {
    this.card.hidden = true;
    document.body.classList.remove("predicting");
    this.onAnswered();
  }
}

function revealed(guess: Guess, impacts: readonly Impact[]): string {
  const [first, second] = impacts;
  if (!first) return "";
  if (!second) return "There is no second blow: after the first nothing comes down again.";
  const ratio = second.impulse_normal / first.impulse_normal;
  const truth: Guess = Math.abs(ratio - 1) < ALIKE ? "same" : ratio > 1 ? "harder" : "softer";
  const verdict = guess === truth ? "You guessed it." : "A surprise:";
  const numbers = `${significant(second.impulse_normal, 4)} N·s after ${significant(first.impulse_normal, 4)} N·s`;
  return `${verdict} The second blow is ${comparison(ratio)}${comparison(ratio) === "about as hard" ? "" : " as the first"}: ${numbers}.`;
}
