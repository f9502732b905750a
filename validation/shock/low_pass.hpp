// SPDX-License-Identifier: GPL-3.0-or-later
// The low-pass filter of impact tests, for records and for computed histories alike.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "validation/shock/point_motion.hpp"

namespace clatter::validation {

/// Two passes, one forward and one backward, of a Butterworth filter with two poles, so that its phase is zero:
///     |H(f)| = 1/(1 + (tan(π f T)/tan(π f_d T))⁴),   T the distance of samples,                              (1)
///     y_i = a₀ (x_i + 2 x_{i−1} + x_{i−2}) + b₁ y_{i−1} + b₂ y_{i−2},                                         (2)
///     w = tan(π f_d T),   N = 1 + √2 w + w²,   a₀ = w²/N,   b₁ = 2 (1 − w²)/N,   b₂ = (−1 + √2 w − w²)/N.
/// Source: SAE J211-1 (MAR95), whose channel frequency class CFC has f_d = 2.0775 CFC; ISO 6487 has 25/12 CFC.
struct LowPass {
  double design = 0;         ///< f_d, at which each pass has 1/√2 [Hz], > 0
  double channel_class = 0;  ///< CFC; 0: a cut-off was given

  [[nodiscard]] static LowPass of_class(double channel_class);
  [[nodiscard]] static LowPass of_cut_off(double frequency);
  /// At which both passes together have 1/√2: f_d (√2 − 1)^(1/4) [Hz].
  [[nodiscard]] double cut_off() const;
  /// "CFC 1000", or "a low-pass of 1650 Hz".
  [[nodiscard]] std::string name() const;
  /// "CFC 1000 of SAE J211-1, ...".
  [[nodiscard]] std::string words() const;
  /// By (2) in both directions; the first and the last value count as lasting before and after.
  /// @param step  T [s], less than 1/(2 f_d).  @throws std::domain_error for one that is not
  [[nodiscard]] std::vector<Vector3> filtered(const std::vector<Vector3>& values, double step) const;
  /// Standard deviation that the filter leaves of independent readings with one of 1.
  [[nodiscard]] double noise_gain(double step) const;
};

/// What an accelerometer reads behind the filter, body axes [m/s²], at equal steps from `begin` on.
struct FilteredHistory {
  double begin = 0, step = 0;  ///< after the first touch-down [s]
  std::vector<Vector3> values;

  [[nodiscard]] double time(std::size_t i) const { return begin + step * static_cast<double>(i); }
  /// How far values may be from those of infinitely short steps, in parts of the largest: means over a step, steps of a
  /// filter, and a peak between two of them.
  static constexpr double relative_error = 2e-4;
};
/// Filters the means of the history at the point r over steps of 1/(200 f_d), exact on its polynomials; before and
/// after the pieces the base counts as unaccelerated, and the filter's own forerun and tail are in the result.
[[nodiscard]] FilteredHistory filtered_history(std::span<const MotionPiece> motion, const Vector3& r, double mass,
                                               const LowPass& filter);

}  // namespace clatter::validation
