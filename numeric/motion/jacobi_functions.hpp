// SPDX-License-Identifier: GPL-3.0-or-later
// Jacobi's elliptic functions of one modulus, up to its very limit.
#pragma once

#include <array>

namespace clatter::numeric {

/// sn, cn, dn for a given complementary parameter k'² = 1 − k².
///
/// A double k cannot tell a body that turns almost about its intermediate axis from one that does so exactly:
/// there k'² falls to 1e-34 and below.  Everything here starts from k'² and keeps its relative accuracy.
class JacobiFunctions {
 public:
  /// @param complementary_parameter k'² in [1e-200, 1].
  explicit JacobiFunctions(double complementary_parameter);

  struct Values {
    double sn = 0, cn = 1, dn = 1;
  };
  /// Values at u in [-K, K].  By descending Gauss transformations, in a form without differences:
  ///     T_N = a_N cot(a_N u),  dn_N = 1,
  ///     z = T_{n+1}²/a_{n+1},  T_n = T_{n+1} dn_{n+1},  dn_n = (b_n + z)/(a_n + z),  T_0 = cn/sn
  /// with a_n, b_n the arithmetic and geometric means from 1 and k'.
  /// Accuracy: a few eps of each value, and what an error of eps K in u does to it.
  /// Source: Bulirsch, Numer. Math. 7 (1965) 78.
  [[nodiscard]] Values at(double u) const;

  /// K = F(π/2) = π / (2 a_N).
  [[nodiscard]] double quarter_period() const { return quarter_period_; }

  /// u with sn(u) = sine, cn(u) = cosine >= 0:  F = s R_F(c², c² + k'² s², 1), in [-K, K].
  struct Amplitude {
    double sine = 0, cosine = 1;
  };
  [[nodiscard]] double argument(const Amplitude& amplitude) const;

  /// ∫ cn²/(1 + h sn²) du from |u| to K, h >= 0, from the values at u in [-K, K]:
  ///     cn³/(3 (1 + h) k') R_J(sn², 1, dn²/k'², (1 + h sn²)/(1 + h)),
  /// measured from the end where the integrand is small.  Accuracy: a few eps of the result.
  [[nodiscard]] double remaining_integral(const Values& values, double h) const;

 private:
  static constexpr int most_means = 16;  // k'² = 1e-200 takes 12

  double complement_;
  int means_ = 0;
  std::array<double, most_means> arithmetic_{};
  std::array<double, most_means> geometric_{};
  double quarter_period_ = 0;
};

}  // namespace clatter::numeric
