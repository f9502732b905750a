// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/space/sequence/last_motion.hpp"

#include <algorithm>
#include <cmath>

#include "analytic/base/limits.hpp"
#include "analytic/space/flight/point_height.hpp"
#include "analytic/space/landing/face_slide.hpp"

namespace clatter::analytic::space {

using detail::infinite;

namespace {

/// What is left of a number that is zero but for rounding, relative; of velocities, to a fall by the size of the body.
constexpr double nothing = 1e-12;

/// The turn that a rotation at ω₀ + α t makes, by Magnus's series to the fourth order in steps of a hundredth.
Quaternion turned(const Vector3& rate, const Vector3& change, double time) {
  constexpr double step = 0.01;
  const Vector3 all = time * (rate + time / 2 * change);
  if (rate.cross(change) == Vector3::Zero()) return turn_by(all);
  const int steps = 1 + static_cast<int>(std::fmin(1e6, time * (rate.norm() + time * change.norm()) / step));
  const double h = time / steps;
  Quaternion turn = Quaternion::Identity();
  for (int i = 0; i < steps; ++i) {
    const Vector3 now = rate + i * h * change;
    turn = turn_by(h * (now + h / 2 * change) + h * h * h / 12 * change.cross(now)) * turn;
  }
  return turn.normalized();
}

}  // namespace

GroundedMotion::GroundedMotion(const Drop& drop, const State& now, const std::vector<int>& touching)
    : drop_(drop), now_(now), friction_(drop.law.most_friction()) {
  const ImpactLaw& law = drop.law;
  const bool has_force = law.friction != FrictionKind::impulse_ratio || law.friction_value == 0;
  if (!(drop.gravity > 0) || !has_force || touching.empty()) return;
  const Body& body = drop.body;
  const double fall = std::sqrt(drop.gravity * body.reach());
  now_.velocity.z() = 0;
  if (now_.velocity.norm() <= nothing * fall) now_.velocity.setZero();
  if (std::fabs(now_.angular_velocity.z()) * body.reach() <= nothing * fall) now_.angular_velocity.z() = 0;
  if (body.is_ball()) {
    roll(now_.position.z(), body.inertia(0, 0));
  } else if (const auto radius = mantle()) {
    const Vector3 axis = body.round(0).axis;
    roll(*radius, axis.dot(body.inertia * axis));
  } else {
    lie(touching);
  }
}

/// The radius on which a body of revolution lies with its axis level, moving across that and turning about it.
std::optional<double> GroundedMotion::mantle() const {
  const Body& body = drop_.body;
  if (!body.transverse_moment() || body.points() < 2 || body.rims.empty()) return {};
  const Vector3 axis = now_.attitude * body.rims.front().axis;
  const Vector3 &v = now_.velocity, &w = now_.angular_velocity;
  const auto lies = [&](int i) {
    const Vector3 place = touching_place(body, now_.attitude, i);
    return std::fabs(now_.position.z() + (now_.attitude * place).z()) <= 1e-9 * body.reach();
  };
  for (int i = 0; i < 2; ++i) {
    if (!lies(i)) return {};
  }
  const bool moves_across = std::fabs(v.dot(axis)) <= nothing * v.norm() && w.cross(axis).norm() <= nothing * w.norm();
  return moves_across ? std::optional(now_.position.z()) : std::nullopt;
}

State GroundedMotion::after(const Piece& piece, double time) {
  State s = piece.state;
  s.position += time * (s.velocity + time / 2 * piece.acceleration);
  s.attitude = (turned(s.angular_velocity, piece.turning, time) * s.attitude).normalized();
  s.velocity += time * piece.acceleration;
  s.angular_velocity += time * piece.turning;
  return s;
}

std::optional<State> GroundedMotion::at(double time) const {
  if (!face_) {
    const auto later = std::ranges::find_if(pieces_, [&](const Piece& p) { return p.begin > time; });
    const Piece& piece = *std::prev(later);
    return after(piece, time - piece.begin);
  }
  const auto slid = slide_and_spin(*face_, area_, time);
  if (!slid) return {};
  State s = now_;
  s.position.head<2>() += slid->way;
  s.attitude = (turn_by(slid->turn * Vector3::UnitZ()) * s.attitude).normalized();
  s.velocity = {slid->slip.x(), slid->slip.y(), 0};
  s.angular_velocity = {0, 0, slid->spin};
  return s;
}

void GroundedMotion::summarise(LastMotion::Kind kind, double duration) {
  if (!face_ && pieces_.empty()) pieces_.push_back({.state = now_});
  summary_ = LastMotion{.kind = kind, .state = now_, .duration = duration};
  const auto end = duration < infinite ? at(duration) : std::optional(now_);
  if (!end) return summary_.reset();
  summary_->distance = duration < infinite ? (end->position - now_.position).norm() : infinite;
  summary_->velocity_after = end->velocity;
  summary_->angular_velocity_after = end->angular_velocity;
}

void GroundedMotion::roll(double radius, double moment) {
  if (drop_.gravity_along != 0) return;
  const double inverse = drop_.body.mass * radius * radius / moment;
  const Vector3 up = Vector3::UnitZ();
  Vector3 slip = now_.velocity - radius * now_.angular_velocity.cross(up);
  slip.z() = 0;
  const bool moves = now_.velocity.norm() > 0 || now_.angular_velocity.head<2>().norm() > 0;
  const bool slips = slip.norm() > nothing * (now_.velocity.norm() + radius * now_.angular_velocity.norm());
  pieces_.push_back({.state = now_});
  if (!moves && now_.angular_velocity.z() == 0) return summarise(LastMotion::Kind::rests, 0);
  if (!moves) return summarise(LastMotion::Kind::spins, infinite);
  if (slips && friction_ == 0) return summarise(LastMotion::Kind::slides, infinite);
  if (!slips) return summarise(LastMotion::Kind::rolls, 0);
  const Vector3 along = slip.normalized();
  const double time = slip.norm() / (friction_ * drop_.gravity * (1 + inverse));
  pieces_[0].acceleration = -friction_ * drop_.gravity * along;
  pieces_[0].turning = friction_ * drop_.gravity * inverse / radius * up.cross(along);
  pieces_.push_back({.begin = time, .state = after(pieces_[0], time)});
  summarise(LastMotion::Kind::rolls, time);
}

/// Whether the ground can push the body up at this point, from below the centre of mass.
bool GroundedMotion::carries(const Vector2& point) const {
  const double near = 1e-9 * drop_.body.reach();
  if (area_.radius > 0 || area_.corners.size() > 2) return area_.contains(point);
  if (area_.corners.size() < 2) return area_.corners.size() == 1 && (point - area_.corners[0]).norm() <= near;
  const Vector2 edge = area_.corners[1] - area_.corners[0], from = point - area_.corners[0];
  const double share = from.dot(edge) / edge.squaredNorm();
  return std::fabs(cross(edge, from)) <= near * edge.norm() && share >= 0 && share <= 1;
}

void GroundedMotion::lie(const std::vector<int>& touching) {
  const Body& body = drop_.body;
  const auto corner = touching_corner(body, now_.attitude, touching.front());
  const Vector3 middle = now_.attitude * corner.place;
  area_.radius = corner.radius;
  if (corner.radius > 0) {
    area_.corners = {Vector2(middle.head<2>())};
  } else {
    for (const int i : touching)
      area_.corners.push_back((now_.attitude * touching_place(body, now_.attitude, i)).head<2>());
    const Vector2 centre = area_.middle();
    std::ranges::sort(area_.corners, {},
                      [&](const Vector2& p) { return std::atan2(p.y() - centre.y(), p.x() - centre.x()); });
  }
  const Vector3& w = now_.angular_velocity;
  if (!(w.head<2>().norm() <= nothing * w.norm())) return;  // it does not lie still on them
  now_.angular_velocity = {0, 0, w.z()};
  if (drop_.gravity_along != 0) return slide_on_slope();
  if (w.z() != 0 && friction_ > 0) return slide_and_turn();
  slide_straight();
}

void GroundedMotion::slide_straight() {
  const double speed = now_.velocity.norm(), spin = now_.angular_velocity.z();
  const Vector3 along = speed > 0 ? Vector3(now_.velocity / speed) : Vector3::Zero();
  if (!carries(friction_ * now_.position.z() * along.head<2>())) return;
  if (speed == 0 && spin == 0) return summarise(LastMotion::Kind::rests, 0);
  if (friction_ == 0) return summarise(speed > 0 ? LastMotion::Kind::slides : LastMotion::Kind::spins, infinite);
  const double time = speed / (friction_ * drop_.gravity);
  pieces_.push_back({.state = now_, .acceleration = -friction_ * drop_.gravity * along});
  Piece rest{.begin = time, .state = after(pieces_[0], time)};
  rest.state.velocity.setZero();
  pieces_.push_back(rest);
  summarise(LastMotion::Kind::slides, time);
  summary_->distance = speed * time / 2;
}

void GroundedMotion::slide_on_slope() {
  const double pull = drop_.gravity_along, rub = friction_ * drop_.gravity, v = now_.velocity.x();
  const double held = pull / drop_.gravity * now_.position.z(), lead = friction_ * now_.position.z();
  if (now_.velocity.y() != 0 || now_.angular_velocity.z() != 0) return;
  Piece piece{.state = now_};
  double time = 0;
  if (v != 0) {
    if (!carries({std::copysign(lead, v), 0})) return;
    piece.acceleration.x() = pull - std::copysign(rub, v);
    pieces_.push_back(piece);
    if (!(piece.acceleration.x() * v < 0)) return summarise(LastMotion::Kind::slides, infinite);
    time = -v / piece.acceleration.x();
    piece = {.begin = time, .state = after(piece, time)};
    piece.state.velocity.setZero();
  }
  const bool is_held = std::fabs(pull) <= rub;
  if (!carries({is_held ? held : std::copysign(lead, pull), 0})) return;
  if (!is_held) piece.acceleration.x() = pull - std::copysign(rub, pull);
  pieces_.push_back(piece);
  if (!is_held) return summarise(LastMotion::Kind::slides, infinite);
  summarise(v != 0 ? LastMotion::Kind::slides : LastMotion::Kind::rests, time);
}

/// A spin about an axis that is no principal one rocks the body, which face_slide.hpp leaves out.
void GroundedMotion::slide_and_turn() {
  const Vector3 up = now_.attitude.conjugate() * Vector3::UnitZ(), momentum = drop_.body.inertia * up;
  const double moment = up.dot(momentum);
  if (!((momentum - moment * up).norm() <= nothing * moment)) return;
  if (area_.radius == 0 && area_.corners.size() < 3) return;
  face_ = SpinningFace{.mass = drop_.body.mass,
                       .moment = moment,
                       .depth = now_.position.z(),
                       .friction = friction_,
                       .gravity = drop_.gravity,
                       .slip = now_.velocity.head<2>(),
                       .spin = now_.angular_velocity.z()};
  const auto stop = slide_and_spin(*face_, area_, infinite);
  if (!stop || !stop->has_stopped) return face_.reset();
  summarise(now_.velocity == Vector3::Zero() ? LastMotion::Kind::spins : LastMotion::Kind::slides, stop->time);
}

}  // namespace clatter::analytic::space
