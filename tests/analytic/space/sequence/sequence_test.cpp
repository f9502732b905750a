// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/space/sequence/sequence.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <string>

#include "analytic/plane/sequence.hpp"
#include "analytic/space/flight/body.hpp"
#include "validation/oracles/reference_scene.hpp"

namespace {

using namespace clatter::analytic::space;
using clatter::analytic::Outcome;
using clatter::oracle::ReferenceRowOfScene;
using clatter::oracle::ReferenceScene;

std::vector<ReferenceScene> scenes() {
  using clatter::oracle::read_reference_table;
  const std::string folder = CLATTER_TEST_DATA_DIR;
  return clatter::oracle::reference_scenes(read_reference_table(folder + "/space_scenes.csv"),
                                           read_reference_table(folder + "/space_sequences.csv"));
}

Sequence run(const ReferenceScene& scene) {
  return impact_sequence(scene.drop, {.impacts = static_cast<int>(scene.impacts.size())});
}

/// The reference tells a path along which slip turns and one along which slip is straight by the same word.
std::string path_name(const ImpactRow& row) {
  const bool slipped = row.impact.contact_before.head<2>().norm() > 1e-12;
  switch (row.impact.path) {
    case PathKind::frictionless: return "frictionless";
    case PathKind::slip: return slipped ? "slip" : "rest-slip";
    case PathKind::turning_slip: return "slip";
    case PathKind::stick: return "stick";
    case PathKind::slip_stick: return "slip-stick";
    case PathKind::slip_reslip: return "slip-reslip";
  }
  return "";
}

/// Rotation between two attitudes [rad].
double angle_between(const Quaternion& p, const Quaternion& q) {
  const Quaternion d = p.normalized() * q.normalized().conjugate();
  return 2 * std::asin(std::fmin(d.vec().norm(), 1.0));
}

/// Largest numbers of a sequence, which errors are compared with.
struct Sizes {
  double time = 0, impulse = 0, velocity = 0, angular_velocity = 0, energy = 0;
  explicit Sizes(const ReferenceScene& scene)
      : velocity(scene.drop.velocity.norm()), angular_velocity(scene.drop.angular_velocity.norm()) {
    for (const ReferenceRowOfScene& row : scene.impacts) {
      time = std::fmax(time, row.time);
      impulse = std::fmax(impulse, row.impulse.norm());
      velocity = std::fmax(velocity, row.velocity.norm());
      angular_velocity = std::fmax(angular_velocity, row.angular_velocity.norm());
      energy = std::fmax(energy, std::fabs(row.energy_before));
    }
  }
};

/// Errors of a row against the reference, whose energies are kinetic, in the units of the numbers.
struct Errors {
  double time, attitude, approach, impulse, velocity, angular_velocity, energy_before, energy_after;
  Errors(const ImpactRow& row, const ReferenceRowOfScene& expected, double weight)
      : time(std::fabs(row.start - expected.time)), attitude(angle_between(row.before.attitude, expected.attitude)),
        approach(std::fabs(row.impact.approach_speed - expected.approach)),
        impulse((row.impact.impulse - expected.impulse).norm()),
        velocity((row.impact.velocity_after - expected.velocity).norm()),
        angular_velocity((row.impact.angular_velocity_after - expected.angular_velocity).norm()),
        energy_before(std::fabs(row.energy_before - weight * row.before.position.z() - expected.energy_before)),
        energy_after(std::fabs(row.energy_after - weight * row.before.position.z() - expected.energy_after)) {}
};

}  // namespace

BOOST_AUTO_TEST_CASE(every_reference_scene_comes_out_impact_by_impact_within_its_tolerance) {
  const auto all = scenes();
  BOOST_REQUIRE_GE(all.size(), 45u);
  for (const ReferenceScene& scene : all) {
    const Sequence sequence = run(scene);
    BOOST_TEST_CONTEXT(scene.name << ": " << sequence.message) {
      BOOST_REQUIRE_EQUAL(sequence.rows.size(), scene.impacts.size());
      const Sizes size(scene);
      double worst = 0;
      for (std::size_t i = 0; i < sequence.rows.size(); ++i) {
        const ImpactRow& row = sequence.rows[i];
        BOOST_CHECK_EQUAL(row.corners.size(), 1u);
        BOOST_CHECK_EQUAL(row.corners.front().index, scene.impacts[i].corner);
        if (!scene.impacts[i].is_ambiguous) BOOST_CHECK_EQUAL(path_name(row), scene.impacts[i].path);
        const Errors e(row, scene.impacts[i], scene.drop.body.mass * scene.drop.gravity);
        BOOST_CHECK_LE(e.time, scene.tolerance * size.time);
        BOOST_CHECK_LE(e.attitude, scene.tolerance);
        BOOST_CHECK_LE(e.impulse, scene.tolerance * size.impulse);
        BOOST_CHECK_LE(e.velocity, scene.tolerance * size.velocity);
        BOOST_CHECK_LE(e.angular_velocity, scene.tolerance * size.angular_velocity);
        BOOST_CHECK_LE(e.energy_after, scene.tolerance * size.energy);
        worst = std::fmax(worst, e.angular_velocity / (scene.tolerance * size.angular_velocity));
      }
      BOOST_TEST_MESSAGE(scene.name << " " << worst << " amplification " << sequence.rows.back().amplification
                                    << " tolerance " << scene.tolerance);
    }
  }
}

BOOST_AUTO_TEST_CASE(errors_of_every_reference_scene_lie_within_the_bounds_that_rows_state) {
  for (const ReferenceScene& scene : scenes()) {
    const Sequence sequence = run(scene);
    for (std::size_t i = 0; i < sequence.rows.size(); ++i) {
      const ImpactRow& row = sequence.rows[i];
      const Errors e(row, scene.impacts.at(i), scene.drop.body.mass * scene.drop.gravity);
      BOOST_TEST_CONTEXT(scene.name << " impact " << i + 1) {
        BOOST_CHECK(row.error.predictable);
        BOOST_CHECK_LE(e.time, row.error.start);
        BOOST_CHECK_LE(e.attitude, row.error.attitude);
        BOOST_CHECK_LE(e.approach, row.error.approach_speed);
        BOOST_CHECK_LE(e.impulse, row.error.impulse);
        BOOST_CHECK_LE(e.velocity, row.error.velocity_after);
        BOOST_CHECK_LE(e.angular_velocity, row.error.angular_velocity_after);
        BOOST_CHECK_LE(e.energy_before, row.error.energy_before);
        BOOST_CHECK_LE(e.energy_after, row.error.energy_after);
        // Bounds that say something: below the tolerance that a scene's sensitivity gives, times a hundred.
        BOOST_CHECK_LE(row.error.angular_velocity_after, 100 * scene.tolerance * Sizes(scene).angular_velocity);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(a_corner_without_rebound_stays_if_its_acceleration_is_downward) {
  int stayed = 0;
  for (const ReferenceScene& scene : scenes()) {
    if (scene.end != "contact persists") continue;
    const Sequence sequence = impact_sequence(scene.drop, {.impacts = 6});
    BOOST_TEST(sequence.rows.size() == scene.impacts.size());
    BOOST_CHECK(sequence.outcome == Outcome::sustained_contact);
    BOOST_TEST(std::fabs(sequence.end_acceleration - scene.end_acceleration) <=
               1e-11 * std::fabs(scene.end_acceleration));
    ++stayed;
  }
  BOOST_TEST(stayed > 0);
}

BOOST_AUTO_TEST_CASE(a_sequence_that_ends_without_contact_ends_as_in_the_reference) {
  int ended = 0;
  for (const ReferenceScene& scene : scenes()) {
    if (scene.end != "no further impact") continue;
    const Sequence sequence = impact_sequence(scene.drop, {.impacts = 20});
    BOOST_TEST(sequence.rows.size() == scene.impacts.size());
    BOOST_CHECK(sequence.outcome == Outcome::no_further_impact);
    BOOST_TEST(sequence.end_predictable);
    ++ended;
  }
  BOOST_TEST(ended > 0);
}

/// Two models' roundings, grown by the impacts.
constexpr double rounding = 1e-10;

BOOST_AUTO_TEST_CASE(a_drop_of_the_plane_has_the_same_rows_in_space) {
  namespace analytic = clatter::analytic;
  constexpr analytic::BoxSize size{.mass = 0.18, .length = 0.14, .width = 0.07, .thickness = 0.008};
  analytic::Drop drop;
  drop.body = analytic::make_box(size);
  drop.velocity = {.normal = -1, .tangential = 0.2, .angular = 0.5};
  drop.gravity = 9.81;
  drop.law = {.restitution = 0.8, .friction = analytic::FrictionKind::coulomb, .friction_value = 0.3};
  for (const double angle : {-35.0, 20.0, 65.0}) {
    drop.inclination = analytic::Angle::from_degrees(angle);
    const Drop spatial = in_space(drop, analytic::space::make_box(size));
    const analytic::Sequence plane = impact_sequence(drop, {.impacts = 3});
    const Sequence space = impact_sequence(spatial, {.impacts = 3});
    BOOST_TEST_REQUIRE(plane.rows.size() == space.rows.size());
    for (std::size_t i = 0; i < plane.rows.size(); ++i) {
      const analytic::ImpactRow& one = plane.rows[i];
      const ImpactRow& other = space.rows[i];
      BOOST_TEST(std::fabs(one.start - other.start) <= rounding);
      BOOST_TEST((one.impulse() - other.impulse()).norm() <= rounding * one.impulse().norm());
      BOOST_TEST((one.velocity_after() - other.velocity_after()).norm() <= rounding);
      BOOST_TEST((one.angular_velocity_after() - other.angular_velocity_after()).norm() <= 100 * rounding);
    }
  }
  drop.law.ratio_direction = {0, 1};
  BOOST_CHECK_THROW(drop.validate(), std::domain_error);
  BOOST_TEST(make_rod({.mass = 2, .length = 3, .radius = 0.1}).rims.size() == 2U);
}

BOOST_AUTO_TEST_CASE(the_total_impulse_changes_the_momentum_within_its_bound) {
  Drop drop;
  drop.body = make_box({.mass = 0.18, .length = 0.14, .width = 0.07, .thickness = 0.008});
  drop.attitude = Eigen::AngleAxisd(0.5, Vector3(1, -1, 0).normalized());
  drop.law.restitution = 0.8;
  for (const double speed : {0.3, 1.0, 7.0}) {
    drop.velocity.z() = -speed;
    const Sequence sequence = impact_sequence(drop, {.impacts = 3});
    const double change = drop.body.mass * (sequence.rows.back().velocity_after().z() + speed);
    BOOST_TEST(std::fabs(sequence.total_normal_impulse - change) <= sequence.total_normal_impulse_error);
    BOOST_TEST(sequence.total_normal_impulse_error <= 1e-9 * change);
  }
  drop.gravity = 9.81;
  drop.law.restitution = 0.3;
  BOOST_TEST(std::isinf(impact_sequence(drop, {.impacts = 3, .amplification = false}).total_normal_impulse_error));
}
