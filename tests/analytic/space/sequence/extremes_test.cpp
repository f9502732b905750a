// SPDX-License-Identifier: GPL-3.0-or-later
#include <boost/test/unit_test.hpp>
#include <cmath>

#include "analytic/base/errors.hpp"
#include "analytic/space/flight/body.hpp"
#include "analytic/space/sequence/sequence.hpp"
#include "tests/analytic/space/impulse/random_contact.hpp"

namespace {

using namespace clatter::analytic::space;
using clatter::analytic::FrictionKind;
using clatter::analytic::NumericalError;
using clatter::analytic::OutsideModelError;
using clatter::analytic::RestitutionLaw;
using clatter::oracle::Random;

/// A sequence goes on until a million evaluations, a third of a second; its last flight is cut short after as many.
constexpr int most_evaluations = 2'300'000;

Drop drop_of(Random& random, const Body& body, double spin) {
  Drop drop{.body = body, .law = {}};
  drop.attitude =
      Quaternion(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(0.1, 1))
          .normalized();
  drop.angular_velocity = spin * random.vector(1);
  drop.velocity = {random.uniform(-1, 1), random.uniform(-1, 1), -2 - 2 * drop.angular_velocity.norm() * body.reach()};
  drop.gravity = random.whole(0, 2) == 0 ? 0 : 9.81;
  drop.law.restitution = random.whole(0, 3) == 0 ? 1 : random.uniform(0, 1);
  drop.law.law = static_cast<RestitutionLaw>(random.whole(0, 2));
  if (random.whole(0, 1) == 1) {
    drop.law.friction = FrictionKind::coulomb;
    drop.law.friction_value = random.uniform(0, 3);
  }
  return drop;
}

/// Runs the drop: all its numbers, or a refusal of a stated kind.
struct Tally {
  int rows = 0, refusals = 0;
  void run(const Drop& drop) {
    try {
      const Sequence sequence = impact_sequence(drop, {.impacts = 4});
      BOOST_CHECK_LE(sequence.root_evaluations, most_evaluations);
      for (const ImpactRow& row : sequence.rows) {
        ++rows;
        BOOST_CHECK(std::isfinite(row.start) && std::isfinite(row.energy_before) && std::isfinite(row.energy_after));
        BOOST_CHECK(row.impact.impulse.allFinite() && row.impact.velocity_after.allFinite());
        BOOST_CHECK(row.impact.angular_velocity_after.allFinite() && row.before.attitude.coeffs().allFinite());
        BOOST_CHECK(!std::isnan(row.error.impulse) && !std::isnan(row.error.start));
        BOOST_CHECK_GE(row.impact.impulse.z(), 0);
      }
      BOOST_CHECK(!sequence.message.empty());
    } catch (const NumericalError& error) {
      ++refusals;
    } catch (const OutsideModelError& error) {
      ++refusals;
    }
  }
};

}  // namespace

BOOST_AUTO_TEST_CASE(thin_plates_and_needles_give_every_number_or_a_typed_refusal_and_no_nan) {
  Random random(1);
  Tally tally;
  constexpr int scenes = CLATTER_TEST_SLOW_BUILD ? 12 : 60;
  for (int i = 0; i < scenes; ++i) {
    const double thin = std::exp2(-random.uniform(3, 40));
    const Vector3 size = i % 2 == 0 ? Vector3(1, random.uniform(0.2, 1), thin) : Vector3(1, thin, thin * 0.7);
    tally.run(drop_of(random, box(1, {.size = size}), random.uniform(0, 5)));
    tally.run(drop_of(random, cylinder(1, {.length = i % 2 == 0 ? thin : 1, .radius = i % 2 == 0 ? 1 : thin}), 1));
  }
  BOOST_TEST(3 * tally.rows > 10 * scenes);
}

BOOST_AUTO_TEST_CASE(nearly_equal_inertias_give_every_number_or_a_typed_refusal_and_no_nan) {
  Random random(2);
  Tally tally;
  for (int i = 0; i < 60; ++i) {
    const double apart = std::exp2(-random.uniform(10, 54));
    tally.run(drop_of(random, box(1, {.size = {1, 1 + apart, 1 - 0.7 * apart}}), random.uniform(0, 5)));
  }
  BOOST_TEST(tally.rows > 100);
  BOOST_TEST(tally.refusals == 0);
}

BOOST_AUTO_TEST_CASE(a_spin_of_a_million_radians_a_second_gives_every_number_or_a_typed_refusal_and_no_nan) {
  Random random(3);
  Tally tally;
  for (int i = 0; i < 6; ++i) tally.run(drop_of(random, box(0.1, {.size = {0.1, 0.05, 0.02}}), 1e6));
  BOOST_TEST(tally.rows > 6);
}

/// Of a top that spins about its axis of largest inertia and takes off at 10 m/s the flight is as long as its parabola:
/// its corners turn level, so that the spin has no part in the time.
BOOST_AUTO_TEST_CASE(a_flight_of_a_million_turns_takes_as_long_as_its_parabola) {
  const double speed = 10, g = 9.81, spin = 3.2e6;
  const Drop drop{.body = box(1, {.size = {0.1, 0.1, 0.02}}),
                  .velocity = Vector3(0, 0, -speed),
                  .angular_velocity = {0, 0, spin},
                  .gravity = g,
                  .law = {}};
  const Sequence sequence = impact_sequence(drop, {.impacts = 2, .amplification = false});
  BOOST_REQUIRE_EQUAL(sequence.rows.size(), 2u);
  BOOST_TEST(sequence.rows[1].start * spin / (2 * M_PI) > 1e6);
  BOOST_TEST(std::fabs(sequence.rows[1].start - 2 * speed / g) <= 1e-12);
  BOOST_TEST(sequence.root_evaluations < 100000);
}
