// SPDX-License-Identifier: GPL-3.0-or-later
// Impacts in words: the line below the picture, which a screen reader reads aloud.
import type { Impact } from "./api";
import { BODIES, CONTINUOUS_RADIUS, seenAngle, type BodyName } from "./body";
import { byId } from "./dom";
import { significant } from "./format";
import { DEFAULT_PARAMETERS, LEAST, bodyOf, dampingOf, restitutionOf, type Parameters } from "./parameters";

/** What a body is to the models, if that is not what one sees. */
const BODY_NOTES: Readonly<Partial<Record<BodyName, string>>> = {
  phone: "The phone is a box to both models; its round corners are drawn alone.",
  coin: "At 0° the coin lies flat; files and commands count the angle of its axis, which is then 90°. Ends a and b are its faces.",
  tube: "The tube has a thin wall; its lids have no mass.",
};

/** What an exercise needs of the body: its mass and, where its title has none, its sizes in mm. */
function sizeInWords(parameters: Parameters): string {
  const { shape, mass } = BODIES[parameters.body].size;
  if (!parameters.body.startsWith("own")) return `${significant(mass, 4)} kg`;
  const { length, radius, width, thickness } = parameters;
  const sides = shape === "box" ? [length, width, thickness] : [length, 2 * radius];
  return `${sides.map((side) => significant(1e3 * side, 4)).join(" × ")} mm, ${significant(parameters.mass, 4)} kg`;
}

/** What is dropped, in one sentence. */
function dropInWords(parameters: Parameters): string {
  const { body, angle, tilt, turn, drop, height, clearance, speed, gravity, e, friction } = parameters;
  const leans = turn === "plane" || turn === "tilted" ? `, inclined by ${significant(seenAngle(BODIES[body].size, angle), 4)}°${turn === "tilted" ? ` and turned by ${significant(tilt, 4)}° before` : ""}` : "";
  const above = drop === "clearance" ? `with its lowest point ${significant(clearance, 4)} m` : `${significant(height, 4)} m`;
  const falls = drop === "height" || drop === "clearance" ? `, let go ${above} above the floor` : drop === "speed" ? `, comes down at ${significant(speed, 4)} m/s` : "";
  const floor = friction > 0 ? `, friction μ = ${significant(friction, 4)}` : "";
  return `${BODIES[body].title} (${sizeInWords(parameters)})${leans}${falls}. Gravity ${significant(gravity, 4)} m/s², restitution e = ${significant(e, 4)}${floor}.`;
}

/** On what the continuous model runs, of which the discrete one knows nothing; whether nobody else chose it. */
function groundInWords({ stiffness, damping, follow, e }: Parameters, isOfPage: boolean): string {
  const numbers = `k = ${significant(stiffness, 4)} N/m³, c = ${significant(damping, 4)} N·s/m⁴`;
  const given = follow && e < LEAST ? `e = ${LEAST}, the least that the page gives it` : "e";
  const choice = isOfPage || given !== "e" ? `${isOfPage ? ", chosen by the page" : ""}; c is such that it gives ${given} in the first blow, and less in a faster one` : "";
  return `The continuous model’s ground: ${numbers}${choice}.`;
}

/** How hard a blow is, compared with another. */
export function comparison(ratio: number): string {
  if (ratio > 0.95 && ratio < 1.05) return "about as hard";
  if (ratio > 1.95 && ratio < 2.05) return "twice as hard";
  if (ratio > 0.48 && ratio < 0.52) return "half as hard";
  return `${significant(ratio, 2)} times as hard`;
}

function endInWords(end: string): string {
  if (end === "a" || end === "b") return `end ${end}`;
  const edge = /^([ab])-top$/.exec(end)?.[1];
  if (edge) return `upper edge of end ${edge}`;
  return end === "both" ? "both ends at once" : end;
}

const SIDES: Readonly<Record<string, string>> = { "-x": "left", "+x": "right", "-y": "front", "+y": "back", "-z": "lower", "+z": "upper" };

/** "-x+y-z" as seen on the body while it lies flat: "left back lower". */
function sidesInWords(name: string): string {
  return (name.match(/[-+][xyz]/g) ?? [name]).map((side) => SIDES[side] ?? side).join(" ");
}

/** Corners by where they are on the body while it lies flat. */
export function cornersInWords(corners: string): string {
  const given = corners.split(" ");
  if (given[0] === "a" || given[0] === "b") return endInWords(given.length > 1 ? "both" : given[0]);
  const names = given.map(sidesInWords);
  if (names.length === 1) return `corner ${names[0]}`;
  return `corners ${names.slice(0, -1).join(", ")} and ${names[names.length - 1]} at once`;
}

/** Ends of a body in the plane, corners in space. */
export function placeInWords(place: string): string {
  return /[xyz ]/.test(place) ? cornersInWords(place) : endInWords(place);
}

export function impactInWords(impacts: readonly Impact[], n: number): string {
  const impact = impacts[n - 1];
  const first = impacts[0];
  if (!impact || !first) return "";
  const place = placeInWords(impact.corners ?? impact.end);
  const angle = `${significant(impact.contact_angle_deg, 3)}°`;
  if (n === 1) return `Impact 1: ${place}, at ${angle}, impulse ${significant(impact.impulse_normal, 3)} N·s`;
  const after = `${significant(impact.start - first.start, 2)} s after the first`;
  return `Impact ${n}: ${place}, ${after}, ${comparison(impact.impulse_normal / first.impulse_normal)}`;
}

const OUTCOMES: Readonly<Record<string, string>> = {
  "no-further-impact": "Nothing reaches the ground any more.",
  "impact-limit": "More impacts may follow.",
  "at-rest": "Then it comes to rest.",
  "evaluation-limit": "The last contact goes on beyond what is computed.",
  "sustained-contact": "Then one end stays down while the body still turns.",
};

export function outcomeInWords(outcome: string): string {
  return OUTCOMES[outcome] ?? outcome.replace(/-/g, " ");
}

/** What the program warns of beside the discrete model's numbers, an option as the address has it; beside energies what concerns them. */
export function showWarnings(warnings: readonly string[]): void {
  const said = warnings.map((warning) => warning.replace(/--([a-z-]+) (\w+)/g, (_all, name: string, value: string) => `with.${name.replace(/-/g, "_")}=${value} in the address`));
  for (const line of document.querySelectorAll<HTMLElement>(".warnings")) {
    const told = said.filter((warning) => !line.classList.contains("of-energy") || warning.includes("energy"));
    line.textContent = told.map((warning) => `In the discrete model ${warning}.`).join(" ");
    line.hidden = told.length === 0;
  }
}

export function showNotes(parameters: Parameters): void {
  byId("handout-drop").textContent = dropInWords({ ...parameters, e: restitutionOf(parameters) });
  byId("body-note").textContent = BODY_NOTES[parameters.body] ?? "";
  // A scene that gives a stiffness gives the damping, too.
  const isOfPage = parameters.stiffness === DEFAULT_PARAMETERS.stiffness && parameters.follow;
  const { shape, length, radius } = bodyOf(parameters);
  const thick = shape === "rod" && radius === 0 ? ` Its rod has a radius of ${significant(100 * CONTINUOUS_RADIUS * length, 3)} cm.` : "";
  const ground = groundInWords({ ...parameters, damping: dampingOf(parameters) }, isOfPage) + thick;
  for (const note of document.querySelectorAll(".ground-note")) note.textContent = ground;
}
