// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies as the graphics card draws them: solid with what makes them a phone, a coin, a tube or a die, and as lines. The round corners
// of a phone are drawn alone: both models strike with those of the box.
import {
  BoxGeometry, BufferGeometry, Color, CylinderGeometry, EdgesGeometry, Float32BufferAttribute, Group, Mesh, MeshLambertMaterial,
} from "three";
import { LineMaterial } from "three/addons/lines/LineMaterial.js";
import { LineSegments2 } from "three/addons/lines/LineSegments2.js";
import { LineSegmentsGeometry } from "three/addons/lines/LineSegmentsGeometry.js";
import { THINNEST, type Body, type Look } from "./body";
import { COLOURS } from "./colours";
import type { ModelName } from "./frame";

const THICK = 0.03; // radius of a rod that is drawn as round, over its length
const ROUNDED = 0.12; // radius of a phone's corners, over its width
const ABOVE = 1.004; // what is printed on a face stands so far out

/** The body of a model: solid, or in lines that the other one's solid body never hides. */
export function figureOf(body: Body, model: ModelName): Group {
  const group = new Group();
  if (model === "discrete") {
    group.add(solid(geometryOf(body), COLOURS.discrete), ...(body.look ? MARKS[body.look](body) : []));
  } else {
    const material = new LineMaterial({ color: new Color(COLOURS.continuous).getHex(), linewidth: 2, depthTest: false, transparent: true });
    group.add(new LineSegments2(outlineOf(body), material));
  }
  return group;
}

const solid = (geometry: BufferGeometry, colour: string): Mesh => new Mesh(geometry, new MeshLambertMaterial({ color: colour }));

export function geometryOf(body: Body): BufferGeometry {
  const { length, width, thickness } = body;
  if (body.look === "phone") return slab(length, width, ROUNDED * width, -thickness / 2, thickness / 2);
  if (body.shape === "box") return new BoxGeometry(length, width, thickness);
  return cylinder(Math.max(body.radius, THINNEST * length), length);
}

const cylinder = (radius: number, length: number): BufferGeometry => new CylinderGeometry(radius, radius, length, 48).rotateZ(Math.PI / 2);

/** A plate with round corners between two heights. */
function slab(length: number, width: number, radius: number, low: number, high: number): BufferGeometry {
  const parts = 8;
  const rim = [[1, 1], [-1, 1], [-1, -1], [1, -1]].flatMap(([x = 1, y = 1], corner) => Array.from({ length: parts + 1 }, (_none, i) => {
    const turn = ((corner + i / parts) * Math.PI) / 2;
    return [x * (length / 2 - radius) + radius * Math.cos(turn), y * (width / 2 - radius) + radius * Math.sin(turn)] as const;
  }));
  const corners: number[] = [];
  rim.forEach(([x, y], i) => {
    const [p, q] = rim[(i + 1) % rim.length] ?? [0, 0];
    corners.push(0, 0, high, x, y, high, p, q, high, 0, 0, low, p, q, low, x, y, low);
    corners.push(x, y, low, p, q, low, p, q, high, x, y, low, p, q, high, x, y, high);
  });
  const geometry = new BufferGeometry().setAttribute("position", new Float32BufferAttribute(corners, 3));
  geometry.computeVertexNormals();
  return geometry;
}

const MARKS: Readonly<Record<Look, (body: Body) => Mesh[]>> = {
  phone: ({ length, width, thickness }) => [
    solid(slab(0.9 * length, 0.88 * width, 0.08 * width, thickness / 2, (ABOVE * thickness) / 2), "#10202e"),
    solid(slab(0.16 * width, 0.4 * width, 0.07 * width, -(ABOVE * thickness) / 2, -thickness / 2).translate(0.4 * length, 0, 0), "#10202e"),
  ],
  coin: ({ length, radius }) => [solid(cylinder(0.8 * radius, (1 + 8 * (ABOVE - 1)) * length), "#4da3d8")],
  tube: ({ length, radius }) => [-1, 1].map((side) => solid(cylinder(1.03 * radius, 0.06 * length).translate(side * 0.471 * length, 0, 0), "#0a3d62")),
  die: pips,
};

/** One to six; opposite faces make seven. */
function pips({ length }: Body): Mesh[] {
  const patterns = [[[0, 0]], [[-1, -1], [1, 1]], [[-1, -1], [0, 0], [1, 1]], [[-1, -1], [-1, 1], [1, -1], [1, 1]],
    [[-1, -1], [-1, 1], [1, -1], [1, 1], [0, 0]], [[-1, -1], [-1, 0], [-1, 1], [1, -1], [1, 0], [1, 1]]];
  const faces = [[1, 0, 0], [0, 1, 0], [0, 0, 1], [0, 0, -1], [0, -1, 0], [-1, 0, 0]];
  return faces.flatMap(([x = 0, y = 0, z = 0], face) => (patterns[face] ?? []).map(([u = 0, v = 0]) => {
    const flat = cylinder(0.09 * length, length * (ABOVE - 1)).translate((length * ABOVE) / 2, 0.25 * u * length, 0.25 * v * length);
    if (x < 0) flat.rotateZ(Math.PI);
    return solid(y !== 0 ? flat.rotateZ((y * Math.PI) / 2) : z !== 0 ? flat.rotateY((-z * Math.PI) / 2) : flat, "#ffffff");
  }));
}

/** Edges of a box; of a thick rod its ends and four lines along it, of a thin one its outline as seen from the side. */
function outlineOf(body: Body): LineSegmentsGeometry {
  const outline = new LineSegmentsGeometry();
  if (body.shape === "box") return outline.fromEdgesGeometry(edges(body));
  const half = body.length / 2;
  if (body.radius > THICK * body.length) return outline.setPositions(cage(half, body.radius));
  const radius = Math.max(body.radius, 1.4 * THINNEST * body.length);
  const corners = [[-half, 0, -radius], [half, 0, -radius], [half, 0, radius], [-half, 0, radius]];
  return outline.setPositions(corners.flatMap((corner, i) => [...corner, ...(corners[(i + 1) % 4] ?? [])]));
}

const edges = ({ length, width, thickness }: Body): EdgesGeometry => new EdgesGeometry(new BoxGeometry(length, width, thickness), 1);

function cage(half: number, radius: number): number[] {
  const parts = 24;
  const at = (x: number, i: number): number[] =>
    [x, radius * Math.cos((2 * Math.PI * i) / parts), radius * Math.sin((2 * Math.PI * i) / parts)];
  const all = Array.from({ length: parts }, (_, i) => i);
  const circles = all.flatMap((i) => [-half, half].flatMap((x) => [...at(x, i), ...at(x, i + 1)]));
  return [...circles, ...all.filter((i) => i % (parts / 4) === 0).flatMap((i) => [...at(-half, i), ...at(half, i)])];
}

/** Of a box its edges; of a rod, which has none along itself, its outline. */
export function silhouetteOf(body: Body): BufferGeometry {
  if (body.shape === "box") return edges(body);
  const radius = Math.max(body.radius, THINNEST * body.length);
  return new BufferGeometry().setAttribute("position", new Float32BufferAttribute(cage(body.length / 2, radius), 3));
}
