// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/plane/accumulation.hpp"

#include "analytic/plane/sequence.hpp"
#include "tests/support.hpp"

namespace {

using namespace clatter::analytic;
using clatter::test::eps;

constexpr double rounding = 20 * eps;

Drop bouncing(double degrees, double radius) {
  return {.body = make_rod({.mass = 2, .length = 1, .radius = radius}),
          .inclination = Angle::from_degrees(degrees),
          .velocity = {.normal = -3},
          .gravity = 9.81,
          .law = {.restitution = 0.6}};
}

}  // namespace

BOOST_AUTO_TEST_CASE(flat_and_upright_bouncing_end_where_the_geometric_series_ends) {
  for (const double degrees : {0.0, 90.0}) {
    for (const double radius : {0.0, 0.05}) {
      for (const int impacts : {1, 3, 10}) {
        const Sequence s = impact_sequence(bouncing(degrees, radius), {.impacts = impacts});
        BOOST_REQUIRE(s.tail.has_value());
        BOOST_CHECK(s.outcome == Outcome::at_rest);
        BOOST_TEST(s.rows.size() == static_cast<std::size_t>(impacts));
        BOOST_TEST(s.tail->closed_form);
        const double end = 2 * 0.6 * 3 / (9.81 * (1 - 0.6));
        BOOST_TEST(std::fabs(s.tail->end_time - end) <= rounding * end);
        // All of the momentum 2·3 is stopped, and each bounce stops what the last one gave back.
        const double total = 2 * 3 * (1 + 0.6) / (1 - 0.6);
        BOOST_TEST(std::fabs(s.total_normal_impulse - total) <= rounding * total);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(a_sliding_face_is_stopped_by_friction_or_slides_on) {
  Drop drop = bouncing(0, 0.05);
  drop.velocity.tangential = 100;
  drop.law.friction = FrictionKind::coulomb;
  drop.law.friction_value = 0.25;
  const Sequence slides = impact_sequence(drop, {.impacts = 2});
  BOOST_REQUIRE(slides.tail.has_value());
  // Momentum lost to friction: μ times all of the normal impulse.
  BOOST_TEST(std::fabs(slides.tail->velocity_after.x() - (100 - 0.25 * slides.total_normal_impulse / 2)) <= 1e-13);
  drop.velocity.tangential = 0.5;
  const Sequence stops = impact_sequence(drop, {.impacts = 2});
  BOOST_TEST(stops.tail->velocity_after.x() == 0);
}

BOOST_AUTO_TEST_CASE(elastic_bouncing_has_no_end) {
  Drop drop = bouncing(0, 0);
  drop.law.restitution = 1;
  const Sequence s = impact_sequence(drop, {.impacts = 50});
  BOOST_CHECK(s.outcome == Outcome::impact_limit);
  BOOST_TEST(!s.tail.has_value());
}

BOOST_AUTO_TEST_CASE(bouncing_on_damped_ground_never_comes_to_rest_since_slow_contacts_lose_nothing) {
  for (const double degrees : {0.0, 90.0, 5.0, 10.0, 40.0, 70.0}) {
    for (const double damping : {0.01, 0.3, 10.0}) {
      Drop drop = bouncing(degrees, 0);
      drop.law = {.law = RestitutionLaw::viscoelastic, .damping_per_stiffness = damping};
      const Sequence s = impact_sequence(drop, {.impacts = 200, .digits = 1});
      BOOST_TEST_CONTEXT(degrees << "°, " << damping << " s/m: " << s.message) {
        BOOST_CHECK(s.outcome == Outcome::impact_limit || s.outcome == Outcome::no_further_impact);
        BOOST_TEST(!s.tail.has_value());
        for (const ImpactRow& row : s.rows) BOOST_TEST(row.impact.energy_loss >= -1e-15 * row.energy_before);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(on_damped_ground_only_friction_ends_a_bouncing_and_more_digits_confirm_its_end) {
  Drop drop = bouncing(81, 0.05);  // reverses its slip in each impact
  drop.law = {.law = RestitutionLaw::viscoelastic,
              .friction = FrictionKind::coulomb,
              .friction_value = 0.5,
              .damping_per_stiffness = 10};
  const Sequence coarse = impact_sequence(drop, {.impacts = 20000, .digits = 1, .amplification = false});
  const Sequence fine = impact_sequence(drop, {.impacts = 20000, .digits = 3, .amplification = false});
  BOOST_REQUIRE(coarse.tail.has_value());
  BOOST_REQUIRE(fine.tail.has_value());
  BOOST_TEST(std::fabs(coarse.tail->end_time - fine.tail->end_time) <= coarse.tail->end_time_error);
  drop.inclination = Angle::from_degrees(21);  // sticks, and stays elastic: its flights shorten like 1/n
  BOOST_TEST(!impact_sequence(drop, {.impacts = 20000, .digits = 1, .amplification = false}).tail.has_value());
}

BOOST_AUTO_TEST_CASE(without_rebound_a_flat_body_rests_at_once_and_an_inclined_one_keeps_its_end_down) {
  for (const double degrees : {0.0, 90.0}) {
    Drop drop = bouncing(degrees, 0);
    drop.law.restitution = 0;
    for (const int impacts : {1, 6}) {
      const Sequence s = impact_sequence(drop, {.impacts = impacts});
      BOOST_CHECK(s.outcome == Outcome::at_rest);
      BOOST_TEST(s.rows.size() == 1);
      BOOST_TEST(!s.tail.has_value());
      BOOST_TEST(s.end_predictable);
      BOOST_TEST(std::fabs(s.total_normal_impulse - 2 * 3) <= s.total_normal_impulse_error);
      BOOST_TEST(s.total_normal_impulse_error <= 1e-13);
    }
  }
  Drop inclined = bouncing(20, 0);
  inclined.law.restitution = 0;
  inclined.velocity.normal = -0.5;
  BOOST_CHECK(impact_sequence(inclined, {}).outcome == Outcome::sustained_contact);
}

BOOST_AUTO_TEST_CASE(vertices_that_have_struck_long_ago_do_not_end_on_the_ground_with_those_that_still_do) {
  // Impacts in no order that repeats, each half as long as the last: 30 of vertices 2 and 3, then 20 of 0 and 1.
  Accumulation accumulation;
  double size = 1;
  for (unsigned i = 0; i < 50; ++i, size /= 2) {
    const unsigned vertex = (i < 30 ? 2 : 0) + (i * i / 7) % 2;
    accumulation.add({.vertices = static_cast<VertexSet>(1u << vertex), .flight_time = size, .normal_impulse = size});
  }
  const auto tail = accumulation.extrapolate({.relative = 1e-18, .time = 1e-9, .impulse = 1e-9});
  BOOST_REQUIRE(tail.has_value());
  BOOST_TEST(tail->vertices == 3U);
}
