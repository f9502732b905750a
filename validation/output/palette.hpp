// SPDX-License-Identifier: GPL-3.0-or-later
// The project's colours, for gnuplot; the page's and matplotlib's are the same ones, which a test compares.  Hues are
// those of Okabe and Ito, which colour-blind readers tell apart; classes and numbers also become darker from one to the
// next, so that they stay apart in grey.
#pragma once

#include <array>

namespace clatter::validation::palette {

inline constexpr const char *discrete = "#0072b2", *continuous = "#d55e00";
inline constexpr const char *beta = "#0072b2", *gamma = "#cc79a7";
inline constexpr const char *ground = "#009e73", *ink = "#222222", *sky = "#56b4e9", *ochre = "#e69f00";
/// Kinds of energy; what the ground stores has the ground's colour, the total is ink.
inline constexpr const char *translation = ochre, *rotation = "#7a2a5b", *potential = sky;

/// Classes in their order, such as numbers of impacts from 1 on.
inline constexpr std::array<const char*, 10> classes{"#fdf1c9", "#f4be55", "#56b4e9", "#e07b39", "#cc6fa0",
                                                     "#0b86a8", "#b03a00", "#0a5a8a", "#7a2a5b", "#0a3350"};
/// Infinitely many impacts; more than were followed; no such drop, or beyond the model; decided by rounding.
inline constexpr const char *infinite = "#14141f", *beyond = "#6b7280", *refused = "#d9d9d9", *open = "#ff2da0";

/// Numbers from the least to the greatest, in equal steps between which colours are mixed.
inline constexpr std::array<const char*, 6> numbers{"#0b1f4a", "#27508a", "#4f86a6", "#86b29b", "#cfd08a", "#fdf6c4"};

}  // namespace clatter::validation::palette
