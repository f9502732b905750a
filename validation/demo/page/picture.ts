// SPDX-License-Identifier: GPL-3.0-or-later
// What draws the motion: in space, or without a graphics card in lines.
import type { Frame, ModelName } from "./frame";
import type { Orbit } from "./orbit";
import type { Vector } from "./rotation";

/** Place in the picture, from its upper left corner [px]. */
export interface Projection {
  x: number;
  y: number;
}

export interface View {
  resize(width: number, height: number): void;
  draw(frame: Frame, orbit: Orbit): void;
  project(model: ModelName, point: Vector, side: boolean): Projection;
}
