// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/space/face_friction.hpp"

#include <Eigen/LU>
#include <cmath>
#include <limits>

#include "analytic/base/limits.hpp"
#include "analytic/space/slip_motion.hpp"

namespace clatter::analytic::space {

namespace {

/// Pressure on less than this part of the area counts as pressure at its edge, where there is none.
constexpr double least_part = 1e-4;
/// What turns a face, of (1) and (2): J, α₀, and the pressure point (−M_y, M_x) without friction and per K.
struct FaceTurning {
  double inertia, drift;
  Vector2 point, point_per_couple;

  explicit FaceTurning(const SlidingFace& face) {
    const Matrix2 held = face.inverse_inertia.topLeftCorner<2, 2>().inverse();
    const Vector2 mixed = face.inverse_inertia.block<2, 1>(0, 2);
    const Vector2 moment = held * face.turn_rate, per_couple = held * mixed;
    inertia = 1 / (face.inverse_inertia(2, 2) - mixed.dot(per_couple));
    drift = mixed.dot(moment);
    point = {-moment.y(), moment.x()};
    point_per_couple = {per_couple.y(), -per_couple.x()};
  }
};

Vector2 drift_of_slip(const SlidingFace& face) { return face.depth * Vector2(-face.turn_rate.y(), face.turn_rate.x()); }

/// The path of (U, w), in the metric of the kinetic energy: y = (√m U, √J w).
class FacePath final : SlipMotion {
 public:
  FacePath(const SlidingFace& face, const ContactArea& area)
      : SlipMotion(3), face_(face), turning_(face), area_(area), pushed_(area), root_mass_(std::sqrt(face.mass)),
        root_inertia_(std::sqrt(turning_.inertia)) {
    load_ << root_mass_ * drift_of_slip(face), root_inertia_ * turning_.drift;
    if (!(face.normal_impulse * load_.norm() > rounding())) load_.setZero();
    only_friction_ = load_ == Vector3::Zero();
    y_ << root_mass_ * face.slip, root_inertia_ * face.spin;
    whole_moments_ = pushed_.moments();
    press_evenly();
    const Vector2& centre = pushed_.centre();
    rubbing_ << 1, 0, 0, 0, 1, 0, -centre.y(), centre.x(), pushed_.unit();
    rubbing_ *= -face.friction;
    shift_ << -face.depth, 0, turning_.point_per_couple.x(), 0, -face.depth, turning_.point_per_couple.y();
  }

  std::optional<FaceFriction> follow();

 private:
  Values rate(const Values& y) override;
  double impulse_left(const Values&) override { return face_.normal_impulse - spent_; }
  bool end_stage() override { return true; }
  std::optional<bool> is_held(Vector3& direction);
  /// What rounding leaves of y.
  [[nodiscard]] double rounding() const { return 16 * detail::epsilon * root_mass_ * face_.velocity_scale; }
  [[nodiscard]] bool solve(const Vector2& slip, double spin) {
    return solve(turning_.point, slip + spin * Vector2(-pushed_.centre().y(), pushed_.centre().x()), spin);
  }
  [[nodiscard]] bool solve(const Vector2& point, const Vector2& u, std::optional<double> spin,
                           const Vector2& slack = Vector2::Zero());
  [[nodiscard]] bool solve_from_even_pressure(const Vector2& slip, double spin);
  void press_evenly() { pressure_ << 1 / whole_moments_(0, 0), 0, 0; }
  void go_on_to(const Vector3& direction);

  const SlidingFace& face_;
  FaceTurning turning_;
  const ContactArea& area_;
  PressedArea pushed_;
  double root_mass_, root_inertia_;
  Vector3 load_;      ///< y′ without friction
  Vector3 pressure_;  ///< a, b, c in the units of pushed_, as they were last
  struct Solution {
    Vector3 direction = Vector3::Zero(), pressure = Vector3::Zero();
  };
  Solution last_, one_before_;       ///< at two directions of slip
  Vector3 force_ = Vector3::Zero();  ///< (F, K) with them
  Matrix3 whole_moments_, rubbing_;
  Eigen::Matrix<double, 2, 3> shift_;  ///< of the pressure point by (F, K)
};

/// Finds a, b, c and with them F, K for the slip u at the centre: linear equations on the area that is pushed, which is
/// that of the solution.  Without a spin: a, b, c that have `point` for their pressure point.
/// @param slack  that the pressure's centre, in units of pushed_, may have beside what the equations ask for
bool FacePath::solve(const Vector2& point, const Vector2& u, std::optional<double> spin, const Vector2& slack) {
  constexpr int most_turns = 40;
  constexpr double settled = 1e-7;  // where the error of Newton's method is its square
  const Vector2& centre = pushed_.centre();
  const Vector3 wanted = (Vector3() << 1, (point - centre) / pushed_.unit() + slack).finished();
  Vector3 before = pressure_;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < most_turns; ++i) {
    const bool whole = pushed_.press(pressure_);
    const Matrix3 moments = whole ? whole_moments_ : pushed_.moments();
    if (!(moments(0, 0) > least_part * whole_moments_(0, 0))) {
      pressure_ = (before + pressure_) / 2;
      continue;
    }
    Matrix3 rubs = Matrix3::Zero(), equations = moments;
    if (spin) {
      rubs = rubbing_ * pushed_.slip_moments(u, *spin * pushed_.unit());
      equations.bottomRows<2>() -= shift_ * rubs / pushed_.unit();
    }
    const double residual = (equations * pressure_ - wanted).norm();
    if (residual > least) {  // beyond the solution
      pressure_ = (before + pressure_) / 2;
      continue;
    }
    least = residual;
    const Vector3 next = equations.partialPivLu().solve(wanted);
    const bool stays_whole = whole && pushed_.press(next);
    before = pressure_;
    pressure_ = next;
    if (stays_whole || (next - before).norm() <= settled * next.norm()) {
      force_ = rubs * next;
      return true;
    }
  }
  return false;
}

/// From even pressure, with the slack that its friction needs, to a pressure without slack, in steps as long as
/// Newton's method allows: where it fails at once, a pressure may still exist.
bool FacePath::solve_from_even_pressure(const Vector2& slip, double spin) {
  constexpr double shortest = 1.0 / 1024;
  const Vector2& centre = pushed_.centre();
  const Vector2 u = slip + spin * Vector2(-centre.y(), centre.x());
  press_evenly();
  pushed_.press(pressure_);
  const Vector3 friction = rubbing_ * (pushed_.slip_moments(u, spin * pushed_.unit()) * pressure_);
  const Vector3 moments = whole_moments_ * pressure_;
  const Vector2 slack = moments.tail<2>() - (turning_.point + shift_ * friction - centre) / pushed_.unit();
  for (double done = 0, step = 1; done < 1;) {
    const Vector3 before = pressure_;
    const double next = std::fmin(done + step, 1);
    if (solve(turning_.point, u, spin, (1 - next) * slack)) {
      done = next;
      step *= 2;
      continue;
    }
    pressure_ = before;
    step /= 4;
    if (step < shortest) return false;
  }
  return true;
}

/// Lets the pressure change as it did between the last two directions of slip, to begin near the solution.
void FacePath::go_on_to(const Vector3& direction) {
  const Vector3 way = last_.direction - one_before_.direction;
  const double part = (direction - last_.direction).dot(way) / way.squaredNorm();
  if (std::fabs(part) <= 2) pressure_ += part * (last_.pressure - one_before_.pressure);
}

FacePath::Values FacePath::rate(const Values& y) {
  const Vector2 slip = y.head<2>() / root_mass_;
  const double spin = y[2] / root_inertia_;
  const Vector3 direction = y.head<3>().normalized();
  go_on_to(direction);
  if (!solve(slip, spin) && !solve_from_even_pressure(slip, spin))
    return Vector3::Constant(std::numeric_limits<double>::quiet_NaN());
  one_before_ = last_;
  last_ = {direction, pressure_};
  return load_ + Vector3(force_.x() / root_mass_, force_.y() / root_mass_, force_.z() / root_inertia_);
}

/// Whether friction can hold the face under the pressure that it then has; nothing if it has none.
std::optional<bool> FacePath::is_held(Vector3& direction) {
  const Vector2 force = -root_mass_ * load_.head<2>();
  const double couple = -root_inertia_ * load_.z();
  const Vector2 point = turning_.point + shift_ * Vector3(force.x(), force.y(), couple);
  if (!area_.contains(point)) return {};
  if (load_ == Vector3::Zero()) return true;
  press_evenly();
  if (!solve(point, Vector2::Zero(), {})) return {};
  pushed_.press(pressure_);
  SlipLetGo slip(load_, [&](const Vector3& y) -> Vector3 {
    const Vector2& centre = pushed_.centre();
    const double spin = y.z() / root_inertia_;
    const Vector2 u = y.head<2>() / root_mass_ + spin * Vector2(-centre.y(), centre.x());
    const Vector3 rub = rubbing_ * (pushed_.slip_moments(u, spin * pushed_.unit()) * pressure_);
    return {rub.x() / root_mass_, rub.y() / root_mass_, rub.z() / root_inertia_};
  });
  const bool held = slip.is_held();
  direction = slip.direction();
  return held;
}

std::optional<FaceFriction> FacePath::follow() {
  FaceFriction result;
  const Vector3 before = y_.head<3>();
  const bool slips = before.norm() > rounding();
  End end = slips ? slide() : End::stopped;
  if (end == End::stopped) {
    Vector3 direction;
    const auto held = is_held(direction);
    if (!held) return {};
    result.path =
        slips ? (*held ? PathKind::slip_stick : PathKind::slip_reslip) : (*held ? PathKind::stick : PathKind::slip);
    y_.setZero();
    if (!*held) {
      y_ = first_slip * face_.normal_impulse * load_.norm() * direction;
      end = slide(true);
      if (end == End::stopped) return {};
    }
  }
  if (end == End::no_pressure) return {};
  const Vector3 change = y_.head<3>() - before - face_.normal_impulse * load_;
  result.impulse = root_mass_ * change.head<2>();
  result.couple = root_inertia_ * change.z();
  result.spin_after = y_[2] / root_inertia_;
  return result;
}

}  // namespace

bool slides_straight(const SlidingFace& face) {
  constexpr double rounding = 16 * detail::epsilon;
  const FaceTurning turning(face);
  const Vector2 drift = drift_of_slip(face);
  const double radius = std::sqrt(turning.inertia / face.mass);
  const double turns = std::fabs(face.spin) + face.normal_impulse * std::fabs(turning.drift);
  if (!(turns * radius <= rounding * face.velocity_scale)) return false;
  const Vector2 line = face.slip.norm() > rounding * face.velocity_scale ? face.slip : drift;
  if (line == Vector2::Zero()) return true;
  const auto off = [&](const Vector2& v) { return std::fabs(cross(line, v)) / line.norm(); };
  return face.normal_impulse * off(drift) <= rounding * face.velocity_scale &&
         off(turning.point) <= rounding * (turning.point.norm() + radius);
}

std::optional<FaceFriction> face_friction(const SlidingFace& face, const ContactArea& area) {
  return FacePath(face, area).follow();
}

}  // namespace clatter::analytic::space
