// SPDX-License-Identifier: GPL-3.0-or-later
// Blows to be heard: louder with the impulse, higher with the contact angle, so that 2:1:2 is an octave down and up again.
// Each is told in a line, too. Off until somebody switches it on; no link does.
import type { Impact } from "./api";
import { byId } from "./dom";
import { significant } from "./format";
import { comparison } from "./words";

const PITCH = 440; // of the first impact [Hz]
const LOWEST = PITCH / 8;
const HIGHEST = PITCH * 4;
const LOUDEST = 0.5; // of what the loudspeaker has
const FADES = 0.35; // [s]

/** Gains are in the ratio of the impulses. */
function gainOf(impacts: readonly Impact[], n: number): number {
  const most = Math.max(...impacts.map(({ impulse_normal }) => impulse_normal));
  return most > 0 ? (LOUDEST * (impacts[n - 1]?.impulse_normal ?? 0)) / most : 0;
}

function angleRatio(impacts: readonly Impact[], n: number): number {
  const first = impacts[0]?.contact_angle_deg ?? 0;
  return first > 0 ? (impacts[n - 1]?.contact_angle_deg ?? first) / first : 1;
}

function captionOf(impacts: readonly Impact[], n: number): string {
  const [first] = impacts;
  const impact = impacts[n - 1];
  if (!first || !impact) return "";
  if (n === 1) return "♪ Impact 1";
  const loudness = comparison(impact.impulse_normal / first.impulse_normal).replace("hard", "loud");
  return `♪ Impact ${n}: ${loudness} as the first, ${pitchInWords(angleRatio(impacts, n))}`;
}

function pitchInWords(ratio: number): string {
  if (ratio > 0.94 && ratio < 1.06) return "about as high";
  if (ratio > 1.94 && ratio < 2.06) return "an octave higher";
  if (ratio > 0.485 && ratio < 0.515) return "an octave lower";
  return `at ${significant(ratio, 2)} times its pitch`;
}

export class Sound {
  private readonly box = byId<HTMLInputElement>("sound");
  private readonly caption = byId("sound-caption");
  private context: AudioContext | null = null;

  constructor(isLocked: boolean) {
    this.box.checked = false;
    this.box.disabled = isLocked;
    // Browsers let a page sound only after somebody did something on it.
    this.box.addEventListener("change", () => {
      if (this.box.checked) this.context ??= new AudioContext();
      void (this.box.checked ? this.context?.resume() : this.context?.suspend());
      this.caption.textContent = this.box.checked ? "♪ Louder: a larger impulse. Higher: a larger contact angle. Play to hear it." : "";
    });
  }

  /** While the picture is played from one time to the next. */
  pass(impacts: readonly Impact[], from: number, to: number): void {
    if (!this.box.checked) return;
    for (const { n, start } of impacts) if (start > from && start <= to) this.strike(impacts, n);
  }

  private strike(impacts: readonly Impact[], n: number): void {
    this.caption.textContent = captionOf(impacts, n);
    const { context } = this;
    if (!context) return;
    const tone = context.createOscillator();
    const level = context.createGain();
    tone.type = "triangle";
    // Pitches are in the ratio of the contact angles.
    tone.frequency.value = Math.min(HIGHEST, Math.max(LOWEST, PITCH * angleRatio(impacts, n)));
    level.gain.setValueAtTime(gainOf(impacts, n), context.currentTime);
    level.gain.setTargetAtTime(0, context.currentTime, FADES / 5);
    tone.connect(level).connect(context.destination);
    tone.start();
    tone.stop(context.currentTime + FADES);
  }
}
