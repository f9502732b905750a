// SPDX-License-Identifier: GPL-3.0-or-later
// Which damping of the ground gives a coefficient of restitution: the exact relation for one frictionless contact whose
// depth is one number, s = (c_G/k_G) v, ln[(1 + s)/(1 − s e)] = s (1 + e).
import { attitudeOf } from "./attitude";
import { centreHeight } from "./body";
import { bodyOf, type Parameters } from "./parameters";

/** The least coefficient of restitution that the page gives the ground a damping for. */
export const LEAST = 0.05;

function dampingFor(e: number, stiffness: number, speed: number): number {
  if (!(e < 1) || !(speed > 0)) return 0;
  // The relation has its root below 1/e; at e = 0 damping would have to be infinite.
  const wanted = Math.max(e, LEAST);
  let low = 1e-9;
  let high = (1 - 1e-12) / wanted;
  for (let i = 0; i < 100; i++) {
    const s = (low + high) / 2;
    const residual = Math.log1p(s) - Math.log1p(-s * wanted) - s * (1 + wanted);
    // Negative between 0 and the root, positive beyond it.
    if (residual < 0) low = s;
    else high = s;
  }
  return Number(((low * stiffness) / speed).toPrecision(4));
}

/** Downward speed of the centre of mass at the first touch [m/s]; 0 if the body is not released above that. */
export function firstSpeed(parameters: Parameters): number {
  if (parameters.drop === "speed") return parameters.speed;
  if (parameters.drop === "velocity") return Math.max(0, -parameters.vz);
  const body = bodyOf(parameters);
  const fall = parameters.height - centreHeight(body, attitudeOf(parameters, body));
  return Math.sqrt(Math.max(0, 2 * parameters.gravity * fall));
}

/** The coefficient of restitution that damping gives at a speed, to the digits that a control shows. */
function restitutionFor(damping: number, stiffness: number, speed: number): number {
  const s = (damping / stiffness) * speed;
  if (!(s > 0)) return 1;
  let low = 0;
  let high = Math.min(1, 1 / s);
  for (let i = 0; i < 60; i++) {
    const e = (low + high) / 2;
    // Negative below the root; no number, which counts as above, where s e reaches 1.
    if (Math.log1p(s) - Math.log1p(-s * e) - s * (1 + e) < 0) low = e;
    else high = e;
  }
  return Number(low.toPrecision(3));
}

/** The coefficient of restitution of the first impact: as given, or as the ground gives it. */
export function restitutionOf(parameters: Parameters): number {
  if (!parameters.ofGround) return parameters.e;
  return restitutionFor(parameters.damping, parameters.stiffness, firstSpeed(parameters));
}

/** Damping of the ground that the continuous model gets [N s/m⁴]. */
export function dampingOf(parameters: Parameters): number {
  if (!parameters.follow) return parameters.damping;
  return dampingFor(parameters.e, parameters.stiffness, firstSpeed(parameters));
}
