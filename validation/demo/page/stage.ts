// SPDX-License-Identifier: GPL-3.0-or-later
// The picture and the labels over it.
import { byId, make } from "./dom";
import { FlatView } from "./flat_view";
import type { Frame, Projection, View } from "./frame";
import { STRAIGHT, type Orbit } from "./orbit";
import type { Vector } from "./rotation";
import { SpaceView } from "./view";

export class Stage {
  private readonly box = byId("stage");
  private readonly labels = byId("stage-labels");
  private readonly view: View;
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
    const { width, height } = this.box.getBoundingClientRect();
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
    this.view.resize(width, height);
    if (this.frame) this.draw(this.frame);
  }
}
