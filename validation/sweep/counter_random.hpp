// SPDX-License-Identifier: GPL-3.0-or-later
// Random numbers by their place instead of by their turn.
#pragma once

#include <cstdint>

namespace clatter::validation {

/// Number `column` of scene `scene` in the family `seed`, and where a column needs several its number `draw`: uniform
/// in [0, 1), a multiple of 2^-53, the same on every machine.  From Philox 4×32 with ten rounds (Salmon et al.,
/// Parallel random numbers: as easy as 1, 2, 3, 2011).
[[nodiscard]] double uniform_at(std::uint64_t seed, std::uint64_t scene, std::uint32_t column, std::uint32_t draw = 0);

}  // namespace clatter::validation
