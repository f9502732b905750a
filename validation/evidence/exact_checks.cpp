// SPDX-License-Identifier: GPL-3.0-or-later
// Exact results: closed forms, 30-digit tables, conservation laws, convergence orders.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analytic/law/viscoelastic.hpp"
#include "analytic/near_flat/footprint.hpp"
#include "analytic/near_flat/two_contacts.hpp"
#include "analytic/plane/contact_angles.hpp"
#include "analytic/plane/sequence.hpp"
#include "analytic/space/sequence/sequence.hpp"
#include "numeric/contact/contact_load.hpp"
#include "numeric/mesh/generators.hpp"
#include "numeric/motion/free_rotation.hpp"
#include "validation/evidence/check.hpp"
#include "validation/output/number.hpp"

namespace clatter::validation {
namespace {

using analytic::Angle;
using analytic::ContactAngles;
using analytic::degrees_per_radian;

double relative(double value, double exact) { return std::fabs(value - exact) / std::fabs(exact); }

/// Largest relative error of all angles, impulses and velocities of a 30-digit table.
Measured against_table(ReferenceTable table) {
  WorstError worst;
  std::string where;
  int count = 0;
  for (const ReferenceRow& row : reference_table(table)) {
    const ContactAngles angles =
        contact_angles(Angle::from_degrees(row.at("theta_deg")), {.gravity_number = row.at("G")});
    const std::pair<const char*, double> numbers[] = {{"beta_deg", angles.beta.angle * degrees_per_radian},
                                                      {"gamma_deg", angles.gamma.angle * degrees_per_radian},
                                                      {"P1", angles.impulse[0]},
                                                      {"P2", angles.impulse[1]},
                                                      {"P3", angles.impulse[2]},
                                                      {"V1", angles.velocity[0]},
                                                      {"V2", angles.velocity[1]},
                                                      {"V3", angles.velocity[2]},
                                                      {"Omega1", angles.angular[0]},
                                                      {"Omega2", angles.angular[1]},
                                                      {"Omega3", angles.angular[2]}};
    for (const auto& [name, value] : numbers) {
      const auto exact = row.find(name);
      if (exact == row.end()) continue;
      ++count;
      if (worst.take(relative(value, exact->second)))
        where = fmt::format("{} at θ = {}°, G = {}", name, row.at("theta_deg"), row.at("G"));
    }
  }
  return {static_cast<double>(count), worst.value(), Finding::holds, "worst: " + where};
}

Measure table(ReferenceTable of) {
  return [=](CaseRuns&) { return against_table(of); };
}

Measured small_angle_coefficient(CaseRuns&) {
  const double theta = 1e-3;
  const double beta = contact_angles(Angle::from_radians(theta), {}).beta.angle;
  const double coefficient = (beta / theta - 0.5) / (theta * theta);
  return {coefficient, std::fabs(coefficient - 17.0 / 64), Finding::holds, "17/64 = 0.265625, at θ = 1e-3"};
}

Measured largest_second_impulse(CaseRuns&) {
  const auto impulse = [](double degrees) { return contact_angles(Angle::from_degrees(degrees), {}).impulse[1]; };
  double low = 40, high = 54;
  while (high - low > 1e-6) {  // P₂ is unimodal there
    const double third = (high - low) / 3;
    const double left = low + third, right = high - third;
    if (impulse(left) < impulse(right)) low = left;
    else high = right;
  }
  const double largest = impulse(low);
  return {largest, std::fabs(largest - 1.04540), Finding::holds, fmt::format("at θ = {}°", significant(low, 5))};
}

Measured bouncing_end(CaseRuns&) {
  const double e = 0.5, g = 9.81, v = 2;
  const analytic::Sequence sequence = analytic::impact_sequence({.body = analytic::make_box({}),
                                                                 .inclination = Angle::from_degrees(0),
                                                                 .velocity = {.normal = -v},
                                                                 .gravity = g,
                                                                 .law = {.restitution = e}},
                                                                {.impacts = 3});
  const double end = sequence.tail.value().end_time;
  return {end, relative(end, 2 * e * v / (g * (1 - e))), Finding::holds, "flat box, e = 0.5, 2 m/s"};
}

Measured restitution_map(CaseRuns&) {
  const double at_tenth = analytic::restitution_of_damping(0.1), at_one = analytic::restitution_of_damping(1);
  const auto residual = [](double s, double e) { return std::fabs(std::log1p(s) - std::log1p(-s * e) - s * (1 + e)); };
  return {at_tenth, worst_of({relative(at_tenth, 0.937475579949905), residual(0.1, at_tenth), residual(1, at_one)}),
          Finding::holds, fmt::format("e(1) = {}", significant(at_one, 12))};
}

/// The first impact, to so many digits.
numeric::ImpactNumbers first_impact(const numeric::Body& body, const numeric::World& world,
                                    const numeric::MotionState& start, int digits) {
  const numeric::Request request{.impacts = 1, .error_estimates = false, .amplification = false};
  return numeric::simulate(body, world, start, request, {.digits = digits}).impacts.at(0).value;
}

struct FlatLanding {
  numeric::ImpactNumbers numbers;
  double mass = 2, area = 0.06, stiffness = 1e8, speed = 3;
};

FlatLanding flat_landing(double damping) {
  FlatLanding landing;
  const numeric::Body body(numeric::box_mesh({.size = {0.3, 0.2, 0.1}, .mass = landing.mass}));
  const numeric::World world{
      .ground = {.stiffness = landing.stiffness, .damping = damping, .area = numeric::AreaMeasure::projected},
      .gravity = 0};
  const auto start = numeric::touching_state(body, {.inclination = 0, .velocity = {0, 0, -landing.speed}});
  landing.numbers = first_impact(body, world, start, 10);
  return landing;
}

Measured half_sine(CaseRuns&) {
  const FlatLanding landing = flat_landing(0);
  const double frequency = std::sqrt(landing.stiffness * landing.area / landing.mass);
  const double force = landing.speed * std::sqrt(landing.stiffness * landing.area * landing.mass);
  const double error = worst_of(
      {relative(landing.numbers.duration, analytic::pi / frequency), relative(landing.numbers.peak_force, force)});
  return {landing.numbers.peak_force, error, Finding::holds,
          fmt::format("contact time {} s", significant(landing.numbers.duration, 9))};
}

Measured damped_landing(CaseRuns&) {
  WorstError worst;
  double at_one = 0;
  for (const double s : {0.01, 0.1, 1.0, 5.0}) {
    const FlatLanding landing = flat_landing(s * 1e8 / 3);
    const double e = landing.numbers.restitution;
    const double residual = std::log1p(s) - std::log1p(-s * e) - s * (1 + e);
    const double slope = s / (1 - s * e) - s;  // of the residual over e
    worst.take(std::fabs(residual / slope));
    if (s == 1) at_one = e;
  }
  return {at_one, worst.value(), Finding::holds, "worst of s = 0.01, 0.1, 1, 5"};
}

Measured elastic_energy(CaseRuns& case_runs) {
  WorstError worst;
  for (const char* name : {"rod-45", "phone-elastic"}) {
    const numeric::Simulation& run = case_runs.run(name, {.planar = true});
    for (const auto& impact : run.impacts) worst.take(std::fabs(impact.value.energy_loss) / run.energy_start);
  }
  return {worst.value(), worst.value(), Finding::holds, "largest loss of one impact over the energy; digits 6"};
}

Measured energy_ledger(CaseRuns& case_runs) {
  WorstError worst;
  for (const char* name : {"phone-damped", "rod-at-1ms", "rod-from-2m", "rod-friction-03"}) {
    for (const auto& impact : case_runs.run(name).impacts) worst.take(std::fabs(impact.ledger_gap));
  }
  return {worst.value(), worst.value(), Finding::holds, "loss − dampers − friction − released, over the energy"};
}

/// Change of the end state from step to step of the paper's method.
Measured runge_kutta_order(CaseRuns&) {
  Scene scene = scene_of_case("phone-damped", {.impacts = 1});
  scene.accuracy.method = numeric::Method::tvd_rk3;
  const numeric::Body body = scene.make_body();
  const auto velocity = [&](double step) {
    scene.accuracy.step = step;
    scene.request.amplification = false;
    return numeric::simulate(body, scene.world, scene.start(body), scene.request, scene.accuracy)
        .impacts.at(0)
        .value.velocity_after.z();
  };
  const double h = 2e-5;
  const double a = velocity(h), b = velocity(h / 2), c = velocity(h / 4);
  const double order = std::log2(std::fabs((a - b) / (b - c)));
  return {order, std::fabs(order - 3), Finding::holds, "damped phone, V_n after impact 1, steps of 20, 10 and 5 µs"};
}

Measured free_rotation(CaseRuns&) {
  const numeric::Matrix3 inertia = numeric::Vector3(1, 2, 2.5).asDiagonal();
  const numeric::Rotation start{Eigen::Quaterniond::Identity(), {0.3, 5, -0.2}};
  const numeric::FreeRotation rotation(inertia, start);
  const auto momentum = [&](const numeric::Rotation& r) {
    return numeric::Vector3(r.attitude * (inertia * r.angular_velocity));
  };
  WorstError worst;
  for (int i = 1; i <= 100; ++i) {
    const numeric::Rotation at = rotation.at(12.6 * i);
    worst.take((momentum(at) - momentum(start)).norm() / momentum(start).norm());
  }
  return {momentum(start).norm(), worst.value(), Finding::holds, "body about its intermediate axis, 1000 turns"};
}

/// A box standing on its edge, sunk by d: the submerged wedge has the volume W d²/(2 sin θ cos θ).
Measured hydrostatic_force(CaseRuns&) {
  const double k = 1e7, depth = 1e-3, width = 0.2, theta = 0.5;
  const numeric::Vector3 size(0.3, width, 0.1);
  const numeric::Body body(numeric::box_mesh({.size = size, .mass = 1}));
  const numeric::Ground ground{.stiffness = k, .area = numeric::AreaMeasure::projected};
  numeric::GroundView view;
  view.reference.normal = {std::sin(theta), 0, std::cos(theta)};
  view.reference.offset = size.x() / 2 * std::sin(theta) + size.z() / 2 * std::cos(theta);
  view.sink = -depth;
  const double force = numeric::facet_surface(body, ground)->load(view).force;
  const double volume = width * depth * depth / (2 * std::sin(theta) * std::cos(theta));
  return {force, relative(force, k * volume), Finding::holds, "wedge 1 mm deep at 0.5 rad"};
}

Measured contact_time_powers(CaseRuns&) {
  WorstError worst;
  std::string found;
  const auto power = [&](const Scene& scene, double exact, const char* what) {
    const double measured = stiff_limit(scene, scene.make_body(), {.impacts = 1}).power;
    worst.take(std::fabs(measured - exact));
    found += fmt::format("{}{} {}", found.empty() ? "" : ", ", what, significant(measured, 5));
    return measured;
  };
  Scene flat = scene_of_case("phone-elastic", {.impacts = 1});
  flat.angle_deg = 0;
  power(flat, 1.0 / 2, "face");
  power(scene_of_case("phone-elastic", {.impacts = 1}), 1.0 / 3, "edge");
  const double corner = power(scene_of_case("rod-45", {.impacts = 1}), 1.0 / 4, "corner");
  return {corner, worst.value(), Finding::holds, found};
}

// Close to flat: the billiard in a wedge or cone against the full model at a small tilt.

Measured impulses_close_to_flat(CaseRuns&) {
  analytic::PlanarBody body{.mass = 1, .gyration_square = 0.04, .vertex_count = 2, .vertices = {}};
  body.vertices[0] = {-0.3, -0.05};
  body.vertices[1] = {0.7, -0.05};
  const auto limit = analytic::near_flat::strikes({0.3, 0.7, 0.2}, 1, analytic::near_flat::End::a, 9);
  const auto full = analytic::impact_sequence(
      {.body = body, .inclination = Angle::from_radians(1e-13), .velocity = {.normal = -1}, .law = {}},
      {.impacts = 9, .amplification = false});
  WorstError worst;
  if (full.rows.size() != limit.size()) worst.take(INFINITY);
  for (std::size_t i = 0; i < std::min(limit.size(), full.rows.size()); ++i)
    worst.take(std::fabs(full.rows[i].impact.normal_impulse - limit[i].impulse));
  return {limit[1].impulse, worst.value(), Finding::holds,
          fmt::format("{} impacts, arms 0.3 and 0.7, κ = 0.2", limit.size())};
}

Measured hardest_blow_of_the_phone(CaseRuns&) {
  namespace space = analytic::space;
  constexpr double tilt = 1e-8;
  const Eigen::Vector3d size(0.15, 0.075, 0.008);
  space::Drop drop;
  drop.body = space::box(1, {.size = size, .centre = Eigen::Vector3d::Zero()});
  analytic::near_flat::Footprint face;
  for (const auto& [x, y] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}})
    face.corners.emplace_back(x * size.x() / 2, y * size.y() / 2);
  face.mobility = analytic::near_flat::slope_mobility(1, drop.body.inertia);
  const auto found = analytic::near_flat::tilt_sectors(face, 1);
  const auto hardest =
      std::ranges::max_element(found.sectors, {}, [](const auto& s) { return s.strikes[s.hardest()].approach; });
  const std::size_t at = hardest->hardest();
  const double direction = (hardest->from + hardest->to) / 2;
  drop.attitude = Eigen::AngleAxisd(tilt, Eigen::Vector3d(std::sin(direction), -std::cos(direction), 0));
  drop.velocity = {0, 0, -1};
  const auto full = impact_sequence(drop, {.impacts = static_cast<int>(at) + 1, .amplification = false});
  const double speed = full.rows.size() > at ? full.rows[at].impact.approach_speed : NAN;
  return {speed, std::fabs(speed - hardest->strikes[at].approach), Finding::holds,
          fmt::format("impact {} of an elastic phone tilted by {} rad", at + 1, tilt)};
}

/// The corners of a thin rectangle strike around it: 7 λ³ + (e − 6) λ² + (1 − 6 e) λ + 7 e has a double root there.
Measured endless_strikes(CaseRuns&) {
  const analytic::near_flat::Footprint face{.corners = {{-1, -0.5}, {1, -0.5}, {1, 0.5}, {-1, 0.5}},
                                            .mobility = Eigen::Vector2d(3, 12).asDiagonal()};
  double low = 0.02, high = 0.04;
  for (int i = 0; i < 60; ++i) {
    const double e = (low + high) / 2, b = e - 6, c = 1 - 6 * e, d = 7 * e;
    const double discriminant = 126 * b * c * d - 4 * b * b * b * d + b * b * c * c - 28 * c * c * c - 1323 * d * d;
    (discriminant > 0 ? low : high) = e;
  }
  const auto found = analytic::near_flat::critical_restitution(face);
  const double e = found ? found->restitution : NAN;
  return {e, std::fabs(e - low), Finding::holds, "four corners in turn"};
}

/// The ends of a bar that lands level, without rebound and friction, under gravity.  With q = L²/(4k²) > 1 an impulse P
/// stops its end at once, P = m u/(1 + q), and drives the other down by (q − 1)/(q + 1) u; b comes down first, a only
/// by what b does to it.
Measured plastic_level_landing(CaseRuns&) {
  constexpr double speed = 0.1, length = 0.2;
  WorstError worst;
  double sum = 0;
  for (const double thickness : {0.02, 0.05, 0.1, 0.2}) {
    analytic::Drop drop{.body = analytic::make_box({.mass = 1, .length = length, .thickness = thickness}),
                        .inclination = {},
                        .velocity = {.normal = -speed, .angular = 2 * speed / length},
                        .gravity = 9.81,
                        .law = {.restitution = 0}};
    const double q = length * length / 4 / drop.body.gyration_square;
    double approach = 2 * speed;
    const auto sequence = impact_sequence(drop, {.impacts = 5});
    for (const analytic::ImpactRow& row : sequence.rows) {
      worst.take(row.start == 0 ? relative(row.impact.normal_impulse, approach / (1 + q)) : INFINITY);
      approach *= (q - 1) / (q + 1);
    }
    sum = sequence.total_normal_impulse;
    worst.take(sequence.outcome == analytic::Outcome::at_rest ? relative(sum, speed) : INFINITY);
  }
  return {sum, worst.value(), Finding::holds, "four bars of 1 kg and 0.2 m, five impacts of each and their sum"};
}

/// What is left of 10 rad/s of a plate that lands level: −μ P_n c̄ of I, c̄ = r/3 + p²/(6 q) asinh(q/p) + q²/(6 p)
/// asinh(p/q) the mean distance of a rectangle 2 p × 2 q from its middle, r = √(p² + q²).
Measured spinning_face(CaseRuns&) {
  constexpr double p = 0.1, q = 0.05, mass = 1, friction = 0.3, spin = 10, speed = 1;
  const double arm = std::hypot(p, q) / 3 + p * p / (6 * q) * std::asinh(q / p) + q * q / (6 * p) * std::asinh(p / q);
  const double exact = spin - friction * 2 * mass * speed * arm / (mass * (p * p + q * q) / 3);
  const numeric::Body body(numeric::box_mesh({.size = {2 * p, 2 * q, 0.05}, .mass = mass}));
  WorstError worst;
  double found = 0;
  for (const numeric::FrictionLaw law : {numeric::FrictionLaw::local, numeric::FrictionLaw::coulomb}) {
    for (const double slip : {1e-9, 0.0}) {
      const numeric::World world{.ground = {.stiffness = 1e8,
                                            .static_friction = friction,
                                            .sliding_friction = friction,
                                            .area = numeric::AreaMeasure::projected,
                                            .friction = law},
                                 .gravity = 0};
      numeric::MotionState start = numeric::touching_state(body, {.inclination = 0, .velocity = {slip, 0, -speed}});
      start.angular_velocity = {0, 0, spin};
      found = first_impact(body, world, start, 8).angular_velocity_after.z();
      worst.take(relative(found, exact));
    }
  }
  return {found, worst.value(), Finding::holds,
          "each place's own slip, and the patch as a whole; with 1 nm/s of slip and without"};
}

/// The peak force of a ball that comes down on the springs of its projected area, E(δ) = π k δ³ (R/3 − δ/12), and the
/// spin that one without friction gets from an oblique blow: none.
Measured ball_landing(CaseRuns&) {
  constexpr double radius = 0.05, mass = 1, speed = 1;
  const numeric::Mesh mesh = numeric::round_mesh({.semiaxes = numeric::Vector3::Constant(radius), .sectors = 8});
  const numeric::Body ball({.mass = mass,
                            .centre = numeric::Vector3::Zero(),
                            .inertia = 0.4 * mass * radius * radius * numeric::Matrix3::Identity()},
                           numeric::boundary_surface(mesh), true,
                           numeric::SmoothShape{.semiaxes = numeric::Vector3::Constant(radius)});
  const auto land = [&](double stiffness, double tangential) {
    const numeric::World world{.ground = {.stiffness = stiffness, .area = numeric::AreaMeasure::projected},
                               .gravity = 0};
    const auto start = numeric::touching_state(ball, {.inclination = 0.1, .velocity = {tangential, 0, -speed}});
    return first_impact(ball, world, start, 9);
  };
  WorstError worst;
  double force = 0;
  for (const double k : {1e9, 1e11}) {
    double low = 0, high = radius;
    while (low < (low + high) / 2 && (low + high) / 2 < high) {
      const double d = (low + high) / 2, energy = analytic::pi * k * d * d * d * (radius / 3 - d / 12);
      (energy < mass * speed * speed / 2 ? low : high) = d;
    }
    const double exact = analytic::pi * k * low * low * (radius - low / 3);
    const auto straight = land(k, 0), oblique = land(k, 0.7);
    force = straight.peak_force;
    worst.take(relative(force, exact));
    worst.take(relative(oblique.peak_force, exact));
    worst.take(oblique.angular_velocity_after.norm() * radius / speed);
  }
  return {force, worst.value(), Finding::holds, "ball of 1 kg and 0.05 m at 1 m/s, k_G 1e9 and 1e11 N/m³"};
}

}  // namespace

CheckMeasures exact_measures() {
  return {{"X1", table(ReferenceTable::no_gravity)},
          {"X2", table(ReferenceTable::gravity)},
          {"X3", small_angle_coefficient},
          {"X4", largest_second_impulse},
          {"X5", bouncing_end},
          {"X6", restitution_map},
          {"X7", half_sine},
          {"X8", damped_landing},
          {"X9", elastic_energy},
          {"X10", energy_ledger},
          {"X11", runge_kutta_order},
          {"X12", free_rotation},
          {"X13", hydrostatic_force},
          {"X14", contact_time_powers},
          {"X15", impulses_close_to_flat},
          {"X16", hardest_blow_of_the_phone},
          {"X23", plastic_level_landing},
          {"X24", spinning_face},
          {"X25", ball_landing},
          {"X17", endless_strikes}};
}

}  // namespace clatter::validation
