// SPDX-License-Identifier: GPL-3.0-or-later
// Before the first answer: what does the reader expect? A guess that is tested teaches more than a table that is read.
import type { Impact, SequenceAnswer } from "./api";
import { byId } from "./dom";
import { significant } from "./format";
import { comparison } from "./words";

type Guess = "harder" | "same" | "softer" | "none";

const TITLES: Readonly<Record<Guess, string>> = { harder: "Yes", same: "About the same", softer: "No", none: "There is none" };
const GUESSES = Object.keys(TITLES) as Guess[];
/** Blows that differ by less are "about the same". */
const ALIKE = 0.1;
/** From here on an elastic rod may turn away after its first blow, and so the question leaves it open whether there is a second [°]. */
const STEEP = 45;

export class Prediction {
  private readonly card = byId("prediction");
  private readonly question = byId("prediction-question");
  private readonly reveal = byId("prediction-reveal");
  private readonly skip = byId("prediction-skip");
  private readonly buttons = [...this.card.querySelectorAll<HTMLButtonElement>("button[data-guess]")];
  /** Of a class, hand by hand; null: one reader guesses. */
  private votes: Guess[] | null = null;
  private guess: Guess | null = null;  // also of a class that is divided
  /** A guess was made, and the second blow has not been seen yet. */
  isWaiting = false;
  /** The discrete model's, and of which drop. */
  private impacts: readonly Impact[] = [];
  private drop = "";
  /** No second blow was asked for. */
  private isCut = false;
  /** Of the drop before, which the slower model may still tell of. */
  private past: readonly Impact[] | null = null;

  /** @param onAnswered whether the reader wants to be asked again */
  constructor(private readonly onAnswered: (asksOn: boolean) => void) {
    for (const button of this.buttons) {
      button.addEventListener("click", () => {
        const guess = button.dataset["guess"] as Guess;
        if (this.votes) {
          this.votes.push(guess);
          return this.label(button);
        }
        this.guess = guess;
        this.wait(true);
        this.close(true);
      });
    }
    this.skip.addEventListener("click", () => {
      if (this.votes?.length) {
        const most = Math.max(...GUESSES.map((guess) => this.votesFor(guess)));
        const first = GUESSES.filter((guess) => this.votesFor(guess) === most);
        this.guess = first.length === 1 ? first[0]! : null;
        this.wait(true);
      }
      this.close(this.votes !== null);
    });
  }

  get isOpen(): boolean {
    return !this.card.hidden;
  }

  /** What the discrete model answers; a guess can come before it, and is void for another drop. */
  setImpacts({ impacts, outcome }: SequenceAnswer, drop: string): void {
    if (impacts === this.past) return;
    const isAnother = this.impacts.length > 0 && drop !== this.drop;
    this.drop = drop;
    this.impacts = impacts;
    const mayFollow = outcome === "impact-limit";
    this.isCut = mayFollow && impacts.length === 1;
    if (impacts[0]) this.setOpen((impacts.length < 2 && !mayFollow) || impacts[0].contact_angle_deg >= STEEP);
    if (isAnother) this.give(null);
  }

  /** The angle of a drop whose impacts are still to come [°]. */
  awaits(angle: number): void {
    this.setOpen(angle >= STEEP);
  }

  /** Whether there is a second blow is part of the question. */
  private setOpen(open: boolean): void {
    for (const part of this.card.querySelectorAll<HTMLElement>(".surely, .perhaps")) part.hidden = open === part.classList.contains("surely");
  }

  /** What the picture shows now; once that is the second blow, the guess is judged; at once where none comes. */
  seen(time: number): void {
    if (!this.isWaiting || !this.impacts.length) return;
    const second = this.impacts[1];
    if (second && time < second.start) return;
    this.wait(false);
    const votes = this.votes?.length ? ` The class: ${this.buttons.filter(({ hidden }) => !hidden).map(({ textContent }) => textContent).join(", ")}.` : "";
    this.reveal.textContent = (this.isCut ? "Only one blow is computed: set “Impacts, at most”." : revealed(this.guess, this.impacts)) + votes;
  }

  /** @param isOther about a drop whose impacts are still to come, before which a guess may be made */
  open(isOther = false): void {
    if (isOther && this.impacts.length) [this.past, this.impacts] = [this.impacts, []];
    this.card.hidden = false;
    this.question.hidden = false;
    if (this.votes) this.setVoting(true);
    this.give(null);
    document.body.classList.add("predicting");
  }

  /** A class votes: each button counts hands, and the guess is that of the most. */
  setVoting(on: boolean): void {
    this.votes = on ? [] : null;
    this.skip.textContent = on ? "Let it drop" : "Just show me";
    for (const button of this.buttons) this.label(button);
  }

  private label(button: HTMLButtonElement): void {
    const votes = this.votesFor(button.dataset["guess"] as Guess);
    button.textContent = TITLES[button.dataset["guess"] as Guess] + (this.votes && votes ? ` · ${votes}` : "");
  }

  private votesFor(guess: Guess | null): number {
    return this.votes?.filter((vote) => vote === guess).length ?? 0;
  }

  private give(guess: Guess | null): void {
    this.guess = guess;
    this.reveal.textContent = "";
    this.wait(false);
  }

  private wait(waits: boolean): void {
    this.isWaiting = waits;
    if (waits) this.reveal.textContent = "Watch the second blow …";
    document.body.classList.toggle("watching", waits);
  }

  private close(asksOn: boolean): void {
    this.card.hidden = true;
    document.body.classList.remove("predicting");
    this.onAnswered(asksOn);
  }
}

function revealed(guess: Guess | null, impacts: readonly Impact[]): string {
  const [first, second] = impacts;
  if (!first) return "";
  const ratio = second ? second.impulse_normal / first.impulse_normal : NaN;
  const truth: Guess = !second ? "none" : Math.abs(ratio - 1) < ALIKE ? "same" : ratio > 1 ? "harder" : "softer";
  const verdict = guess === null ? "The class is divided:" : guess === truth ? "You guessed it." : "A surprise:";
  if (!second) return `${verdict} There is no second blow: after the first nothing comes down again.`;
  const numbers = `${significant(second.impulse_normal, 4)} N·s after ${significant(first.impulse_normal, 4)} N·s`;
  return `${verdict} The second blow is ${comparison(ratio)}${comparison(ratio) === "about as hard" ? "" : " as the first"}: ${numbers}.`;
}
