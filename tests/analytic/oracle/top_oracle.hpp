// A free top by Taylor series of Euler's equations and of the Euler parameters, in any arithmetic.
// Shares nothing with the closed form that it judges.
#pragma once

#include <array>
#include <cmath>
#include <vector>

namespace oracle {

/// Attitude q (body to world, scalar first) and angular velocity w in body axes, which are principal.
template <class Real>
struct Top {
  std::array<Real, 3> moments{};
  std::array<Real, 4> q{};
  std::array<Real, 3> w{};
};

template <class Real>
class TopSeries {
 public:
  explicit TopSeries(int order) : order_(order) {
    for (auto* part : {&w_[0], &w_[1], &w_[2], &q_[0], &q_[1], &q_[2], &q_[3]})
      part->resize(static_cast<std::size_t>(order) + 1);
  }

  void step(Top<Real>& top, Real h) {
    expand(top);
    evaluate(top, h);
  }

  /// The motion h after the state that was expanded last.
  void evaluate(Top<Real>& top, Real h) const {
    for (std::size_t k = 0; k < 3; ++k) top.w[k] = sum(w_[k], h);
    for (std::size_t k = 0; k < 4; ++k) top.q[k] = sum(q_[k], h);
  }

  void expand(const Top<Real>& top) {
    const auto& i = top.moments;
    const Real a[3] = {(i[1] - i[2]) / i[0], (i[2] - i[0]) / i[1], (i[0] - i[1]) / i[2]};
    for (std::size_t k = 0; k < 3; ++k) w_[k][0] = top.w[k];
    for (std::size_t k = 0; k < 4; ++k) q_[k][0] = top.q[k];
    for (int n = 0; n < order_; ++n) {
      const Real next = n + 1;
      const auto at = static_cast<std::size_t>(n) + 1;
      w_[0][at] = a[0] * product(w_[1], w_[2], n) / next;
      w_[1][at] = a[1] * product(w_[2], w_[0], n) / next;
      w_[2][at] = a[2] * product(w_[0], w_[1], n) / next;
      const Real half = 2 * next;
      q_[0][at] = (0 - product(q_[1], w_[0], n) - product(q_[2], w_[1], n) - product(q_[3], w_[2], n)) / half;
      q_[1][at] = (product(q_[0], w_[0], n) + product(q_[2], w_[2], n) - product(q_[3], w_[1], n)) / half;
      q_[2][at] = (product(q_[0], w_[1], n) + product(q_[3], w_[0], n) - product(q_[1], w_[2], n)) / half;
      q_[3][at] = (product(q_[0], w_[2], n) + product(q_[1], w_[1], n) - product(q_[2], w_[0], n)) / half;
    }
  }

 private:
  using Coefficients = std::vector<Real>;
  static Real product(const Coefficients& x, const Coefficients& y, int n) {
    Real sum = 0;
    for (int k = 0; k <= n; ++k) sum += x[static_cast<std::size_t>(k)] * y[static_cast<std::size_t>(n - k)];
    return sum;
  }
  static Real sum(const Coefficients& x, Real h) {
    Real value = 0;
    for (std::size_t k = x.size(); k-- > 0;) value = value * h + x[k];
    return value;
  }

  int order_;
  std::array<Coefficients, 3> w_;
  std::array<Coefficients, 4> q_;
};

}  // namespace oracle
