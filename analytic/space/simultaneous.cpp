#include "analytic/space/simultaneous.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "analytic/contact_impulse.hpp"
#include "analytic/detail/limits.hpp"
#include "analytic/errors.hpp"
#include "analytic/space/ground_polygon.hpp"
#include "analytic/space/impulse_path.hpp"

namespace clatter::analytic::space {

using detail::epsilon;

namespace {

/// A body with its touching corners while its velocity changes and its attitude does not.
class StrikingGroup {
 public:
  StrikingGroup(const Body& body, const State& before, std::span<const Corner> touching, const Law& law)
      : body_(body), law_(law), state_(before), before_(before) {
    law.validate();
    const Matrix3 axes = before.attitude.toRotationMatrix();
    inverse_inertia_ = axes * body.inertia.inverse() * axes.transpose();
    for (const Corner& corner : touching) {
      points_.push_back({.index = corner.index, .place = corner.place, .arm = axes * corner.place});
      impact_.approach_speed = std::fmax(impact_.approach_speed, -velocity(points_.back()).z());
    }
  }

  struct Point {
    int index;
    Vector3 place, arm;
  };
  using Points = std::vector<Point>;

  [[nodiscard]] const Points& points() const { return points_; }
  [[nodiscard]] Vector3 velocity(const Point& p) const {
    return state_.velocity + state_.angular_velocity.cross(p.arm);
  }
  [[nodiscard]] bool approaches(const Point& p) const {
    const double scale = before_.velocity.norm() + before_.angular_velocity.norm() * p.arm.norm();
    return velocity(p).z() < -64 * epsilon * scale;
  }
  [[nodiscard]] Points approaching() const {
    Points some;
    std::ranges::copy_if(points_, std::back_inserter(some), [&](const Point& p) { return approaches(p); });
    return some;
  }
  /// Those that approach as fast as the fastest, to rounding.
  [[nodiscard]] Points fastest() const;

  /// Strikes with these points as a whole; false, and nothing done, if pushes alone cannot do it.
  bool strike(const Points& group);
  void strike_corner(const Point& p);
  [[nodiscard]] GroupImpact result() const;
  [[nodiscard]] std::size_t strikes() const { return impact_.order.size(); }

 private:
  bool strike_edge(const Point& first, const Point& second, const Points& group);
  bool strike_face(const Points& group);
  void push(const Vector3& impulse, const Vector3& moment, PathKind path, const Points& group);

  const Body& body_;
  const Law& law_;
  State state_, before_;
  Matrix3 inverse_inertia_;
  Points points_;
  GroupImpact impact_;
};

StrikingGroup::Points StrikingGroup::fastest() const {
  double most = 0;
  for (const Point& p : points_) most = std::fmax(most, approaches(p) ? -velocity(p).z() : 0);
  Points some;
  for (const Point& p : points_) {
    if (approaches(p) && -velocity(p).z() >= most * (1 - 1e-12)) some.push_back(p);
  }
  return some;
}

void StrikingGroup::push(const Vector3& impulse, const Vector3& moment, PathKind path, const Points& group) {
  if (impact_.order.empty()) impact_.path = path;
  impact_.impulse += impulse;
  impact_.moment += moment;
  state_.velocity += impulse / body_.mass;
  state_.angular_velocity += inverse_inertia_ * moment;
  std::vector<int>& indices = impact_.order.emplace_back();
  for (const Point& p : group) indices.push_back(p.index);
}

void StrikingGroup::strike_corner(const Point& p) {
  const Impact impact = space::strike(body_, state_, p.place, law_);
  push(impact.impulse, p.arm.cross(impact.impulse), impact.path, {p});
}

bool StrikingGroup::strike(const Points& group) {
  if (group.empty()) return false;
  std::vector<Vector2> feet;
  for (const Point& p : group) feet.push_back(p.arm.head<2>());
  const std::vector<int> hull = convex_hull(feet);
  const auto corner = [&](int i) -> const Point& {
    return group[static_cast<std::size_t>(hull[static_cast<std::size_t>(i)])];
  };
  if (hull.size() == 1) return strike_corner(corner(0)), true;
  return hull.size() == 2 ? strike_edge(corner(0), corner(1), group) : strike_face(group);
}

/// The edge strikes with the point at which the impulses of (1) have their resultant.
bool StrikingGroup::strike_edge(const Point& first, const Point& second, const Points& group) {
  const auto inverse = [&](const Point& a, const Point& b) {  // of the mass that a push at b moves at a, upwards
    const Vector3 up = Vector3::UnitZ();
    return 1 / body_.mass + a.arm.cross(up).dot(inverse_inertia_ * b.arm.cross(up));
  };
  const double mixed = inverse(first, second);
  const double u1 = -velocity(first).z(), u2 = -velocity(second).z();
  const double of_first = inverse(second, second) * u1 - mixed * u2;
  const double of_second = inverse(first, first) * u2 - mixed * u1;
  if (!(of_first >= 0 && of_second >= 0 && of_first + of_second > 0)) return false;
  const double share = of_second / (of_first + of_second);
  const Vector3 place = first.place + share * (second.place - first.place);
  const Impact impact = space::strike(body_, state_, place, law_);
  const StrikingGroup kept = *this;
  push(impact.impulse, (before_.attitude * place).cross(impact.impulse), impact.path, group);
  if (!approaches(first) && !approaches(second)) return true;
  state_ = kept.state_;
  impact_ = kept.impact_;
  return false;
}

bool StrikingGroup::strike_face(const Points& group) {
  const double speed = -state_.velocity.z();
  if (!(speed > 0)) return false;
  double depth = 0;
  std::vector<Vector2> feet;
  for (const Point& p : group) depth -= p.arm.z() / static_cast<double>(group.size()), feet.push_back(p.arm.head<2>());
  const double e = restitution_at(law_.law, speed);
  const Vector2 turn = -(1 + e) * state_.angular_velocity.head<2>();
  const Vector2 moment = inverse_inertia_.topLeftCorner<2, 2>().inverse() * turn;
  const double normal = (1 + e) * body_.mass * speed;
  const Vector3 below(0, 0, -depth);
  const Vector3 slip = state_.velocity + state_.angular_velocity.cross(below);
  const ContactImpulse whole =
      face_impulse({.mass = body_.mass,
                    .approach_speed = speed,
                    .slip = slip.head<2>(),
                    .drift = Vector2(-depth * turn.y(), depth * turn.x()) / normal,
                    .velocity_scale = state_.velocity.norm() + state_.angular_velocity.norm() * depth},
                   law_);
  const Vector3 of_friction = below.cross(whole.impulse);
  const Vector2 of_pushes = moment - of_friction.head<2>();
  const Vector2 pressure_point = Vector2(-of_pushes.y(), of_pushes.x()) / whole.impulse.z();
  if (!(margin_inside(feet, pressure_point) >= 0)) return false;
  push(whole.impulse, {moment.x(), moment.y(), 0}, whole.path, group);
  return true;
}

GroupImpact StrikingGroup::result() const {
  GroupImpact result = impact_;
  result.velocity_after = state_.velocity;
  result.angular_velocity_after = state_.angular_velocity;
  result.energy_loss = -(result.impulse.dot(before_.velocity + state_.velocity) +
                         result.moment.dot(before_.angular_velocity + state_.angular_velocity)) /
                       2;
  return result;
}

constexpr std::size_t budget = 10000;

void check_budget(std::size_t strikes) {
  if (strikes < budget) return;
  throw NumericalError("corners that touch together strike one after the other without end");
}

/// Corners strike in the order that a tilt towards `direction` gives.
GroupImpact tilted(StrikingGroup group, double direction) {
  const auto& points = group.points();
  const Vector2 rise(std::cos(direction), std::sin(direction));
  std::vector<double> height;
  for (const auto& p : points) height.push_back(rise.dot(p.arm.head<2>()));
  const double least = std::ranges::min(height);
  for (double& h : height) h -= least;
  for (;;) {
    check_budget(group.strikes());
    double soonest = std::numeric_limits<double>::infinity();
    std::size_t next = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double time = group.approaches(points[i]) ? -height[i] / group.velocity(points[i]).z() : soonest;
      if (time < soonest) soonest = time, next = i;
    }
    if (!(soonest < std::numeric_limits<double>::infinity())) break;
    for (std::size_t i = 0; i < points.size(); ++i) {
      height[i] = std::fmax(height[i] + group.velocity(points[i]).z() * soonest, 0.0);
    }
    height[next] = 0;
    group.strike_corner(points[next]);
  }
  GroupImpact result = group.result();
  result.is_whole = group.strikes() == 1;
  return result;
}

/// Outcomes nearer to each other than this part of the velocities are one.
constexpr double same_outcome = 1e-6;

/// Collects outcomes over the directions of the tilt.
class OutcomeSearch {
 public:
  OutcomeSearch(const StrikingGroup& group, double reach, const State& before)
      : group_(group), reach_(reach), scale_(before.velocity.norm() + before.angular_velocity.norm() * reach) {}

  std::vector<TiltedOutcome> search() {
    constexpr int directions = 32;
    constexpr double step = 6.283185307179586 / directions;
    constexpr double first = 0.1234567;  // no edge of a scene is likely to lie so
    std::size_t before = add(first);
    for (int i = 1; i <= directions; ++i) {
      const double direction = first + i * step;
      const std::size_t after = add(direction);
      refine({direction - step, before}, {direction, after}, 6);
      before = after;
    }
    return std::move(found_);
  }

 private:
  struct Sample {
    double direction;
    std::size_t outcome;
  };
  /// The place in found_ of what this direction gives.
  std::size_t add(double direction) {
    const GroupImpact impact = tilted(group_, direction);
    for (std::size_t i = 0; i < found_.size(); ++i) {
      const double apart = (impact.velocity_after - found_[i].impact.velocity_after).norm() +
                           reach_ * (impact.angular_velocity_after - found_[i].impact.angular_velocity_after).norm();
      if (apart <= same_outcome * scale_) return i;
    }
    found_.push_back({direction, impact});
    return found_.size() - 1;
  }
  void refine(const Sample& low, const Sample& high, int depth) {
    if (low.outcome == high.outcome || depth == 0) return;
    const double middle = (low.direction + high.direction) / 2;
    const Sample between{middle, add(middle)};
    refine(low, between, depth - 1);
    refine(between, high, depth - 1);
  }

  const StrikingGroup& group_;
  double reach_, scale_;
  std::vector<TiltedOutcome> found_;
};

}  // namespace

std::optional<GroupImpact> rebound_as_a_whole(const Body& body, const State& before, std::span<const Corner> touching,
                                              const Law& law) {
  StrikingGroup group(body, before, touching, law);
  if (!group.strike(group.approaching()) || !group.approaching().empty()) return {};
  GroupImpact result = group.result();
  result.is_whole = true;
  return result;
}

GroupImpact strike_together(const Body& body, const State& before, std::span<const Corner> touching, const Law& law) {
  if (auto whole = rebound_as_a_whole(body, before, touching, law)) return *whole;
  StrikingGroup group(body, before, touching, law);
  for (auto fastest = group.fastest(); !fastest.empty(); fastest = group.fastest()) {
    check_budget(group.strikes());
    if (!group.strike(fastest)) group.strike_corner(fastest.front());
  }
  return group.result();
}

OutcomeSet tilted_outcomes(const Body& body, const State& before, std::span<const Corner> touching, const Law& law) {
  const StrikingGroup group(body, before, touching, law);
  double reach = 0;
  for (const auto& p : group.points()) reach = std::fmax(reach, p.arm.norm());
  OutcomeSet set{.outcomes = OutcomeSearch(group, reach, before).search()};
  std::vector<GroupImpact> all{strike_together(body, before, touching, law)};
  for (const TiltedOutcome& outcome : set.outcomes) all.push_back(outcome.impact);
  for (const GroupImpact& a : all) {
    for (const GroupImpact& b : all) {
      set.velocity_spread = std::fmax(set.velocity_spread, (a.velocity_after - b.velocity_after).norm());
      set.angular_velocity_spread =
          std::fmax(set.angular_velocity_spread, (a.angular_velocity_after - b.angular_velocity_after).norm());
    }
  }
  return set;
}

}  // namespace clatter::analytic::space
