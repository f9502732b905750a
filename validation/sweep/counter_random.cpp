// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/sweep/counter_random.hpp"

#include <Random123/philox.h>

namespace clatter::validation {
namespace {

std::uint32_t high(std::uint64_t number) { return static_cast<std::uint32_t>(number >> 32); }
std::uint32_t low(std::uint64_t number) { return static_cast<std::uint32_t>(number); }

}  // namespace

double uniform_at(std::uint64_t seed, std::uint64_t scene, std::uint32_t column, std::uint32_t draw) {
  const auto words = r123::Philox4x32{}({{low(scene), high(scene), column, draw}}, {{low(seed), high(seed)}});
  const std::uint64_t bits = (std::uint64_t{words[0]} << 32 | words[1]) >> 11;
  return static_cast<double>(bits) * 0x1p-53;
}

}  // namespace clatter::validation
