// SPDX-License-Identifier: GPL-3.0-or-later
// A free top by Taylor series of Euler's equations and of the Euler parameters, in any arithmetic.
// Shares nothing with the closed forms that it judges.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace clatter::oracle {

/// Attitude q (body to world, scalar first) and angular velocity w in body axes, which are principal.
template <class Real>
struct Top {
  std::array<Real, 3> moments{};
  std::array<Real, 4> q{Real(1), 0, 0, 0};
  std::array<Real, 3> w{};
};

/// With steps of half a radian the series converges like 2⁻ⁿ or better.
template <class Real>
class TopSeries {
 public:
  explicit TopSeries(int order) : order_(static_cast<std::size_t>(order)) {
    for (auto& series : w_) series.resize(order_ + 1);
    for (auto& series : q_) series.resize(order_ + 1);
  }

  void step(Top<Real>& top, const Real& h) {
    expand(top);
    evaluate(top, h);
  }

  /// The motion h after the state that was expanded last.
  void evaluate(Top<Real>& top, const Real& h) const {
    for (std::size_t k = 0; k < 3; ++k) top.w[k] = sum(w_[k], h);
    for (std::size_t k = 0; k < 4; ++k) top.q[k] = sum(q_[k], h);
  }

  /// Recurrences for the coefficients.
  void expand(const Top<Real>& top) {
    const auto& m = top.moments;
    for (std::size_t k = 0; k < 3; ++k) w_[k][0] = top.w[k];
    for (std::size_t k = 0; k < 4; ++k) q_[k][0] = top.q[k];
    for (std::size_t n = 0; n < order_; ++n) {
      const Real next = static_cast<int>(n + 1), half = 2 * next;
      for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
        w_[i][n + 1] = (m[j] - m[k]) / m[i] * product(w_[j], w_[k], n) / next;
        q_[i + 1][n + 1] =
            (product(q_[0], w_[i], n) + product(q_[j + 1], w_[k], n) - product(q_[k + 1], w_[j], n)) / half;
      }
      q_[0][n + 1] = (0 - product(q_[1], w_[0], n) - product(q_[2], w_[1], n) - product(q_[3], w_[2], n)) / half;
    }
  }

 private:
  using Coefficients = std::vector<Real>;
  static Real product(const Coefficients& x, const Coefficients& y, std::size_t n) {
    Real sum = 0;
    for (std::size_t k = 0; k <= n; ++k) sum += x[k] * y[n - k];
    return sum;
  }
  /// Horner's rule.
  static Real sum(const Coefficients& x, const Real& h) {
    Real value = 0;
    for (std::size_t k = x.size(); k-- > 0;) value = value * h + x[k];
    return value;
  }

  std::size_t order_;
  std::array<Coefficients, 3> w_;
  std::array<Coefficients, 4> q_;
};

}  // namespace clatter::oracle
