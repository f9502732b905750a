// SPDX-License-Identifier: GPL-3.0-or-later
// Measured in space: cubes that cameras tracked, each over what the discrete model predicts from its fall, with a law fitted on other tosses.
import type { SequenceAnswer } from "./answers";
import { ask } from "./api";
import { uniformBody, type Body } from "./body";
import tracked from "./cubes.json";
import { DiscreteMotion } from "./discrete_motion";
import { byId, make } from "./dom";
import { significant } from "./format";
import type { Motion } from "./motion";
import { facesOf } from "./outline";
import { Replay, apart } from "./replay";
import { normalised, plus, product, slerp, type Rotation, type Vector } from "./rotation";
import { LOOK, onPaper, svg } from "./sketch";

const { rate, side, gravity, e, friction, inertia, drops } = tracked;
type Drop = (typeof drops)[number];
const WIDTH = 160;
const HEIGHT = 112;
const SCALE = 270; // px a metre
const SLOWER = 20;
const FRAMES = Math.min(...drops.map(({ turns }) => turns.length / 4));
const END = (FRAMES - 1) / rate;
/** Of the ground below a picture, from its middle [m]. */
const GROUND = [[-0.3, -0.2], [0.3, -0.2], [0.3, 0.2], [-0.3, 0.2]] as const;

const moment = (inertia * side ** 2) / 6;
const CUBE: Body = { ...uniformBody({ shape: "box", mass: 1, length: side, radius: 0, width: side, thickness: side }), inertia: [moment, moment, moment, 0, 0, 0] };

interface Place {
  centre: Vector;
  rotation: Rotation;
}

/** Between two frames; whole tenths of a millimetre and thousandths. */
function trackedAt({ places, turns }: Drop, time: number): Place {
  const row = Math.min(Math.floor(time * rate), FRAMES - 2);
  const part = time * rate - row;
  const place = (frame: number): Vector => places.slice(3 * frame, 3 * frame + 3).map((length) => length / 1e4) as Vector;
  const turn = (frame: number): Rotation => normalised(turns.slice(4 * frame, 4 * frame + 4) as Rotation);
  return { centre: plus(place(row), plus(place(row + 1), place(row), -1), part), rotation: slerp(turn(row), turn(row + 1), part) };
}

/** From the state at the first touch on. */
async function predicted({ attitude, speed, spin }: Drop): Promise<Motion> {
  const { impacts } = await ask<SequenceAnswer>({
    path: "sequence", body: {
      body: "box", mass: 1, size: [side, side, side], inertia: [moment, moment, moment].join(","), attitude: attitude.join(","),
      velocity: speed.join(","), angular_velocity: spin.join(","), gravity, restitution: e, friction, impacts: 8,
    },
  });
  return new DiscreteMotion(CUBE, impacts, gravity, spin as Vector);
}

/** On the paper, so that the middle of the track stands in the middle of the picture. */
const pathOf = (points: readonly Vector[], middle: Vector): string => `M${points.map((point) => {
  const [x, y] = onPaper(plus(point, middle, -1));
  return `${(WIDTH / 2 + x * SCALE).toFixed(1)},${(HEIGHT - 32 - y * SCALE).toFixed(1)}`;
}).join("L")}Z`;

function put(path: SVGElement, { centre, rotation }: Place, middle: Vector): void {
  path.setAttribute("d", facesOf(CUBE, rotation, LOOK).map((face) => pathOf(face.map((corner) => plus(corner, centre)), middle)).join(""));
}

function apartInWords(one: Place, other: Place): string {
  const [w] = product(one.rotation, other.rotation.map((part, i) => (i === 0 ? part : -part)) as Rotation);
  return apart(Math.hypot(...plus(one.centre, other.centre, -1)), 2 * Math.acos(Math.min(1, Math.abs(w))));
}

function middleOfTrack(drop: Drop): Vector {
  const [first, last] = [trackedAt(drop, 0).centre, trackedAt(drop, END).centre];
  return [(first[0] + last[0]) / 2, (first[1] + last[1]) / 2, 0];
}

export function setUpCubes(): void {
  byId("cubes-law").textContent = `e = ${significant(e, 2)}, μ = ${significant(friction, 2)}`;
  const cells = drops.map((drop) => ({
    drop, model: svg("path", { class: "exact" }), seen: svg("path", { class: "own" }), words: make("span"), motion: null as Motion | null, middle: middleOfTrack(drop),
  }));
  byId("cubes-cells").append(...cells.map(({ drop, model, seen, words, middle }) => {
    const picture = svg("svg", { viewBox: `0 0 ${WIDTH} ${HEIGHT}`, "aria-hidden": "true" });
    const ground = svg("path", { class: "ground", d: pathOf(GROUND.map(([x, y]) => [middle[0] + x, middle[1] + y, 0]), middle) });
    picture.append(ground, model, seen);
    return make("li", {}, make("b", {}, `Toss ${drop.name}`), picture, words);
  }));
  const replay = new Replay("cubes", END, SLOWER, (time) => {
    for (const { drop, model, seen, words, motion, middle } of cells) {
      const own = trackedAt(drop, time);
      put(seen, own, middle);
      if (!motion) continue;
      const pose = motion.pose(Math.min(time - drop.touch, motion.end));
      const [x = 0, y = 0] = drop.place;
      const guess = { centre: plus(pose.centre, [x, y, 0]), rotation: pose.rotation };
      put(model, guess, middle);
      words.textContent = apartInWords(own, guess);
    }
  });
  for (const cell of cells) void predicted(cell.drop).then((motion) => { cell.motion = motion; replay.show(); });
}
