// SPDX-License-Identifier: GPL-3.0-or-later
// The body in the hand: taken in the picture with mouse, pen or finger, tilted by an end, lifted by its middle, let go. By keys, too:
// on the picture ↑ and ↓ lift, [ and ] tilt, Enter lets go.
import { centreHeight, extentOf, isDisc, longHalf, seenAngle, type Body } from "./body";
import { byId, say } from "./dom";
import { significant } from "./format";
import { heldFrame, type Frame, type Projection } from "./frame";
import { shownTime, type Motion } from "./motion";
import type { OrbitControl } from "./orbit";
import { attitudeOf, bodyOf, tiltOf, type Parameters } from "./parameters";
import { planeRotation, product, rotate, turnAbout, type Rotation } from "./rotation";
import type { Stage } from "./stage";
import { isFixed, type State } from "./state";

const DEGREE = Math.PI / 180;
/** So near the pointer has to come to the body [px]. */
const REACH = 26;
/** Of the length, on either side of the middle: where a grip lifts instead of tilting. */
const MIDDLE = 0.22;
const TILT_STEP = 1; // ° a key
const LIFT_STEP = 0.04; // of the length a key
const HIGHEST = 2.2; // lengths over the ground

interface Held {
  /** [°], 0 to 90 */
  angle: number;
  /** Of the centre of mass [m] */
  height: number;
}

interface Taken {
  body: Body;
  held: Held;
  tilt: number;
  /** The place of the ground below its centre [m]. */
  over: readonly [number, number];
}

function heldRotation({ angle }: Held, tilt: number): Rotation {
  const plane = planeRotation(angle * DEGREE);
  return tilt === 0 ? plane : product(plane, turnAbout(0, tilt * DEGREE));
}

/** Before the models have answered: the body as it is given, a little above the ground. */
export function awaitedFrame(parameters: Parameters): Frame {
  const body = bodyOf(parameters);
  const given = attitudeOf(parameters, body);
  // Euler parameters that are all zero give none.
  const rotation: Rotation = given.every(Number.isFinite) ? given : [1, 0, 0, 0];
  return { ...heldFrame(body, rotation, centreHeight(body, rotation) + 0.05 * extentOf(body), ""), labels: [] };
}

/** Within what a hand can do: not into the ground, not out of sight. */
function possible(body: Body, { angle, height }: Held, tilt: number): Held {
  const turned = { angle: Math.round(Math.min(90, Math.max(0, angle)) * 10) / 10, height };
  const lowest = centreHeight(body, heldRotation(turned, tilt)) + 0.01 * extentOf(body);
  const most = lowest + HIGHEST * extentOf(body);
  return { ...turned, height: Number(Math.min(most, Math.max(lowest, height)).toPrecision(4)) };
}

interface Grip {
  part: "a" | "b" | "middle";
  from: Held;
  start: Projection;
  /** Where the middle of the body was [px], and pixels a metre. */
  centre: Projection;
  scale: number;
  isDisc: boolean;
}

interface Around {
  motion(): Motion | null;
  /** That of the picture [s]. */
  time(): number;
  onHold(): void;
  /** The situation is another one: it falls from where it was let go. */
  onDrop(): void;
}

export class InHand {
  private readonly box = byId("stage");
  private held: Held | null = null;
  private wasHeld = false;
  /** What the picture showed when it was taken, and over which place. */
  private taken: { frame: Frame; over: Taken["over"] } | null = null;
  private grip: Grip | null = null;
  private readonly pointers = new Map<number, Projection>();

  constructor(
    private readonly state: State, private readonly stage: Stage, private readonly orbit: OrbitControl, private readonly around: Around,
  ) {
    this.box.addEventListener("pointerdown", (event) => this.down(event));
    this.box.addEventListener("pointermove", (event) => this.move(event));
    for (const kind of ["pointerup", "pointercancel"] as const) this.box.addEventListener(kind, (event) => this.up(event));
    this.box.addEventListener("keydown", (event) => this.key(event));
  }

  /** Letting it go changes each of these, and gravity where there is none. */
  private get isLocked(): boolean {
    const { state } = this;
    return isFixed(state) || ["angle", "height", "speed", "clearance", "drop", "spinning"].some((name) => state.lock.includes(name)) || (state.parameters.gravity === 0 && state.lock.includes("gravity"));
  }

  /** The body as it can be taken: where it is given by angles. */
  private body(): Taken | null {
    const { parameters, layout } = this.state;
    const motion = this.around.motion();
    const isGiven = parameters.turn === "plane" || parameters.turn === "tilted";
    if (!isGiven || layout === "side" || this.isLocked || !motion) return null;
    const { body } = motion;
    const tilt = tiltOf(parameters);
    if (this.held) return { body, held: this.held, tilt, over: this.taken?.over ?? [0, 0] };
    const { centre: [x, y, height], inclination } = motion.pose(shownTime(motion, this.around.time()));
    const angle = Math.abs(inclination) / DEGREE;
    return { body, held: { angle: Math.min(angle, 180 - angle), height }, tilt, over: [x, y] };
  }

  private placeOf(event: PointerEvent): Projection {
    const { left, top } = this.box.getBoundingClientRect();
    return { x: event.clientX - left, y: event.clientY - top };
  }

  /** The part of the body under a place of the picture. */
  private gripAt(place: Projection): Grip | null {
    const taken = this.body();
    if (!taken) return null;
    const { body, held, tilt, over: [right, deep] } = taken;
    const along = rotate(heldRotation(held, tilt), longHalf(body));
    const at = (part: number): Projection => this.stage.project([right + along[0] * part, deep, held.height + along[2] * part]);
    const [a, b] = [at(-1), at(1)];
    const [x, y] = [b.x - a.x, b.y - a.y];
    const size = Math.hypot(x, y) || 1;
    const part = ((place.x - a.x) * x + (place.y - a.y) * y) / size ** 2;
    const off = Math.abs((place.x - a.x) * y - (place.y - a.y) * x) / size;
    const across = body.shape === "box" ? Math.hypot(body.width, body.thickness) : isDisc(body) ? body.length : 2 * body.radius;
    const thick = (across / 2 / extentOf(body)) * size;
    const margin = REACH / size;
    if (off > Math.max(REACH, thick) || part < -margin || part > 1 + margin) return null;
    const name = Math.abs(part - 0.5) < MIDDLE ? "middle" : part < 0.5 ? "a" : "b";
    const up = this.stage.project([right, deep, held.height + extentOf(body)]);
    const centre = at(0);
    return { part: name, from: held, start: place, centre, scale: Math.hypot(up.x - centre.x, up.y - centre.y) / extentOf(body), isDisc: isDisc(body) };
  }

  private down(event: PointerEvent): void {
    if ((event.target as HTMLElement).closest("button")) return;
    const place = this.placeOf(event);
    this.pointers.set(event.pointerId, place);
    this.box.setPointerCapture(event.pointerId);
    if (this.pointers.size === 1) this.grip = this.gripAt(place);
    this.box.classList.toggle("grabbing", this.grip !== null);
    if (this.grip) this.hold(this.grip.from);
  }

  private move(event: PointerEvent): void {
    const place = this.placeOf(event);
    const before = this.pointers.get(event.pointerId);
    if (!before) {
      this.box.classList.toggle("grabbable", this.gripAt(place) !== null);
      return;
    }
    const others = [...this.pointers].filter(([id]) => id !== event.pointerId).map(([, other]) => other);
    this.pointers.set(event.pointerId, place);
    const [other] = others;
    if (this.grip) this.hold(this.pulled(this.grip, place));
    else if (other) this.orbit.pinch(Math.hypot(place.x - other.x, place.y - other.y) / (Math.hypot(before.x - other.x, before.y - other.y) || 1));
    else this.orbit.drag(place.x - before.x, place.y - before.y);
  }

  /** How the body is held when the grip is pulled there. */
  private pulled({ part, from, start, centre, scale, isDisc: leansBack }: Grip, place: Projection): Held {
    if (part === "middle") return { ...from, height: from.height + (start.y - place.y) / scale };
    const side = part === "b" ? 1 : -1;
    const [right, up] = [side * (place.x - centre.x), side * (centre.y - place.y)];
    // The axis of a disc, whose inclination counts, stands across what the hand pulls.
    const lean = Math.atan2(Math.max(0, up), leansBack ? -right : right) / DEGREE;
    return { ...from, angle: leansBack ? 90 - lean : lean };
  }

  /** As far as a hand can. */
  private hold(wanted: Held): void {
    const taken = this.body();
    if (!taken) return;
    const { shown } = this.stage;
    if (!this.held && shown) this.taken = { frame: shown, over: taken.over };
    this.wasHeld = true;
    this.held = possible(taken.body, wanted, taken.tilt);
    this.around.onHold();
  }

  private up(event: PointerEvent): void {
    this.pointers.delete(event.pointerId);
    if (!this.grip || this.pointers.size) return;
    this.grip = null;
    this.box.classList.remove("grabbing");
    this.letGo();
  }

  /** Where nothing fell before, gravity is switched on. */
  private letGo(): void {
    const { held, state: { parameters } } = this;
    this.held = this.taken = null;
    if (!held) return;
    if (parameters.gravity === 0) parameters.gravity = 9.81;
    Object.assign(parameters, { angle: held.angle, height: held.height, drop: "height", spinning: false });
    this.around.onDrop();
  }

  private key(event: KeyboardEvent): void {
    if (event.target !== this.box || event.altKey || event.ctrlKey || event.metaKey) return;
    const taken = this.body();
    const length = taken ? extentOf(taken.body) : 0;
    const from = this.held ?? taken?.held;
    const lift = { ArrowUp: 1, ArrowDown: -1 }[event.key];
    const tilt = { "]": 1, "[": -1 }[event.key];
    if (this.orbit.key(event)) event.preventDefault();
    else if (event.key === "Enter" && this.held) this.letGo();
    else if (from && !event.shiftKey && lift !== undefined) this.hold({ ...from, height: from.height + lift * LIFT_STEP * length });
    else if (from && tilt !== undefined) this.hold({ ...from, angle: from.angle + tilt * TILT_STEP });
    else return;
    event.preventDefault();
    event.stopPropagation();
  }

  /** @return whether it is in the hand, and so drawn */
  draw(): boolean {
    byId("grab-hint").hidden = this.wasHeld || !this.body();
    if (!this.held) return false;
    const { parameters } = this.state;
    const body = bodyOf(parameters);
    const { angle, height } = this.held;
    const words = `${significant(seenAngle(body, angle), 3)}°, ${significant(height, 3)} m high`;
    const rotation = heldRotation(this.held, tiltOf(parameters));
    this.stage.draw(heldFrame(body, rotation, height, words, this.taken?.over, this.taken?.frame));
    say("caption", `In your hand: ${words}. Let go to drop it${parameters.gravity === 0 ? ", with gravity switched on" : ""}.`);
    return true;
  }
}
