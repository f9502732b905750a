// SPDX-License-Identifier: GPL-3.0-or-later
// The table [sweep] of a scene file.
#pragma once

#include <optional>
#include <string>

#include "validation/scene/scene.hpp"
#include "validation/scene/scene_values.hpp"

namespace clatter::validation {

/// The sweep of a file, if it has one: under "sweep" a quantity's name with
///     [A, B, ...]                                    these values, in their order
///     { from = A, to = B, step = S }                 A, A + S, ... as far as B
///     { from = A, to = B, count = N }                N values at equal distances, both ends taken
///     { from = A, to = B, count = N, scale = "log" } N values with equal ratios, A > 0
/// @throws BadInput naming the key, what was given and what is allowed.
[[nodiscard]] std::optional<SceneSweep> read_sweep_table(const SceneValues& values);

/// Leaves out all that the file says of the sweep of `name`.
void drop_sweep(SceneValues& values, const std::string& name);

}  // namespace clatter::validation
