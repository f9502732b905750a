// SPDX-License-Identifier: GPL-3.0-or-later
// From where the picture is seen: turned by dragging beside the body, drawn near by wheel or pinch, both by keys, and set back.
import { byId } from "./dom";

/** Added to where the picture is seen from by itself [rad]; `zoom` divides the distance. */
export interface Orbit {
  azimuth: number;
  elevation: number;
  zoom: number;
}

export const STRAIGHT: Orbit = { azimuth: 0, elevation: 0, zoom: 1 };

const TURN = 0.008; // rad a pixel
const STEP = 0.12; // rad a key
const NEARER = 1.15; // a key

export class OrbitControl {
  orbit: Orbit = STRAIGHT;
  private readonly reset = byId<HTMLButtonElement>("view-reset");

  constructor(stage: HTMLElement, private readonly onTurn: () => void) {
    this.reset.addEventListener("click", () => { this.set(STRAIGHT); stage.focus(); });
    // The wheel belongs to the page until somebody works with the picture.
    stage.addEventListener("wheel", (event) => {
      if (document.activeElement !== stage && !event.ctrlKey) return;
      event.preventDefault();
      this.turn(0, 0, NEARER ** (-event.deltaY / 100));
    }, { passive: false });
  }

  drag(right: number, down: number): void {
    this.turn(right * TURN, down * TURN);
  }

  pinch(nearer: number): void {
    this.turn(0, 0, nearer);
  }

  /** @return whether the key was one of its own */
  key({ key, shiftKey }: KeyboardEvent): boolean {
    const turns: Record<string, [number, number]> = { ArrowLeft: [-STEP, 0], ArrowRight: [STEP, 0], ArrowUp: [0, STEP], ArrowDown: [0, -STEP] };
    const turn = shiftKey ? turns[key] : undefined;
    if (turn) this.turn(...turn);
    else if (key === "+" || key === "=") this.turn(0, 0, NEARER);
    else if (key === "-") this.turn(0, 0, 1 / NEARER);
    else if (key === "0") this.set(STRAIGHT);
    else return false;
    return true;
  }

  private turn(right: number, up: number, nearer = 1): void {
    const { azimuth, elevation, zoom } = this.orbit;
    const limit = (value: number, low: number, high: number): number => Math.min(high, Math.max(low, value));
    this.set({ azimuth: azimuth - right, elevation: limit(elevation + up, -0.5, 1.2), zoom: limit(zoom * nearer, 0.25, 6) });
  }

  private set(orbit: Orbit): void {
    this.orbit = orbit;
    this.reset.hidden = orbit.azimuth === 0 && orbit.elevation === 0 && orbit.zoom === 1;
    this.onTurn();
  }
}
