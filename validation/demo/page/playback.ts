// SPDX-License-Identifier: GPL-3.0-or-later
// Playback: which time of the motion the picture shows. It slows down through each contact, which lasts milliseconds.
// The physics is computed once for a situation; nothing here changes it.

export interface Window {
  start: number;
  end: number;
}

const FLIGHTS = 4.5; // all flights together, on the screen [s]
const CONTACT = 1.1; // each contact, on the screen [s]
const SHORTEST_FLIGHT = 0.35; // on the screen [s]

/** A monotone map between the time on the screen and the time of the motion. */
export class TimeWarp {
  readonly duration: number;
  private readonly screen: number[] = [0];
  private readonly motion: number[];

  constructor(readonly begin: number, readonly end: number, contacts: readonly Window[], slow: boolean) {
    this.motion = [begin];
    const windows = slow ? merged(contacts, begin, end) : [];
    const scale = FLIGHTS / (end - begin || 1);
    let time = begin;
    for (const { start, end: stop } of windows) {
      this.add(start, Math.max(SHORTEST_FLIGHT, (start - time) * scale));
      this.add(stop, CONTACT);
      time = stop;
    }
    this.add(end, (end - time) * scale);
    this.duration = this.screen[this.screen.length - 1] ?? 0;
  }

  toMotion(screen: number): number {
    return interpolate(this.screen, this.motion, screen);
  }

  toScreen(time: number): number {
    return interpolate(this.motion, this.screen, time);
  }

  private add(time: number, lasts: number): void {
    if (time <= (this.motion[this.motion.length - 1] ?? 0)) return;
    this.motion.push(time);
    this.screen.push((this.screen[this.screen.length - 1] ?? 0) + lasts);
  }
}

/** Contacts with a margin before and after; those that then overlap are one. */
function merged(contacts: readonly Window[], begin: number, end: number): Window[] {
  const margin = 0.004 * (end - begin);
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
  /** Where it was sent, to the last digit; until the playback moves. */
  private sought: number | null = null;
  private last = 0;
  private request = 0;

  constructor(private warp: TimeWarp, private readonly onTime: (time: number, ended: boolean) => void) {}

  get time(): number {
    return this.sought ?? this.warp.toMotion(this.position);
  }

  /** Another situation: a running playback goes on at the same place of the screen, a standing one keeps its time. */
  setWarp(warp: TimeWarp): void {
    const time = this.time;
    this.warp = warp;
    if (this.playing) this.sought = null;
    this.position = this.playing ? Math.min(this.position, warp.duration) : warp.toScreen(time);
  }

  seek(time: number): void {
    this.sought = Math.min(this.warp.end, Math.max(this.warp.begin, time));
    this.position = this.warp.toScreen(time);
  }

  /** Part of the playback that has passed, 0 to 1. */
  get progress(): number {
    return this.warp.duration > 0 ? this.position / this.warp.duration : 0;
  }

  set progress(part: number) {
    this.sought = null;
    this.position = part * this.warp.duration;
  }

  progressAt(time: number): number {
    return this.warp.duration > 0 ? this.warp.toScreen(time) / this.warp.duration : 0;
  }

  play(): void {
    if (this.playing) return;
    if (this.position >= this.warp.duration - 1e-9) this.position = 0;
    this.playing = true;
    this.last = 0;
    this.request = requestAnimationFrame((now) => this.frame(now));
  }

  pause(): void {
    this.playing = false;
    cancelAnimationFrame(this.request);
  }

  private frame(now: number): void {
    // A tab in the background draws no frames: coming back must not jump over impacts.
    const passed = this.last ? Math.min(0.1, (now - this.last) / 1000) : 0;
    this.last = now;
    this.sought = null;
    this.position = Math.min(this.warp.duration, this.position + passed * this.rate);
    const ended = this.position >= this.warp.duration;
    if (ended) this.playing = false;
    this.onTime(this.time, ended);
    if (this.playing) this.request = requestAnimationFrame((next) => this.frame(next));
  }
}
