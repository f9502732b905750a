// SPDX-License-Identifier: GPL-3.0-or-later
// What panels say of the situation beside their numbers.
import { byId } from "./dom";
import { isInPlane, type Parameters } from "./parameters";
import { restitutionOf } from "./restitution";
import { bodyInWords, dropInWords } from "./words";

export function showNotes(parameters: Parameters): void {
  byId("map-note").hidden = parameters.body === "rod" && parameters.friction === 0 && isInPlane(parameters);
  byId("handout-drop").textContent = dropInWords({ ...parameters, e: restitutionOf(parameters) });
  byId("body-note").textContent = bodyInWords(parameters.body);
}
