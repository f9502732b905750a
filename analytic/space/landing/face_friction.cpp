// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/space/landing/face_friction.hpp"

#include <Eigen/LU>
#include <cmath>

#include "analytic/base/limits.hpp"
#include "analytic/space/impulse/slip_motion.hpp"
#include "analytic/space/landing/face_pressure.hpp"

namespace clatter::analytic::space {

namespace {

/// Relative errors of the impulse of a landing whose pushes come near the boundary: where pressure always goes on from
/// what it was, and where it jumps, at a moment that is known to the square root of rounding.
constexpr double error_of_tilting = 1e-10, error_of_jump = 1e-5;
/// Local error of a step of such a landing.
constexpr double step_of_tilting = 1e-12;

/// What turns a face, of (1) to (3): E, J, α₀, R₀, S, B.
struct FaceTurning {
  Matrix2 held, metric;
  Vector2 mixed, point;
  Eigen::Matrix<double, 2, 3> shift;
  double inertia, drift;

  explicit FaceTurning(const SlidingFace& face)
      : held(face.inverse_inertia.topLeftCorner<2, 2>().inverse()), mixed(face.inverse_inertia.block<2, 1>(0, 2)) {
    const Vector2 moment = held * face.turn_rate, per_couple = held * mixed;
    inertia = 1 / (face.inverse_inertia(2, 2) - mixed.dot(per_couple));
    drift = mixed.dot(moment);
    point = quarter_turn(moment);
    shift << -face.depth, 0, per_couple.y(), 0, -face.depth, -per_couple.x();
    metric = turned(face.inverse_inertia.topLeftCorner<2, 2>());
  }
  /// A matrix of tilts, given for the axes of turns, for the slopes that they make.
  static Matrix2 turned(const Matrix2& a) { return (Matrix2() << a(1, 1), -a(0, 1), -a(1, 0), a(0, 0)).finished(); }
};

Vector2 drift_of_slip(const SlidingFace& face) { return face.depth * quarter_turn(face.turn_rate); }

/// A face that does not slip: where its pushes are asked for and act, and what friction and tilt do to it per P.
struct HeldFace {
  Vector2 point, beyond;  ///< x̂; R − x̂ of the moment about the centre of mass [m]
  Vector3 friction;       ///< (F, K)
};

/// The path of (U, w), in the metric of the kinetic energy: y = (√m U, √J w), and of ∫(R − x̂) dP in units of N ℓ.
class FacePath final : SlipMotion {
 public:
  FacePath(const SlidingFace& face, const ContactArea& area)
      : SlipMotion(5), face_(face), turning_(face), pressure_(area, {face.friction, turning_.point, turning_.shift}),
        root_(std::sqrt(face.mass), std::sqrt(face.mass), std::sqrt(turning_.inertia)),
        unit_(pressure_.unit() * face.normal_impulse) {
    load_ << root_[0] * drift_of_slip(face), root_[2] * turning_.drift;
    if (!(face.normal_impulse * load_.norm() > rounding())) load_.setZero();
    only_friction_ = load_ == Vector3::Zero();
    y_.head<3>() << root_[0] * face.slip, root_[2] * face.spin;
    of_beyond_ = root_.asDiagonal() * turning_.shift.transpose() * turning_.metric;
  }

  FaceFriction follow();

 private:
  Values rate(const Values& y) override;
  double impulse_left(const Values&) override { return face_.normal_impulse - spent_; }
  bool end_stage() override { return true; }
  void keep() override {
    was_at_side_ = pressure_.is_at_side();
    if (pressure_.is_near_side()) step_error_ = step_of_tilting;
    jumps_ = jumps_ || (spent_ > 0 && pressure_.has_jumped());
    pressure_.keep();
  }
  void go_back() override { pressure_.go_back(); }
  bool may_step_to(const Values& next, const Values& then, double length) override;
  [[nodiscard]] HeldFace held() const;
  bool is_held(const HeldFace& held, Vector3& direction);
  bool go_on_from_rest(const HeldFace& held);
  /// What rounding leaves of y.
  [[nodiscard]] double rounding() const { return 16 * detail::epsilon * root_[0] * face_.velocity_scale; }

  const SlidingFace& face_;
  FaceTurning turning_;
  FacePressure pressure_;
  Vector3 root_;  ///< √m, √m, √J
  double unit_;   ///< [m·N·s]
  Vector3 load_;  ///< y′ without friction
  bool was_at_side_ = false, jumps_ = false, is_lost_ = false;
  Eigen::Matrix<double, 3, 2> of_beyond_;  ///< of y′ by R − x̂
};

FacePath::Values FacePath::rate(const Values& y) {
  const auto push = pressure_.against(y.head<2>() / root_[0], y[2] / root_[2], at_once_);
  Values change(5);
  change << load_ + Vector3(push.friction.array() / root_.array()) + of_beyond_ * push.beyond, push.beyond / unit_;
  return change;
}

/// The share of friction ends its fall within a millionth of slip from where it is least: the rest is of second order.
bool FacePath::may_step_to(const Values& next, const Values& then, double length) {
  constexpr double near = 1e-6, ahead = 1e-5;
  const double size = next.head<3>().norm(), speed = then.head<3>().norm();
  if (pressure_.has_jumped()) return at_once_;
  if (!was_at_side_ || length * speed <= near * size) return true;
  if (!pressure_.is_at_side()) return false;
  const double share = pressure_.share_by_slip();
  (void)rate(next + ahead * size / speed * then);
  const bool falls = pressure_.share_by_slip() <= share;
  (void)rate(next);
  return falls;
}

/// Without slip tilting has the inertia of the body about the points that stay where they are, by which C is nearest.
HeldFace FacePath::held() const {
  const Matrix2 own = face_.inverse_inertia.inverse().topLeftCorner<2, 2>();
  const Matrix2 about_ground = own + face_.mass * face_.depth * face_.depth * Matrix2::Identity();
  const Matrix2 tilting = about_ground.inverse();
  const Vector2 asked = quarter_turn(about_ground * face_.turn_rate);
  const NearestInArea nearest(pressure_.corners(), FaceTurning::turned(tilting));
  const auto pushed = nearest.to(pressure_.in_units(asked));
  const Vector2 beyond = pressure_.unit() * (pressure_.in_units(asked) - pushed.point);
  Vector2 tilt = Vector2::Zero();
  if (!pushed.is_inside) tilt = tilting * quarter_turn(beyond);
  const Vector2 turn = face_.turn_rate + tilt;
  Vector3 friction = Vector3::Zero();
  if (!only_friction_ || !pushed.is_inside) {
    friction << -face_.mass * face_.depth * quarter_turn(turn),
        -turning_.inertia * turning_.mixed.dot(turning_.held * turn);
  }
  return {asked - beyond, -quarter_turn(turning_.held * tilt), friction};
}

/// Whether friction can hold the face under the pressure that it then has; else where slip goes.
bool FacePath::is_held(const HeldFace& held, Vector3& direction) {
  const Vector3 load = -held.friction.array() / root_.array();
  if (load == Vector3::Zero()) return true;
  pressure_.press_near(held.point);
  SlipLetGo slip(load, [&](const Vector3& y) -> Vector3 {
    return pressure_.friction_against(y.head<2>() / root_[0], y[2] / root_[2]).array() / root_.array();
  });
  const bool is_held = slip.is_held();
  direction = slip.direction();
  return is_held;
}

/// Whether the face slips to the end of the impulse; otherwise it is held, by less than it would take where it seems to
/// be let go and slip dies out.
bool FacePath::go_on_from_rest(const HeldFace& held) {
  y_.head<3>().setZero();
  Vector3 direction;
  if (is_held(held, direction)) return false;
  const Values at_rest = y_;
  const double spent = spent_;
  pressure_.begin();
  y_.head<3>() =
      first_slip * face_.normal_impulse * (held.friction.array() / root_.array()).matrix().norm() * direction;
  const End end = slide(true);
  is_lost_ = end == End::no_pressure;
  if (end == End::impulse_spent) return true;
  y_ = at_rest;
  spent_ = spent;
  return false;
}

FaceFriction FacePath::follow() {
  FaceFriction result;
  const Vector3 before = y_.head<3>();
  const bool slips = before.norm() > rounding();
  const End end = slips ? slide() : End::stopped;
  is_lost_ = end == End::no_pressure;
  if (end == End::stopped) {
    const HeldFace held = this->held();
    if (go_on_from_rest(held)) {
      result.path = slips ? PathKind::slip_reslip : PathKind::slip;
    } else {
      result.path = slips ? PathKind::slip_stick : PathKind::stick;
      y_.tail<2>() += (face_.normal_impulse - spent_) / unit_ * held.beyond;
    }
  }
  const Vector2 beyond = unit_ * y_.tail<2>();
  const Vector3 change = y_.head<3>() - before - face_.normal_impulse * load_ - of_beyond_ * beyond;
  result.impulse = root_[0] * change.head<2>();
  result.couple = root_[2] * change.z();
  result.moment = quarter_turn(beyond);
  result.has_pressure = !is_lost_;
  if (step_error_ == step_of_tilting) result.path_error = jumps_ ? error_of_jump : error_of_tilting;
  result.spin_after = y_[2] / root_[2];
  return result;
}

}  // namespace

bool slides_straight(const SlidingFace& face, const ContactArea& area) {
  constexpr double rounding = 16 * detail::epsilon;
  const FaceTurning turning(face);
  const Vector2 drift = drift_of_slip(face);
  const double radius = std::sqrt(turning.inertia / face.mass);
  const double turns = std::fabs(face.spin) + face.normal_impulse * std::fabs(turning.drift);
  if (!(turns * radius <= rounding * face.velocity_scale)) return false;
  const Vector2 line = face.slip.norm() > rounding * face.velocity_scale ? face.slip : drift;
  if (line == Vector2::Zero()) return area.contains(turning.point);
  const auto off = [&](const Vector2& v) { return std::fabs(cross(line, v)) / line.norm(); };
  const Vector2 shift = face.friction * face.depth * line.normalized();
  return face.normal_impulse * off(drift) <= rounding * face.velocity_scale &&
         off(turning.point) <= rounding * (turning.point.norm() + radius) && area.contains(turning.point + shift) &&
         area.contains(turning.point - shift);
}

FaceFriction face_friction(const SlidingFace& face, const ContactArea& area) { return FacePath(face, area).follow(); }

}  // namespace clatter::analytic::space
