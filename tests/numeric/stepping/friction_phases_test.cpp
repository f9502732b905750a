// SPDX-License-Identifier: GPL-3.0-or-later
// Coulomb friction during contacts.
#include "tests/numeric/bodies.hpp"
#include "tests/numeric/support.hpp"

namespace {

using namespace clatter::numeric;
using namespace clatter::numeric::test;

Simulation rod_at_45(double mu, double stiffness = 1e11, bool planar = false,
                     const HistoryRecorder& history = nullptr) {
  static const Body body = rod();
  const Ground ground = with_friction({.stiffness = stiffness}, mu);
  return dropped(body, weightless(ground, planar), 45 * degree, 1, {.digits = 8}, {.history = history});
}

double ratio(const ImpactNumbers& n) { return n.impulse.x() / n.impulse.z(); }

/// d_t d_n/(I + m d_n²): the ratio that sticking takes at the rim.
double sticking_ratio() {
  const double angle = 45 * degree, r = 0.01;
  const double across = 0.5 * std::cos(angle) - r * std::sin(angle);
  const double down = 0.5 * std::sin(angle) + r * std::cos(angle);
  return across * down / (rod().inertia()(1, 1) + down * down);
}

}  // namespace

BOOST_AUTO_TEST_CASE(slip_in_one_direction_has_the_impulse_ratio_mu) {
  for (const double mu : {0.1, 0.3, 0.5}) {
    const Simulation run = rod_at_45(mu);
    BOOST_TEST((run.impacts.at(0).mode == FrictionMode::slip));
    BOOST_TEST(std::fabs(ratio(run.impacts.at(0).value)) == mu, boost::test_tools::tolerance(1e-9));
    BOOST_TEST(run.impacts.at(0).value.work_friction > 0);
  }
}

/// Above the sliding friction the static one only keeps slip that has ended from beginning again.
BOOST_AUTO_TEST_CASE(a_body_that_slides_feels_the_sliding_friction_alone) {
  const double sliding = 0.3;
  const Ground tilted{.stiffness = 1e11, .static_friction = 0.5, .sliding_friction = sliding};  // 0.586 would stick
  const Simulation rod_run = dropped(rod(), weightless(tilted), 45 * degree, 1);
  BOOST_TEST((rod_run.impacts.at(0).mode == FrictionMode::slip));
  BOOST_TEST(std::fabs(ratio(rod_run.impacts.at(0).value)) == sliding, boost::test_tools::tolerance(1e-9));
  // A plate that slides at 10 m/s, by a law over its whole patch: (v_r/v)²/2 below the coefficient.
  const Ground local{
      .stiffness = 1e8, .static_friction = 0.5, .sliding_friction = sliding, .friction = FrictionLaw::regularised};
  const Body plate = phone();
  const MotionState start = touching_state(plate, {.velocity = {10, 0, -1}});
  const Simulation plate_run = simulate(plate, weightless(local), start, plain);
  BOOST_TEST(ratio(plate_run.impacts.at(0).value) == -sliding, boost::test_tools::tolerance(1e-7));
}

/// Claim C11: a plateau from about 0.6 on; with the rod's real radius from 0.586 on, but for the patch's size.
BOOST_AUTO_TEST_CASE(beyond_the_sticking_ratio_more_friction_changes_nothing) {
  const Simulation first = rod_at_45(0.62), second = rod_at_45(0.8);
  BOOST_TEST((first.impacts.at(0).mode == FrictionMode::stick));
  // The very end, where the force fades and the rod's turning asks for more than it, slips for an instant.
  BOOST_TEST(ratio(first.impacts.at(0).value) == ratio(second.impacts.at(0).value), boost::test_tools::tolerance(1e-5));
  // The rigid body's ratio but for the patch's size, which falls by √10 on a ground a hundred times as stiff.
  const auto off = [](const Simulation& run) {
    return std::fabs(std::fabs(ratio(run.impacts.at(0).value)) - sticking_ratio());
  };
  BOOST_TEST(off(first) <= 0.01);
  BOOST_TEST(off(rod_at_45(0.8, 1e13)) <= 0.4 * off(second));
  BOOST_TEST(std::fabs(first.impacts.at(0).value.work_friction) <= 1e-9 * first.energy_start);
}

/// Claim C12.
BOOST_AUTO_TEST_CASE(the_pressure_centre_of_a_sticking_rod_stays_at_rest) {
  std::vector<HistorySample> rows;
  const Simulation run = rod_at_45(0.7, 1e11, false, [&](const HistorySample& sample) { rows.push_back(sample); });
  BOOST_REQUIRE(rows.size() > 10);
  for (const HistorySample& row : rows) {
    // But for the very end, where the force has faded.
    if (!(row.force.z() > 0.01 * run.impacts.at(0).value.peak_force)) continue;
    BOOST_TEST(std::fabs(row.point_velocity.x()) <= 1e-9);
    BOOST_TEST(std::hypot(row.force.x(), row.force.y()) <= 0.7 * row.force.z());
  }
}

/// At 45° the rod sticks from 0.586 on: with that much static friction, however little when it slides.
BOOST_AUTO_TEST_CASE(slip_that_ends_sticks_or_turns_as_the_static_friction_allows) {
  struct Case {
    double speed, static_friction, sliding_friction;
    FrictionMode mode;
  };
  const Body body = rod();
  for (const Case& c : {Case{0.3, 0.7, 0.7, FrictionMode::slip_stick},
                        {0.3, 0.7, 0.5, FrictionMode::slip_stick},
                        {0.3, 0.2, 0.2, FrictionMode::reverse_slip},
                        {-0.3, 0.2, 0.2, FrictionMode::slip}}) {
    const MotionState start = touching_state(body, {.inclination = 45 * degree, .velocity = {c.speed, 0, -1}});
    const Ground ground{
        .stiffness = 1e11, .static_friction = c.static_friction, .sliding_friction = c.sliding_friction};
    BOOST_TEST((simulate(body, weightless(ground), start, plain).impacts[0].mode == c.mode),
               c.speed << ' ' << c.static_friction << ' ' << c.sliding_friction);
  }
}

/// In space the plane of the drop may be any: here it is turned by 0.7 rad about the vertical.
BOOST_AUTO_TEST_CASE(friction_knows_no_direction_of_the_ground) {
  const Body body = phone();
  const Ground ground{.stiffness = 1e8, .damping = 1e6, .static_friction = 0.3, .sliding_friction = 0.2};
  MotionState start =
      touching_state(body, {.inclination = 0.4, .velocity = {1, 0.5, -2}, .spin = 3, .out_of_plane_tilt = 0.2});
  const ImpactNumbers straight = simulate(body, weightless(ground), start, plain).impacts[0].value;
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(0.7, Vector3::UnitZ()));
  start.attitude = turn * start.attitude;
  start.velocity = turn * start.velocity;
  const ImpactNumbers turned = simulate(body, weightless(ground), start, plain).impacts[0].value;
  BOOST_TEST((turned.impulse - turn * straight.impulse).norm() <= 1e-8 * straight.impulse.norm());
  BOOST_TEST((turned.angular_velocity_after - turn * straight.angular_velocity_after).norm() <=
             1e-7 * straight.angular_velocity_after.norm());
}

/// The regularised law tends to Coulomb's as its speed falls.
BOOST_AUTO_TEST_CASE(the_regularised_law_tends_to_coulombs) {
  const Body body = rod();
  const auto impulse = [&](const Ground& ground) {
    return dropped(body, weightless(ground), 45 * degree, 1).impacts[0].value.impulse;
  };
  const Vector3 coulomb = impulse(with_friction({.stiffness = 1e11}, 0.3));
  double previous = 1;
  for (const double speed : {1e-2, 1e-3, 1e-4}) {
    const Vector3 soft = impulse(
        with_friction({.stiffness = 1e11, .friction = FrictionLaw::regularised, .regularisation_speed = speed}, 0.3));
    const double gap = (soft - coulomb).norm();
    BOOST_TEST(gap < 0.5 * previous);
    previous = gap;
  }
  BOOST_TEST(previous <= 1e-3 * coulomb.norm());
}

/// A plate that spins flat on the ground: the local law slows the spin, sticking at the centre would not.
BOOST_AUTO_TEST_CASE(the_regularised_law_slows_a_spinning_plate) {
  const Body body = phone();
  MotionState start = touching_state(body, {.velocity = {0, 0, -1}});
  start.angular_velocity = Vector3(0, 0, 10);
  const Ground ground = with_friction({.stiffness = 1e8, .friction = FrictionLaw::regularised}, 0.3);
  const Simulation run = simulate(body, weightless(ground), start, plain);
  const double spin = run.impacts.at(0).value.angular_velocity_after.z();
  BOOST_TEST(spin < 9.9);
  BOOST_TEST(spin > -10 * eps);  // it may come to rest, to rounding, and does not turn back
  BOOST_TEST(run.impacts.at(0).value.work_friction > 0);
}

/// Friction that brings slip and spin to rest together is stiff; a law that jumps there made steps a billionth as long.
BOOST_AUTO_TEST_CASE(a_patch_that_hardly_slips_and_spins_takes_few_steps_at_any_tolerance) {
  const Body body = box_body({0.25, 0.17, 0.008}, 0.48);
  const World world{.ground = with_friction({.stiffness = 5.6e10, .damping = 1.65e10}, 0.4)};
  const MotionState start =
      touching_state(body, {.inclination = 85 * degree, .velocity = {0, 0, -4.852}, .out_of_plane_tilt = 2 * degree});
  const auto run = [&](Method method, double tolerance) {
    return simulate(body, world, start, plain, {.method = method, .tolerance = tolerance, .evaluation_limit = 100'000});
  };
  const Simulation best = run(Method::rk8pd, 1e-13);
  for (const double tolerance : {1e-8, 1e-10, 1e-12}) {
    const Simulation other = run(Method::rkck, tolerance);
    const Vector3 off = other.impacts.at(0).value.impulse - best.impacts.at(0).value.impulse;
    // Slow slip errs by the root of the tolerance.
    BOOST_TEST(off.norm() <= 0.01 * std::sqrt(tolerance) * best.impacts.at(0).value.impulse.norm());
  }
}

/// Holding the corner takes 0.736 of the normal force at the touch, and less than μ = 0.706 soon after: slip that began
/// has turned by then, and goes on.
BOOST_AUTO_TEST_CASE(slip_that_has_hardly_begun_is_free_to_turn_at_the_usual_tolerances) {
  const Body body = box_body({0.1372, 0.07699, 0.01878}, 0.299);
  const World world{.ground = with_friction({.stiffness = 6.7e10, .damping = 7.28e8}, 0.706)};
  const MotionState start = touching_state(
      body, {.inclination = 1.4388 * degree, .velocity = {0, 0, -1.3}, .out_of_plane_tilt = 0.1411 * degree});
  const auto spin = [&](const Accuracy& accuracy) {
    const Simulation run = simulate(body, world, start, plain, accuracy);
    BOOST_TEST((run.impacts.at(0).mode == FrictionMode::slip));
    return run.impacts.at(0).value.angular_velocity_after.z();
  };
  const double fine = spin({.method = Method::rk8pd, .tolerance = 1e-12});
  for (const double tolerance : {1e-7, 1e-8, 1e-10}) {
    // Slip that begins errs by a hundredth of the root of the tolerance; one that sticks has more than twice the spin.
    const double bound = 0.03 * std::sqrt(tolerance) * std::fabs(fine);
    BOOST_TEST(std::fabs(spin({.method = Method::rkck, .tolerance = tolerance}) - fine) <= bound);
  }
}
