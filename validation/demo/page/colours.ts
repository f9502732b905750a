// SPDX-License-Identifier: GPL-3.0-or-later
// Colours that also colour-blind eyes tell apart (Okabe and Ito). A second mark always goes with them: a solid body or an
// outline, a dash, a word.

export const COLOURS = {
  discrete: "#0072b2",
  continuous: "#d55e00",
  speed: "#009e73",
  blow: { discrete: "#0a3d62", continuous: "#8a3d00" },
  beta: "#0072b2",
  gamma: "#cc79a7",
  tangential: "#56b4e9",
  ink: "#1b2430",
  quiet: "#566270",
  grid: "#e6eaee",
} as const;
