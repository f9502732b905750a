// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/near_flat/two_contacts.hpp"

#include "tests/support.hpp"

namespace {

using namespace clatter::analytic::near_flat;
using clatter::test::eps, clatter::test::Random;

/// Impulses/(m|v|) by nothing but Newton's law, z and φ: u = V − Ω d, P = −(1 + e) u/(1 + d²/κ²).
std::vector<long double> struck_by_hand(const TwoContacts& body, double e, End first, int most) {
  const long double k2 = static_cast<long double>(body.gyration) * body.gyration;
  const long double place[2] = {-static_cast<long double>(body.arm_a), body.arm_b};
  long double v = -1, spin = 0;
  std::vector<long double> impulses;
  for (int at = first == End::a ? 0 : 1; static_cast<int>(impulses.size()) < most; at = 1 - at) {
    const long double d = place[at], u = v - spin * d;
    if (!(u < 0)) return impulses;
    impulses.push_back(-(1 + e) * u / (1 + d * d / k2));
    v += impulses.back();
    spin -= d * impulses.back() / k2;
  }
  return impulses;
}

TwoContacts with_ratio(double square) { return {.arm_a = 1, .arm_b = 1, .gyration = 1 / std::sqrt(square)}; }

BOOST_AUTO_TEST_CASE(strikes_count_the_digits_of_half_pi) {
  // π/ψ + 1/2 with ψ = 2 arctan(10^-k): π/2 10^k + 1/2 less a part of 10^-k.
  const long long counts[] = {2, 16, 157, 1571, 15708, 157080, 1570796};
  double square = 1;
  for (const long long count : counts) {
    BOOST_CHECK_EQUAL(strike_count(with_ratio(square), 1, End::a).value(), count);
    square *= 100;
  }
  BOOST_CHECK_EQUAL(strikes(with_ratio(1e6), 1, End::b, 5000).size(), 1571u);
}

BOOST_AUTO_TEST_CASE(strikes_of_unequal_arms_and_any_restitution_are_those_struck_one_by_one) {
  Random random(5);
  int finite = 0;
  for (int i = 0; i < 2000; ++i) {
    const TwoContacts body{random(0.2, 1.2), i % 7 == 0 ? -0.1 : random(0.05, 1.05), random(0.02, 1.02)};
    const double e = i % 3 == 0 ? 1 : random(0, 1);
    const End first = i % 2 == 0 ? End::a : End::b;
    const auto by_hand = struck_by_hand(body, e, first, 300);
    const auto found = strikes(body, e, first, 300);
    BOOST_REQUIRE_EQUAL(found.size(), by_hand.size());
    finite += by_hand.size() < 300 ? 1 : 0;
    double most = 0;
    for (const auto p : by_hand) most = std::fmax(most, static_cast<double>(p));
    for (std::size_t j = 0; j < found.size(); ++j)
      BOOST_REQUIRE_LE(std::fabs(found[j].impulse - static_cast<double>(by_hand[j])), 16 * eps * most);
  }
  BOOST_CHECK_GT(finite, 1000);
}

BOOST_AUTO_TEST_CASE(infinitely_many_strikes_up_to_the_critical_restitution_bring_both_contacts_to_rest) {
  const TwoContacts rod = with_ratio(3);
  const double critical = critical_restitution(rod);
  BOOST_CHECK_LE(std::fabs(critical - (7 - 4 * std::sqrt(3.0))), 1e-15);
  BOOST_CHECK(!strike_count(rod, critical * (1 - 1e-12), End::a));
  BOOST_CHECK(strike_count(rod, critical * (1 + 1e-9), End::a));
  const TwoContacts uneven{0.3, 0.7, 0.2};
  // (1 + e) cos ψ = 2 √e there, ψ from the product of the contacts' normals in the mass metric.
  const double e = critical_restitution(uneven), a = 0.3 / 0.2, b = 0.7 / 0.2;
  const double cosine = -(1 - a * b) / std::sqrt((1 + a * a) * (1 + b * b));
  BOOST_CHECK_LE(std::fabs((1 + e) * cosine - 2 * std::sqrt(e)), 8 * eps);
  for (const End first : {End::a, End::b}) {
    double sum = 0;
    for (const PlanarStrike& strike : strikes(uneven, 0.5 * e, first, 400)) sum += strike.impulse;
    BOOST_CHECK_LE(std::fabs(sum - 1), 1e-14);
  }
  BOOST_CHECK_EQUAL(critical_restitution({1, 1, 1.5}), 0);
  BOOST_CHECK_EQUAL(strike_count({1, 1, 1.5}, 0, End::a).value(), 2);
}

BOOST_AUTO_TEST_CASE(what_is_no_body_or_no_restitution_is_refused) {
  for (const TwoContacts& body : {TwoContacts{1, -1, 1}, {1, 1, 0}, {std::nan(""), 1, 1}})
    CHECK_REFUSED(wedge_angle(body), std::domain_error);
  CHECK_REFUSED(strike_count({1, 1, 1}, 1.1, End::a), std::domain_error);
}

}  // namespace
