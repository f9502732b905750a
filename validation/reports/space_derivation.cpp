// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/reports/space_derivation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "analytic/space/free_flight.hpp"
#include "analytic/space/point_height.hpp"
#include "validation/scene/discrete_scene.hpp"

namespace clatter::validation::inline reports {
namespace {

namespace space = analytic::space;
using space::Vector3;

void write_first_touch(const ImpactInSpace& impact, StepWriter& writer) {
  const space::State& before = impact.row().before;
  std::vector<int> corners;
  for (const space::Corner& corner : impact.row().corners) corners.push_back(corner.index);
  writer.open("The first touch", fmt::format("The body touches the ground with {}.", impact.corner_names(corners)));
  const space::Quaternion& q = before.attitude;
  const double parts[]{q.w(), q.x(), q.y(), q.z()};
  const char* const names[]{"q₀", "q₁", "q₂", "q₃"};
  for (int k = 0; k < 4; ++k) {
    writer.add({.name = names[k], .formula = "Euler parameter, body to world", .value = parts[k], .size = 1});
  }
  writer.add({.name = "z", .formula = "height of the centre of mass", .value = before.position.z(), .unit = "m"});
  writer.add_vector("V", "", "velocity of the centre of mass", before.velocity, "m/s");
  writer.add_vector("ω", "", "angular velocity before", before.angular_velocity, "rad/s");
}

void write_steady_rotation(const Vector3& rate, const Vector3& momentum, double time, StepWriter& writer) {
  writer.open("Rotation without torque", "The body turns about a fixed axis, ω constant.");
  writer.add({.name = "2T", .formula = "ω·I ω", .value = rate.dot(momentum), .unit = "J"});
  writer.add({.name = "L", .formula = "|I ω|", .value = momentum.norm(), .unit = "kg·m²/s"});
  writer.add({.name = "φ",
              .formula = "|ω| T",
              .numbers = fmt::format("{}·{}", writer.number(rate.norm()), writer.number(time)),
              .value = rate.norm() * time,
              .unit = "rad"});
}

void write_rotation(const ImpactInSpace& impact, StepWriter& writer) {
  const space::State& start = impact.previous().before;
  const space::FreeRotation rotation(space::PrincipalAxes(impact.drop.body.inertia), start.attitude,
                                     impact.previous().impact.angular_velocity_after);
  const Vector3 rate = rotation.angular_velocity(0);
  const Vector3 momentum = impact.drop.body.inertia * rate;
  const double time = impact.row().flight.time;
  const char* const unit = "kg·m²/s";
  if (rotation.is_steady()) return write_steady_rotation(rate, momentum, time, writer);
  const space::ThetaRotation& theta = *rotation.theta();
  writer.open("Rotation without torque",
              "2T and L are constant.  In principal axes, numbered so that L circles axis 3, ω follows Jacobi's "
              "elliptic functions of modulus k, and repeats after the period 4K(k)/λ.");
  const Vector3& i = theta.moments();
  const char* const names[]{"I₁", "I₂", "I₃"};
  for (int k = 0; k < 3; ++k) {
    writer.add({.name = names[k], .formula = "principal moment", .value = i[k], .unit = "kg·m²"});
  }
  const double energy = rate.dot(momentum), size = i.maxCoeff() * energy;
  writer.add(
      {.name = "2T", .formula = "ω·I ω", .numbers = writer.product(rate, momentum), .value = energy, .unit = "J"});
  writer.add({.name = "L", .formula = "|I ω|", .value = theta.momentum(), .unit = unit});
  const double l2 = theta.momentum() * theta.momentum();
  writer.add({.name = "k²",
              .formula = "|I₁ − I₂| |2T I₃ − L²|/(|I₂ − I₃| |L² − 2T I₁|)",
              .numbers = fmt::format("{}·{}/({}·{})", writer.number(std::fabs(i[0] - i[1]), i.maxCoeff()),
                                     writer.number(std::fabs(energy * i[2] - l2), size),
                                     writer.number(std::fabs(i[1] - i[2]), i.maxCoeff()),
                                     writer.number(std::fabs(l2 - energy * i[0]), size)),
              .value = theta.modulus_square(),
              .size = 1});
  writer.add({.name = "period", .formula = "4K/λ, of ω in the body", .value = theta.period(), .unit = "s"});
  writer.add({.name = "periods", .formula = "flown, T over the period", .value = time / theta.period()});
}

/// The corner, not among those that arrive, that is lowest then.
void write_next_corner(const ImpactInSpace& impact, StepWriter& writer) {
  const space::Body& body = impact.drop.body;
  const space::State& now = impact.row().before;
  double least = std::numeric_limits<double>::infinity();
  int next = 0;
  for (int point = 0; point < static_cast<int>(body.vertices.size() + body.rims.size()); ++point) {
    const std::vector<space::Corner>& arrived = impact.row().corners;
    const auto is_it = [&](const space::Corner& corner) { return corner.index == point; };
    if (std::any_of(arrived.begin(), arrived.end(), is_it)) continue;
    const double height = now.position.z() + (now.attitude * space::touching_place(body, now.attitude, point)).z();
    if (height < least) least = height, next = point;
  }
  if (!std::isfinite(least)) return;
  writer.add({.name = "h next",
              .formula = fmt::format("height then of {}, the lowest of the others", impact.corner_names({next})),
              .value = least,
              .unit = "m",
              .size = body.reach()});
}

/// Of the centre of mass and of the corner that arrives.
void write_heights(const ImpactInSpace& impact, StepWriter& writer) {
  const space::ImpactRow& row = impact.row();
  const space::State& start = impact.previous().before;
  const double fall = impact.previous().impact.velocity_after.z(), g = impact.drop.gravity, t = row.flight.time;
  const double reach = impact.drop.body.reach();
  writer.add({.name = "z",
              .formula = "z + V_z T − g T²/2",
              .numbers = fmt::format("{} + {}·{} − {}·{}²/2", writer.number(start.position.z()), writer.number(fall),
                                     writer.number(t), writer.number(g), writer.number(t)),
              .value = row.before.position.z(),
              .unit = "m",
              .size = reach});
  const double low = (row.before.attitude * row.corners.front().place).z();
  const double centre = start.position.z() + t * (fall - g / 2 * t);
  writer.add({.name = "h(T)",
              .formula = "z + e·r",
              .numbers = fmt::format("{} + {}", writer.number(centre), writer.number(low)),
              .value = centre + low,
              .unit = "m",
              .size = reach});
  writer.add({.name = "h′(T)", .formula = "its normal velocity", .value = row.flight.normal_velocity, .unit = "m/s"});
}

void write_earliest_corner(const ImpactInSpace& impact, StepWriter& writer) {
  const space::FirstContact& flight = impact.row().flight;
  writer.open("The earliest corner",
              fmt::format("Height of a corner at r in the body: h(t) = z + V_z t − g t²/2 + e(t)·r, e(t) the vertical "
                          "in body axes.  Certificate: the flight is cut into pieces, on each of which bounds on h and "
                          "h″ hold; before the bracket no corner comes down, within it h of {} has one root.",
                          impact.corner_names(flight.together)));
  if (flight.bracket_high < 1e300) {
    writer.add(
        {.name = "t low", .formula = "left end of the certified bracket", .value = flight.bracket_low, .unit = "s"});
    writer.add({.name = "t high", .formula = "right end", .value = flight.bracket_high, .unit = "s"});
  }
  writer.add({.name = "T",
              .formula = fmt::format("the root, after {} evaluations of the rotation", flight.evaluations),
              .value = flight.time,
              .unit = "s"});
  write_heights(impact, writer);
  write_next_corner(impact, writer);
  if (std::isfinite(flight.near_miss.clearance)) {
    writer.add({.name = "near miss",
                .formula = "least height at a turning point before, of any corner",
                .value = flight.near_miss.clearance,
                .unit = "m",
                .error = flight.near_miss.margin});
  }
}

void write_energy(const ImpactInSpace& impact, StepWriter& writer) {
  const space::ImpactRow& row = impact.row();
  const space::Matrix3 axes = row.before.attitude.toRotationMatrix();
  const space::Matrix3 inertia = axes * impact.drop.body.inertia * axes.transpose();
  const double size = std::max(row.energy_before, row.energy_after);
  const auto moving = [&](const Vector3& v) { return impact.drop.body.mass * v.squaredNorm() / 2; };
  const auto turning = [&](const Vector3& w) { return w.dot(inertia * w) / 2; };
  writer.open("Energy", "E = m V²/2 + ω·I ω/2 + m g z, z of the centre of mass above the ground.");
  const auto part = [&](const char* name, const char* formula, double value) {
    writer.add({.name = name, .formula = formula, .value = value, .unit = "J", .size = size});
  };
  part("m V²/2", "before", moving(row.before.velocity));
  part("ω·I ω/2", "before", turning(row.before.angular_velocity));
  part("m g z", "before and after", impact.drop.body.mass * impact.drop.gravity * row.before.position.z());
  part("m V′²/2", "after", moving(row.impact.velocity_after));
  part("ω′·I ω′/2", "after", turning(row.impact.angular_velocity_after));
  part("E before", "sum", row.energy_before);
  part("E after", "sum", row.energy_after);
  part("loss", row.group ? "−(P·(V + V′) + M·(ω + ω′))/2" : "−P·(v + v′)/2", row.impact.energy_loss);
}

}  // namespace

std::string ImpactInSpace::corner_names(const std::vector<int>& corners) const {
  std::string names;
  for (const int index : corners) {
    const Vector3 place = space::touching_place(drop.body, row().before.attitude, index);
    names += (names.empty() ? "" : ", ") + corner_name(scene, {index, place});
  }
  return (corners.size() == 1 ? "corner " : "corners ") + names;
}

double ImpactInSpace::relative_error() const {
  const space::RowErrors& error = row().error;
  if (!error.predictable) return std::numeric_limits<double>::infinity();
  const space::Impact& struck = row().impact;
  const double speed = std::max({row().before.velocity.norm(), struck.velocity_after.norm(), row().approach_speed});
  const double rate =
      std::max({row().before.angular_velocity.norm(), struck.angular_velocity_after.norm(), speed / drop.body.reach()});
  const double time = row().flight.time;
  return std::max({error.attitude, error.approach_speed / speed, error.velocity_after / speed,
                   error.angular_velocity_after / rate, time > 0 ? error.start / time : 0,
                   struck.impulse.norm() > 0 ? error.impulse / struck.impulse.norm() : 0});
}

std::vector<Step> derive_impact(const Scene& scene, const space::Drop& drop, const space::Sequence& sequence, int n) {
  const ImpactInSpace impact{scene, drop, sequence, n};
  StepWriter writer(scene.accuracy.digits, impact.relative_error());
  if (n == 1) write_first_touch(impact, writer);
  else write_flight(impact, writer);
  if (impact.row().group) write_group_impact(impact, writer);
  else write_corner_impact(impact, writer);
  write_energy(impact, writer);
  return writer.take();
}

void write_flight(const ImpactInSpace& impact, StepWriter& writer) {
  const space::Impact& last = impact.previous().impact;
  writer.open(fmt::format("The flight to impact {}", impact.n),
              fmt::format("After impact {} the body flies freely: its centre of mass along a parabola, its attitude "
                          "by a rotation without torque.",
                          impact.n - 1));
  writer.add({.name = "z",
              .formula = "height of the centre of mass at departure",
              .value = impact.previous().before.position.z(),
              .unit = "m"});
  writer.add_vector("V", "", "after the last impact", last.velocity_after, "m/s");
  writer.add_vector("ω", "", "after the last impact", last.angular_velocity_after, "rad/s");
  write_rotation(impact, writer);
  write_earliest_corner(impact, writer);
  writer.open("At the touch", "Velocities and attitude as the corner comes down.");
  const space::State& now = impact.row().before;
  writer.add_vector("V", "", "velocity of the centre of mass", now.velocity, "m/s");
  writer.add_vector("ω", "", "angular velocity", now.angular_velocity, "rad/s");
}

}  // namespace clatter::validation::inline reports
