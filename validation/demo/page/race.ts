// SPDX-License-Identifier: GPL-3.0-or-later
// The race: one drop as engines of others computed it, recorded by the league, each beside the exact one, which this page computes.
import type { SequenceAnswer } from "./answers";
import { ask } from "./api";
import { BODIES, uniformBody } from "./body";
import { DiscreteMotion } from "./discrete_motion";
import { byId, make } from "./dom";
import type { Motion } from "./motion";
import recorded from "./race.json";
import { Replay, apart } from "./replay";
import { svg } from "./sketch";

const { drop, step, runs } = recorded;
const WIDTH = 160;
const FLOOR = 58;
const SCALE = 118; // px a metre
const HALF = 0.5; // of the rod [m]
const END = step * (Math.max(...runs.map(({ z }) => z.length)) - 1);
const SLOWER = 25;

/** Height of the middle [m] and inclination [rad]. */
type Place = readonly [number, number];

/** Between two steps, whole tenths of a millimetre and milliradians. */
function placeOf({ z, phi }: (typeof runs)[number], time: number): Place {
  const row = Math.min(Math.floor(time / step), z.length - 2);
  const part = Math.min(1, time / step - row);
  const at = (column: number[]): number => (column[row] ?? 0) + part * ((column[row + 1] ?? 0) - (column[row] ?? 0));
  return [at(z) / 1e4, at(phi) / 1e3];
}

function put(line: SVGElement, [height, angle]: Place): void {
  const [across, up] = [HALF * Math.cos(angle), HALF * Math.sin(angle)];
  const places = { x1: WIDTH / 2 - across * SCALE, x2: WIDTH / 2 + across * SCALE, y1: FLOOR - (height - up) * SCALE, y2: FLOOR - (height + up) * SCALE };
  for (const [name, value] of Object.entries(places)) line.setAttribute(name, value.toFixed(2));
}

export function setUpRace(): void {
  let motion: Motion | null = null;
  const cells = runs.map((run) => ({ run, words: make("span"), exact: svg("line", { class: "exact" }), own: svg("line", { class: "own" }) }));
  byId("race-cells").append(...cells.map(({ run, words, exact, own }) => {
    const picture = svg("svg", { viewBox: `0 0 ${WIDTH} 66`, "aria-hidden": "true" });
    picture.append(svg("line", { x1: 4, x2: WIDTH - 4, y1: FLOOR, y2: FLOOR, class: "ground" }), exact, own);
    return make("li", { title: `Version ${run.version}: ${run.settings}` }, make("b", {}, run.name), picture, words);
  }));
  const replay = new Replay("race", END, SLOWER, (time) => {
    // The recorded runs begin above the ground.
    const pose = motion?.pose(time - drop.gap / drop.speed);
    for (const { run, words, exact, own } of cells) {
      const [height, angle] = placeOf(run, time);
      put(own, [height, angle]);
      if (!pose) continue;
      put(exact, [pose.centre[2], pose.inclination]);
      words.textContent = apart(height - pose.centre[2], angle - pose.inclination);
    }
  });
  void ask<SequenceAnswer>({ path: "sequence", body: { angle: drop.angle, speed: drop.speed } }).then(({ impacts }) => {
    motion = new DiscreteMotion(uniformBody(BODIES.rod.size), impacts, 0, [0, 0, 0]);
    replay.show();
  });
}
