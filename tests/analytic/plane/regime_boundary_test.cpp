// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/plane/contact_angles.hpp"
#include "tests/support.hpp"
#include "validation/oracles/rod_oracle.hpp"

namespace {

using namespace clatter::analytic;

constexpr double printed = 6e-13;  // [°] half a unit of the last digit given

double degrees(double radians) { return radians * degrees_per_radian; }

}  // namespace

BOOST_AUTO_TEST_CASE(the_second_impact_ends_in_a_fold_at_58_488442288312_degrees_and_the_third_at_27_577809606636) {
  const RegimeBoundary second = regime_boundary(ImpactNumber::second, {}),
                       third = regime_boundary(ImpactNumber::third, {});
  BOOST_CHECK((second.kind == BoundaryKind::fold && third.kind == BoundaryKind::fold));
  BOOST_TEST(std::fabs(degrees(second.theta) - 58.488442288312) <= printed);
  BOOST_TEST(std::fabs(degrees(second.beta) - 86.701384197437) <= printed);
  BOOST_TEST(second.uncertainty <= 1e-14);
  BOOST_TEST(std::fabs(degrees(third.theta) - 27.577809606636) <= printed);
  BOOST_TEST(std::fabs(degrees(third.beta) - 15.682060152257) <= 2 * printed);
  BOOST_TEST(std::fabs(degrees(third.gamma) - 63.128123330456) <= 2 * printed);
}

BOOST_AUTO_TEST_CASE(without_gravity_every_fold_solves_the_grazing_condition) {
  // sin θ + K (θ + arccos K) − √(1 − K²) = 0 with K = [e − 3c² + 3 μ_i s c]/[3 (1+e)(c − μ_i s)], from
  // Eq. 9 with e and μ_i, evaluated in 50 digits at the double returned.
  using Exact = boost::multiprecision::cpp_bin_float_50;
  for (const double e : {0.3, 0.6, 0.9, 1.0}) {
    for (const double mu : {-0.2, 0.0, 0.25}) {
      const RegimeBoundary b = regime_boundary(ImpactNumber::second, {.restitution = e, .impulse_ratio = mu});
      BOOST_REQUIRE(b.kind == BoundaryKind::fold);
      const auto graze = [&](const Exact& t) {
        const Exact s = sin(t), c = cos(t);
        const Exact k = (e - 3 * c * c + 3 * mu * s * c) / (3 * (1 + Exact(e)) * (c - mu * s));
        return Exact(s + k * (t + acos(k)) - sqrt(1 - k * k));
      };
      const Exact t(b.theta), h("1e-20");
      const Exact error = graze(t) / ((graze(t + h) - graze(t - h)) / (2 * h));
      BOOST_TEST(std::fabs(static_cast<double>(error)) <= 4 * 2.2e-16);  // 4 ulp at 1 rad
    }
  }
}

/// Gravity, which brings the end down later, moves the fold without gravity by as little as it is weak.
BOOST_AUTO_TEST_CASE(with_weak_gravity_the_second_impact_still_ends_in_a_fold) {
  const RegimeBoundary free = regime_boundary(ImpactNumber::second, {});
  for (const double g : {1e-8, 1e-6, 1e-4}) {
    const RegimeBoundary b = regime_boundary(ImpactNumber::second, {.gravity_number = g});
    BOOST_CHECK(b.kind == BoundaryKind::fold);
    // The gravity term of Eq. 12 is G φ²/Ω² with φ, 1/Ω of order 1, and so are the derivatives at a fold.
    BOOST_TEST(std::fabs(b.theta - free.theta) <= 10 * g);
  }
}

BOOST_AUTO_TEST_CASE(with_strong_gravity_or_without_rebound_the_second_impact_ends_upright) {
  const RegimeBoundary strong = regime_boundary(ImpactNumber::second, {.gravity_number = 1});
  BOOST_CHECK(strong.kind == BoundaryKind::upright);
  BOOST_TEST(std::fabs(degrees(strong.beta) - 90) <= 1e-9);
  // V_1 = -3 c²/(1 + 3 c²) |v_n| < 0 below the upright: the rod goes on falling and lands on its other end.
  const RegimeBoundary plastic = regime_boundary(ImpactNumber::second, {.restitution = 0});
  BOOST_TEST(std::fabs(plastic.theta - pi / 2) <= 1e-7);
  BOOST_TEST(plastic.uncertainty >= 0);
}

/// b stays down after its impact, which keeps the angular momentum about b: I Ω₁ + ½ m L cos β V₁, 0 there.
BOOST_AUTO_TEST_CASE(without_rebound_the_third_impact_ends_where_the_second_stops_the_rod) {
  const RodParameters plastic{.restitution = 0};
  const RegimeBoundary b = regime_boundary(ImpactNumber::third, plastic);
  BOOST_CHECK(b.kind == BoundaryKind::stop);
  const double c = std::cos(b.theta), first = 1 / (1 + 3 * c * c);
  const double velocity = first - 1, spin = 6 * c * first;  // of the centre, for L = |v_n| = 1
  BOOST_TEST(std::fabs(spin / 12 + std::cos(b.beta) / 2 * velocity) <= 1e-12);
  BOOST_TEST(degrees(b.gamma) < 1);
}

/// Rounding decides between the two kinds where the third is lost with the second.
BOOST_AUTO_TEST_CASE(a_third_impact_that_is_lost_with_the_second_ends_as_that_does) {
  for (double g = 9; g <= 11; g += 0.125) {
    const RodParameters rod{.gravity_number = g};
    const RegimeBoundary second = regime_boundary(ImpactNumber::second, rod),
                         third = regime_boundary(ImpactNumber::third, rod);
    BOOST_CHECK(second.kind == BoundaryKind::order && third.kind == second.kind);
    BOOST_TEST(third.theta == second.theta);
  }
}

BOOST_AUTO_TEST_CASE(the_impact_happens_just_below_a_boundary_and_not_just_above) {
  for (const double g : {0.0, 0.03, 0.5, 2.0, 20.0}) {
    const RodParameters rod{.gravity_number = g};
    const RegimeBoundary b = regime_boundary(ImpactNumber::second, rod);
    BOOST_REQUIRE(b.kind != BoundaryKind::never);
    BOOST_TEST(contact_angles(Angle::from_radians(b.theta * (1 - 1e-12)), rod).impacts() >= 2);
    BOOST_TEST(contact_angles(Angle::from_radians(b.theta * (1 + 1e-12)), rod).impacts() == 1);
  }
}

BOOST_AUTO_TEST_CASE(the_printed_gravity_term_gives_the_angles_that_refute_it) {
  constexpr double shown = 0.005;  // [°] digits of the values known beforehand
  const Angle theta = Angle::from_degrees(20);
  BOOST_TEST(std::fabs(degrees(contact_angles(theta, {.gravity_number = 9.81}).beta.angle) - 3.1820) <= 5e-5);
  BOOST_TEST(std::fabs(degrees(contact_angle_as_printed(theta, 9.81).angle) - 25.99) <= shown);
  BOOST_TEST(std::fabs(degrees(contact_angle_as_printed(theta, -9.81).angle) - 5.97) <= shown);
}

BOOST_AUTO_TEST_CASE(a_root_takes_at_most_20_evaluations_and_8_in_the_median) {
  std::vector<int> counts;
  for (double t = 1e-6; t < 58.4884; t += 0.01)
    counts.push_back(contact_angles(Angle::from_degrees(t), {}).beta.evaluations);
  for (double apart = 1e-15; apart < 1e-2; apart *= 1.1) {
    const ContactAngle beta =
        contact_angles(Angle::from_radians(regime_boundary(ImpactNumber::second, {}).theta - apart), {}).beta;
    counts.push_back(beta.evaluations);
  }
  std::sort(counts.begin(), counts.end());
  BOOST_TEST(counts.back() <= 20);
  BOOST_TEST(counts[counts.size() / 2] <= 8);
}

BOOST_AUTO_TEST_CASE(parameters_out_of_range_are_refused) {
  const Angle theta = Angle::from_degrees(10);
  for (const RodParameters& rod : {RodParameters{.gravity_number = -1}, {.gravity_number = NAN}, {.restitution = 1.1}})
    CHECK_REFUSED(contact_angles(theta, rod), std::domain_error);
  for (const double angle : {90.1, -1e-300})
    CHECK_REFUSED(contact_angles(Angle::from_degrees(angle), {}), std::domain_error);
}
