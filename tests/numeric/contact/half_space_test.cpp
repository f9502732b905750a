// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/contact/half_space.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>

#include "numeric/contact/contact_system.hpp"
#include "tests/numeric/bodies.hpp"
#include "tests/numeric/support.hpp"

namespace {

using namespace clatter::numeric;
using namespace clatter::numeric::test;

constexpr double pi = std::numbers::pi;
constexpr double relative = 1e-12;

/// An upright cone on its tip, of a slope of its side.
Body cone(double slope, int sectors) {
  Mesh mesh;
  mesh.nodes = {{0, 0, 0}, {0, 0, slope}};
  for (int i = 0; i < sectors; ++i) {
    const double angle = 2 * pi * i / sectors;
    mesh.nodes.push_back({std::cos(angle), std::sin(angle), slope});
  }
  for (int i = 0; i < sectors; ++i) {
    mesh.elements.push_back({ElementShape::tetrahedron, {0, 2 + i, 2 + (i + 1) % sectors, 1, -1, -1, -1, -1}, 1});
  }
  return Body(mesh);
}

Ground half_space(double modulus, double dissipation = 0) {
  return {.modulus = modulus, .dissipation = dissipation, .area = AreaMeasure::projected};
}

ContactLoad load_of(const Body& body, const Ground& ground, const GroundView& view) {
  return contact_on(body, ground)->load(view);
}

double force_at(const Body& body, const Vector3& normal, double depth) {
  return load_of(body, half_space(1), pressed(body, normal, depth)).force;
}

/// Power of the load on the body's motion, against the motion [W].
double power_of(const ContactLoad& load, const GroundView& view) {
  const Vector3 slope = view.normal().cross(view.angular_velocity);
  return -(view.vertical_speed * load.force + slope.dot(load.first_moment));
}

/// The view a time later in a motion of constant velocities.
GroundView later(GroundView view, double time) {
  const Vector3 n = view.normal(), w = view.angular_velocity;
  const double angle = w.norm() * time;
  if (angle != 0) view.turn += Eigen::AngleAxisd(-angle, w.normalized()) * n - n;
  view.sink += time * view.vertical_speed;
  return view;
}

Body plate_on_foot() {
  Mesh peg = box_mesh({.size = {0.3, 0.3, 0.02}, .mass = 1, .nx = 5, .ny = 5, .nz = 2});
  std::vector<Element> elements;
  for (const Element& element : peg.elements) {
    Vector3 middle = Vector3::Zero();
    for (const int node : element.nodes) middle += peg.nodes[node] / 8;
    if (middle.z() > 0 || middle.head<2>().norm() < 0.01) elements.push_back(element);
  }
  peg.elements = elements;
  return Body(peg);
}

/// Bodies of all kinds that a ground sees, not convex ones among them.
std::vector<Body> bodies() {
  std::vector<Body> all;
  all.push_back(box_body({0.3, 0.2, 0.1}, 1));
  all.push_back(Body(rod_mesh({.length = 0.3, .radius = 0.05, .mass = 1, .sectors = 24, .rings = 2, .layers = 2})));
  Mesh corner = box_mesh({.size = {0.2, 0.2, 0.2}, .mass = 1, .nx = 2, .ny = 2, .nz = 2});
  corner.elements.pop_back();  // a cube without one of its eighths
  all.push_back(Body(corner));
  all.push_back(plate_on_foot());
  all.push_back(round_body({.semiaxes = Vector3::Constant(0.1)}));
  all.push_back(round_body({.semiaxes = {0.1, 0.07, 0.12}}));
  all.push_back(round_body({.semiaxes = Vector3::Constant(0.05), .straight = 0.2}));
  return all;
}

}  // namespace

/// F = 2 E* a δ, a the radius of a circle of the same area; its sides have no part.
BOOST_AUTO_TEST_CASE(a_flat_round_end_presses_as_boussinesq_says) {
  for (const int sectors : {12, 40}) {
    const double radius = 0.03, area = sectors * radius * radius / 2 * std::sin(2 * pi / sectors);
    const Body rod = Body(rod_mesh({.length = 0.2, .radius = radius, .mass = 1, .sectors = sectors, .layers = 1}));
    const ContactLoad load = load_of(rod, half_space(3e9), pressed(rod, Vector3::UnitX(), 1e-5));
    const double force = 2 * 3e9 * std::sqrt(area / pi) * 1e-5;
    BOOST_TEST(load.force == force, boost::test_tools::tolerance(1e-11));
    BOOST_TEST(load.energy == force * 1e-5 / 2, boost::test_tools::tolerance(1e-11));
    BOOST_TEST((load.first_moment / load.force - Vector3(-0.1, 0, 0)).norm() <= 1e-5 + 1e-12);
  }
}

/// A flat end's force is to its displacement as the charge of a conducting plate of its shape to the voltage: of a
/// square 0.36678746 of 4πε times its side, of a circle 8ε times its radius.  Of rectangles by boundary elements:
/// pressures constant on squares, 400 of them along the side, the error of their edges extrapolated.
BOOST_AUTO_TEST_CASE(flat_rectangles_press_within_two_and_a_half_per_cent) {
  struct Flat {
    double aspect, over_circle;
  };
  const double square = 4 * pi * 0.36678746 / (8 * std::sqrt(1 / pi));
  for (const auto& [aspect, over_circle] : {Flat{1, square}, Flat{2, 1.0472}, Flat{4, 1.1266}, Flat{10, 1.3227}}) {
    const double force = force_at(box_body({aspect, 1, 1}, 1), Vector3::UnitZ(), 1e-3);
    BOOST_TEST(force == over_circle * 2e-3 * std::sqrt(aspect / pi), boost::test_tools::tolerance(0.025));
  }
}

BOOST_AUTO_TEST_CASE(a_ball_presses_as_hertz_says_within_two_per_cent) {
  const Body ball = round_body({.semiaxes = Vector3::Constant(1)});
  for (const double depth : {1e-8, 1e-4, 1e-2}) {
    const double force = force_at(ball, Vector3(0.6, 0, 0.8), depth) / (4.0 / 3 * std::pow(depth, 1.5));
    BOOST_TEST(force == std::pow(2.0 / 3, 1.5) * 15 / 8, boost::test_tools::tolerance(depth + 1e-7));
    BOOST_TEST(std::fabs(force - 1) <= 0.021);
  }
}

/// F = (2/π) E* δ²/slope.
BOOST_AUTO_TEST_CASE(a_cone_presses_as_sneddon_says_within_four_and_a_half_per_cent) {
  for (const double slope : {0.1, 1.0}) {
    const Body tip = cone(slope, 200);
    const double force = load_of(tip, half_space(1), pressed(tip, Vector3::UnitZ(), slope / 10)).force;
    BOOST_TEST(force == 2 / pi * slope / 100, boost::test_tools::tolerance(0.045));
  }
}

/// Energies by boundary elements, at a depth of 1: of corners and edges what is stored is less than that, and never by
/// more than a third.
BOOST_AUTO_TEST_CASE(corners_and_edges_are_softer_than_they_are_by_a_third_at_most) {
  struct Pose {
    Vector3 size, normal;
    double energy;
  };
  const auto edge = [](double length, double inclination, double energy) {
    return Pose{{length, 30, 30}, {0, std::sin(inclination * degree), std::cos(inclination * degree)}, energy};
  };
  const Vector3 cube = Vector3::Constant(100);
  for (const Pose& pose : {Pose{cube, {1, 1, 1}, 0.2080}, Pose{cube, {1, 1, 0.3}, 0.3237},
                           Pose{cube, {1, 0.3, 0.3}, 0.3760}, Pose{cube, {1, 0.3, 0.1}, 0.6911}, edge(4, 45, 0.7662),
                           edge(10, 45, 1.4927), edge(4, 20, 0.9258), edge(10, 20, 1.7288), edge(4, 5, 1.7176)}) {
    const Body body = box_body(pose.size, 1);
    const double energy = load_of(body, half_space(1), pressed(body, pose.normal.normalized(), 1)).energy;
    BOOST_TEST(energy < pose.energy);
    BOOST_TEST(energy > 0.74 * pose.energy);
  }
}

/// Once the plate has gone down by a seventieth of the depth of the foot, the force is no less than 0.77 of the
/// foot's alone, and what is stored grows.
BOOST_AUTO_TEST_CASE(a_wide_part_round_a_narrow_one_does_not_take_its_force_away) {
  const Body body = plate_on_foot();
  const double foot = 2 * 0.06 / std::sqrt(pi);
  double stored = 0;
  for (const double part : {0.0, 0.015, 0.02, 0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.7}) {
    const double depth = 0.01 / (1 - part);
    const ContactLoad load = load_of(body, half_space(1), pressed(body, Vector3::UnitZ(), depth));
    BOOST_TEST(load.force >= 0.77 * foot * depth);
    BOOST_TEST(load.energy > (part > 0 ? 1 : 0.999) * stored);
    stored = part > 0 ? load.energy : 0;
  }
}

/// A circle that turns about its diameter: of (2/3) E* a³ θ² the patch has 3/8 E* a³ θ².
BOOST_AUTO_TEST_CASE(a_flat_end_turns_more_easily_than_it_does) {
  const double radius = 0.03, tilt = 1e-6, depth = 1e-5;
  const Body rod = Body(rod_mesh({.length = 0.2, .radius = radius, .mass = 1, .sectors = 60, .layers = 1}));
  GroundView view = pressed(rod, Vector3::UnitX(), depth);
  const double level = load_of(rod, half_space(1), view).energy;
  view.turn = Vector3(std::cos(tilt), 0, std::sin(tilt)) - Vector3::UnitX();
  view.sink += 0.1 * (1 - std::cos(tilt));
  const double turned = load_of(rod, half_space(1), view).energy;
  BOOST_TEST((turned - level) / (radius * radius * radius * tilt * tilt) == 0.375, boost::test_tools::tolerance(0.02));
}

/// A strip 1e5 times as long as wide, turned in the ground's plane by anything: κ to its digits.
BOOST_AUTO_TEST_CASE(long_patches_keep_their_digits) {
  Random random(4);
  const double aspect = 1e5;
  const Body strip = box_body({aspect, 1, 1}, 1);
  const double level = force_at(strip, Vector3::UnitZ(), 1e-3);
  double a = std::sqrt(aspect), b = 1 / a;
  for (int i = 0; i < 60; ++i) std::tie(a, b) = std::pair((a + b) / 2, std::sqrt(a * b));
  BOOST_TEST(level == a * 2e-3 * std::sqrt(aspect / pi), boost::test_tools::tolerance(1e-10));
}

/// The load is the gradient of U, over sinking and over turning: U is a potential.
BOOST_AUTO_TEST_CASE(force_and_moment_are_derivatives_of_the_stored_energy) {
  Random random(1);
  for (const Body& body : bodies()) {
    const auto surface = contact_on(body, half_space(1));
    for (int i = 0; i < 40; ++i) {
      const double depth = body.radius() * std::pow(10, random(-4, -0.7));
      GroundView view =
          pressed(body, i % 2 == 0 ? random.direction() : (Vector3::UnitZ() + random.vector(0.1)).normalized(), depth);
      view.vertical_speed = random(-1, 1) * depth;
      view.angular_velocity = random.vector(depth / body.radius());
      const ContactLoad load = surface->load(view);
      const auto change = [&](double h) {
        return (surface->load(later(view, h)).energy - surface->load(later(view, -h)).energy) / (2 * h);
      };
      constexpr double h = 1e-3;
      const double rate = (4 * change(h / 2) - change(h)) / 3;
      const double scale = load.force * depth;
      BOOST_TEST(std::fabs(power_of(load, view) - rate) <= 1e-7 * scale);
    }
  }
}

/// Power of the load = U̇ + what is dissipated, never negative, and the ground never pulls.
BOOST_AUTO_TEST_CASE(damping_takes_energy_and_gives_none) {
  Random random(2);
  for (const Body& body : bodies()) {
    for (int i = 0; i < 200; ++i) {
      const double depth = body.radius() * std::pow(10, random(-4, -0.7)), number = std::pow(10, random(-2, 1.5));
      const auto surface = contact_on(body, half_space(1, number));
      GroundView view =
          pressed(body, i % 2 == 0 ? random.direction() : (Vector3::UnitZ() + random.vector(0.1)).normalized(), depth);
      view.vertical_speed = random(-1, 1);
      view.angular_velocity = random.vector(std::pow(10, random(-1, 3)) / body.radius());
      const ContactLoad load = surface->load(view);
      BOOST_TEST(load.force >= 0);
      BOOST_TEST(load.damping_power >= 0);
      // Where nothing presses on a body below the ground all that the patch stores is released, or taken back.
      if (load.force > 0) BOOST_TEST(load.release_power >= -1e-12 * load.energy / depth);
      const double fastest = 1 + view.angular_velocity.norm() * body.radius();
      const auto change = [&](double h) {
        return (surface->load(later(view, h)).energy - surface->load(later(view, -h)).energy) / (2 * h);
      };
      const double h = 1e-3 * depth / fastest, rate = (4 * change(h / 2) - change(h)) / 3;
      const double gap = power_of(load, view) - rate - load.damping_power - load.release_power;
      const double scale = load.energy / depth * fastest * (1 + number * fastest);
      BOOST_TEST(std::fabs(gap) <= 1e-7 * scale);
    }
  }
}

/// A plate on a narrow foot is where that law by itself would give energy: just below the depth at which nothing
/// presses.
BOOST_AUTO_TEST_CASE(where_damping_would_give_energy_it_takes_none) {
  Random random(7);
  const Body body = plate_on_foot();
  int without = 0;
  for (int i = 0; i < 60000; ++i) {
    const double depth = body.radius() * std::pow(10, random(-5, -0.7));
    GroundView view =
        pressed(body, (Vector3::UnitZ() + random.vector(std::pow(10, random(-4, 0)))).normalized(), depth);
    view.vertical_speed = random(-1, 1);
    view.angular_velocity = random.vector(std::pow(10, random(-2, 3)) / body.radius());
    const ContactLoad load = load_of(body, half_space(1, std::pow(10, random(-2, 1.5))), view);
    if (!(load.force > 0)) continue;
    if (load.damping_power == 0 && load.release_power == 0) ++without;
    BOOST_TEST_REQUIRE(load.damping_power >= 0);
    BOOST_TEST_REQUIRE(load.release_power >= 0);
  }
  BOOST_TEST(without > 0);
}

/// The rates that events and stick take, against a difference along the motion with its accelerations.
BOOST_AUTO_TEST_CASE(the_rate_of_the_force_is_that_along_the_motion) {
  Random random(3);
  for (const Body& body : bodies()) {
    for (int i = 0; i < 20; ++i) {
      Ground ground = half_space(1e6, i % 2 == 0 ? 0 : 0.3);
      if (i % 3 == 0) ground.static_friction = ground.sliding_friction = 0.4;
      ContactSystem system(body, ground, 9.81, false);
      MotionState touch;
      touch.attitude = Eigen::Quaterniond::FromTwoVectors(random.direction(), Vector3::UnitZ());
      const Vector3 normal = touch.attitude.conjugate() * Vector3::UnitZ();
      const double depth = body.radius() * std::pow(10, random(-4, -1));
      touch.centre = {0, 0, pressed(body, normal, 0).reference.offset};
      system.begin(touch);
      ContactState y = system.initial();
      displacement(y).z() = -depth;
      velocity(y) = random.vector(1);
      angular_velocity(y) = random.vector(1 / body.radius());
      FrictionPhase phase;
      if (ground.has_friction()) phase.kind = FrictionPhase::Kind::stick;
      system.set_phase(phase);
      ContactState rate, unused;
      const ContactDiagnosis at = system.diagnose(y, rate);
      const double h = 1e-4 * depth;
      const auto force = [&](double time) {
        ContactState moved = y + time * rate;
        euler_parameters(moved).normalize();
        return system.diagnose(moved, unused).load.force;
      };
      const double found = (8 * (force(h / 2) - force(-h / 2)) - (force(h) - force(-h))) / (6 * h);
      const double scale = at.load.force / depth;
      BOOST_TEST(std::fabs(at.force_rate - found) <= 1e-6 * scale);
    }
  }
}

/// Hertz: ½ m v² = (8/15) E* √R δ^(5/2), T = 2.868 (m²/(R E*² v))^(1/5).
BOOST_AUTO_TEST_CASE(the_impact_of_a_ball_is_hertz_s_within_one_per_cent) {
  const double radius = 0.02, modulus = 5e9, speed = 2;
  const Body ball = round_body({.semiaxes = Vector3::Constant(radius)}, 0.2);
  const double mass = ball.mass();
  const double depth = std::pow(15 * mass * speed * speed / (16 * modulus * std::sqrt(radius)), 0.4);
  const Simulation run = dropped(ball, weightless(half_space(modulus)), 0.3, speed, {.tolerance = 1e-10});
  const ImpactNumbers& row = run.impacts.at(0).value;
  BOOST_TEST(row.peak_force == 4.0 / 3 * modulus * std::sqrt(radius) * std::pow(depth, 1.5),
             boost::test_tools::tolerance(0.01));
  BOOST_TEST(row.duration == 2.868 * std::pow(mass * mass / (radius * modulus * modulus * speed), 0.2),
             boost::test_tools::tolerance(0.01));
  BOOST_TEST(row.restitution == 1, boost::test_tools::tolerance(1e-8));
}

/// s − ln(1 + s) = −e s − ln(1 − e s), s = τ v, for whatever sinks as one.
BOOST_AUTO_TEST_CASE(restitution_is_that_of_hunt_and_crossley_s_factor) {
  for (const double number : {0.03, 0.5, 4.0}) {
    double low = 0, high = std::min(1.0, 1 / number);
    const double loss = number - std::log1p(number);
    for (int i = 0; i < 200; ++i) {
      const double e = (low + high) / 2;
      (-e * number - std::log1p(-e * number) < loss ? low : high) = e;
    }
    const double speed = 1.7;
    const Ground ground = half_space(1e8, number / speed);
    const Body ball = round_body({.semiaxes = Vector3::Constant(0.1)});
    const Body box = box_body({0.1, 0.07, 0.02}, 0.3);
    for (const Body* const body : {&ball, &box}) {
      const Simulation run = dropped(*body, weightless(ground), 0, speed, {.tolerance = 1e-10});
      BOOST_TEST(run.impacts.at(0).value.restitution == low, boost::test_tools::tolerance(1e-6));
    }
  }
}

BOOST_AUTO_TEST_CASE(the_ledger_of_drops_closes) {
  Random random(5);
  for (int i = 0; i < 8; ++i) {
    Ground ground = half_space(std::pow(10, random(6, 9)), i % 2 == 0 ? 0 : random(0.05, 1));
    if (i % 4 > 1) ground.static_friction = ground.sliding_friction = random(0.05, 0.8);
    if (i > 4) ground.friction = i == 6 ? FrictionLaw::regularised : FrictionLaw::local;
    const World world{.ground = ground};
    const Body body = i % 4 == 0 ? round_body({.semiaxes = {0.1, 0.07, 0.12}}) : phone();
    const MotionState touch = touching_state(body, {.inclination = random(0.05, 1.4),
                                                    .velocity = {0.3, 0.1, -random(0.5, 4)},
                                                    .out_of_plane_tilt = random(-0.5, 0.5)});
    const Simulation run = simulate(body, world, touch, plain_impacts(3), {.tolerance = 1e-9}, {});
    BOOST_TEST(!run.impacts.empty());
    for (const ImpactRecord& impact : run.impacts) {
      BOOST_TEST(std::fabs(impact.ledger_gap) <= 1e-8);
      BOOST_TEST(impact.value.work_damping >= 0);
      BOOST_TEST(impact.value.energy_after <= impact.value.energy_before * (1 + 1e-9));
    }
  }
}
