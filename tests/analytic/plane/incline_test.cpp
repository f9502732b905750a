// SPDX-License-Identifier: GPL-3.0-or-later
// Sequences on sloping ground, in the plane and in space: against level ground, the equations of flight, and bounce
// after bounce of a face that slides.
#include <bit>

#include "analytic/plane/gradient.hpp"
#include "analytic/plane/sequence.hpp"
#include "analytic/space/flight/body.hpp"
#include "analytic/space/sequence/sequence.hpp"
#include "tests/support.hpp"

namespace {

using namespace clatter::analytic;

constexpr double slope = 20 * std::numbers::pi / 180, g = 9.81;
constexpr double ulps = 64 * clatter::test::eps;

ImpactLaw rough(double e, double friction) {
  return {.restitution = e, .friction = FrictionKind::coulomb, .friction_value = friction};
}

Drop on_slope(const PlanarBody& body, double degrees, const ImpactLaw& law) {
  return {.body = body,
          .inclination = Angle::from_degrees(degrees),
          .velocity = {.normal = -1, .tangential = 0.3, .angular = 0.2},
          .gravity = g * std::cos(slope),
          .gravity_along = g * std::sin(slope),
          .law = law};
}

PlanarBody box() { return make_box({.mass = 2, .length = 0.3, .width = 0.2, .thickness = 0.1}); }

Drop flat(double tangential, const ImpactLaw& law) {
  Drop drop = on_slope(box(), 0, law);
  drop.velocity = {.normal = -1, .tangential = tangential};
  return drop;
}

/// Slip of a flat landing after bounces that are followed one by one until nothing is left of them.
double slip_after_bounces(const Drop& drop) {
  const double e = drop.law.restitution, mu = drop.law.friction_value;
  double slip = drop.velocity.tangential;
  for (double approach = -drop.velocity.normal; approach > 1e-18; approach *= e) {
    const double most = mu * (1 + e) * approach;
    slip = std::fabs(slip) <= most ? 0 : slip - std::copysign(most, slip);
    slip += drop.gravity_along * (2 * e * approach / drop.gravity);
  }
  return std::fabs(slip) < 1e-15 ? 0 : slip;
}

}  // namespace

BOOST_AUTO_TEST_CASE(without_friction_a_slope_adds_its_gravity_times_the_time_to_the_velocity_along_it) {
  for (const double degrees : {3.0, 40.0}) {
    const Drop drop = on_slope(box(), degrees, {.restitution = 0.7});
    Drop level = drop;
    level.gravity_along = 0;
    const Sequence found = impact_sequence(drop, {.impacts = 12}), expected = impact_sequence(level, {.impacts = 12});
    BOOST_TEST_REQUIRE(found.rows.size() == expected.rows.size());
    for (std::size_t i = 0; i < found.rows.size(); ++i) {
      const ImpactRow &row = found.rows[i], &other = expected.rows[i];
      BOOST_TEST(row.start == other.start);
      BOOST_TEST(row.impact.normal_impulse == other.impact.normal_impulse);
      BOOST_TEST(row.impact.after.angular == other.impact.after.angular);
      const double along = drop.velocity.tangential + drop.gravity_along * row.start;
      BOOST_TEST(std::fabs(row.impact.after.tangential - along) <= ulps * along);
    }
  }
}

BOOST_AUTO_TEST_CASE(between_impacts_on_a_slope_the_body_flies_with_both_parts_of_gravity_and_keeps_its_energy) {
  for (const double friction : {0.1, 0.4, 1.0}) {
    const Drop drop = on_slope(box(), 12, rough(0.8, friction));
    const Sequence found = impact_sequence(drop, {.impacts = 8});
    BOOST_TEST_REQUIRE(found.rows.size() >= 4U);
    double x = 0;
    for (std::size_t i = 0; i + 1 < found.rows.size(); ++i) {
      const ImpactRow &row = found.rows[i], &next = found.rows[i + 1];
      const double t = next.start - row.start;
      x += t * (row.impact.after.tangential + drop.gravity_along / 2 * t);
      BOOST_TEST(std::fabs(next.before.tangential - row.impact.after.tangential - drop.gravity_along * t) <= ulps);
      BOOST_TEST(std::fabs(next.energy_before - row.energy_after) <= ulps);
      const PlanarVelocity& v = next.before;
      const double height = next.centre_height, kinetic = v.normal * v.normal + v.tangential * v.tangential +
                                                          drop.body.gyration_square * v.angular * v.angular;
      const double energy = drop.body.mass * (kinetic / 2 + drop.gravity * height - drop.gravity_along * x);
      BOOST_TEST(std::fabs(energy - next.energy_before) <= ulps);
      BOOST_TEST(next.error.energy_before > 0);
      BOOST_TEST(next.error.energy_before <= 1e-11);
      // The slip that friction acts on is that of the vertex.
      const ContactPoint d = drop.body.contact_point(std::countr_zero(next.vertices), std::sin(next.inclination),
                                                     std::cos(next.inclination));
      BOOST_TEST(std::fabs(next.impact.slip_before - slip_velocity(v, d)) <= ulps);
    }
  }
}

BOOST_AUTO_TEST_CASE(a_face_that_bounces_to_rest_on_a_slope_slides_as_its_bounces_one_by_one_say) {
  int sticking = 0, slipping = 0;
  for (const double e : {0.2, 0.5, 0.9}) {
    for (const double friction : {0.05, 0.2, 0.3, 0.35, 0.4, 0.6, 1.2}) {
      for (const double tangential : {-3.0, -0.4, 0.0, 0.2, 2.0}) {
        const Drop drop = flat(tangential, rough(e, friction));
        const Sequence found = impact_sequence(drop, {.impacts = 3});
        const double slip = slip_after_bounces(drop);
        BOOST_TEST_CONTEXT("e " << e << " friction " << friction << " tangential " << tangential) {
          if (!found.tail) {  // slip up the slope turns round within the bounces
            BOOST_TEST(tangential < 0);
            continue;
          }
          BOOST_TEST(found.tail->closed_form);
          BOOST_TEST(std::fabs(found.tail->velocity_after.x() - slip) <= 1e-13);
          const double pull = drop.body.mass * drop.gravity_along * (found.tail->end_time - found.rows.back().start);
          const double change = found.tail->velocity_after.x() - found.rows.back().impact.after.tangential;
          BOOST_TEST(std::fabs(drop.body.mass * change - pull - found.tail->tangential_impulse.x()) <= 1e-13);
          const bool rests = slip == 0 && friction >= std::tan(slope);
          BOOST_TEST(found.message.ends_with(rests ? "the body is at rest" : "the body slides on"));
          ++(slip == 0 ? sticking : slipping);
        }
      }
    }
  }
  BOOST_TEST(sticking >= 10);
  BOOST_TEST(slipping >= 40);
}

/// tan 20° = 0.364: it stays above that friction, and tips where the height is over length/tan, if friction holds it.
BOOST_AUTO_TEST_CASE(a_box_at_rest_on_a_slope_stays_slides_or_tips_by_friction_and_by_the_place_of_its_weight) {
  struct Case {
    double thickness, friction;
    const char* end;
  };
  for (const Case& c : {Case{0.1, 0.37, "the body is at rest"},
                        {0.1, 0.36, "the body slides on"},
                        {0.274, 0.5, "the body is at rest"},
                        {0.275, 0.5, "tips over its lower edge"},
                        {0.275, 0.35, "the body slides on"}}) {
    Drop drop = flat(0, rough(0, c.friction));
    drop.body = make_box({.mass = 1, .length = 0.1, .width = 0.1, .thickness = c.thickness});
    const Sequence found = impact_sequence(drop, {.impacts = 3});
    BOOST_TEST(found.message.find(c.end) != std::string::npos, c.thickness << ' ' << c.friction << found.message);
  }
}

BOOST_AUTO_TEST_CASE(a_sequence_on_a_slope_is_the_same_in_space_as_in_the_plane) {
  const Drop drop = on_slope(box(), 12, rough(0.6, 0.3));
  const double half = drop.inclination.radians / 2;
  space::Drop other{.body = space::box(2, {.size = {0.3, 0.2, 0.1}, .centre = space::Vector3::Zero()}),
                    .attitude = space::Quaternion(std::cos(half), 0, -std::sin(half), 0),
                    .velocity = {drop.velocity.tangential, 0, drop.velocity.normal},
                    .angular_velocity = {0, drop.velocity.angular, 0},
                    .gravity = drop.gravity,
                    .gravity_along = drop.gravity_along,
                    .law = drop.law};
  const Sequence plane = impact_sequence(drop, {.impacts = 5});
  const space::Sequence found = impact_sequence(other, {.impacts = 5});
  BOOST_TEST_REQUIRE(found.rows.size() == plane.rows.size());
  for (std::size_t i = 0; i < plane.rows.size(); ++i) {
    const ImpactRow& row = plane.rows[i];
    const space::ImpactRow& one = found.rows[i];
    BOOST_TEST(std::fabs(row.start - one.start) <= 1e-12);
    BOOST_TEST(std::fabs(row.impact.after.tangential - one.impact.velocity_after.x()) <= 1e-11);
    BOOST_TEST(std::fabs(row.impact.after.normal - one.impact.velocity_after.z()) <= 1e-11);
    BOOST_TEST(std::fabs(row.energy_after - one.energy_after) <= 1e-11);
    BOOST_TEST((i == 0 || one.error.energy_after > 0));
  }
}

BOOST_AUTO_TEST_CASE(derivatives_of_a_sequence_on_a_slope_are_its_differences) {
  constexpr double step = 1e-6;
  const Drop drop = on_slope(box(), 12, rough(0.8, 0.2));
  const SequenceGradient found = sequence_gradient(drop, 4);
  const auto moved = [&](double by) {
    Drop other = drop;
    other.inclination = Angle::from_radians(drop.inclination.radians + by);
    return impact_sequence(other, {.impacts = 4});
  };
  const Sequence up = moved(step), down = moved(-step);
  BOOST_TEST_REQUIRE(found.rows.size() == 4U);
  for (std::size_t i = 0; i < 4; ++i) {
    const double of_angle = found.rows[i].of[static_cast<std::size_t>(DropParameter::angle)].tangential;
    const double slope = (up.rows[i].impact.after.tangential - down.rows[i].impact.after.tangential) / (2 * step);
    BOOST_TEST(std::fabs(of_angle - slope) <= step * std::pow(1 + std::fabs(of_angle), 2));
  }
}
