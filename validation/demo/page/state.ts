// SPDX-License-Identifier: GPL-3.0-or-later
// What the page shows, and its form as a link: the fragment of its address holds everything that a colleague needs to see
// the same, wherever the file lies.
import { BODIES, type BodyName } from "./body";
import {
  DEFAULT_PARAMETERS, DROPS, QUANTITIES, TURNS, isInPlane, isUsed, setBody, type Choices, type Parameters, type Quantity,
} from "./parameters";
import { namesGround, numberOf, parametersOf, usualGravity } from "./requests";
import { nearMatch } from "./spelling";

export const PANELS = ["story", "strip", "numbers", "profile", "table", "fan", "force", "energy", "map", "race", "measured", "explain"] as const;

export const RATES = [0.25, 0.5, 1, 2] as const;
const TREMORS = [0.1, 0.5, 1, 2] as const;

/** What an address may hide, and lock beside each quantity and choice of the situation. */
const HIDDEN: readonly string[] = [...PANELS, "controls", "answers", "continuous"];
const LOCKED: readonly string[] = ["all", "scene", "file", "story", "sound", "layout", "rate", "slow", "predict"];
/** What `lock=all` stands for: whatever would make another drop of it. */
const DROP: readonly string[] = ["scene", "file", "story", ...Object.keys(DEFAULT_PARAMETERS)];

/** Words that mean something in an address, and numbers. */
const WORDS: Readonly<Record<string, readonly (string | number)[]>> = {
  body: Object.keys(BODIES), turn: TURNS, drop: DROPS, planar: [0, 1], law: ["ground"], layout: ["overlay", "side"], rate: RATES, slow: [0, 1],
  predict: [0, 1], tremor: TREMORS, fan: [0, 1], tab: [...PANELS, "all"], models: ["discrete"], given: [1],
};
const NUMBERS: readonly string[] = [...QUANTITIES, "impact", "t"];

const NAMES: readonly string[] = [...Object.keys(WORDS), ...NUMBERS, "hide", "lock"];

function refused(name: string, text: string, given: boolean): string | null {
  const words = WORDS[name];
  // Of a scene as the program gives it the program itself says what is wrong with other names.
  if (name === "body" && given) return null;
  if (words) return words.map(String).includes(text) ? null : `must be one of ${words.join(", ")}`;
  if (NUMBERS.includes(name) || (given && name === "restitution")) {
    if (Number.isFinite(numberOf(text, NaN))) return null;
    return Number.isFinite(numberOf(text.replace(",", "."), NaN)) ? `a decimal comma is refused, write ${text.replace(",", ".")}` : "must be a number";
  }
  if (given || name === "hide" || name === "lock" || name.startsWith(EXTRA)) return null;
  return `unknown${nearMatch(name, NAMES)}; allowed are ${NAMES.join(", ")}`;
}

const isSlip = (name: string): boolean => !HIDDEN.includes(name);

/** What can be given in one way only, as the program has it; a choice in the link says which counts. */
const WAYS: readonly (readonly [keyof Choices, readonly (readonly string[])[]])[] = [
  ["drop", [["speed"], ["height"], ["clearance"], ["velocity"], ["vx", "vy", "vz"]]], ["turn", [["angle"], ["orientation"], ["attitude"], ["q0", "q1", "q2", "q3"]]],
];

function givenTwice(query: URLSearchParams): string[] {
  return WAYS.flatMap(([choice, ways]) => {
    const given = ways.flatMap((names) => names.find((name) => query.has(name)) ?? []);
    return given.length < 2 || query.has(choice) ? [] : [`${given.join(" and ")}: give one of them, not ${given.length === 2 ? "both" : "all"}`];
  });
}

/** What an address says that means nothing, in words; null if all means something. */
export function wrongInAddress({ said: { hide, lock } }: State): string | null {
  const query = addressQuery();
  const why = new Map<string, string[]>();
  for (const [name, text] of query) {
    const reason = refused(name, text, query.has("given"));
    if (reason) why.set(reason, [...(why.get(reason) ?? []), `${name}=${text}`]);
  }
  const wrong = [...why].map(([reason, said]) => `${said.join(", ")}: ${reason}`);
  const hidden = hide.filter(isSlip).map((name) => `hide=${name}${nearMatch(name, HIDDEN)}: must be one of ${HIDDEN.join(", ")}; until it is, all that can hold answers is hidden`);
  const locked = lock.filter((name) => !LOCKED.includes(name) && !(name in DEFAULT_PARAMETERS))
    .map((name) => `lock=${name}${nearMatch(name, [...LOCKED, ...Object.keys(DEFAULT_PARAMETERS)])}: must be a quantity of the link, or one of ${LOCKED.join(", ")}`);
  return [...wrong, ...givenTwice(query), ...hidden, ...locked].join("; ") || null;
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
  /** How far a hand misses the tilt to either side [°], and whether the picture shows what comes of that. */
  tremor: number;
  fan: boolean;
  /** Whether the reader has taken the continuous model away; a link that hides it takes its tick, too. */
  alone: boolean;
  lock: readonly string[];
  hide: readonly string[];
  /** Both as the link has them. */
  said: Readonly<Record<"lock" | "hide", readonly string[]>>;
  /** The panel below the picture, or "all". */
  tab: string;
}

/** In space the models stand beside each other: what tumbles cannot be told apart in one place. */
export function usualLayout(parameters: Parameters): State["layout"] {
  return isInPlane(parameters) ? "overlay" : "side";
}

/** Of a scene's arguments without a control: their names in a link begin so. */
const EXTRA = "with.";
/** What a link says of the view, not of the situation. */
const VIEW = ["impact", "t", "layout", "rate", "slow", "predict", "tremor", "fan", "models", "lock", "hide", "tab", "given"];

/** The choice without which a quantity would not be the one that counts. */
function choiceOf(quantity: Quantity): keyof Choices | null {
  if (/^(angle|tilt|orientation|q\d)$/.test(quantity)) return "turn";
  if (/^(speed|height|clearance|v[xyz])$/.test(quantity)) return "drop";
  if (/^w[xyz]$/.test(quantity)) return "spinning";
  return /^(mass|length|radius|width|thickness)$/.test(quantity) ? "body" : null;
}

/** Whether the reader is given no way to another drop: then neither picture, map nor file is one. */
export function isFixed({ hide, lock }: State): boolean {
  return hide.includes("controls") || lock.includes("all");
}

/** Takes over a situation, but for what the link of a class has locked; @return names of what stays as it was. */
export function assignUnlocked({ parameters, lock }: State, wanted: Parameters): string[] {
  const locked = lock.filter((name): name is keyof Parameters => name in parameters);
  const choices = locked.map((name) => choiceOf(name as Quantity)).filter((name) => name !== null);
  const kept = [...new Set<keyof Parameters>([...locked, ...choices])];
  const differing = kept.filter((name) => parameters[name] !== wanted[name]);
  const before = Object.fromEntries(kept.map((name) => [name, parameters[name]]));
  Object.assign(parameters, wanted, before);
  return differing;
}

function toQuery(state: State): URLSearchParams {
  const query = new URLSearchParams();
  const { parameters } = state;
  query.set("body", parameters.body);
  for (const quantity of QUANTITIES) {
    if (quantity === "damping" && parameters.follow) continue;
    if (quantity === "e" && parameters.ofGround) continue;
    if (isUsed(parameters, quantity)) query.set(quantity, String(parameters[quantity]));
  }
  if (parameters.turn !== "plane") query.set("turn", parameters.turn);
  if (!parameters.planar) query.set("planar", "0");
  if (parameters.ofGround) query.set("law", "ground");
  for (const [name, text] of Object.entries(parameters.extra)) query.set(EXTRA + name, text);
  query.set("impact", String(state.impact));
  if (Number.isFinite(state.time)) query.set("t", String(state.time));
  if (state.layout !== usualLayout(parameters)) query.set("layout", state.layout);
  if (state.rate !== 1) query.set("rate", String(state.rate));
  if (!state.slow) query.set("slow", "0");
  if (!state.predict) query.set("predict", "0");
  if (state.tremor !== 0.5) query.set("tremor", String(state.tremor));
  if (state.fan) query.set("fan", "1");
  if (state.alone) query.set("models", "discrete");
  if (state.said.lock.length) query.set("lock", state.said.lock.join(","));
  if (state.tab !== "strip") query.set("tab", state.tab);
  if (state.said.hide.length) query.set("hide", state.said.hide.join(","));
  return query;
}

/** Numbers pass as they are given, even senseless ones: the program says what is allowed. */
function situationIn(query: URLSearchParams): Parameters {
  if (query.has("given")) return parametersOf(Object.fromEntries([...query].filter(([name]) => !VIEW.includes(name))));
  const parameters = { ...DEFAULT_PARAMETERS };
  const body = query.get("body");
  if (body !== null && Object.hasOwn(BODIES, body)) setBody(parameters, body as BodyName);
  Object.assign(parameters, choicesIn(query));
  parameters.gravity = usualGravity(parameters);
  for (const quantity of QUANTITIES) parameters[quantity] = numberOf(query.get(quantity), parameters[quantity]);
  parameters.extra = Object.fromEntries([...query].filter(([name]) => name.startsWith(EXTRA))
    .map(([name, text]) => [name.slice(EXTRA.length), text]));
  return parameters;
}

function choicesIn(query: URLSearchParams): Omit<Choices, "body"> {
  const hasAny = (...names: Quantity[]): boolean => names.some((name) => query.has(name));
  const turn = hasAny("q0", "q1", "q2", "q3") ? "attitude" : hasAny("orientation") ? "orientation" : hasAny("tilt") ? "tilted" : "plane";
  const drop = hasAny("vx", "vy", "vz") ? "velocity" : (["speed", "height", "clearance"] as const).find((name) => hasAny(name)) ?? "speed";
  return {
    turn: TURNS.find((one) => one === query.get("turn")) ?? turn, drop: DROPS.find((one) => one === query.get("drop")) ?? drop,
    spinning: hasAny("wx", "wy", "wz"), follow: !query.has("damping"), ofGround: query.get("law") === "ground",
    planar: query.get("planar") !== "0",
  };
}

/** What a link says. */
export function stateOf(text: string): State {
  const query = new URLSearchParams(text);
  const parameters = situationIn(query);
  const number = (key: string, otherwise: number): number => numberOf(query.get(key), otherwise);
  const list = (key: string): string[] => (query.get(key) ?? "").split(",").map((s) => s.trim()).filter(Boolean);
  const said = { lock: list("lock"), hide: list("hide") };
  return {
    parameters,
    impact: Math.max(1, Math.round(number("impact", 1))),
    time: number("t", query.has("impact") ? NaN : 0),
    layout: (["overlay", "side"] as const).find((layout) => layout === query.get("layout")) ?? usualLayout(parameters),
    rate: RATES.find((rate) => rate === number("rate", 1)) ?? 1,
    slow: query.get("slow") !== "0",
    predict: query.get("predict") !== "0",
    tremor: TREMORS.find((tremor) => tremor === number("tremor", 0.5)) ?? 0.5,
    fan: query.get("fan") === "1",
    alone: query.get("models") === "discrete",
    lock: said.lock.includes("all") ? [...said.lock, ...DROP] : said.lock,
    hide: said.hide.some(isSlip) ? [...said.hide, ...HIDDEN.filter((name) => name !== "controls")] : said.hide,
    said,
    tab: [...PANELS, "all"].find((tab) => tab === query.get("tab")) ?? "strip",
  };
}

/** What the address says; where it names no body, over the scene that was written into the page. */
function addressQuery(): URLSearchParams {
  const said = new URLSearchParams(location.hash.slice(1));
  if (said.has("body") || said.has("given")) return said;
  const written = new URLSearchParams(document.querySelector<HTMLMetaElement>("meta[name=clatter-scene]")?.content ?? "");
  // What the address gives takes the place of the same thing given in another way.
  for (const [choice, ways] of WAYS) {
    if ([choice, ...ways.flat()].some((name) => said.has(name))) for (const name of [choice, ...ways.flat()]) written.delete(name);
  }
  for (const [name, value] of said) written.set(name, value);
  return written;
}

/** Whether the address gives a scene of the program's in which no ground is named. */
export function lacksGround(): boolean {
  const query = addressQuery();
  return query.has("given") && !namesGround(query.keys());
}

export function readAddress(): State {
  return stateOf(addressQuery().toString());
}

/** @param without names that are left out, but for those that are locked */
export function addressOf(state: State, without: readonly string[] = []): string {
  const url = new URL(location.href);
  const query = toQuery(state);
  for (const name of without) if (!state.lock.includes(name)) query.delete(name);
  url.hash = query.toString().replace(/%2C/g, ",");
  return url.href;
}

/** The address as the page has read or written it: any other one is a link that was opened, of which no event has told yet. */
let known = location.hash;
let pending = 0;
/** Browsers allow only so many changes of the address a second: while something is dragged, one in 100 ms. */
export function writeAddress(state: State): void {
  if (pending) return;
  pending = window.setTimeout(() => {
    pending = 0;
    if (location.hash !== known) return;
    history.replaceState(null, "", addressOf(state));
    known = location.hash;
  }, 100);
}
