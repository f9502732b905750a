// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/benchmark/cause.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "analytic/base/angle.hpp"
#include "validation/benchmark/motion.hpp"
#include "validation/output/number.hpp"

namespace clatter::validation {
namespace {

namespace space = analytic::space;
using space::State;
using space::Vector3;

using analytic::degrees_per_radian;

/// The number of degrees that is asked for, as phi in radians.
void add_degrees(const Motion& motion, const Reference& reference, std::vector<Cause>& causes) {
  const auto column = motion.table().column("phi");
  if (!column) return;
  const double phi = motion.table().at(0, *column);
  const State asked = asked_at_height(reference, motion.state(0).position.z());
  const double angle = inclination_of(asked);
  const double left = std::fabs(phi / degrees_per_radian - angle);
  if (!(std::fabs(angle) > reference.tolerances[2]) || !(left <= reference.tolerances[2] * std::fabs(angle))) return;
  causes.push_back(
      {"start-degrees", phi, left,
       fmt::format("phi at the start is {} rad: the angle that is asked for, but in degrees", significant(phi, 4))});
}

/// Which part of the state at the start is another one.
void add_start(const Motion& motion, const Reference& reference, double left_after, std::vector<Cause>& causes) {
  if (!(left_after <= explained * std::fmin(motion.start_error(), 1))) return;
  const State first = motion.state(0);
  const State start = asked_at_height(reference, first.position.z());
  const auto angle = [](const State& state) {
    return std::remainder(inclination_of(state), 2 * std::numbers::pi) * degrees_per_radian;
  };
  const double turned = 2 * (first.attitude.conjugate() * start.attitude).vec().norm();
  const double spin = reference.reach() * (first.angular_velocity - start.angular_velocity).norm() / reference.speed();
  const double speed = (first.velocity - start.velocity).norm() / reference.speed();
  const double most = std::max({turned, spin, speed});
  const auto alone = [&](double part) { return part == most && turned + spin + speed - part <= explained * part; };
  const double left = turned + spin + speed - most;
  if (alone(turned)) {
    const std::string words =
        reference.is_planar
            ? fmt::format("at {}° and not at {}°", significant(angle(first), 4), significant(angle(start), 4))
            : fmt::format("turned by {}°", three_digits(turned * degrees_per_radian));
    causes.push_back({"start-angle", reference.is_planar ? angle(first) : turned * degrees_per_radian, left,
                      "the body starts " + words});
  } else if (alone(spin)) {
    const double rate = (first.angular_velocity - start.angular_velocity).norm();
    causes.push_back(
        {"start-spin", rate, left, fmt::format("the body starts with {} rad/s more or less", three_digits(rate))});
  } else if (alone(speed)) {
    const double factor = first.velocity.norm() / start.velocity.norm();
    const std::string words = std::fabs(factor - 1) <= reference.tolerances[2]
                                  ? "a velocity of another direction"
                                  : fmt::format("{} times the speed", significant(factor, 4));
    causes.push_back({"start-speed", factor, left, "the body starts with " + words});
  }
}

/// A planar body of another size along one of its axes.
struct Size {
  int axis;              ///< 0: length, 2: thickness or radius
  bool inertia_follows;  ///< or is the one asked for
  double half = 0;       ///< of the body asked for [m]
  double factor = 1;
};

Vector3 half_size(const space::Body& body) {
  Vector3 half = Vector3::Zero();
  for (const Vector3& vertex : body.vertices) half = half.cwiseMax(vertex.cwiseAbs());
  return half;
}

/// Moment of inertia about y by a body's extent along its length, and what is left by that across it [kg m²].
std::pair<double, double> parts_of_inertia(const space::Body& body) {
  const double half = half_size(body).x(), along = body.mass * half * half / 3;
  return {along, body.inertia(1, 1) - along};
}

Reference with_size(const Reference& reference, const Size& size) {
  Reference other = reference;
  for (Vector3& vertex : other.body.vertices) vertex[size.axis] *= size.factor;
  if (!size.inertia_follows) return other;
  const auto [along, across] = parts_of_inertia(reference.body);
  const double square = size.factor * size.factor;
  other.scale_inertia((size.axis == 0 ? along * square + across : along + across * square) / (along + across));
  return other;
}

/// "thickness 0.2 m (0.1 m is asked)", and the first number.
std::pair<std::string, double> named_size(const space::Body& body, const Size& size) {
  const double across = parts_of_inertia(body).second, square = body.mass * size.half * size.half;
  const bool is_round = size.axis == 2 && std::fabs(across - square / 4) < std::fabs(across - square / 3);
  const double whole = is_round ? size.half : 2 * size.half;
  return {fmt::format("{} {} m ({} m is asked){}",
                      size.axis == 0 ? "length"
                      : is_round     ? "radius"
                                     : "thickness",
                      three_digits(whole * size.factor), shortest(whole),
                      size.inertia_follows ? "" : " with the moment of inertia asked for"),
          whole * size.factor};
}

/// What impacts leave of another size; unknown where they are not at the ground.
double size_misfit(const NumericTable& table, const Reference& other, const DeclaredLaw& law) {
  const Motion motion(table, other);
  std::vector<FoundImpact> impacts = impacts_of(motion, other);
  impacts.resize(std::min(impacts.size(), other.sequences.front().truth.size()));
  double left = impacts.empty() ? Score::unknown : 0;
  for (const FoundImpact& impact : impacts) {
    left = worse(left, law_error(other, law, impact));
    if (impact.points.empty()) return Score::unknown;
    const double approach = other.velocity(impact.before, impact.points.front()).norm();
    const double least = other.tolerances[1] * other.reach();
    if (!(std::fabs(other.height(impact.before, impact.points.front())) <= least + 2 * motion.step() * approach))
      return Score::unknown;
  }
  return left;
}

/// Whether the lowest point is at the ground, or was or will be within a step.
bool is_at_ground(const Reference& reference, const State& state, double step) {
  const int point = reference.lowest(state.attitude);
  const double approach = std::fabs(reference.velocity(state, point).z());
  return std::fabs(reference.height(state, point)) <= 1e-6 * reference.reach() + step * approach;
}

bool is_symmetric(const space::Body& body) {
  Vector3 sum = Vector3::Zero();
  for (const Vector3& vertex : body.vertices) sum += vertex;
  return sum.norm() <= 1e-12 * body.reach();
}

}  // namespace

std::vector<Cause> start_causes_of(const Motion& motion, const Reference& reference, double left_after) {
  std::vector<Cause> causes;
  if (motion.begins_after_touch() || !(motion.start_error() > reference.tolerances[1])) return causes;
  add_degrees(motion, reference, causes);
  if (causes.empty()) add_start(motion, reference, left_after, causes);
  return causes;
}

std::vector<Cause> size_causes_of(const Motion& motion, const Reference& reference, const DeclaredLaw& law,
                                  const FoundImpact& first, double law_left) {
  if (!reference.is_planar || reference.is_compliant || reference.ground_end || !is_symmetric(reference.body))
    return {};
  if (is_at_ground(reference, first.before, motion.step())) return {};
  const Vector3 half = half_size(reference.body);
  const Vector3 up = first.before.attitude.conjugate() * Vector3::UnitZ();  // in the body's axes
  const double height = first.before.position.z();
  std::vector<Cause> causes;
  for (const int axis : {0, 2}) {
    const double other = half[2 - axis] * std::fabs(up[2 - axis]), share = half[axis] * std::fabs(up[axis]);
    double factor = (height - other) / share;
    // A code of steps strikes a body without thickness up to a step's fall too low.
    const double fall = std::fabs(first.before.velocity.z()) + first.before.angular_velocity.norm() * reference.reach();
    if (axis == 2 && std::fabs(factor) * share <= motion.step() * fall + 1e-9 * reference.reach()) factor = 0;
    if (!(share > 1e-6 * reference.reach()) || !(factor == 0 || (factor > 0.1 && factor < 10))) continue;
    for (const bool inertia_follows : {true, false}) {
      const Size size{.axis = axis, .inertia_follows = inertia_follows, .half = half[axis], .factor = factor};
      const double left = size_misfit(motion.table(), with_size(reference, size), law);
      constexpr double least = 1e-4;  // less is no other size
      if (!(std::fabs(factor - 1) > least)) continue;
      if (!(left <= explained * std::min({law_left, std::fabs(factor - 1), 1.0}))) continue;
      const auto [words, value] = named_size(reference.body, size);
      causes.push_back({"size", value, left, fmt::format("{} explains the impacts {}", words, misfit_words(left))});
    }
  }
  return causes;
}

}  // namespace clatter::validation
