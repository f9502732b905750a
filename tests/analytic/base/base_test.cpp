// SPDX-License-Identifier: GPL-3.0-or-later
#include <boost/math/constants/constants.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>

#include "analytic/base/angle.hpp"
#include "analytic/base/root_finder.hpp"
#include "tests/support.hpp"

using namespace clatter::analytic;
using namespace clatter::analytic::detail;
using namespace clatter::test;
using Exact = boost::multiprecision::cpp_bin_float_50;

namespace {

double root_of(const auto& f, const Bracket& bracket, double guess) {
  return bracketed_root(FunctionView(f), bracket, guess, true).value;
}

}  // namespace

BOOST_AUTO_TEST_CASE(degrees_are_converted_to_within_two_ulp_and_exactly_where_flat_and_upright) {
  constexpr double tolerance = 2;  // ulp: one rounding of the argument, one of the function
  BOOST_TEST((Angle::from_degrees(0).sine == 0 && Angle::from_degrees(90).cosine == 0));
  BOOST_TEST((Angle::from_degrees(90).sine == 1 && Angle::from_degrees(-90).sine == -1));
  Random random(1);
  const Exact per_degree = boost::math::constants::pi<Exact>() / 180;
  for (int i = 0; i < 2000; ++i) {
    const double degrees = random(0, 90);
    const Angle angle = Angle::from_degrees(degrees);
    const Exact exact = Exact(degrees) * per_degree;
    BOOST_REQUIRE(ulps(angle.radians, exact) <= 1);
    BOOST_REQUIRE(ulps(angle.sine, Exact(sin(exact))) <= tolerance);
    BOOST_REQUIRE(ulps(angle.cosine, Exact(cos(exact))) <= tolerance);
  }
}

BOOST_AUTO_TEST_CASE(the_acute_angle_of_a_line_lies_between_0_and_90_degrees) {
  BOOST_TEST(acute_angle(-0.25) == 0.25);
  BOOST_TEST(std::fabs(acute_angle(3) - (pi - 3)) <= 1e-15);
}

BOOST_AUTO_TEST_CASE(an_angle_that_is_not_finite_is_refused) {
  CHECK_REFUSED(Angle::from_degrees(NAN), std::domain_error);
  CHECK_REFUSED(Angle::from_radians(INFINITY), std::domain_error);
}

BOOST_AUTO_TEST_CASE(newtons_steps_from_one_side_of_the_root_to_the_other_end) {
  // Newton's method on 90.2 x − 36.4 x³ + 10.2 x⁵ is drawn to ±1: f(1) = 2 f′(1), and 2 f″/f′ = −0.9 there.
  const auto f = [](double x) {
    const double y = x * x;
    return Sample{x * (90.2 - 36.4 * y + 10.2 * y * y), 90.2 - 109.2 * y + 51 * y * y, 1e-16};
  };
  for (const double guess : {1.1, -1.1, 1.05, 1.001}) BOOST_TEST(std::fabs(root_of(f, {-1.3, 1.2}, guess)) <= 1e-16);
}

BOOST_AUTO_TEST_CASE(a_root_of_a_smooth_function_is_right_to_the_last_digit) {
  const auto f = [](double x) { return Sample{std::exp(x) - 2, std::exp(x), 0}; };
  for (const double guess : {-3.0, 0.1, 0.69, 5.0})
    BOOST_TEST(std::fabs(root_of(f, {-10, 10}, guess) - std::numbers::ln2) <= 2e-16);
}
