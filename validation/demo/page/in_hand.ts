// SPDX-License-Identifier: GPL-3.0-or-later
// What the page does with a body in the hand: which one can be taken, how it is shown, and where it falls from.
import { byId, say } from "./dom";
import { heldFrame, type Frame } from "./frame";
import { heldInWords, heldRotation, type Held, type Taken } from "./grab";
import { shownTime, type Motion } from "./motion";
import { bodyOf, tiltOf } from "./parameters";
import type { Stage } from "./stage";
import type { State } from "./state";

const DEGREE = Math.PI / 180;

export interface Around {
  stage: Stage;
  motion(): Motion | null;
  /** That of the picture [s]. */
  time(): number;
  onHold(): void;
  /** The situation is another one: it falls from where it was let go. */
  onDrop(): void;
}

export class InHand {
  held: Held | null = null;
  private wasHeld = false;
  /** What the picture showed when it was taken, and over which place. */
  private taken: { frame: Frame; over: Taken["over"] } | null = null;

  constructor(private readonly state: State, private readonly around: Around) {}

  /** The body as it can be taken: where it is given by angles. */
  body(): Taken | null {
    const { parameters, lock, layout } = this.state;
    const motion = this.around.motion();
    const isGiven = parameters.turn === "plane" || parameters.turn === "tilted";
    if (!isGiven || layout === "side" || lock.includes("angle") || lock.includes("height") || !motion) return null;
    const { body } = motion;
    const tilt = tiltOf(parameters);
    if (this.held) return { body, held: this.held, tilt, over: this.taken?.over ?? [0, 0] };
    const { centre: [x, y, height], inclination } = motion.pose(shownTime(motion, this.around.time()));
    const angle = Math.abs(inclination) / DEGREE;
    return { body, held: { angle: Math.min(angle, 180 - angle), height }, tilt, over: [x, y] };
  }

  hold(held: Held): void {
    const { shown } = this.around.stage;
    if (!this.held && shown) this.taken = { frame: shown, over: this.body()?.over ?? [0, 0] };
    this.wasHeld = true;
    this.held = held;
    this.around.onHold();
  }

  /** Where nothing fell before, gravity is switched on. */
  letGo(held: Held): void {
    const { parameters } = this.state;
    this.held = this.taken = null;
    if (parameters.gravity === 0) parameters.gravity = 9.81;
    Object.assign(parameters, { angle: held.angle, height: held.height, drop: "height", spinning: false });
    this.around.onDrop();
  }

  /** @return whether it is in the hand, and so drawn */
  draw(): boolean {
    byId("grab-hint").hidden = this.wasHeld || !this.body();
    if (!this.held) return false;
    const { parameters } = this.state;
    const body = bodyOf(parameters);
    const words = heldInWords(body, this.held);
    const rotation = heldRotation(this.held, tiltOf(parameters));
    this.around.stage.draw(heldFrame(body, rotation, this.held.height, words, this.taken?.over, this.taken?.frame));
    say("caption", `In your hand: ${words}. Let go to drop it${parameters.gravity === 0 ? ", with gravity switched on" : ""}.`);
    return true;
  }
}
