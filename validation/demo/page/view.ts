// SPDX-License-Identifier: GPL-3.0-or-later
// The picture in space, drawn by the graphics card.
import {
  AmbientLight, BufferGeometry, Color, ConeGeometry, CylinderGeometry, DirectionalLight, DoubleSide, Float32BufferAttribute, Group,
  LineBasicMaterial, LineSegments, Material, Mesh, MeshBasicMaterial, PerspectiveCamera, Quaternion, Scene, Vector3, WebGLRenderer,
  type Object3D,
} from "three";
import { extentOf, middleOf, type Body } from "./body";
import { COLOURS } from "./colours";
import { MODELS, type Arc, type Arrow, type Bounds, type Frame, type ModelName, type Projection, type View } from "./frame";
import type { Pose } from "./motion";
import { STRAIGHT, type Orbit } from "./orbit";
import type { Vector } from "./rotation";
import { figureOf, geometryOf, silhouetteOf } from "./shapes";

const FIELD_OF_VIEW = 24; // degrees, upright
const PALE = 0.35; // a model past its end
/** Of the camera over the ground, and around the picture [rad]: straight from the side, in space from where three faces of a box are seen. */
const PLANE = { elevation: 0, azimuth: 0 };
const SPACE = { elevation: 0.34, azimuth: -0.3 };

/** Made once: a new one for each body would be compiled anew. */
const SHADOW = new MeshBasicMaterial({ color: 0x1b2430, transparent: true, opacity: 0.13, depthWrite: false, side: DoubleSide });
const GRID = new LineBasicMaterial({ vertexColors: true, toneMapped: false });

/** The body of a model, and its shadow of light from straight above: flattened on the ground. */
class Figure {
  readonly group = new Group();
  readonly shadow = new Group();
  private of = "";

  constructor(private readonly model: ModelName) {
    this.shadow.scale.set(1, 1, 1e-4);
  }

  put({ body, pose, isOver = false }: Frame["figures"][number]): void {
    if (this.of !== JSON.stringify(body)) this.rebuild(body);
    this.group.traverse((part) => {
      if (part instanceof Mesh) Object.assign(part.material as Material, { transparent: isOver || this.model === "continuous", opacity: isOver ? PALE : 1 });
    });
    for (const part of [this.group, ...this.shadow.children]) putAt(part, body, pose);
  }

  private rebuild(body: Body): void {
    this.of = JSON.stringify(body);
    for (const group of [this.group, this.shadow]) {
      group.traverse((part) => { if (part instanceof Mesh) part.geometry.dispose(); });
      group.clear();
    }
    this.group.add(figureOf(body, this.model));
    this.shadow.add(new Mesh(geometryOf(body), SHADOW));
  }
}

export class SpaceView implements View {
  private readonly renderer: WebGLRenderer;
  private readonly scene = new Scene();
  private readonly camera = new PerspectiveCamera(FIELD_OF_VIEW, 1, 0.01, 100);
  private readonly layers: Record<ModelName, Group> = { discrete: new Group(), continuous: new Group() };
  private readonly figures: Record<ModelName, Figure> = { discrete: new Figure("discrete"), continuous: new Figure("continuous") };
  private readonly arrows: Record<ModelName, ArrowMesh[]> = { discrete: [], continuous: [] };
  private ground: LineSegments | null = null;
  private cell = 0;
  private size = { width: 1, height: 1 };
  private frame: Frame | null = null;
  private orbit: Orbit = STRAIGHT;
  private readonly ghosts: Record<ModelName, LineSegments<BufferGeometry, LineBasicMaterial>[]> = { discrete: [], continuous: [] };
  private readonly arc = new LineSegments(new BufferGeometry(), new LineBasicMaterial({ color: COLOURS.ink, depthTest: false, transparent: true }));
  private readonly patch = new Mesh(new BufferGeometry(), new MeshBasicMaterial({ color: COLOURS.continuous, depthTest: false, transparent: true, opacity: 0.65, side: DoubleSide }));

  constructor(canvas: HTMLCanvasElement) {
    this.renderer = new WebGLRenderer({ canvas, antialias: true, alpha: true });
    this.camera.up.set(0, 0, 1);
    const sun = new DirectionalLight(0xffffff, 2.2);
    sun.position.set(-1, -3, 4);
    this.scene.add(new AmbientLight(0xffffff, 1.6), sun);
    this.layers.discrete.add(this.arc);
    this.layers.continuous.add(this.patch);
    // What lies under the body would else be hidden by it.
    this.patch.renderOrder = 1;
    for (const model of MODELS) {
      const { group, shadow } = this.figures[model];
      this.layers[model].add(group, shadow);
      this.scene.add(this.layers[model]);
    }
  }

  resize(width: number, height: number): void {
    this.size = { width, height };
    this.renderer.setPixelRatio(Math.min(2, devicePixelRatio));
    this.renderer.setSize(width, height, false);
  }

  draw(frame: Frame, orbit: Orbit): void {
    this.frame = frame;
    this.orbit = orbit;
    this.drawArc(frame.arcs[0]);
    this.drawPatch(frame.patch?.outline ?? []);
    const body = frame.figures[0]?.body;
    this.makeGround(body ? extentOf(body) : 1);
    for (const model of MODELS) {
      const figure = frame.figures.find((f) => f.model === model);
      this.layers[model].visible = figure !== undefined;
      if (figure) this.figures[model].put(figure);
      this.placeGhosts(model, frame.ghosts.filter((ghost) => ghost.model === model));
      this.placeArrows(model, frame.arrows.filter((arrow) => arrow.model === model));
    }
    this.renderer.setScissorTest(frame.side);
    for (const part of this.parts(frame.side)) {
      const { left, bottom, width, height } = part;
      this.renderer.setViewport(left, bottom, width, height);
      this.renderer.setScissor(left, bottom, width, height);
      this.aim(part.model, width / height);
      this.moveGround(frame.bounds[part.model ?? "discrete"]);
      if (part.model) for (const { model } of frame.figures) this.layers[model].visible = model === part.model;
      this.renderer.render(this.scene, this.camera);
    }
  }

  project(model: ModelName, [x, y, z]: Vector, side: boolean): Projection {
    const part = this.parts(side).find((p) => p.model === null || p.model === model);
    const { left, bottom, width, height } = part ?? { left: 0, bottom: 0, ...this.size };
    this.aim(side ? model : null, width / height);
    const point = new Vector3(x, y, z).project(this.camera);
    return { x: left + ((point.x + 1) / 2) * width, y: this.size.height - bottom - ((point.y + 1) / 2) * height };
  }

  /** Side by side on a wide picture, one above the other on a narrow one. */
  private parts(side: boolean): { model: ModelName | null; left: number; bottom: number; width: number; height: number }[] {
    const { width, height } = this.size;
    if (!side) return [{ model: null, left: 0, bottom: 0, width, height }];
    if (width >= 600) {
      return MODELS.map((model, i) => ({ model, left: (i * width) / 2, bottom: 0, width: width / 2, height }));
    }
    return MODELS.map((model, i) => ({ model, left: 0, bottom: ((1 - i) * height) / 2, width, height: height / 2 }));
  }

  private aim(model: ModelName | null, aspect: number): void {
    if (!this.frame) return;
    const { left, right, top, depth, deep } = this.frame.bounds[model ?? "discrete"];
    const own = this.frame.inSpace ? SPACE : PLANE;
    const [elevation, azimuth] = [own.elevation + this.orbit.elevation, own.azimuth + this.orbit.azimuth];
    const margin = 1.16;
    const half = Math.tan((FIELD_OF_VIEW * Math.PI) / 360);
    const tall = (top * margin) / 2;
    const wide = ((right - left) * margin) / 2;
    const distance = (Math.max(tall / half, wide / (half * aspect)) + 0.15 * wide + deep) / this.orbit.zoom;
    // Where width decides, the ground stays low in the picture instead of floating in its middle.
    const height = Math.max(top * 0.47, 0.58 * distance * half) - deep * Math.sin(own.elevation);
    const centre = new Vector3((left + right) / 2, depth, height);
    const flat = Math.cos(elevation) * distance;
    this.camera.position.set(
      centre.x + Math.sin(azimuth) * flat, centre.y - Math.cos(azimuth) * flat, centre.z + Math.sin(elevation) * distance,
    );
    this.camera.aspect = aspect;
    this.camera.near = distance / 50;
    this.camera.far = distance * 10;
    this.camera.lookAt(centre);
    this.camera.updateProjectionMatrix();
    this.camera.updateMatrixWorld();
  }

  private makeGround(length: number): void {
    if (this.cell === length / 10) return;
    this.cell = length / 10;
    // The graphics card keeps what nobody gives back.
    this.ground?.geometry.dispose();
    this.ground?.removeFromParent();
    this.ground = groundGrid(this.cell);
    this.scene.add(this.ground);
  }

  /** A body that drifts stays on the grid, which moves along by whole cells. */
  private moveGround({ left, right, depth }: Bounds): void {
    const { cell } = this;
    this.ground?.position.set(Math.round((left + right) / 2 / cell) * cell, Math.round(depth / cell) * cell, 0);
  }

  /** Silhouettes at the blows. */
  private placeGhosts(model: ModelName, wanted: Frame["ghosts"]): void {
    const lines = this.ghosts[model];
    while (lines.length < wanted.length) {
      const line = new LineSegments(new BufferGeometry(), new LineBasicMaterial({ transparent: true, depthWrite: false }));
      lines.push(line);
      this.layers[model].add(line);
    }
    lines.forEach((line, i) => {
      const ghost = wanted[i];
      line.visible = ghost !== undefined;
      if (!ghost) return;
      line.material.color.set(ghost.tone === "aside" ? COLOURS.quiet : COLOURS[model]);
      line.material.opacity = ghost.tone === "fan" ? 0.3 : ghost.tone ? 0.22 : 0.45;
      if (line.userData["of"] !== ghost.body) {
        line.userData["of"] = ghost.body;
        line.geometry.dispose();
        line.geometry = silhouetteOf(ghost.body);
      }
      putAt(line, ghost.body, ghost.pose);
    });
  }

  private drawArc(arc: Arc | undefined): void {
    this.arc.visible = arc !== undefined;
    if (!arc) return;
    const parts = 24;
    const point = (i: number): number[] => {
      const along = arc.radius * Math.cos((arc.angle * i) / parts);
      return [arc.at[0] + (arc.toRight ? along : -along), arc.at[1], arc.radius * Math.sin((arc.angle * i) / parts)];
    };
    const lines = Array.from({ length: parts }, (_, i) => [...point(i), ...point(i + 1)]).flat();
    // The ground's side of the angle, and the body's.
    const legs = [0, parts].flatMap((i) => [...arc.at, ...point(i).map((x, k) => (arc.at[k] ?? 0) + 1.3 * (x - (arc.at[k] ?? 0)))]);
    this.arc.geometry.dispose();
    this.arc.geometry = new BufferGeometry().setAttribute("position", new Float32BufferAttribute([...lines, ...legs], 3));
  }

  private drawPatch(outline: Vector[]): void {
    const corners = outline.slice(2).flatMap((point, i) => [...(outline[0] ?? []), ...(outline[i + 1] ?? []), ...point]);
    this.patch.geometry.dispose();
    this.patch.geometry = new BufferGeometry().setAttribute("position", new Float32BufferAttribute(corners, 3));
  }

  private placeArrows(model: ModelName, wanted: Arrow[]): void {
    const meshes = this.arrows[model];
    while (meshes.length < wanted.length) {
      const mesh = new ArrowMesh();
      meshes.push(mesh);
      this.layers[model].add(mesh.group);
    }
    meshes.forEach((mesh, i) => mesh.set(wanted[i], this.cell * 0.06));
  }
}

function putAt(part: Object3D, body: Body, { centre, rotation }: Pose): void {
  const [w, x, y, z] = rotation;
  part.position.set(...middleOf(body, centre, rotation));
  part.quaternion.set(x, y, z, w);
}

function groundGrid(cell: number): LineSegments {
  const points: number[] = [];
  const colours: number[] = [];
  const [near, far] = [new Color(COLOURS.floor), new Color(COLOURS.paper)];
  const fade = (x: number, y: number): number[] =>
    near.clone().lerp(far, Math.min(1, Math.hypot(x / (22 * cell), (y - 4 * cell) / (16 * cell)))).toArray();
  const line = (x: number, y: number, p: number, q: number): void => {
    points.push(x, y, 0, p, q, 0);
    colours.push(...fade(x, y), ...fade(p, q));
  };
  for (let i = -22; i < 22; i++) {
    for (let j = -12; j <= 20; j++) {
      line(i * cell, j * cell, (i + 1) * cell, j * cell);
      if (j < 20) line(i * cell, j * cell, i * cell, (j + 1) * cell);
    }
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new Float32BufferAttribute(points, 3));
  geometry.setAttribute("color", new Float32BufferAttribute(colours, 3));
  return new LineSegments(geometry, GRID);
}

class ArrowMesh {
  readonly group = new Group();
  private readonly material = new MeshBasicMaterial({ depthTest: false, transparent: true });
  private readonly shaft = new Mesh(new CylinderGeometry(1, 1, 1, 12).translate(0, 0.5, 0), this.material);
  private readonly head = new Mesh(new ConeGeometry(1, 1, 16).translate(0, -0.5, 0), this.material);

  constructor() {
    this.group.add(this.shaft, this.head);
    // A blow under a broad body would else be hidden by it.
    this.shaft.renderOrder = this.head.renderOrder = 1;
  }

  set(arrow: Arrow | undefined, thickness: number): void {
    const [x, y, z] = arrow?.vector ?? [0, 0, 0];
    const length = Math.hypot(x, y, z);
    this.group.visible = arrow !== undefined && length > 2 * thickness;
    if (!arrow || !this.group.visible) return;
    const radius = arrow.kind === "blow" ? thickness : 0.55 * thickness;
    const head = Math.min(5 * radius, 0.6 * length);
    this.material.opacity = arrow.isPast ? 0.4 : 1;
    this.material.color.set(arrow.kind === "speed" ? COLOURS.speed : COLOURS.blow[arrow.model]);
    this.group.position.set(...arrow.from);
    const direction = new Vector3(x, y, z).divideScalar(length);
    this.group.quaternion.copy(new Quaternion().setFromUnitVectors(new Vector3(0, 1, 0), direction));
    this.shaft.scale.set(radius, length - head, radius);
    this.head.scale.set(2.6 * radius, head, 2.6 * radius);
    this.head.position.set(0, length, 0);
  }
}
