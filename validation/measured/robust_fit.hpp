// SPDX-License-Identifier: GPL-3.0-or-later
// Parameters that make the sum of bounded or slowly growing losses least, with confidence from the items' scatter.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

namespace clatter::validation {

/// The loss of each item (a drop, say) for given parameters.
using Losses = std::function<Eigen::VectorXd(const Eigen::VectorXd& parameters)>;

struct FitStart {
  std::vector<double> value;
  std::vector<double> step;  ///< size of the first simplex, and twenty times the step of derivatives
};

struct RobustFit {
  Eigen::VectorXd value;
  /// The jackknife's covariance: without item i the parameters move by (Σ H − H_i)⁻¹ g_i to first order, g and H an
  /// item's first and second derivatives by central differences; NaN where Σ H is not positive definite.
  Eigen::MatrixXd covariance;
  Eigen::VectorXd losses;  ///< of each item at `value`

  [[nodiscard]] double loss() const { return losses.mean(); }
  /// Half the width of a parameter's 95 % interval, by Student's distribution.
  [[nodiscard]] double half_width(int parameter) const;
};

/// Least mean loss by the simplex of Nelder and Mead (GSL).  Losses need no derivatives: friction's have kinks.
/// @throws NumericalError if the simplex does not shrink to 1e-6 of its first size in 2000 steps.
[[nodiscard]] RobustFit fit_robustly(const Losses& losses, const FitStart& start);

/// s² (√(1 + (r/s)²) − 1): r²/2 for small r, s |r| for large ones.
[[nodiscard]] double pseudo_huber(double r, double s);

/// Mean of a − b, item by item, and its standard error: whether one model beats another on the same items.
struct PairedDifference {
  double mean = 0;
  double error = 0;
  [[nodiscard]] bool is_clear() const { return std::abs(mean) > 1.96 * error; }
};
[[nodiscard]] PairedDifference paired_difference(const Eigen::VectorXd& a, const Eigen::VectorXd& b);

}  // namespace clatter::validation
