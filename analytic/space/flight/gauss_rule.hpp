// SPDX-License-Identifier: GPL-3.0-or-later
// Gauss–Legendre rules as arrays, for integrands that are computed at all nodes at once.
#pragma once

#include <Eigen/Core>
#include <boost/math/quadrature/gauss.hpp>

namespace clatter::analytic::space {

/// On [−1, 1], nodes ascending.
template <int points>
struct GaussRule {
  using Array = Eigen::Array<double, points, 1>;
  Array nodes, weights;

  GaussRule() {
    using Gauss = boost::math::quadrature::gauss<double, points>;
    constexpr int above = points / 2, below = (points - 1) / 2;  // the middle node, or the two beside it
    for (int i = 0; i < points - above; ++i) {
      const auto k = static_cast<std::size_t>(i);
      nodes[above + i] = Gauss::abscissa()[k], weights[above + i] = Gauss::weights()[k];
      nodes[below - i] = -nodes[above + i], weights[below - i] = weights[above + i];
    }
  }
};

}  // namespace clatter::analytic::space
