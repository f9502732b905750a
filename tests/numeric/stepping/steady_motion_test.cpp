// SPDX-License-Identifier: GPL-3.0-or-later
// Motions on the ground that end in closed form: slides that friction stops, and what rolls on.
#include "numeric/equilibrium.hpp"
#include "tests/numeric/bodies.hpp"
#include "tests/numeric/support.hpp"

namespace {

using namespace clatter::numeric;
using namespace clatter::numeric::test;

constexpr double g = 9.81, mu = 0.5, speed = 6, stiffness = 1e9, side = 0.1;

Body cube() { return box_body({side, side, side}, 1); }

World world_of(FrictionLaw law, bool planar = false) {
  const Ground ground{.stiffness = stiffness, .damping = 9e11, .area = AreaMeasure::projected, .friction = law};
  return {.ground = with_friction(ground, mu), .planar = planar};
}

/// The cube that slides presses with its front alone, over the length 3 (side/2 − μ h), at the tilt and depths of a
/// triangle of pressure; h = side/2.
struct Wedge {
  double length = 3 * (side / 2 - mu * side / 2);
  double tilt = 2 * g / (stiffness * side * length * length);
  double depth = tilt * (length - side / 2);  ///< at the middle
};

}  // namespace

/// v²/(2 μ g) and v/(μ g): but for what the centre of mass sinks on the way, times μ, and its way back as the cube
/// turns level about the places that stick.
BOOST_AUTO_TEST_CASE(a_box_slides_as_far_and_as_long_as_friction_lets_it) {
  const Wedge wedge;
  const double sunk = wedge.depth, back = wedge.tilt * side / 2;
  for (const FrictionLaw law : {FrictionLaw::coulomb, FrictionLaw::local}) {
    for (const bool planar : {true, false}) {
      const World world = world_of(law, planar);
      const Simulation run =
          simulate(cube(), world, touching_state(cube(), {.velocity = {speed, 0, 0}}), plain_impacts(5));
      BOOST_TEST((run.outcome == Outcome::at_rest), run.message);
      BOOST_TEST_REQUIRE(run.rest.has_value());
      BOOST_TEST(run.rest->time == speed / (mu * g), boost::test_tools::tolerance(1e-9));
      BOOST_TEST(std::fabs(run.rest->distance - speed * speed / (2 * mu * g) - mu * sunk + back) <= 1e-8);
      BOOST_TEST(run.message.find("slides 3.66972 m and stops at 1.22324 s") != std::string::npos, run.message);
      BOOST_TEST(run.force_evaluations <= 3000);
      BOOST_TEST_REQUIRE(run.impacts.size() == 1U);
      const ImpactRecord& row = run.impacts[0];
      BOOST_TEST(std::fabs(row.ledger_gap) <= 1e-12);
      BOOST_TEST(row.value.work_friction == 18, boost::test_tools::tolerance(2e-6));  // of which the tilt has some
      BOOST_TEST(row.value.impulse.z() == g * run.rest->time, boost::test_tools::tolerance(1e-9));
      BOOST_TEST(row.value.velocity_after.norm() == 0);
      BOOST_TEST(run.final_state.centre.z() == side / 2 - g / (stiffness * side * side),
                 boost::test_tools::tolerance(1e-12));
    }
  }
  const Simulation rough =
      simulate(cube(), world_of(FrictionLaw::coulomb), touching_state(cube(), {.velocity = {speed, 0, 0}}),
               plain_impacts(5), {.digits = 4});
  BOOST_TEST(rough.force_evaluations <= 2000);
}

/// Whichever way it points, from its equilibrium too; and its states on the way are those of a constant deceleration.
BOOST_AUTO_TEST_CASE(a_box_at_rest_that_is_pushed_slides_and_stops) {
  const World world = world_of(FrictionLaw::coulomb);
  MotionState start = equilibrium(cube(), world, touching_state(cube(), {})).state;
  start.velocity = speed * Vector3(0.6, -0.8, 0);
  Request request{.impacts = 5, .times = {0, 0.5, 1, 2}};
  request.starts_on_ground = true;
  const Simulation run = simulate(cube(), world, start, request);
  BOOST_TEST((run.outcome == Outcome::at_rest), run.message);
  for (const StateRecord& at : run.states) {
    const double t = std::min(at.time, speed / (mu * g)), way = speed * t - mu * g * t * t / 2;
    BOOST_TEST((at.known && at.in_contact && at.impacts == 1));
    BOOST_TEST((at.state.centre.head<2>() - way * Vector3(0.6, -0.8, 0).head<2>()).norm() <=
               5e-6);  // the wedge's sizes
    BOOST_TEST(std::fabs(at.state.velocity.norm() - (speed - mu * g * t)) <= 1e-5);
    BOOST_TEST(at.error.position <= 1e-5);
    BOOST_TEST(at.error.velocity <= 1e-3);
  }
  BOOST_TEST(std::fabs(run.impacts.at(0).ledger_gap) <= 1e-9);
  request.times = {1};
  request.until = 1;
  const Simulation until = simulate(cube(), world, start, request);
  BOOST_TEST((until.outcome == Outcome::time_limit));
  BOOST_TEST(until.impacts.empty());
  BOOST_TEST((until.states.at(0).state.centre - run.states[2].state.centre).norm() <= 1e-9);
}

/// Up and down a slope that holds it: μ g cos ± g sin.
BOOST_AUTO_TEST_CASE(a_box_stops_on_a_slope_that_friction_can_hold_it_on) {
  World world = world_of(FrictionLaw::coulomb, true);
  world.incline_deg = 5;
  for (const double v : {2.0, -2.0}) {
    const Simulation run = simulate(cube(), world, touching_state(cube(), {.velocity = {v, 0, 0}}), plain_impacts(5));
    BOOST_TEST((run.outcome == Outcome::at_rest), run.message);
    const Gravity pull = world.pull();
    const double deceleration = mu * pull.down - std::copysign(pull.along, v);
    BOOST_TEST(run.rest->time == std::fabs(v) / deceleration, boost::test_tools::tolerance(1e-7));
    BOOST_TEST(std::fabs(run.rest->distance - v * v / (2 * deceleration)) <= 5e-6);  // the wedge's sizes
    BOOST_TEST(std::fabs(run.impacts.at(0).ledger_gap) <= 1e-9);
  }
}

/// 5/7 of its speed is left to a ball that slid first; the ground's damping takes e/R of its weight, e = c v a²/(6 k
/// R).
BOOST_AUTO_TEST_CASE(a_ball_that_slides_comes_to_roll_on) {
  const double radius = 0.0235, mass = 0.045;
  const Body ball = round_body({.semiaxes = Vector3::Constant(radius)}, mass);
  for (const double damping : {0.0, 1e8, 1e10}) {
    const World world{.ground =
                          with_friction({.stiffness = 1e9, .damping = damping, .area = AreaMeasure::projected}, 0.3)};
    const Equilibrium lies = equilibrium(ball, world, touching_state(ball, {}));
    MotionState start = lies.state;
    start.velocity = {0.5, 0, 0};
    Request request = plain_impacts(5);
    request.starts_on_ground = true;
    request.times = {0.5, 10};
    const Simulation run = simulate(ball, world, start, request);
    BOOST_TEST((run.outcome == Outcome::sustained_contact), run.message);
    BOOST_TEST((run.on_ground->kind == GroundMotionKind::rolls));
    BOOST_TEST(run.message.find("rolls on at 0.35") != std::string::npos, run.message);
    BOOST_TEST(run.force_evaluations <= 3000);
    BOOST_TEST(run.on_ground->from.velocity.x() == 5.0 / 7 * 0.5, boost::test_tools::tolerance(4e-3));  // d/R, damping
    const double patch = radius * radius - std::pow(radius - lies.depth, 2);
    const double decay = g * damping / 1e9 * patch / (6 * radius * radius * 1.4);
    BOOST_TEST(run.on_ground->decay == decay, boost::test_tools::tolerance(1e-2));  // d/R
    BOOST_TEST(
        run.states.at(1).state.velocity.x() == run.states[0].state.velocity.x() * std::exp(-9.5 * run.on_ground->decay),
        boost::test_tools::tolerance(1e-9));
  }
}

/// What slides and spins is not cut short, and says where it stands when its evaluations are used up.
BOOST_AUTO_TEST_CASE(a_box_that_slides_and_spins_says_where_it_stands) {
  MotionState start = touching_state(cube(), {.velocity = {1, 0, 0}});
  start.angular_velocity = {0, 0, 5};
  const Simulation run =
      simulate(cube(), world_of(FrictionLaw::coulomb), start, plain_impacts(5), {.evaluation_limit = 3000});
  BOOST_TEST((run.outcome == Outcome::evaluation_limit), run.message);
  BOOST_TEST(run.message.find("moves along the ground at 0.") != std::string::npos, run.message);
}

/// Pressed as its slide presses it, the box neither rocks nor heaves on undamped ground, whichever way it slides.
BOOST_AUTO_TEST_CASE(a_box_that_starts_on_the_ground_slides_without_rocking) {
  for (const FrictionLaw law : {FrictionLaw::coulomb, FrictionLaw::local}) {
    World world = world_of(law);
    world.ground.damping = 0;
    const Vector3 way(0.6, -0.8, 0);
    MotionState start = touching_state(cube(), {.velocity = speed * way});
    start.attitude = Eigen::AngleAxisd(std::atan2(-0.8, 0.6), Vector3::UnitZ());
    start = sliding_equilibrium(cube(), world, start).state;
    start.velocity = speed * way;
    // The wedge is right to first order in its tilt, 3.5e-5, times some.
    BOOST_TEST((start.attitude * Vector3::UnitZ()).dot(way) == Wedge().tilt, boost::test_tools::tolerance(3e-4));
    Request request = plain_impacts(5);
    request.starts_on_ground = true;
    const Simulation run = simulate(cube(), world, start, request);
    BOOST_TEST((run.outcome == Outcome::at_rest), run.message);
    BOOST_TEST(run.rest->time == speed / (mu * g), boost::test_tools::tolerance(1e-12));
    BOOST_TEST(run.rest->slid == speed * speed / (2 * mu * g), boost::test_tools::tolerance(1e-12));
    BOOST_TEST(run.force_evaluations <= 200);
    if (law == FrictionLaw::coulomb) BOOST_TEST((run.impacts.at(0).mode == FrictionMode::slip));
  }
}

/// Undamped it heaves about its equilibrium for ever, by sqrt(g d) at most if it was let down without a speed; its
/// slide stops when μ (g t − v_z) has used up v.
BOOST_AUTO_TEST_CASE(a_body_that_heaves_for_ever_is_said_to) {
  World world = world_of(FrictionLaw::coulomb);
  world.ground.damping = 0;
  const double depth = g / (stiffness * side * side), fall = std::sqrt(g * depth), shallow = depth / 2;
  Request request{.impacts = 5};
  request.starts_on_ground = true;
  MotionState start = touching_state(cube(), {.velocity = Vector3::Zero()});
  start.centre.z() -= shallow;
  const Simulation still = simulate(cube(), world, start, request);
  BOOST_TEST((still.outcome == Outcome::at_rest), still.message);
  BOOST_TEST(still.message.find("but for rocking") != std::string::npos, still.message);
  BOOST_TEST(still.force_evaluations <= 100'000);
  const ImpactRecord& row = still.impacts.at(0);
  BOOST_TEST(row.error.velocity_after.z() == fall / 2, boost::test_tools::tolerance(0.01));
  BOOST_TEST(row.value.impulse.z() == g * row.value.duration, boost::test_tools::tolerance(1e-9));
  BOOST_TEST(row.error.impulse.z() <= 1e-9);
  BOOST_TEST(std::fabs(row.ledger_gap) <= 1e-9);

  constexpr double slow = 0.1, friction = 0.01;
  world.ground = with_friction(world.ground, friction);
  start.velocity = {slow, 0, 0};
  const Simulation slides = simulate(cube(), world, start, request);
  BOOST_TEST((slides.outcome == Outcome::at_rest), slides.message);
  BOOST_TEST_REQUIRE(slides.impacts.size() == 1U);
  const ImpactRecord& slide = slides.impacts[0];
  BOOST_TEST(slides.force_evaluations <= 100'000);
  BOOST_TEST(std::fabs(slides.rest->time - slow / (friction * g)) <= slide.error.duration);
  BOOST_TEST(slide.error.duration <= 2 * fall / (friction * g));
  BOOST_TEST(std::fabs(slide.ledger_gap) <= 1e-6);
}

/// At its deepest a corner that sticks hardly moves for as many steps as a tight tolerance takes there; the ground
/// presses by a hundred times the weight, and what it stores it gives back.
BOOST_AUTO_TEST_CASE(an_impact_that_turns_a_body_back_is_no_rest) {
  const Body crate = box_body({0.3, 0.2, 0.1}, 2);
  const Eigen::Quaterniond attitude(0.8529184862645794, 0.2845568818869075, 0.4373181730657549, 0.0176139792599396);
  const MotionState start =
      on_ground(crate, {.attitude = attitude,
                        .velocity = {0.4, -0.2, -2.2979},
                        .angular_velocity = attitude.conjugate() * Vector3(0.91728, 1.50755, -0.648194)});
  for (const double hardness : {1e10, 1e12}) {
    const World world{.ground = with_friction({.stiffness = hardness}, 0.3)};
    const Simulation run = simulate(crate, world, start, plain_impacts(1), {.digits = 8});
    BOOST_TEST((run.outcome == Outcome::impact_limit), run.message);
    BOOST_TEST_REQUIRE(run.impacts.size() == 1U);
    BOOST_TEST(run.impacts[0].value.velocity_after.z() > 0);
    BOOST_TEST(std::fabs(run.impacts[0].value.work_damping) <= 1e-9);
  }
}
