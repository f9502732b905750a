// SPDX-License-Identifier: GPL-3.0-or-later
// The project's palette, validation/output/palette.hpp, whose colours colour-blind eyes tell apart (Okabe and Ito). A second mark
// always goes with them: a solid body or an outline, a dash, a word.  What has no meaning of its own follows the theme.

export const isDark = matchMedia("(prefers-color-scheme: dark)").matches;
// All that is drawn is drawn anew; the address has the state.
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => location.reload());

const THEME = isDark
  ? { blow: { discrete: "#9fd2f2", continuous: "#ffb27f" }, ink: "#e6ebf0", quiet: "#9aa7b4", grid: "#2b3640", paper: "#161d24", floor: 0x2f6f5f }
  : { blow: { discrete: "#0a3d62", continuous: "#8a3d00" }, ink: "#1b2430", quiet: "#566270", grid: "#e6eaee", paper: "#ffffff", floor: 0x8fbfb0 };

export const COLOURS = {
  discrete: "#0072b2",
  continuous: "#d55e00",
  ground: "#009e73",
  beta: "#0072b2",
  gamma: "#cc79a7",
  speed: "#e69f00",
  tangential: "#56b4e9",
  ...THEME,
} as const;
