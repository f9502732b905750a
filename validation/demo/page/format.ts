// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers as people read them.
import { make } from "./dom";

/** With so many significant digits, a true minus sign, and powers of ten where zeros would have to be counted. */
export function significant(value: number | null | undefined, digits = 4): string {
  if (value === null || value === undefined || !Number.isFinite(value)) return "–";
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size >= 1e6 || size < 1e-4) {
    const [mantissa = "", exponent = ""] = value.toExponential(Math.max(0, digits - 2)).split("e");
    return withMinus(`${Number(mantissa)}·10${superscript(Number(exponent))}`);
  }
  // 0.9999 rounds to 1.00, which has a digit less behind its point.
  const rounded = Number(value.toPrecision(digits));
  const places = Math.min(20, Math.max(0, digits - 1 - Math.floor(Math.log10(Math.abs(rounded)))));
  return withMinus(rounded.toFixed(places));
}

/** With so many decimals; what rounds to zero is zero. */
export function fixed(value: number, decimalPlaces: number): string {
  const text = value.toFixed(decimalPlaces);
  return withMinus(Number(text) === 0 ? text.replace("-", "") : text);
}

function withMinus(text: string): string {
  return text.replace("-", "−");
}

function superscript(exponent: number): string {
  return [...String(exponent)].map((c) => (c === "-" ? "⁻" : "⁰¹²³⁴⁵⁶⁷⁸⁹"[Number(c)] ?? "")).join("");
}

/** How many leading digits of a number an error of this size leaves: it is at most half a unit of the last of them. */
export function digitsLeft(value: number, error: number | null | undefined): number {
  if (value === 0 || error === null || error === undefined || error === 0) return Infinity;
  const left = Math.floor(Math.log10(Math.abs(value))) - Math.ceil(Math.log10(2 * error)) + 1;
  return left > 0 ? left : 0;
}

/** How many leading digits numbers have in common, of so many. */
export function sharedDigits(values: readonly number[], most: number): number {
  const [first = "", ...others] = values.map((value) => value.toExponential(most - 1).replace(".", ""));
  if (others.some((other) => other.split("e")[1] !== first.split("e")[1])) return 0;
  const differs = [...first].findIndex((letter, i) => others.some((other) => other[i] !== letter));
  return differs < 0 ? most : Math.min(most, differs);
}

/** A printed number cut after so many significant digits, counts rising; the last part has the rest. Zeros before the first digit go with it. */
export function cut(text: string, counts: readonly number[]): string[] {
  const parts = [...counts, 0].map(() => "");
  const [mantissa = "", ...power] = text.split("·");
  let digits = 0;
  for (const letter of mantissa) {
    if (/[1-9]/.test(letter) || (letter === "0" && digits > 0)) digits += 1;
    const place = counts.findIndex((count) => Math.max(1, digits) <= count);
    parts[place < 0 ? counts.length : place] += letter;
  }
  if (power.length) parts[counts.length] += `·${power.join("·")}`;
  return parts;
}

/** Parts of a number of which each has a kind of its own, "" for plain text. */
export function withKinds(parts: readonly string[], kinds: readonly string[]): (Node | string)[] {
  return parts.flatMap((part, i) => (part === "" ? [] : [kinds[i] ? make("span", { class: kinds[i] }, part) : part]));
}
