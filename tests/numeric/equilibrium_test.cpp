// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies that the ground carries: where they lie, and that they lie still.
#include "numeric/equilibrium.hpp"
#include "tests/numeric/bodies.hpp"
#include "tests/numeric/support.hpp"

namespace {

using namespace clatter::numeric;
using namespace clatter::numeric::test;

constexpr double rounding = 1e-12;
constexpr double g = 9.81, mass = 2, area = 0.06, stiffness = 1e8;

Body brick() { return box_body({0.3, 0.2, 0.1}, mass); }

Request from_rest(std::vector<double> times = {}) {
  Request request{.impacts = 5, .times = std::move(times)};
  request.starts_on_ground = true;
  return request;
}

World on(const Ground& ground, double incline_deg = 0) { return {.ground = ground, .incline_deg = incline_deg}; }

}  // namespace

/// m g/(k_G A) on springs, m g/(2 E* r) on a half-space under the flat end of a cylinder, and the two pieces of a pad.
BOOST_AUTO_TEST_CASE(a_level_face_lies_as_deep_as_its_weight_presses_it) {
  const Ground springs{.stiffness = stiffness, .area = AreaMeasure::projected};
  const double depth = mass * g / (stiffness * area);
  const MotionState level = touching_state(brick(), {});
  const Equilibrium lies = equilibrium(brick(), on(springs), level);
  BOOST_TEST(lies.depth == depth, boost::test_tools::tolerance(rounding));
  BOOST_TEST(lies.energy_stored == mass * g * depth / 2, boost::test_tools::tolerance(rounding));
  BOOST_TEST(lies.state.centre.z() == 0.05 - depth, boost::test_tools::tolerance(rounding));
  Ground pad = springs;
  pad.kinks = {{depth / 4, 2}};  // d/4 + 3 (x − d/4) = d
  BOOST_TEST(equilibrium(brick(), on(pad), level).depth == depth / 2, boost::test_tools::tolerance(rounding));
  Ground half_space = springs;
  half_space.modulus = 1e7;
  const Simulation still =
      simulate(brick(), on(half_space), equilibrium(brick(), on(half_space), level).state, from_rest());
  BOOST_TEST((still.outcome == Outcome::at_rest));
}

/// From a tilt, from its edge and balanced on it, a box comes to lie on its face.
BOOST_AUTO_TEST_CASE(a_tilted_body_comes_to_lie_on_the_face_below_it) {
  const World world = on({.stiffness = stiffness, .area = AreaMeasure::projected});
  const double depth = mass * g / (stiffness * area);
  for (const double tilt : {1e-7, 1e-4, 0.1, 0.3}) {
    const Equilibrium lies =
        equilibrium(brick(), world, touching_state(brick(), {.inclination = tilt, .out_of_plane_tilt = tilt / 2}));
    BOOST_TEST(lies.depth == depth, boost::test_tools::tolerance(1e-8));  // a tilt's rounding over the length
    BOOST_TEST((lies.state.attitude * Vector3::UnitZ() - Vector3::UnitZ()).norm() <= 1e-12);
  }
  const Body cube = box_body({0.1, 0.1, 0.1}, 1);
  const Equilibrium fallen = equilibrium(cube, world, touching_state(cube, {.inclination = 45 * degree}));
  BOOST_TEST(fallen.depth == g / (stiffness * 0.01), boost::test_tools::tolerance(1e-8));
}

/// A ball of radius R on springs: π k d² (R − d/3) = m g.
BOOST_AUTO_TEST_CASE(a_ball_sinks_until_its_cap_carries_it) {
  const double radius = 0.02;
  const Body ball = round_body({.semiaxes = Vector3::Constant(radius)}, 0.3, 5e-5 * Matrix3::Identity());
  const double d =
      equilibrium(ball, on({.stiffness = 1e8, .area = AreaMeasure::projected}), touching_state(ball, {})).depth;
  BOOST_TEST(std::numbers::pi * 1e8 * d * d * (radius - d / 3) == 0.3 * g, boost::test_tools::tolerance(1e-11));
}

/// On a slope the pressure centre lies under the centre of mass, h tan α down the slope: the face tilts by
/// m g h sin α/(k_G I).
BOOST_AUTO_TEST_CASE(on_a_slope_friction_holds_a_body_that_leans_down_it) {
  const double slope = 10;
  const Ground ground = with_friction({.stiffness = stiffness, .area = AreaMeasure::projected}, 0.3);
  const Equilibrium lies = equilibrium(brick(), on(ground, slope), touching_state(brick(), {}));
  const double second_moment = 0.2 * std::pow(0.3, 3) / 12;
  const double lean = (lies.state.attitude * Vector3::UnitZ()).x();
  const double torque = mass * g * std::sin(slope * degree) * lies.state.centre.z();
  BOOST_TEST(lean == torque / (stiffness * second_moment), boost::test_tools::tolerance(1e-4));  // lean² and its lever
  const Simulation run = simulate(brick(), on(ground, slope), lies.state, from_rest({1}));
  BOOST_TEST((run.outcome == Outcome::at_rest));
  BOOST_TEST((run.states.at(0).state.centre - lies.state.centre).norm() == 0);
  CHECK_REFUSED(static_cast<void>(equilibrium(brick(), on(ground, 20), touching_state(brick(), {}))),
                clatter::numeric::NumericalError);
  World weightless_world = weightless(ground);
  CHECK_REFUSED(static_cast<void>(equilibrium(brick(), weightless_world, touching_state(brick(), {}))),
                clatter::numeric::NumericalError);
}

/// Nothing that does not wobble may wobble, whether or not anything damps it.
BOOST_AUTO_TEST_CASE(a_body_put_down_at_rest_lies_still_from_the_start) {
  for (const double damping : {0.0, 1e6}) {
    for (const AreaMeasure area_measure : {AreaMeasure::surface, AreaMeasure::projected}) {
      const World world = on(with_friction({.stiffness = 1e9, .damping = damping, .area = area_measure}, 0.3));
      for (const Body& body : {brick(), phone(), box_body({0.1, 0.1, 0.1}, 1, 3, 2, 1, false)}) {
        const Equilibrium lies = equilibrium(body, world, touching_state(body, {}));
        const Simulation run = simulate(body, world, lies.state, from_rest({0, 1, 1e6}));
        BOOST_TEST((run.outcome == Outcome::at_rest), run.message);
        BOOST_TEST(run.impacts.empty());
        BOOST_TEST(run.rest->time == 0);
        BOOST_TEST(run.force_evaluations < 100);
        for (const StateRecord& at : run.states) {
          BOOST_TEST((at.known && at.in_contact && at.impacts == 0));
          BOOST_TEST((at.state.centre - lies.state.centre).norm() == 0);
          BOOST_TEST(at.energy_stored == lies.energy_stored, boost::test_tools::tolerance(1e-9));
          BOOST_TEST(at.error.position <= 1e-12);
        }
      }
    }
  }
}

/// Pressed twice as deep it jumps up: ½ k A (2δ)² = m g (2 δ + h).
BOOST_AUTO_TEST_CASE(a_body_pressed_deeper_than_it_lies_swings_about_its_equilibrium) {
  const World world = on({.stiffness = stiffness, .area = AreaMeasure::projected});
  MotionState start = equilibrium(brick(), world, touching_state(brick(), {})).state;
  const double depth = mass * g / (stiffness * area), frequency = std::sqrt(g / depth);
  start.centre.z() -= depth / 2;
  std::vector<double> times;
  for (int i = 0; i < 20; ++i) times.push_back(0.1 * i / frequency);
  Request request = from_rest(times);
  request.until = 2 / frequency;
  const Simulation run = simulate(brick(), world, start, request, {.digits = 8});
  BOOST_TEST((run.outcome == Outcome::time_limit));
  for (const StateRecord& at : run.states) {
    const double expected = 0.05 - depth - depth / 2 * std::cos(frequency * at.time);
    BOOST_TEST(std::fabs(at.state.centre.z() - expected) <= 1e-8 * depth);
  }
}

BOOST_AUTO_TEST_CASE(a_start_in_the_ground_is_refused_unless_it_is_meant) {
  MotionState start = touching_state(brick(), {});
  start.centre.z() -= 1e-6;
  CHECK_REFUSED(simulate(brick(), {}, start), std::domain_error);
  CHECK_REFUSED_SAYING(simulate(brick(), {}, start, from_rest({-1, 1})), std::domain_error, "run.times");
}
