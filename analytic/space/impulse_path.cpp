// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/space/impulse_path.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <sstream>

#include "analytic/contact_impulse.hpp"
#include "analytic/detail/limits.hpp"
#include "analytic/errors.hpp"
#include "analytic/space/path_progress.hpp"
#include "analytic/space/slip_field.hpp"
#include "analytic/space/turning_slip.hpp"

namespace clatter::analytic::space {

using detail::epsilon;

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();
/// Relative distances below this are decided by rounding of W and v.
constexpr double rounding = 1e-13;
/// Slip below this part of the corner's speed can be brought to any smaller value by rounding.
constexpr double ambiguous_slip = 1e-12;

/// Coulomb's path in units of the approach speed v and of v/W_nn, in the frame of the slip field.
class CoulombPath {
 public:
  CoulombPath(const Contact& contact, const Law& law, NormalCoupling coupling)
      : contact_(contact), speed_(-contact.velocity.z()),
        field_(contact.inverse_inertia, law.law.friction_value, coupling),
        velocity_(field_.to_frame(contact.velocity.head<2>() / speed_)),
        progress_(
            {.law = law.law.law, .restitution = law.law.restitution, .damping = law.law.damping_per_stiffness * speed_},
            velocity_.norm()) {}

  ContactImpulse follow();

 private:
  void slip();
  void slip_straight(const Direction& direction);
  void slip_along_arc(double angle);
  void go_on_from_rest(bool has_slipped);
  [[nodiscard]] double direction_tolerance(const Direction& invariant) const;
  [[nodiscard]] bool is_invariant(double angle) const;
  [[nodiscard]] bool is_ambiguous() const;

  const Contact& contact_;
  double speed_;
  SlipField field_;
  Vector2 velocity_;  ///< of slip
  PathProgress progress_;
  Direction direction_;  ///< of slip at the end
  double stop_ = none;
  PathKind kind_ = PathKind::slip;
  bool passes_fourth_quadrant_ = false;
};

/// A direction of slip this near to an invariant one is not distinct from it: rounding of v and of g.
double CoulombPath::direction_tolerance(const Direction& zero) const {
  const double c = zero.cosine, s = zero.sine;
  const double slope = -field_.b1() * c - field_.b2() * s + field_.anisotropy() * (c - s) * (c + s);
  const double of_velocity = 4 * contact_.velocity_scale / (speed_ * progress_.slip);
  return epsilon * (8 + of_velocity + 8 * field_.rounding_scale() / std::fabs(slope));
}

bool CoulombPath::is_invariant(double angle) const {
  constexpr double turn = 2 * std::numbers::pi;
  if (field_.is_straight()) return true;
  for (int i = 0; i < field_.zero_count(); ++i) {
    const Direction& zero = field_.zero(i).at;
    if (std::fabs(std::remainder(angle - zero.angle, turn)) <= direction_tolerance(zero)) return true;
  }
  return false;
}

/// Slip along one line, to where it stops or the law ends.
void CoulombPath::slip_straight(const Direction& s) {
  const double rate = field_.slip_rate(s);
  const double length = rate < 0 ? progress_.slip / -rate : std::numeric_limits<double>::infinity();
  const double start = progress_.at.impulse;
  progress_.follow({.ratio = {-field_.friction() * s.cosine, -field_.friction() * s.sine},
                    .normal_rate = field_.normal_rate(s),
                    .length = length});
  direction_ = s;
  if (progress_.is_done()) {
    progress_.slip = std::fmax(progress_.slip + rate * (progress_.at.impulse - start), 0.0);
    progress_.least_slip = std::fmin(progress_.least_slip, progress_.slip);
    return;
  }
  stop_ = start + length;
  progress_.slip = progress_.least_slip = 0;
}

void CoulombPath::slip_along_arc(double angle) {
  constexpr double turn = 2 * std::numbers::pi;
  const int count = field_.zero_count();
  const double first = field_.zero(0).at.angle;
  while (angle < first) angle += turn;
  while (angle >= first + turn) angle -= turn;
  int above = 1;
  while (above < count && field_.zero(above).at.angle <= angle) ++above;
  InvariantAngle lower = field_.zero(above - 1), upper = field_.zero(above % count);
  if (above == count) upper.at.angle += turn;
  passes_fourth_quadrant_ = above < count;
  SlipArc arc{.repelling = lower.at, .attracting = upper.at, .angle = angle};
  if (lower.attracts) std::swap(arc.repelling, arc.attracting);
  kind_ = PathKind::turning_slip;
  direction_ = follow_turning_slip(field_, arc, progress_);
  if (!progress_.is_done()) slip_straight(direction_);
}

void CoulombPath::slip() {
  const double angle = std::atan2(velocity_.y(), velocity_.x());
  if (!is_invariant(angle)) return slip_along_arc(angle);
  slip_straight({angle, velocity_.x() / progress_.slip, velocity_.y() / progress_.slip});
}

void CoulombPath::go_on_from_rest(bool has_slipped) {
  if (field_.can_stick()) {
    kind_ = has_slipped ? PathKind::slip_stick : PathKind::stick;
    return progress_.follow({.ratio = field_.stick_ratio(), .normal_rate = field_.stick_rate()});
  }
  kind_ = has_slipped ? PathKind::slip_reslip : PathKind::slip;
  slip_straight(field_.outgoing());
}

bool CoulombPath::is_ambiguous() const {
  const double speed = std::hypot(1.0, velocity_.norm());
  const double slip = velocity_.norm();
  const bool stopped = !(stop_ != stop_);
  if (slip > 0 && slip * speed_ <= 4 * epsilon * contact_.velocity_scale) return true;
  if (!stopped && slip > 0 && progress_.least_slip <= ambiguous_slip * speed) return true;
  if (passes_fourth_quadrant_ && std::fabs(field_.astroid_excess()) <= rounding) return true;
  if (stopped && std::fabs(progress_.at.impulse - stop_) <= rounding * stop_) return true;
  const double excess = field_.stick_ratio().norm() - field_.friction();
  return (stopped || slip == 0) && std::fabs(excess) <= rounding * field_.friction();
}

ContactImpulse CoulombPath::follow() {
  const bool slips = progress_.slip > 0;
  if (slips) slip();
  if (!progress_.is_done()) go_on_from_rest(slips);
  const double unit = speed_ / contact_.inverse_inertia(2, 2);
  const Vector2 friction = field_.to_world(progress_.friction);
  const Vector2 slip = field_.to_world({direction_.cosine, direction_.sine}) * progress_.slip;
  ContactImpulse result;
  result.impulse = unit * Vector3(friction.x(), friction.y(), progress_.at.impulse);
  result.velocity_after = speed_ * Vector3(slip.x(), slip.y(), progress_.at.normal_velocity);
  result.compression_impulse = unit * progress_.compression;
  result.slip_stop_impulse = unit * stop_;
  result.least_slip = speed_ * progress_.least_slip;
  result.path = kind_;
  result.is_path_ambiguous = is_ambiguous();
  return result;
}

[[noreturn]] void jam(double ratio) {
  std::ostringstream text;
  text.precision(6);
  text << "jamming (Painlevé's paradox): at the impulse ratio " << ratio
       << " in the direction given the corner can no longer leave the ground, since c + μ_i b·d <= 0";
  throw OutsideModelError(text.str());
}

/// Eq. 8 in space, and without friction: P_t = μ_i P_n d, P_n = −(1+e) v_n/(c + μ_i b·d).
ContactImpulse ratio_impulse(const Contact& contact, const Law& law, NormalCoupling coupling) {
  const Matrix3& w = contact.inverse_inertia;
  const double ratio = law.law.friction == FrictionKind::impulse_ratio ? law.law.friction_value : 0;
  const double speed = -contact.velocity.z();
  const Vector3 direction(ratio * law.ratio_direction.x(), ratio * law.ratio_direction.y(), 1);
  const double rate = coupling == NormalCoupling::none ? w(2, 2) : w.row(2).dot(direction);
  if (!(rate > 0)) jam(ratio);
  const double e = restitution_at(law.law, speed);
  ContactImpulse result;
  result.impulse = (1 + e) * speed / rate * direction;
  result.velocity_after = contact.velocity + w * result.impulse;
  result.velocity_after.z() = e * speed;
  result.compression_impulse = speed / rate;
  result.slip_stop_impulse = none;
  result.least_slip = std::fmin(contact.velocity.head<2>().norm(), result.velocity_after.head<2>().norm());
  result.path = ratio == 0 ? PathKind::frictionless : PathKind::slip;
  return result;
}

ContactImpulse impulse(const Contact& contact, const Law& law, NormalCoupling coupling) {
  const bool rubs = law.law.friction == FrictionKind::coulomb && law.law.friction_value > 0;
  const ContactImpulse result =
      rubs ? CoulombPath(contact, law, coupling).follow() : ratio_impulse(contact, law, coupling);
  if (!result.impulse.allFinite() || !result.velocity_after.allFinite()) {
    throw NumericalError("the impulse of a corner overflows");
  }
  return result;
}

}  // namespace

ContactImpulse contact_impulse(const Contact& contact, const Law& law) {
  return impulse(contact, law, NormalCoupling::of_friction);
}

ContactImpulse face_impulse(const FaceContact& face, const Law& law) {
  Contact contact{.inverse_inertia = Matrix3::Identity() / face.mass,
                  .velocity = {face.slip.x(), face.slip.y(), -face.approach_speed},
                  .velocity_scale = face.velocity_scale};
  contact.inverse_inertia.block<2, 1>(0, 2) = face.drift;
  Law whole = law;
  whole.law = {.restitution = face.restitution,
               .law = RestitutionLaw::newton,
               .friction = law.law.friction,
               .friction_value = law.law.friction_value};
  return impulse(contact, whole, NormalCoupling::none);
}

}  // namespace clatter::analytic::space
