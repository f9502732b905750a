// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/space/impulse/impulse_path.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <optional>
#include <sstream>
#include <type_traits>

#include "analytic/base/errors.hpp"
#include "analytic/base/limits.hpp"
#include "analytic/law/coulomb_path.hpp"
#include "analytic/space/flight/body.hpp"
#include "analytic/space/impulse/path_progress.hpp"
#include "analytic/space/impulse/slip_field.hpp"
#include "analytic/space/impulse/turning_slip.hpp"

namespace clatter::analytic::space {

namespace {

// The impulse of one corner with friction judged by the slip after the impact.

constexpr double near_circle = 1e-4;  ///< of roots that may have an angle, before they are refined
constexpr double same_angle = 1e-9;   ///< of roots that count as one
constexpr double parallel = 1e-12;    ///< sine between slips that counts as none
constexpr double least_sine =
    4 * std::numeric_limits<double>::epsilon();  ///< sine of an angle from x or y that counts as none

/// Exact along x and y, so that motion in a plane stays there.
Vector2 heading(double angle) {
  const double x = std::cos(angle), y = std::sin(angle);
  if (std::fabs(y) < least_sine) return {std::copysign(1, x), 0};
  if (std::fabs(x) < least_sine) return {0, std::copysign(1, y)};
  return {x, y};
}

/// Newton's restitution and Coulomb's cone for the velocity after the impact,
///     v′ = v + W P,   v′_n = −e v_n,   |P_t| <= μ P_n,   P_t = −μ P_n s,  s = v′_t/|v′_t|,  where v′_t ≠ 0.     (1)
/// Source: J. J. Moreau, Unilateral contact and dry friction in finite freedom dynamics (1988), without tangential
/// restitution.  On the plane v′_n = −e v_n P_n = (r − k·P_t)/W_nn and v′_t = q + M P_t are linear in P_t, with r =
/// −(1+e) v_n and k = W_nt.  The corner sticks if P_t = −M⁻¹q lies in the cone; otherwise the direction s solves
///     (W_nn − μ k·s)(s × q) = μ r (s × M s),                                                                      (2)
/// a polynomial of fourth degree in exp(iθ), with W_nn > μ k·s and s·(q − μ P_n M s) >= 0.
class MoreauContact {
 public:
  /// @param is_face  whether friction leaves the normal motion alone, k = 0
  MoreauContact(const Contact& contact, bool is_face, double friction, double restitution)
      : contact_(contact), friction_(friction), restitution_(restitution),
        rise_(-(1 + restitution) * contact.velocity.z()) {
    const Matrix3& w = contact.inverse_inertia;
    coupling_ = is_face ? Vector2::Zero().eval() : Vector2(w(2, 0), w(2, 1));
    const Vector2 drift = w.block<2, 1>(0, 2) / w(2, 2);
    q_ = contact.velocity.head<2>() + rise_ * drift;
    m_ = w.topLeftCorner<2, 2>() - drift * coupling_.transpose();
  }

  /// Where several directions solve (2), as can be for μ k near W_nn, that which leaves the least energy, as an
  /// ambiguous path.  Accuracy: rounding of W and v times the condition of (2).
  /// @throws NumericalError where none does in double precision.
  [[nodiscard]] ContactImpulse impulse() const {
    const double normal = contact_.inverse_inertia(2, 2), friction = friction_;
    const Vector2 holding = -(m_.inverse() * q_);
    const double pressing = (rise_ - coupling_.dot(holding)) / normal;
    if (holding.norm() <= friction * pressing) {
      const bool slips = contact_.velocity.head<2>() != Vector2::Zero();
      return result_of({holding.x(), holding.y(), pressing}, Vector2::Zero(),
                       slips ? PathKind::slip_stick : PathKind::stick);
    }
    // With z = exp(iθ): s × q = Re(a z), k·s = Re(b z), s × M s = c0 + Re(c z²).
    using Complex = std::complex<double>;
    const double size = q_.norm() + friction * rise_ / normal * m_.norm();
    const Complex a = Complex(q_.y(), q_.x()) / size, b = Complex(coupling_.x(), -coupling_.y()) / normal;
    const double scale = friction * rise_ / normal / size;
    const Complex c = scale * Complex((m_(1, 0) + m_(0, 1)) / 2, (m_(0, 0) - m_(1, 1)) / 2);
    const double c0 = scale * (m_(1, 0) - m_(0, 1)) / 2;
    // Re(a z) − μ Re(a z) Re(b z) − c0 − Re(c z²) = 0, times 2 z².
    const Complex square = -friction * a * b / 2.0 - c;
    const double constant = -friction * std::real(a * std::conj(b)) - 2 * c0;
    Eigen::Matrix4cd companion = Eigen::Matrix4cd::Zero();
    Eigen::Vector4cd low{std::conj(square), std::conj(a), constant, a};
    std::optional<Slip> best;
    int ways = 0;
    double best_angle = 0;
    const auto look = [&](double angle) {
      angle = refined(angle);
      const auto slip = slip_along(angle);
      if (!slip) return;
      if (best && std::fabs(std::remainder(angle - best_angle, 2 * std::numbers::pi)) <= same_angle) return;
      ++ways;
      const auto energy = [&](const Slip& way) {
        return way.impulse.head<2>().dot(way.after + contact_.velocity.head<2>()) +
               way.impulse.z() * (1 - restitution_) * contact_.velocity.z();
      };
      if (best && !(energy(*slip) < energy(*best))) return;
      best = slip;
      best_angle = angle;
    };
    if (std::abs(square) > std::numeric_limits<double>::min()) {
      companion.diagonal(-1).setOnes();
      companion.col(3) = -low / square;
      const Eigen::ComplexEigenSolver<Eigen::Matrix4cd> roots(companion, false);
      for (const Complex& z : roots.eigenvalues()) {
        if (std::fabs(std::abs(z) - 1) <= near_circle) look(std::arg(z));
      }
    }
    // Where the degree falls, and where roots lie close together: slip without turning.
    if (!best) {
      for (const double angle : {std::atan2(q_.y(), q_.x()), std::atan2(-holding.y(), -holding.x())}) look(angle);
    }
    if (!best) throw NumericalError("no direction of slip after the impact satisfies Moreau's law in double precision");
    const Vector2 slip = contact_.velocity.head<2>();
    const bool goes_on = slip.dot(best->after) >= 0,
               turns = std::fabs(cross(slip, best->after)) > parallel * slip.norm() * best->after.norm();
    ContactImpulse result = result_of(best->impulse, best->after,
                                      !goes_on ? PathKind::slip_reslip
                                      : turns  ? PathKind::turning_slip
                                               : PathKind::slip);
    result.is_path_ambiguous = ways > 1;
    return result;
  }

  /// From (1), linearised about `result`, which impulse() gave.

  /// Slip: P_t + μ P_n v′_t/|v′_t| = 0, changed by a change of v′ in its direction alone; stick: v′_t = 0.
  void derive(const ContactImpulse& result, ImpulseSlopes& slopes) const {
    const Matrix3& w = contact_.inverse_inertia;
    Matrix3 of_impulse, of_velocity = Matrix3::Identity();  // of the three conditions, to be zero
    Matrix3 reached = w;                                    // v′ per P
    reached.row(2).head<2>() = coupling_.transpose();
    const Vector2 slip = result.velocity_after.head<2>();
    of_velocity(2, 2) = 1 + restitution_;
    of_impulse.row(2) = reached.row(2);
    Matrix2 kept = Matrix2::Identity();
    if (slip.norm() > 0) {
      const Vector2 s = slip.normalized();
      kept = friction_ * result.impulse.z() * (Matrix2::Identity() - s * s.transpose()) / slip.norm();
      of_impulse.topRows<2>() = kept * reached.topRows<2>();
      of_impulse.topLeftCorner<2, 2>() += Matrix2::Identity();
      of_impulse.block<2, 1>(0, 2) += friction_ * s;
    } else {
      of_impulse.topRows<2>() = reached.topRows<2>();
    }
    of_velocity.topLeftCorner<2, 2>() = kept;
    const Matrix3 answer = -of_impulse.inverse();
    slopes.of_velocity = answer * of_velocity;
    Matrix3 of_turned = of_velocity;
    of_turned(2, 2) = 1;  // δ(W P) adds to v′, not to v
    for (std::size_t k = 0; k < 2; ++k)
      slopes.of_turns.col(static_cast<int>(k)) = answer * of_turned * (slopes.turns[k] * result.impulse);
    const Vector3 up = Vector3::UnitZ();
    slopes.of_turns.col(2) = up.cross(result.impulse) - slopes.of_velocity * up.cross(contact_.velocity);
  }

 private:
  struct Slip {
    Vector3 impulse;
    Vector2 after;
  };

  [[nodiscard]] std::optional<Slip> slip_along(double angle) const {
    const Vector2 s = heading(angle);
    const double open = contact_.inverse_inertia(2, 2) - friction_ * coupling_.dot(s);
    if (!(open > 0)) return std::nullopt;
    const double pressing = rise_ / open;
    const Vector2 pushed = -friction_ * pressing * s, after = q_ + m_ * pushed;
    const double sized = q_.norm() + (m_ * pushed).norm();
    if (!(after.dot(s) >= -parallel * sized) || !(std::fabs(cross(s, after)) <= parallel * sized)) return std::nullopt;
    return Slip{{pushed.x(), pushed.y(), pressing}, std::max(after.dot(s), 0.0) * s};
  }

  /// The root of (2) near an angle, by Newton's steps.
  [[nodiscard]] double refined(double angle) const {
    const double normal = contact_.inverse_inertia(2, 2), pushed = friction_ * rise_;
    for (int i = 0; i < 20; ++i) {
      const Vector2 s = heading(angle), ahead(-s.y(), s.x());
      const double open = normal - friction_ * coupling_.dot(s);
      const double value = open * cross(s, q_) - pushed * cross(s, m_ * s);
      const double slope = -friction_ * coupling_.dot(ahead) * cross(s, q_) + open * cross(ahead, q_) -
                           pushed * (cross(ahead, m_ * s) + cross(s, m_ * ahead));
      const double step = value / slope;
      if (!std::isfinite(step)) break;
      angle -= std::clamp(step, -0.1, 0.1);
      if (std::fabs(step) <= 4 * std::numeric_limits<double>::epsilon()) break;
    }
    return angle;
  }

  [[nodiscard]] ContactImpulse result_of(const Vector3& impulse, const Vector2& slip, PathKind path) const {
    ContactImpulse result;
    result.impulse = impulse;
    result.velocity_after = {slip.x(), slip.y(), -restitution_ * contact_.velocity.z()};
    result.compression_impulse = impulse.z() / (1 + restitution_);
    result.slip_stop_impulse = std::numeric_limits<double>::quiet_NaN();
    result.least_slip = std::fmin(contact_.velocity.head<2>().norm(), slip.norm());
    result.path = path;
    return result;
  }

  const Contact& contact_;
  double friction_, restitution_;
  double rise_;       ///< r
  Vector2 coupling_;  ///< k
  Vector2 q_;         ///< v′_t without friction
  Matrix2 m_;         ///< M
};

}  // namespace

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

  ContactImpulse follow() {
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

  /// After follow().

  /// P is v/W_nn times what progress_ has; a turn about the vertical turns it with v.
  void derive(const ContactImpulse& result, ImpulseSlopes& slopes) const {
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

 private:
  static constexpr bool follows_slopes = !std::is_same_v<Number, double>;
  using Row = SlipFieldSlopes::Row;

  void slip() {
    const double angle = std::atan2(velocity_.y(), velocity_.x());
    const auto straight = straight_direction(angle);
    if (!straight) return slip_along_arc(angle);
    const double slip = value_of(progress_.slip);
    slip_straight(rates(*straight, Row::Zero()));
    if constexpr (follows_slopes) turn_straight_slip(slip);
  }

  /// Slip along one line, to where it stops or the law ends.
  void slip_straight(const SlipRates<Number>& s) {
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

  void slip_along_arc(double angle) {
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

  void go_on_from_rest(bool has_slipped) {
    if (field_.can_stick()) {
      kind_ = has_slipped ? PathKind::slip_stick : PathKind::stick;
      if (!has_slipped) stick_from_slip();
      return progress_.follow(sticking());
    }
    kind_ = has_slipped ? PathKind::slip_reslip : PathKind::slip;
    slip_straight(rates(field_.outgoing(), turn_of_zero(field_.outgoing())));
    if (!has_slipped) forget_slopes();
  }

  /// The friction of slip that leaves its invariant direction by ψ: σ dψ/dp = γ ψ + δg, γ = g′.  With dp = σ dτ,
  ///     ∫ ψ dp = ψ₀ K₁ + δg K₂,   K₁ = ∫ e^{γτ} dp,   K₂ = ∫ (e^{γτ} − 1)/γ dp,   σ = σ₀ e^{fτ}.
  /// In a plane of symmetry f and h keep their values to first order; elsewhere slip that turns has no closed form
  /// here.
  void turn_straight_slip(double start_slip) {
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

  /// Sticking friction that has to stop a small slip first: A P_t + v_t = 0 beside what the normal impulse asks for.
  void stick_from_slip() {
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

  void forget_slopes() {
    if constexpr (follows_slopes) progress_.at.impulse.slope.fill(none);
  }

  [[nodiscard]] Number initial_slip() const {
    const double slip = velocity_.norm();
    if constexpr (follows_slopes) {
      if (slip == 0) return slip;
      const Vector2 along = field_.to_world(velocity_ / slip);
      return Number(slip, {0, 0, along.x(), along.y(), 0});
    } else {
      return slip;
    }
  }

  /// −v_z, and |v_t|: derivatives are by v in units of the approach speed.
  [[nodiscard]] static Number approach() {
    if constexpr (follows_slopes) return Number(1, {0, 0, 0, 0, -1});
    else return 1;
  }

  [[nodiscard]] SlipRates<Number> rates(const Direction& s, const Row& turn) const {
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
  [[nodiscard]] Row turn_of_zero(const Direction& zero) const {
    if constexpr (follows_slopes) return -slopes_->turning(zero) / field_.turning_slope(zero);
    else return Row::Zero();
  }

  /// Derivatives of the angle of slip at the start.
  [[nodiscard]] std::array<double, 5> initial_turn() const {
    const Vector2 across = field_.to_world(Vector2(-velocity_.y(), velocity_.x()) / velocity_.squaredNorm());
    return {0, 0, across.x(), across.y(), 0};
  }

  /// P_t/p and du/dp of a point that does not slip.
  [[nodiscard]] typename PathProgress<Number>::Line sticking() const {
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

  /// A direction of slip this near to an invariant one is not distinct from it: rounding of v and of g.
  [[nodiscard]] double direction_tolerance(const Direction& zero) const {
    const double of_velocity = 4 * contact_.velocity_scale / (speed_ * velocity_.norm());
    return epsilon * of_velocity + turning_tolerance(zero);
  }

  /// The part of that which g has, however slow slip is.
  [[nodiscard]] double turning_tolerance(const Direction& zero) const {
    return 8 * epsilon * (1 + field_.rounding_scale() / std::fabs(field_.turning_slope(zero)));
  }

  /// The direction that slip at this angle keeps, if it turns no more than rounding says: its own, or the invariant one
  /// where v, not g, leaves the two apart: slip of rounding's size can be far off it, and grows along it alone.
  [[nodiscard]] std::optional<Direction> straight_direction(double angle) const {
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

  [[nodiscard]] bool is_ambiguous() const {
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

ContactImpulse moreau_impulse(const Contact& contact, double friction, double restitution) {
  return MoreauContact(contact, false, friction, restitution).impulse();
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
