// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/space/landing/tilted_outcomes.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "analytic/space/landing/simultaneous.hpp"
#include "tests/analytic/space/impulse/random_contact.hpp"
#include "tests/analytic/space/landing/flat_landing.hpp"

namespace {

using namespace clatter::analytic;
using namespace clatter::analytic::space;
using namespace clatter::oracle;

/// A uniform thin rod along x, flat.
struct FlatRod {
  Body body{.mass = 1, .inertia = Vector3(1e-3, 1. / 12, 1. / 12).asDiagonal(), .vertices = {}, .rims = {}};
  std::vector<Corner> ends = corners_of({{-0.5, 0, 0}, {0.5, 0, 0}});
};

BOOST_AUTO_TEST_CASE(a_flat_elastic_rod_rebounds_as_a_whole_however_it_is_tilted_after_impulses_1_2_1) {
  const FlatRod rod;
  State before;
  before.velocity = {0, 0, -1};
  const OutcomeSet set = tilted_outcomes(rod.body, before, rod.ends, frictionless(1));
  BOOST_CHECK_LE(set.velocity_spread, 1e-14);
  BOOST_CHECK_LE(set.angular_velocity_spread, 1e-13);
  for (const TiltedOutcome& outcome : set.outcomes) {
    BOOST_CHECK_EQUAL(outcome.impact.order.size(), 3u);
    BOOST_CHECK(outcome.impact.order[0] == outcome.impact.order[2]);
    BOOST_CHECK(outcome.impact.order[0] != outcome.impact.order[1]);
  }
}

BOOST_AUTO_TEST_CASE(tilts_to_either_side_of_a_damped_rod_give_two_outcomes_that_are_mirror_images) {
  const FlatRod rod;
  State before;
  before.velocity = {0, 0, -1};
  const double e = 0.5;
  const OutcomeSet set = tilted_outcomes(rod.body, before, rod.ends, frictionless(e));
  BOOST_REQUIRE_EQUAL(set.outcomes.size(), 2u);
  const GroupImpact &left = set.outcomes[0].impact, &right = set.outcomes[1].impact;
  BOOST_CHECK_LE((left.velocity_after - right.velocity_after).norm(), 1e-14);
  BOOST_CHECK_LE((left.angular_velocity_after + right.angular_velocity_after).norm(), 1e-14);
  // In terms of the ends' velocities (u, w) an impact gives (−e u, w + (1+e) u/2), for W = 4 at the end and −2 across.
  double u = -1, w = -1;
  for (bool at_u = true; u < 0 || w < 0; at_u = !at_u) {
    double &struck = at_u ? u : w, &other = at_u ? w : u;
    other += (1 + e) * struck / 2;
    struck *= -e;
  }
  BOOST_CHECK_LE(std::fabs(left.velocity_after.z() - (u + w) / 2), 1e-14);
  BOOST_CHECK_LE(std::fabs(set.angular_velocity_spread - 2 * std::fabs(u - w)), 1e-13);
}

BOOST_AUTO_TEST_CASE(a_slippery_rocking_block_has_several_outcomes_and_a_face_that_drops_level_and_elastic_one) {
  const FlatBox block(0.4, 0.3, 1, 1);
  State rocking;
  rocking.angular_velocity = {0, -1, 0};
  rocking.velocity = {0, 0, -0.2};
  const OutcomeSet set = tilted_outcomes(block.body, rocking, block.bottom, frictionless(0.7));
  BOOST_CHECK_GE(set.outcomes.size(), 2u);
  BOOST_CHECK_GT(set.angular_velocity_spread, 1e-3);
  // Each of these leaves no corner approaching.
  for (const TiltedOutcome& outcome : set.outcomes) {
    for (const Corner& corner : block.bottom) {
      BOOST_CHECK_GE(
          normal_velocity(outcome.impact.velocity_after, outcome.impact.angular_velocity_after, corner.place), -1e-13);
    }
  }
}

/// Whether two impacts are one outcome.
bool agree(const Vector3& v, const Vector3& spin, const GroupImpact& impact, double tolerance) {
  return (v - impact.velocity_after).norm() + (spin - impact.angular_velocity_after).norm() <= tolerance;
}

/// Corners one after the other as the heights of one tilt have it, each by its own impact.
State after_tilt(const Body& body, const State& before, const std::vector<Corner>& touching, const ImpactLaw& law,
                 double direction) {
  State state = before;
  std::vector<double> heights;
  for (const Corner& corner : touching) {
    const Vector3 arm = before.attitude * corner.place;
    heights.push_back(std::cos(direction) * arm.x() + std::sin(direction) * arm.y());
  }
  const double least = *std::ranges::min_element(heights);
  for (double& height : heights) height -= least;
  for (int strikes = 0; strikes < 1000; ++strikes) {
    std::vector<double> rises;
    for (const Corner& corner : touching) {
      rises.push_back(normal_velocity(state.velocity, state.angular_velocity, before.attitude * corner.place));
    }
    double soonest = std::numeric_limits<double>::infinity();
    std::size_t next = 0;
    for (std::size_t i = 0; i < rises.size(); ++i) {
      if (rises[i] < -1e-9 && -heights[i] / rises[i] < soonest) soonest = -heights[i] / rises[i], next = i;
    }
    if (!std::isfinite(soonest)) break;
    for (std::size_t i = 0; i < rises.size(); ++i) heights[i] = std::fmax(heights[i] + rises[i] * soonest, 0);
    heights[next] = 0;
    const Impact impact = strike(body, state, touching[next].place, law);
    state.velocity = impact.velocity_after;
    state.angular_velocity = impact.angular_velocity_after;
  }
  return state;
}

/// Whether a direction lies in a sector.
bool holds(const TiltSector& sector, double direction) {
  const double turn = 2 * std::numbers::pi, along = std::fmod(direction - sector.from, turn);
  return (along < 0 ? along + turn : along) < sector.width;
}

BOOST_AUTO_TEST_CASE(each_direction_lies_in_one_sector_the_outcome_of_which_its_tilt_gives) {
  const FlatBox block(0.4, 0.3, 1, 1);
  State before;
  before.angular_velocity = {0.3, -1, 0.1};
  before.velocity = {0, 0, -0.6};
  const ImpactLaw law = frictionless(0.7);
  const OutcomeSet set = tilted_outcomes(block.body, before, block.bottom, law);
  BOOST_REQUIRE_GE(set.outcomes.size(), 3u);
  for (const TiltedOutcome& outcome : set.outcomes) {
    double width = 0;
    for (const TiltSector& sector : outcome.sectors) width += sector.width;
    BOOST_TEST(std::fabs(width - 2 * std::numbers::pi * outcome.share) <= 1e-12);
  }
  for (int k = 0; k < 500; ++k) {
    const double direction = -3 + 0.0125 * k;
    int found = 0;
    for (const TiltedOutcome& outcome : set.outcomes) {
      for (const TiltSector& sector : outcome.sectors) {
        if (!holds(sector, direction)) continue;
        ++found;
        const State after = after_tilt(block.body, before, block.bottom, law, direction);
        BOOST_TEST(agree(after.velocity, after.angular_velocity, outcome.impact, 1e-5));
      }
    }
    BOOST_TEST(found == 1, "direction " << direction);
  }
}

double kinetic_energy(const Body& body, const State& state) {
  const Vector3 spin = state.attitude.conjugate() * state.angular_velocity;
  return (body.mass * state.velocity.squaredNorm() + spin.dot(body.inertia * spin)) / 2;
}

/// A prism on an uneven polygon, that lands level.
struct LevelFace {
  Body body;
  State before;
  std::vector<Corner> touching;

  explicit LevelFace(Random& random) {
    const double mass = random.uniform(0.2, 3), l = random.uniform(0.2, 1), w = random.uniform(0.2, 1);
    const double h = random.uniform(0.2, 1);
    const Vector3 inertia = mass / 12 * Vector3(w * w + h * h, h * h + l * l, l * l + w * w);
    body = {.mass = mass, .inertia = inertia.asDiagonal(), .vertices = {}, .rims = {}};
    const int corners = random.whole(3, 6);
    std::vector<Vector3> places;
    for (int i = 0; i < corners; ++i) {
      const double turn = 2 * std::numbers::pi * (i + random.uniform(0, 0.5)) / corners;
      places.emplace_back(l / 2 * std::cos(turn), w / 2 * std::sin(turn), -h / 2);
    }
    touching = corners_of(places);
    before.attitude = Quaternion(Eigen::AngleAxisd(random.uniform(0, 6), Vector3::UnitZ()));
    before.velocity = random.vector(1) - Vector3(0, 0, 1.2);
    before.angular_velocity = random.vector(2);
  }
};

BOOST_AUTO_TEST_CASE(no_direction_of_the_tilt_has_an_outcome_beyond_the_set_and_shares_are_those_of_the_directions) {
  constexpr int faces = 24, directions = 4000;
  constexpr double share_tolerance = 8e-3;  // of a share counted over so many evenly spaced directions
  Random random(31);
  for (int i = 0; i < faces; ++i) {
    const LevelFace face(random);
    const double e = random.uniform(0.3, 1);
    const ImpactLaw law =
        i % 4 == 0 ? coulomb(e, random.uniform(0, 1), static_cast<RestitutionLaw>(i / 4 % 3)) : frictionless(e);
    const OutcomeSet set = tilted_outcomes(face.body, face.before, face.touching, law);
    BOOST_REQUIRE(set.is_complete());
    std::vector<double> shares(set.outcomes.size());
    int missed = 0;
    for (int k = 0; k < directions; ++k) {
      const double direction = 2 * std::numbers::pi * (k + 0.37) / directions;
      const State after = after_tilt(face.body, face.before, face.touching, law, direction);
      bool found = false;
      for (std::size_t j = 0; j < shares.size() && !found; ++j) {
        found = agree(after.velocity, after.angular_velocity, set.outcomes[j].impact, 1e-5);
        if (found) shares[j] += 1.0 / directions;
      }
      missed += found ? 0 : 1;
    }
    BOOST_CHECK_EQUAL(missed, 0);
    const GroupImpact by_rule = strike_together(face.body, face.before, face.touching, law);
    double sum = 0, by_rule_share = 0, least = 1e300, most = -1e300;
    for (std::size_t j = 0; j < shares.size(); ++j) {
      const auto& [direction, share, sectors, impact] = set.outcomes[j];
      sum += share;
      BOOST_CHECK_LE(std::fabs(shares[j] - share), share_tolerance);
      const State after = after_tilt(face.body, face.before, face.touching, law, direction);
      BOOST_CHECK(agree(after.velocity, after.angular_velocity, impact, 1e-5));
      if (agree(after.velocity, after.angular_velocity, by_rule, 1e-5)) by_rule_share += share;
      least = std::fmin(least, kinetic_energy(face.body, after));
      most = std::fmax(most, kinetic_energy(face.body, after));
    }
    BOOST_CHECK_LE(std::fabs(by_rule_share - set.convention_share), 1e-12);
    BOOST_CHECK_LE(std::fabs(most - least - set.range.energy_loss), 1e-5 * most);
    BOOST_CHECK_LE(std::fabs(sum - 1), 1e-8);
  }
}

BOOST_AUTO_TEST_CASE(a_face_whose_narrowest_sector_has_eight_degrees_has_all_four_outcomes) {
  const double angle = 2 * std::atan2(0.8097135568321546, -0.5868253197351159);
  const FlatBox block(0.1514, 0.08958, 0.1433, 0.584);
  State before;
  before.attitude = Eigen::AngleAxisd(angle, Vector3::UnitZ());
  before.velocity = {0, 0, -1};
  before.angular_velocity = {20.31, -4.001, -25.12};
  const OutcomeSet set = tilted_outcomes(block.body, before, block.bottom, frictionless(0.4));
  BOOST_REQUIRE_EQUAL(set.outcomes.size(), 4u);
  BOOST_CHECK(set.is_complete());
  const GroupImpact& narrow = set.outcomes.back().impact;
  // By a computation of its own, which follows 100 000 directions with the closed form of an impact: to its digits.
  BOOST_CHECK_LE(std::fabs(narrow.velocity_after.z() - 0.73715), 5e-6);
  BOOST_CHECK_LE((narrow.angular_velocity_after - Vector3(3.2415, 6.7277, -25.12)).norm(), 1e-4);
  BOOST_CHECK_LE(std::fabs(set.outcomes.back().share - 8.1 / 360), 3e-4);
}

BOOST_AUTO_TEST_CASE(a_light_body_that_rattles_on_has_a_set_that_says_what_is_left_out) {
  FlatBox light(1, 1, 0.7, 1);
  light.body.inertia = Vector3(6e-4, 5.5e-3, 5e-3).asDiagonal();
  State before;
  before.velocity = {0, 0, -1};
  for (const double e : {0.0, 0.3, 0.9}) {
    const OutcomeSet set = tilted_outcomes(light.body, before, light.bottom, frictionless(e));
    double sum = set.open_share;
    for (const TiltedOutcome& outcome : set.outcomes) {
      sum += outcome.share;
      for (const Corner& corner : light.bottom) {
        BOOST_CHECK_GE(
            normal_velocity(outcome.impact.velocity_after, outcome.impact.angular_velocity_after, corner.place), -1e-9);
      }
    }
    BOOST_CHECK_LE(std::fabs(sum - 1), 1e-6);
    BOOST_CHECK_EQUAL(set.is_complete(), e == 0);
    BOOST_CHECK_EQUAL(set.outcomes.empty(), false);
    if (e > 0) continue;  // without rebound it comes to rest whatever the tilt, as it does as a whole
    BOOST_CHECK_EQUAL(set.outcomes.size(), 1u);
    BOOST_CHECK_LE(set.velocity_spread, 1e-9);
    BOOST_CHECK_LE(std::fabs(set.convention_share - 1), 1e-9);
  }
}

/// Almost all of its mass lies along x.
FlatBox needle_in_a_box() {
  FlatBox light(1, 0.7, 1, 1);
  light.body.inertia = Vector3(6e-4, 5e-3, 5.5e-3).asDiagonal();
  return light;
}

BOOST_AUTO_TEST_CASE(the_sum_of_a_rattle_with_friction_is_that_of_its_strikes) {
  const FlatBox light = needle_in_a_box();
  State now;
  now.velocity = {0.0054, 0.0012, -0.975};
  now.angular_velocity = {0, 1.95, -0.12};
  const ImpactLaw law{.restitution = 0, .friction = FrictionKind::coulomb, .friction_value = 0.3};
  const GroupImpact sum = strike_together(light.body, now, light.bottom, law);
  std::vector<Corner> edges[2];
  for (const Corner& corner : light.bottom) edges[corner.place.x() > 0].push_back(corner);
  int strikes = 0;
  for (bool goes_on = true; goes_on && strikes < 5000;) {  // the edges in turn, one by one
    goes_on = false;
    for (const std::vector<Corner>& edge : edges) {
      if (!(normal_velocity(now.velocity, now.angular_velocity, edge.front().place) < -1e-11)) continue;
      const auto one = rebound_as_a_whole(light.body, now, edge, law);
      BOOST_REQUIRE(one.has_value());
      now.velocity = one->velocity_after;
      now.angular_velocity = one->angular_velocity_after;
      goes_on = true;
      ++strikes;
    }
  }
  BOOST_TEST(strikes > 300);
  BOOST_TEST((sum.velocity_after - now.velocity).norm() <= 2e-8);
  BOOST_TEST((sum.angular_velocity_after - now.angular_velocity).norm() <= 1e-6);
}

/// Its edges rattle on for dozens of strikes, each time with friction all along them.
BOOST_AUTO_TEST_CASE(edges_that_rattle_on_give_outcomes_that_mirror_one_another_or_are_left_out_where_asked_for_less) {
  const FlatBox light = needle_in_a_box();
  State before;
  before.velocity = {0, 0, -1};
  const ImpactLaw law{.restitution = 0, .friction = FrictionKind::coulomb, .friction_value = 0.3};
  const OutcomeSet set = tilted_outcomes(light.body, before, light.bottom, law);
  BOOST_TEST(set.is_complete());
  const auto share_of = [&](const Vector3& velocity) {
    double share = 0;
    for (const TiltedOutcome& one : set.outcomes) {
      if ((one.impact.velocity_after - velocity).norm() <= 1e-8) share += one.share;
    }
    return share;
  };
  for (const TiltedOutcome& one : set.outcomes) {
    const Vector3& v = one.impact.velocity_after;
    BOOST_TEST(share_of({-v.x(), v.y(), v.z()}) == one.share, boost::test_tools::tolerance(1e-6));
    BOOST_TEST(share_of({v.x(), -v.y(), v.z()}) == one.share, boost::test_tools::tolerance(1e-6));
    for (const Corner& corner : light.bottom) {
      BOOST_TEST(normal_velocity(v, one.impact.angular_velocity_after, corner.place) >= -1e-9);
    }
  }
  const OutcomeSet some = tilted_outcomes(light.body, before, light.bottom, law, {.rubs = 10});
  double sum = some.open_share;
  for (const TiltedOutcome& one : some.outcomes) sum += one.share;
  BOOST_TEST(sum == 1, boost::test_tools::tolerance(1e-6));
  BOOST_TEST(some.open_share > 0.5);
}

}  // namespace
