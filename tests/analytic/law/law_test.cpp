// SPDX-License-Identifier: GPL-3.0-or-later
// Limits of the impulse ratio, and the restitution of a damped ground.
#include "analytic/law/impact_law.hpp"
#include "analytic/law/viscoelastic.hpp"
#include "analytic/plane/impact.hpp"
#include "tests/support.hpp"
#include "validation/oracles/digits.hpp"
#include "validation/oracles/impulse_path.hpp"

using namespace clatter::analytic;
using namespace clatter::test;
using clatter::oracle::exact_restitution;
using Exact = clatter::oracle::Decimal<120>;

namespace {

constexpr double rounding = 20 * eps;

ContactInertia rod_inertia(double theta) {
  const PlanarBody rod = make_rod({});
  return contact_inertia(rod.gyration_square, rod.contact_point(0, std::sin(theta), std::cos(theta)));
}

}  // namespace

BOOST_AUTO_TEST_CASE(the_rod_sticks_from_3sc_over_1_plus_3ss_on_and_jams_from_four_thirds_on_at_tan_theta_2) {
  for (double t = 0.01; t < 1.57; t += 0.01) {
    const double s = std::sin(t), c = std::cos(t);
    BOOST_REQUIRE(std::fabs(sticking_ratio(rod_inertia(t)) - 3 * s * c / (1 + 3 * s * s)) <= rounding);
    BOOST_REQUIRE(sticking_ratio(rod_inertia(t)) <= 0.75 + rounding);
    BOOST_REQUIRE(jamming_ratio(rod_inertia(t)) >= 4.0 / 3 - rounding);
  }
  BOOST_TEST(std::fabs(sticking_ratio(rod_inertia(std::atan(0.5))) - 0.75) <= rounding);
  BOOST_TEST(std::fabs(jamming_ratio(rod_inertia(std::atan(2.0))) - 4.0 / 3) <= rounding);
  BOOST_TEST(std::isinf(jamming_ratio({.normal = 1, .coupling = 0, .tangential = 1})));
}

BOOST_AUTO_TEST_CASE(sticking_and_both_limits_of_brach_are_0_6_at_45_degrees) {
  const ContactInertia inertia = rod_inertia(std::atan(1.0));
  for (const double limit : {sticking_ratio(inertia), slip_stopping_ratio(inertia, {}),
                             energy_neutral_ratio(inertia, {}), admissible_ratio(inertia, {})}) {
    BOOST_TEST(std::fabs(limit - 0.6) <= rounding);
  }
}

BOOST_AUTO_TEST_CASE(an_impact_at_a_limit_does_what_the_limit_says) {
  Random random(6);
  for (int i = 0; i < 1000; ++i) {
    const PlanarBody body{.mass = 1, .gyration_square = random(0.1, 1)};
    const ContactPoint d{random(-0.5, 0.5), random(-0.5, -0.05)};
    const double e = random(0, 1);
    const PlanarVelocity before{.normal = -1, .tangential = random(-0.4, 0.4)};
    const ContactInertia inertia = contact_inertia(body.gyration_square, d);
    const LimitState state{.approach_speed = 1, .slip = before.tangential, .restitution = e};
    const auto is_far = [&](double ratio) { return inertia.normal - ratio * inertia.coupling > 0.05; };
    const auto hit = [&](double ratio) {
      return strike(body, before, d,
                    {.restitution = e, .friction = FrictionKind::impulse_ratio, .friction_value = ratio});
    };
    constexpr double tolerance = 1e-11;  // rounding × 1/(1 − ratio/jamming limit) for the cases kept
    const double stopping = slip_stopping_ratio(inertia, state);
    if (is_far(stopping)) BOOST_REQUIRE(std::fabs(hit(stopping).slip_after) <= tolerance);
    const auto [lower, upper] = energy_neutral_ratios(inertia, state);
    BOOST_REQUIRE(lower <= upper);
    for (const double ratio : {lower, upper}) {
      if (is_far(ratio)) BOOST_REQUIRE(std::fabs(hit(ratio).energy_loss) <= tolerance);
    }
  }
}

BOOST_AUTO_TEST_CASE(the_map_of_damping_is_good_to_4_ulp_and_its_loss_to_8_from_1e_minus_12_to_1e6) {
  for (double s = 1e-12; s < 1e6; s *= 1.5) {
    const Exact exact = exact_restitution(Exact(s));
    BOOST_TEST_CONTEXT("s = " << s) {
      BOOST_TEST(ulps(restitution_of_damping(s), exact) <= 4);
      BOOST_TEST(ulps(restitution_loss_of_damping(s), Exact(1 - exact)) <= 8);
    }
  }
}

BOOST_AUTO_TEST_CASE(the_inverse_is_good_to_4_ulp_plus_twice_its_condition) {
  for (double e = 1e-6; e < 1; e += 0.00991) {
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
  BOOST_TEST(restitution_of_damping(infinite) == 0);
  BOOST_TEST(restitution_loss_of_damping(1e-300) == 2e-300 / 3);
  BOOST_TEST(damping_of_restitution(1) == 0);
  BOOST_TEST(std::isinf(damping_of_restitution(0)));
  for (const double bad : {-1e-300, -1.0, not_a_number}) {
    CHECK_REFUSED(restitution_of_damping(bad), std::domain_error);
    CHECK_REFUSED(damping_of_restitution(bad), std::domain_error);
  }
  CHECK_REFUSED(damping_of_restitution(1.0000001), std::domain_error);
}
