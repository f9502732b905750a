// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/base/angle.hpp"

#include <boost/math/constants/constants.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

using clatter::analytic::acute_angle;
using clatter::analytic::Angle;
using Exact = boost::multiprecision::cpp_bin_float_50;

namespace {

double ulps(double value, const Exact& exact) {
  const double nearest = static_cast<double>(exact);
  const double ulp = std::nextafter(std::fabs(nearest), INFINITY) - std::fabs(nearest);
  return static_cast<double>(abs(Exact(value) - exact)) / ulp;
}

}  // namespace

BOOST_AUTO_TEST_CASE(flat_and_upright_are_exact_in_degrees) {
  BOOST_TEST(Angle::from_degrees(0).sine == 0);
  BOOST_TEST(Angle::from_degrees(90).cosine == 0);
  BOOST_TEST(Angle::from_degrees(90).sine == 1);
  BOOST_TEST(Angle::from_degrees(-90).sine == -1);
}

BOOST_AUTO_TEST_CASE(degrees_are_converted_to_within_two_ulp) {
  constexpr double tolerance = 2;  // ulp: one rounding of the argument, one of the function
  std::mt19937_64 random(1);
  const Exact per_degree = boost::math::constants::pi<Exact>() / 180;
  for (int i = 0; i < 20000; ++i) {
    const double degrees = std::uniform_real_distribution<>(0, 90)(random);
    const Angle angle = Angle::from_degrees(degrees);
    const Exact exact = Exact(degrees) * per_degree;
    BOOST_REQUIRE(ulps(angle.radians, exact) <= 1);
    BOOST_REQUIRE(ulps(angle.sine, sin(exact)) <= tolerance);
    BOOST_REQUIRE(ulps(angle.cosine, cos(exact)) <= tolerance);
  }
}

BOOST_AUTO_TEST_CASE(the_acute_angle_of_a_line_lies_between_0_and_90_degrees) {
  BOOST_TEST(acute_angle(-0.25) == 0.25);
  BOOST_TEST(std::fabs(acute_angle(3) - (clatter::analytic::pi - 3)) <= 1e-15);
}

BOOST_AUTO_TEST_CASE(an_angle_that_is_not_finite_is_refused) {
  BOOST_CHECK_THROW(static_cast<void>(Angle::from_degrees(NAN)), std::domain_error);
  BOOST_CHECK_THROW(static_cast<void>(Angle::from_radians(INFINITY)), std::domain_error);
}
