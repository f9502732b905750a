// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers as people read them.

/** With so many significant digits, a true minus sign, and powers of ten where zeros would have to be counted. */
export function significant(value: number | null | undefined, digits = 4): string {
  if (value === null || value === undefined || !Number.isFinite(value)) return "–";
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size >= 1e6 || size < 1e-4) {
    const [mantissa = "", exponent = ""] = value.toExponential(Math.max(0, digits - 2)).split("e");
    return withMinus(`${Number(mantissa)}·10${superscript(Number(exponent))}`);
  }
  return withMinus(Number(value.toPrecision(digits)).toFixed(decimals(value, digits)));
}

/** With so many decimals; what rounds to zero is zero. */
export function fixed(value: number, decimalPlaces: number): string {
  const text = value.toFixed(decimalPlaces);
  return withMinus(Number(text) === 0 ? text.replace("-", "") : text);
}

function decimals(value: number, digits: number): number {
  return Math.min(20, Math.max(0, digits - 1 - Math.floor(Math.log10(Math.abs(value)))));
}

function withMinus(text: string): string {
  return text.replace("-", "−");
}

function superscript(exponent: number): string {
  return [...String(exponent)].map((c) => (c === "-" ? "⁻" : "⁰¹²³⁴⁵⁶⁷⁸⁹"[Number(c)] ?? "")).join("");
}
