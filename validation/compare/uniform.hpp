// SPDX-License-Identifier: GPL-3.0-or-later
// Uniform random numbers that do not depend on the library's distributions.
#pragma once

#include <cmath>
#include <cstdint>
#include <random>

namespace clatter::validation {

/// Random numbers of member `index` of the random family `seed`.
class Uniform {
 public:
  Uniform(std::uint64_t seed, int index) : engine_(seed + 1'000'003ULL * static_cast<std::uint64_t>(index)) {}
  double operator()(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53;
  }
  double logarithmic(double low, double high) { return std::exp((*this)(std::log(low), std::log(high))); }
  bool one_in(int n) { return (*this)(0, n) < 1; }

 private:
  std::mt19937_64 engine_;
};

}  // namespace clatter::validation
