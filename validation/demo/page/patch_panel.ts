// SPDX-License-Identifier: GPL-3.0-or-later
// The contact patch beside the force that acts on it.
import type { History } from "./answers";
import { byId } from "./dom";
import { significant } from "./format";
import { hasEnded, shownTime, type Motion } from "./motion";
import { patchOf } from "./patch";
import { svg } from "./sketch";

/** The largest extent of all patches of a run, so that they are drawn in one scale. */
function largestOf(motion: Motion, { t, in_contact: touches }: History): number {
  return t.reduce((most, time, i) => (touches[i] ? Math.max(most, ...(patchOf(motion.body, motion.pose(time))?.size ?? [])) : most), 0);
}

const largest = new WeakMap<Motion, number>();
const SIDE = 120;

/** The patch from above, and its size in words. */
export function showPatch(motion: Motion | null, history: History | null, time: number): void {
  const patch = motion && time >= 0 ? patchOf(motion.body, motion.pose(shownTime(motion, time))) : null;
  byId("patch-words").textContent = (motion && hasEnded(motion, time) ? "the model ends here; " : "") + (patch
    ? `${significant(patch.size[0] * 1e3, 3)} × ${significant(patch.size[1] * 1e3, 3)} mm, ${significant(patch.depth * 1e3, 3)} mm deep` : "nothing touches now");
  if (!motion || !history) return;
  const whole = largest.get(motion) ?? largestOf(motion, history);
  largest.set(motion, whole);
  const scale = SIDE / (1.1 * whole || 1);
  const picture = svg("svg", { viewBox: `0 0 ${SIDE} ${SIDE}`, "aria-hidden": "true" });
  if (patch) {
    // Around the middle of its extent.
    const middle = ([0, 1] as const).map((axis) => (Math.max(...patch.outline.map((p) => p[axis])) + Math.min(...patch.outline.map((p) => p[axis]))) / 2);
    const [x0 = 0, y0 = 0] = middle;
    const points = patch.outline.map(([x, y]) => `${(SIDE / 2 + (x - x0) * scale).toFixed(1)},${(SIDE / 2 - (y - y0) * scale).toFixed(1)}`);
    picture.append(svg("polygon", { points: points.join(" ") }));
  }
  byId("patch-picture").replaceChildren(picture);
}
