// SPDX-License-Identifier: GPL-3.0-or-later
// Measured: squares that a camera tracked, each over what the discrete model predicts from its fall, with a law fitted on other drops.
import type { SequenceAnswer } from "./answers";
import { ask } from "./api";
import { uniformBody, type Body } from "./body";
import { DiscreteMotion } from "./discrete_motion";
import { setUpCubes } from "./cubes";
import { byId, make } from "./dom";
import { significant } from "./format";
import tracked from "./measured.json";
import type { Motion } from "./motion";
import { Replay, apart } from "./replay";
import type { Vector } from "./rotation";
import { svg } from "./sketch";

const { rate, side, gravity, e, friction, inertia, drops } = tracked;
type Drop = (typeof drops)[number];
const WIDTH = 160;
const FLOOR = 104;
const SCALE = 560; // px a metre
const SLOWER = 20;
const END = (Math.max(...drops.map(({ z }) => z.length)) - 1) / rate;

/** Along the ground and up [m], and counterclockwise [rad]. */
type Place = readonly [number, number, number];

function trackedAt({ x, z, angle }: Drop, time: number): Place {
  const row = Math.min(Math.floor(time * rate), z.length - 2);
  const part = time * rate - row;
  const at = (column: number[]): number => (column[row] ?? 0) + part * ((column[row + 1] ?? 0) - (column[row] ?? 0));
  return [at(x) / 1e4, at(z) / 1e4, at(angle) / 1e3];
}

/** From the state at the first touch on. */
async function predicted({ place, speed }: Drop): Promise<Motion> {
  const [, , angle = 0] = place;
  const [vx = 0, vz = 0, turn = 0] = speed;
  const moment = (inertia * side ** 2) / 6;
  const spin: Vector = [0, -turn, 0];
  const { impacts } = await ask<SequenceAnswer>({
    path: "sequence", body: {
      body: "box", mass: 1, size: [side, side, side], inertia: [moment, moment, moment].join(","),
      attitude: [Math.cos(angle / 2), 0, -Math.sin(angle / 2), 0].join(","), velocity: [vx, 0, vz].join(","), angular_velocity: spin.join(","),
      gravity, restitution: e, friction, impacts: 8,
    },
  });
  const body: Body = { ...uniformBody({ shape: "box", mass: 1, length: side, radius: 0, width: side, thickness: side }), inertia: [moment, moment, moment, 0, 0, 0] };
  return new DiscreteMotion(body, impacts, gravity, spin);
}

/** @param middle of the picture along the ground [m] */
function put(square: SVGElement, [x, z, angle]: Place, middle: number): void {
  const corners = [45, 135, 225, 315].map((corner) => {
    const turned = angle + (corner * Math.PI) / 180;
    const half = side * Math.SQRT1_2;
    return `${(WIDTH / 2 + (x - middle + half * Math.cos(turned)) * SCALE).toFixed(2)},${(FLOOR - (z + half * Math.sin(turned)) * SCALE).toFixed(2)}`;
  });
  square.setAttribute("points", corners.join(" "));
}

export function setUpMeasured(): void {
  byId("measured-law").textContent = `e = ${significant(e, 2)}, μ = ${significant(friction, 2)}`;
  const cells = drops.map((drop) => ({
    drop, model: svg("polygon", { class: "exact" }), seen: svg("polygon", { class: "own" }), words: make("span"), motion: null as Motion | null,
    middle: (Math.max(...drop.x) + Math.min(...drop.x)) / 2e4,
  }));
  byId("measured-cells").append(...cells.map(({ drop, model, seen, words }) => {
    const picture = svg("svg", { viewBox: `0 0 ${WIDTH} 112`, "aria-hidden": "true" });
    picture.append(svg("line", { x1: 4, x2: WIDTH - 4, y1: FLOOR, y2: FLOOR, class: "ground" }), model, seen);
    return make("li", {}, make("b", {}, `Drop ${drop.name}`), picture, words);
  }));
  const replay = new Replay("measured", END, SLOWER, (time) => {
    for (const { drop, model, seen, words, motion, middle } of cells) {
      const own = trackedAt(drop, time);
      put(seen, own, middle);
      if (!motion) continue;
      const { centre, inclination } = motion.pose(Math.min(time - drop.touch, motion.end));
      const place: Place = [drop.place[0] ?? 0, 0, 0];
      const guess: Place = [place[0] + centre[0], centre[2], inclination];
      put(model, guess, middle);
      words.textContent = apart(Math.hypot(own[0] - guess[0], own[1] - guess[1]), own[2] - guess[2]);
    }
  });
  for (const cell of cells) void predicted(cell.drop).then((motion) => { cell.motion = motion; replay.show(); });
  setUpCubes();
}
