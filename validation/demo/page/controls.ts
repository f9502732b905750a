// SPDX-License-Identifier: GPL-3.0-or-later
// Sliders, number fields and choices of the situation: what they are called, their range and scale stand in index.html. The program, not
// the page, says which numbers are allowed.
import type { ApiError } from "./api";
import { BODIES, seenAngle, type BodyName } from "./body";
import { byId, make } from "./dom";
import {
  QUANTITIES, SCENES, attitudeOf, bodyOf, dampingOf, firstSpeed, isInPlane, isUsed, orientationName, restitutionOf, setBody,
  type Parameters, type Quantity,
} from "./parameters";
import { normalised, product, turnAbout, type Rotation } from "./rotation";
import { usualGravity } from "./requests";
import { assignUnlocked, type State } from "./state";

interface Row {
  box: HTMLElement;
  field: HTMLInputElement;
  error: HTMLElement;
  /** Not for a part of a vector. */
  slider?: HTMLInputElement;
  /** Why it cannot be changed. */
  reason?: HTMLElement;
}

const CHECKS = ["follow", "ofGround", "planar", "spinning"] as const;
const STEP = Math.PI / 12; // of a button that turns the body
/** Positions of a logarithmic slider. */
const TICKS = 600;

/** What the program calls these quantities in its messages. */
const BLAMED: Readonly<Record<string, Quantity>> = {
  restitution: "e", static_friction: "friction", sliding_friction: "friction", size: "length", attitude: "q0",
  velocity: "vx", angular_velocity: "wx",
};

/** A quantity's value, or that which follows from another's. */
function shownValue(parameters: Parameters, quantity: Quantity): number {
  if (quantity === "damping") return dampingOf(parameters);
  if (quantity === "angle") return seenAngle(bodyOf(parameters), parameters.angle);
  return quantity === "e" ? restitutionOf(parameters) : parameters[quantity];
}

/** Of a slider: its ends, and the step of a linear one; without a step it is logarithmic, with the number 0 at its left end if `zero`. */
function rangeOf(slider: HTMLElement): { min: number; max: number; step: number; zero: boolean } {
  const [min = 0, max = 1, step = 0] = (slider.dataset["range"] ?? "").split(" ").map(Number);
  return { min, max, step, zero: "zero" in slider.dataset };
}

function toSlider(slider: HTMLElement, value: number): number {
  const { min, max, step, zero } = rangeOf(slider);
  if (step) return value;
  if (!(value > 0)) return 0;
  const part = Math.log(value / min) / Math.log(max / min);
  return Math.round(Math.min(1, Math.max(zero ? 1 / TICKS : 0, part)) * TICKS);
}

function fromSlider(slider: HTMLElement, position: number): number {
  const { min, max, step, zero } = rangeOf(slider);
  if (step) return Number(position.toFixed(6));
  return zero && position === 0 ? 0 : Number((min * (max / min) ** (position / TICKS)).toPrecision(3));
}

/** As a number field takes it; large numbers with an exponent. */
function fieldText(value: number): string {
  return Math.abs(value) >= 1e5 ? value.toExponential().replace("e+", "e") : String(value);
}

export class Controls {
  private readonly rows = new Map<Quantity, Row>();
  private readonly scene = byId<HTMLSelectElement>("scene");
  private readonly body = byId<HTMLSelectElement>("body");
  private readonly turn = byId<HTMLSelectElement>("turn");
  private readonly drop = byId<HTMLSelectElement>("drop");
  /** Buttons that turn the body about the axes of the world. */
  private readonly turns = [...byId("turns").querySelectorAll("button")];
  private readonly errors = new Map<string, ApiError>();

  constructor(
    private readonly state: State, private readonly onChange: () => void, private readonly onRelease: () => void,
  ) {
    const { parameters } = state;
    for (const box of document.querySelectorAll<HTMLElement>("[data-quantity]")) this.buildRow(box);
    for (const box of document.querySelectorAll<HTMLElement>("[data-vector]")) this.buildVector(box);
    this.scene.append(...SCENES.map(({ name, title }) => make("option", { value: name }, title)));
    this.body.append(...Object.entries(BODIES).map(([name, { title }]) => make("option", { value: name }, title)));
    this.scene.addEventListener("change", () => {
      const scene = SCENES.find(({ name }) => name === this.scene.value);
      if (scene) this.choose(() => assignUnlocked(state, scene.parameters));
    });
    this.body.addEventListener("change", () => this.choose(() => setBody(parameters, this.body.value as BodyName)));
    this.turn.addEventListener("change", () => this.choose(() => {
      const turn = this.turn.value as Parameters["turn"];
      // Euler parameters begin as what the body's attitude was.
      if (turn === "attitude") this.put(attitudeOf(parameters, bodyOf(parameters)));
      parameters.turn = turn;
    }));
    this.drop.addEventListener("change", () => this.chooseDrop(this.drop.value as Parameters["drop"]));
    for (const key of CHECKS) byId(key).addEventListener("change", () => this.check(key));
    for (const button of this.turns) button.addEventListener("click", () => this.choose(() => this.turnBy(button)));
    byId("extra-forget").addEventListener("click", () => {
      parameters.extra = {};
      this.change();
    });
    this.refresh();
  }

  /** Shows the state: after a link, a scene or a click on the map changed it. */
  refresh(): void {
    const { parameters, lock } = this.state;
    const isLocked = (...names: string[]): boolean => names.some((name) => lock.includes(name));
    for (const [quantity, { box, slider, field, reason }] of this.rows) {
      const shown = shownValue(parameters, quantity);
      const followed = quantity === "damping" ? parameters.follow : quantity === "e" && parameters.ofGround;
      if (document.activeElement !== field) field.value = fieldText(shown);
      box.hidden = !isUsed(parameters, quantity);
      field.disabled = isLocked(quantity) || followed;
      if (!slider || !reason) continue;
      slider.value = String(toSlider(box, shown));
      slider.setAttribute("aria-valuetext", `${fieldText(shown)} ${box.dataset["unit"] ?? ""}`.trim());
      slider.disabled = field.disabled;
      setText(reason, !followed ? "" : quantity === "e" ? "It follows from the ground’s damping, which the scene gives." : "It follows from the restitution.");
    }
    for (const key of CHECKS) Object.assign(byId(key), { checked: parameters[key], disabled: isLocked(key) });
    byId("planar-row").hidden = !isInPlane(parameters);
    for (const [select, value] of [[this.body, parameters.body], [this.drop, parameters.drop], [this.turn, parameters.turn]] as const) {
      Object.assign(select, { value, disabled: isLocked(select.id) });
    }
    this.turn.disabled ||= isLocked("angle", "tilt", "orientation");
    for (const option of this.turn.options) option.disabled = option.value === "orientation" && bodyOf(parameters).shape !== "box";
    byId("turns").hidden = parameters.turn !== "attitude";
    for (const button of this.turns) button.disabled = isLocked("q0", "q1", "q2", "q3", "turn");
    setText(byId("orientation-name"), parameters.turn === "orientation" ? orientationName(parameters.orientation) : "");
    const extra = Object.entries(parameters.extra).map(([name, text]) => `${name} = ${text}`);
    byId("extra").hidden = extra.length === 0;
    byId("extra-forget").hidden = isLocked("extra");
    byId("extra-keys").textContent = extra.join("; ");
    if (extra.length > 0) this.openMore();
    this.scene.value = sceneOf(parameters) ?? "";
    this.scene.disabled = isLocked("scene");
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
    for (const { blames = "", message } of this.errors.values()) {
      const quantity = isQuantity(blames) ? blames : BLAMED[blames];
      if (quantity && !this.rows.get(quantity)?.box.hidden) blamed.set(quantity, message);
      else general.add(message);
    }
    for (const [quantity, { error: line, field }] of this.rows) {
      setText(line, blamed.get(quantity) ?? "");
      if (!blamed.has(quantity)) field.removeAttribute("aria-invalid");
      else {
        field.setAttribute("aria-invalid", "true");
        if (field.closest("#more")) this.openMore();
      }
    }
    setText(byId("error"), [...general].join("; "));
  }

  private chooseDrop(drop: Parameters["drop"]): void {
    const { parameters } = this.state;
    if (drop === "velocity") Object.assign(parameters, { vx: 0, vy: 0, vz: -firstSpeed(parameters) });
    parameters.drop = drop;
    // Nothing falls from a height without gravity.
    parameters.gravity ||= usualGravity(parameters);
    this.change();
  }

  private check(key: (typeof CHECKS)[number]): void {
    const { parameters } = this.state;
    if (key === "follow" || key === "ofGround") {
      parameters.damping = dampingOf(parameters);
      parameters.e = restitutionOf(parameters);
      parameters.follow = parameters.ofGround = false;  // each is the other's cause, or neither
    }
    parameters[key] = byId<HTMLInputElement>(key).checked;
    this.change();
  }

  private turnBy({ dataset }: HTMLButtonElement): void {
    const { q0, q1, q2, q3 } = this.state.parameters;
    const axis = "xyz".indexOf(dataset["axis"] ?? "x") as 0 | 1 | 2;
    this.put(normalised(product(turnAbout(axis, Number(dataset["sign"]) * STEP), [q0, q1, q2, q3])));
  }

  private put([q0, q1, q2, q3]: Rotation): void {
    Object.assign(this.state.parameters, { q0, q1, q2, q3 });
  }

  private buildRow(box: HTMLElement): void {
    const quantity = box.dataset["quantity"] as Quantity;
    const { label = "", unit = "" } = box.dataset;
    const { min, max, step } = rangeOf(box);
    const range = step ? { min, max, step } : { min: 0, max: TICKS, step: 1 };
    const slider = make("input", { type: "range", id: `${quantity}-slider`, "aria-label": `${label}, slider`, ...range });
    const field = make("input", {
      type: "number", id: quantity, step: "any", inputmode: "decimal", "aria-describedby": `${quantity}-error ${quantity}-reason`,
    });
    const error = make("p", { class: "error", id: `${quantity}-error`, role: "alert", hidden: true });
    const reason = make("p", { class: "reason", id: `${quantity}-reason`, hidden: true });
    box.append(make("label", { for: quantity }, label), field, make("span", { class: "unit" }, unit), slider, reason, error);
    slider.addEventListener("input", () => this.set(quantity, fromSlider(box, Number(slider.value))));
    slider.addEventListener("change", () => this.onRelease());
    this.listen(field, quantity);
    this.rows.set(quantity, { box, slider, field, error, reason });
  }

  /** A field a part, in one line. */
  private buildVector(whole: HTMLElement): void {
    const { label = "", unit = "", vector = "" } = whole.dataset;
    const line = make("div", { class: "vector", role: "group", "aria-label": label });
    whole.append(make("span", { class: "name" }, label, make("span", { class: "unit" }, ` ${unit}`)), line);
    (vector.split(" ") as Quantity[]).forEach((part, i) => {
      const field = make("input", { type: "number", id: part, step: "any", "aria-label": part, "aria-describedby": `${part}-error` });
      const error = make("p", { class: "error", id: `${part}-error`, role: "alert", hidden: true });
      const box = make("span", {}, field);
      line.append(box);
      whole.append(error);
      this.listen(field, part);
      // Parts are shown together, with their title.
      this.rows.set(part, { box: i === 0 ? whole : box, field, error });
    });
  }

  private listen(field: HTMLInputElement, quantity: Quantity): void {
    field.addEventListener("input", () => {
      if (field.value !== "" && Number.isFinite(field.valueAsNumber)) this.set(quantity, field.valueAsNumber);
    });
    // A browser whose language has decimal points would leave a comma out: 15 for 1,5.
    const put = (event: Event, text = ""): void => {
      if (!text.includes(",")) return;
      event.preventDefault();
      document.execCommand("insertText", false, text.replace(",", "."));
    };
    field.addEventListener("keydown", (event) => put(event, event.key));
    field.addEventListener("paste", (event) => put(event, event.clipboardData?.getData("text/plain")));
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

  /** What is chosen at once, as a slider that is let go. */
  private choose(act: () => void): void {
    act();
    this.change();
    this.onRelease();
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
