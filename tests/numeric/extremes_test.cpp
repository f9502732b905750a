// SPDX-License-Identifier: GPL-3.0-or-later
// The ends of every range: each drop ends in finite numbers or in an outcome that says why not.
#include "tests/numeric/bodies.hpp"
#include "tests/numeric/support.hpp"

namespace {

using namespace clatter::numeric;
using namespace clatter::numeric::test;

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
      BOOST_TEST(is_number(row));
      BOOST_TEST(std::fabs(row.ledger_gap) <= 1e-6);
    }
    BOOST_TEST(run.force_evaluations <= 10 * limit);
  }
}

MotionState dropped(const Body& body, double angle, double speed) {
  return touching_state(body, {.inclination = angle * degree, .velocity = {0, 0, -speed}});
}

}  // namespace

BOOST_AUTO_TEST_CASE(every_aspect_ratio_ends_in_numbers_or_a_reason) {
  for (const double ratio : {1.0, 1e2, 1e4, 1e6}) {
    const Body needle(rod_mesh({.length = 1, .radius = 1 / ratio}));
    const Body sheet = box_body({1, 1, 1 / ratio}, 1);
    for (const double angle : {0.0, 1.0, 45.0, 90.0}) {
      const Ground ground = with_friction({.stiffness = 1e9, .damping = 1e8}, 0.2);
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
  BOOST_TEST(std::fabs(run.impacts.at(0).ledger_gap) <= 1e-9);
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

BOOST_AUTO_TEST_CASE(a_bad_world_request_or_accuracy_is_refused_by_the_name_of_what_is_wrong) {
  struct Case {
    const char* name;
    World world;
    Request request;
    Accuracy accuracy;
  };
  const Body body = phone();
  MotionState start = dropped(body, 10, 1);
  for (const Case& c :
       {Case{"ground.stiffness", {.ground = {.stiffness = 0}}, {}, {}},
        {"ground.stiffness", {.ground = {.stiffness = not_a_number}}, {}, {}},
        {"ground.damping", {.ground = {.damping = -1}}, {}, {}},
        {"ground.static_friction", {.ground = {.static_friction = 0.1, .sliding_friction = 0.2}}, {}, {}},
        {"world.gravity", {.gravity = not_a_number}, {}, {}},
        {"world.gravity", {.gravity = -1}, {}, {}},
        {"run.impacts", {}, {.impacts = 0}, {}},
        {"run.digits", {}, {}, {.digits = 1}},
        {"run.digits", {}, {}, {.digits = 13}},
        {"run.step", {}, {}, {.step = -1}},
        {"run.step", {}, {}, {.method = Method::rk8pd, .step = 1e-6}},
        {"run.tolerance", {}, {}, {.tolerance = 1e-14}},
        {"run.tolerance", {}, {}, {.step = 1e-6, .tolerance = 1e-8}},
        {"run.tolerance", {}, {}, {.method = Method::tvd_rk3, .tolerance = 1e-8}},
        {"run.evaluation_limit", {}, {}, {.evaluation_limit = 0}}}) {
    CHECK_REFUSED_SAYING(simulate(body, c.world, start, c.request, c.accuracy), std::domain_error, c.name);
  }
  start.centre.z() -= 0.01;
  CHECK_REFUSED(simulate(body, {}, start), std::domain_error);
}
