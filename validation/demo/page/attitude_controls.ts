// SPDX-License-Identifier: GPL-3.0-or-later
// How the body is turned at the first touch: by angles, by the part of a box that points down, or by Euler parameters.
import { attitudeOf, orientationName } from "./attitude";
import { make } from "./dom";
import { bodyOf, type Parameters } from "./parameters";
import { normalised, product, turnAbout, type Rotation } from "./rotation";
import type { State } from "./state";

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
