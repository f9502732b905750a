// SPDX-License-Identifier: GPL-3.0-or-later
// Changes of units by powers of two.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>

namespace clatter::analytic::detail {

/// Powers of length, speed and mass.
struct Dimension {
  int length, speed, mass;
};
namespace of {
inline constexpr Dimension length{1, 0, 0}, area{2, 0, 0}, time{1, -1, 0}, rate{-1, 1, 0}, speed{0, 1, 0},
    slowness{0, -1, 0}, acceleration{-1, 2, 0}, mass{0, 0, 1}, inertia{2, 0, 1}, impulse{0, 1, 1},
    angular_impulse{1, 1, 1}, energy{0, 2, 1};
}  // namespace of

/// Multiplies doubles, vectors and matrices by a unit that is a power of two: exactly, but for what leaves the normal
/// doubles, which is rounded once.
struct Scales {
  int length, speed, mass;  ///< exponents of two of these units

  [[nodiscard]] Scales inverse() const { return {-length, -speed, -mass}; }

  template <class... Numbers>
  void operator()(const Dimension& of, Numbers&... numbers) const {
    const int exponent = of.length * length + of.speed * speed + of.mass * mass;
    (scale(numbers, exponent), ...);
  }

 private:
  /// As std::ldexp, by a product where the factor is a normal double.
  static void scale(double& value, int exponent) {
    if (std::abs(exponent) > 1022) {
      value = std::ldexp(value, exponent);
      return;
    }
    constexpr int bias = 1023, fraction_bits = 52;
    value *= std::bit_cast<double>(static_cast<std::uint64_t>(exponent + bias) << fraction_bits);
  }
  static void scale(auto& value, int exponent) {
    for (auto* x = value.data(); x != value.data() + value.size(); ++x) scale(*x, exponent);
  }
};

}  // namespace clatter::analytic::detail
