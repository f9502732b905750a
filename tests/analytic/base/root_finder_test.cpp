// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/base/root_finder.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

namespace {

using namespace clatter::analytic::detail;

double root_of(const auto& f, const Bracket& bracket, double guess, bool rising) {
  return bracketed_root(FunctionView(f), bracket, guess, rising).value;
}

}  // namespace

BOOST_AUTO_TEST_CASE(newtons_steps_from_one_side_of_the_root_to_the_other_end) {
  // Newton's method on 90.2 x − 36.4 x³ + 10.2 x⁵ is drawn to ±1: f(1) = 2 f′(1), and 2 f″/f′ = −0.9 there.
  const auto f = [](double x) {
    const double y = x * x;
    return Sample{x * (90.2 - 36.4 * y + 10.2 * y * y), 90.2 - 109.2 * y + 51 * y * y, 1e-16};
  };
  for (const double guess : {1.1, -1.1, 1.05, 1.001}) {
    BOOST_TEST(std::fabs(root_of(f, {-1.3, 1.2}, guess, true)) <= 1e-16);
  }
}

BOOST_AUTO_TEST_CASE(a_root_of_a_smooth_function_is_right_to_the_last_digit) {
  const auto f = [](double x) { return Sample{std::exp(x) - 2, std::exp(x), 0}; };
  for (const double guess : {-3.0, 0.1, 0.69, 5.0}) {
    BOOST_TEST(std::fabs(root_of(f, {-10, 10}, guess, true) - 0.693147180559945309) <= 2e-16);
  }
}
