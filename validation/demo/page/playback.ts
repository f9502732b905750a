// SPDX-License-Identifier: GPL-3.0-or-later
// Playback: which time of the motion the picture shows, and how much slower than life. Through each contact, which lasts
// milliseconds, it goes by one curve for all scenes: from the pace of flights by its square root to that of contacts and back.
// The physics is computed once for a situation; nothing here changes it.
import { byId, make } from "./dom";
import { fixed, significant } from "./format";
import { RATES, type State } from "./state";

interface Window {
  start: number;
  end: number;
}

const FLIGHTS = 4.5; // at least, all flights together, on the screen [s]
const CONTACT = 1.1; // the longest contact, on the screen, and up to 2.5 times as much [s]
/** Without a duration a blow is slowed down for this part of the whole, half of it before. */
const MARGIN = 0.008;

/** 1, 2, 5, 10, 20, …: the first that is not less. */
function niceSlowness(least: number): number {
  if (!(least > 1)) return 1;
  const power = 10 ** Math.floor(Math.log10(least));
  return power * ([1, 2, 5].find((step) => step * power >= least * (1 - 1e-9)) ?? 10);
}

/** A monotone map between the time on the screen and the time of the motion. */
export class TimeWarp {
  private readonly screen: number[] = [0];
  private readonly motion: number[];

  constructor(readonly begin: number, readonly end: number) {
    this.motion = [begin];
  }

  /** Life itself. */
  static real(begin: number, end: number): TimeWarp {
    const warp = new TimeWarp(begin, end);
    warp.add(end, 1);
    return warp;
  }

  /** @param near when what is worth seeing begins: a long fall before that is shown as it is */
  static slow(begin: number, near: number, end: number, contacts: readonly Window[], throughContacts: boolean): TimeWarp {
    const warp = new TimeWarp(begin, end);
    const flights = niceSlowness(FLIGHTS / (end - near || 1));
    warp.add(near, 1);
    for (const { start, end: stop } of throughContacts ? merged(contacts, near, end) : []) {
      const longest = Math.max(...contacts.map((contact) => contact.end - contact.start), MARGIN * (end - near));
      const pace = Math.max(flights, niceSlowness(CONTACT / longest));
      const ramp = (stop - start) / 4;
      warp.add(start - ramp, flights);
      warp.add(start, Math.sqrt(flights * pace));
      warp.add(stop, pace);
      warp.add(Math.min(end, stop + ramp), Math.sqrt(flights * pace));
    }
    warp.add(end, flights);
    return warp;
  }

  get duration(): number {
    return this.screen[this.screen.length - 1] ?? 0;
  }

  toMotion(screen: number): number {
    return interpolate(this.screen, this.motion, screen);
  }

  toScreen(time: number): number {
    return interpolate(this.motion, this.screen, time);
  }

  /** How much slower than life it is there. */
  slownessAt(screen: number): number {
    const next = Math.max(1, this.screen.findIndex((edge) => edge > screen));
    const [from, to] = [next - 1, next].map((i) => [this.screen[i] ?? 0, this.motion[i] ?? 0] as const);
    return from && to && to[1] > from[1] ? (to[0] - from[0]) / (to[1] - from[1]) : 1;
  }

  private add(time: number, slowness: number): void {
    const last = this.motion[this.motion.length - 1] ?? 0;
    if (time <= last) return;
    this.motion.push(time);
    this.screen.push(this.duration + (time - last) * slowness);
  }
}

/** Contacts with a margin before and after; those that then overlap are one. */
function merged(contacts: readonly Window[], begin: number, end: number): Window[] {
  const margin = (MARGIN / 2) * (end - begin);
  const windows: Window[] = [];
  for (const contact of [...contacts].sort((a, b) => a.start - b.start)) {
    const start = Math.max(begin, contact.start - margin);
    const stop = Math.min(end, contact.end + margin);
    const last = windows[windows.length - 1];
    if (last && start <= last.end) last.end = Math.max(last.end, stop);
    else windows.push({ start, end: stop });
  }
  return windows;
}

function interpolate(from: number[], to: number[], value: number): number {
  const last = from.length - 1;
  if (value <= (from[0] ?? 0)) return to[0] ?? 0;
  for (let i = 1; i <= last; i++) {
    const a = from[i - 1] ?? 0;
    const b = from[i] ?? 0;
    if (value <= b) return (to[i - 1] ?? 0) + (((to[i] ?? 0) - (to[i - 1] ?? 0)) * (value - a)) / (b - a);
  }
  return to[last] ?? 0;
}

/** Plays a warp in the browser's frames. */
export class Player {
  playing = false;
  rate = 1;
  private position = 0;
  private real: TimeWarp | null = null;
  /** Where it was sent, to the last digit; until the playback moves. */
  private sought: number | null = null;
  private last = 0;
  private request = 0;

  constructor(private warp: TimeWarp, private readonly onTime: (time: number, ended: boolean) => void) {}

  get time(): number {
    return this.sought ?? (this.real ?? this.warp).toMotion(this.position);
  }

  /** How much slower than life the picture moves, or would if it was played. */
  get slowness(): number {
    return this.real ? 1 : this.warp.slownessAt(this.position) / this.rate;
  }

  /** Another situation: a running playback goes on at the same place of the screen, a standing one keeps its time. */
  setWarp(warp: TimeWarp): void {
    const time = this.time;
    this.real = null;
    this.warp = warp;
    if (this.playing) this.sought = null;
    this.position = this.playing ? Math.min(this.position, warp.duration) : warp.toScreen(time);
  }

  seek(time: number): void {
    this.real = null;
    this.sought = Math.min(this.warp.end, Math.max(this.warp.begin, time));
    this.position = this.warp.toScreen(time);
  }

  /** Part of the playback that has passed, 0 to 1. */
  get progress(): number {
    return this.progressAt(this.time);
  }

  set progress(part: number) {
    this.real = null;
    this.sought = null;
    this.position = part * this.warp.duration;
  }

  progressAt(time: number): number {
    return this.warp.duration > 0 ? this.warp.toScreen(time) / this.warp.duration : 0;
  }

  play(): void {
    if (this.playing) return;
    if (this.position >= this.warp.duration - 1e-9) this.position = 0;
    this.start();
  }

  /** From the beginning, as fast as it happens. */
  playReal(): void {
    this.pause();
    this.real = TimeWarp.real(this.warp.begin, this.warp.end);
    this.position = 0;
    this.start();
  }

  pause(): void {
    this.playing = false;
    cancelAnimationFrame(this.request);
    if (this.real) this.seek(this.time);
  }

  private start(): void {
    this.playing = true;
    this.sought = null;
    this.last = 0;
    this.request = requestAnimationFrame((now) => this.frame(now));
  }

  private frame(now: number): void {
    // A tab in the background draws no frames: coming back must not jump over impacts.
    const passed = this.last ? Math.min(0.1, (now - this.last) / 1000) : 0;
    this.last = now;
    const { duration } = this.real ?? this.warp;
    this.position = Math.min(duration, this.position + passed * (this.real ? 1 : this.rate));
    const ended = this.position >= duration;
    if (ended) this.pause();
    this.onTime(this.time, ended);
    if (this.playing) this.request = requestAnimationFrame((next) => this.frame(next));
  }
}

interface TransportActions {
  toggle(): void;
  step(direction: 1 | -1): void;
  scrub(progress: number): void;
  setRate(rate: number): void;
  setSlow(slow: boolean): void;
  playReal(): void;
}

const SCRUBBER_STEPS = 1000;

export class Transport {
  private readonly play = byId<HTMLButtonElement>("play");
  private readonly scrubber = byId<HTMLInputElement>("scrubber");
  private readonly marks = byId("impact-marks");
  private readonly time = byId("time");
  private readonly rate = byId<HTMLSelectElement>("rate");
  private readonly slow = byId<HTMLInputElement>("slow");
  private readonly pace = byId("pace");

  constructor({ rate: usual, slow, lock }: State, private readonly actions: TransportActions) {
    this.rate.append(...RATES.map((rate) => make("option", { value: rate }, rate === 1 ? "usual" : `${rate === 0.25 ? "¼" : rate === 0.5 ? "½" : rate} times`)));
    this.play.addEventListener("click", () => actions.toggle());
    byId("real").addEventListener("click", () => actions.playReal());
    byId("previous").addEventListener("click", () => actions.step(-1));
    byId("next").addEventListener("click", () => actions.step(1));
    this.scrubber.max = String(SCRUBBER_STEPS);
    this.scrubber.addEventListener("input", () => actions.scrub(Number(this.scrubber.value) / SCRUBBER_STEPS));
    this.rate.addEventListener("change", () => actions.setRate(Number(this.rate.value)));
    this.slow.addEventListener("change", () => actions.setSlow(this.slow.checked));
    document.addEventListener("keydown", (event) => this.onKey(event));
    Object.assign(this.rate, { value: String(usual), disabled: lock.includes("rate") });
    Object.assign(this.slow, { checked: slow, disabled: lock.includes("slow") });
  }

  setMarks(marks: readonly { place: number; name: string }[]): void {
    this.marks.replaceChildren(...marks.map(({ place, name }, i) => {
      const mark = make("span", {}, name);
      mark.style.left = `${(100 * place).toFixed(2)}%`;
      // Numbers of impacts that nearly coincide would cover each other.
      if (i > 0 && place - (marks[i - 1]?.place ?? 0) < 0.025) mark.textContent = "";
      return mark;
    }));
  }

  show(time: number, progress: number, playing: boolean, slowness: number): void {
    const pace = slowness < 1.05 && slowness > 0.95 ? "as fast as it happens" : slowness > 1 ? `${significant(slowness, 2)} times slower than life` : `${significant(1 / slowness, 2)} times faster than life`;
    if (this.pace.textContent !== pace) this.pace.textContent = pace;
    this.pace.hidden = !playing;
    this.scrubber.value = String(Math.round(progress * SCRUBBER_STEPS));
    this.scrubber.setAttribute("aria-valuetext", `${fixed(time * 1e3, 1)} ms`);
    this.time.textContent = `${fixed(time * 1e3, Math.abs(time) < 0.1 ? 2 : 1)} ms`;
    this.play.setAttribute("aria-label", playing ? "Pause" : "Play");
    this.play.classList.toggle("playing", playing);
  }

  /** Space plays, arrows step, unless the key means something to the element that has the focus. */
  private onKey(event: KeyboardEvent): void {
    if (event.altKey || event.ctrlKey || event.metaKey) return;
    const target = event.target as HTMLElement;
    const takesKeys = /^(INPUT|SELECT|TEXTAREA)$/.test(target.tagName);
    const isCheckbox = target instanceof HTMLInputElement && target.type === "checkbox";
    const scrolls = target.getAttribute("tabindex") === "0" && target.id !== "stage";
    if (event.key === " " && !/^(SELECT|BUTTON|SUMMARY|A)$/.test(target.tagName) && !isCheckbox) {
      event.preventDefault();
      this.actions.toggle();
    } else if (event.key === "r" && !takesKeys) {
      this.actions.playReal();
    } else if (!event.shiftKey && (event.key === "ArrowRight" || event.key === "ArrowLeft") && (!takesKeys || isCheckbox) && !scrolls) {
      event.preventDefault();
      this.actions.step(event.key === "ArrowRight" ? 1 : -1);
    }
  }
}
