// SPDX-License-Identifier: GPL-3.0-or-later
// Drops of bodies without corners against conservation.
#include "numeric/motion/free_flight.hpp"
#include "tests/numeric/bodies.hpp"
#include "tests/numeric/support.hpp"

namespace {

using namespace clatter::numeric;
using namespace clatter::numeric::test;

/// The inertia of an ellipsoid of the extents of the shape: any that a body can have serves.
Body any_round(const SmoothShape& shape, double mass) {
  const Vector3 half = shape.semiaxes + Vector3(shape.straight / 2, 0, 0), square = half.cwiseProduct(half);
  const Vector3 moments(square.y() + square.z(), square.z() + square.x(), square.x() + square.y());
  return round_body(shape, mass, mass / 5 * moments.asDiagonal());
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_rolling_ball_hops_on_rolling) {
  const Body body = any_round({.semiaxes = Vector3::Constant(0.0235)}, 0.045);
  MotionState start;
  start.velocity = {0.5, 0, -2};
  start.angular_velocity = {0, 0.5 / 0.0235, 0};
  for (const FrictionLaw law : {FrictionLaw::coulomb, FrictionLaw::local}) {
    const World world{.ground = {.stiffness = 1e9,
                                 .static_friction = 0.3,
                                 .sliding_friction = 0.25,
                                 .area = AreaMeasure::projected,
                                 .friction = law},
                      .gravity = 0};
    const Simulation run = simulate(body, world, on_ground(body, start), plain_impacts(1), {.digits = 6});
    // The springs give way while the ball rolls: its lowest point, d below, has the speed ω (R − d).
    BOOST_TEST(std::fabs(run.impacts.at(0).value.angular_velocity_after.y() * 0.0235 / 0.5 - 1) <= 0.03);
  }
}

BOOST_AUTO_TEST_CASE(the_ledger_of_energy_closes_and_error_bars_hold_for_round_bodies) {
  Random random(3);
  int numbers = 0, held = 0;
  for (int i = 0; i < 6; ++i) {
    const bool is_capsule = i % 3 == 0, has_friction = i % 2 == 0;
    SmoothShape shape{
        is_capsule ? Vector3(Vector3::Constant(0.02)) : 0.01 * Vector3(random(2, 5), random(2, 5), random(2, 5)),
        is_capsule ? 0.06 : 0,
        {}};
    shape.centre = i % 5 == 0 ? random.vector(0.004) : Vector3::Zero();
    const Body body = any_round(shape, 0.2);
    MotionState start;
    start.attitude = random.attitude();
    start.velocity = {random(-1, 1), random(-1, 1), -random(0.5, 2)};
    start.angular_velocity = random.vector(10);
    const FrictionLaw laws[] = {FrictionLaw::coulomb, FrictionLaw::local, FrictionLaw::regularised};
    const World world{.ground = {.stiffness = 1e9,
                                 .damping = i % 4 == 3 ? 2e9 : 1e8,
                                 .static_friction = has_friction ? 0.4 : 0,
                                 .sliding_friction = has_friction ? 0.3 : 0,
                                 .area = i % 4 < 2 ? AreaMeasure::surface : AreaMeasure::projected,
                                 .friction = laws[(i / 2) % 3],
                                 .regularisation_speed = 1e-2}};
    const MotionState touch = on_ground(body, start);
    const Simulation run = simulate(body, world, touch, {.impacts = 1}, {.digits = 4});
    const Simulation truth = simulate(body, world, touch, plain_impacts(1), {.digits = 6});
    BOOST_REQUIRE(run.impacts.size() == 1U && truth.impacts.size() == 1U);
    const ImpactRecord &row = run.impacts.at(0), &right = truth.impacts.at(0);
    BOOST_TEST(std::fabs(right.ledger_gap) <= 1e-8, "drop " << i << ": " << right.ledger_gap);
    const auto judge = [&](double value, double exact, double bar) {
      ++numbers;
      if (std::fabs(value - exact) <= bar) ++held;
    };
    judge(row.value.peak_force, right.value.peak_force, row.error.peak_force);
    judge(row.value.duration, right.value.duration, row.error.duration);
    for (int j = 0; j < 3; ++j) {
      judge(row.value.velocity_after[j], right.value.velocity_after[j], row.error.velocity_after[j]);
      judge(row.value.angular_velocity_after[j], right.value.angular_velocity_after[j],
            row.error.angular_velocity_after[j]);
    }
  }
  BOOST_TEST(held >= 0.95 * numbers, held << " of " << numbers << " numbers within their bars");
}

/// The line on which nothing slips passes a millimetre beside the mantle on its way into it.  Against an integration of
/// its own in Python: rows of Gauss nodes graded towards that line, DOP853 at 1e-11.
BOOST_AUTO_TEST_CASE(local_slip_that_all_but_vanishes_beside_a_capsule_is_integrated) {
  const double length = 0.16527938169822023, radius = 0.029878187168985038;
  const Vector3 moments(0.00046933462367569677, 0.002247667560783182, 0.002247667560783182);
  const Body body = round_body({.semiaxes = Vector3::Constant(radius), .straight = length - 2 * radius},
                               1.1124639365621023, moments.asDiagonal());
  const World world{.ground = {.stiffness = 84484122.41124359,
                               .damping = 316648.1129582398,
                               .static_friction = 0.48486095997500245,
                               .sliding_friction = 0.48486095997500245,
                               .area = AreaMeasure::surface,
                               .friction = FrictionLaw::local}};
  MotionState start;
  start.attitude =
      Eigen::Quaterniond(-0.08387247648239934, -0.1343144539455736, 0.985739626014465, 0.05694229407807876);
  start.velocity = {-2.0620129535248894, -2.005626167983248, -1.7326132988819298};
  start.angular_velocity =
      start.attitude.conjugate() * Vector3(36.7229272388965, 25.194942760446224, -29.278164078217205);
  const Simulation run = simulate(body, world, on_ground(body, start), {.impacts = 1}, {.digits = 6});
  const ImpactRecord& row = run.impacts.at(0);
  BOOST_TEST(std::fabs(row.value.impulse.x() - 0.8127816) <= row.error.impulse.x() + 2e-7);
  BOOST_TEST(std::fabs(row.value.angular_velocity_after.y() + 36.308458) <=
             row.error.angular_velocity_after.y() + 2e-6);
  BOOST_TEST(row.error.impulse.x() <= 3e-6);
}

BOOST_AUTO_TEST_CASE(flights_end_where_the_lowest_point_touches) {
  Random random(4);
  for (int i = 0; i < 50; ++i) {
    const bool is_capsule = i % 2 == 0;
    const SmoothShape shape{is_capsule ? Vector3(Vector3::Constant(0.3)) : Vector3(random(0.2, 1), random(0.2, 1), 0.4),
                            is_capsule ? 1.0 : 0, random.vector(0.1)};
    const Body body = any_round(shape, 1);
    MotionState start;
    start.centre = {0, 0, random(1.5, 3)};
    start.velocity = random.vector(2);
    start.angular_velocity = random.vector(8);
    const FreeFlight flight(body, start, 9.81);
    const TouchDown down = next_touch_down(body, flight);
    BOOST_REQUIRE(down.kind == TouchDown::Kind::touch);
    BOOST_TEST(std::fabs(lowest_height(body, flight.at(down.time))) <= 1e-14);
    for (int j = 0; j < 500; ++j) BOOST_REQUIRE(lowest_height(body, flight.at(down.time * j / 500)) > 0);
  }
}
