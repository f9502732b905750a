// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/contact/contact_load.hpp"

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

/// Along that motion, by differences over the time.
double rate_of_energy(ContactSurface& surface, const GroundView& view, double h) {
  const auto change = [&](double time) {
    return (surface.load(later(view, time)).energy - surface.load(later(view, -time)).energy) / (2 * time);
  };
  return (4 * change(h / 2) - change(h)) / 3;
}

Body plate_on_foot() {
  return Body(without(box_mesh({.size = {0.3, 0.3, 0.02}, .mass = 1, .nx = 5, .ny = 5, .nz = 2}),
                      [](const Vector3& middle) { return middle.z() < 0 && middle.head<2>().norm() > 0.01; }));
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

/// −e s − ln(1 − e s) = s − ln(1 + s), s = τ v: of what sinks as one without gravity.
double restitution_of(double number) {
  double low = 0, high = std::min(1.0, 1 / number);
  const double loss = number - std::log1p(number);
  for (int i = 0; i < 200; ++i) {
    const double e = (low + high) / 2;
    (-e * number - std::log1p(-e * number) < loss ? low : high) = e;
  }
  return low;
}

// Pads.

/// Straight pieces through points of depth and pressure, from (0, 0) on; level beyond the last.
struct Curve {
  std::vector<double> depths, pressures;

  [[nodiscard]] double at(double depth) const {
    std::size_t i = 1;
    while (i + 1 < depths.size() && depth > depths[i]) ++i;
    const double part = (depth - depths[i - 1]) / (depths[i] - depths[i - 1]);
    return pressures[i - 1] + part * (pressures[i] - pressures[i - 1]);
  }
  [[nodiscard]] double slope(std::size_t i) const {
    return (pressures[i + 1] - pressures[i]) / (depths[i + 1] - depths[i]);
  }
  [[nodiscard]] Ground pad(double dissipation = 0, AreaMeasure area = AreaMeasure::projected) const {
    Ground ground{.stiffness = slope(0), .dissipation = dissipation, .area = area};
    for (std::size_t i = 1; i + 1 < depths.size(); ++i)
      ground.kinks.push_back({depths[i], (slope(i) - slope(i - 1)) / slope(0)});
    return ground;
  }
};

/// Stiff, all but level, and stiffer than at first, as a foam is.
Curve foam(double depth) { return {{0, 0.1 * depth, 0.6 * depth, 100 * depth}, {0, 2e4, 2.5e4, 2e7}}; }

Body ball() { return round_body({.semiaxes = Vector3::Constant(0.1)}); }

/// Five points a piece between breaks, each piece a polynomial of degree 9 at most.
double integral(double from, double to, const std::vector<double>& breaks, auto&& f) {
  static const double nodes[] = {0, 0.5384693101056831, 0.9061798459386640};
  static const double weights[] = {0.5688888888888889, 0.4786286704993665, 0.2369268850561891};
  std::vector<double> ends{from, to};
  for (const double at : breaks) {
    if (at > from && at < to) ends.push_back(at);
  }
  std::sort(ends.begin(), ends.end());
  double sum = 0;
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    const double middle = (ends[i] + ends[i + 1]) / 2, half = (ends[i + 1] - ends[i]) / 2;
    for (int k = 0; k < 3; ++k)
      sum += half * weights[k] * (k == 0 ? f(middle) : f(middle - half * nodes[k]) + f(middle + half * nodes[k]));
  }
  return sum;
}

/// What presses on a box's corner that points down: over each face that meets there, ∫p(δ) of its places.
struct CornerLoad {
  double force = 0;
  Vector3 moment = Vector3::Zero();  ///< of the places, from the corner
};
CornerLoad corner_load(const Curve& curve, const Vector3& up, double depth, AreaMeasure area) {
  CornerLoad load;
  for (int face = 0; face < 3; ++face) {
    const int j = (face + 1) % 3, k = (face + 2) % 3;
    const auto over = [&](auto&& weight) {
      std::vector<double> breaks;
      for (const double d : curve.depths) breaks.push_back((depth - d) / up[j]);
      return integral(0, depth / up[j], breaks, [&](double a) {
        const double left = depth - a * up[j];
        std::vector<double> inner;
        for (const double d : curve.depths) inner.push_back((left - d) / up[k]);
        return integral(0, left / up[k], inner, [&](double b) { return weight(a, b) * curve.at(left - b * up[k]); });
      });
    };
    const double size = area == AreaMeasure::projected ? up[face] : 1;
    load.force += size * over([](double, double) { return 1; });
    load.moment[j] += size * over([](double a, double) { return a; });
    load.moment[k] += size * over([](double, double b) { return b; });
  }
  return load;
}

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
  const auto bed = [](AreaMeasure area) { return Ground{.stiffness = 1e8, .area = area}; };
  for (const Ground& ground : {half_space(1), bed(AreaMeasure::surface), bed(AreaMeasure::projected)}) {
    for (const Body& body : bodies()) {
      const auto surface = contact_on(body, ground);
      for (int i = 0; i < 40; ++i) {
        const double depth = body.radius() * std::pow(10, random(-4, -0.7));
        GroundView view = pressed(
            body, i % 2 == 0 ? random.direction() : (Vector3::UnitZ() + random.vector(0.1)).normalized(), depth);
        view.vertical_speed = random(-1, 1) * depth;
        view.angular_velocity = random.vector(depth / body.radius());
        const ContactLoad load = surface->load(view);
        BOOST_TEST(std::fabs(power_of(load, view) - rate_of_energy(*surface, view, 1e-3)) <= 1e-7 * load.force * depth);
      }
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
      const double rate = rate_of_energy(*surface, view, 1e-3 * depth / fastest);
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
    for (int i = 0; i < 40; ++i) {
      Ground ground = half_space(1e6, i % 2 == 0 ? 0 : 0.3);
      if (i >= 20) ground = foam(0.02 * body.radius()).pad(i % 2 == 0 ? 0 : 0.2);
      if (i % 3 == 0) ground = with_friction(ground, 0.4);
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

/// Whatever the shape, and the curve of a pad.
BOOST_AUTO_TEST_CASE(restitution_follows_from_dissipation_alone_as_hunt_and_crossley_s_factor_has_it) {
  constexpr double speed = 1.7;
  for (const double number : {0.03, 0.5, 4.0}) {
    for (const Ground& ground : {half_space(1e8, number / speed), foam(0.02).pad(number / speed)}) {
      for (const Body& body : {ball(), box_body({0.2, 0.1, 0.04}, 0.7)}) {
        const Simulation run = dropped(body, weightless(ground), 0, speed, {.tolerance = 1e-11});
        BOOST_TEST(run.impacts.at(0).value.restitution == restitution_of(number), boost::test_tools::tolerance(1e-7));
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(the_ledger_of_drops_closes) {
  Random random(5);
  for (int i = 0; i < 16; ++i) {
    const double dissipation = i % 2 == 0 ? 0 : random(0.05, 1);
    const AreaMeasure area = i % 3 == 0 ? AreaMeasure::surface : AreaMeasure::projected;
    Ground ground =
        i < 8 ? half_space(random.decades(6, 9), dissipation) : foam(random(0.002, 0.02)).pad(dissipation, area);
    if (i % 4 > 1) ground = with_friction(ground, random(0.05, 0.8));
    if (i % 8 > 4) ground.friction = i % 8 == 6 ? FrictionLaw::regularised : FrictionLaw::local;
    const Body body = i % 4 != 0 ? phone() : i < 8 ? round_body({.semiaxes = {0.1, 0.07, 0.12}}) : ball();
    const MotionState touch = touching_state(body, {.inclination = random(0.05, 1.4),
                                                    .velocity = {0.3, 0.1, -random(0.5, 3)},
                                                    .out_of_plane_tilt = random(-0.5, 0.5)});
    const Simulation run = simulate(body, {.ground = ground}, touch, plain_impacts(3), {.tolerance = 1e-9}, {});
    BOOST_TEST(!run.impacts.empty());
    for (const ImpactRecord& impact : run.impacts) {
      BOOST_TEST(std::fabs(impact.ledger_gap) <= 1e-8);
      BOOST_TEST(impact.value.work_damping >= 0);
      BOOST_TEST(impact.value.energy_after <= impact.value.energy_before * (1 + (i < 8 ? 1e-9 : 1e-8)));
    }
  }
}

BOOST_AUTO_TEST_CASE(a_pad_of_one_piece_has_the_bits_of_springs) {
  Random random(1);
  const double k = 1.7e7, tau = 0.13;
  for (const double friction : {0.0, 0.4}) {
    Ground pad = with_friction({.stiffness = k, .dissipation = tau, .kinks = {{0.02, 0}}}, friction);
    Ground springs = with_friction({.stiffness = k, .damping = tau * k}, friction);
    for (const Body& body : {phone(), ball()}) {
      pad.friction = springs.friction = friction > 0 ? FrictionLaw::local : FrictionLaw::coulomb;
      const MotionState touch = touching_state(body, {.inclination = random(0.1, 1), .velocity = {0.4, 0, -1.3}});
      const Simulation one = simulate(body, {.ground = pad}, touch, plain, {.tolerance = 1e-8}, {});
      const Simulation other = simulate(body, {.ground = springs}, touch, plain, {.tolerance = 1e-8}, {});
      const ImpactNumbers &a = one.impacts.at(0).value, &b = other.impacts.at(0).value;
      BOOST_TEST(a.peak_force == b.peak_force);
      BOOST_TEST(a.duration == b.duration);
      BOOST_TEST(a.indentation == b.indentation);
      BOOST_TEST(a.velocity_after == b.velocity_after);
      BOOST_TEST(a.angular_velocity_after == b.angular_velocity_after);
      BOOST_TEST(a.energy_loss == b.energy_loss);
    }
  }
}

BOOST_AUTO_TEST_CASE(force_and_moment_on_a_corner_are_the_integrals_of_the_curve) {
  Random random(2);
  const Vector3 size(0.3, 0.2, 0.25);
  const Body box = box_body(size, 1);
  for (int i = 0; i < 20; ++i) {
    const Vector3 up = (Vector3(0.3, 0.3, 0.3) + random.vector(0.15)).normalized();
    const double depth = random(0.002, 0.04);
    const Curve curve = foam(0.03);
    GroundView view;
    view.reference = {up, 0.5 * up.dot(size) - depth};
    for (const AreaMeasure area : {AreaMeasure::surface, AreaMeasure::projected}) {
      const ContactLoad load = contact_on(box, curve.pad(0, area))->load(view);
      const CornerLoad seen = corner_load(curve, up, depth, area);
      BOOST_TEST(std::fabs(load.force - seen.force) <= relative * seen.force);
      const Vector3 moment = load.first_moment + 0.5 * size * load.force;
      BOOST_TEST((moment - seen.moment).norm() <= relative * seen.moment.norm());
    }
  }
}

/// ∫p dδ = m (½ v² + g δ)/A, in each piece a quadratic for δ.
BOOST_AUTO_TEST_CASE(a_flat_drop_goes_as_deep_as_the_curve_takes_its_energy_up) {
  const Vector3 size(0.2, 0.1, 0.04);
  const double mass = 0.7, area = size.x() * size.y(), g = 9.81;
  const Body box = box_body(size, mass);
  const Curve curve = foam(0.02);
  for (const double speed : {0.3, 0.9, 1.5, 3.0}) {
    double taken = 0, depth = 0;
    for (std::size_t i = 0; i + 1 < curve.depths.size(); ++i) {
      const double from = curve.depths[i], to = curve.depths[i + 1], load = mass / area;
      const double whole = (curve.pressures[i] + curve.pressures[i + 1]) / 2 * (to - from);
      if (taken + whole < load * (speed * speed / 2 + g * to)) {
        taken += whole;
        continue;
      }
      const double b = curve.pressures[i] - load * g, c = load * (speed * speed / 2 + g * from) - taken;
      depth = from + 2 * c / (b + std::sqrt(b * b + 2 * curve.slope(i) * c));
      break;
    }
    const Simulation run = dropped(box, {.ground = curve.pad()}, 0, speed, {.tolerance = 1e-11});
    const ImpactNumbers& row = run.impacts.at(0).value;
    BOOST_TEST(row.indentation == depth, boost::test_tools::tolerance(1e-9));
    BOOST_TEST(row.peak_force == curve.at(depth) * area, boost::test_tools::tolerance(1e-9));
    BOOST_TEST(std::fabs(run.impacts.at(0).ledger_gap) <= 1e-8);
  }
}

BOOST_AUTO_TEST_CASE(a_number_that_the_ground_would_not_use_is_refused) {
  Ground{.damping = 0, .modulus = 1e9, .dissipation = 0.1}.validate();
  Ground{.stiffness = 1e8, .damping = 1e5}.validate();
  CHECK_REFUSED_SAYING((Ground{.damping = 1e5, .modulus = 1e9}.validate()), std::domain_error, "ground.damping");
  CHECK_REFUSED_SAYING((Ground{.stiffness = 1e8, .dissipation = 0.1}.validate()), std::domain_error,
                       "ground.dissipation");
  CHECK_REFUSED_SAYING((Ground{.stiffness = 1e8, .damping = 1, .kinks = {{0.01, 2}}}.validate()), std::domain_error,
                       "ground.damping");
}

BOOST_AUTO_TEST_CASE(curves_that_fall_or_go_back_are_refused) {
  const auto with = [](std::vector<Kink> kinks) { return Ground{.stiffness = 1e6, .kinks = std::move(kinks)}; };
  with({{0.01, -1}, {0.02, 3}}).validate();
  for (const auto& kinks : std::vector<std::vector<Kink>>{
           {{0.01, -1.1}}, {{0.02, 1}, {0.01, 1}}, {{0, 1}}, {{not_a_number, 1}}, {{0.01, not_a_number}}})
    CHECK_REFUSED_SAYING(with(kinks).validate(), std::domain_error, "ground.kinks");
}

}  // namespace
