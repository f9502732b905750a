// SPDX-License-Identifier: GPL-3.0-or-later
// States at times that were asked for: closed forms, reversal of time, and what their error bars promise.
#include "numeric/motion/free_flight.hpp"
#include "tests/numeric/bodies.hpp"
#include "tests/numeric/support.hpp"

namespace {

using namespace clatter::numeric;
using namespace clatter::numeric::test;

constexpr double rounding = 1e-13;  ///< of numbers of order 1
constexpr double promised = 1e-9;   ///< of ten digits asked for

Request at_times(std::vector<double> times, int impacts = 1) {
  Request request = plain_impacts(impacts);
  request.times = std::move(times);
  return request;
}

MotionState before_touch(const Body& body, const MotionState& touch, const World& world, double time) {
  return FreeFlight(body, touch, world.pull(), world.planar).at(-time);
}

MotionState reversed(MotionState state) {
  state.velocity *= -1;
  state.angular_velocity *= -1;
  return state;
}

double angle_between(const MotionState& a, const MotionState& b) {
  return Eigen::AngleAxisd(a.attitude.conjugate() * b.attitude).angle();
}

StateErrors distance(const MotionState& a, const MotionState& b) {
  return {.position = (a.centre - b.centre).norm(),
          .angle = std::remainder(angle_between(a, b), 2 * std::numbers::pi),
          .velocity = (a.velocity - b.velocity).norm(),
          .angular_velocity = (a.angular_velocity - b.angular_velocity).norm()};
}

/// The largest of the four in units of the body's size and a speed.
double size_of(const StateErrors& e, double radius, double speed) {
  return std::max({e.position / radius, std::fabs(e.angle), e.velocity / speed, e.angular_velocity * radius / speed});
}

MotionState some_drop(const Body& body, Random& random) {
  return touching_state(body, {.inclination = random(5, 80) * degree,
                               .velocity = {random(-1, 1), random(-1, 1), -random(1, 5)},
                               .spin = random(-5, 5),
                               .out_of_plane_tilt = random(-0.5, 0.5)});
}

}  // namespace

/// A ball's flight is a parabola, and its turning uniform; after the last impact, and before the first.
BOOST_AUTO_TEST_CASE(states_in_flight_have_their_closed_form) {
  const Body ball = round_body({.semiaxes = Vector3::Constant(0.1)});
  const World world{.ground = {.stiffness = 1e7, .area = AreaMeasure::projected}, .gravity = 9.81};
  MotionState touch;
  touch.velocity = {0.3, -0.2, -4};
  touch.angular_velocity = {1, 2, 3};
  touch = on_ground(ball, touch);
  const MotionState start = before_touch(ball, touch, world, 0.3);
  const Simulation run = simulate(ball, world, start, at_times({-0.3, -0.1, 0.4, 0.7}), {.digits = 10});
  const ImpactNumbers& n = run.impacts.at(0).value;
  BOOST_TEST_REQUIRE(run.states.size() == 4U);
  for (const StateRecord& at : run.states) {
    BOOST_TEST_REQUIRE(at.known);
    BOOST_TEST(at.impacts == (at.time < 0 ? 0 : 1));
    BOOST_TEST(!at.in_contact);
    BOOST_TEST((at.force.norm() == 0 && at.energy_stored == 0));
    BOOST_TEST(at.energy == run.energy_start, boost::test_tools::tolerance(promised));  // elastic, without friction
    // Where it left the ground it has the height at which it touched.
    const double time = at.time < 0 ? at.time : at.time - n.duration;
    const Vector3 velocity = at.time < 0 ? touch.velocity : n.velocity_after;
    BOOST_TEST(std::fabs(at.state.centre.z() - (0.1 + velocity.z() * time - 9.81 / 2 * time * time)) <= promised);
    BOOST_TEST((at.state.centre.head<2>() - at.time * touch.velocity.head<2>()).norm() <= promised);
    BOOST_TEST((at.state.velocity - velocity - time * Vector3(0, 0, -9.81)).norm() <= promised);
    MotionState expected = at.state;
    expected.attitude = Eigen::AngleAxisd(touch.angular_velocity.norm() * at.time, touch.angular_velocity.normalized());
    BOOST_TEST(std::fabs(std::remainder(angle_between(at.state, expected), 2 * std::numbers::pi)) <= promised);
  }
}

/// δ = (v/ω) sin ωt + (g/ω²)(1 − cos ωt), on a soft ground.
BOOST_AUTO_TEST_CASE(states_in_a_flat_contact_are_those_of_a_spring) {
  const double stiffness = 1e5, speed = 0.3, mass = 2, area = 0.06, g = 9.81;
  const Body body = box_body({0.3, 0.2, 0.1}, mass);
  const World world{.ground = {.stiffness = stiffness, .area = AreaMeasure::projected}, .gravity = g};
  const double frequency = std::sqrt(stiffness * area / mass);
  std::vector<double> times;
  for (int i = 0; i < 40; ++i) times.push_back(i * 0.025 * std::numbers::pi / frequency);
  const Simulation run =
      simulate(body, world, touching_state(body, {.velocity = {0, 0, -speed}}), at_times(times), {.digits = 10});
  for (const StateRecord& at : run.states) {
    const double phase = frequency * at.time;
    const double depth = speed / frequency * std::sin(phase) + g / (frequency * frequency) * (1 - std::cos(phase));
    const double rate = speed * std::cos(phase) + g / frequency * std::sin(phase);
    BOOST_TEST((at.known && at.in_contact && at.impacts == 1));
    BOOST_TEST(std::fabs(0.05 - at.state.centre.z() - depth) <= promised * speed / frequency);
    BOOST_TEST(std::fabs(at.state.velocity.z() + rate) <= promised * speed);
    BOOST_TEST(std::fabs(at.force.z() - stiffness * area * depth) <= promised * stiffness * area * speed / frequency);
    BOOST_TEST(std::fabs(at.energy_stored - stiffness * area * depth * depth / 2) <= promised * run.energy_start);
    BOOST_TEST(std::fabs(at.energy + at.energy_stored - run.energy_start) <= promised * run.energy_start);
  }
}

/// m v dv/dδ = −(k_G + c_G v) A δ has the integral k_G A δ²/(2 m) = G(v₀) − G(v), G(v) = v/s − ln(1 + s v)/s²,
/// s = c_G/k_G.
BOOST_AUTO_TEST_CASE(states_in_a_damped_flat_contact_lie_on_the_oscillators_orbit) {
  const double stiffness = 1e7, speed = 2, mass = 2, area = 0.06, s = 0.3;
  const Body body = box_body({0.3, 0.2, 0.1}, mass);
  const Ground ground{.stiffness = stiffness, .damping = s * stiffness, .area = AreaMeasure::projected};
  std::vector<double> times;
  for (int i = 0; i < 30; ++i) times.push_back(i * 1e-4);
  const Simulation run = simulate(body, weightless(ground), touching_state(body, {.velocity = {0, 0, -speed}}),
                                  at_times(times), {.digits = 10});
  const auto orbit = [&](double v) { return v / s - std::log1p(s * v) / (s * s); };
  int inside = 0;
  for (const StateRecord& at : run.states) {
    if (!at.in_contact) continue;
    ++inside;
    const double depth = 0.05 - at.state.centre.z();
    const double left = stiffness * area * depth * depth / (2 * mass);
    BOOST_TEST(std::fabs(left - orbit(speed) + orbit(-at.state.velocity.z())) <= promised * orbit(speed));
  }
  BOOST_TEST(inside > 15);
}

/// Elastic motion without friction runs back the way it came.
BOOST_AUTO_TEST_CASE(an_elastic_drop_reversed_in_time_returns_to_its_start_within_its_bars) {
  Random random(7);
  for (const Body& body : {phone(), box_body({0.3, 0.2, 0.1}, 2)}) {
    for (int i = 0; i < 6; ++i) {
      const World world{.ground = {.stiffness = random.decades(6, 9), .area = AreaMeasure::projected}};
      const MotionState touch = some_drop(body, random);
      const double fall = random(0.01, 0.1);
      const MotionState start = before_touch(body, touch, world, fall);
      Request request{.impacts = 1, .times = {-fall / 2}};
      // Flight alone: reversed, it is a flight from there up to the start, of a body that is not asked to touch.
      const Simulation flown = simulate(body, world, start, request, {.digits = 10});
      const MotionState back = FreeFlight(body, reversed(flown.states.at(0).state), world.pull()).at(fall / 2);
      const StateErrors missed = distance(reversed(back), start);
      const double speed = touch.velocity.norm();
      BOOST_TEST(size_of(missed, body.radius(), speed) <=
                 2 * size_of(flown.states[0].error, body.radius(), speed) + rounding);
      // Through the contact, to a time shortly behind it.
      const double end = simulate(body, world, start, plain, {.digits = 10}).impacts.at(0).value.duration;
      request.times = {end * random(1.001, 1.01)};
      const Simulation there = simulate(body, world, start, request, {.digits = 10});
      const StateRecord& turning = there.states.at(0);
      if (turning.impacts != 1) continue;
      request.times = {end + fall / 2};
      const Simulation again = simulate(body, world, reversed(turning.state), request, {.digits = 10});
      const StateRecord& home = again.states.at(0);
      if (home.impacts != 1) continue;
      const double time = home.time - again.impacts.at(0).value.duration;
      const StateErrors off = distance(reversed(home.state), before_touch(body, touch, world, time));
      const double bar =
          size_of(home.error, body.radius(), speed) + home.amplification * size_of(turning.error, body.radius(), speed);
      BOOST_TEST(size_of(off, body.radius(), speed) <= bar);
      BOOST_TEST(bar <= 1e-5);
    }
  }
}

BOOST_AUTO_TEST_CASE(states_and_a_limit_of_time_change_no_other_number) {
  const Body body = phone();
  for (const FrictionLaw law : {FrictionLaw::coulomb, FrictionLaw::local}) {
    World world{.ground = with_friction({.stiffness = 1e8, .damping = 1e6}, 0.3)};
    world.ground.friction = law;
    const MotionState start =
        touching_state(body, {.inclination = 0.2, .velocity = {0.5, 0.1, -3}, .out_of_plane_tilt = 0.1});
    const Simulation alone = simulate(body, world, start, {.impacts = 3});
    Request request{.impacts = 3};
    const double end = alone.impacts.at(2).value.start;
    for (int i = 0; i <= 300; ++i) request.times.push_back(end * i / 300);
    const Simulation with = simulate(body, world, start, request);
    BOOST_TEST_REQUIRE(with.impacts.size() == alone.impacts.size());
    BOOST_TEST(with.force_evaluations == alone.force_evaluations);
    BOOST_TEST(with.root_evaluations == alone.root_evaluations);
    BOOST_TEST(with.state_evaluations > 0);
    BOOST_TEST(alone.state_evaluations == 0);
    BOOST_TEST(with.final_state.velocity == alone.final_state.velocity);
    for (std::size_t i = 0; i < alone.impacts.size(); ++i) {
      const ImpactRecord &a = alone.impacts[i], &b = with.impacts[i];
      for (const auto part : {&ImpactRecord::value, &ImpactRecord::error}) {
        BOOST_TEST((a.*part).impulse == (b.*part).impulse);
        BOOST_TEST((a.*part).angular_velocity_after == (b.*part).angular_velocity_after);
        BOOST_TEST((a.*part).work_friction == (b.*part).work_friction);
        BOOST_TEST((a.*part).peak_force == (b.*part).peak_force);
        BOOST_TEST((a.*part).start == (b.*part).start);
      }
      BOOST_TEST(a.amplification == b.amplification);
    }
    request.until = end;
    const Simulation until = simulate(body, world, start, request);
    BOOST_TEST((until.outcome == Outcome::time_limit));
    BOOST_TEST_REQUIRE(until.impacts.size() == 2U);
    BOOST_TEST(until.impacts[1].value.velocity_after == alone.impacts[1].value.velocity_after);
    BOOST_TEST(until.states.back().known);
    BOOST_TEST(until.states.back().in_contact);  // the instant of a touch-down is of the contact
    BOOST_TEST(until.states.back().impacts == 3);
    BOOST_TEST(until.message.find("not listed") != std::string::npos);
  }
}

BOOST_AUTO_TEST_CASE(with_times_all_impacts_until_the_last_of_them_are_listed) {
  const Body body = phone();
  const World world{.ground = {.stiffness = 1e8, .damping = 1e7}};
  const MotionState start = touching_state(body, {.inclination = 10 * degree, .velocity = {0, 0, -4}});
  const Simulation six = simulate(body, world, start, plain_impacts(6));
  const ImpactNumbers& last = six.impacts.at(5).value;
  const Simulation run = simulate(body, world, start, at_times({last.start + last.duration / 2}, 2));
  BOOST_TEST(run.impacts.size() == 6U);
  BOOST_TEST((run.outcome == Outcome::impact_limit));
  BOOST_TEST((run.states.at(0).in_contact && run.states[0].impacts == 6));
  const double end = last.start + last.duration;
  const Simulation at_end = simulate(body, world, start, at_times({end}, 2));
  BOOST_TEST(!at_end.states.at(0).in_contact);  // the instant of a lift-off is of the flight
  BOOST_TEST((at_end.states[0].state.velocity - last.velocity_after).norm() <= rounding);
}

/// Beyond what the run knows a state is said not to be known, with no number.
BOOST_AUTO_TEST_CASE(a_state_after_a_run_that_has_stopped_short_is_not_known) {
  const Body body = phone();
  const World world{.ground = {.stiffness = 1e8}};
  const MotionState start = touching_state(body, {.inclination = 10 * degree, .velocity = {0, 0, -4}});
  const Simulation run = simulate(body, world, start, at_times({0, 1e-5, 0.5}), {.evaluation_limit = 300});
  BOOST_TEST((run.outcome == Outcome::evaluation_limit));
  BOOST_TEST((run.states.at(0).known && run.states.at(1).known && !run.states.at(2).known));
  BOOST_TEST(std::isnan(run.states[2].state.centre.z()));
  BOOST_TEST(std::isnan(run.states[2].energy));
  BOOST_TEST(std::isnan(run.states[2].error.position));
}

BOOST_AUTO_TEST_CASE(a_body_at_rest_stays_and_one_that_slides_without_friction_slides_on) {
  const Body body = box_body({0.3, 0.2, 0.1}, 1);
  const Ground ground{.stiffness = 1e6, .damping = 1e7, .area = AreaMeasure::projected};
  const MotionState start = touching_state(body, {.velocity = {0, 0.7, -0.5}});
  const Simulation slides = simulate(body, {.ground = ground}, start, at_times({1000}, 100));
  const StateRecord& far = slides.states.at(0);
  BOOST_TEST((slides.outcome == Outcome::sustained_contact));
  BOOST_TEST((far.known && far.in_contact));
  BOOST_TEST(far.state.centre.y() == 700, boost::test_tools::tolerance(promised));
  BOOST_TEST(far.force.z() == 9.81, boost::test_tools::tolerance(promised));
  const Simulation rests = simulate(body, {.ground = ground}, touching_state(body, {}), at_times({1e9}, 100));
  const StateRecord& there = rests.states.at(0);
  BOOST_TEST((rests.outcome == Outcome::at_rest));
  BOOST_TEST(there.state.velocity.norm() == 0);
  // It counts as lying still once a millionth of the motion of its fall is left.
  BOOST_TEST(0.05 - there.state.centre.z() == 9.81 / (1e6 * 0.06), boost::test_tools::tolerance(1e-5));
}

/// Six digits against ten, with friction and damping, in flight, in contacts and where the runs part.
BOOST_AUTO_TEST_CASE(bars_of_states_cover_95_of_100_errors) {
  Random random(21);
  const Body bodies[] = {phone(), box_body({0.1, 0.08, 0.06}, 0.5)};
  int numbers = 0, held = 0, states = 0, inside = 0;
  std::vector<double> ratios;
  const int drops = CLATTER_TEST_SLOW_BUILD ? 10 : 100;
  for (int i = 0; i < drops; ++i) {
    const Body& body = bodies[i % 2];
    World world{.ground = {.stiffness = random.decades(7, 10), .damping = random.decades(5, 7)}};
    world.ground = with_friction(world.ground, random(0.05, 0.8));
    const MotionState start = some_drop(body, random);
    const Simulation first = simulate(body, world, start, plain_impacts(2), {.digits = 4});
    Request request{.impacts = 1, .local_slip_with_errors = false};
    const ImpactNumbers& last = first.impacts.back().value;
    for (int j = 0; j < 3; ++j) {
      // Every other time lies in a contact.
      const ImpactNumbers& one = first.impacts[random.below(first.impacts.size())].value;
      const bool in_contact = random.one_in(2);
      request.times.push_back(in_contact ? one.start + random(0, 1) * one.duration
                                         : random(0, 1) * (last.start + last.duration));
    }
    std::ranges::sort(request.times);
    const Simulation run = simulate(body, world, start, request, {.digits = 6});
    const Simulation truth = simulate(body, world, start, at_times(request.times), {.digits = 10});
    for (std::size_t j = 0; j < 3; ++j) {
      const StateRecord &at = run.states.at(j), &exact = truth.states.at(j);
      if (!at.known || !exact.known || !std::isfinite(at.error.position)) continue;
      ++states;
      if (at.in_contact) ++inside;
      StateErrors off = distance(at.state, exact.state);
      off.energy = std::fabs(at.energy - exact.energy);
      for (const auto number : {&StateErrors::position, &StateErrors::angle, &StateErrors::velocity,
                                &StateErrors::angular_velocity, &StateErrors::energy}) {
        ++numbers;
        if (std::fabs(off.*number) <= at.error.*number) ++held;
        if (off.*number != 0) ratios.push_back(at.error.*number / std::fabs(off.*number));
      }
    }
  }
  BOOST_TEST(states > 2 * drops);
  BOOST_TEST(inside > drops / 2);
  BOOST_TEST(held >= 0.95 * numbers, held << " of " << numbers << " numbers within their bars");
  std::ranges::sort(ratios);
  BOOST_TEST(ratios[ratios.size() / 2] <= 20, "median of bar over error " << ratios[ratios.size() / 2]);
}

BOOST_AUTO_TEST_CASE(times_that_cannot_be_are_refused) {
  const Body body = phone();
  const World world{.ground = {.stiffness = 1e8}};
  const MotionState start = touching_state(body, {.inclination = 0.2, .velocity = {0, 0, -1}});
  for (const std::vector<double>& times : {std::vector<double>{2, 1}, {not_a_number}, {-0.1, 0.2}})
    CHECK_REFUSED_SAYING(simulate(body, world, start, at_times(times)), std::domain_error, "run.times");
  Request request = at_times({2});
  request.until = 1;
  CHECK_REFUSED_SAYING(simulate(body, world, start, request), std::domain_error, "run.times");
  request.until = -1;
  CHECK_REFUSED_SAYING(simulate(body, world, start, request), std::domain_error, "run.until");
}
