// Random numbers by their place instead of by their turn.
#pragma once

#include <array>
#include <cstdint>

namespace clatter::validation {

/// Philox 4×32 with ten rounds (Salmon et al., Parallel random numbers: as easy as 1, 2, 3, 2011): a bijection of
/// 128-bit counters for each 64-bit key, the same on every machine.
[[nodiscard]] std::array<std::uint32_t, 4> philox(std::array<std::uint32_t, 4> counter,
                                                  std::array<std::uint32_t, 2> key);

/// Number `column` of scene `scene` in the family `seed`: uniform in [0, 1), a multiple of 2^-53.
[[nodiscard]] double uniform_at(std::uint64_t seed, std::uint64_t scene, std::uint32_t column);

}  // namespace clatter::validation
