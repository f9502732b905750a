// SPDX-License-Identifier: GPL-3.0-or-later
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>
#include <random>

#include "analytic/base/errors.hpp"
#include "analytic/plane/sequence.hpp"
#include "analytic/space/body.hpp"
#include "analytic/space/sequence.hpp"

namespace {

using namespace clatter::analytic;
namespace space = clatter::analytic::space;
using space::Quaternion;
using space::Vector3;

Quaternion turn(double angle, const Vector3& axis) { return Quaternion(Eigen::AngleAxisd(angle, axis.normalized())); }

/// A slab that falls without turning.
space::Drop slab(const Quaternion& attitude, double e) {
  space::Drop drop;
  drop.body = space::box(1, {.size = {0.3, 0.2, 0.02}});
  drop.attitude = attitude;
  drop.velocity = {0, 0, -1};
  drop.gravity = 9.81;
  drop.law.law.restitution = e;
  return drop;
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_flat_landing_ends_after_the_time_and_impulse_of_a_geometric_series) {
  const double e = 0.6, g = 9.81, w = e * 1.0;
  const space::Sequence s = space::impact_sequence(slab(Quaternion::Identity(), e), {.impacts = 3});
  BOOST_TEST(s.rows.size() == 3);
  BOOST_CHECK(s.outcome == Outcome::at_rest);
  BOOST_REQUIRE(s.tail);
  BOOST_TEST(s.tail->closed_form);
  BOOST_TEST(std::fabs(s.tail->end_time - 2 * w / (g * (1 - e))) <= 1e-15);
  // All of the momentum that gravity brings until then, and that at the start.
  BOOST_TEST(std::fabs(s.total_normal_impulse - (1 + g * s.tail->end_time)) <= 1e-14);
}

BOOST_AUTO_TEST_CASE(a_slab_on_damped_ground_never_comes_to_rest_since_slow_contacts_lose_nothing) {
  for (const Quaternion& attitude : {Quaternion::Identity(), turn(0.05, {1, 0, 0}) * turn(0.2, {0, 1, 0})}) {
    for (const double damping : {0.01, 0.3, 10.0}) {
      space::Drop drop = slab(attitude, 1);
      drop.law.law.law = RestitutionLaw::viscoelastic;
      drop.law.law.damping_per_stiffness = damping;
      const space::Sequence s = space::impact_sequence(drop, {.impacts = 200, .digits = 1});
      BOOST_TEST_CONTEXT(damping << " s/m: " << s.message) {
        BOOST_CHECK(s.outcome == Outcome::impact_limit);
        BOOST_TEST(!s.tail);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(a_slab_that_bounces_on_one_corner_is_seen_to_end_with_its_momentum_balance) {
  const space::Drop drop = slab(turn(0.05, {1, 0, 0}) * turn(0.2, {0, 1, 0}), 0.5);
  const space::Sequence s = space::impact_sequence(drop, {.impacts = 400});
  BOOST_REQUIRE(s.tail);
  BOOST_TEST(!s.tail->closed_form);
  BOOST_CHECK(s.outcome == Outcome::sustained_contact || s.outcome == Outcome::at_rest);
  // Momentum: impulses take V_z from −1 to that at the end, less what gravity brings; six digits are asked for.
  const double expected = drop.body.mass * (s.tail->velocity_after.z() + 1 + drop.gravity * s.tail->end_time);
  BOOST_TEST(std::fabs(s.total_normal_impulse - expected) <= 1e-6 * s.total_normal_impulse);
  for (const space::ImpactRow& row : s.rows) BOOST_TEST(row.before.position.z() > 0);
}

BOOST_AUTO_TEST_CASE(accumulations_of_a_corner_leave_that_corner_on_the_ground) {
  // On one corner with others clear: at the end of the tail the corner has no normal velocity.
  int corners = 0;
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> angle(-0.5, 0.5);
  for (int n = 0; n < 200; ++n) {
    const space::Drop drop = slab(turn(angle(random), {1, 0, 0}) * turn(angle(random), {0, 1, 0}), 0.2);
    const space::Sequence s = space::impact_sequence(drop, {.impacts = 400, .digits = 2});
    BOOST_TEST_CONTEXT("drop " << n << ": " << s.message) {
      BOOST_CHECK(s.outcome == Outcome::sustained_contact || s.outcome == Outcome::at_rest);
      BOOST_REQUIRE(s.tail);
      if (s.tail->corners.size() != 1) continue;
      ++corners;
      const auto corner = static_cast<std::size_t>(s.tail->corners.front());
      Vector3 arm = s.rows.back().before.attitude * drop.body.vertices[corner];
      arm += (s.tail->end_time - s.rows.back().start) * s.tail->angular_velocity_after.cross(arm);  // turns meanwhile
      const Vector3 v = s.tail->velocity_after + s.tail->angular_velocity_after.cross(arm);
      // Two digits are asked for: of what the impulses that are left do to the corner's velocity.
      BOOST_TEST(std::fabs(v.z()) <= 0.05 * s.tail->normal_impulse / drop.body.mass);
    }
  }
  BOOST_TEST(corners > 20);
}

BOOST_AUTO_TEST_CASE(a_drop_without_rebound_ends_where_a_corner_stays_and_never_below_the_ground) {
  std::mt19937_64 random(6);
  std::normal_distribution<double> normal;
  for (int n = 0; n < 300; ++n) {
    space::Drop drop = slab(Quaternion(normal(random), normal(random), normal(random), normal(random)).normalized(), 0);
    drop.angular_velocity = Vector3(normal(random), normal(random), normal(random));
    const space::Sequence s = space::impact_sequence(drop, {.impacts = 50});
    BOOST_TEST_CONTEXT("drop " << n << ": " << s.message) {
      BOOST_CHECK(s.outcome == Outcome::sustained_contact || s.outcome == Outcome::at_rest);
      if (!s.tail) BOOST_TEST(s.end_acceleration < 0);
      for (const space::ImpactRow& row : s.rows) {
        const double depth = drop.body.reach() * 1e-12;
        for (const Vector3& r : drop.body.vertices) {
          BOOST_TEST(row.before.position.z() + (row.before.attitude * r).z() >= -depth);
        }
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(a_thick_rod_strikes_with_its_real_rims_as_the_planar_model_does) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> angle(3, 87);
  for (int n = 0; n < 300; ++n) {
    const double degrees = angle(random);
    Drop planar;
    planar.body = make_rod({.mass = 1, .length = 1, .radius = 0.03});
    planar.inclination = Angle::from_degrees(degrees);
    planar.velocity = {.normal = -1};
    planar.gravity = 9.81;
    space::Drop drop;
    drop.body = space::cylinder(1, {.length = 1, .radius = 0.03});
    drop.attitude = turn(-planar.inclination.radians, {0, 1, 0});
    drop.velocity = {0, 0, -1};
    drop.gravity = 9.81;
    const Sequence p = impact_sequence(planar, {.impacts = 3});
    const space::Sequence s = space::impact_sequence(drop, {.impacts = 3});
    BOOST_TEST_CONTEXT(degrees << "°: " << p.message << " | " << s.message) {
      for (std::size_t i = 0; i < p.rows.size() && p.rows[i].amplification < 1e3; ++i) {
        BOOST_REQUIRE_GT(s.rows.size(), i);
        const double allowed = 1e-12 * std::fmax(1.0, p.rows[i].amplification);
        BOOST_TEST(std::fabs(p.rows[i].start - s.rows[i].start) <= allowed);
        BOOST_TEST(std::fabs(p.rows[i].impact.normal_impulse - s.rows[i].impact.impulse.z()) <= allowed);
        BOOST_TEST(std::fabs(p.rows[i].impact.after.angular - s.rows[i].impact.angular_velocity_after.y()) <=
                   10 * allowed);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(
    extremes_give_every_number_or_a_typed_refusal_within_a_bounded_number_of_evaluations_of_the_rotation) {
  struct Extreme {
    Vector3 size;
    Vector3 spin;
    double gravity;
    Vector3 velocity;
  };
  const Extreme extremes[] = {
      {{1, 1, 1e-9}, {3, 2, 1}, 9.81, {0.1, 0, -1}},
      {{1, 1e-6, 1e-6}, {1e-3, 2, 1}, 9.81, {0, 0, -1}},
      {{1, 1, 1 + 1e-14}, {3, 2, 1}, 9.81, {0, 0, -1}},
      {{1, 0.5, 0.2}, {1e6, 1e6, 1e6}, 9.81, {0, 0, -1}},
      {{1, 0.5, 0.2}, {0, 1e6, 1e-3}, 9.81, {0, 0, -1}},
      {{1, 0.5, 0.2}, {1, 1, 1}, 1e-9, {0, 0, -1}},
      {{1, 0.5, 0.2}, {1e6, 2e6, 0}, 0, {0, 0, -1}},
      {{1, 1e-3, 1e-3}, {1e6, 0, 0}, 9.81, {0, 0, -1}},
      {{1e-9, 1e-9, 2e-9}, {1e6, 0, 2}, 9.81, {0, 0, -1}},
      {{1e9, 1e9, 2e9}, {1e-9, 0, 2e-9}, 9.81, {0, 0, -1}},
      {{1, 0.5, 0.2}, {1e-300, 0, 0}, 9.81, {0, 0, -1}},
      {{1, 0.5, 0.2}, {1, 0, 0}, 1e9, {0, 0, -1e-6}},
      {{1, 0.5, 0.2}, {1, 0, 0}, 9.81, {0, 0, -1e6}},
      {{1, 0.5, 0.2}, {1e-3, 2e-3, 0}, 0, {0, 0, -1e-12}},
      {{1, 0.5, 0.2}, {7, 1, 0}, 0, {0, 0, 0}},
  };
  for (const Extreme& extreme : extremes) {
    for (const double e : {1.0, 0.5, 0.0}) {
      space::Drop drop;
      drop.body = space::box(1, {.size = extreme.size});
      drop.attitude = Quaternion(0.7, 0.3, -0.5, 0.2);
      drop.velocity = extreme.velocity;
      drop.angular_velocity = extreme.spin;
      drop.gravity = extreme.gravity;
      drop.law.law.restitution = e;
      BOOST_TEST_CONTEXT("velocity " << drop.velocity.transpose() << " size " << extreme.size.transpose() << ", spin "
                                     << extreme.spin.transpose() << ", e " << e) {
        try {
          const space::Sequence s = space::impact_sequence(drop, {.impacts = 20});
          BOOST_TEST(!s.rows.empty());
          BOOST_TEST(s.evaluations < 3'000'000);  // each takes a third of a microsecond
          for (const space::ImpactRow& row : s.rows) {
            BOOST_TEST(row.impact.impulse.allFinite());
            BOOST_TEST(row.impact.velocity_after.allFinite());
            BOOST_TEST(row.impact.angular_velocity_after.allFinite());
            BOOST_TEST(std::isfinite(row.start));
            BOOST_TEST(row.before.attitude.coeffs().allFinite());
            BOOST_TEST((std::isfinite(row.error.start) || !row.error.predictable));
          }
        } catch (const std::domain_error& error) {
          BOOST_TEST(std::string(error.what()).size() > 0);
        } catch (const NumericalError& error) {
          BOOST_TEST(std::string(error.what()).size() > 0);
        }
      }
    }
  }
}
