// SPDX-License-Identifier: GPL-3.0-or-later
// Contacts with friction end in numbers: lift-off from stick, bodies that sink, sizes at the ends of the range.
#include "numeric/stepping/friction_phases.hpp"
#include "tests/numeric/bodies.hpp"
#include "tests/numeric/support.hpp"

namespace {

using namespace clatter::numeric;
using namespace clatter::numeric::test;

/// Whether all that a history was given is a number.
struct Finite {
  long rows = 0;
  bool all = true;
  void operator()(const HistorySample& s) {
    ++rows;
    all = all && std::isfinite(s.time) && std::isfinite(s.energy_total()) && s.state.centre.allFinite() &&
          s.state.velocity.allFinite() && s.state.attitude.coeffs().allFinite() &&
          s.state.angular_velocity.allFinite() && s.force.allFinite() && s.point_velocity.allFinite();
  }
};

constexpr Method methods[] = {Method::automatic, Method::tvd_rk3, Method::rk4,
                              Method::rkf45,     Method::rkck,    Method::rk8pd};

/// A box or rod that a hand could throw, by its number.
struct Scene {
  explicit Scene(unsigned number) {
    Random random(number);
    const auto over = [&](double low, double high) { return std::exp(random(std::log(low), std::log(high))); };
    const double mass = over(0.02, 5), length = over(0.05, 0.5), thickness = over(0.01, 0.2);
    const bool is_rod = random.one_in(3);
    body = is_rod ? Body(rod_mesh({.length = 2 * length, .radius = thickness / 4, .mass = mass}))
                  : box_body({length, over(0.02, 0.3), thickness}, mass);
    const double angles[] = {0, 90, over(1e-3, 5), random(0, 90)}, tilts[] = {0, 90, random(0, 90)};
    world.planar = random.one_in(2);
    const double speed = over(0.3, 5);
    start = touching_state(body, {.inclination = angles[random.below(4)] * degree,
                                  .velocity = {random.one_in(2) ? 0 : random(-2, 2), 0, -speed},
                                  .spin = random.one_in(2) ? 0 : random(-5, 5),
                                  .out_of_plane_tilt = world.planar ? 0 : tilts[random.below(3)] * degree});
    Ground& ground = world.ground;
    ground.stiffness = over(1e7, 1e11);
    ground.damping = random.one_in(2) ? 0 : over(0.003, 0.3) * ground.stiffness / speed;
    ground.sliding_friction = random.one_in(8) ? 0 : random(0, 2);
    ground.static_friction = random.one_in(2) ? ground.sliding_friction : random(ground.sliding_friction, 2);
    ground.area = random.one_in(2) ? AreaMeasure::surface : AreaMeasure::projected;
    // Over the many facets on which a rod lies the regularised law, which is stiff, takes a minute.
    if (random.one_in(8) && !is_rod) ground.friction = FrictionLaw::regularised;
    accuracy.method = methods[random.below(6)];
    accuracy.digits = 4 + static_cast<int>(random.below(2));
    request.impacts = 1 + static_cast<int>(random.below(3));
    world.gravity = random.one_in(2) ? 0 : 9.81;
  }

  Body body = phone();
  World world;
  Request request;
  Accuracy accuracy;
  MotionState start;
};

/// Nothing slips and nothing tips: P = 2 m v and no more.  The pressure centre's way was once divided by the force that
/// fades.
BOOST_AUTO_TEST_CASE(a_flat_or_upright_landing_with_friction_is_the_plain_rebound) {
  int number = 0;
  for (const Body& body : {rod(), phone()}) {
    for (const double angle : {0.0, 90.0}) {
      for (const Method method : methods) {
        const bool planar = ++number % 2 == 0;
        const double mu = number % 4 < 2 ? 0.3 : 1;
        Finite history;
        const Simulation run = dropped(body, weightless(with_friction({.stiffness = 1e9}, mu), planar), angle * degree,
                                       2, {.method = method}, {.history = std::ref(history)});
        BOOST_TEST_CONTEXT("angle " << angle << " mu " << mu << " method " << static_cast<int>(method)) {
          const ImpactNumbers& n = run.impacts.at(0).value;
          BOOST_TEST(n.impulse.z() == 4 * body.mass(), boost::test_tools::tolerance(1e-6));
          BOOST_TEST(std::hypot(n.impulse.x(), n.impulse.y()) <= 1e-9 * body.mass());
          BOOST_TEST(body.radius() * n.angular_velocity_after.norm() <= 1e-9);
          BOOST_TEST(n.restitution == 1, boost::test_tools::tolerance(1e-6));
          BOOST_TEST(history.all);
        }
      }
    }
  }
}

/// Coulomb's bound in every row down to the last; and stick that has come to it slides from there on, with less
/// friction.
BOOST_AUTO_TEST_CASE(sticking_never_takes_more_than_the_static_friction_gives_and_then_gives_way) {
  struct Bound {
    double mu = 0, peak = 0;
    long beyond = 0, held_at_the_bound = 0;
    void operator()(const HistorySample& s) {
      const double tangential = std::hypot(s.force.x(), s.force.y()), bound = mu * s.force.z();
      peak = std::max(peak, s.force.z());
      beyond += tangential > bound * (1 + 1e-12);
      held_at_the_bound += s.force.z() > 1e-6 * peak && tangential > bound * (1 - 1e-9);
    }
  };
  for (const double mu : {0.1, 0.3, 0.59, 0.62, 1.0}) {
    for (const double angle : {5.0, 20.0, 45.0, 60.0, 75.0, 80.0}) {
      for (const Body& body : {rod(), phone()}) {
        Bound bound;
        bound.mu = mu;
        const Ground ground{.stiffness = 1e9, .static_friction = mu, .sliding_friction = mu / 2};
        static_cast<void>(dropped(body, weightless(ground), angle * degree, 1, {}, {.history = std::ref(bound)}));
        BOOST_TEST(bound.beyond == 0);
        BOOST_TEST(bound.held_at_the_bound == 0);
      }
    }
  }
}

/// A flat face that turns and has hardly any depth: its pressure centre runs away as δ falls, so that holding it asks
/// for more than any friction gives.
BOOST_AUTO_TEST_CASE(stick_under_a_fading_force_is_bounded_and_knows_that_it_cannot_hold) {
  const double mu = 0.7;
  const Body body = box_body({0.3, 0.2, 0.1}, 1);
  const Ground ground = with_friction({.stiffness = 1e9}, mu);
  for (const bool planar : {true, false}) {
    ContactSystem system(body, ground, 0, planar);
    system.begin(touching_state(body, {}));
    system.set_phase({.kind = FrictionPhase::Kind::stick, .direction = {}});
    for (const double depth : {1e-8, 1e-12, 1e-16, 1e-24, 1e-60}) {
      ContactState state = system.initial(), rate;
      displacement(state).z() = -depth;
      angular_velocity(state).y() = 1;
      const ContactDiagnosis at = system.diagnose(state, rate);
      BOOST_TEST(at.load.force > 0);
      BOOST_TEST(at.friction.norm() <= mu * at.load.force * (1 + 1e-12));
      if (depth <= 1e-16) BOOST_TEST(at.hold.norm() == 2 * mu * at.load.force, boost::test_tools::tolerance(1e-12));
      BOOST_TEST(rate.allFinite());
    }
  }
}

/// Stick that gives way in the last of few large steps gives way all the same: as in a run of many small ones, to some
/// tens of times the tolerance of 1e-8.
BOOST_AUTO_TEST_CASE(a_late_release_does_not_depend_on_the_steps) {
  struct Case {
    Body body;
    double angle, slip, mu;
  };
  for (const Case& c : {Case{rod(), 60, 0, 0.6}, {phone(), 75, 0, 0.4}, {phone(), 75, 0.3, 0.7}}) {
    const Ground ground{.stiffness = 1e9, .static_friction = c.mu, .sliding_friction = 0};
    const auto impulse = [&](Method method, int digits) {
      const Accuracy accuracy{.method = method, .digits = digits};
      const MotionState start = touching_state(c.body, {.inclination = c.angle * degree, .velocity = {c.slip, 0, -1}});
      return Vector3(simulate(c.body, weightless(ground, true), start, plain, accuracy).impacts.at(0).value.impulse);
    };
    const Vector3 fine = impulse(Method::rk8pd, 10);
    for (const Method method : {Method::rkf45, Method::rkck, Method::rk8pd})
      BOOST_TEST((impulse(method, 4) - fine).norm() <= 5e-7 * fine.norm());
  }
}

/// Deep in the bed the faces that look up were once driven along their slip.
BOOST_AUTO_TEST_CASE(friction_over_faces_that_look_up_from_below_the_ground_never_drives) {
  for (const FrictionLaw law : {FrictionLaw::regularised, FrictionLaw::coulomb}) {
    for (const double stiffness : {1e5, 3e5, 1e7}) {
      if (CLATTER_TEST_SLOW_BUILD && stiffness > 1e5) continue;
      const double tilt = stiffness == 3e5 ? 0 : 20 * degree;
      const Body body = box_body({0.2, 0.1, 0.02}, 0.5);
      const MotionState start = touching_state(
          body, {.inclination = 30 * degree, .velocity = {1, 0, -3}, .spin = -8, .out_of_plane_tilt = tilt});
      const Ground ground = with_friction(
          {.stiffness = stiffness, .damping = stiffness / 100, .area = AreaMeasure::projected, .friction = law}, 1);
      const Simulation run = simulate(body, {.ground = ground}, start, plain_impacts(3));
      BOOST_TEST_CONTEXT("law " << static_cast<int>(law) << " k " << stiffness << ": " << run.message) {
        BOOST_TEST(!run.impacts.empty());
        for (const ImpactRecord& row : run.impacts) {
          BOOST_TEST(row.value.work_friction >= -1e-9 * run.energy_start);
          BOOST_TEST(row.value.energy_loss >= -1e-6 * run.energy_start);
        }
      }
    }
  }
}

/// F = k_G A δ while a flat plate of thickness T sinks: it goes under if m v² > k_G A T².
BOOST_AUTO_TEST_CASE(a_body_that_sinks_wholly_is_flagged_and_no_other) {
  const double mass = 0.5, thickness = 0.02, area = 0.2 * 0.1, stiffness = 1e5;
  const Body body = box_body({0.2, 0.1, thickness}, mass);
  const double speed = thickness * std::sqrt(stiffness * area / mass);
  for (const double part : {0.5, 0.98, 1.02, 3.0}) {
    const Simulation run =
        dropped(body, weightless({.stiffness = stiffness, .area = AreaMeasure::projected}), 0, part * speed);
    BOOST_TEST(run.impacts.at(0).submerged == (part > 1));
  }
}

/// A table of two feet, and a plate with a hole through its middle.
BOOST_AUTO_TEST_CASE(two_feet_that_land_at_once_are_two_touches_and_a_face_is_one) {
  const Body table(without(box_mesh({.size = {0.3, 0.1, 0.1}, .mass = 1, .nx = 3, .ny = 1, .nz = 2}),
                           [](const Vector3& at) { return std::fabs(at.x()) < 0.05 && at.z() < 0; }));
  const Body frame(without(box_mesh({.size = {0.3, 0.3, 0.05}, .mass = 1, .nx = 3, .ny = 3, .nz = 1}),
                           [](const Vector3& at) { return std::hypot(at.x(), at.y()) < 0.05; }));
  const std::pair<Body, int> landings[] = {
      {table, 2}, {frame, 1}, {phone(), 1}, {phone(3, 2, 1, false), 1}, {rod(), 1}};
  for (const auto& [body, touches] : landings)
    BOOST_TEST(dropped(body, weightless({.stiffness = 1e9}), 0, 1).impacts.at(0).touches == touches);
}

BOOST_AUTO_TEST_CASE(an_impact_has_the_name_of_its_phases_of_friction) {
  // Each part is slip one way or the other, an instant of slip, or stick.
  const auto name = [](const std::string& parts) {
    FrictionLog log;
    log.begin({.depth = 1, .speed = 1, .time = 1, .energy = 1}, 1);
    FrictionLog::Sums sums;
    for (const char part : parts) {
      log.open(sums);
      sums.time += 0.1;
      sums.work += part == 's' ? 0 : part == 'i' ? 1e-9 : 0.1;
      if (part == 's') log.close({.kind = FrictionPhase::Kind::stick, .direction = {0, 0}}, sums);
      else log.close({.kind = FrictionPhase::Kind::slip, .direction = {part == '<' ? -1. : 1., 0}}, sums);
    }
    return log.mode();
  };
  const std::pair<const char*, FrictionMode> modes[] = {{">", FrictionMode::slip},
                                                        {"si", FrictionMode::stick},
                                                        {">s", FrictionMode::slip_stick},
                                                        {"s>", FrictionMode::stick_slip},
                                                        {"><", FrictionMode::reverse_slip},
                                                        {">s>", FrictionMode::slip_stick_slip},
                                                        {">s<", FrictionMode::slip_stick_slip},
                                                        {"s>s", FrictionMode::stick_slip_stick},
                                                        {">s>s", FrictionMode::alternating},
                                                        {">sis", FrictionMode::slip_stick}};
  for (const auto& [parts, mode] : modes) BOOST_TEST((name(parts) == mode), parts);
}

/// A bounce 5·10¹⁰ m high: over the ground its lowest vertices are told apart to 10⁻⁵ m.
BOOST_AUTO_TEST_CASE(the_history_of_a_high_flight_holds_numbers) {
  for (const double speed : {1e4, 1e6, 1e8}) {
    Finite history;
    const Body body = phone();
    const MotionState start = touching_state(body, {.inclination = 30 * degree, .velocity = {0, 0, -speed}});
    const World world{.ground = {.stiffness = 1e8 * speed * speed}};
    static_cast<void>(simulate(body, world, start, plain_impacts(2), {}, {.history = std::ref(history)}));
    BOOST_TEST(history.rows > 20);
    BOOST_TEST(history.all);
  }
}

/// k_G ∝ m v²/L⁴ keeps the motion similar; the determinant of the inertia, ∝ L⁶, once overflowed from 10⁵² m on.
BOOST_AUTO_TEST_CASE(a_body_of_any_size_moves_like_one_of_a_metre) {
  const auto turning = [](double size) {
    const Ground ground{.stiffness = 1e6 / (size * size) / (size * size)};
    const Body body = box_body(size * Vector3(1, 0.4, 0.2), 1);
    const MotionState start = touching_state(body, {.inclination = 10 * degree, .out_of_plane_tilt = 17 * degree});
    const Simulation run = simulate(body, weightless(ground), start, plain, {.digits = 9});
    BOOST_TEST(std::fabs(run.impacts.at(0).value.energy_loss) <= 1e-9 * run.energy_start);
    return Vector3(size * run.impacts.at(0).value.angular_velocity_after);
  };
  const Vector3 one = turning(1);
  for (const double size : {1e-60, 1e-30, 1e30, 1e50, 1e52, 1e53, 1e60, 1e70})
    BOOST_TEST((turning(size) - one).norm() <= 1e-8 * one.norm());
}

/// What a contact costs at a loose tolerance is the search for its events: bisecting them would take twice as many.
BOOST_AUTO_TEST_CASE(few_evaluations_find_where_a_damped_contact_ends) {
  const Body body = phone();
  const World world{.ground = with_friction({.stiffness = 1e8, .damping = 1e7}, 0.075)};
  for (const double angle : {10, 25, 40, 55, 70}) {
    const MotionState start = touching_state(body, {.inclination = angle * degree, .velocity = {0, 0, -4.4}});
    const Simulation run = simulate(body, world, start, plain_impacts(6), {.method = Method::rkck, .tolerance = 1e-4});
    BOOST_REQUIRE(run.impacts.size() == 6);
    BOOST_TEST(run.force_evaluations < 6 * 230, angle << " deg: " << run.force_evaluations / 6 << " for an impact");
  }
}

BOOST_AUTO_TEST_CASE(random_scenes_with_friction_end_in_numbers) {
  const unsigned count = CLATTER_TEST_SLOW_BUILD ? 8 : 40;
  for (unsigned number = 1; number <= count; ++number) {
    Scene scene(number);
    Finite history;
    const Simulation run =
        simulate(scene.body, scene.world, scene.start, scene.request, scene.accuracy, {.history = std::ref(history)});
    BOOST_TEST_CONTEXT("scene " << number << ": " << run.message) {
      BOOST_TEST((run.outcome == Outcome::no_further_impact || run.outcome == Outcome::impact_limit ||
                  run.outcome == Outcome::at_rest || run.outcome == Outcome::sustained_contact));
      BOOST_TEST(!run.impacts.empty());
      BOOST_TEST(history.all);
      for (const ImpactRecord& row : run.impacts) {
        BOOST_TEST(is_number(row));
        BOOST_TEST(row.value.work_friction >= -1e-9 * run.energy_start);
      }
    }
  }
}

}  // namespace
