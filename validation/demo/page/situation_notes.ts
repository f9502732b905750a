// SPDX-License-Identifier: GPL-3.0-or-later
// What panels say of the situation beside their numbers.
import { byId } from "./dom";
import { DEFAULT_PARAMETERS, type Parameters } from "./parameters";
import { dampingOf, restitutionOf } from "./restitution";
import { bodyInWords, dropInWords, groundInWords } from "./words";

export function showNotes(parameters: Parameters): void {
  byId("handout-drop").textContent = dropInWords({ ...parameters, e: restitutionOf(parameters) });
  byId("body-note").textContent = bodyInWords(parameters.body);
  // A scene that gives a stiffness gives the damping, too.
  const isOfPage = parameters.stiffness === DEFAULT_PARAMETERS.stiffness && parameters.follow;
  const ground = groundInWords({ ...parameters, damping: dampingOf(parameters) }, isOfPage);
  for (const note of document.querySelectorAll(".ground-note")) note.textContent = ground;
}
