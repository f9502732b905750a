// SPDX-License-Identifier: GPL-3.0-or-later
// Contacts with closed forms: flat and upright landings, and what no landing may lose.
#include "tests/numeric/bodies.hpp"
#include "tests/numeric/support.hpp"
#include "validation/oracles/digits.hpp"
#include "validation/oracles/impulse_path.hpp"

namespace {

using namespace clatter::numeric;
using namespace clatter::numeric::test;

constexpr double promised = 1e-9;

/// A spring k_G A under the mass m: half a sine.
void check_half_sine(const Simulation& run, double mass, double area, double stiffness, double speed) {
  const ImpactNumbers& n = run.impacts.at(0).value;
  const double frequency = std::sqrt(stiffness * area / mass);
  BOOST_TEST(n.duration == std::numbers::pi / frequency, boost::test_tools::tolerance(promised));
  BOOST_TEST(n.peak_force == speed * std::sqrt(stiffness * area * mass), boost::test_tools::tolerance(promised));
  BOOST_TEST(n.peak_time == n.duration / 2, boost::test_tools::tolerance(1e-5));  // flat top: √ of the force's digits
  BOOST_TEST(n.impulse.z() == 2 * mass * speed, boost::test_tools::tolerance(promised));
  BOOST_TEST(n.restitution == 1, boost::test_tools::tolerance(promised));
  BOOST_TEST(run.impacts.at(0).touches == 1);
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_flat_landing_is_half_a_sine) {
  const double stiffness = 1e8, speed = 3;
  const Ground ground{.stiffness = stiffness, .area = AreaMeasure::projected};
  const Simulation run = dropped(box_body({0.3, 0.2, 0.1}, 2), weightless(ground), 0, speed);
  check_half_sine(run, 2, 0.06, stiffness, speed);
  BOOST_TEST((run.impacts.at(0).end == ContactEnd::both));
}

/// With gravity δ = (v/ω) sin ωt + (g/ω²)(1 − cos ωt) until t = (2/ω)(π − atan(vω/g)); P = 2mv + mgt; the largest force
/// is mg + √((mg)² + m k_G A v²).  A soft ground, so that gravity matters.
BOOST_AUTO_TEST_CASE(a_flat_landing_under_gravity_has_its_closed_form) {
  const double stiffness = 1e5, speed = 0.3, mass = 2, area = 0.06, g = 9.81;
  const World world{.ground = {.stiffness = stiffness, .area = AreaMeasure::projected}, .gravity = g};
  const Simulation run = dropped(box_body({0.3, 0.2, 0.1}, mass), world, 0, speed);
  const ImpactNumbers& n = run.impacts.at(0).value;
  const double frequency = std::sqrt(stiffness * area / mass);
  const double duration = 2 / frequency * (std::numbers::pi - std::atan(speed * frequency / g));
  BOOST_TEST(n.duration == duration, boost::test_tools::tolerance(promised));
  BOOST_TEST(n.impulse.z() == 2 * mass * speed + mass * g * duration, boost::test_tools::tolerance(promised));
  BOOST_TEST(n.peak_force == mass * g + std::sqrt(mass * g * mass * g + mass * stiffness * area * speed * speed),
             boost::test_tools::tolerance(promised));
  BOOST_TEST(std::fabs(n.energy_loss) <= promised * run.energy_start);
}

BOOST_AUTO_TEST_CASE(an_upright_landing_is_half_a_sine) {
  const double stiffness = 1e10, r = 0.01;
  const Ground ground{.stiffness = stiffness, .area = AreaMeasure::projected};
  const Simulation run = dropped(rod(), weightless(ground), 90 * degree, 1);
  check_half_sine(run, 1, 8 * r * r * std::sin(std::numbers::pi / 8), stiffness, 1);
  BOOST_TEST((run.impacts.at(0).end == ContactEnd::a));
}

/// Ω > 0 is clockwise: it lifts the rim of end a, which lies L/2 cos α − R sin α to the left of the centre.
BOOST_AUTO_TEST_CASE(a_clockwise_spin_lifts_the_lower_end) {
  const double angle = 45 * degree, spin = 0.8;
  const Body body = rod();
  const MotionState start = touching_state(body, {.inclination = angle, .velocity = {0, 0, -1}, .spin = spin});
  const Simulation run = simulate(body, weightless({.stiffness = 1e11}), start, plain);
  const double lift = spin * (0.5 * std::cos(angle) - 0.01 * std::sin(angle));
  BOOST_TEST(run.impacts.at(0).value.approach_speed == 1 - lift, boost::test_tools::tolerance(1e-13));  // rounding
}

BOOST_AUTO_TEST_CASE(a_damped_flat_landing_has_the_restitution_of_the_exact_map) {
  using Exact = clatter::oracle::Decimal<50>;
  const double stiffness = 1e8, speed = 2;
  for (const double s : {1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 0.1, 0.3, 1.0, 3.0, 10.0}) {
    const Ground ground{.stiffness = stiffness, .damping = s * stiffness / speed, .area = AreaMeasure::projected};
    const Simulation run = dropped(box_body({0.3, 0.2, 0.1}, 2), weightless(ground), 0, speed);
    const double exact = static_cast<double>(clatter::oracle::exact_restitution(Exact(s)));
    BOOST_TEST(run.impacts.at(0).value.restitution == exact, boost::test_tools::tolerance(promised));
  }
}

/// The force never grows beyond what it is for the whole face: no corner may be ahead of the others.
BOOST_AUTO_TEST_CASE(a_flat_drop_of_any_mesh_starts_no_spin) {
  for (const bool merge : {true, false}) {
    for (const Body& body : {phone(1, 1, 1, merge), phone(7, 5, 3, merge), Body(rod_mesh({.sectors = 12}), merge)}) {
      const Simulation run = dropped(body, weightless({.stiffness = 1e8, .damping = 1e6}), 0, 4);
      BOOST_TEST(run.impacts.at(0).value.angular_velocity_after.norm() <= 1e-12 * 4 / body.radius());
    }
  }
}

BOOST_AUTO_TEST_CASE(elastic_frictionless_impacts_lose_no_energy) {
  struct Case {
    Body body;
    double angle, tilt, stiffness;
  };
  const Case cases[] = {{rod(), 45, 0, 1e11},
                        {rod(), 10, 0, 1e9},
                        {rod(), 0, 0, 1e9},
                        {phone(), 10, 0, 1e8},
                        {phone(), 30, 20, 1e8},
                        {phone(), 3, 0, 1e7},
                        {phone(5, 4, 3, false), 60, 1, 1e10}};
  for (const auto& [digits, bound] : {std::pair{6, 1e-9}, {12, 1e-12}}) {
    for (const AreaMeasure area : {AreaMeasure::surface, AreaMeasure::projected}) {
      for (const Case& c : cases) {
        const MotionState start = touching_state(c.body, {.inclination = c.angle * degree,
                                                          .velocity = {0.3, 0, -1},
                                                          .spin = 0.5,
                                                          .out_of_plane_tilt = c.tilt * degree});
        const Simulation run =
            simulate(c.body, weightless({.stiffness = c.stiffness, .area = area}), start, plain, {.digits = digits});
        BOOST_TEST(std::fabs(run.impacts.at(0).value.energy_loss) <= bound * run.energy_start);
      }
    }
  }
}

/// A vertical load has no moment about the vertical and no part along the ground, however the body spins.
BOOST_AUTO_TEST_CASE(a_frictionless_contact_keeps_the_vertical_angular_momentum) {
  for (const Body& body : {phone(), box_body({0.3, 0.2, 0.05}, 1)}) {
    MotionState start =
        touching_state(body, {.inclination = 0.5, .velocity = {0.4, -0.2, -3}, .out_of_plane_tilt = 0.3});
    start.angular_velocity = Vector3(20, -30, 40);
    const Simulation run = simulate(body, weightless({.stiffness = 1e8, .damping = 1e6}), start, plain);
    const auto vertical = [&](const MotionState& state) {
      return (state.attitude * (body.inertia() * state.angular_velocity)).z();
    };
    BOOST_TEST(vertical(run.final_state) == vertical(start), boost::test_tools::tolerance(promised));
    BOOST_TEST(run.final_state.velocity.x() == 0.4, boost::test_tools::tolerance(promised));
    BOOST_TEST(run.final_state.velocity.y() == -0.2, boost::test_tools::tolerance(promised));
  }
}

/// What was there before = what is left + dampers + friction + released by the clamp.
BOOST_AUTO_TEST_CASE(the_ledger_of_energy_closes) {
  double released = 0;
  for (const FrictionLaw law : {FrictionLaw::coulomb, FrictionLaw::regularised}) {
    for (const AreaMeasure area : {AreaMeasure::surface, AreaMeasure::projected}) {
      for (const auto& [damping, friction] : {std::pair{0.0, 0.9}, {1e6, 0.0}, {1e7, 0.1}, {1e8, 0.9}}) {
        const Body body = phone();
        const Ground ground{.stiffness = 1e8,
                            .damping = damping,
                            .static_friction = 1.2 * friction,
                            .sliding_friction = friction,
                            .area = area,
                            .friction = law};
        const MotionState start = touching_state(
            body, {.inclination = 0.3, .velocity = {0.5, 0.1, -3}, .spin = -20, .out_of_plane_tilt = 0.1});
        const Simulation run =
            simulate(body, {.ground = ground}, start, plain_impacts(CLATTER_TEST_SLOW_BUILD ? 1 : 3));
        BOOST_REQUIRE(!run.impacts.empty());
        for (const ImpactRecord& row : run.impacts) {
          BOOST_TEST(std::fabs(row.ledger_gap) <= promised);
          BOOST_TEST((row.value.work_damping >= 0 && row.value.work_released >= 0));
          released += row.value.work_released;
        }
      }
    }
  }
  BOOST_TEST(released > 0);  // the clamp was at work somewhere
}
