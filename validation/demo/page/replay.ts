// SPDX-License-Identifier: GPL-3.0-or-later
// Small pictures side by side that a slider moves through time, by hand or by itself: `ID-time`, `ID-play`, `ID-now`.
import { byId } from "./dom";
import { fixed, significant } from "./format";

/** How far one place is from the other [m, rad]. */
export function apart(distance: number, turn: number): string {
  const turned = (turn * 180) / Math.PI;
  return `off by ${significant(1e3 * Math.abs(distance), 2)} mm, ${significant(Math.abs(turned - 360 * Math.round(turned / 360)), 2)}°`;
}

export class Replay {
  private readonly slider: HTMLInputElement;
  private readonly button: HTMLButtonElement;
  private last: number | null = null;

  /** @param end of time, from 0 [s]; @param slower than life, when it plays by itself */
  constructor(private readonly id: string, end: number, private readonly slower: number, private readonly onTime: (time: number) => void) {
    this.slider = byId<HTMLInputElement>(`${id}-time`);
    this.button = byId<HTMLButtonElement>(`${id}-play`);
    this.slider.max = String(Math.round(end * 1e4));
    this.slider.addEventListener("input", () => { this.pause(); this.show(); });
    this.button.addEventListener("click", () => { if (this.last === null) this.play(); else this.pause(); });
    this.show();
  }

  show(): void {
    const time = Number(this.slider.value) / 1e4;
    this.slider.setAttribute("aria-valuetext", `${fixed(time * 1e3, 1)} ms`);
    byId(`${this.id}-now`).textContent = `${fixed(time * 1e3, 1)} ms, ${this.slower} times slower than life when it plays`;
    this.onTime(time);
  }

  private play(): void {
    if (Number(this.slider.value) >= Number(this.slider.max)) this.slider.value = "0";
    this.last = 0;
    this.button.textContent = "Stop";
    requestAnimationFrame((now) => this.frame(now));
  }

  private pause(): void {
    this.last = null;
    this.button.textContent = "Play";
  }

  private frame(now: number): void {
    if (this.last === null) return;
    const passed = this.last ? Math.min(0.1, (now - this.last) / 1000) : 0;
    this.last = now;
    this.slider.value = String(Number(this.slider.value) + Math.round((1e4 * passed) / this.slower));
    this.show();
    if (Number(this.slider.value) >= Number(this.slider.max)) this.pause();
    else requestAnimationFrame((next) => this.frame(next));
  }
}
