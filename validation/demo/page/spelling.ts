// SPDX-License-Identifier: GPL-3.0-or-later
// Slips of the pen in an address.

/** How many letters are to be put in, left out or replaced. */
function distance(one: string, other: string): number {
  let row = Array.from({ length: other.length + 1 }, (_, i) => i);
  for (const [i, letter] of [...one].entries()) {
    const next = [i + 1];
    for (const [k, wanted] of [...other].entries()) {
      next.push(Math.min((row[k] ?? 0) + (letter === wanted ? 0 : 1), (row[k + 1] ?? 0) + 1, (next[k] ?? 0) + 1));
    }
    row = next;
  }
  return row[other.length] ?? 0;
}

/** ", did you mean answers?"; empty where nothing is near. */
export function nearMatch(slip: string, allowed: readonly string[]): string {
  const [best] = allowed.map((name) => [distance(slip.toLowerCase(), name), name] as const).sort(([a], [b]) => a - b);
  return best && best[0] <= slip.length / 2.5 ? `, did you mean ${best[1]}?` : "";
}
