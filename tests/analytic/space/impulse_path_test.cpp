// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/space/impulse_path.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "tests/analytic/space/random_contact.hpp"
#include "validation/oracles/stepped_impact.hpp"

namespace {

using namespace clatter::analytic;
using namespace clatter::analytic::space;
using clatter::oracle::Random;

constexpr int corners = CLATTER_TEST_SLOW_BUILD ? 300 : 10000;

BOOST_AUTO_TEST_CASE(random_corners_with_friction_and_any_law_agree_with_stepping_in_long_double) {
  constexpr double tolerance = 1e-11;
  Random random(11);
  int unlike = 0;
  double worst = 0;
  for (int i = 0; i < corners; ++i) {
    const Contact contact = contact_of(random_collision(random));
    const Law law = random_law(random, 3);
    const ContactImpulse impact = contact_impulse(contact, law);
    const clatter::oracle::SteppedImpact<long double> stepped(contact, law.law);
    const double of_impulse =
        (impact.impulse - stepped.impulse().cast<double>()).norm() / stepped.impulse().cast<double>().norm();
    const double of_velocity =
        (impact.velocity_after - stepped.velocity().cast<double>()).norm() / contact.velocity.norm();
    worst = std::fmax(worst, std::fmax(of_impulse, of_velocity));
    if (impact.is_path_ambiguous) continue;
    unlike += std::isnan(impact.slip_stop_impulse) == stepped.slip_stopped();
    BOOST_TEST_CONTEXT("corner " << i << " law " << static_cast<int>(law.law.law) << " friction "
                                 << law.law.friction_value) {
      BOOST_CHECK_LE(of_impulse, tolerance);
      BOOST_CHECK_LE(of_velocity, tolerance);
    }
  }
  BOOST_CHECK_EQUAL(unlike, 0);
  BOOST_TEST_MESSAGE("largest relative error " << worst);
}

}  // namespace
