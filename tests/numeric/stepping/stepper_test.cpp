// SPDX-License-Identifier: GPL-3.0-or-later
// Observed orders of the time integration.
#include "numeric/motion/free_flight.hpp"
#include "numeric/stepping/contact_run.hpp"
#include "tests/numeric/bodies.hpp"
#include "tests/numeric/support.hpp"

namespace {

using namespace clatter::numeric;
using namespace clatter::numeric::test;

constexpr int halvings = CLATTER_TEST_SLOW_BUILD ? 4 : 5;
constexpr long many_steps = CLATTER_TEST_SLOW_BUILD ? 50'000 : 1'000'000;
const std::vector<double> phases = CLATTER_TEST_SLOW_BUILD ? std::vector{0.37} : std::vector{1.0, 0.37, 0.05};

struct Scene {
  Body body;
  Ground ground;
  MotionState touch;
};

Scene scene(const Body& body, const Ground& ground, double angle, double tilt) {
  return {body, ground,
          touching_state(body,
                         {.inclination = angle * degree, .velocity = {0, 0, -1}, .out_of_plane_tilt = tilt * degree})};
}

std::vector<Scene> scenes() {
  return {scene(phone(), {.stiffness = 1e8}, 10, 0), scene(phone(), {.stiffness = 1e8, .damping = 1e7}, 10, 0),
          scene(phone(), {.stiffness = 1e8, .damping = 1e7, .area = AreaMeasure::projected}, 20, 15),
          scene(phone(), {.stiffness = 1e8, .damping = 1e7, .area = AreaMeasure::projected}, 0, 0),
          scene(rod(), {.stiffness = 1e11, .damping = 1e9}, 45, 0)};
}

ContactResult run(const Scene& s, Method method, const ContactControl& how) {
  ContactSystem system(s.body, s.ground, 0, false);
  const auto stepper = make_stepper(method);
  ContactControl control = how;
  control.evaluation_limit = 100'000'000;
  return ContactRun(system, *stepper).run(s.touch, touch_point(s.body, s.touch), control);
}

double distance(const Scene& s, const ContactResult& a, const ContactResult& b) {
  return (a.after.velocity - b.after.velocity).norm() +
         s.body.radius() * (a.after.angular_velocity - b.after.angular_velocity).norm();
}

}  // namespace

/// The reference is the eighth-order method at its finest; its own error is below 1e-14.
BOOST_AUTO_TEST_CASE(tvd_rk3_has_order_three_whatever_the_phase_of_its_first_step) {
  for (const Scene& s : scenes()) {
    const ContactResult reference = run(s, Method::rk8pd, {.steps = {.tolerance = 3e-15}});
    for (const double phase : phases) {
      double previous = 0;
      for (int halving = 0; halving <= halvings; ++halving) {
        const double step = reference.duration / 40 / std::pow(2.0, halving);
        const ContactResult result = run(s, Method::tvd_rk3, {.steps = {.step = step, .first_step = phase * step}});
        const double error = distance(s, result, reference);
        if (halving > 0) BOOST_TEST(std::fabs(std::log2(previous / error) - 3) <= 0.1);
        previous = error;
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(the_error_of_adaptive_methods_follows_the_tolerance_over_six_decades) {
  for (const Scene& s : scenes()) {
    const ContactResult reference = run(s, Method::rk8pd, {.steps = {.tolerance = 3e-15}});
    for (const Method method : {Method::rk8pd, Method::rkf45, Method::rkck, Method::rk4}) {
      const double finest = 1e-11;
      for (double tolerance = 1e-5; tolerance >= finest; tolerance /= 10) {
        const ContactResult result = run(s, method, {.steps = {.tolerance = tolerance}});
        BOOST_TEST(distance(s, result, reference) <= 100 * tolerance);
      }
      const double coarse = distance(s, run(s, method, {.steps = {.tolerance = 1e-5}}), reference);
      const double fine = distance(s, run(s, method, {.steps = {.tolerance = finest}}), reference);
      BOOST_TEST(fine <= 1e-3 * coarse + 1e-12);
    }
  }
}

/// A box that tumbles while it sinks into a ground too soft to bear it, so that the contact never ends.
BOOST_AUTO_TEST_CASE(the_euler_parameters_stay_of_unit_norm_over_a_million_steps) {
  const Body body = box_body({0.3, 0.2, 0.1}, 1);
  const Ground ground{.stiffness = 1e3, .area = AreaMeasure::projected};
  const MotionState touch =
      touching_state(body, {.inclination = 0.3, .velocity = {0, 0, -0.1}, .spin = -1, .out_of_plane_tilt = 0.2});
  ContactSystem system(body, ground, 9.81, false);
  const auto stepper = make_stepper(Method::tvd_rk3);
  long steps = 0;
  double worst = 0;
  ContactControl control;
  control.steps.step = 1e-3;
  control.evaluation_limit = 100'000'000;
  const auto count = [&](const ContactInstant& at) {
    worst = std::max(worst, std::fabs(euler_parameters(at.state).norm() - 1));
    return ++steps < many_steps;
  };
  const ContactResult result = ContactRun(system, *stepper).run(touch, touch_point(body, touch), control, count);
  BOOST_TEST(static_cast<int>(result.ending) == static_cast<int>(ContactEnding::interrupted));
  BOOST_TEST(steps == many_steps);
  BOOST_TEST(worst <= 1e-15);
}

BOOST_AUTO_TEST_CASE(peak_force_and_duration_converge_with_the_state) {
  for (const Scene& s : scenes()) {
    const ContactResult reference = run(s, Method::rk8pd, {.steps = {.tolerance = 3e-15}});
    const ContactResult result = run(s, Method::rk8pd, {.steps = {.tolerance = 1e-11}});
    BOOST_TEST(result.peak_force == reference.peak_force, boost::test_tools::tolerance(1e-8));
    BOOST_TEST(result.duration == reference.duration, boost::test_tools::tolerance(1e-9));
  }
}

/// The Jacobian has the derivatives by velocities alone, so that the springs' part of it is wrong; the eighth-order
/// method's step stands for the solution.  A step's own error is of fourth order.
BOOST_AUTO_TEST_CASE(the_linearly_implicit_step_has_order_three_with_an_incomplete_jacobian) {
  std::vector<Scene> all = scenes();
  const Ground rough{.stiffness = 1e8, .damping = 1e7, .area = AreaMeasure::projected};
  all.push_back(scene(phone(), with_friction(rough, 0.3), 20, 15));
  all.back().touch.angular_velocity = {1, -2, 3};
  for (const Scene& s : all) {
    ContactSystem system(s.body, s.ground, 0, false);
    const auto exact = make_stepper(Method::rk8pd);
    ContactInstant middle;
    const auto until_middle = [&](const ContactInstant& at) {
      middle = at;
      return at.time == 0 || at.diagnosis.force_rate >= 0;
    };
    const ContactResult whole = ContactRun(system, *exact)
                                    .run(s.touch, touch_point(s.body, s.touch),
                                         {.steps = {.tolerance = 1e-10}, .evaluation_limit = 100'000}, until_middle);
    FrictionStepper stepper;
    stepper.begin(whole.scales.speed, s.body.radius());
    double longest = 0, shortest = 0;  // the errors of those steps
    for (int halving = 0; halving <= 3; ++halving) {
      const double h = middle.time / 40 / std::pow(2.0, halving);
      ContactState one, other, error;
      BOOST_REQUIRE(stepper.step(system, middle.state, middle.rate, h, one, error));
      BOOST_REQUIRE(exact->step(system, middle.state, middle.rate, h, other, error));
      const double off = (velocity(one) - velocity(other)).norm() +
                         s.body.radius() * (angular_velocity(one) - angular_velocity(other)).norm();
      (halving == 0 ? longest : shortest) = off;
    }
    BOOST_TEST(std::log2(longest / shortest) / 3 >= 3.5);
  }
}

/// A patch that spins slowly while its centre hardly slips: friction there is a damper of which a contact lasts ten
/// thousand times.  Explicit steps took 358,000 evaluations at 1e-5, and 688,000 at 1e-7.
BOOST_AUTO_TEST_CASE(slip_that_is_slow_beside_its_patch_s_spin_takes_few_steps) {
  const Body body = box_body({0.15, 0.075, 0.008}, 0.165);
  World world;
  world.ground = with_friction({.modulus = 2.31e9, .dissipation = 0.3235, .area = AreaMeasure::projected}, 0.3);
  world.gravity = 9.81;
  const Eigen::Quaterniond attitude(0.7230102059124981, 0.024849087965851484, -0.6889174529324525,
                                    -0.045072253312818146);
  MotionState start{.attitude = attitude.normalized(), .velocity = {0, 0, -std::sqrt(2 * 9.81)}};
  start.centre.z() -= lowest_height(body, start);
  const auto second = [&](double tolerance) {
    const Simulation found =
        simulate(body, world, start, plain_impacts(2), {.method = Method::rkck, .tolerance = tolerance});
    BOOST_TEST_REQUIRE(found.impacts.size() == 2);
    return std::pair(found.impacts[1].value, found.force_evaluations);
  };
  const auto [rough, few] = second(1e-5);
  const auto [fine, more] = second(1e-8);
  BOOST_TEST(few <= 5'000);
  BOOST_TEST(more <= 30'000);
  BOOST_TEST((rough.impulse - fine.impulse).norm() <= 2e-3 * fine.impulse.norm());
  BOOST_TEST((rough.angular_velocity_after - fine.angular_velocity_after).norm() <=
             2e-3 * fine.angular_velocity_after.norm());
}

/// The regularised law is a damper of rate μ F_n/(m v₀) near rest; what slides slower than μ (1 + e) v_n is stopped.
BOOST_AUTO_TEST_CASE(regularised_friction_of_a_small_speed_takes_few_steps) {
  const Body body = box_body({0.2, 0.1, 0.01}, 1);
  for (const double slow : {1e-3, 1e-5, 1e-7}) {
    World world;
    world.ground = with_friction({.stiffness = 1e8,
                                  .area = AreaMeasure::projected,
                                  .friction = FrictionLaw::regularised,
                                  .regularisation_speed = slow},
                                 0.3);
    world.planar = true;
    const MotionState start = touching_state(body, {.velocity = {0.2, 0, -1}});
    const Simulation found =
        simulate(body, world, start, plain_impacts(1), {.method = Method::rkck, .tolerance = 1e-6});
    BOOST_TEST(std::fabs(found.impacts.at(0).value.velocity_after.x()) <= 0.01);
    BOOST_TEST(found.force_evaluations <= 200'000, slow << ": " << found.force_evaluations);
  }
}
