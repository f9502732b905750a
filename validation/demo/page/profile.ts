// SPDX-License-Identifier: GPL-3.0-or-later
// How fast each point of the body moves up and down, just before and just after a blow: why the end that did not strike comes down
// twice as fast.
import { byId } from "./dom";
import { significant } from "./format";
import { isDisc, longHalf } from "./body";
import { pointMotion, type Motion } from "./motion";
import type { Vector } from "./rotation";
import { svg } from "./sketch";

const WIDTH = 420;
const HEIGHT = 220;
const LEFT = 48;
const RIGHT = 372;

/** Upward velocity of the two ends, or of two opposite points of a disc's rim, at a time [m/s]. */
function velocities(motion: Motion, time: number): [number, number] {
  const pose = motion.pose(time);
  const half = longHalf(motion.body);
  const at = (side: number): number => pointMotion(motion.body, pose, half.map((part) => side * part) as Vector).velocity[2];
  return [at(-1), at(1)];
}

export function showProfile(motion: Motion | null, n: number): void {
  byId("profile-title").textContent = `Along the body, at blow ${n}`;
  const box = byId("profile-picture");
  const impact = motion?.impacts[n - 1];
  byId("panel-profile").classList.toggle("empty", !impact);
  if (!motion || !impact) return;
  const gap = 1e-9 * Math.max(1e-6, motion.end - motion.begin);
  const lines = { before: velocities(motion, impact.start - gap), after: velocities(motion, impact.start) };
  const most = Math.max(1e-12, ...Object.values(lines).flat().map(Math.abs));
  const names = isDisc(motion.body) ? ["one side", "other side"] as const : ["end a", "end b"] as const;
  const y = (speed: number): string => (HEIGHT / 2 - (speed / most) * (HEIGHT / 2 - 30)).toFixed(1);
  const words = (name: "before" | "after"): string => `${name} the blow ${significant(lines[name][0], 3)} m/s at ${names[0]} and ${significant(lines[name][1], 3)} m/s at ${names[1]}`;
  const picture = svg("svg", { viewBox: `0 0 ${WIDTH} ${HEIGHT}`, role: "img", "aria-label": `Upward velocity along the body: ${words("before")}, ${words("after")}` });
  picture.append(svg("line", { x1: LEFT - 12, x2: RIGHT + 12, y1: y(0), y2: y(0), class: "axis" }));
  for (const name of ["before", "after"] as const) {
    const [a, b] = lines[name];
    picture.append(svg("line", { x1: LEFT, x2: RIGHT, y1: y(a), y2: y(b), class: name }));
    for (let i = 0; i <= 6; i++) {
      const x = LEFT + ((RIGHT - LEFT) * i) / 6;
      picture.append(svg("line", { x1: x, x2: x, y1: y(0), y2: y(a + ((b - a) * i) / 6), class: `${name} thin` }));
    }
    // Numbers that would lie on each other stand above and below.
    const shift = (own: number, other: number): number => (Math.abs(own - other) / most < 0.15 && name === "after" ? 16 : -6);
    const other = lines[name === "after" ? "before" : "after"];
    picture.append(label(LEFT - 8, Number(y(a)) + shift(a, other[0]), "end", a, name), label(RIGHT + 8, Number(y(b)) + shift(b, other[1]), "start", b, name));
  }
  for (const [x, y0, words] of [[LEFT, HEIGHT - 6, names[0]], [RIGHT, HEIGHT - 6, names[1]], [WIDTH / 2, 14, "velocity upwards in m/s"]] as const) {
    const text = svg("text", { x, y: y0, "text-anchor": "middle", class: "end" });
    text.textContent = words;
    picture.append(text);
  }
  box.replaceChildren(picture);
}

function label(x: number, y: number, anchor: string, speed: number, name: string): SVGElement {
  const text = svg("text", { x, y, "text-anchor": anchor, class: name });
  text.textContent = significant(speed, 3);
  return text;
}
