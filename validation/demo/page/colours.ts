// SPDX-License-Identifier: GPL-3.0-or-later
// The page's colours for what is drawn: those of page.css, whose meanings are the project's palette. A second mark always goes with
// them: a solid body or an outline, a dash, a word.

// All that is drawn is drawn anew; the address has the state.
const dark = matchMedia("(prefers-color-scheme: dark)");
dark.addEventListener("change", () => location.reload());
document.documentElement.classList.toggle("drawn-dark", dark.matches);

const sheet = getComputedStyle(document.documentElement);
const of = (name: string): string => sheet.getPropertyValue(`--${name}`).trim();

export const COLOURS = {
  discrete: of("discrete"), continuous: of("continuous"), beta: of("beta"), gamma: of("gamma"), speed: of("speed"), tangential: of("tangential"),
  blow: { discrete: of("blow-discrete"), continuous: of("blow-continuous") },
  ink: of("ink"), quiet: of("quiet"), grid: of("line"), paper: of("paper"), floor: of("floor-lines"),
} as const;
