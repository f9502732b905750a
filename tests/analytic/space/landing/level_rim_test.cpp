// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/space/landing/level_rim.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>

#include "analytic/space/flight/body.hpp"
#include "analytic/space/landing/tilted_outcomes.hpp"
#include "analytic/space/sequence/sequence.hpp"
#include "tests/analytic/space/impulse/random_contact.hpp"
#include "validation/oracles/impulse_path.hpp"

namespace {

constexpr int scale = CLATTER_TEST_SLOW_BUILD ? 1 : 12;

using clatter::analytic::FrictionKind;
using clatter::analytic::ImpactLaw;
using clatter::analytic::Outcome;
using clatter::analytic::RestitutionLaw;
using namespace clatter::analytic::space;
using clatter::oracle::Random;

ImpactLaw law_of(double e, double friction) {
  ImpactLaw law;
  law.restitution = e;
  if (friction > 0) law.friction = FrictionKind::coulomb, law.friction_value = friction;
  return law;
}

/// A body with its lower end on the ground, attitude the identity: the rim's axis is z.
struct Upright {
  double radius = 0, depth = 0;
  Vector2 foot = Vector2::Zero();  ///< of the rim's centre below the centre of mass
  Body body;
  Corner rim;
  State before;

  void finish() {
    body.rims = {{.centre = {foot.x(), foot.y(), -depth}, .axis = Vector3::UnitZ(), .radius = radius}};
    rim = {.index = 0, .place = body.rims[0].centre, .radius = radius};
  }
  [[nodiscard]] Vector3 point(double angle) const {
    return rim.place + Vector3(radius * std::cos(angle), radius * std::sin(angle), 0);
  }
};

/// A uniform cylinder along z.
Upright cylinder_on_its_end(double radius, double height) {
  Upright u{.radius = radius, .depth = height / 2, .body = {}, .rim = {}, .before = {}};
  const double across = (3 * radius * radius + height * height) / 12;
  u.body.inertia = Vector3(across, across, radius * radius / 2).asDiagonal();
  u.finish();
  return u;
}

/// Any inertia, the centre of mass anywhere above the round end.
Upright random_end(Random& random) {
  Upright u{.radius = random.uniform(0.1, 1), .depth = random.uniform(0.1, 1), .body = {}, .rim = {}, .before = {}};
  u.body = clatter::oracle::random_collision(random).body;
  u.body.vertices.clear();
  u.foot = 0.6 * u.radius * Vector2(random.uniform(-1, 1), random.uniform(-1, 1));
  u.finish();
  u.before.velocity = random.vector(1) - Vector3(0, 0, 1.2);
  u.before.angular_velocity = random.vector(1.5);
  return u;
}

double rise(const Vector3& v, const Vector3& spin, const Vector3& arm) { return (v + spin.cross(arm)).z(); }
double rise_before(const Upright& u, double angle) {
  return rise(u.before.velocity, u.before.angular_velocity, u.point(angle));
}
double rise_after(const Upright& u, const GroupImpact& impact, double angle) {
  return rise(impact.velocity_after, impact.angular_velocity_after, u.point(angle));
}

std::vector<Corner> polygon(const Upright& u, int sides, double first = 0) {
  std::vector<Corner> corners;
  for (int i = 0; i < sides; ++i) {
    corners.push_back({.index = i, .place = u.point(first + 2 * std::numbers::pi * i / sides)});
  }
  return corners;
}

double kinetic_energy(const Body& body, const Vector3& v, const Vector3& spin) {
  return (body.mass * v.squaredNorm() + spin.dot(body.inertia * spin)) / 2;
}

Quaternion upright(double tilt = 0) {
  return Quaternion(Eigen::AngleAxisd(-std::numbers::pi / 2 + tilt, Vector3::UnitY()));
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_level_rim_on_damped_ground_bounces_as_a_mass_at_its_pressure_centre_does) {
  constexpr double tolerance = 1e-9;  // integrated_restitution()
  Upright can = cylinder_on_its_end(0.4, 0.6);
  can.before.velocity = {0.3, -0.2, -1.3};
  can.before.angular_velocity = {0.5, -0.7, 2};
  ImpactLaw law = law_of(1, 0);
  law.law = RestitutionLaw::viscoelastic;
  law.damping_per_stiffness = 0.6;
  const auto whole = LevelRim(can.body, can.before, can.rim, law).rebound_as_a_whole();
  BOOST_REQUIRE(whole.has_value());
  const Vector3 centre(-whole->moment.y() / whole->impulse.z(), whole->moment.x() / whole->impulse.z(), 0);
  const double e =
      clatter::oracle::integrated_restitution(0.6, -rise(can.before.velocity, can.before.angular_velocity, centre));
  BOOST_TEST(centre.norm() > 0.01);
  for (const double angle : {0.0, 1.0, 2.5, 4.0}) {
    BOOST_TEST(std::fabs(rise_after(can, *whole, angle) + e * rise_before(can, angle)) <= tolerance);
  }
}

BOOST_AUTO_TEST_CASE(an_upright_cylinder_without_spin_rebounds_flat_with_e_and_slides_or_stops_as_friction_has_it) {
  constexpr double tolerance = 1e-15;
  for (const double mu : {0.0, 0.1, 0.4, 1.2}) {
    const double e = 0.6;
    const Drop drop{.body = cylinder(2, {.length = 0.8, .radius = 0.5}),
                    .attitude = upright(),
                    .velocity = Vector3(0.3, 0.4, -1),
                    .law = law_of(e, mu)};
    const Sequence sequence = impact_sequence(drop, {.impacts = 1});
    const ImpactRow& row = sequence.rows.at(0);
    BOOST_REQUIRE(row.group && row.group->is_whole);
    BOOST_TEST(row.corners.size() == 1u);
    BOOST_TEST(row.corners[0].radius == 0.5);
    const double normal = 2 * (1 + e), tangential = std::fmin(mu * normal, 2 * 0.5);
    BOOST_CHECK_LE((row.impact.impulse - Vector3(-0.6 * tangential, -0.8 * tangential, normal)).norm(), tolerance * 4);
    BOOST_CHECK_LE(row.impact.angular_velocity_after.norm(), 0);
    BOOST_CHECK_LE(std::fabs(row.impact.velocity_after.z() - e), tolerance);
  }
}

BOOST_AUTO_TEST_CASE(a_can_so_high_that_friction_tips_it_is_pushed_at_its_rim_while_it_slides) {
  constexpr double tolerance = 1e-9;
  Upright can = cylinder_on_its_end(0.1, 1);
  const double mu = 0.5, normal = 1.5;
  for (const double direction : {0.0, 0.7, 2.0}) {
    const Vector3 ahead(std::cos(direction), std::sin(direction), 0);
    can.before.velocity = 3 * ahead - Vector3::UnitZ();
    const GroupImpact impact = strike_together(can.body, can.before, std::vector{can.rim}, law_of(0.5, mu));
    const double tilt = normal * (mu * can.depth - can.radius) / can.body.inertia(0, 0);
    BOOST_TEST(impact.tilts);
    BOOST_TEST(!impact.is_open);
    BOOST_TEST((impact.velocity_after - (3 - mu * normal) * ahead - 0.5 * Vector3::UnitZ()).norm() <= tolerance);
    BOOST_TEST((impact.angular_velocity_after - tilt * Vector3::UnitZ().cross(ahead)).norm() <= 10 * tolerance);
    // Slip that is all but nothing: the can lands as one that does not slip.
    can.before.velocity = 1e-9 * ahead - Vector3::UnitZ();
    can.before.angular_velocity = {0, 0, 1e-9};
    const GroupImpact still = strike_together(can.body, can.before, std::vector{can.rim}, law_of(0.5, mu));
    BOOST_TEST((still.velocity_after - 0.5 * Vector3::UnitZ()).norm() <= 1e-7);
    BOOST_TEST(still.angular_velocity_after.norm() <= 1e-7);
    can.before.angular_velocity.setZero();
  }
}

BOOST_AUTO_TEST_CASE(
    a_slip_or_spin_of_1e_9_changes_the_landing_of_a_can_by_as_little_and_its_mirror_image_is_mirrored) {
  constexpr double kick = 1e-9;
  const Matrix3 mirror = Vector3(1, -1, 1).asDiagonal();
  Random random(21);
  int tipped = 0;
  for (int n = 0; n < 10 * scale; ++n) {
    const auto little = [&] { return std::pow(10.0, -random.whole(0, 12)) * random.uniform(-1, 1); };
    Upright can = cylinder_on_its_end(random.uniform(0.1, 0.4), 1);
    can.body.inertia(0, 2) = can.body.inertia(2, 0) = random.uniform(-0.1, 0.1) * can.body.inertia(2, 2);
    can.before.velocity = {little(), little(), -1};
    can.before.angular_velocity = {0, 0, little()};
    if (n % 3 == 0) can.before.angular_velocity.head<2>() << random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3);
    ImpactLaw law = law_of(random.uniform(0, 1), random.uniform(0.1, 1));
    law.law = n % 2 == 0 ? RestitutionLaw::poisson : RestitutionLaw::stronge;
    const auto land = [&](const Upright& u) { return strike_together(u.body, u.before, std::vector{u.rim}, law); };
    const GroupImpact impact = land(can);
    BOOST_TEST_CONTEXT("landing " << n) {
      BOOST_TEST(!impact.is_open);
      BOOST_TEST(impact.energy_loss >= -1e-12);
      if (impact.tilts) ++tipped;
      Upright image = can, kicked = can;
      image.body.inertia = mirror * can.body.inertia * mirror;
      image.before.velocity = mirror * can.before.velocity;
      image.before.angular_velocity = -mirror * can.before.angular_velocity;
      const GroupImpact mirrored = land(image);
      const double margin = 1e-11 + 6 * impact.path_error;
      BOOST_TEST((mirror * mirrored.velocity_after - impact.velocity_after).norm() <= margin);
      BOOST_TEST((mirror * mirrored.angular_velocity_after + impact.angular_velocity_after).norm() <= 10 * margin);
      kicked.before.velocity += kick * Vector3(0.6, -0.8, 0);
      kicked.before.angular_velocity.z() += kick;
      const GroupImpact then = land(kicked);
      BOOST_TEST((then.velocity_after - impact.velocity_after).norm() <= margin + 300 * kick);
      BOOST_TEST((then.angular_velocity_after - impact.angular_velocity_after).norm() <= 10 * (margin + 300 * kick));
    }
  }
  BOOST_TEST(tipped > 3 * scale);
}

BOOST_AUTO_TEST_CASE(
    a_level_rim_of_which_all_points_approach_leaves_with_e_times_their_approach_where_pushes_can_do_it) {
  Random random(1);
  int whole_ones = 0, others = 0;
  for (int i = 0; i < 150 * scale; ++i) {
    Upright u = random_end(random);
    u.before.velocity.z() -= 2 * u.radius;
    const double e = random.uniform(0, 1), mu = random.whole(1, 2) == 1 ? 0 : random.uniform(0, 1);
    bool all_approach = true;
    for (int k = 0; k < 360; ++k) all_approach = all_approach && rise_before(u, k * std::numbers::pi / 180) < -0.01;
    if (!all_approach) continue;
    const ImpactLaw law = law_of(e, mu);
    const auto whole = rebound_as_a_whole(u.body, u.before, std::vector{u.rim}, law);
    // Without friction a polygon inside the rim needs no more than the rim, and one around it no less; with friction
    // the pressures over them differ, and with those the slip.
    if (mu == 0) {
      const auto inside = rebound_as_a_whole(u.body, u.before, polygon(u, 360), law);
      Upright wider = u;
      wider.radius /= std::cos(std::numbers::pi / 360);
      const auto around = rebound_as_a_whole(u.body, u.before, polygon(wider, 360), law);
      if (inside) BOOST_CHECK(whole.has_value());
      if (whole) BOOST_CHECK(around.has_value());
    }
    ++(whole ? whole_ones : others);
    if (!whole || whole->tilts) continue;
    for (const double angle : {0.0, 1.0, 2.5, 4.0}) {
      BOOST_CHECK_LE(std::fabs(rise_after(u, *whole, angle) + e * rise_before(u, angle)), 1e-13 * 10);
    }
  }
  BOOST_CHECK_GT(whole_ones, 15 * scale);
  BOOST_CHECK_GT(others, 15 * scale);
}

BOOST_AUTO_TEST_CASE(
    points_of_a_level_rim_that_cannot_rebound_as_a_whole_strike_the_fastest_first_until_none_approaches) {
  Random random(2);
  int several = 0;
  for (int i = 0; i < 100 * scale; ++i) {
    const Upright u = random_end(random);
    ImpactLaw law =
        law_of(random.whole(1, 4) == 1 ? 0 : random.uniform(0, 1), random.whole(1, 2) == 1 ? 0 : random.uniform(0, 1));
    law.law = RestitutionLaw::stronge;
    const GroupImpact impact = strike_together(u.body, u.before, std::vector{u.rim}, law);
    double fastest = 0, where = 0, slowest_after = 1e9;
    for (int k = 0; k < 3600; ++k) {
      const double angle = k * std::numbers::pi / 1800, approach = -rise_before(u, angle);
      if (approach > fastest) fastest = approach, where = angle;
      slowest_after = std::fmin(slowest_after, rise_after(u, impact, angle));
    }
    BOOST_CHECK_GE(slowest_after, -1e-12);
    BOOST_CHECK_LE(std::fabs(impact.approach_speed - fastest), 1e-5 * fastest);
    const double energy = kinetic_energy(u.body, u.before.velocity, u.before.angular_velocity);
    const double after = kinetic_energy(u.body, impact.velocity_after, impact.angular_velocity_after);
    BOOST_CHECK_LE(std::fabs(energy - after - impact.energy_loss), 1e-12 * energy);
    // A face with friction that rebounds as a whole obeys Newton's law, which can create energy.
    if (!impact.is_whole || law.friction == FrictionKind::none) BOOST_CHECK_GE(impact.energy_loss, -1e-12 * energy);
    if (impact.is_whole || impact.tilts || impact.order.empty()) continue;
    if (impact.order.size() > 1) ++several;
    if (impact.order.size() != 1) continue;
    const Impact alone = strike(u.body, u.before, u.point(where), law);
    BOOST_CHECK_LE((alone.velocity_after - impact.velocity_after).norm(), 0.02 * alone.impulse.norm() / u.body.mass);
  }
  BOOST_CHECK_GT(several, 5 * scale);
}

BOOST_AUTO_TEST_CASE(a_cylinder_that_lands_level_while_it_turns_strikes_like_the_two_ends_of_its_diameter) {
  Random random(3);
  for (int i = 0; i < 500; ++i) {
    Upright u = cylinder_on_its_end(random.uniform(0.1, 1), random.uniform(0.1, 2));
    const double direction = random.uniform(0, 6.28), spin = random.uniform(-3, 3);
    u.before.velocity = {0, 0, -random.uniform(0.1, 2)};
    u.before.angular_velocity = {spin * std::sin(direction), -spin * std::cos(direction), random.uniform(-2, 2)};
    const ImpactLaw law = law_of(random.uniform(0, 1), 0);
    // Along the diameter in which the ends move up and down, everything goes on as for two corners.
    const std::vector<Corner> ends{{.index = 0, .place = u.point(direction)},
                                   {.index = 1, .place = u.point(direction + std::numbers::pi)}};
    const GroupImpact rim = strike_together(u.body, u.before, std::vector{u.rim}, law);
    const GroupImpact two = strike_together(u.body, u.before, ends, law);
    if (rim.is_whole != two.is_whole) continue;  // two corners can be pushed where the disc's other points would pull
    BOOST_CHECK_LE((rim.velocity_after - two.velocity_after).norm(), 1e-12);
    BOOST_CHECK_LE((rim.angular_velocity_after - two.angular_velocity_after).norm(), 1e-11);
  }
}

BOOST_AUTO_TEST_CASE(small_tilts_of_an_upright_cylinder_give_outcomes_that_turn_with_the_direction) {
  Upright u = cylinder_on_its_end(0.5, 0.4);
  u.before.velocity = {0, 0, -1};
  const double e = 0.5;
  const OutcomeSet set = tilted_outcomes(u.body, u.before, std::vector{u.rim}, law_of(e, 0));
  BOOST_CHECK(set.varies);
  BOOST_REQUIRE_EQUAL(set.outcomes.size(), 64u);
  // Two ends of a diameter: velocities (p, q), W at an end and across.
  const double turning = u.radius * u.radius / u.body.inertia(0, 0), own = 1 + turning, across = 1 - turning;
  double p = -1, q = -1;
  for (bool at_p = true; std::fmin(p, q) < -1e-13; at_p = !at_p) {
    double &struck = at_p ? p : q, &other = at_p ? q : p;
    if (!(struck < 0)) continue;
    other -= (1 + e) * struck * across / own;
    struck *= -e;
  }
  for (const TiltedOutcome& outcome : set.outcomes) {
    BOOST_CHECK_LE(std::fabs(outcome.impact.velocity_after.z() - (p + q) / 2), 1e-3);
    BOOST_CHECK_LE(std::fabs(outcome.impact.angular_velocity_after.norm() - std::fabs(p - q) / 2 / u.radius), 1e-3);
    const Vector2 rise(std::cos(outcome.tilt_direction), std::sin(outcome.tilt_direction));
    BOOST_CHECK_LE(std::fabs(outcome.impact.angular_velocity_after.head<2>().dot(rise)), 1e-12);
  }
  BOOST_CHECK_LE(std::fabs(set.angular_velocity_spread - std::fabs(p - q) / u.radius), 2e-3);
}

BOOST_AUTO_TEST_CASE(an_outcome_of_a_small_tilt_is_that_of_a_flight_without_gravity_from_this_tilt) {
  Random random(4);
  int compared = 0;
  for (int i = 0; i < 300; ++i) {
    Upright u = random_end(random);
    const ImpactLaw law = law_of(random.uniform(0.3, 1), i % 3 == 0 ? random.uniform(0, 0.6) : 0);
    const double direction = random.uniform(0, 6.28), tilt = 1e-7;
    const GroupImpact limit = LevelRim(u.body, u.before, u.rim, law).tilted(direction);
    const Vector3 axis(std::sin(direction), -std::cos(direction), 0);  // raises the side of `direction`
    Drop drop{.body = u.body,
              .attitude = Quaternion(Eigen::AngleAxisd(tilt, axis)),
              .velocity = u.before.velocity,
              .angular_velocity = u.before.angular_velocity,
              .gravity = 0,
              .law = law};
    const Vector3 lowest = u.point(direction + std::numbers::pi);
    if (!(rise(drop.velocity, drop.angular_velocity, lowest) < -0.05)) continue;
    // Further impacts belong to this landing as long as their times are of the order of the tilt.
    const Sequence sequence = impact_sequence(drop, {.impacts = 60, .amplification = false});
    std::size_t last = 0;
    while (last + 1 < sequence.rows.size() && sequence.rows[last + 1].start < 1e-4) ++last;
    if (last + 1 == 60) continue;  // rolls on
    const Impact& end = sequence.rows[last].impact;
    BOOST_TEST_CONTEXT("scene " << i << ", " << last + 1 << " impacts, " << limit.order.size() << " strikes") {
      BOOST_CHECK_LE((end.velocity_after - limit.velocity_after).norm(), 3e-3);
      BOOST_CHECK_LE((end.angular_velocity_after - limit.angular_velocity_after).norm(),
                     3e-3 / u.body.inertia.diagonal().minCoeff());
    }
    ++compared;
  }
  BOOST_CHECK_GT(compared, 100);
}

BOOST_AUTO_TEST_CASE(an_upright_cylinder_bounces_to_rest_in_the_time_of_the_geometric_series_and_keeps_its_spin) {
  const double e = 0.5, g = 9.81, speed = 1;
  for (const double spin : {0.0, 3.0, 400.0}) {
    const Drop drop{.body = cylinder(1, {.length = 0.3, .radius = 0.1}),
                    .attitude = upright(),
                    .velocity = Vector3(0, 0, -speed),
                    .angular_velocity = {0, 0, spin},
                    .gravity = g,
                    .law = law_of(e, 0)};
    const Sequence sequence = impact_sequence(drop, {.impacts = 60});
    BOOST_TEST_CONTEXT("spin " << spin << ": " << sequence.message) {
      for (const ImpactRow& row : sequence.rows) BOOST_CHECK(row.group && row.group->is_whole);
      BOOST_REQUIRE(sequence.tail.has_value());
      BOOST_CHECK_LE(std::fabs(sequence.tail->end_time - 2 * e * speed / (g * (1 - e))), 1e-9);
      BOOST_CHECK_LE(std::fabs(sequence.total_normal_impulse - (1 + e) / (1 - e)), 1e-9);
      BOOST_CHECK_LE((sequence.tail->angular_velocity_after - Vector3(0, 0, spin)).norm(), 1e-12 * spin);
      BOOST_CHECK_LE(std::fabs(sequence.tail->velocity_after.z()), 1e-12);
      BOOST_CHECK(sequence.outcome == (spin > 0 ? Outcome::sustained_contact : Outcome::at_rest));
      BOOST_CHECK_LT(sequence.root_evaluations, 100000);
    }
  }
}

BOOST_AUTO_TEST_CASE(an_upright_cylinder_without_rebound_stays_on_its_end) {
  const Drop drop{.body = cylinder(1, {.length = 0.3, .radius = 0.1}),
                  .attitude = upright(),
                  .velocity = Vector3(0.2, 0, -1),
                  .gravity = 9.81,
                  .law = law_of(0, 0.1)};
  const Sequence sequence = impact_sequence(drop, {.impacts = 10});
  BOOST_TEST(sequence.rows.size() == 1u);
  BOOST_CHECK(sequence.outcome == Outcome::at_rest);
  BOOST_CHECK_LE((sequence.rows[0].impact.velocity_after - Vector3(0.1, 0, 0)).norm(), 1e-15);
}

BOOST_AUTO_TEST_CASE(a_cylinder_on_its_side_strikes_with_both_rims_as_a_thin_rod_with_that_inertia_does) {
  Random random(5);
  for (int i = 0; i < 300; ++i) {
    const double length = random.uniform(0.1, 2), radius = random.uniform(0.01, 1), mass = random.uniform(0.2, 3);
    Drop drop{.body = cylinder(mass, {.length = length, .radius = radius}),
              .attitude = Quaternion(Eigen::AngleAxisd(random.uniform(0, 6.28), Vector3::UnitZ())) *
                          Quaternion(Eigen::AngleAxisd(random.uniform(0, 6.28), Vector3::UnitX())),
              .velocity = random.vector(1) - Vector3(0, 0, 2),
              .angular_velocity = random.vector(0.5) / (length + radius),
              .law = law_of(random.uniform(0, 1), 0)};
    const Sequence sequence = impact_sequence(drop, {.impacts = 1, .amplification = false});
    const ImpactRow& row = sequence.rows.at(0);
    BOOST_REQUIRE_EQUAL(row.corners.size(), 2u);
    // Without friction the line pushes upwards through the axis: V_z and the turn about the horizontal across it.
    const Vector3 axis = drop.attitude * Vector3::UnitX(), across = Vector3::UnitZ().cross(axis);
    const double e = drop.law.restitution, rate = drop.angular_velocity.dot(across);
    const double inertia = mass * (3 * radius * radius + length * length) / 12;
    const double u = -drop.velocity.z(), w = rate * length / 2;
    const bool both = std::fabs(w) * mass * length * length / 4 <= u * inertia * 1e9;
    BOOST_REQUIRE(both);
    if (!row.group->is_whole) continue;
    BOOST_CHECK_LE(std::fabs(row.impact.velocity_after.z() - e * u), 1e-12);
    BOOST_CHECK_LE(std::fabs(row.impact.angular_velocity_after.dot(across) + e * rate), 1e-11 / length);
    BOOST_CHECK_LE(std::fabs((row.impact.angular_velocity_after - drop.angular_velocity).dot(axis)), 1e-11 / radius);
  }
}

BOOST_AUTO_TEST_CASE(errors_of_a_rim_that_is_almost_level_grow_as_its_lowest_point_moves) {
  for (const double tilt : {1e-3, 1e-6, 1e-9}) {
    const Drop drop{.body = cylinder(1, {.length = 1, .radius = 0.05}),
                    .attitude = upright(tilt),
                    .velocity = Vector3(0, 0.3, -1),
                    .law = {}};
    const Sequence sequence = impact_sequence(drop, {.impacts = 1});
    const ImpactRow& row = sequence.rows.at(0);
    BOOST_TEST(std::fabs(row.corners.at(0).place.z()) == 0.05, boost::test_tools::tolerance(1e-12));
    // A turn by δ about the diameter of the lowest point moves the point by ρ δ/tilt, and ω′ with the point.
    BOOST_CHECK_GE(row.error.angular_velocity_after, 1e-16 / tilt);
    BOOST_CHECK(row.error.predictable);
  }
}
