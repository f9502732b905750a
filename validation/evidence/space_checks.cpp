// SPDX-License-Identifier: GPL-3.0-or-later
// The discrete model in space against oracles that share nothing with it.
#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "analytic/space/flight/body.hpp"
#include "validation/compare/random_scenes.hpp"
#include "validation/evidence/check.hpp"
#include "validation/oracles/reference_scene.hpp"
#include "validation/oracles/stepped_impact.hpp"

namespace clatter::validation {
namespace {

using namespace analytic::space;
using analytic::FrictionKind;
using analytic::RestitutionLaw;

/// Rotation between two attitudes [rad].
double angle_between(const Quaternion& p, const Quaternion& q) {
  return 2 * std::asin(std::min((p.normalized() * q.normalized().conjugate()).vec().norm(), 1.0));
}

/// Largest error of a scene's numbers, relative to the sequence's sizes; infinite for another corner.
double scene_error(const oracle::ReferenceScene& scene) {
  const Sequence sequence = impact_sequence(scene.drop, {.impacts = static_cast<int>(scene.impacts.size())});
  if (sequence.rows.size() != scene.impacts.size()) return INFINITY;
  double time = 0, impulse = 0, speed = scene.drop.velocity.norm(), rate = scene.drop.angular_velocity.norm();
  for (const oracle::ReferenceRowOfScene& row : scene.impacts) {
    time = std::max(time, row.time);
    impulse = std::max(impulse, row.impulse.norm());
    speed = std::max(speed, row.velocity.norm());
    rate = std::max(rate, row.angular_velocity.norm());
  }
  WorstError worst;
  for (std::size_t i = 0; i < scene.impacts.size(); ++i) {
    const ImpactRow& row = sequence.rows[i];
    const oracle::ReferenceRowOfScene& exact = scene.impacts[i];
    if (row.corners.size() != 1 || row.corners.front().index != exact.corner) return INFINITY;
    const double apart = time > 0 ? std::fabs(row.start - exact.time) / time : 0;
    worst.take(worst_of({apart, angle_between(row.before.attitude, exact.attitude),
                         (row.impact.impulse - exact.impulse).norm() / impulse,
                         (row.impact.velocity_after - exact.velocity).norm() / speed,
                         (row.impact.angular_velocity_after - exact.angular_velocity).norm() / rate}));
  }
  return worst.value();
}

Measured against_scenes(CaseRuns&) {
  const auto scenes =
      oracle::reference_scenes(reference_words("space_scenes.csv"), reference_words("space_sequences.csv"));
  WorstError worst;
  std::size_t impacts = 0;
  std::string where;
  for (const oracle::ReferenceScene& scene : scenes) {
    impacts += scene.impacts.size();
    if (worst.take(scene_error(scene) / scene.tolerance)) where = scene.name;
  }
  return {static_cast<double>(impacts), worst.value(), Finding::holds,
          fmt::format("of {} scenes, each corner right; worst: {}", scenes.size(), where)};
}

/// A solid block of width tan α and height 1 that rocks from one edge of its foot to the other without rebound.
Measured rocking_block(CaseRuns&) {
  WorstError worst;
  double part = 0;
  for (const double slenderness : {0.05, 0.2, 0.4, 0.6}) {
    const Body block = box(2.5, {.size = {slenderness, 0.3, 1}});
    std::vector<Corner> foot;
    for (int i = 0; i < 8; i += 2) foot.push_back({i, block.vertices[static_cast<std::size_t>(i)]});
    State before;
    before.angular_velocity = {0, -0.7, 0};  // about the corners at x > 0; those at x < 0 come down
    before.velocity = -before.angular_velocity.cross(Vector3(slenderness / 2, 0, -0.5));
    const analytic::ImpactLaw rough{.restitution = 0, .friction = FrictionKind::coulomb, .friction_value = 10};
    const double sine = std::sin(std::atan(slenderness));
    part = strike_together(block, before, foot, rough).angular_velocity_after.y() / before.angular_velocity.y();
    worst.take(std::fabs(part - (1 - 1.5 * sine * sine)));
  }
  return {part, worst.value(), Finding::holds, "tan α = 0.05, 0.2, 0.4, 0.6; the number is that of 0.6"};
}

Vector3 random_vector(Uniform& random, double size) {
  const double x = random(-size, size), y = random(-size, size), z = random(-size, size);
  return {x, y, z};
}

/// A box with its mass off the middle in any attitude, friction and any law of restitution, on one corner.
Drop random_drop(int index) {
  constexpr std::uint64_t family = 11;
  Uniform random(family, index);
  Drop drop;
  const Vector3 size(1, random(0.3, 1), random(0.1, 0.6));
  drop.body = box(random(0.5, 1.5), {.size = size, .centre = random(-0.2, 0.2) * size});
  drop.attitude = Quaternion(random(-1, 1), random(-1, 1), random(-1, 1), random(-1, 1)).normalized();
  drop.velocity = Vector3(random(-1, 1), random(-1, 1), random(-3, -2));
  drop.angular_velocity = random_vector(random, 1);
  drop.gravity = random.one_in(3) ? 0 : 9.81;
  drop.law = {.restitution = random(0.3, 1),
              .law = std::array{RestitutionLaw::newton, RestitutionLaw::poisson,
                                RestitutionLaw::stronge}[static_cast<std::size_t>(index % 3)]};
  if (random.one_in(2)) return drop;
  drop.law.friction = FrictionKind::coulomb;
  drop.law.friction_value = random(0, 1.5);
  return drop;
}

constexpr int drops = 200, impacts_of_drop = 3;

/// Angular momentum about the corner that strikes, and work against energy.
Measured kept_by_an_impact(CaseRuns&) {
  WorstError worst;
  int impacts = 0;
  for (int index = 0; index < drops; ++index) {
    const Drop drop = random_drop(index);
    for (const ImpactRow& row : impact_sequence(drop, {.impacts = impacts_of_drop, .amplification = false}).rows) {
      if (row.corners.size() != 1) continue;
      ++impacts;
      const Matrix3 axes = row.before.attitude.toRotationMatrix();
      const Matrix3 inertia = axes * drop.body.inertia * axes.transpose();
      const Vector3 arm = -(axes * row.corners.front().place);  // from the corner to the centre of mass
      const auto momentum = [&](const Vector3& v, const Vector3& w) {
        return Vector3(arm.cross(drop.body.mass * v) + inertia * w);
      };
      const Vector3 before = momentum(row.before.velocity, row.before.angular_velocity);
      const Vector3 after = momentum(row.impact.velocity_after, row.impact.angular_velocity_after);
      const double size =
          drop.body.mass * arm.norm() * (row.before.velocity.norm() + row.impact.velocity_after.norm()) +
          (inertia * row.impact.angular_velocity_after).norm();
      worst.take((after - before).norm() / size);
      const double loss = row.energy_before - row.energy_after;
      worst.take(std::fabs(loss - row.impact.energy_loss) / row.energy_before);
    }
  }
  return {static_cast<double>(impacts), worst.value(), Finding::holds,
          "angular momentum about the corner; work and energy"};
}

/// A quarter turn and more about the vertical, and the mirror image in the plane y = 0.
struct Symmetry {
  Matrix3 of_vectors = Matrix3::Identity();
  bool mirrors = false;

  [[nodiscard]] Vector3 velocity(const Vector3& v) const { return of_vectors * v; }
  [[nodiscard]] Vector3 rate(const Vector3& w) const { return of_vectors * (mirrors ? Vector3(-w) : w); }
  [[nodiscard]] Drop of(Drop drop) const {
    drop.velocity = velocity(drop.velocity);
    drop.angular_velocity = rate(drop.angular_velocity);
    if (!mirrors) {
      drop.attitude = Quaternion(Matrix3(of_vectors)) * drop.attitude;
      return drop;
    }
    const Quaternion& q = drop.attitude;
    drop.attitude = Quaternion(q.w(), -q.x(), q.y(), -q.z());
    drop.body.inertia = of_vectors * drop.body.inertia * of_vectors;
    for (Vector3& vertex : drop.body.vertices) vertex = of_vectors * vertex;
    return drop;
  }
};

/// Takes the distance of two runs over what rounding, grown by the sequence, makes of them.
void take_asymmetry(WorstError& worst, const Drop& drop, const Symmetry& symmetry) {
  const Sequence run = impact_sequence(drop, {.impacts = impacts_of_drop});
  const Sequence other = impact_sequence(symmetry.of(drop), {.impacts = impacts_of_drop});
  for (std::size_t i = 0; i < run.rows.size() && run.rows[i].error.predictable; ++i) {
    if (i >= other.rows.size()) return static_cast<void>(worst.take(INFINITY));
    const analytic::space::Impact &a = run.rows[i].impact, &b = other.rows[i].impact;
    const double apart = worst_of({(b.impulse - symmetry.velocity(a.impulse)).norm() / a.impulse.norm(),
                                   (b.velocity_after - symmetry.velocity(a.velocity_after)).norm() / 3,
                                   (b.angular_velocity_after - symmetry.rate(a.angular_velocity_after)).norm() /
                                       (1 + a.angular_velocity_after.norm())});
    worst.take(apart / std::max(1.0, run.rows[i].amplification));
  }
}

Measured symmetries(CaseRuns&) {
  WorstError worst;
  const Symmetry turn{.of_vectors = Eigen::AngleAxisd(2.1, Vector3::UnitZ()).toRotationMatrix()};
  const Symmetry mirror{.of_vectors = Vector3(1, -1, 1).asDiagonal(), .mirrors = true};
  for (int index = 0; index < drops; ++index) {
    const Drop drop = random_drop(index);
    take_asymmetry(worst, drop, turn);
    take_asymmetry(worst, drop, mirror);
  }
  return {2 * drops, worst.value(), Finding::holds,
          "turned by 2.1 rad about the vertical, and mirrored; 3 impacts each"};
}

Measured path_of_friction(CaseRuns&) {
  WorstError worst;
  int paths = 0;
  for (int index = 0; index < 20 * drops; ++index) {
    const Drop drop = random_drop(index);
    const State before{.attitude = drop.attitude, .velocity = drop.velocity, .angular_velocity = drop.angular_velocity};
    const Vector3 place = drop.body.vertices[static_cast<std::size_t>(index % 8)];
    const Matrix3 axes = drop.attitude.toRotationMatrix();
    const ContactVelocity velocity = contact_velocity(before, place);
    if (!(velocity.value.z() < 0)) continue;
    const analytic::space::Impact impact = strike(drop.body, before, place, drop.law);
    if (impact.path != PathKind::turning_slip || !(impact.least_slip > 0.1 * velocity.value.norm())) continue;
    ++paths;
    const Matrix3 inverse =
        inverse_contact_inertia(drop.body.mass, axes * drop.body.inertia.inverse() * axes.transpose(), axes * place);
    const oracle::SteppedImpact<long double> exact(
        analytic::space::Contact{
            .inverse_inertia = inverse, .velocity = velocity.value, .velocity_scale = velocity.scale},
        drop.law);
    worst.take(worst_of({(impact.contact_after - exact.velocity().cast<double>()).norm() / velocity.value.norm(),
                         (impact.impulse - exact.impulse().cast<double>()).head<2>().norm() / impact.impulse.norm()}));
  }
  return {static_cast<double>(paths), worst.value(), Finding::holds,
          "paths along which slip turns and stays above a tenth"};
}

/// The same planar body for both models: four vertices in the plane, free to leave it.
struct PlanarPair {
  analytic::Drop planar;
  Drop in_space;
};
PlanarPair planar_pair(int index) {
  Uniform random(12, index);
  PlanarPair pair;
  analytic::Drop& planar = pair.planar;
  planar.body = analytic::make_box({.mass = 1, .length = 1, .width = 1, .thickness = random(0.05, 0.8)});
  planar.inclination = analytic::Angle::from_degrees(random(1, 89));
  planar.velocity = {.normal = random(-1.2, -0.2), .tangential = random(-1, 1), .angular = random(-0.3, 0.3)};
  planar.gravity = random.one_in(3) ? 0 : random(0, 10);
  planar.law = {.restitution = random(0.3, 1), .law = RestitutionLaw::stronge};
  planar.law.friction = FrictionKind::coulomb;
  planar.law.friction_value = random(0, 1);
  Body body{.mass = 1, .inertia = Vector3(0.7, 1, 0.9).asDiagonal(), .vertices = {}, .rims = {}};
  body.inertia *= planar.body.mass * planar.body.gyration_square;
  for (const analytic::Vertex& v : planar.body.vertices) body.vertices.emplace_back(v.x, 0, v.z);
  pair.in_space = in_space(planar, body);
  return pair;
}

Measured planar_model(CaseRuns&) {
  WorstError worst;
  std::size_t impacts = 0;
  for (int index = 0; index < drops; ++index) {
    const PlanarPair pair = planar_pair(index);
    const auto planar = impact_sequence(pair.planar, {.impacts = impacts_of_drop});
    const Sequence flown = impact_sequence(pair.in_space, {.impacts = impacts_of_drop});
    for (std::size_t i = 0; i < flown.rows.size() && flown.rows[i].error.predictable; ++i) {
      if (i >= planar.rows.size()) return {static_cast<double>(impacts), INFINITY, Finding::refuted, "an impact more"};
      ++impacts;
      const analytic::Impact& a = planar.rows[i].impact;
      const analytic::space::Impact& b = flown.rows[i].impact;
      const double apart = worst_of({std::fabs(b.impulse.z() - a.normal_impulse),
                                     std::fabs(b.impulse.x() - a.tangential_impulse), std::fabs(b.impulse.y()),
                                     (b.velocity_after - Vector3(a.after.tangential, 0, a.after.normal)).norm(),
                                     (b.angular_velocity_after - Vector3(0, a.after.angular, 0)).norm()});
      worst.take(apart / std::max(1.0, flown.rows[i].amplification));
    }
  }
  return {static_cast<double>(impacts), worst.value(), Finding::holds,
          "boxes of 1 kg and 1 m that fall with about 1 m/s"};
}

}  // namespace

CheckMeasures space_measures() {
  return {{"S1", against_scenes}, {"S2", rocking_block},    {"S3", kept_by_an_impact},
          {"S4", symmetries},     {"S5", path_of_friction}, {"S6", planar_model}};
}

}  // namespace clatter::validation
