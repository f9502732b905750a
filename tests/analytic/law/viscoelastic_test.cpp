// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/law/viscoelastic.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "validation/oracles/digits.hpp"
#include "validation/oracles/impulse_path.hpp"

namespace {

using namespace clatter::analytic;
using Exact = clatter::oracle::Decimal<120>;
using clatter::oracle::exact_restitution;

double ulps(double value, const Exact& exact) {
  const double nearest = static_cast<double>(exact);
  return static_cast<double>(abs(Exact(value) - exact)) / (std::nextafter(nearest, INFINITY) - nearest);
}

}  // namespace

BOOST_AUTO_TEST_CASE(known_values_of_the_map) {
  constexpr double printed = 1e-12;  // digits to which these values were given
  BOOST_TEST(std::fabs(restitution_of_damping(0.1) - 0.937475579949905) <= 1e-15);
  BOOST_TEST(std::fabs(restitution_of_damping(1) - 0.593624260040) <= printed);
}

BOOST_AUTO_TEST_CASE(the_map_is_good_to_4_ulp_and_its_loss_to_8_from_1e_minus_12_to_1e6) {
  double worst = 0, worst_loss = 0;
  for (double s = 1e-12; s < 1e6; s *= 1.17) {
    const Exact exact = exact_restitution(Exact(s));
    worst = std::fmax(worst, ulps(restitution_of_damping(s), exact));
    worst_loss = std::fmax(worst_loss, ulps(restitution_loss_of_damping(s), 1 - exact));
  }
  BOOST_TEST_MESSAGE("worst error of e: " << worst << " ulp, of 1 - e: " << worst_loss << " ulp");
  BOOST_TEST(worst <= 4);
  BOOST_TEST(worst_loss <= 8);
}

BOOST_AUTO_TEST_CASE(the_inverse_is_good_to_4_ulp_plus_twice_its_condition) {
  for (double e = 1e-6; e < 1; e += 0.00317) {
    const double s = damping_of_restitution(e);
    // The exact e at the s returned differs from the e asked for by the error of s alone.
    const Exact error = exact_restitution(Exact(s)) - Exact(e);
    const Exact h = Exact(s) * Exact(1e-20);
    const Exact slope = (exact_restitution(Exact(s) + h) - exact_restitution(Exact(s) - h)) / (2 * h);
    const double condition = std::fabs(static_cast<double>(Exact(e) / (slope * Exact(s))));
    const double error_ulps = std::fabs(static_cast<double>(error / slope)) / (std::nextafter(s, INFINITY) - s);
    BOOST_REQUIRE_MESSAGE(error_ulps <= 4 + 2 * condition, "e = " << e << ": " << error_ulps << " ulp");
  }
}

BOOST_AUTO_TEST_CASE(the_ends_of_the_map_are_exact_and_values_beyond_refused) {
  BOOST_TEST(restitution_of_damping(0) == 1);
  BOOST_TEST(restitution_of_damping(std::numeric_limits<double>::infinity()) == 0);
  BOOST_TEST(restitution_loss_of_damping(1e-300) == 2e-300 / 3);
  BOOST_TEST(damping_of_restitution(1) == 0);
  BOOST_TEST(std::isinf(damping_of_restitution(0)));
  for (const double bad : {-1e-300, -1.0, std::nan("")}) {
    BOOST_CHECK_THROW(static_cast<void>(restitution_of_damping(bad)), std::domain_error);
    BOOST_CHECK_THROW(static_cast<void>(damping_of_restitution(bad)), std::domain_error);
  }
  BOOST_CHECK_THROW(static_cast<void>(damping_of_restitution(1.0000001)), std::domain_error);
}
