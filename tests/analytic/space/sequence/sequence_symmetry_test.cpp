// SPDX-License-Identifier: GPL-3.0-or-later
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <random>

#include "analytic/plane/sequence.hpp"
#include "analytic/space/flight/body.hpp"
#include "analytic/space/sequence/sequence.hpp"

namespace {

using namespace clatter::analytic;
namespace space = clatter::analytic::space;
using space::Quaternion;
using space::Vector3;

constexpr int drops = CLATTER_TEST_SLOW_BUILD ? 500 : 10000;

/// Allowed difference, relative to the size of a number, times how the sequence amplifies rounding.
constexpr double tolerance = 1e-13;

struct PlanarScene {
  Drop planar;
  space::Drop in_space;
};

/// A body with four vertices in the plane; y is its axis of largest inertia, so that turning about y is stable.
PlanarScene planar_scene(auto& random) {
  std::uniform_real_distribution<double> share(0, 1), sided(-1, 1);
  PlanarScene s;
  const double length = std::exp2(2 * sided(random)), thickness = length * (0.05 + 0.7 * share(random));
  PlanarBody& body = s.planar.body;
  body = make_box({.mass = std::exp2(sided(random)), .length = length, .width = 1, .thickness = thickness});
  s.planar.inclination = Angle::from_degrees(1 + 88 * share(random));
  s.planar.velocity = {.normal = -0.2 - share(random), .tangential = sided(random), .angular = 0.3 * sided(random)};
  s.planar.gravity = share(random) < 0.3 ? 0 : 9.81 * share(random);
  ImpactLaw& law = s.planar.law;
  law.restitution = 0.3 + 0.7 * share(random);
  law.law = std::array{RestitutionLaw::newton, RestitutionLaw::poisson, RestitutionLaw::stronge}[random() % 3];
  law.friction = share(random) < 0.4 ? FrictionKind::none : FrictionKind::coulomb;
  law.friction_value = law.friction == FrictionKind::none ? 0 : share(random);

  space::Drop& drop = s.in_space;
  const double inertia = body.mass * body.gyration_square;
  drop.body.mass = body.mass;
  drop.body.inertia = Vector3(0.7 * inertia, inertia, 0.9 * inertia).asDiagonal();
  for (int i = 0; i < body.vertex_count; ++i) {
    const Vertex& v = body.vertices[i];
    drop.body.vertices.emplace_back(v.x, 0, v.z);
  }
  const double half = s.planar.inclination.radians / 2;
  drop.attitude = Quaternion(std::cos(half), 0, -std::sin(half), 0);
  drop.velocity = {s.planar.velocity.tangential, 0, s.planar.velocity.normal};
  drop.angular_velocity = {0, s.planar.velocity.angular, 0};
  drop.gravity = s.planar.gravity;
  drop.law = law;
  return s;
}

/// A box in any attitude, with friction or without.
space::Drop random_drop(auto& random) {
  std::uniform_real_distribution<double> share(0, 1), sided(-1, 1);
  std::normal_distribution<double> normal;
  const auto vector = [&] { return Vector3(normal(random), normal(random), normal(random)); };
  space::Drop drop;
  const Vector3 size(1, 0.3 + 0.7 * share(random), 0.1 + 0.5 * share(random));
  drop.body = space::box(0.5 + share(random), {.size = size, .centre = 0.2 * sided(random) * size});
  drop.attitude = Quaternion(normal(random), normal(random), normal(random), normal(random)).normalized();
  drop.velocity = Vector3(sided(random), sided(random), -2 - share(random));
  drop.angular_velocity = vector();
  drop.gravity = share(random) < 0.3 ? 0 : 9.81;
  drop.law.restitution = 0.3 + 0.7 * share(random);
  drop.law.law = std::array{RestitutionLaw::newton, RestitutionLaw::poisson, RestitutionLaw::stronge}[random() % 3];
  if (share(random) < 0.6) {
    drop.law.friction = FrictionKind::coulomb;
    drop.law.friction_value = 1.5 * share(random);
  }
  return drop;
}

/// Bound on a difference that rounding explains: the tolerance times the row's amplification, or anything at all from
/// the first row that cannot be predicted on.
double allowed(const space::ImpactRow& row) {
  return row.error.predictable ? tolerance * std::fmax(1.0, row.amplification) : INFINITY;
}

}  // namespace

BOOST_AUTO_TEST_CASE(planar_scenes_through_the_space_code_agree_with_the_planar_code_corner_for_corner) {
  std::mt19937_64 random(7);
  int rows = 0, wrong = 0;
  double worst = 0;
  for (int n = 0; n < drops; ++n) {
    const PlanarScene s = planar_scene(random);
    Sequence planar;
    space::Sequence in_space;
    try {
      planar = impact_sequence(s.planar, {.impacts = 4});
      in_space = space::impact_sequence(s.in_space, {.impacts = 4});
    } catch (const std::domain_error&) {
      continue;  // does not approach
    }
    const double speed = s.in_space.velocity.norm(), reach = s.planar.body.reach();
    for (std::size_t i = 0; i < std::min(planar.rows.size(), in_space.rows.size()); ++i) {
      const ImpactRow& p = planar.rows[i];
      const space::ImpactRow& r = in_space.rows[i];
      if (!(allowed(r) < 1e-9) || !p.error.predictable) break;
      ++rows;
      const double scale = speed + reach * std::fabs(p.impact.after.angular) + std::fabs(p.impact.after.normal);
      const double off = std::fmax(
          std::fmax(std::fabs(p.impact.after.normal - r.impact.velocity_after.z()),
                    std::fabs(p.impact.after.tangential - r.impact.velocity_after.x())) /
              scale,
          std::fmax(std::fabs(p.impact.after.angular - r.impact.angular_velocity_after.y()) * reach / scale,
                    std::fabs(p.impact.normal_impulse - r.impact.impulse.z()) / (scale * s.planar.body.mass)));
      const double late = p.start > 0 ? std::fabs(p.start - r.start) / p.start : 0;
      worst = std::fmax(worst, std::fmax(off, late) / allowed(r) * tolerance);
      const bool same = p.vertices == (1u << r.corners.front().index) && r.corners.size() == 1;
      if (same && off <= allowed(r) && late <= allowed(r) &&
          std::fabs(r.impact.velocity_after.y()) <= 4 * allowed(r) * scale)
        continue;
      if (++wrong < 6) {
        BOOST_TEST_MESSAGE("drop " << n << " impact " << i + 1 << ": " << int(p.vertices) << " and corner "
                                   << r.corners.front().index << ", off " << off << " and " << late << ", allowed "
                                   << allowed(r));
      }
    }
    if (planar.end_predictable && in_space.end_predictable) {
      BOOST_TEST_CONTEXT("drop " << n << ": " << planar.message << " | " << in_space.message) {
        BOOST_CHECK_EQUAL(planar.rows.size(), in_space.rows.size());
        BOOST_CHECK(planar.outcome == in_space.outcome);
      }
    }
  }
  BOOST_TEST_MESSAGE(rows << " rows, worst " << worst);
  BOOST_TEST(wrong == 0);
  BOOST_TEST(rows > 2 * drops);
}

BOOST_AUTO_TEST_CASE(a_scene_turned_about_the_vertical_or_mirrored_has_the_same_impacts_turned_or_mirrored) {
  std::mt19937_64 random(8);
  std::uniform_real_distribution<double> angles(-3, 3);
  int rows = 0;
  for (int n = 0; n < drops / 10; ++n) {
    const space::Drop drop = random_drop(random);
    space::Drop turned = drop, mirrored = drop;
    const Quaternion turn(Eigen::AngleAxisd(angles(random), Vector3::UnitZ()));
    turned.attitude = turn * drop.attitude;
    turned.velocity = turn * drop.velocity;
    turned.angular_velocity = turn * drop.angular_velocity;
    // Mirrored at y = 0: the body too; a rotation vector is an axial one.
    const auto mirror = [](const Vector3& v) { return Vector3(v.x(), -v.y(), v.z()); };
    const auto axial = [](const Vector3& v) { return Vector3(-v.x(), v.y(), -v.z()); };
    for (Vector3& vertex : mirrored.body.vertices) vertex = mirror(vertex);
    mirrored.attitude = Quaternion(drop.attitude.w(), -drop.attitude.x(), drop.attitude.y(), -drop.attitude.z());
    mirrored.velocity = mirror(drop.velocity);
    mirrored.angular_velocity = axial(drop.angular_velocity);
    std::vector<space::Sequence> runs;
    try {
      for (const auto& d : {drop, turned, mirrored}) runs.push_back(space::impact_sequence(d, {.impacts = 4}));
    } catch (const std::domain_error&) {
      continue;
    }
    for (std::size_t i = 0; i < runs[0].rows.size(); ++i) {
      const space::ImpactRow& row = runs[0].rows[i];
      if (!(allowed(row) < 1e-9)) break;
      ++rows;
      const Vector3& v = row.impact.velocity_after;
      const Vector3& w = row.impact.angular_velocity_after;
      const double margin = 4 * allowed(row) * (v.norm() + w.norm() + drop.velocity.norm());
      BOOST_TEST_CONTEXT("drop " << n << " impact " << i + 1) {
        for (const std::size_t k : {1u, 2u}) {
          BOOST_REQUIRE_GT(runs[k].rows.size(), i);
          BOOST_REQUIRE_EQUAL(runs[k].rows[i].corners.front().index, row.corners.front().index);
          const space::Impact& other = runs[k].rows[i].impact;
          BOOST_CHECK_LE((other.velocity_after - (k == 1 ? turn * v : mirror(v))).norm(), margin);
          BOOST_CHECK_LE((other.angular_velocity_after - (k == 1 ? turn * w : axial(w))).norm(), margin);
        }
      }
    }
  }
  BOOST_TEST(rows > drops / 10);
}

BOOST_AUTO_TEST_CASE(units_that_differ_by_powers_of_two_give_the_same_numbers_to_the_bit) {
  std::mt19937_64 random(9);
  const double length = 0x1p-7, time = 0x1p5, mass = 0x1p9;
  int rows = 0;
  for (int n = 0; n < drops / 20; ++n) {
    const space::Drop drop = random_drop(random);
    space::Drop other = drop;
    other.body.mass *= mass;
    other.body.inertia *= mass * length * length;
    for (Vector3& vertex : other.body.vertices) vertex *= length;
    other.velocity *= length / time;
    other.angular_velocity /= time;
    other.gravity *= length / (time * time);
    space::Sequence a, b;
    try {
      a = space::impact_sequence(drop, {.impacts = 5});
      b = space::impact_sequence(other, {.impacts = 5});
    } catch (const std::domain_error&) {
      continue;
    }
    BOOST_REQUIRE_EQUAL(a.rows.size(), b.rows.size());
    BOOST_CHECK(a.message == b.message);
    BOOST_CHECK(a.total_normal_impulse * (mass * length / time) == b.total_normal_impulse);
    for (std::size_t i = 0; i < a.rows.size(); ++i, ++rows) {
      const space::ImpactRow &p = a.rows[i], &q = b.rows[i];
      BOOST_CHECK(p.start * time == q.start);
      BOOST_CHECK(p.impact.impulse * (mass * length / time) == q.impact.impulse);
      BOOST_CHECK(p.impact.velocity_after * (length / time) == q.impact.velocity_after);
      BOOST_CHECK(p.impact.angular_velocity_after / time == q.impact.angular_velocity_after);
      BOOST_CHECK(p.energy_after * (mass * length * length / (time * time)) == q.energy_after);
      BOOST_CHECK(p.error.velocity_after * (length / time) == q.error.velocity_after);
      BOOST_CHECK(p.before.attitude.coeffs() == q.before.attitude.coeffs());
      BOOST_CHECK(p.before.position * length == q.before.position);
      BOOST_CHECK(p.corners.front().place * length == q.corners.front().place);
    }
  }
  BOOST_TEST(rows > drops / 20);
}
