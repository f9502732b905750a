// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/space/face_friction.hpp"

#include <gsl/gsl_odeiv2.h>

#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <memory>

#include "analytic/base/limits.hpp"

namespace clatter::analytic::space {

namespace {

/// Local error of a step, relative to the largest slip so far.
constexpr double step_error = 4e-15;
/// A stop forecast within this part of the impulse that is left will come, whatever turn slip takes.
constexpr double sure_stop = 1e-4;
/// Slip, relative to what all of the impulse could do, with which a face that is let go begins to slip.
constexpr double first_slip = 1e-15;
/// Pressure on less than this part of the area counts as pressure at its edge, where there is none.
constexpr double least_part = 1e-4;
/// A step that may change no more of the slip than this and still fails leads out of what pressure can do.
constexpr double shortest_step = 1e-13;

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

struct FreeFaceStep {
  void operator()(gsl_odeiv2_step* step) const { gsl_odeiv2_step_free(step); }
};

/// The path of (U, w), in the metric of the kinetic energy: y = (√m U, √J w).
class FacePath {
 public:
  FacePath(const SlidingFace& face, const ContactArea& area)
      : face_(face), turning_(face), area_(area), pushed_(area), root_mass_(std::sqrt(face.mass)),
        root_inertia_(std::sqrt(turning_.inertia)) {
    load_ << root_mass_ * drift_of_slip(face), root_inertia_ * turning_.drift;
    slip_ << root_mass_ * face.slip, root_inertia_ * face.spin;
    whole_moments_ = pushed_.moments();
    pressure_ << 1 / whole_moments_(0, 0), 0, 0;
    const Vector2& centre = pushed_.centre();
    rubbing_ << 1, 0, 0, 0, 1, 0, -centre.y(), centre.x(), pushed_.unit();
    rubbing_ *= -face.friction;
    shift_ << -face.depth, 0, turning_.point_per_couple.x(), 0, -face.depth, turning_.point_per_couple.y();
  }

  std::optional<FaceFriction> follow();

 private:
  enum class End { impulse_spent, stopped, no_pressure };
  End slide();
  bool sticks();
  [[nodiscard]] Vector3 rate(const Vector3& y);
  static int derivative(double impulse, const double y[], double change[], void* path);
  [[nodiscard]] bool solve(const Vector2& slip, double spin);

  const SlidingFace& face_;
  FaceTurning turning_;
  const ContactArea& area_;
  PressedArea pushed_;
  double root_mass_, root_inertia_;
  Vector3 load_;                     ///< y′ without friction
  Vector3 slip_;                     ///< y
  double spent_ = 0;                 ///< P
  Vector3 pressure_;                 ///< a, b, c in the units of pushed_, as they were last
  Vector3 force_ = Vector3::Zero();  ///< (F, K) with them
  Matrix3 whole_moments_, rubbing_;
  Eigen::Matrix<double, 2, 3> shift_;  ///< of the pressure point by (F, K)
  gsl_odeiv2_system system_{derivative, nullptr, 3, this};
  std::unique_ptr<gsl_odeiv2_step, FreeFaceStep> step_{gsl_odeiv2_step_alloc(gsl_odeiv2_step_rk8pd, 3)};
};

int FacePath::derivative(double, const double y[], double change[], void* path) {
  Eigen::Map<Vector3> rate_of_change(change);
  rate_of_change = static_cast<FacePath*>(path)->rate(Eigen::Map<const Vector3>(y));
  return 0;
}

/// Finds a, b, c and with them F, K: linear equations on the area that is pushed, which is that of the solution.
bool FacePath::solve(const Vector2& slip, double spin) {
  constexpr int most_turns = 40;
  constexpr double settled = 1e-9;
  const Vector2& centre = pushed_.centre();
  const Vector3 wanted = (Vector3() << 1, (turning_.point - centre) / pushed_.unit()).finished();
  const Vector2 u = slip + spin * Vector2(-centre.y(), centre.x());
  Vector3 before = pressure_;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < most_turns; ++i) {
    const bool whole = pushed_.press(pressure_);
    const Matrix3 moments = whole ? whole_moments_ : pushed_.moments();
    if (!(moments(0, 0) > least_part * whole_moments_(0, 0))) {
      pressure_ = (before + pressure_) / 2;
      continue;
    }
    const Matrix3 rubs = rubbing_ * pushed_.slip_moments(u, spin * pushed_.unit());
    Matrix3 equations = moments;
    equations.bottomRows<2>() -= shift_ * rubs / pushed_.unit();
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

/// y′, NaN where no pressure does it.
Vector3 FacePath::rate(const Vector3& y) {
  const Vector2 slip = y.head<2>() / root_mass_;
  const double spin = y.z() / root_inertia_;
  if (const bool afresh = pressure_.tail<2>() != Vector2::Zero(); !solve(slip, spin)) {
    pressure_ << 1 / whole_moments_(0, 0), 0, 0;
    if (!afresh || !solve(slip, spin)) return Vector3::Constant(std::numeric_limits<double>::quiet_NaN());
  }
  return load_ + Vector3(force_.x() / root_mass_, force_.y() / root_mass_, force_.z() / root_inertia_);
}

/// Follows slip until it stops, as successive forecasts of the stop agree, or until the impulse is spent.
FacePath::End FacePath::slide() {
  constexpr int most_steps = 1000;
  const double begin = spent_;
  double scale = slip_.norm(), size_then = scale, forecast = -1, length = std::numeric_limits<double>::infinity();
  for (int i = 0; i < most_steps; ++i) {
    const Vector3 now = rate(slip_);
    if (!now.allFinite()) return End::no_pressure;
    const double size = slip_.norm(), growth = slip_.dot(now) / size;
    scale = std::fmax(scale, size);
    if (growth < 0) {
      const double stop = spent_ - size / growth;
      const double rounding = detail::epsilon * (stop - begin);
      const bool agrees = std::fabs(stop - forecast) <= rounding && size <= size_then / 2;
      // Without a load slip can only become less, and what stops it does not depend on when.
      const double forecast_error = load_ == Vector3::Zero() ? sure_stop * (face_.normal_impulse - spent_) : rounding;
      if ((agrees && stop < face_.normal_impulse) || stop - spent_ <= forecast_error) {
        spent_ = stop;
        return End::stopped;
      }
      if (!(size > size_then / 2 && forecast >= 0)) forecast = stop, size_then = size;
    }
    length = std::fmin(length, size / std::fmax(-growth / 0.9, now.norm() / 8));
    const double left = face_.normal_impulse - spent_;
    const bool last = length >= left;
    if (!(left > 0)) return End::impulse_spent;
    length = std::fmin(length, left);
    Vector3 next = slip_, error;
    gsl_odeiv2_step_apply(step_.get(), 0, length, next.data(), error.data(), now.data(), nullptr, &system_);
    const double wrong = error.norm() / (step_error * scale);
    if (wrong <= 1) {
      slip_ = next;
      if (last) return End::impulse_spent;
      spent_ += length;
    } else if (length * now.norm() <= shortest_step * size) {
      return End::no_pressure;
    }
    length *= wrong >= 0 ? std::fmin(std::fmax(0.9 * std::pow(wrong, -0.125), 0.1), 4) : 0.1;
  }
  return End::no_pressure;  // along the edge of what pressure can do, where it cannot be told from none
}

/// Whether a face that holds still has a pressure; friction is what it takes.
bool FacePath::sticks() {
  const Vector2 force = -root_mass_ * load_.head<2>();
  const double couple = -root_inertia_ * load_.z();
  return area_.contains(turning_.point + shift_ * Vector3(force.x(), force.y(), couple));
}

std::optional<FaceFriction> FacePath::follow() {
  FaceFriction result;
  const Vector3 before = slip_;
  const bool slips = before.norm() > 16 * detail::epsilon * root_mass_ * face_.velocity_scale;
  End end = slips ? slide() : End::stopped;
  if (end == End::stopped) {
    result.path = slips ? PathKind::slip_stick : PathKind::stick;
    slip_ = first_slip * face_.normal_impulse * load_;
    if (load_ != Vector3::Zero()) end = slide();
    if (end == End::impulse_spent) result.path = slips ? PathKind::slip_reslip : PathKind::slip;
    if (end == End::stopped) {
      slip_.setZero();
      if (!sticks()) end = End::no_pressure;
    }
  }
  if (end == End::no_pressure) return {};
  const Vector3 change = slip_ - before - face_.normal_impulse * load_;
  result.impulse = root_mass_ * change.head<2>();
  result.couple = root_inertia_ * change.z();
  result.spin_after = slip_.z() / root_inertia_;
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
