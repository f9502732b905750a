// SPDX-License-Identifier: GPL-3.0-or-later
// The picture and the labels over it.
import { middleOf, type Body } from "./body";
import { COLOURS } from "./colours";
import { byId, make } from "./dom";
import type { Arrow, Frame, ModelName, Projection, View } from "./frame";
import type { Pose } from "./motion";
import { STRAIGHT, type Orbit } from "./orbit";
import { plus, type Vector } from "./rotation";
import { facesOf } from "./sketch";
import { SpaceView } from "./view";

export class Stage {
  private readonly box = byId("stage");
  private readonly labels = byId("stage-labels");
  private readonly view: View;
  /** As it was drawn last: to ask for it while drawing would lay out the page anew. */
  private size = { width: 1, height: 1 };
  private frame: Frame | null = null;
  private orbit: Orbit = STRAIGHT;

  constructor() {
    this.view = this.createView();
    new ResizeObserver(() => this.resize()).observe(this.box);
    this.resize();
  }

  /** Of the picture that is shown, in its first part. */
  project(place: Vector): Projection {
    return this.view.project("discrete", place, this.frame?.side ?? false);
  }

  get shown(): Frame | null {
    return this.frame;
  }

  redraw(): void {
    if (this.frame) this.view.draw(this.frame, this.orbit);
  }

  draw(frame: Frame, orbit: Orbit = this.orbit): void {
    this.frame = frame;
    this.orbit = orbit;
    this.view.draw(frame, orbit);
    // For whoever asks what the canvas shows.
    this.box.dataset["arrows"] = [...new Set(frame.arrows.map(({ kind, isPast }) => (isPast ? "past" : kind)))].sort().join(", ");
    const { width, height } = this.size;
    frame.labels.forEach((label, i) => {
      const { x, y } = this.view.project(label.model, label.place, frame.side);
      const element = (this.labels.children[i] ?? this.labels.appendChild(make("span"))) as HTMLElement;
      element.className = `stage-label ${label.kind} ${label.model} ${label.aside ?? ""}`;
      if (element.textContent !== label.text) element.textContent = label.text;
      const margin = label.kind === "blow" ? 44 : 12;
      const lowest = height - (label.aside === "below" ? 42 : 0);
      const [left, top] = [Math.min(width - margin, Math.max(margin, x)), Math.max(14, Math.min(lowest, y))];
      element.style.transform = `translate(${left.toFixed(1)}px, ${top.toFixed(1)}px)`;
    });
    while (this.labels.children.length > frame.labels.length) this.labels.lastElementChild?.remove();
  }

  private createView(): View {
    const canvas = make("canvas", { "aria-hidden": "true" });
    this.box.prepend(canvas);
    // A canvas that was asked for one kind of context gives no other: another one is asked first.
    const inSpace = document.createElement("canvas").getContext("webgl2") !== null;
    this.box.dataset["view"] = inSpace ? "space" : "flat";
    return inSpace ? new SpaceView(canvas) : new FlatView(canvas);
  }

  private resize(): void {
    const { width, height } = this.box.getBoundingClientRect();
    if (width === 0 || height === 0) return;
    this.size = { width, height };
    this.view.resize(width, height);
    if (this.frame) this.draw(this.frame);
  }
}

/** Of the eye. */
const LOOK: Vector = [0, 1, 0];
const NOTHING = { left: -0.5, right: 0.5, top: 0.5 };

class FlatView implements View {
  private readonly context: CanvasRenderingContext2D;
  private size = { width: 1, height: 1 };
  private frame: Frame | null = null;

  constructor(private readonly canvas: HTMLCanvasElement) {
    const context = canvas.getContext("2d");
    if (!context) throw new Error("the browser can draw neither in space nor in the plane");
    this.context = context;
  }

  resize(width: number, height: number): void {
    this.size = { width, height };
    const ratio = Math.min(2, devicePixelRatio);
    this.canvas.width = Math.round(width * ratio);
    this.canvas.height = Math.round(height * ratio);
    this.context.setTransform(ratio, 0, 0, ratio, 0, 0);
  }

  draw(frame: Frame): void {
    const { context } = this;
    this.frame = frame;
    context.clearRect(0, 0, this.size.width, this.size.height);
    const { y } = this.project("discrete", [0, 0, 0], false);
    this.bar(COLOURS.grid, 8, this.size.width - 8, y, 6);
    this.bar(COLOURS.quiet, 8, this.size.width - 8, y, 1);
    for (const { model, body, pose, tone } of frame.ghosts) this.figure(model, body, pose, frame.side, tone ?? "blow");
    for (const { model, body, pose, isOver } of frame.figures) this.figure(model, body, pose, frame.side, isOver ? "over" : null);
    // From the side, a line on the ground.
    const places = frame.patch?.outline.map((point) => this.project("continuous", point, frame.side).x) ?? [];
    if (places.length) this.bar(COLOURS.continuous, Math.min(...places), Math.max(...places), y, 5);
    for (const arrow of frame.arrows) this.arrow(arrow, frame.side);
  }

  project(model: ModelName, [x, , z]: Vector, side: boolean): Projection {
    const { left, right, top } = this.frame?.bounds[model] ?? NOTHING;
    const width = side ? this.size.width / 2 : this.size.width;
    const scale = Math.min((0.86 * width) / (right - left), (0.72 * this.size.height) / top);
    const offset = side && model === "continuous" ? width : 0;
    return { x: offset + width / 2 + (x - (left + right) / 2) * scale, y: this.size.height * 0.86 - z * scale };
  }

  private bar(colour: string, left: number, right: number, top: number, height: number): void {
    this.context.fillStyle = colour;
    this.context.fillRect(left, top, right - left, height);
  }

  private figure(model: ModelName, body: Body, pose: Pose, side: boolean, ghost: "blow" | "fan" | "aside" | "over" | null = null): void {
    const { context } = this;
    const middle = middleOf(body, pose.centre, pose.rotation);
    for (const face of facesOf(body, pose.rotation, LOOK)) {
      context.beginPath();
      for (const point of face) {
        const { x, y } = this.project(model, plus(middle, point), side);
        context.lineTo(x, y);
      }
      context.closePath();
      context.lineWidth = model === "discrete" ? 1 : 2;
      context.fillStyle = COLOURS.discrete;
      context.strokeStyle = ghost === "aside" ? COLOURS.quiet : model === "discrete" ? COLOURS.blow.discrete : COLOURS.continuous;
      context.globalAlpha = ghost ? 0.35 : 1;
      if (model === "discrete" && !ghost) context.fill();
      context.stroke();
      context.globalAlpha = 1;
    }
  }

  private arrow({ model, kind, from, vector, isPast }: Arrow, side: boolean): void {
    const start = this.project(model, from, side);
    const tip = this.project(model, [from[0] + vector[0], 0, from[2] + vector[2]], side);
    const length = Math.hypot(tip.x - start.x, tip.y - start.y);
    if (length < 6) return;
    const { context } = this;
    const head = Math.min(10, 0.6 * length);
    const angle = Math.atan2(tip.y - start.y, tip.x - start.x);
    context.strokeStyle = context.fillStyle = kind === "speed" ? COLOURS.speed : COLOURS.blow[model];
    context.lineWidth = kind === "blow" ? 4 : 2;
    context.globalAlpha = isPast ? 0.4 : 1;
    context.beginPath();
    context.moveTo(start.x, start.y);
    context.lineTo(tip.x - head * Math.cos(angle), tip.y - head * Math.sin(angle));
    context.stroke();
    context.beginPath();
    context.moveTo(tip.x, tip.y);
    for (const turn of [-0.4, 0.4]) context.lineTo(tip.x - head * 1.1 * Math.cos(angle + turn), tip.y - head * 1.1 * Math.sin(angle + turn));
    context.fill();
    context.globalAlpha = 1;
  }
}
