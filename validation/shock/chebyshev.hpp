// SPDX-License-Identifier: GPL-3.0-or-later
// A quantity over a piece of a history, as the polynomial through its samples.
#pragma once

#include <array>
#include <cstddef>

#include "numeric/drop/history_pieces.hpp"

namespace clatter::validation {

inline constexpr std::size_t sample_count = numeric::piece_points;
using Samples = std::array<double, sample_count>;

/// p(x) = Σ c_k T_k(2x − 1), x in [0, 1], with p(piece_point(j)) = samples[j].
class ChebyshevPolynomial {
 public:
  ChebyshevPolynomial() = default;
  explicit ChebyshevPolynomial(const Samples& samples);
  [[nodiscard]] static ChebyshevPolynomial of_coefficients(const Samples& coefficients);

  /// By Clenshaw's recurrence.  Accuracy: some eps of Σ|c_k|.
  [[nodiscard]] double at(double x) const;
  /// ∫ p dx from 0 to 1.
  [[nodiscard]] double integral() const;
  /// dp/dx.
  [[nodiscard]] ChebyshevPolynomial derivative() const;
  /// |c_7| + |c_8|: where the coefficients fall, a bound on how far the polynomial is from what was sampled; where they
  /// do not, as at a kink, the size of that.
  [[nodiscard]] double tail() const;

 private:
  Samples coefficients_{};
};

}  // namespace clatter::validation
