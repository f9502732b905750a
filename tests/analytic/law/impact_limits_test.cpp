// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/law/impact_limits.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <random>

#include "analytic/base/angle.hpp"
#include "analytic/plane/impact.hpp"

namespace {

using namespace clatter::analytic;

constexpr double rounding = 20 * 2.2e-16;

ContactInertia rod_inertia(double theta) {
  const PlanarBody rod = make_rod({});
  return contact_inertia(rod.gyration_square, rod.contact_point(0, std::sin(theta), std::cos(theta)));
}

}  // namespace

BOOST_AUTO_TEST_CASE(the_sticking_ratio_of_the_rod_is_3sc_over_1_plus_3ss_and_at_most_three_quarters) {
  for (double t = 0.01; t < 1.57; t += 0.01) {
    const double s = std::sin(t), c = std::cos(t);
    BOOST_REQUIRE(std::fabs(sticking_ratio(rod_inertia(t)) - 3 * s * c / (1 + 3 * s * s)) <= rounding);
    BOOST_REQUIRE(sticking_ratio(rod_inertia(t)) <= 0.75 + rounding);
  }
  BOOST_TEST(std::fabs(sticking_ratio(rod_inertia(std::atan(0.5))) - 0.75) <= rounding);
  BOOST_TEST(std::fabs(sticking_ratio(rod_inertia(std::atan(1.0))) - 0.6) <= rounding);
}

BOOST_AUTO_TEST_CASE(the_rod_jams_from_four_thirds_on_at_tan_theta_2) {
  BOOST_TEST(std::fabs(jamming_ratio(rod_inertia(std::atan(2.0))) - 4.0 / 3) <= rounding);
  for (double t = 0.01; t < 1.57; t += 0.01) BOOST_REQUIRE(jamming_ratio(rod_inertia(t)) >= 4.0 / 3 - rounding);
  BOOST_TEST(std::isinf(jamming_ratio({.normal = 1, .coupling = 0, .tangential = 1})));
}

BOOST_AUTO_TEST_CASE(both_limits_of_brach_are_0_6_at_45_degrees) {
  const ContactInertia inertia = rod_inertia(std::atan(1.0));
  BOOST_TEST(std::fabs(slip_stopping_ratio(inertia, {}) - 0.6) <= rounding);
  BOOST_TEST(std::fabs(energy_neutral_ratio(inertia, {}) - 0.6) <= rounding);
  BOOST_TEST(std::fabs(admissible_ratio(inertia, {}) - 0.6) <= rounding);
}

BOOST_AUTO_TEST_CASE(an_impact_at_a_limit_does_what_the_limit_says) {
  std::mt19937_64 random(6);
  const auto uniform = [&](double low, double high) { return std::uniform_real_distribution<>(low, high)(random); };
  for (int i = 0; i < 5000; ++i) {
    const PlanarBody body{.mass = 1, .gyration_square = uniform(0.1, 1)};
    const ContactPoint d{uniform(-0.5, 0.5), uniform(-0.5, -0.05)};
    const double e = uniform(0, 1);
    const PlanarVelocity before{.normal = -1, .tangential = uniform(-0.4, 0.4)};
    const ContactInertia inertia = contact_inertia(body.gyration_square, d);
    const LimitState state{.approach_speed = 1, .slip = before.tangential, .restitution = e};
    const auto hit = [&](double ratio) {
      return strike(body, before, d,
                    {.restitution = e, .friction = FrictionKind::impulse_ratio, .friction_value = ratio});
    };
    constexpr double tolerance = 1e-11;  // rounding × 1/(1 − ratio/jamming limit) for the cases kept
    const double stopping = slip_stopping_ratio(inertia, state);
    if (inertia.normal - stopping * inertia.coupling > 0.05) {
      BOOST_REQUIRE(std::fabs(hit(stopping).slip_after) <= tolerance);
    }
    const auto [lower, upper] = energy_neutral_ratios(inertia, state);
    BOOST_REQUIRE(lower <= upper);
    for (const double ratio : {lower, upper}) {
      if (!(inertia.normal - ratio * inertia.coupling > 0.05)) continue;
      BOOST_REQUIRE(std::fabs(hit(ratio).energy_loss) <= tolerance);
    }
  }
}

BOOST_AUTO_TEST_CASE(a_ratio_beyond_the_limit_is_computed_as_asked_and_creates_energy) {
  const PlanarBody rod = make_rod({});
  const Angle theta = Angle::from_degrees(45);
  const Impact impact = strike(rod, {.normal = -1}, rod.contact_point(0, theta.sine, theta.cosine),
                               {.friction = FrictionKind::impulse_ratio, .friction_value = 0.7});
  BOOST_TEST(std::fabs(impact.normal_impulse - 2 / (2.5 - 1.05)) <= rounding);
  BOOST_TEST(impact.energy_loss < 0);
}
