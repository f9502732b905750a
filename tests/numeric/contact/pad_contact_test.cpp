// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/contact/half_space.hpp"

#include "numeric/contact/contact_system.hpp"
#include "tests/numeric/bodies.hpp"
#include "tests/support.hpp"

namespace {

using namespace clatter::numeric;
using namespace clatter::numeric::test;
using namespace clatter::test;

constexpr double rounding = 1e-12;

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

}  // namespace

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
      BOOST_TEST(std::fabs(load.force - seen.force) <= rounding * seen.force);
      const Vector3 moment = load.first_moment + 0.5 * size * load.force;
      BOOST_TEST((moment - seen.moment).norm() <= rounding * seen.moment.norm());
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

/// −e s − ln(1 − e s) = s − ln(1 + s), s = τ v, whatever the curve, of what sinks as one without gravity.
BOOST_AUTO_TEST_CASE(restitution_follows_from_dissipation_alone) {
  for (const double number : {0.05, 0.5, 3.0}) {
    double low = 0, high = std::min(1.0, 1 / number);
    const double loss = number - std::log1p(number);
    for (int i = 0; i < 200; ++i) {
      const double e = (low + high) / 2;
      (-e * number - std::log1p(-e * number) < loss ? low : high) = e;
    }
    const double speed = 1.3;
    for (const Body& body : {box_body({0.2, 0.1, 0.04}, 0.7), ball()}) {
      const Simulation run = dropped(body, weightless(foam(0.02).pad(number / speed)), 0, speed, {.tolerance = 1e-11});
      BOOST_TEST(run.impacts.at(0).value.restitution == low, boost::test_tools::tolerance(1e-7));
    }
  }
}

/// The derivative of the load that friction and events need is that of the load itself.
BOOST_AUTO_TEST_CASE(rates_of_the_load_are_those_of_its_motion) {
  Random random(3);
  for (const Body& body : {phone(), ball()}) {
    const Ground pad = with_friction(foam(0.005).pad(0.2), 0.3);
    for (int i = 0; i < 20; ++i) {
      const MotionState touch = touching_state(body, {.inclination = random(0.2, 1.3), .velocity = {0.5, 0.2, -1}});
      ContactSystem system(body, pad, 9.81, false);
      system.begin(touch);
      system.set_phase({.kind = FrictionPhase::Kind::slip, .direction = {1, 0}});
      ContactState y = system.initial(), rate;
      displacement(y).z() = -random(0.0008, 0.006);
      angular_velocity(y) = random.vector(20);
      const ContactDiagnosis here = system.diagnose(y, rate);
      constexpr double h = 1e-7;
      const auto force_at = [&](double time) {
        ContactState moved = y + time * rate, unused;
        return system.diagnose(moved, unused).load.force;
      };
      const double found = (8 * (force_at(h / 2) - force_at(-h / 2)) - (force_at(h) - force_at(-h))) / (6 * h);
      const double scale = here.load.force * (1 + 20 * body.radius()) / here.load.deepest;
      BOOST_TEST(std::fabs(here.force_rate - found) <= 1e-6 * scale);
    }
  }
}

BOOST_AUTO_TEST_CASE(the_ledger_of_drops_on_pads_closes) {
  Random random(5);
  for (int i = 0; i < 8; ++i) {
    Ground pad = foam(random(0.002, 0.02))
                     .pad(i % 2 == 0 ? 0 : random(0.05, 1), i % 3 == 0 ? AreaMeasure::surface : AreaMeasure::projected);
    if (i % 4 > 1) pad = with_friction(pad, random(0.05, 0.8));
    if (i > 4) pad.friction = i == 6 ? FrictionLaw::regularised : FrictionLaw::local;
    const Body body = i % 4 == 0 ? ball() : phone();
    const MotionState touch = touching_state(body, {.inclination = random(0.05, 1.4),
                                                    .velocity = {0.3, 0.1, -random(0.5, 3)},
                                                    .out_of_plane_tilt = random(-0.5, 0.5)});
    const Simulation run = simulate(body, {.ground = pad}, touch, plain_impacts(2), {.tolerance = 1e-9}, {});
    BOOST_TEST(!run.impacts.empty());
    for (const ImpactRecord& impact : run.impacts) {
      BOOST_TEST(std::fabs(impact.ledger_gap) <= 1e-8);
      BOOST_TEST(impact.value.work_damping >= 0);
      BOOST_TEST(impact.value.energy_after <= impact.value.energy_before * (1 + 1e-8));
    }
  }
}

BOOST_AUTO_TEST_CASE(curves_that_fall_or_go_back_are_refused) {
  const auto with = [](std::vector<Kink> kinks) { return Ground{.stiffness = 1e6, .kinks = std::move(kinks)}; };
  with({{0.01, -1}, {0.02, 3}}).validate();
  for (const auto& kinks : std::vector<std::vector<Kink>>{
           {{0.01, -1.1}}, {{0.02, 1}, {0.01, 1}}, {{0, 1}}, {{not_a_number, 1}}, {{0.01, not_a_number}}})
    CHECK_REFUSED_SAYING(with(kinks).validate(), std::domain_error, "ground.kinks");
}
