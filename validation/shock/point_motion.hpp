// SPDX-License-Identifier: GPL-3.0-or-later
// The motion of a point of a rigid body, from the forces of the simulator, and its dense history.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "numeric/drop/history_pieces.hpp"

namespace clatter::validation {

// A quantity over a piece of a history, as the polynomial through its samples.

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

using numeric::Vector3;

/// What an accelerometer at the body's point r (from the centre of mass, body frame) reads, in body axes [m/s²]:
///     s = Aᵀ F/m + ω̇′ × r + ω′ × (ω′ × r),
/// the acceleration of the point less that of free fall.  Forces and ω̇′ are those of the equations of motion; nothing
/// is differenced.
[[nodiscard]] Vector3 specific_force(const numeric::PieceSample& at, const Vector3& r, double mass);

/// One piece of the history, which keeps its samples.
struct MotionPiece {
  numeric::HistoryPiece piece;  ///< without its span
  std::vector<numeric::PieceSample> samples;

  [[nodiscard]] double begin() const { return piece.origin + piece.start; }  ///< after the first touch-down [s]
};

/// The components of a vector over a piece.
using VectorPolynomial = std::array<ChebyshevPolynomial, 3>;
[[nodiscard]] Vector3 value_at(const VectorPolynomial& vector, double x);
/// The polynomial of `value(sample)`, a vector.
[[nodiscard]] VectorPolynomial polynomial_of(const MotionPiece& piece, const auto& value) {
  std::array<Samples, 3> samples{};
  for (std::size_t j = 0; j < sample_count; ++j) {
    const Vector3 v = value(piece.samples[j]);
    for (int i = 0; i < 3; ++i) samples[static_cast<std::size_t>(i)][j] = v[i];
  }
  return {ChebyshevPolynomial(samples[0]), ChebyshevPolynomial(samples[1]), ChebyshevPolynomial(samples[2])};
}

/// Keeps a drop's pieces.
class MotionRecorder {
 public:
  void operator()(const numeric::HistoryPiece& piece);
  [[nodiscard]] const std::vector<MotionPiece>& pieces() const { return pieces_; }

 private:
  std::vector<MotionPiece> pieces_;
};

}  // namespace clatter::validation
