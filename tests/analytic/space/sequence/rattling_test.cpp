// SPDX-License-Identifier: GPL-3.0-or-later
// Drops to rest over corners that stay: slip that begins there, and corners that come down again and again beside them.
#include <algorithm>
#include <array>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <random>

#include "analytic/space/sequence/sequence.hpp"

namespace {

using namespace clatter::analytic::space;
using clatter::analytic::FrictionKind;
using clatter::analytic::Outcome;
using clatter::analytic::RestitutionLaw;

struct Uneven {
  double mass;
  Vector3 size, centre;
  Matrix3 inertia;
};

Body body_of(const Uneven& u) {
  Body body = box(u.mass, {.size = u.size});
  for (Vector3& vertex : body.vertices) vertex -= u.centre;
  body.inertia = u.inertia;
  return body;
}

/// A box of uneven mass that is thrown down, without rebound and with friction, or by any of four laws.
Drop thrown(int n, bool rebounds) {
  std::mt19937_64 random(static_cast<std::uint64_t>(7000 + n));
  std::uniform_real_distribution<double> uniform(0, 1);
  std::normal_distribution<double> normal;
  const auto around_zero = [&] { return 2 * uniform(random) - 1; };
  Uneven u{.mass = 0.5 + 1.5 * uniform(random), .size = {}, .centre = {}, .inertia = {}};
  for (int i = 0; i < 3; ++i) u.size[i] = 0.2 + 0.6 * uniform(random);
  for (int i = 0; i < 3; ++i) u.centre[i] = 0.1 * around_zero() * u.size[i];
  u.inertia = box(u.mass, {.size = u.size}).inertia;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < i; ++j) {
      u.inertia(i, j) = u.inertia(j, i) = 0.05 * around_zero() * std::sqrt(u.inertia(i, i) * u.inertia(j, j));
    }
  }
  Drop drop;
  drop.body = body_of(u);
  drop.attitude = Quaternion(normal(random), normal(random), normal(random), normal(random)).normalized();
  drop.velocity = {0, 0, -4 - 5 * uniform(random)};
  for (int i = 0; i < 3; ++i) drop.angular_velocity[i] = 5 * around_zero();
  drop.gravity = 9.81;
  auto& law = drop.law;
  law.restitution = 0;
  law.friction = FrictionKind::coulomb;
  law.friction_value = 0.1 + 1.4 * uniform(random);
  if (!rebounds) return drop;
  constexpr std::array laws{RestitutionLaw::newton, RestitutionLaw::poisson, RestitutionLaw::stronge};
  law.law = laws[static_cast<std::size_t>(n) % laws.size()];
  law.restitution = 0.8 * uniform(random);
  law.friction_value *= 0.5;
  return drop;
}

double unaccounted(const Sequence& s) {
  double left = s.rows.front().energy_before - s.energy_at_end - (s.tail ? s.tail->energy_loss : 0);
  for (const ImpactRow& row : s.rows) left -= row.impact.energy_loss;
  for (const SustainedContact& contact : s.contacts) {
    left -= contact.energy_loss + (contact.tail ? contact.tail->energy_loss : 0);
  }
  return std::fabs(left) / s.rows.front().energy_before;
}

}  // namespace

BOOST_AUTO_TEST_CASE(slip_that_grows_faster_than_its_direction_is_driven_back_begins_as_thirty_digits_have_it) {
  Uneven u{.mass = 1.51057,
           .size = {0.66622, 0.593113, 0.702466},
           .centre = {-0.0492251, -0.0288121, 0.0568912},
           .inertia = {}};
  u.inertia << 0.111013, 0.00100219, 0.000651417, 0.00100219, 0.129739, 0.00542464, 0.000651417, 0.00542464, 0.0970686;
  Drop drop;
  drop.body = body_of(u);
  drop.attitude = Quaternion(-0.12333322042579299, -0.4400132984331793, 0.8056093128307166, 0.3770554985963966);
  drop.velocity = {0, 0, -7.89};
  drop.angular_velocity = {-9.626, 7.83, 6.308};
  drop.gravity = 9.81;
  drop.law = {.restitution = 0, .friction = FrictionKind::coulomb, .friction_value = 1.17};
  const Sequence s = impact_sequence(drop, {.impacts = 100, .until_rest = true});
  BOOST_REQUIRE(!s.contacts.empty());
  const SustainedContact& first = s.contacts.front();
  // The motion from onset integrated with 30 digits; 14 of the end are known.
  constexpr double end = 0.02142600735268, digits = 1e-14;
  BOOST_TEST(std::fabs(first.begin + first.duration - end) <= first.error.time + digits);
  BOOST_TEST(first.error.time <= 1e-11);
}

BOOST_AUTO_TEST_CASE(rattling_beside_corners_that_stay_is_summed_and_leaves_the_end_as_it_is_row_by_row) {
  constexpr int drops = CLATTER_TEST_SLOW_BUILD ? 10 : 30;
  int at_rest = 0, certain = 0, summed = 0;
  std::size_t most_rows = 0;
  for (int n = 0; n < drops; ++n) {
    const Drop drop = thrown(n, false);
    const Sequence s = impact_sequence(drop, {.impacts = 1000, .until_rest = true});
    BOOST_TEST_CONTEXT("drop " << n << ": " << s.message) {
      BOOST_CHECK(s.outcome != Outcome::not_computed);
      BOOST_TEST(unaccounted(s) <= 1e-9);
      most_rows = std::max(most_rows, s.rows.size());
      if (s.outcome != Outcome::at_rest) continue;
      ++at_rest;
      certain += s.end_predictable ? 1 : 0;
      const auto rattled = std::ranges::find_if(s.contacts, [](const SustainedContact& c) {
        return c.tail && c.corners.size() == 2 && std::isfinite(c.error.time);
      });
      if (rattled == s.contacts.end()) continue;
      // Asked for more digits than can be had, rows go on until heights are rounding.
      const Sequence longer = impact_sequence(drop, {.impacts = 1000, .digits = 15, .until_rest = true});
      const auto same = std::ranges::find_if(longer.contacts, [&](const SustainedContact& c) {
        return c.corners == rattled->corners && c.begin > rattled->begin - 1e-3;
      });
      BOOST_REQUIRE(same != longer.contacts.end());
      ++summed;
      BOOST_TEST(longer.rows.size() >= s.rows.size());
      const double allowed = rattled->error.time + same->error.time;
      BOOST_TEST(std::fabs(rattled->begin + rattled->duration - same->begin - same->duration) <= allowed);
      BOOST_TEST(std::fabs(s.total_normal_impulse - longer.total_normal_impulse) <= 1e-4 * s.total_normal_impulse);
    }
  }
  BOOST_TEST(at_rest >= 0.9 * drops);
  BOOST_TEST(certain >= 0.85 * at_rest);
  BOOST_TEST(summed >= drops / 20);
  BOOST_TEST(most_rows <= 40U);
}

BOOST_AUTO_TEST_CASE(throws_by_any_law_run_to_their_end_where_corners_come_to_stay_without_speed) {
  Drop drop;
  drop.body = box(0.016, {.size = {0.0059689999999999995, 0.0127, 0.0127}});
  drop.attitude = Quaternion(-0.6019147019314527, -0.10627066687297441, -0.7913557919215503, 0.012698328762481136);
  drop.velocity = {0.5, 0.2, -1.5};
  drop.angular_velocity = {-0.9471435261017057, -7.608443773962224, -26.198162628006155};
  drop.gravity = 9.81;
  drop.law = {
      .restitution = 0.5, .law = RestitutionLaw::stronge, .friction = FrictionKind::coulomb, .friction_value = 0.25};
  const Sequence s = impact_sequence(drop, {.impacts = 100'000, .digits = 2, .until_rest = true});
  BOOST_CHECK(s.outcome == Outcome::at_rest);
  BOOST_TEST(unaccounted(s) <= 1e-9);
  for (int n = 0; n < (CLATTER_TEST_SLOW_BUILD ? 6 : 20); ++n) {
    const Sequence other = impact_sequence(thrown(n, true), {.impacts = 100'000, .until_rest = true});
    BOOST_TEST_CONTEXT("throw " << n << ": " << other.message) {
      BOOST_CHECK(other.outcome != Outcome::not_computed);
      BOOST_TEST(unaccounted(other) <= 1e-9);
    }
  }
}

/// Here the ground would have to pull both corners of an edge: the one leaves it, the other does not.
BOOST_AUTO_TEST_CASE(of_an_edge_one_corner_leaves_where_the_ground_would_pull_both) {
  Drop drop;
  Vector3 centre = Vector3::Zero();
  drop.body.vertices = {{0.07601, -0.082656, 0.02117},
                        {0.03434, 0.001191, -0.064442},
                        {-0.005282, -0.082131, 0.086918},
                        {0.073097, 0.009528, -0.039951}};
  for (const Vector3& vertex : drop.body.vertices) centre += vertex / 4;
  Matrix3 spread = Matrix3::Zero();  // of a tetrahedron of 1 kg: a twentieth of its vertices' sum
  for (Vector3& vertex : drop.body.vertices) {
    vertex -= centre;
    spread += vertex * vertex.transpose() / 20;
  }
  drop.body.mass = 1;
  drop.body.inertia = spread.trace() * Matrix3::Identity() - spread;
  drop.attitude = Quaternion(-0.6644802, 0.4411136, -0.3445552, 0.4951430).normalized();
  drop.gravity = 9.81;
  drop.velocity = {0.54, 0, -std::sqrt(2 * drop.gravity * 0.207)};
  drop.law = {.restitution = 0.008, .friction = FrictionKind::coulomb, .friction_value = 0.125};
  const Sequence s = impact_sequence(drop, {.impacts = 1000, .until_rest = true});
  BOOST_CHECK(s.outcome == Outcome::at_rest);
  BOOST_TEST(unaccounted(s) <= 1e-9);
}

/// What rests has taken m(v + gT) from the ground, and a rod that rests lies level.
BOOST_AUTO_TEST_CASE(rods_that_rock_from_end_to_end_come_to_lie_level_with_the_balance_of_their_momentum) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> uniform(0, 1);
  Drop drop;
  drop.body = cylinder(0.4, {.length = 0.2});
  drop.gravity = 9.81;
  constexpr int drops = CLATTER_TEST_SLOW_BUILD ? 8 : 40;
  int summed = 0;
  for (int n = 0; n < drops; ++n) {
    const double angle = 1.5 * uniform(random), speed = 1 + 3 * uniform(random);
    drop.attitude = Quaternion(Eigen::AngleAxisd(angle, Vector3::UnitY()));
    drop.velocity = {0, 0, -speed};
    drop.law.restitution = 0.7 + 0.2 * uniform(random);
    drop.law.friction = FrictionKind::coulomb;
    drop.law.friction_value = 0.1 + 0.4 * uniform(random);
    drop.law.law = n % 2 == 0 ? RestitutionLaw::newton : RestitutionLaw::stronge;
    constexpr double late = 60;
    const Sequence s = impact_sequence(drop, {.impacts = 100'000, .until_rest = true}, {late});
    BOOST_TEST_CONTEXT("rod " << n << ": " << s.message) {
      BOOST_CHECK(s.outcome == Outcome::at_rest);
      if (s.tail) {
        ++summed;
        const double taken = drop.body.mass * (speed + drop.gravity * s.tail->end_time);
        BOOST_TEST(std::fabs(s.total_normal_impulse - taken) <= 1e-8 * taken);
      }
      const State& end = s.states.back().state;
      BOOST_TEST(std::fabs((end.attitude * Vector3::UnitX()).z()) <= 1e-12);
      BOOST_TEST(std::fabs(end.position.z()) <= 1e-12 * drop.body.reach());
    }
  }
  BOOST_TEST(summed >= drops / 2);
}

/// Where rows can no longer be predicted decides where a sequence ends, whether bounds are wanted or not.
BOOST_AUTO_TEST_CASE(a_drop_followed_to_rest_is_the_same_without_bounds) {
  Drop drop;
  drop.body = make_box({.mass = 0.5, .length = 0.2, .width = 0.1, .thickness = 0.05});
  drop.velocity = {0, 0, -std::sqrt(2 * 9.81 * 0.5)};
  drop.gravity = 9.81;
  drop.law = {.restitution = 0.6, .friction = FrictionKind::coulomb, .friction_value = 0.3};
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  for (int i = 0; i < (CLATTER_TEST_SLOW_BUILD ? 3 : 12); ++i) {
    drop.attitude = Quaternion(normal(random), normal(random), normal(random), normal(random)).normalized();
    const Sequence with = impact_sequence(drop, {.impacts = 1000, .until_rest = true});
    const Sequence without = impact_sequence(drop, {.impacts = 1000, .amplification = false, .until_rest = true});
    BOOST_TEST(with.rows.size() == without.rows.size());
    BOOST_TEST(with.total_normal_impulse == without.total_normal_impulse);
    BOOST_TEST(with.message == without.message);
  }
}
