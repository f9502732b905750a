// SPDX-License-Identifier: GPL-3.0-or-later
// Sliders, number fields and choices of the situation.
import type { ApiError } from "./api";
import { BODIES, seenAngle, type BodyName } from "./body";
import { byId, make } from "./dom";
import {
  attitudeOf, orientationName, DROPS, QUANTITIES, bodyOf, isInPlane, isUsed, setBody, dampingOf, firstSpeed,
  restitutionOf, SCENES, type Choices, type Parameters, type Quantity,
} from "./parameters";
import { SPECS, blamedQuantity, fieldText, fromSlider, sliderRange, toSlider } from "./quantities";
import { normalised, product, turnAbout, type Rotation } from "./rotation";
import { assignUnlocked, type State } from "./state";

interface Row {
  box: HTMLElement;
  /** None for a part of a vector. */
  slider: HTMLInputElement | null;
  field: HTMLInputElement;
  error: HTMLElement;
  /** Why it cannot be changed. */
  reason: HTMLElement;
}

/** What everybody sees; the rest stands under "More". */
const BASICS: Quantity[] = ["angle", "e", "gravity"];
/** Where each quantity stands; the sizes show only for a body of one's own. */
const GROUPS: readonly { title: string; quantities: Quantity[] }[] = [
  { title: "Drop", quantities: ["tilt", "orientation", "q0", "speed", "height", "vx", "wx"] },
  { title: "Body", quantities: ["mass", "length", "radius", "width", "thickness"] },
  { title: "Contact", quantities: ["friction", "stiffness", "damping"] },
  { title: "Run", quantities: ["impacts"] },
];

/** Parts of vectors share a line, which stands where the first of them does. */
const VECTORS: Readonly<Partial<Record<Quantity, { title: string; parts: readonly Quantity[] }>>> = {
  q0: { title: "Euler parameters, body to world", parts: ["q0", "q1", "q2", "q3"] },
  vx: { title: "Velocity x, y, z", parts: ["vx", "vy", "vz"] },
  wx: { title: "Spin about x, y, z", parts: ["wx", "wy", "wz"] },
};
const DROP_NAMES = { speed: "at a speed", height: "from a height", velocity: "at a velocity" } as const;

/** A quantity's value, or that which follows from another's. */
function shownValue(parameters: Parameters, quantity: Quantity): number {
  if (quantity === "damping") return dampingOf(parameters);
  if (quantity === "angle") return seenAngle(bodyOf(parameters), parameters.angle);
  return quantity === "e" ? restitutionOf(parameters) : parameters[quantity];
}

export class Controls {
  private readonly rows = new Map<Quantity, Row>();
  private readonly scene = byId<HTMLSelectElement>("scene");
  private readonly body = make("select", { id: "body" });
  private readonly drop = make("select", { id: "drop" });
  private readonly follow = make("input", { type: "checkbox", id: "follow" });
  private readonly ofGround = make("input", { type: "checkbox", id: "ofGround" });
  private readonly planar = make("input", { type: "checkbox", id: "planar" });
  private readonly spinning = make("input", { type: "checkbox", id: "spinning" });
  private readonly attitude: AttitudeControls;
  private readonly errors = new Map<string, ApiError>();

  constructor(
    private readonly state: State, private readonly onChange: () => void, private readonly onRelease: () => void,
  ) {
    this.attitude = new AttitudeControls(state, () => this.change(), onRelease);
    this.buildScenes();
    byId("extra-forget").addEventListener("click", () => {
      state.parameters.extra = {};
      this.change();
    });
    byId("basics").append(this.buildGroup("Drop it", BASICS));
    for (const group of GROUPS) byId("quantities").append(this.buildGroup(group.title, group.quantities));
    this.refresh();
  }

  /** Shows the state: after a link, a scene or a click on the map changed it. */
  refresh(): void {
    const { parameters, lock } = this.state;
    for (const [quantity, row] of this.rows) {
      const shown = shownValue(parameters, quantity);
      if (row.slider) {
        row.slider.value = String(toSlider(SPECS[quantity], shown));
        row.slider.setAttribute("aria-valuetext", `${fieldText(shown)} ${SPECS[quantity].unit}`.trim());
      }
      if (document.activeElement !== row.field) row.field.value = fieldText(shown);
      row.box.hidden = !isUsed(parameters, quantity);
      const followed = quantity === "damping" ? parameters.follow : quantity === "e" && parameters.ofGround;
      const disabled = lock.includes(quantity) || followed;
      if (row.slider) row.slider.disabled = disabled;
      row.field.disabled = disabled;
      setText(row.reason, !followed ? "" : quantity === "e" ? "It follows from the ground’s damping, which the scene gives." : "It follows from the restitution.");
    }
    this.body.value = parameters.body;
    this.drop.value = parameters.drop;
    this.follow.checked = parameters.follow;
    this.ofGround.checked = parameters.ofGround;
    this.planar.checked = parameters.planar;
    if (this.planar.parentElement) this.planar.parentElement.hidden = !isInPlane(parameters);
    this.spinning.checked = parameters.spinning;
    this.attitude.refresh();
    const extra = Object.entries(parameters.extra).map(([name, text]) => `${name} = ${text}`);
    byId("extra").hidden = extra.length === 0;
    byId("extra-keys").textContent = extra.join("; ");
    if (extra.length > 0) this.openMore();
    this.scene.value = sceneOf(parameters) ?? "";
    this.scene.disabled = lock.includes("scene");
    for (const choice of [this.body, this.drop, this.follow, this.ofGround, this.planar, this.spinning]) {
      choice.disabled = lock.includes(choice.id);
    }
  }

  /** What must be read must not be folded away. */
  private openMore(): void {
    byId<HTMLDetailsElement>("more").open = true;
  }

  /** Shows what a model says is wrong next to the control that it names, else below all of them. */
  setError(model: string, error: ApiError | null): void {
    if (error) this.errors.set(model, error);
    else this.errors.delete(model);
    const general = new Set<string>();
    const blamed = new Map<Quantity, string>();
    for (const { blames, message } of this.errors.values()) {
      const quantity = blamedQuantity(blames);
      if (quantity && !this.rows.get(quantity)?.box.hidden) blamed.set(quantity, message);
      else general.add(message);
    }
    for (const [quantity, { error: line, field }] of this.rows) {
      setText(line, blamed.get(quantity) ?? "");
      field.toggleAttribute("aria-invalid", blamed.has(quantity));
      if (!blamed.has(quantity)) continue;
      field.setAttribute("aria-invalid", "true");
      if (field.closest("#more")) this.openMore();
    }
    setText(byId("error"), [...general].join("; "));
  }

  private buildScenes(): void {
    this.scene.append(make("option", { value: "" }, "Your own"), ...SCENES.map(({ name, title }) => make("option", { value: name }, title)));
    this.scene.addEventListener("change", () => {
      const scene = SCENES.find(({ name }) => name === this.scene.value);
      if (!scene) return;
      assignUnlocked(this.state, scene.parameters);
      this.change();
      this.onRelease();
    });
  }

  private buildGroup(title: string, quantities: Quantity[]): HTMLElement {
    const group = make("fieldset", {}, make("legend", {}, title));
    if (title === "Body") group.append(this.buildBody());
    for (const quantity of quantities) {
      if (quantity === "tilt") group.append(this.attitude.choice);
      if (quantity === "speed") group.append(this.attitude.turns, this.buildDrop());
      if (quantity === "wx") group.append(this.check(this.spinning, "Turns at the first touch", "spinning"));
      const vector = VECTORS[quantity];
      group.append(vector ? this.buildVector(vector.title, vector.parts) : this.buildRow(quantity));
      if (quantity === "orientation") group.append(this.attitude.orientation);
      if (quantity === "stiffness") {
        group.append(this.check(this.follow, "Damping follows e", "follow"), this.check(this.ofGround, "e follows damping", "ofGround"));
      }
    }
    if (title === "Run") group.append(this.check(this.planar, "Keep the motion in its plane", "planar"));
    return group;
  }

  private buildBody(): HTMLElement {
    this.body.append(...Object.entries(BODIES).map(([name, { title }]) => make("option", { value: name }, title)));
    this.body.addEventListener("change", () => {
      setBody(this.state.parameters, this.body.value as BodyName);
      this.change();
      this.onRelease();
    });
    return make("p", { class: "choice" }, make("label", { for: "body" }, "Shape"), this.body);
  }

  private buildDrop(): HTMLElement {
    this.drop.append(...DROPS.map((value) => make("option", { value }, DROP_NAMES[value])));
    this.drop.addEventListener("change", () => {
      const { parameters } = this.state;
      if (this.drop.value === "velocity") Object.assign(parameters, { vx: 0, vy: 0, vz: -firstSpeed(parameters) });
      parameters.drop = this.drop.value as Parameters["drop"];
      // Nothing falls from a height without gravity.
      if (parameters.drop === "height" && parameters.gravity === 0) parameters.gravity = 9.81;
      this.change();
    });
    return make("p", { class: "choice" }, make("label", { for: "drop" }, "Dropped"), this.drop);
  }

  private check(box: HTMLInputElement, text: string, key: keyof Choices & ("follow" | "ofGround" | "planar" | "spinning")): HTMLElement {
    box.addEventListener("change", () => {
      const { parameters } = this.state;
      if (key === "follow" || key === "ofGround") {
        parameters.damping = dampingOf(parameters);
        parameters.e = restitutionOf(parameters);
        parameters.follow = parameters.ofGround = false;  // each is the other's cause, or neither
      }
      parameters[key] = box.checked;
      this.change();
    });
    return make("p", { class: "check" }, box, make("label", { for: box.id }, text));
  }

  private buildRow(quantity: Quantity): HTMLElement {
    const spec = SPECS[quantity];
    const name = spec.symbol ? `${spec.label} ${spec.symbol}` : spec.label;
    const slider = make("input", { type: "range", id: `${quantity}-slider`, "aria-label": `${name}, slider`, ...sliderRange(spec) });
    const field = make("input", {
      type: "number", id: quantity, step: "any", inputmode: "decimal", "aria-describedby": `${quantity}-error ${quantity}-reason`,
    });
    const error = make("p", { class: "error", id: `${quantity}-error`, role: "alert", hidden: true });
    const label = make("label", { for: quantity }, name);
    const reason = make("p", { class: "reason", id: `${quantity}-reason`, hidden: true });
    const box = make("div", { class: "row" }, label, field, make("span", { class: "unit" }, spec.unit), slider, reason, error);
    if (spec.model) box.title = `Of the ${spec.model} model`;
    slider.addEventListener("input", () => this.set(quantity, fromSlider(spec, Number(slider.value))));
    slider.addEventListener("change", () => this.onRelease());
    this.listen(field, quantity);
    this.rows.set(quantity, { box, slider, field, error, reason });
    return box;
  }

  /** A field a part, in one line. */
  private buildVector(title: string, parts: readonly Quantity[]): HTMLElement {
    const line = make("div", { class: "vector", role: "group", "aria-label": title });
    const unit = SPECS[parts[0] ?? "vx"].unit;
    const name = make("span", { class: "name" }, title, ...(unit ? [make("span", { class: "unit" }, ` ${unit}`)] : []));
    const whole = make("div", { class: "part" }, name, line);
    parts.forEach((part, i) => {
      const field = make("input", { type: "number", id: part, step: "any", "aria-label": part, "aria-describedby": `${part}-error` });
      const error = make("p", { class: "error", id: `${part}-error`, role: "alert", hidden: true });
      const box = make("span", {}, field);
      line.append(box);
      whole.append(error);
      this.listen(field, part);
      // Parts are shown together, with their title.
      this.rows.set(part, { box: i === 0 ? whole : box, slider: null, field, error, reason: make("p") });
    });
    return whole;
  }

  private listen(field: HTMLInputElement, quantity: Quantity): void {
    field.addEventListener("input", () => {
      if (field.value !== "" && Number.isFinite(field.valueAsNumber)) this.set(quantity, field.valueAsNumber);
    });
    field.addEventListener("blur", () => this.refresh());
  }

  private set(quantity: Quantity, value: number): void {
    const { parameters } = this.state;
    parameters[quantity] = quantity === "angle" ? seenAngle(bodyOf(parameters), value) : value;
    this.change();
  }

  private change(): void {
    this.refresh();
    this.onChange();
  }
}

/** The scene that the parameters are, whatever the angle. */
function sceneOf(parameters: Parameters): string | undefined {
  if (Object.keys(parameters.extra).length) return undefined;
  const keys = ["body", "turn", "drop", "spinning", "follow", "planar", ...QUANTITIES.filter((q) => q !== "angle")] as const;
  const differs = (a: Parameters, b: Parameters): boolean =>
    keys.some((key) => a[key] !== b[key] && (key !== "damping" || !a.follow) && (!isQuantity(key) || isUsed(a, key)));
  return SCENES.find((scene) => !differs(parameters, scene.parameters))?.name;
}

function isQuantity(key: string): key is Quantity {
  return (QUANTITIES as readonly string[]).includes(key);
}

function setText(line: HTMLElement, text: string): void {
  if (line.textContent !== text) line.textContent = text;
  line.hidden = text === "";
}

const TURN_NAMES = {
  plane: "in its plane", tilted: "angle and tilt", orientation: "face, edge or corner", attitude: "any, in space",
} as const;
const STEP = 15; // of a button [°]

export class AttitudeControls {
  readonly choice: HTMLElement;
  /** Buttons that turn the body about the axes of the world. */
  readonly turns: HTMLElement;
  /** Which part of a box points down. */
  readonly orientation = make("p", { class: "hint" });
  private readonly select = make("select", { id: "turn" });

  constructor(private readonly state: State, private readonly onChange: () => void, private readonly onRelease: () => void) {
    this.select.append(...Object.entries(TURN_NAMES).map(([value, name]) => make("option", { value }, name)));
    this.select.addEventListener("change", () => this.choose(this.select.value as Parameters["turn"]));
    this.choice = make("p", { class: "choice" }, make("label", { for: "turn" }, "Attitude"), this.select);
    const buttons = ([0, 1, 2] as const).flatMap((axis) => [-1, 1].map((sign) => this.button(axis, sign)));
    this.turns = make("div", { class: "turns", role: "group", "aria-label": "Turn the body" }, ...buttons);
  }

  refresh(): void {
    const { parameters, lock } = this.state;
    const isBox = bodyOf(parameters).shape === "box";
    this.select.value = parameters.turn;
    this.select.disabled = ["turn", "angle", "tilt", "orientation"].some((name) => lock.includes(name));
    for (const option of this.select.options) option.disabled = option.value === "orientation" && !isBox;
    this.turns.hidden = parameters.turn !== "attitude";
    const locked = ["q0", "q1", "q2", "q3", "turn"].some((name) => lock.includes(name));
    for (const button of this.turns.querySelectorAll("button")) button.disabled = locked;
    this.orientation.hidden = parameters.turn !== "orientation";
    this.orientation.textContent = orientationName(parameters.orientation);
  }

  /** Euler parameters begin as what the body's attitude was. */
  private choose(turn: Parameters["turn"]): void {
    const { parameters } = this.state;
    if (turn === "attitude") this.put(attitudeOf(parameters, bodyOf(parameters)));
    parameters.turn = turn;
    this.onChange();
    this.onRelease();
  }

  private button(axis: 0 | 1 | 2, sign: number): HTMLElement {
    const name = `${"xyz".charAt(axis)} ${sign < 0 ? "−" : "+"}${STEP}°`;
    const button = make("button", { type: "button", "aria-label": `Turn about ${name}` }, name);
    button.addEventListener("click", () => {
      const { q0, q1, q2, q3 } = this.state.parameters;
      this.put(normalised(product(turnAbout(axis, (sign * STEP * Math.PI) / 180), [q0, q1, q2, q3])));
      this.onChange();
      this.onRelease();
    });
    return button;
  }

  private put([q0, q1, q2, q3]: Rotation): void {
    Object.assign(this.state.parameters, { q0, q1, q2, q3 });
  }
}
