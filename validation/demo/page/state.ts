// What the page shows, and its form as a link: the query string holds everything that a colleague needs to see the same.
import { BODIES, type Body, type BodyName } from "./body";

export const QUANTITIES = ["angle", "speed", "height", "gravity", "e", "friction", "stiffness", "damping", "impacts",
  "mass", "length", "radius", "width", "thickness"] as const;
export type Quantity = (typeof QUANTITIES)[number];

export const PANELS = ["numbers", "table", "force", "energy", "map", "explain"] as const;

/** The situation: all that the two models need. SI units, angles in degrees. */
export interface Parameters extends Record<Quantity, number> {
  body: BodyName;
  /** What is given: the speed at the first touch, or the height of release. */
  drop: "speed" | "height";
  /** The ground's damping is that which gives the coefficient of restitution e. */
  follow: boolean;
  planar: boolean;
}

export interface State {
  parameters: Parameters;
  /** The chosen impact, from 1. */
  impact: number;
  /** Of the picture, 0 at the first touch [s]; not a number: when the chosen impact starts. */
  time: number;
  layout: "overlay" | "side";
  /** Playback rate; it never enters a computation. */
  rate: number;
  slow: boolean;
  predict: boolean;
  lock: string[];
  hide: string[];
}

export const RATES = [0.25, 0.5, 1, 2] as const;

export const DEFAULT_PARAMETERS: Parameters = {
  body: "rod", drop: "speed", angle: 10, speed: 1, height: 1, gravity: 0, e: 1, friction: 0,
  stiffness: 1e10, damping: 0, follow: true, impacts: 6, planar: true,
  mass: 1, length: 1, radius: 0, width: 0.07, thickness: 0.01,
};

function defaultState(): State {
  return {
    parameters: { ...DEFAULT_PARAMETERS }, impact: 1, time: 0, layout: "overlay", rate: 1, slow: true, predict: true,
    lock: [], hide: [],
  };
}

export function bodyOf(parameters: Parameters): Body {
  const { mass, length, radius, width, thickness } = parameters;
  if (parameters.body === "own-rod") return { shape: "rod", mass, length, radius, width: 0, thickness: 0 };
  if (parameters.body === "own-box") return { shape: "box", mass, length, radius: 0, width, thickness };
  return BODIES[parameters.body].body;
}

/** A size means something only for a body of one's own, a height only if it is what is given. */
export function isUsed(parameters: Parameters, quantity: Quantity): boolean {
  switch (quantity) {
    case "speed": return parameters.drop === "speed";
    case "height": return parameters.drop === "height";
    case "mass": case "length": return parameters.body.startsWith("own");
    case "radius": return parameters.body === "own-rod";
    case "width": case "thickness": return parameters.body === "own-box";
    default: return true;
  }
}

function toQuery(state: State): string {
  const query = new URLSearchParams();
  const { parameters } = state;
  query.set("body", parameters.body);
  for (const quantity of QUANTITIES) {
    if (quantity === "damping" && parameters.follow) continue;
    if (isUsed(parameters, quantity)) query.set(quantity, String(parameters[quantity]));
  }
  if (!parameters.planar) query.set("planar", "0");
  query.set("impact", String(state.impact));
  if (Number.isFinite(state.time)) query.set("t", String(state.time));
  if (state.layout === "side") query.set("layout", "side");
  if (state.rate !== 1) query.set("rate", String(state.rate));
  if (!state.slow) query.set("slow", "0");
  if (!state.predict) query.set("predict", "0");
  if (state.lock.length) query.set("lock", state.lock.join(","));
  if (state.hide.length) query.set("hide", state.hide.join(","));
  return query.toString().replace(/%2C/g, ",");
}

/** Numbers pass as they are given, even senseless ones: the program says what is allowed. */
function fromQuery(text: string): State {
  const query = new URLSearchParams(text);
  const state = defaultState();
  const { parameters } = state;
  const number = (key: string, otherwise: number): number => {
    const given = query.get(key);
    return given === null || given.trim() === "" || !Number.isFinite(Number(given)) ? otherwise : Number(given);
  };
  const list = (key: string): string[] => (query.get(key) ?? "").split(",").map((s) => s.trim()).filter(Boolean);
  const body = query.get("body");
  if (body !== null && Object.hasOwn(BODIES, body)) setBody(parameters, body as BodyName);
  parameters.drop = query.has("height") && !query.has("speed") ? "height" : "speed";
  for (const quantity of QUANTITIES) parameters[quantity] = number(quantity, parameters[quantity]);
  parameters.follow = !query.has("damping");
  parameters.planar = query.get("planar") !== "0";
  state.impact = Math.max(1, Math.round(number("impact", 1)));
  state.time = number("t", query.has("impact") ? NaN : 0);
  state.layout = query.get("layout") === "side" ? "side" : "overlay";
  state.rate = RATES.find((rate) => rate === number("rate", 1)) ?? 1;
  state.slow = query.get("slow") !== "0";
  state.predict = query.get("predict") !== "0";
  state.lock = list("lock");
  state.hide = list("hide");
  return state;
}

/** Chooses a body; one's own starts with sizes that make sense for its shape. */
export function setBody(parameters: Parameters, name: BodyName): void {
  parameters.body = name;
  const { mass, length, radius, width, thickness } = BODIES[name].body;
  Object.assign(parameters, { mass, length, radius, width, thickness });
}

// An offline copy is a file: there only the fragment of its address may change.
const inFragment = (): boolean => location.protocol === "file:";

export function readAddress(): State {
  return fromQuery(inFragment() ? location.hash.slice(1) : location.search);
}

export function addressOf(state: State): string {
  const url = new URL(location.href);
  if (inFragment()) url.hash = toQuery(state);
  else url.search = toQuery(state);
  return url.href;
}

let pending = 0;
/** Browsers allow only so many changes of the address a second: while something is dragged, one in 100 ms. */
export function writeAddress(state: State): void {
  if (pending) return;
  pending = window.setTimeout(() => {
    pending = 0;
    history.replaceState(null, "", addressOf(state));
  }, 100);
}
