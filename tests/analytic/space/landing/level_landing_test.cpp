// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies that land level, in the plane and in space: what comes down at one instant.
#include <algorithm>
#include <array>
#include <bit>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "analytic/plane/sequence.hpp"
#include "analytic/space/sequence/sequence.hpp"
#include "tests/analytic/space/impulse/random_contact.hpp"

namespace {

using clatter::analytic::FrictionKind;
using clatter::analytic::ImpactLaw;
using clatter::analytic::Outcome;
using clatter::analytic::PlanarVelocity;
using clatter::analytic::RestitutionLaw;
using clatter::oracle::Random;
using namespace clatter::analytic::space;
namespace plane = clatter::analytic;

constexpr int landings = CLATTER_TEST_SLOW_BUILD ? 100 : 1000;
/// Some hundred roundings of a landing's speed.
constexpr double tolerance = 1e-13;

/// Every fourth law is Stronge's, Poisson's, Newton's or that of damped ground; the others are without rebound in half
/// of the landings.
ImpactLaw random_law(Random& random, int number) {
  ImpactLaw law;
  law.law = std::array{RestitutionLaw::newton, RestitutionLaw::poisson, RestitutionLaw::stronge,
                       RestitutionLaw::viscoelastic}[number % 4];
  law.restitution = number / 4 % 2 == 0 ? 0 : random.uniform(0, 1);
  if (law.law == RestitutionLaw::viscoelastic) law.restitution = 1, law.damping_per_stiffness = random.uniform(0.1, 5);
  return law;
}

/// A box that lies level on the ground and moves into it.
struct Landing {
  plane::Drop planar;
  Drop in_space;

  [[nodiscard]] double speed() const {
    return std::hypot(planar.velocity.normal, planar.velocity.tangential) +
           std::fabs(planar.velocity.angular) * planar.body.reach();
  }
  /// Normal velocity of its left or right end.
  [[nodiscard]] double of_end(const PlanarVelocity& v, int end) const {
    return v.normal - v.angular * planar.body.vertices[end].x;
  }
};

Landing planar_landing(Random& random, int number) {
  Landing one;
  const double length = random.uniform(0.1, 2), height = random.uniform(0.1, 2), width = random.uniform(0.1, 2);
  plane::Drop& drop = one.planar;
  drop.body = plane::make_box({.mass = 1.5, .length = length, .width = width, .thickness = height});
  drop.law = random_law(random, number);
  if (number / 8 % 2 == 1) drop.law.friction = FrictionKind::coulomb, drop.law.friction_value = random.uniform(0, 10);
  drop.gravity = number / 16 % 2 == 1 ? random.uniform(0.5, 10) : 0;
  do {
    drop.velocity = {
        .normal = random.uniform(-1, 0.5), .tangential = random.uniform(-1, 1), .angular = random.uniform(-3, 3)};
  } while (!(one.of_end(drop.velocity, 0) < 0 || one.of_end(drop.velocity, 1) < 0));
  one.in_space = {.body = box(1.5, {.size = {length, width, height}}),
                  .velocity = {drop.velocity.tangential, 0, drop.velocity.normal},
                  .angular_velocity = {0, drop.velocity.angular, 0},
                  .gravity = drop.gravity,
                  .law = drop.law};
  return one;
}

/// The planar body's velocity once all that strikes at the first instant has; nothing if that is not followed to its
/// end.
std::optional<PlanarVelocity> after_first_instant(const plane::Sequence& sequence) {
  std::size_t rows = 0;
  while (rows < sequence.rows.size() && sequence.rows[rows].start == 0) ++rows;
  if (rows < sequence.rows.size()) return sequence.rows[rows - 1].impact.after;
  if (sequence.outcome == Outcome::impact_limit || sequence.outcome == Outcome::not_computed) return {};
  if (const auto& tail = sequence.tail; tail && tail->end_time == 0)
    return PlanarVelocity{.normal = tail->velocity_after.z(),
                          .tangential = tail->velocity_after.x(),
                          .angular = tail->angular_velocity_after.y()};
  return sequence.rows.back().impact.after;
}

double impulse_of_first_instant(const plane::Sequence& sequence) {
  double sum = 0;
  for (const plane::ImpactRow& row : sequence.rows) sum += row.start == 0 ? row.impact.normal_impulse : 0;
  if (sequence.rows.back().start == 0 && sequence.tail && sequence.tail->end_time == 0)
    sum += sequence.tail->normal_impulse;
  return sum;
}

/// Mirrored at y = 0; a rotation vector is an axial one.
Vector3 mirrored(const Vector3& v) { return {v.x(), -v.y(), v.z()}; }
Vector3 mirrored_turn(const Vector3& v) { return {-v.x(), v.y(), -v.z()}; }

/// The lower corners of a box whose attitude is a turn about the vertical.
std::vector<Corner> lower_corners(const Body& body) {
  std::vector<Corner> corners;
  for (std::size_t i = 0; i < body.vertices.size(); ++i) {
    if (body.vertices[i].z() < 0) corners.push_back({static_cast<int>(i), body.vertices[i]});
  }
  return corners;
}

double speed_of(const State& s, const Body& body) {
  return s.velocity.norm() + s.angular_velocity.norm() * body.reach();
}

void check_same(const GroupImpact& a, const Vector3& velocity, const Vector3& turning, double margin) {
  BOOST_TEST((a.velocity_after - velocity).norm() <= margin);
  BOOST_TEST((a.angular_velocity_after - turning).norm() <= 20 * margin);
}

}  // namespace

BOOST_AUTO_TEST_CASE(no_end_that_is_on_the_ground_moves_into_it_after_a_level_landing_in_the_plane) {
  Random random(12);
  int followed = 0;
  for (int n = 0; n < landings; ++n) {
    const Landing one = planar_landing(random, n);
    const plane::Sequence sequence = plane::impact_sequence(one.planar, {.impacts = 2000});
    const auto after = after_first_instant(sequence);
    if (!after) continue;
    ++followed;
    const double speed = one.speed(), mass = one.planar.body.mass;
    BOOST_TEST_CONTEXT("landing " << n << ": " << sequence.message) {
      for (const int end : {0, 1}) BOOST_TEST(one.of_end(*after, end) >= -100 * tolerance * speed);
      const double gained = mass * (after->normal - one.planar.velocity.normal);
      BOOST_TEST(std::fabs(impulse_of_first_instant(sequence) - gained) <= 100 * tolerance * mass * speed);
    }
  }
  BOOST_TEST(followed > landings * 9 / 10);
}

BOOST_AUTO_TEST_CASE(a_level_landing_without_rebound_takes_the_same_impulses_with_gravity_and_without) {
  Random random(13);
  for (int n = 0; n < landings / 2; ++n) {
    Landing one = planar_landing(random, n);
    if (one.planar.law.law != RestitutionLaw::viscoelastic) one.planar.law.restitution = 0;
    one.planar.gravity = 0;
    plane::Drop falling = one.planar;
    falling.gravity = 9.81;
    const plane::Sequence without = plane::impact_sequence(one.planar, {.impacts = 2000});
    const plane::Sequence with = plane::impact_sequence(falling, {.impacts = 2000});
    BOOST_TEST_CONTEXT("landing " << n << ": " << without.message << " | " << with.message) {
      for (std::size_t i = 0; i < without.rows.size() && without.rows[i].start == 0; ++i) {
        BOOST_TEST_REQUIRE(i < with.rows.size());
        BOOST_TEST(with.rows[i].vertices == without.rows[i].vertices);
        BOOST_TEST(with.rows[i].start == 0);
        BOOST_TEST(with.rows[i].impact.normal_impulse == without.rows[i].impact.normal_impulse);
      }
      BOOST_TEST(impulse_of_first_instant(with) == impulse_of_first_instant(without));
    }
  }
}

BOOST_AUTO_TEST_CASE(
    the_ends_of_a_level_bar_without_rebound_strike_in_turn_until_their_impulses_sum_up_to_its_momentum) {
  // An impulse P at one end changes its velocity by (1 + d²/k²) P/m, that of the other by (1 − d²/k²) P/m.
  for (const double gravity : {0.0, 9.81}) {
    const double length = 0.2, height = 0.18, speed = 0.1, spin = 1;
    plane::Drop drop;
    drop.body = plane::make_box({.mass = 2, .length = length, .width = 1, .thickness = height});
    drop.velocity = {.normal = -speed, .angular = spin};
    drop.gravity = gravity;
    drop.law.restitution = 0;
    const double square = length * length / 4 / drop.body.gyration_square, part = (square - 1) / (square + 1);
    BOOST_TEST_REQUIRE(part > 0);
    double approach = speed + spin * length / 2, other = speed - spin * length / 2;
    const plane::Sequence sequence = plane::impact_sequence(drop, {.impacts = 200});
    BOOST_TEST_CONTEXT("gravity " << gravity << ": " << sequence.message) {
      BOOST_TEST((sequence.outcome == Outcome::at_rest));
      for (std::size_t i = 0; i < sequence.rows.size(); ++i) {
        const double impulse = 2 * approach / (1 + square);
        BOOST_TEST(sequence.rows[i].vertices == (i % 2 == 0 ? 2 : 1));
        BOOST_TEST(std::fabs(sequence.rows[i].impact.normal_impulse / impulse - 1) <= 1e-12);
        const double pushed = other + part * approach;
        other = 0;
        approach = pushed;
      }
      BOOST_TEST(std::fabs(sequence.total_normal_impulse - 2 * speed) <= 1e-14);
      BOOST_TEST(sequence.total_normal_impulse_error <= 1e-13);
    }
  }
}

BOOST_AUTO_TEST_CASE(level_landings_in_the_plane_and_in_space_leave_the_body_with_the_same_motion) {
  Random random(14);
  int compared = 0, wrong = 0;
  for (int n = 0; n < 2 * landings; ++n) {
    const Landing one = planar_landing(random, n);
    const bool both = one.of_end(one.planar.velocity, 0) < 0 && one.of_end(one.planar.velocity, 1) < 0;
    if (one.planar.law.rubs() && !both) continue;  // friction has a pressure where the face rebounds as a whole
    const plane::Sequence planar = plane::impact_sequence(one.planar, {.impacts = 2000});
    const auto after = after_first_instant(planar);
    if (!after || (both && std::popcount(planar.rows.front().vertices) < 2)) continue;
    const Sequence in_space = impact_sequence(one.in_space, {.impacts = 1});
    const Impact& impact = in_space.rows.front().impact;
    const double margin = 1e-10 * one.speed();
    const bool same = std::fabs(impact.velocity_after.z() - after->normal) <= margin &&
                      std::fabs(impact.velocity_after.x() - after->tangential) <= margin &&
                      std::fabs(impact.angular_velocity_after.y() - after->angular) <= 20 * margin;
    ++compared;
    if (!same && ++wrong < 6) {
      BOOST_TEST_MESSAGE("landing " << n << ": " << after->normal << " " << after->tangential << " " << after->angular
                                    << " | " << impact.velocity_after.transpose() << " "
                                    << impact.angular_velocity_after.transpose() << " " << planar.message);
    }
  }
  BOOST_TEST(compared > landings / 2);
  BOOST_TEST(wrong == 0);
}

// The slip across makes the drop one in space, and does nothing without friction.
BOOST_AUTO_TEST_CASE(
    a_box_that_is_tilted_by_next_to_nothing_lands_alike_in_the_plane_and_in_space_or_has_no_error_bars) {
  struct Size {
    double length, width, height;
  };
  int level = 0, open = 0, tilted = 0;
  for (const Size& size : {Size{0.1, 0.07, 0.001}, Size{0.1, 2, 0.02}, Size{0.3, 0.3, 0.3}}) {
    for (const double degrees : {0.0, 1e-17, 1e-16, 1e-15, 1e-14, 1e-13, 2e-13, 1e-12, 1e-11, 1e-10, 1e-9}) {
      for (const double side : {1.0, -1.0}) {
        const plane::Drop planar{
            .body = plane::make_box({.mass = 1, .length = size.length, .width = size.width, .thickness = size.height}),
            .inclination = plane::Angle::from_degrees(side * degrees),
            .velocity = {.normal = -1},
            .law = {}};
        const double half = side * degrees * std::numbers::pi / 360;
        const Drop drop{.body = box(1, {.size = {size.length, size.width, size.height}}),
                        .attitude = Quaternion(std::cos(half), 0, -std::sin(half), 0),
                        .velocity = {0, 1e-9, -1},
                        .law = {}};
        const plane::Sequence in_plane = plane::impact_sequence(planar, {.impacts = 1});
        const Sequence in_space = impact_sequence(drop, {.impacts = 1});
        const ImpactRow& row = in_space.rows.front();
        const double apart = row.impact.impulse.z() - in_plane.rows.front().impact.normal_impulse;
        BOOST_TEST_CONTEXT(size.width << " m wide, " << side * degrees << " degrees") {
          BOOST_TEST((std::fabs(apart) <= 1e-12 || !row.error.predictable));
          if (degrees <= 1e-13) BOOST_TEST((row.error.predictable && row.corners.size() == 4));
          if (degrees == 2e-13) BOOST_TEST(!row.error.predictable);
        }
        ++(!row.error.predictable ? open : row.corners.size() == 4 ? level : tilted);
      }
    }
  }
  BOOST_TEST(level > 0);
  BOOST_TEST(open > 0);
  BOOST_TEST(tilted > 0);
}

BOOST_AUTO_TEST_CASE(no_corner_that_is_on_the_ground_moves_into_it_after_a_level_landing_in_space) {
  Random random(15);
  for (int n = 0; n < landings; ++n) {
    const Body body =
        box(random.uniform(0.5, 2), {.size = {random.uniform(0.1, 2), random.uniform(0.1, 2), random.uniform(0.1, 2)}});
    ImpactLaw law = random_law(random, n);
    if (n / 8 % 2 == 1) law.friction = FrictionKind::coulomb, law.friction_value = random.uniform(0, 0.5);
    State before;
    before.attitude = Quaternion(Eigen::AngleAxisd(random.uniform(0, 6), Vector3::UnitZ()));
    before.velocity = random.vector(1) - Vector3(0, 0, 0.6);
    before.angular_velocity = random.vector(3);
    const std::vector<Corner> corners = lower_corners(body);
    const double speed = speed_of(before, body);
    const GroupImpact impact = strike_together(body, before, corners, law);
    State after = before;
    after.velocity = impact.velocity_after;
    after.angular_velocity = impact.angular_velocity_after;
    BOOST_TEST_CONTEXT("landing " << n) {
      for (const Corner& corner : corners) BOOST_TEST(velocity_at(after, corner.place).z() >= -1e-12 * speed);
      BOOST_TEST((impact.impulse - body.mass * (after.velocity - before.velocity)).norm() <= 1e-12 * body.mass * speed);
    }
  }
}

BOOST_AUTO_TEST_CASE(a_level_landing_mirrored_or_with_its_corners_in_another_order_is_the_same_landing) {
  Random random(16);
  for (int n = 0; n < landings; ++n) {
    const Body body =
        box(random.uniform(0.5, 2), {.size = {random.uniform(0.1, 2), random.uniform(0.1, 2), random.uniform(0.1, 2)}});
    ImpactLaw law = random_law(random, n);
    if (n / 8 % 2 == 1) law.friction = FrictionKind::coulomb, law.friction_value = random.uniform(0, 0.5);
    // Some of the motion vanishes in most of the landings: corners are then equally fast.
    const auto some = [&](double size) { return random.whole(0, 2) == 0 ? random.uniform(-size, size) : 0; };
    State before;
    before.velocity = {some(1), some(1), -random.uniform(0.1, 1)};
    before.angular_velocity = {some(1), some(1), some(3)};
    std::vector<Corner> corners = lower_corners(body);
    State image = before;
    image.velocity = mirrored(before.velocity);
    image.angular_velocity = mirrored_turn(before.angular_velocity);
    const GroupImpact impact = strike_together(body, before, corners, law);
    if (impact.is_open) continue;
    const double margin = (1e-11 + 3 * impact.path_error) * speed_of(before, body);
    BOOST_TEST_CONTEXT("landing " << n) {
      check_same(strike_together(body, image, corners, law), mirrored(impact.velocity_after),
                 mirrored_turn(impact.angular_velocity_after), margin);
      std::ranges::reverse(corners);
      check_same(strike_together(body, before, corners, law), impact.velocity_after, impact.angular_velocity_after,
                 margin);
      std::ranges::rotate(corners, corners.begin() + 1);
      check_same(strike_together(body, before, corners, law), impact.velocity_after, impact.angular_velocity_after,
                 margin);
    }
  }
}

BOOST_AUTO_TEST_CASE(a_landing_of_which_an_index_decides_the_first_corner_has_no_error_bars) {
  Drop drop;
  drop.body = box(1, {.size = {0.1, 0.1, 0.4}});
  drop.velocity = {0.1, 0.05, -1};
  drop.angular_velocity = {0, 0, 1e-6};
  drop.law.restitution = 0.66;
  drop.law.friction = FrictionKind::coulomb;
  drop.law.friction_value = 0.1;
  const ImpactRow flat = impact_sequence(drop, {.impacts = 1}).rows.at(0);
  BOOST_TEST(flat.group.value().is_whole);
  BOOST_TEST(!flat.group->is_open);
  BOOST_TEST(flat.error.predictable);
  // An edge whose friction along it asks for pushes beyond its end is tipped, and no index decides.
  drop.attitude = Quaternion(Eigen::AngleAxisd(0.2, Vector3::UnitY()));
  drop.velocity = {0, 0.5, -1};
  drop.angular_velocity = Vector3::Zero();
  drop.law.friction_value = 0.6;
  const ImpactRow tipped = impact_sequence(drop, {.impacts = 1}).rows.at(0);
  BOOST_TEST(!tipped.group.value().is_open);
  // A face that does not lie below the centre of mass.
  drop.attitude = Quaternion::Identity();
  for (Vector3& corner : drop.body.vertices) corner.x() += 0.08;
  const ImpactRow aside = impact_sequence(drop, {.impacts = 1}).rows.at(0);
  BOOST_TEST(aside.group.value().is_open);
  BOOST_TEST(!aside.error.predictable);
}

namespace {

/// A box that lands flat on one of its sides, so high for its base that friction tips it in half of the landings.
struct TallLanding {
  Body body;
  State before;
  ImpactLaw law;

  TallLanding(Random& random, int number) {
    const double height = random.uniform(0.5, 4);
    body = box(1, {.size = {random.uniform(0.7, 1.4), random.uniform(0.7, 1.4), height}});
    if (number % 3 == 0) body.inertia(0, 2) = body.inertia(2, 0) = 0.03;
    law = random_law(random, number);
    law.friction = FrictionKind::coulomb;
    law.friction_value = random.uniform(0.1, 1);
    const auto size = [&] { return std::pow(10.0, -random.whole(0, 12)); };
    before.velocity = {size() * random.uniform(-1, 1), size() * random.uniform(-1, 1), -random.uniform(0.5, 1)};
    before.angular_velocity = {0, 0, size() * random.uniform(-1, 1)};
  }
  [[nodiscard]] GroupImpact land() const { return strike_together(body, before, lower_corners(body), law); }
  [[nodiscard]] double energy(const Vector3& velocity, const Vector3& turning) const {
    return (body.mass * velocity.squaredNorm() + turning.dot(body.inertia * turning)) / 2;
  }
};

}  // namespace

BOOST_AUTO_TEST_CASE(a_slip_or_spin_of_1e_9_changes_the_landing_of_a_tall_box_by_as_little_and_it_gains_no_energy) {
  Random random(17);
  int tilted = 0;
  for (int n = 0; n < 60; ++n) {
    TallLanding one(random, n);
    const GroupImpact impact = one.land();
    const Vector3 &velocity = one.before.velocity, &turning = one.before.angular_velocity;
    BOOST_TEST_CONTEXT("landing " << n) {
      if (impact.is_open) continue;  // the edge that strikes after the face has no pressure
      if (impact.tilts) ++tilted;
      BOOST_TEST((impact.impulse - one.body.mass * (impact.velocity_after - velocity)).norm() <= 1e-12);
      BOOST_TEST((impact.moment - one.body.inertia * (impact.angular_velocity_after - turning)).norm() <= 1e-12);
      BOOST_TEST(one.energy(impact.velocity_after, impact.angular_velocity_after) <=
                 one.energy(velocity, turning) * (1 + 1e-12));
      constexpr double kick = 1e-9;
      one.before.velocity += kick * Vector3(0.6, -0.8, 0);
      one.before.angular_velocity.z() += kick;
      const double margin = 100 * kick + 3 * impact.path_error;
      check_same(one.land(), impact.velocity_after, impact.angular_velocity_after, margin);
    }
  }
  BOOST_TEST(tilted > 20);
}

namespace {

constexpr double half_angle = std::numbers::pi / 8;  ///< between a spoke of the wheel and the middle of two

/// A rimless wheel with eight spokes of length 1 and pairs of feet `width` apart, m = 1, that comes over from feet 0
/// and 8 to feet 1 and 9 at the rate 1.
struct Wheel {
  Body body;
  State before;

  Wheel(double inertia, double width) {
    const double across = inertia / 2 + width * width / 12;
    body.inertia = Vector3(across, inertia, across).asDiagonal();
    for (const double side : {-width / 2, width / 2}) {
      for (int spoke = 0; spoke < 8; ++spoke) {
        const double angle = (2 * spoke - 1) * half_angle - std::numbers::pi / 2;
        body.vertices.emplace_back(std::cos(angle), side, std::sin(angle));
      }
    }
    before.angular_velocity = {0, 1, 0};
    before.velocity = -before.angular_velocity.cross(body.vertices[0]);
    before.velocity.y() = 0;
  }
  [[nodiscard]] Corner corner(int i) const { return {i, body.vertices[i]}; }
};

}  // namespace

BOOST_AUTO_TEST_CASE(a_wheel_of_spokes_that_comes_down_on_two_feet_keeps_its_spin_about_both) {
  ImpactLaw law;
  law.restitution = 0;
  law.friction = FrictionKind::coulomb;
  law.friction_value = 10;
  for (int k = 0; k <= 80; ++k) {
    const double inertia = std::pow(10.0, -6 + 6 * k / 80.0);
    const double right = (inertia + std::cos(2 * half_angle)) / (inertia + 1);
    for (const double width : {0.02, 0.3, 1.0}) {
      const Wheel wheel(inertia, width);
      const std::vector<int> feet[] = {{0, 8, 1, 9}, {9, 1, 8, 0}, {1, 9, 0, 8}, {1, 9}, {9, 1}};
      for (const std::vector<int>& order : feet) {
        std::vector<Corner> corners;
        for (const int i : order) corners.push_back(wheel.corner(i));
        const GroupImpact impact = strike_together(wheel.body, wheel.before, corners, law);
        BOOST_TEST_CONTEXT("inertia " << inertia << ", width " << width << ", foot " << order[0] << " first") {
          BOOST_TEST(std::fabs(impact.angular_velocity_after.y() - right) <= 1e-9);
          BOOST_TEST(std::fabs(impact.impulse.y()) <= 1e-9);
          BOOST_TEST(impact.order.size() == 1u);
        }
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(a_wheel_that_rolls_over_its_feet_loses_at_each_what_its_closed_form_says) {
  for (const double inertia : {1e-5, 1e-4, 1e-3, 0.1}) {
    const Wheel wheel(inertia, 0.3);
    Drop drop{.body = wheel.body,
              .velocity = wheel.before.velocity,
              .angular_velocity = {0, 1, 0},
              .gravity = 0.1,
              .law = {}};
    drop.law.restitution = 0;
    drop.law.friction = FrictionKind::coulomb;
    drop.law.friction_value = 10;
    const double lost = (inertia + std::cos(2 * half_angle)) / (inertia + 1);
    // From foot to foot without loss between: the centre is as high at each landing.
    const Sequence sequence = impact_sequence(drop, {.impacts = 4, .until_rest = true});
    double rate = 1;
    BOOST_TEST_CONTEXT("inertia " << inertia << ": " << sequence.message) {
      BOOST_TEST(sequence.rows.size() >= 3u);
      for (const ImpactRow& row : sequence.rows) {
        rate *= lost;
        const double margin = std::fmax(1e-9, row.error.angular_velocity_after);
        BOOST_TEST(std::fabs(row.impact.angular_velocity_after.y() - rate) <= margin);
        BOOST_TEST(std::fabs(row.impact.impulse.y()) <= 1e-8);
      }
    }
  }
}

// Turned about the vertical, so that no number of its motion is zero.  A spoke's turn about its foot keeps the energy.
BOOST_AUTO_TEST_CASE(a_wheel_under_its_weight_rolls_over_its_feet_by_the_closed_form_until_it_falls_back) {
  for (const double inertia : {1e-6, 1e-5, 1e-3}) {
    for (const double yaw : {0.0, 0.7}) {
      const Wheel wheel(inertia, 0.5);
      const Eigen::AngleAxisd turn(yaw, Vector3::UnitZ());
      Drop drop{.body = wheel.body,
                .attitude = Quaternion(turn),
                .velocity = turn * wheel.before.velocity,
                .angular_velocity = turn * wheel.before.angular_velocity,
                .gravity = 1.4,
                .law = {}};
      drop.law.restitution = 0;
      drop.law.friction = FrictionKind::coulomb;
      drop.law.friction_value = 10;
      drop.velocity *= 1.5, drop.angular_velocity *= 1.5;
      const double lost = (inertia + std::cos(2 * half_angle)) / (inertia + 1);
      const double climb = 2 * drop.gravity * (1 - std::cos(half_angle)) / (inertia + 1);
      const Sequence sequence = impact_sequence(drop, {.impacts = 20, .until_rest = true});
      BOOST_TEST_CONTEXT("inertia " << inertia << ", yaw " << yaw << ": " << sequence.message) {
        double rate = 1.5 * lost;
        for (std::size_t n = 0;; rate *= lost, ++n) {
          BOOST_REQUIRE(sequence.rows.size() > n);
          const ImpactRow& row = sequence.rows[n];
          BOOST_TEST(std::fabs(row.impact.angular_velocity_after.head<2>().norm() - rate) <= 1e-9);
          BOOST_TEST(std::fabs(row.impact.angular_velocity_after.z()) <= 1e-9);
          if (rate * rate < climb) break;
        }
      }
    }
  }
}
