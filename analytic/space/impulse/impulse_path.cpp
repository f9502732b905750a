// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/space/impulse/impulse_path.hpp"

#include <Eigen/LU>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <sstream>
#include <type_traits>

#include "analytic/base/errors.hpp"
#include "analytic/base/limits.hpp"
#include "analytic/law/coulomb_path.hpp"
#include "analytic/space/flight/body.hpp"
#include "analytic/space/impulse/moreau_contact.hpp"
#include "analytic/space/impulse/path_progress.hpp"
#include "analytic/space/impulse/slip_field.hpp"
#include "analytic/space/impulse/turning_slip.hpp"

namespace clatter::analytic::space {

using detail::epsilon;
using detail::value_of;

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();
/// Relative distances below this are decided by rounding of W and v.
constexpr double relative_rounding = 1e-13;
/// Slip below this part of the corner's speed can be brought to any smaller value by rounding.
constexpr double ambiguous_slip = 1e-12;

/// A direction of slip with what it does per normal impulse.
template <class Number>
struct SlipRates {
  Direction at;
  Number slip, normal;          ///< f, h
  std::array<Number, 2> ratio;  ///< dP_t/dp
};

/// Coulomb's path in units of the approach speed v and of v/W_nn, in the frame of the slip field.
/// Number: double, or PathDual for the derivatives of the impulse.
template <class Number>
class CoulombPath {
 public:
  CoulombPath(const Contact& contact, const ImpactLaw& law, NormalCoupling coupling, const ImpulseSlopes* slopes)
      : contact_(contact), speed_(-contact.velocity.z()), field_(contact.inverse_inertia, law.friction_value, coupling),
        velocity_(field_.to_frame(contact.velocity.head<2>() / speed_)),
        progress_({.law = law.law, .restitution = law.restitution, .damping = law.damping_per_stiffness * speed_},
                  initial_slip(), approach()) {
    if constexpr (follows_slopes) slopes_.emplace(field_, contact.inverse_inertia, slopes->turns);
  }

  ContactImpulse follow();
  /// After follow().
  void derive(const ContactImpulse& result, ImpulseSlopes& slopes) const;

 private:
  static constexpr bool follows_slopes = !std::is_same_v<Number, double>;
  using Row = SlipFieldSlopes::Row;

  void slip();
  void slip_straight(const SlipRates<Number>& rates);
  void slip_along_arc(double angle);
  void go_on_from_rest(bool has_slipped);
  void turn_straight_slip(double start_slip);
  void stick_from_slip();
  void forget_slopes();
  [[nodiscard]] Number initial_slip() const;
  [[nodiscard]] static Number approach();
  [[nodiscard]] SlipRates<Number> rates(const Direction& s, const Row& turn) const;
  [[nodiscard]] Row turn_of_zero(const Direction& zero) const;
  [[nodiscard]] std::array<double, 5> initial_turn() const;
  [[nodiscard]] typename PathProgress<Number>::Line sticking() const;
  [[nodiscard]] double direction_tolerance(const Direction& invariant) const;
  [[nodiscard]] double turning_tolerance(const Direction& invariant) const;
  [[nodiscard]] std::optional<Direction> straight_direction(double angle) const;
  [[nodiscard]] bool is_ambiguous() const;

  const Contact& contact_;
  double speed_;
  SlipField field_;
  Vector2 velocity_;  ///< of slip
  PathProgress<Number> progress_;
  std::optional<SlipFieldSlopes> slopes_;
  Direction direction_;  ///< of slip at the end
  double stop_ = none;
  PathKind kind_ = PathKind::slip;
  bool passes_fourth_quadrant_ = false;
};

/// −v_z, and |v_t|: derivatives are by v in units of the approach speed.
template <class Number>
Number CoulombPath<Number>::approach() {
  if constexpr (follows_slopes) return Number(1, {0, 0, 0, 0, -1});
  else return 1;
}

template <class Number>
Number CoulombPath<Number>::initial_slip() const {
  const double slip = velocity_.norm();
  if constexpr (follows_slopes) {
    if (slip == 0) return slip;
    const Vector2 along = field_.to_world(velocity_ / slip);
    return Number(slip, {0, 0, along.x(), along.y(), 0});
  } else {
    return slip;
  }
}

/// Derivatives of the angle of slip at the start.
template <class Number>
std::array<double, 5> CoulombPath<Number>::initial_turn() const {
  const Vector2 across = field_.to_world(Vector2(-velocity_.y(), velocity_.x()) / velocity_.squaredNorm());
  return {0, 0, across.x(), across.y(), 0};
}

template <class Number>
SlipRates<Number> CoulombPath<Number>::rates(const Direction& s, const Row& turn) const {
  const double friction = field_.friction();
  SlipRates<Number> r{.at = s,
                      .slip = field_.slip_rate(s),
                      .normal = field_.normal_rate(s),
                      .ratio = {-friction * s.cosine, -friction * s.sine}};
  if constexpr (follows_slopes) {
    const Row slip = slopes_->slip_rate(s) + field_.slip_rate_slope(s) * turn;
    const Row normal = slopes_->normal_rate(s) + field_.normal_rate_slope(s) * turn;
    for (std::size_t k = 0; k < 2; ++k) {
      const int row = static_cast<int>(k);
      r.slip.slope[k] = slip[row], r.normal.slope[k] = normal[row];
      r.ratio[0].slope[k] = friction * s.sine * turn[row], r.ratio[1].slope[k] = -friction * s.cosine * turn[row];
    }
  }
  return r;
}

/// δφ = −δg/g′.
template <class Number>
typename CoulombPath<Number>::Row CoulombPath<Number>::turn_of_zero(const Direction& zero) const {
  if constexpr (follows_slopes) return -slopes_->turning(zero) / field_.turning_slope(zero);
  else return Row::Zero();
}

template <class Number>
void CoulombPath<Number>::forget_slopes() {
  if constexpr (follows_slopes) progress_.at.impulse.slope.fill(none);
}

/// A direction of slip this near to an invariant one is not distinct from it: rounding of v and of g.
template <class Number>
double CoulombPath<Number>::direction_tolerance(const Direction& zero) const {
  const double of_velocity = 4 * contact_.velocity_scale / (speed_ * velocity_.norm());
  return epsilon * of_velocity + turning_tolerance(zero);
}

/// The part of that which g has, however slow slip is.
template <class Number>
double CoulombPath<Number>::turning_tolerance(const Direction& zero) const {
  return 8 * epsilon * (1 + field_.rounding_scale() / std::fabs(field_.turning_slope(zero)));
}

/// The direction that slip at this angle keeps, if it turns no more than rounding says: its own, or the invariant one
/// where v, not g, leaves the two apart: slip of rounding's size can be far off it, and grows along it alone.
template <class Number>
std::optional<Direction> CoulombPath<Number>::straight_direction(double angle) const {
  constexpr double turn = 2 * std::numbers::pi;
  const double slip = velocity_.norm();
  const Direction own{angle, velocity_.x() / slip, velocity_.y() / slip};
  if (field_.is_straight()) return own;
  std::optional<Direction> nearest;
  double least = turn;
  for (int i = 0; i < field_.zero_count(); ++i) {
    const Direction& zero = field_.zero(i).at;
    const double apart = std::fabs(std::remainder(angle - zero.angle, turn));
    if (apart < least && apart <= direction_tolerance(zero)) nearest = zero, least = apart;
  }
  return nearest && least <= turning_tolerance(*nearest) ? own : nearest;
}

/// Slip along one line, to where it stops or the law ends.
template <class Number>
void CoulombPath<Number>::slip_straight(const SlipRates<Number>& s) {
  const Number length = s.slip < 0 ? progress_.slip / -s.slip : Number(std::numeric_limits<double>::infinity());
  const Number start = progress_.at.impulse;
  progress_.follow({.ratio = s.ratio, .normal_rate = s.normal, .length = length});
  direction_ = s.at;
  if (progress_.is_done()) {
    const Number slip = progress_.slip + s.slip * (progress_.at.impulse - start);
    progress_.slip = slip > 0 ? slip : Number(0);
    progress_.least_slip = std::fmin(progress_.least_slip, value_of(progress_.slip));
    return;
  }
  stop_ = value_of(start) + value_of(length);
  progress_.slip = 0;
  progress_.least_slip = 0;
}

/// The friction of slip that leaves its invariant direction by ψ: σ dψ/dp = γ ψ + δg, γ = g′.  With dp = σ dτ,
///     ∫ ψ dp = ψ₀ K₁ + δg K₂,   K₁ = ∫ e^{γτ} dp,   K₂ = ∫ (e^{γτ} − 1)/γ dp,   σ = σ₀ e^{fτ}.
/// In a plane of symmetry f and h keep their values to first order; elsewhere slip that turns has no closed form here.
template <class Number>
void CoulombPath<Number>::turn_straight_slip(double start_slip) {
  const Direction& s = direction_;
  const double f = field_.slip_rate(s), turning = field_.turning_slope(s), slowing = -f - turning;
  const double asymmetry = std::fabs(field_.slip_rate_slope(s)) + std::fabs(field_.normal_rate_slope(s));
  if (!(asymmetry <= relative_rounding * (1 + field_.turning_bound()))) return forget_slopes();
  // ψ = 1, where slip has turned round, is reached at so small a slip that even errors of 1e-15 leave it a part.
  if (!progress_.is_done() && turning > 2 * slowing) return forget_slopes();
  double of_start = start_slip / slowing, of_turning = of_start / -f;  // where slip stops
  if (progress_.is_done()) {
    using Gauss = boost::math::quadrature::gauss<double, 15>;
    const double impulse = value_of(progress_.at.impulse), growth = f * impulse / start_slip;
    const double time = std::fabs(growth) > epsilon ? std::log1p(growth) / f : impulse / start_slip;
    of_start *= -std::expm1(-slowing * time);
    const auto rate = [&](double t) {
      return start_slip * std::exp(f * t) * (turning == 0 ? t : std::expm1(turning * t) / turning);
    };
    const int pieces = 1 + static_cast<int>(std::fmin((std::fabs(f) + std::fabs(turning)) * time / 2, 1000.0));
    of_turning = 0;
    for (int i = 0; i < pieces; ++i) of_turning += Gauss::integrate(rate, i * time / pieces, (i + 1) * time / pieces);
  }
  if constexpr (follows_slopes) {
    const Row of_field = slopes_->turning(s);
    const std::array<double, 5> start = initial_turn();
    for (std::size_t k = 0; k < 5; ++k) {
      const double turned = start[k] * of_start + (k < 2 ? of_field[static_cast<int>(k)] * of_turning : 0);
      progress_.friction[0].slope[k] += field_.friction() * s.sine * turned;
      progress_.friction[1].slope[k] -= field_.friction() * s.cosine * turned;
    }
  }
}

template <class Number>
void CoulombPath<Number>::slip_along_arc(double angle) {
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
  const Row to = turn_of_zero(arc.attracting);
  if constexpr (follows_slopes) {
    const SlipArcSlopes slopes{
        .field = *slopes_, .repelling = turn_of_zero(arc.repelling), .attracting = to, .angle = initial_turn()};
    direction_ = follow_turning_slip(field_, arc, &slopes, progress_);
  } else {
    direction_ = follow_turning_slip(field_, arc, nullptr, progress_);
  }
  if (!progress_.is_done()) slip_straight(rates(direction_, to));
}

template <class Number>
void CoulombPath<Number>::slip() {
  const double angle = std::atan2(velocity_.y(), velocity_.x());
  const auto straight = straight_direction(angle);
  if (!straight) return slip_along_arc(angle);
  const double slip = value_of(progress_.slip);
  slip_straight(rates(*straight, Row::Zero()));
  if constexpr (follows_slopes) turn_straight_slip(slip);
}

/// P_t/p and du/dp of a point that does not slip.
template <class Number>
typename PathProgress<Number>::Line CoulombPath<Number>::sticking() const {
  const Vector2 ratio = field_.stick_ratio();
  typename PathProgress<Number>::Line line{.ratio = {ratio.x(), ratio.y()}, .normal_rate = field_.stick_rate()};
  if constexpr (follows_slopes) {
    const SlipFieldSlopes& d = *slopes_;
    const Row x = -(d.b1 + d.a11 * ratio.x() + d.a12 * ratio.y()) / field_.a1();
    const Row y = -(d.b2 + d.a12 * ratio.x() + d.a22 * ratio.y()) / field_.a2();
    const Row rise = d.b1 * ratio.x() + d.b2 * ratio.y() + field_.b1() * x + field_.b2() * y;
    for (std::size_t k = 0; k < 2; ++k) {
      const int row = static_cast<int>(k);
      line.ratio[0].slope[k] = x[row], line.ratio[1].slope[k] = y[row], line.normal_rate.slope[k] = rise[row];
    }
  }
  return line;
}

/// Sticking friction that has to stop a small slip first: A P_t + v_t = 0 beside what the normal impulse asks for.
template <class Number>
void CoulombPath<Number>::stick_from_slip() {
  if constexpr (follows_slopes) {
    for (std::size_t k = 0; k < 2; ++k) {
      const Vector2 slip = field_.to_frame(Vector2::Unit(static_cast<int>(k)));
      const Vector2 push(-slip.x() / field_.a1(), -slip.y() / field_.a2());
      progress_.friction[0].slope[2 + k] += push.x();
      progress_.friction[1].slope[2 + k] += push.y();
      progress_.at.normal_velocity.slope[2 + k] += field_.b1() * push.x() + field_.b2() * push.y();
    }
  }
}

template <class Number>
void CoulombPath<Number>::go_on_from_rest(bool has_slipped) {
  if (field_.can_stick()) {
    kind_ = has_slipped ? PathKind::slip_stick : PathKind::stick;
    if (!has_slipped) stick_from_slip();
    return progress_.follow(sticking());
  }
  kind_ = has_slipped ? PathKind::slip_reslip : PathKind::slip;
  slip_straight(rates(field_.outgoing(), turn_of_zero(field_.outgoing())));
  if (!has_slipped) forget_slopes();
}

template <class Number>
bool CoulombPath<Number>::is_ambiguous() const {
  const double speed = std::hypot(1.0, velocity_.norm());
  const double slip = velocity_.norm();
  const bool stopped = !(stop_ != stop_);
  if (slip > 0 && slip * speed_ <= 4 * epsilon * contact_.velocity_scale) return true;
  if (!stopped && slip > 0 && progress_.least_slip <= ambiguous_slip * speed) return true;
  if (passes_fourth_quadrant_ && std::fabs(field_.astroid_excess()) <= relative_rounding) return true;
  if (stopped && std::fabs(value_of(progress_.at.impulse) - stop_) <= relative_rounding * stop_) return true;
  const double excess = field_.stick_ratio().norm() - field_.friction();
  return (stopped || slip == 0) && std::fabs(excess) <= relative_rounding * field_.friction();
}

template <class Number>
ContactImpulse CoulombPath<Number>::follow() {
  const bool slips = progress_.slip > 0;
  if (slips) slip();
  if (!progress_.is_done()) go_on_from_rest(slips);
  const double unit = speed_ / contact_.inverse_inertia(2, 2);
  const Vector2 friction = field_.to_world({value_of(progress_.friction[0]), value_of(progress_.friction[1])});
  const Vector2 slip = field_.to_world({direction_.cosine, direction_.sine}) * value_of(progress_.slip);
  const Measure<> end{value_of(progress_.at.impulse), value_of(progress_.at.normal_velocity)};
  ContactImpulse result;
  result.impulse = unit * Vector3(friction.x(), friction.y(), end.impulse);
  result.velocity_after = speed_ * Vector3(slip.x(), slip.y(), end.normal_velocity);
  result.compression_impulse = unit * value_of(progress_.compression);
  result.slip_stop_impulse = unit * stop_;
  result.least_slip = speed_ * progress_.least_slip;
  result.path = kind_;
  result.is_path_ambiguous = is_ambiguous();
  return result;
}

/// P is v/W_nn times what progress_ has; a turn about the vertical turns it with v.
template <class Number>
void CoulombPath<Number>::derive(const ContactImpulse& result, ImpulseSlopes& slopes) const {
  const double per_speed = 1 / contact_.inverse_inertia(2, 2);
  for (std::size_t k = 0; k < 5; ++k) {
    const int row = static_cast<int>(k);
    const Vector2 friction = field_.to_world({progress_.friction[0].slope[k], progress_.friction[1].slope[k]});
    const Vector3 change = per_speed * Vector3(friction.x(), friction.y(), progress_.at.impulse.slope[k]);
    if (row < 2) slopes.of_turns.col(row) = speed_ * change - slopes_->unit[row] * result.impulse;
    else slopes.of_velocity.col(row - 2) = change;
  }
  const Vector3 up = Vector3::UnitZ();
  slopes.of_turns.col(2) = up.cross(result.impulse) - slopes.of_velocity * up.cross(contact_.velocity);
}

ContactImpulse coulomb_impulse(const Contact& contact, const ImpactLaw& law, NormalCoupling coupling,
                               ImpulseSlopes* slopes) {
  if (slopes == nullptr) return CoulombPath<double>(contact, law, coupling, nullptr).follow();
  CoulombPath<PathDual> path(contact, law, coupling, slopes);
  const ContactImpulse result = path.follow();
  path.derive(result, *slopes);
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
ContactImpulse ratio_impulse(const Contact& contact, const ImpactLaw& law, NormalCoupling coupling,
                             ImpulseSlopes* slopes) {
  const Matrix3& w = contact.inverse_inertia;
  const double ratio = law.friction == FrictionKind::impulse_ratio ? law.friction_value : 0;
  const double speed = -contact.velocity.z();
  const Vector3 direction(ratio * law.ratio_direction.x(), ratio * law.ratio_direction.y(), 1);
  const double rate = coupling == NormalCoupling::none ? w(2, 2) : w.row(2).dot(direction);
  if (!(rate > 0)) jam(ratio);
  const double e = restitution_at(law, speed);
  ContactImpulse result;
  result.impulse = (1 + e) * speed / rate * direction;
  result.velocity_after = contact.velocity + w * result.impulse;
  result.velocity_after.z() = e * speed;
  result.compression_impulse = speed / rate;
  result.slip_stop_impulse = none;
  result.least_slip = std::fmin(contact.velocity.head<2>().norm(), result.velocity_after.head<2>().norm());
  result.path = ratio == 0 ? PathKind::frictionless : PathKind::slip;
  if (slopes == nullptr) return result;
  const detail::Dual<1> gain = 1 + restitution_at(law, detail::Dual<1>(speed, {1}));
  slopes->of_velocity = -(gain.value + speed * gain.slope[0]) / rate * direction * Vector3::UnitZ().transpose();
  for (std::size_t k = 0; k < 3; ++k) {
    slopes->of_turns.col(static_cast<int>(k)) = -slopes->turns[k].row(2).dot(direction) / rate * result.impulse;
  }
  return result;
}

ContactImpulse end_impulse(const Contact& contact, const ImpactLaw& law, NormalCoupling coupling,
                           ImpulseSlopes* slopes) {
  const MoreauContact at(contact, coupling == NormalCoupling::none, law.friction_value, law.restitution);
  const ContactImpulse result = at.impulse();
  if (slopes != nullptr) at.derive(result, *slopes);
  return result;
}

ContactImpulse impulse(const Contact& contact, const ImpactLaw& law, NormalCoupling coupling, ImpulseSlopes* slopes) {
  if (slopes != nullptr) slopes->of_turns = slopes->of_velocity = Matrix3::Constant(none);
  const bool at_end = law.friction == FrictionKind::moreau && law.friction_value > 0;
  const ContactImpulse result = at_end       ? end_impulse(contact, law, coupling, slopes)
                                : law.rubs() ? coulomb_impulse(contact, law, coupling, slopes)
                                             : ratio_impulse(contact, law, coupling, slopes);
  if (!result.impulse.allFinite() || !result.velocity_after.allFinite()) {
    throw NumericalError("the impulse of a corner overflows");
  }
  return result;
}

}  // namespace

ContactImpulse contact_impulse(const Contact& contact, const ImpactLaw& law, ImpulseSlopes* slopes) {
  return impulse(contact, law, NormalCoupling::of_friction, slopes);
}

ContactImpulse face_impulse(const FaceContact& face, const ImpactLaw& law) {
  Contact contact{.inverse_inertia = Matrix3::Identity() / face.mass,
                  .velocity = {face.slip.x(), face.slip.y(), -face.approach_speed},
                  .velocity_scale = face.velocity_scale};
  contact.inverse_inertia.block<2, 1>(0, 2) = face.drift;
  const ImpactLaw whole{.restitution = face.restitution,
                        .friction = law.friction,
                        .friction_value = law.friction_value,
                        .ratio_direction = law.ratio_direction};
  return impulse(contact, whole, NormalCoupling::none, nullptr);
}

}  // namespace clatter::analytic::space
