// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/motion/free_flight.hpp"

#include "tests/numeric/bodies.hpp"
#include "tests/numeric/support.hpp"

namespace {

using namespace clatter::numeric;
using namespace clatter::numeric::test;

MotionState random_state(Random& random, const Body& body) {
  MotionState state;
  state.attitude = random.attitude();
  state.velocity = random.vector(2);
  state.angular_velocity = random.vector(50);
  state.centre.z() = 1 - (lowest_height(body, {.centre = Vector3::UnitZ(), .attitude = state.attitude})) * (1 - 1e-3);
  return state;
}

/// Lowest height by brute force over the vertices.
double lowest_by_hand(const Body& body, const MotionState& state) {
  double lowest = 1e300;
  for (const Vector3& u : body.facets().vertices) lowest = std::min(lowest, (state.centre + state.attitude * u).z());
  return lowest;
}

}  // namespace

BOOST_AUTO_TEST_CASE(the_parabola_is_exact) {
  const Body body = phone();
  MotionState start;
  start.centre = Vector3(1, 2, 3);
  start.velocity = Vector3(0.5, -0.25, 4);
  const MotionState later = FreeFlight(body, start, 10).at(0.5);
  BOOST_TEST((later.centre - Vector3(1.25, 1.875, 3.75)).norm() == 0);
  BOOST_TEST((later.velocity - Vector3(0.5, -0.25, -1)).norm() == 0);
}

/// In space this axis is unstable, and the least deviation turns the phone over within 40 radians.
BOOST_AUTO_TEST_CASE(a_planar_flight_keeps_its_axis) {
  const Body body = phone();
  MotionState start;
  start.angular_velocity = Vector3(1e-9, 80, 0);
  const Vector3 axis = start.angular_velocity.normalized();
  const MotionState plane = FreeFlight(body, start, 9.81, true).at(1);
  BOOST_TEST((plane.attitude * axis - axis).norm() <= 1e-12);
  BOOST_TEST((FreeFlight(body, start, 9.81).at(1).attitude * axis - axis).norm() > 0.1);
}

BOOST_AUTO_TEST_CASE(a_fall_without_turning_touches_after_the_time_of_the_parabola) {
  const Body body = phone();
  MotionState start = touching_state(body, {.inclination = 0.3});
  start.centre.z() += 2;
  start.velocity.setZero();
  const TouchDown down = next_touch_down(body, FreeFlight(body, start, 9.81));
  BOOST_REQUIRE((down.kind == TouchDown::Kind::touch));
  BOOST_TEST(down.time == std::sqrt(2 * 2 / 9.81), boost::test_tools::tolerance(1e-14));
  BOOST_TEST(down.evaluations <= 20);
}

/// The bound proves it; sampling a thousand times as finely as the search finds nothing lower either.
BOOST_AUTO_TEST_CASE(no_vertex_is_below_the_ground_before_the_touch_down) {
  Random random(7);
  const Body body = phone(3, 2, 2, false);
  for (int i = 0; i < 20; ++i) {
    const FreeFlight flight(body, random_state(random, body), 9.81);
    const TouchDown down = next_touch_down(body, flight);
    BOOST_REQUIRE((down.kind == TouchDown::Kind::touch));
    BOOST_TEST(down.evaluations <= 1000);
    const double rounding = 1e-14;
    for (int k = 0; k <= 2000; ++k) BOOST_REQUIRE(lowest_by_hand(body, flight.at(down.time * k / 2000)) >= -rounding);
    BOOST_TEST(std::fabs(lowest_by_hand(body, flight.at(down.time))) <= rounding);
  }
}

BOOST_AUTO_TEST_CASE(a_body_that_rises_without_gravity_never_touches) {
  const Body body = phone();
  MotionState start = touching_state(body, {.inclination = 0.3, .velocity = {0, 0, 2}});
  start.centre.z() += 1e-3;
  start.angular_velocity = Vector3(5, 6, 7);
  BOOST_TEST((next_touch_down(body, FreeFlight(body, start, 0)).kind == TouchDown::Kind::never));
}

/// A corner at distance R turns with ω under a centre that rises with V; with q = V/(Rω) its lowest height is
///     z₀ + V t₀ − (V/ω) asin q − R √(1 − q²),
/// t₀ the time until it is at the bottom.
BOOST_AUTO_TEST_CASE(a_graze_is_decided_to_a_millionth_of_a_millionth) {
  const Body body = box_body({1, 0.1, 0.1}, 1);
  const double omega = 3, rise = 1e-3, reach = std::hypot(0.5, 0.05);
  const double at_bottom = (std::numbers::pi / 2 - std::atan2(0.05, 0.5)) / omega, q = rise / (reach * omega);
  const double lowest = rise * at_bottom - rise / omega * std::asin(q) - reach * std::sqrt(1 - q * q);
  MotionState start;
  start.angular_velocity = Vector3(0, omega, 0);
  start.velocity.z() = rise;
  start.centre.z() = -lowest - 1e-12;
  BOOST_TEST((next_touch_down(body, FreeFlight(body, start, 0)).kind == TouchDown::Kind::touch));
  start.centre.z() = -lowest + 1e-12;
  BOOST_TEST((next_touch_down(body, FreeFlight(body, start, 0)).kind == TouchDown::Kind::never));
}

/// A long flight is bridged without stepping: the search looks only where the sphere around the body is near.
BOOST_AUTO_TEST_CASE(the_cost_of_a_flight_does_not_grow_with_its_height) {
  const Body body = phone();
  for (const double height : {1.0, 1e3, 1e6}) {
    MotionState start;
    start.centre.z() = height;
    start.angular_velocity = Vector3(0, 1, 0);
    BOOST_TEST(next_touch_down(body, FreeFlight(body, start, 9.81)).evaluations <= 60);
  }
}

BOOST_AUTO_TEST_CASE(the_lowest_height_is_that_of_the_lowest_vertex) {
  Random random(3);
  const Body body = rod();
  for (int i = 0; i < 100; ++i) {
    const MotionState state = random_state(random, body);
    BOOST_TEST(std::fabs(lowest_height(body, state) - lowest_by_hand(body, state)) <= 1e-14);
  }
}
