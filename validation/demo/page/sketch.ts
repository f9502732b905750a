// SPDX-License-Identifier: GPL-3.0-or-later
// A small picture of a body at a touch, drawn in lines: parallel projection, seen from the right, the front and above.
import { middleOf, type Body } from "./body";
import type { ModelName } from "./frame";
import { facesOf } from "./outline";
import { plus, type Rotation, type Vector } from "./rotation";

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

export interface Touch {
  model: ModelName;
  body: Body;
  rotation: Rotation;
  /** From the centre of mass to the point that strikes, world. */
  struck: Vector;
  /** World [N s]; `strongest` is the size of the largest one of the run. */
  impulse: Vector;
  strongest: number;
}

/** On the paper, to the right and up, of a place from the point that strikes [m]. */
export function onPaper([x, y, z]: Vector): [number, number] {
  const [c, s] = [Math.cos(AZIMUTH), Math.sin(AZIMUTH)];
  return [x * c + y * s, (-x * s + y * c) * Math.sin(ELEVATION) + z * Math.cos(ELEVATION)];
}

export function sketch(touch: Touch): SVGSVGElement {
  const { body, rotation, struck, model } = touch;
  const scale = SPAN / Math.hypot(body.length, body.width, body.thickness, 2 * body.radius);
  const middle = middleOf(body, plus([0, 0, 0], struck, -1), rotation);
  const shift = onPaper(middle)[0] * scale;
  const at = (place: Vector): string => {
    const [x, y] = onPaper(place);
    return `${(WIDTH / 2 - shift + x * scale).toFixed(1)},${(FLOOR - y * scale).toFixed(1)}`;
  };
  const picture = svg("svg", { viewBox: `0 0 ${WIDTH} ${HEIGHT}`, class: `sketch ${model}`, "aria-hidden": "true" });
  picture.append(svg("path", { class: "floor", d: floorPath(scale, at) }));
  for (const face of facesOf(body, rotation, LOOK)) {
    const corners = face.map((corner) => at(plus(middle, corner)));
    picture.append(svg("polygon", { points: corners.join(" "), style: `--shade:${shadeOf(face)}` }));
  }
  picture.append(blow(touch, at, scale));
  return picture;
}

/** A piece of the ground below the body, as crossed lines. */
function floorPath(scale: number, at: (place: Vector) => string): string {
  const half = (0.62 * SPAN) / scale;
  const lines = [-1, -0.5, 0, 0.5, 1].flatMap((part) => [
    `M${at([-half, part * half, 0])}L${at([half, part * half, 0])}`, `M${at([part * half, -half, 0])}L${at([part * half, half, 0])}`]);
  return lines.join("");
}

/** Of light from above: faces that look up are lighter. */
function shadeOf(face: readonly Vector[]): string {
  const heights = face.map(([, , z]) => z);
  const tilt = (heights.reduce((sum, z) => sum + z, 0) / face.length) / (Math.max(...heights.map(Math.abs)) || 1);
  return (0.55 + 0.4 * tilt).toFixed(2);
}

function blow({ impulse, strongest, model }: Touch, at: (place: Vector) => string, scale: number): SVGElement {
  const length = strongest > 0 ? (0.42 * SPAN) / scale / strongest : 0;
  const tip = plus([0, 0, 0], impulse, length);
  return svg("path", { d: `M${at([0, 0, 0])}L${at(tip)}`, class: "blow", "marker-end": `url(#tip-${model})` });
}

export function svg<Tag extends keyof SVGElementTagNameMap>(tag: Tag, attributes: Record<string, string | number>): SVGElementTagNameMap[Tag] {
  const element = document.createElementNS("http://www.w3.org/2000/svg", tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, String(value));
  return element;
}

