// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/contact/gauss_rules.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>

namespace clatter::numeric {
namespace {

using Rule = std::array<GaussNode, most_gauss_nodes>;

/// Legendre's polynomial P_n and its derivative at x, |x| < 1.
struct Legendre {
  double value, slope;
};

Legendre legendre(int n, double x) {
  double before = 1, value = x;
  for (int k = 2; k <= n; ++k) {
    const double next = ((2 * k - 1) * x * value - (k - 1) * before) / k;
    before = value;
    value = next;
  }
  return {value, n * (before - x * value) / (1 - x * x)};
}

/// Newton's method from Tricomi's guess.
Rule make_rule(int n) {
  Rule rule{};
  for (int i = 0; i < n; ++i) {
    double x = -std::cos(std::numbers::pi * (i + 0.75) / (n + 0.5));
    for (int pass = 0; pass < 10; ++pass) {
      const Legendre p = legendre(n, x);
      x -= p.value / p.slope;
    }
    if (2 * i + 1 == n) x = 0;
    const double slope = legendre(n, x).slope;
    rule[i] = {x, 2 / ((1 - x * x) * slope * slope)};
  }
  return rule;
}

std::array<Rule, most_gauss_nodes + 1> make_rules() {
  std::array<Rule, most_gauss_nodes + 1> rules{};
  for (int n = 1; n <= most_gauss_nodes; ++n) rules[n] = make_rule(n);
  return rules;
}

}  // namespace

std::span<const GaussNode> gauss_rule(int n) {
  assert(1 <= n && n <= most_gauss_nodes);
  static const std::array<Rule, most_gauss_nodes + 1> rules = make_rules();
  return {rules[n].data(), static_cast<std::size_t>(n)};
}

int gauss_order(double ellipse, double digits) {
  constexpr int for_polynomial = 2;
  const double wanted = std::ceil(digits * std::numbers::ln10 / (2 * std::log(ellipse))) + for_polynomial;
  return wanted < most_gauss_nodes ? std::max(static_cast<int>(wanted), for_polynomial + 1) : most_gauss_nodes;
}

}  // namespace clatter::numeric
