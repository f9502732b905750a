// SPDX-License-Identifier: GPL-3.0-or-later
// Contacts on sloping ground: balances of momentum and energy, and how they end.
#include "tests/numeric/bodies.hpp"
#include "tests/numeric/support.hpp"

namespace {

using namespace clatter::numeric;
using namespace clatter::numeric::test;

constexpr double slope = 20, promised = 1e-8;

Body brick() { return box_body({0.3, 0.2, 0.1}, 2); }

World hillside(double friction, double damping = 0) {
  return {.ground = with_friction({.stiffness = 1e6, .damping = damping, .area = AreaMeasure::projected}, friction),
          .incline_deg = slope,
          .planar = true};
}

Simulation landed(const World& world, double tangential, int impacts, double inclination = 0) {
  const Body body = brick();
  const MotionState start = touching_state(body, {.inclination = inclination, .velocity = {tangential, 0, -0.5}});
  return simulate(body, world, start, plain_impacts(impacts));
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_contact_that_slips_on_a_slope_gains_its_gravity_along_it_less_friction) {
  const World world = hillside(0.3);
  const Simulation run = landed(world, 2, 2);
  BOOST_TEST_REQUIRE(run.impacts.size() == 2U);
  Vector3 before(2, 0, -0.5);
  double time = 0;
  for (const ImpactRecord& row : run.impacts) {
    const ImpactNumbers& n = row.value;
    before += (n.start - time) * world.pull().acceleration();
    const double gained = n.velocity_after.x() - before.x();
    BOOST_TEST(n.impulse.x() == -0.3 * n.impulse.z(), boost::test_tools::tolerance(promised));
    BOOST_TEST(std::fabs(gained - n.duration * world.pull().along - n.impulse.x() / 2) <= promised);
    BOOST_TEST(std::fabs(row.ledger_gap) <= promised);
    before = n.velocity_after;
    time = n.start + n.duration;
  }
}

BOOST_AUTO_TEST_CASE(an_elastic_frictionless_box_keeps_its_energy_down_the_slope) {
  const Simulation run = landed(hillside(0), 0.4, 4, 0.2);
  BOOST_TEST_REQUIRE(run.impacts.size() == 4U);
  for (const ImpactRecord& row : run.impacts) {
    BOOST_TEST(std::fabs(row.value.energy_before - run.energy_start) <= promised * run.energy_start);
    BOOST_TEST(std::fabs(row.value.energy_after - run.energy_start) <= promised * run.energy_start);
    // Its way down is that of free fall along the slope.
    const double end = row.value.start + row.value.duration;
    BOOST_TEST(std::fabs(row.value.velocity_after.x() - 0.4 - end * hillside(0).pull().along) <= promised);
  }
}

BOOST_AUTO_TEST_CASE(a_box_on_a_slope_rests_where_friction_is_above_tan_of_the_slope_and_else_slides_on) {
  constexpr double damping = 1e8;  // so that the contact does not end
  const Simulation held = landed(hillside(0.45, damping), 0.1, 100), slides = landed(hillside(0.3, damping), 1, 100);
  BOOST_TEST((held.outcome == Outcome::at_rest), held.message);
  BOOST_TEST(held.impacts.back().energy_stored > 0);  // the ground bears the weight
  BOOST_TEST(held.final_state.velocity.norm() <= 1e-5);
  BOOST_TEST((slides.outcome == Outcome::sustained_contact), slides.message);
  // All that was left to it: gravity along the slope, less friction of the normal impulse.
  const ImpactNumbers& last = slides.impacts.back().value;
  const double time = last.start + last.duration, along = hillside(0.3).pull().along, down = hillside(0.3).pull().down;
  const double expected = 1 + along * time - 0.3 * (down * time + 0.5 + slides.final_state.velocity.z());
  BOOST_TEST(std::fabs(slides.final_state.velocity.x() - expected) <= 1e-6);
}
