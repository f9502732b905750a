// SPDX-License-Identifier: GPL-3.0-or-later
// The contact patch: the outline in which a body that presses into the ground cuts through the ground's level; its panel beside the
// force that acts on it.
import { cornersOf, middleOf, type Body } from "./body";
import { byId } from "./dom";
import { significant } from "./format";
import { hasEnded, shownTime, type Motion, type Pose } from "./motion";
import { plus, rotate, type Vector } from "./rotation";

export interface Patch {
  /** On the ground, around it. */
  outline: Vector[];
  /** Of the lowest point below the ground [m]. */
  depth: number;
  /** Along x and y [m]. */
  size: readonly [number, number];
}

type Edge = readonly [Vector, Vector];

/** From the geometric centre, body axes; round ends have as many corners as the simulator's mesh. */
function edgesOf(body: Body): Edge[] {
  if (body.shape === "box") {
    const corners = cornersOf(body).map(({ place }) => place);
    const differ = (a: Vector, b: Vector): number => a.filter((part, i) => part !== b[i]).length;
    return corners.flatMap((a, i) => corners.slice(i + 1).filter((b) => differ(a, b) === 1).map((b): Edge => [a, b]));
  }
  const at = (side: number, i: number): Vector =>
    [(side * body.length) / 2, body.radius * Math.cos((i * Math.PI) / 32), body.radius * Math.sin((i * Math.PI) / 32)];
  return Array.from({ length: 64 }, (_none, i): Edge[] => [[at(-1, i), at(1, i)], [at(-1, i), at(-1, i + 1)], [at(1, i), at(1, i + 1)]]).flat();
}

const edges = new WeakMap<Body, Edge[]>();

export function patchOf(body: Body, pose: Pose): Patch | null {
  const own = edges.get(body) ?? edgesOf(body);
  edges.set(body, own);
  const middle = middleOf(body, pose.centre, pose.rotation);
  const points: Vector[] = [];
  let lowest = 0;
  for (const edge of own) {
    const [a, b] = edge.map((end) => plus(middle, rotate(pose.rotation, end))) as [Vector, Vector];
    lowest = Math.min(lowest, a[2], b[2]);
    if (a[2] < 0 === b[2] < 0) continue;
    const part = a[2] / (a[2] - b[2]);
    points.push([a[0] + part * (b[0] - a[0]), a[1] + part * (b[1] - a[1]), 0]);
  }
  const outline = hullOf(points);
  if (outline.length < 3) return null;
  const extent = (axis: 0 | 1): number => Math.max(...outline.map((p) => p[axis])) - Math.min(...outline.map((p) => p[axis]));
  return { outline, depth: -lowest, size: [extent(0), extent(1)] };
}

/** The convex hull on the ground, counterclockwise (Andrew's monotone chain). */
function hullOf(points: Vector[]): Vector[] {
  const sorted = [...points].sort((a, b) => a[0] - b[0] || a[1] - b[1]);
  const chain = (all: Vector[]): Vector[] => {
    const kept: Vector[] = [];
    for (const point of all) {
      for (let [p, q] = kept.slice(-2); p && q && turn(p, q, point) <= 0; [p, q] = kept.slice(-2)) kept.pop();
      kept.push(point);
    }
    return kept.slice(0, -1);
  };
  return [...chain(sorted), ...chain(sorted.reverse())];
}

const turn = (a: Vector, b: Vector, c: Vector): number => (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);

export function showPatch(motion: Motion | null, time: number): void {
  const patch = motion && time >= 0 ? patchOf(motion.body, motion.pose(shownTime(motion, time))) : null;
  byId("patch-words").textContent = (motion && hasEnded(motion, time) ? "the model ends here; " : "") + (patch
    ? `${significant(patch.size[0] * 1e3, 3)} × ${significant(patch.size[1] * 1e3, 3)} mm, ${significant(patch.depth * 1e3, 3)} mm deep` : "nothing touches now");
}
