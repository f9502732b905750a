// SPDX-License-Identifier: GPL-3.0-or-later
// Recorded motions, each over what the discrete model says of the same drop: a race of engines, as the league of this project recorded
// it, and squares and cubes that cameras tracked, with a law that was fitted on other drops. Small pictures that a slider moves through
// time, by hand or by itself.
import { ask, type SequenceAnswer } from "./api";
import { BODIES, uniformBody, type Body } from "./body";
import cubes from "./cubes.json";
import { byId, make, svg } from "./dom";
import { fixed, significant } from "./format";
import squares from "./measured.json";
import { DiscreteMotion } from "./motion";
import race from "./race.json";
import { normalised, planeRotation, plus, product, rotate, slerp, type Rotation, type Vector } from "./rotation";
import { LOOK, facesOf, onPaper } from "./sketch";

interface Place {
  centre: Vector;
  rotation: Rotation;
}

/** How a picture shows a place: where the eye looks, and what is to the right and up. */
interface Look {
  look: Vector;
  onPaper(place: Vector): readonly [number, number];
}

interface Gallery<Drop> {
  /** Of the elements: `ID-cells`, `ID-time`, `ID-play`, `ID-now`. */
  id: string;
  drops: readonly Drop[];
  body: Body;
  /** Of time, from 0 [s], and how much slower than life it plays. */
  end: number;
  slower: number;
  look: Look;
  height: number;
  /** Of the ground, from above [px]. */
  floor: number;
  /** [px/m] */
  scale: number;
  /** Of the ground, from the middle [m]. */
  ground: readonly Vector[];
  /** The place of the ground in the middle of a picture. */
  middle(drop: Drop): Vector;
  title(drop: Drop): string;
  hint?(drop: Drop): string;
  recorded(drop: Drop, time: number): Place;
  predicted(drop: Drop): Promise<(time: number) => Place>;
}

const WIDTH = 160;
const TICKS = 1e4; // of a slider, a second
const FROM_THE_SIDE: Look = { look: [0, 1, 0], onPaper: ([x, , z]) => [x, z] };
const FROM_ABOVE: Look = { look: LOOK, onPaper };

function apartInWords(one: Place, other: Place): string {
  const [w] = product(one.rotation, other.rotation.map((part, i) => (i === 0 ? part : -part)) as Rotation);
  const turned = (360 / Math.PI) * Math.acos(Math.min(1, Math.abs(w)));
  return `off by ${significant(1e3 * Math.hypot(...plus(one.centre, other.centre, -1)), 2)} mm, ${significant(turned, 2)}°`;
}

function show<Drop>(gallery: Gallery<Drop>): void {
  const { id, drops, body, end, slower, look, height, floor, scale } = gallery;
  const cells = drops.map((drop) => ({
    drop, exact: svg("path", { class: "exact" }), own: svg("path", { class: "own" }), words: make("span"),
    predicted: null as ((time: number) => Place) | null,
  }));
  const pathOf = (points: readonly Vector[], drop: Drop): string => `M${points.map((point) => {
    const [x, y] = look.onPaper(plus(point, gallery.middle(drop), -1));
    return `${(WIDTH / 2 + x * scale).toFixed(2)},${(floor - y * scale).toFixed(2)}`;
  }).join("L")}Z`;
  const put = (path: SVGElement, { centre, rotation }: Place, drop: Drop): void => {
    // Of a rod its axis.
    const faces = body.shape === "box" ? facesOf(body, rotation, look.look) : [[-0.5, 0.5].map((part) => rotate(rotation, [part * body.length, 0, 0]))];
    path.setAttribute("d", faces.map((face) => pathOf(face.map((corner) => plus(centre, corner)), drop)).join(""));
  };
  byId(`${id}-cells`).append(...cells.map(({ drop, exact, own, words }) => {
    const picture = svg("svg", { viewBox: `0 0 ${WIDTH} ${height}`, "aria-hidden": "true" });
    const ground = gallery.ground.map((point) => plus(gallery.middle(drop), point));
    picture.append(svg("path", { class: "ground", d: pathOf(ground, drop) }), exact, own);
    return make("li", { title: gallery.hint?.(drop) ?? false }, make("b", {}, gallery.title(drop)), picture, words);
  }));
  const slider = byId<HTMLInputElement>(`${id}-time`);
  const showNow = (): void => {
    const time = Number(slider.value) / TICKS;
    const ms = `${fixed(time * 1e3, 1)} ms`;
    slider.setAttribute("aria-valuetext", ms);
    byId(`${id}-now`).textContent = `${ms}, ${slower} times slower than life when it plays`;
    for (const { drop, exact, own, words, predicted } of cells) {
      const seen = gallery.recorded(drop, time);
      put(own, seen, drop);
      if (!predicted) continue;
      put(exact, predicted(time), drop);
      words.textContent = apartInWords(seen, predicted(time));
    }
  };
  slider.max = String(Math.round(end * TICKS));
  playBy(byId(`${id}-play`), slider, slower, showNow);
  showNow();
  for (const cell of cells) void gallery.predicted(cell.drop).then((predicted) => { cell.predicted = predicted; showNow(); });
}

function playBy(button: HTMLElement, slider: HTMLInputElement, slower: number, showNow: () => void): void {
  /** When the last picture was drawn; null while it stands. */
  let last: number | null = null;
  const pause = (): void => {
    last = null;
    button.textContent = "Play";
  };
  const frame = (now: number): void => {
    if (last === null) return;
    const passed = last ? Math.min(0.1, (now - last) / 1000) : 0;
    last = now;
    slider.value = String(Number(slider.value) + Math.round((TICKS * passed) / slower));
    showNow();
    if (Number(slider.value) >= Number(slider.max)) pause();
    else requestAnimationFrame(frame);
  };
  slider.addEventListener("input", () => { pause(); showNow(); });
  button.addEventListener("click", () => {
    if (last !== null) return pause();
    if (Number(slider.value) >= Number(slider.max)) slider.value = "0";
    last = 0;
    button.textContent = "Stop";
    requestAnimationFrame(frame);
  });
}

/** Between the rows of a column. */
function between(column: readonly number[], place: number): number {
  const row = Math.min(Math.floor(place), column.length - 2);
  const [a = 0, b = 0] = column.slice(row, row + 2);
  return a + Math.min(1, place - row) * (b - a);
}

/** From the left to the right of a picture. */
const level = (scale: number): Vector[] => [[(4 - WIDTH / 2) / scale, 0, 0], [(WIDTH / 2 - 4) / scale, 0, 0]];

const { angle, speed, gap } = race.drop;
const ROD = uniformBody(BODIES.rod.size);
/** The drop of all engines; the recorded runs begin above the ground. */
const exact = ask<SequenceAnswer>({ path: "sequence", body: { angle, speed } }).then(({ impacts }) => {
  const motion = new DiscreteMotion(ROD, impacts, 0, [0, 0, 0]);
  return (time: number): Place => motion.pose(time - gap / speed);
});

const RACE: Gallery<(typeof race.runs)[number]> = {
  id: "race", drops: race.runs, body: ROD, end: race.step * (Math.max(...race.runs.map(({ z }) => z.length)) - 1), slower: 25,
  look: FROM_THE_SIDE, height: 66, floor: 58, scale: 118, ground: level(118),
  middle: () => [0, 0, 0],
  title: ({ name }) => name,
  hint: ({ version, settings }) => `Version ${version}: ${settings}`,
  // Tenths of a millimetre and milliradians.
  recorded: ({ z, phi }, time) =>
    ({ centre: [0, 0, between(z, time / race.step) / 1e4], rotation: planeRotation(between(phi, time / race.step) / 1e3) }),
  predicted: () => exact,
};

/** What a camera's drops have in common, and the state of one at its first touch. */
type Law = Pick<typeof squares, "side" | "gravity" | "e" | "friction" | "inertia">;
interface Touch {
  touch: number;
  over: readonly number[];
  attitude: readonly number[];
  velocity: readonly number[];
  spin: readonly number[];
}

function cubeOf({ side, inertia }: Law): Body {
  const moment = (inertia * side ** 2) / 6;
  const size = { shape: "box", mass: 1, length: side, radius: 0, width: side, thickness: side } as const;
  return { ...uniformBody(size), inertia: [moment, moment, moment, 0, 0, 0] };
}

async function predictedCube(law: Law, { touch, over: [x = 0, y = 0], attitude, velocity, spin }: Touch): Promise<(time: number) => Place> {
  const body = cubeOf(law);
  const { side, gravity, e, friction } = law;
  const { impacts } = await ask<SequenceAnswer>({
    path: "sequence", body: {
      body: "box", mass: 1, size: [side, side, side], inertia: body.inertia.slice(0, 3).join(","), attitude: attitude.join(","),
      velocity: velocity.join(","), angular_velocity: spin.join(","), gravity, restitution: e, friction, impacts: 8,
    },
  });
  const motion = new DiscreteMotion(body, impacts, gravity, spin as Vector);
  return (time) => {
    const { centre, rotation } = motion.pose(Math.min(time - touch, motion.end));
    return { centre: plus(centre, [x, y, 0]), rotation };
  };
}

const SQUARES: Gallery<(typeof squares.drops)[number]> = {
  id: "measured", drops: squares.drops, body: cubeOf(squares),
  end: (Math.max(...squares.drops.map(({ z }) => z.length)) - 1) / squares.rate, slower: 20,
  look: FROM_THE_SIDE, height: 112, floor: 104, scale: 560, ground: level(560),
  middle: ({ x }) => [(Math.max(...x) + Math.min(...x)) / 2e4, 0, 0],
  title: ({ name }) => `Drop ${name}`,
  recorded: ({ x, z, angle: turns }, time) => {
    const [right, up, turned] = [x, z, turns].map((column) => between(column, time * squares.rate)) as Vector;
    return { centre: [right / 1e4, 0, up / 1e4], rotation: planeRotation(turned / 1e3) };
  },
  predicted: ({ touch, place: [x = 0, , turned = 0], speed: [right = 0, up = 0, spin = 0] }) => predictedCube(squares,
    { touch, over: [x, 0], attitude: planeRotation(turned), velocity: [right, 0, up], spin: [0, -spin, 0] }),
};

const FRAMES = Math.min(...cubes.drops.map(({ turns }) => turns.length / 4));
const LAST = (FRAMES - 1) / cubes.rate;

function trackedCube({ places, turns }: (typeof cubes.drops)[number], time: number): Place {
  const row = Math.min(Math.floor(time * cubes.rate), FRAMES - 2);
  const part = time * cubes.rate - row;
  const [a, b] = [row, row + 1].map((frame) => places.slice(3 * frame, 3 * frame + 3).map((length) => length / 1e4)) as [Vector, Vector];
  const [p, q] = [row, row + 1].map((frame) => normalised(turns.slice(4 * frame, 4 * frame + 4) as Rotation)) as [Rotation, Rotation];
  return { centre: plus(a, plus(b, a, -1), part), rotation: slerp(p, q, part) };
}

const CUBES: Gallery<(typeof cubes.drops)[number]> = {
  id: "cubes", drops: cubes.drops, body: cubeOf(cubes), end: LAST, slower: 20, look: FROM_ABOVE, height: 112, floor: 80, scale: 270,
  ground: [[-0.3, -0.2, 0], [0.3, -0.2, 0], [0.3, 0.2, 0], [-0.3, 0.2, 0]],
  middle: (toss) => {
    const [first, last] = [trackedCube(toss, 0).centre, trackedCube(toss, LAST).centre];
    return [(first[0] + last[0]) / 2, (first[1] + last[1]) / 2, 0];
  },
  title: ({ name }) => `Toss ${name}`,
  recorded: trackedCube,
  predicted: ({ touch, place, attitude, speed: velocity, spin }) => predictedCube(cubes, { touch, over: place, attitude, velocity, spin }),
};

export function setUpTracks(): void {
  for (const [id, { e, friction }] of Object.entries({ measured: squares, cubes })) {
    byId(`${id}-law`).textContent = `e = ${significant(e, 2)}, μ = ${significant(friction, 2)}`;
  }
  show(RACE);
  show(SQUARES);
  show(CUBES);
}
