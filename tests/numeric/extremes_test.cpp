// SPDX-License-Identifier: GPL-3.0-or-later
// The ends of every range: each drop ends in finite numbers or in an outcome that says why not.
#include <boost/test/unit_test.hpp>

#include <cmath>
#include <string>

#include "tests/numeric/bodies.hpp"

namespace {

using namespace clatter::numeric;
using namespace clatter::numeric::test;

bool all_finite(const ImpactRecord& row) {
  const ImpactNumbers& n = row.value;
  const double sum = n.start + n.duration + n.inclination + n.contact_angle + n.approach_speed + n.impulse.sum() +
                     n.peak_force + n.peak_time + n.velocity_after.sum() + n.angular_velocity_after.sum() +
                     n.energy_before + n.energy_after + n.energy_loss + n.work_damping + n.work_friction +
                     n.work_released;
  return std::isfinite(sum) && (std::isfinite(n.restitution) || row.touches > 1);
}

/// Finite rows that close their ledger, or none and an outcome other than the good ones; and within the work allowed.
void check(const Body& body, const Ground& ground, const MotionState& start, double gravity, const std::string& name) {
  constexpr long limit = CLATTER_TEST_SLOW_BUILD ? 5'000 : 20'000;
  const Simulation run =
      simulate(body, {.ground = ground, .gravity = gravity}, start, {.impacts = 2}, {.evaluation_limit = limit});
  BOOST_TEST_CONTEXT(name << ": " << run.message) {
    BOOST_TEST(!run.message.empty());
    const bool refused = run.outcome != Outcome::no_further_impact && run.outcome != Outcome::impact_limit &&
                         run.outcome != Outcome::at_rest && run.outcome != Outcome::sustained_contact;
    BOOST_TEST((refused || !run.impacts.empty()));
    for (const ImpactRecord& row : run.impacts) {
      BOOST_TEST(all_finite(row));
      BOOST_TEST(std::fabs(row.ledger_gap) <= 1e-6);
    }
    BOOST_TEST(run.force_evaluations <= 10 * limit);
  }
}

MotionState dropped(const Body& body, double angle, double speed) {
  return touching_state(body, {.inclination = angle * degree, .velocity = {0, 0, -speed}});
}

}  // namespace

BOOST_AUTO_TEST_CASE(every_stiffness_and_damping_ends_in_numbers_or_a_reason) {
  const Body body = phone();
  for (const double stiffness : {1.0, 1e3, 1e6, 1e9, 1e12, 1e15}) {
    for (const double damping : {0.0, 1.0, 1e3, 1e6, 1e9, 1e12}) {
      for (const double gravity : {0.0, 9.81}) {
        check(body, {.stiffness = stiffness, .damping = damping}, dropped(body, 10, 1), gravity,
              "k " + std::to_string(stiffness) + " c " + std::to_string(damping));
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(every_angle_ends_in_numbers_or_a_reason) {
  for (const Body& body : {phone(), rod()}) {
    for (const double angle : {0.0, 1e-10, 1e-7, 1e-4, 0.01, 1.0, 45.0, 89.0, 90 - 1e-7, 90.0}) {
      for (const double damping : {0.0, 1e8}) {
        check(body, {.stiffness = 1e9, .damping = damping, .static_friction = 0.3, .sliding_friction = 0.3},
              dropped(body, angle, 1), 9.81, "angle " + std::to_string(angle));
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(every_speed_ends_in_numbers_or_a_reason) {
  const Body body = phone();
  for (const double speed : {1e-9, 1e-6, 1e-3, 1.0, 1e2, 1e4}) {
    for (const double stiffness : {1e3, 1e8, 1e15}) {
      for (const double gravity : {0.0, 9.81}) {
        check(body, {.stiffness = stiffness, .damping = stiffness / 10}, dropped(body, 20, speed), gravity,
              "speed " + std::to_string(speed) + " k " + std::to_string(stiffness));
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(every_aspect_ratio_ends_in_numbers_or_a_reason) {
  for (const double ratio : {1.0, 1e2, 1e4, 1e6}) {
    const Body needle(rod_mesh({.length = 1, .radius = 1 / ratio}));
    const Body sheet = box_body({1, 1, 1 / ratio}, 1);
    for (const double angle : {0.0, 1.0, 45.0, 90.0}) {
      const Ground ground{.stiffness = 1e9, .damping = 1e8, .static_friction = 0.2, .sliding_friction = 0.2};
      check(needle, ground, dropped(needle, angle, 1), 9.81, "needle " + std::to_string(ratio));
      check(sheet, ground, dropped(sheet, angle, 1), 9.81, "sheet " + std::to_string(ratio));
    }
  }
}

BOOST_AUTO_TEST_CASE(a_body_that_goes_right_through_the_ground_ends_in_numbers_or_a_reason) {
  const Body body = phone();
  for (const AreaMeasure area : {AreaMeasure::surface, AreaMeasure::projected}) {
    for (const double damping : {0.0, 1e2, 1e4}) {
      const Ground ground{.stiffness = 1e3, .damping = damping, .area = area};
      check(body, ground, dropped(body, 30, 100), 9.81, "through");
      check(body, ground, dropped(body, 30, 100), 0, "through without gravity");
    }
  }
}

/// The ground pushes the body out at just the speed at which it lets go of it; the energy that its springs release then
/// was once booked nowhere.
BOOST_AUTO_TEST_CASE(a_shot_into_a_soft_damped_ground_keeps_its_ledger) {
  const Body body = box_body({0.043, 0.159, 0.035}, 6.5);
  const MotionState start = touching_state(body, {.velocity = {0, 0, -168}, .out_of_plane_tilt = -1});
  const Simulation run = simulate(body, weightless({.stiffness = 8.9, .damping = 672}), start, {.impacts = 1});
  BOOST_REQUIRE(run.impacts.size() == 1);
  BOOST_TEST(std::fabs(run.impacts[0].ledger_gap) <= 1e-9);
}

/// A flight of 10¹³ times the body's size puts the touch-down off by more than the contact is deep; the energy that the
/// springs held from there on, up to a tenth of all, was given to the body.
BOOST_AUTO_TEST_CASE(a_contact_shallower_than_its_touch_down_is_uncertain_is_refused) {
  const Body body = box_body({0.0230256, 0.000282138, 0.00308472}, 0.000324789);
  const MotionState start = touching_state(body, {.velocity = {0, 0, -3.64552e-05}});
  const Simulation run =
      simulate(body, {.ground = {.stiffness = 2.24028e10}, .gravity = 1.69094e-16}, start, plain_impacts(3));
  BOOST_TEST((run.outcome == Outcome::not_representable));
  for (const ImpactRecord& row : run.impacts) BOOST_TEST(std::fabs(row.ledger_gap) <= 1e-6);
}

BOOST_AUTO_TEST_CASE(every_size_ends_in_numbers_or_a_reason) {
  for (const double scale : {1e-9, 1e-3, 1.0, 1e3, 1e9}) {
    const Body body = box_body(scale * phone_size(), phone_mass * scale * scale * scale);
    check(body, {.stiffness = 1e8, .damping = 1e6}, dropped(body, 10, 1), 9.81, "scale " + std::to_string(scale));
  }
}

BOOST_AUTO_TEST_CASE(a_bad_world_request_or_accuracy_is_refused_by_the_name_of_what_is_wrong) {
  const Body body = phone();
  const MotionState start = dropped(body, 10, 1);
  const auto refused = [&](const World& world, const Request& request, const Accuracy& accuracy,
                           const std::string& word) {
    BOOST_CHECK_EXCEPTION(
        static_cast<void>(simulate(body, world, start, request, accuracy)), std::domain_error,
        [&](const std::domain_error& error) { return std::string(error.what()).find(word) != std::string::npos; });
  };
  const double nan = std::nan("");
  refused({.ground = {.stiffness = 0}}, {}, {}, "ground.stiffness");
  refused({.ground = {.stiffness = nan}}, {}, {}, "ground.stiffness");
  refused({.ground = {.damping = -1}}, {}, {}, "ground.damping");
  refused({.ground = {.static_friction = 0.1, .sliding_friction = 0.2}}, {}, {}, "ground.static_friction");
  refused({.gravity = nan}, {}, {}, "world.gravity");
  refused({.gravity = -1}, {}, {}, "world.gravity");
  refused({}, {.impacts = 0}, {}, "run.impacts");
  refused({}, {}, {.digits = 1}, "run.digits");
  refused({}, {}, {.digits = 13}, "run.digits");
  refused({}, {}, {.step = -1}, "run.step");
  refused({}, {}, {.method = Method::rk8pd, .step = 1e-6}, "run.step");
  refused({}, {}, {.tolerance = 1e-14}, "run.tolerance");
  refused({}, {}, {.step = 1e-6, .tolerance = 1e-8}, "run.tolerance");
  refused({}, {}, {.method = Method::tvd_rk3, .tolerance = 1e-8}, "run.tolerance");
  refused({}, {}, {.evaluation_limit = 0}, "run.evaluation_limit");
  MotionState low = start;
  low.centre.z() -= 0.01;
  BOOST_CHECK_THROW(static_cast<void>(simulate(body, {}, low)), std::domain_error);
}
