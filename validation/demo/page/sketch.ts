// SPDX-License-Identifier: GPL-3.0-or-later
// A small picture of a body at a touch, drawn in lines: parallel projection, seen from the right, the front and above.
import type { Impact } from "./api";
import { THINNEST, lowestPlace, middleOf, type Body } from "./body";
import { byId, make, press, svg } from "./dom";
import { significant } from "./format";
import { MODELS, type ModelName, type Motions } from "./frame";
import type { Pairing } from "./models";
import { touchRotation, type Motion } from "./motion";
import { cross, plus, rotate, type Rotation, type Vector } from "./rotation";
import { cornersInWords } from "./words";

const AZIMUTH = -0.45; // of the eye around the picture [rad]
const ELEVATION = 0.3;
const WIDTH = 150;
const HEIGHT = 104;
const FLOOR = 84; // of the point that strikes, from the top
const SPAN = 78; // of the body's longest diagonal

/** Where the eye looks. */
export const LOOK: Vector = [
  -Math.sin(AZIMUTH) * Math.cos(ELEVATION), Math.cos(AZIMUTH) * Math.cos(ELEVATION), -Math.sin(ELEVATION),
];

/** On the paper, to the right and up, of a place from the point that strikes [m]. */
export function onPaper([x, y, z]: Vector): [number, number] {
  const [c, s] = [Math.cos(AZIMUTH), Math.sin(AZIMUTH)];
  return [x * c + y * s, (-x * s + y * c) * Math.sin(ELEVATION) + z * Math.cos(ELEVATION)];
}

/** A body at a touch, and its impulse in the scale of the strongest of the run. */
function sketch(model: ModelName, { body, impacts }: Motion, rotation: Rotation, impulse: Vector): SVGSVGElement {
  const scale = SPAN / Math.hypot(body.length, body.width, body.thickness, 2 * body.radius);
  // From the point that strikes.
  const middle = middleOf(body, plus([0, 0, 0], lowestPlace(body, rotation), -1), rotation);
  const shift = onPaper(middle)[0] * scale;
  const at = (place: Vector): string => {
    const [x, y] = onPaper(place);
    return `${(WIDTH / 2 - shift + x * scale).toFixed(1)},${(FLOOR - y * scale).toFixed(1)}`;
  };
  const picture = svg("svg", { viewBox: `0 0 ${WIDTH} ${HEIGHT}`, class: `sketch ${model}`, "aria-hidden": "true" });
  // A piece of the ground below the body, as crossed lines.
  const half = (0.62 * SPAN) / scale;
  const lines = [-half, -half / 2, 0, half / 2, half].flatMap((place) => [
    `M${at([-half, place, 0])}L${at([half, place, 0])}`, `M${at([place, -half, 0])}L${at([place, half, 0])}`]);
  picture.append(svg("path", { class: "floor", d: lines.join("") }));
  for (const face of facesOf(body, rotation, LOOK)) {
    const corners = face.map((corner) => at(plus(middle, corner)));
    picture.append(svg("polygon", { points: corners.join(" "), style: `--shade:${shadeOf(face)}` }));
  }
  const strongest = Math.max(...impacts.map((impact) => Math.hypot(...impact.impulse)));
  const tip = plus([0, 0, 0], impulse, strongest > 0 ? (0.42 * SPAN) / scale / strongest : 0);
  picture.append(svg("path", { d: `M${at([0, 0, 0])}L${at(tip)}`, class: "blow", "marker-end": `url(#tip-${model})` }));
  return picture;
}

/** Of light from above: faces that look up are lighter. */
function shadeOf(face: readonly Vector[]): string {
  const heights = face.map(([, , z]) => z);
  const tilt = (heights.reduce((sum, z) => sum + z, 0) / face.length) / (Math.max(...heights.map(Math.abs)) || 1);
  return (0.55 + 0.4 * tilt).toFixed(2);
}

/** Corners of the faces of a box, or of a rod the rectangle that shows its outline to an eye that looks along
 *  `look`; only faces that are turned towards that eye. World axes, from the geometric centre. */
export function facesOf(body: Body, rotation: Rotation, look: Vector): Vector[][] {
  if (body.shape === "rod") return [rodOutline(body, rotation, look), ...discs(body, rotation, look)];
  const half: Vector = [body.length / 2, body.width / 2, body.thickness / 2];
  return [0, 1, 2].flatMap((axis) => [-1, 1].map((sign) => faceOf(half, axis, sign)))
    .map((face) => ({ normal: rotate(rotation, face.normal), corners: face.corners.map((corner) => rotate(rotation, corner)) }))
    .filter(({ normal }) => dot(normal, look) < 0)
    .map(({ corners }) => corners);
}

function faceOf(half: Vector, axis: number, sign: number): { normal: Vector; corners: Vector[] } {
  const [u, v] = [(axis + 1) % 3, (axis + 2) % 3];
  const corner = (a: number, b: number): Vector => {
    const place: Vector = [0, 0, 0];
    place[axis] = sign * (half[axis] ?? 0);
    place[u] = a * (half[u] ?? 0);
    place[v] = b * (half[v] ?? 0);
    return place;
  };
  const normal: Vector = [0, 0, 0];
  normal[axis] = sign;
  return { normal, corners: [corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1)] };
}

/** The end of a thick rod that is turned towards the eye. */
function discs(body: Body, rotation: Rotation, look: Vector): Vector[][] {
  if (body.radius < 0.03 * body.length) return [];
  return [-1, 1].filter((side) => side * dot(rotate(rotation, [1, 0, 0]), look) < 0).map((side) => Array.from({ length: 24 }, (_none, i) => {
    const turn = (i * Math.PI) / 12;
    return rotate(rotation, [(side * body.length) / 2, body.radius * Math.cos(turn), body.radius * Math.sin(turn)]);
  }));
}

function rodOutline(body: Body, rotation: Rotation, look: Vector): Vector[] {
  const along = rotate(rotation, [body.length / 2, 0, 0]);
  const side = cross(along, look);
  const size = Math.hypot(...side) || 1;
  const across = plus([0, 0, 0], side, Math.max(body.radius, THINNEST * body.length) / size);
  const back = plus([0, 0, 0], along, -1);
  return [plus(back, across, -1), plus(along, across, -1), plus(along, across), plus(back, across)];
}

function dot(a: Vector, b: Vector): number {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/** More pictures than these nobody looks at; they are as many as the page's own slider asks for. */
const MOST = 20;

export class Strip {
  private readonly rows = byId("strip-rows");

  constructor(private readonly onChoose: (model: ModelName, n: number) => void) {}

  show(motions: Motions, pairing: Pairing | null, chosen: number): void {
    const focused = (document.activeElement as HTMLElement | null)?.dataset["strip"];
    this.rows.replaceChildren(...MODELS.flatMap((model) => {
      const motion = motions[model];
      if (!motion) return [];
      const cards = motion.impacts.slice(0, MOST).map((impact) => make("li", {}, this.card(model, motion, impact, pairing)));
      const rest = motion.impacts.length - MOST;
      if (rest > 0) cards.push(make("li", { class: "rest" }, `and ${rest} more in the table`));
      return [make("li", {}, make("p", { class: "name" }, make("span", { class: `swatch ${model}` }), `${model} model`),
        make("ol", { class: "cards" }, ...cards))];
    }));
    this.choose(chosen);
    if (focused) this.rows.querySelector<HTMLElement>(`[data-strip="${focused}"]`)?.focus();
  }

  choose(chosen: number): void {
    press(this.rows.querySelectorAll("button[data-strip]"), ({ dataset }) => dataset["strip"] === `discrete-${chosen}`);
  }

  private card(model: ModelName, motion: Motion, impact: Impact, pairing: Pairing | null): HTMLElement {
    const { n } = impact;
    const rotation = model === "discrete" ? touchRotation(impact) : motion.pose(impact.start).rotation;
    const isUnknown = impact.predictable === false;
    const isAlone = pairing !== null && n > pairing.count;
    const where = impact.corners ? cornersInWords(impact.corners) : `end ${impact.end}`;
    const force = isUnknown ? "unpredictable" : `${significant(impact.impulse_normal, 3)} N·s`;
    const alone = isAlone ? ", not the same blow in both models" : "";
    const button = make("button", {
      type: "button", "data-strip": `${model}-${n}`, class: [isUnknown ? "unpredictable" : "", isAlone ? "alone" : ""].join(" ").trim(),
    }, make("b", {}, `${n}${isUnknown ? "?" : ""}`), make("span", {}, force),
    make("span", { class: "spoken" }, ` impact of the ${model} model, ${where}${alone}`));
    button.append(sketch(model, motion, rotation, impact.impulse));
    button.addEventListener("click", () => this.onChoose(model, n));
    return button;
  }
}
