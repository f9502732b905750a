// SPDX-License-Identifier: GPL-3.0-or-later
// Gauss–Legendre rules.
#pragma once

#include <span>

namespace clatter::numeric {

struct GaussNode {
  double at;      ///< in (−1, 1)
  double weight;  ///< their sum is 2
};

inline constexpr int most_gauss_nodes = 24;

/// The rule of n nodes, 1 <= n <= most_gauss_nodes, exact for polynomials of degree 2n − 1; nodes and weights right to
/// some eps.
[[nodiscard]] std::span<const GaussNode> gauss_rule(int n);

/// The n for which the rule's error ρ^(−2n), of a function that is analytic within the Bernstein ellipse of parameter
/// ρ > 1 but for a factor that is a polynomial of degree 4, is below 10^−digits.  At most most_gauss_nodes.
[[nodiscard]] int gauss_order(double ellipse, double digits = 15);

}  // namespace clatter::numeric
