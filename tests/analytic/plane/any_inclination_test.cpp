// SPDX-License-Identifier: GPL-3.0-or-later
// Drops at an inclination beyond 0° to 90°: end b low, or turned over.
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>

#include "analytic/plane/sequence.hpp"

namespace {

using namespace clatter::analytic;

/// Rounding of the state, grown over four impacts of these scenes.
constexpr double grown = 1e-9;

struct Scene {
  PlanarBody body;
  double restitution, gravity, friction;
};

/// Bodies that look the same turned by half a turn and mirrored.
const Scene scenes[] = {{make_rod({}), 1, 0, 0},
                        {make_rod({}), 1, 9.81, 0},
                        {make_rod({}), 0.8, 9.81, 0.1},
                        {make_rod({.length = 0.7, .radius = 0.02}), 0.9, 9.81, 0.2},
                        {make_box({0.08814, 0.10566, 0.04394, 0.01905}), 0.7, 9.81, 0}};

Sequence run(const Scene& scene, double degrees, double sign) {
  Drop drop{.body = scene.body,
            .inclination = Angle::from_degrees(degrees),
            .velocity = {.normal = -1.3, .tangential = sign * 0.2, .angular = sign * 0.4},
            .gravity = scene.gravity,
            .law = {.restitution = scene.restitution}};
  if (scene.friction > 0) {
    drop.law.friction = FrictionKind::coulomb;
    drop.law.friction_value = scene.friction;
  }
  return impact_sequence(drop, {.impacts = 4, .amplification = false});
}

/// @param sign −1: seen from behind the page
void check_same(const Sequence& some, const Sequence& other, double sign) {
  BOOST_REQUIRE(!some.rows.empty());
  BOOST_REQUIRE_EQUAL(some.rows.size(), other.rows.size());
  for (std::size_t i = 0; i < some.rows.size(); ++i) {
    const Impact &a = some.rows[i].impact, &b = other.rows[i].impact;
    const double impulse = other.rows[0].impact.normal_impulse,
                 rate = std::fabs(other.rows[0].impact.after.angular) + 1;
    BOOST_TEST(std::fabs(a.normal_impulse - b.normal_impulse) <= grown * impulse);
    BOOST_TEST(std::fabs(a.after.normal - b.after.normal) <= grown);
    BOOST_TEST(std::fabs(a.after.tangential - sign * b.after.tangential) <= grown);
    BOOST_TEST(std::fabs(a.after.angular - sign * b.after.angular) <= grown * rate);
    BOOST_TEST(std::fabs(some.rows[i].start - other.rows[i].start) <= grown);
    BOOST_TEST(std::fabs(some.rows[i].contact_angle - other.rows[i].contact_angle) <= grown);
  }
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_drop_with_its_other_end_low_is_the_mirror_image) {
  for (const Scene& scene : scenes) {
    for (const double degrees : {8., 25., 50., 71., 90.}) {
      check_same(run(scene, -degrees, -1), run(scene, degrees, 1), -1);
    }
  }
}

BOOST_AUTO_TEST_CASE(a_symmetric_body_dropped_turned_over_falls_the_same) {
  for (const Scene& scene : scenes) {
    for (const double degrees : {8., 25., 50., 71.}) {
      check_same(run(scene, degrees - 180, 1), run(scene, degrees, 1), 1);
      check_same(run(scene, 180 - degrees, -1), run(scene, degrees, 1), -1);
    }
  }
}

BOOST_AUTO_TEST_CASE(an_inclination_beyond_half_a_turn_is_refused) {
  BOOST_CHECK_THROW(static_cast<void>(run(scenes[0], 181, 1)), std::domain_error);
  BOOST_CHECK_THROW(static_cast<void>(run(scenes[0], -200, 1)), std::domain_error);
}
