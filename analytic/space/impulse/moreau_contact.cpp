// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/space/impulse/moreau_contact.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

#include "analytic/base/errors.hpp"

namespace clatter::analytic::space {
namespace {

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

}  // namespace

MoreauContact::MoreauContact(const Contact& contact, bool is_face, double friction, double restitution)
    : contact_(contact), friction_(friction), restitution_(restitution),
      rise_(-(1 + restitution) * contact.velocity.z()) {
  const Matrix3& w = contact.inverse_inertia;
  coupling_ = is_face ? Vector2::Zero().eval() : Vector2(w(2, 0), w(2, 1));
  const Vector2 drift = w.block<2, 1>(0, 2) / w(2, 2);
  q_ = contact.velocity.head<2>() + rise_ * drift;
  m_ = w.topLeftCorner<2, 2>() - drift * coupling_.transpose();
}

ContactImpulse MoreauContact::impulse() const {
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

/// The root of (2) near an angle, by Newton's steps.
double MoreauContact::refined(double angle) const {
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

std::optional<MoreauContact::Slip> MoreauContact::slip_along(double angle) const {
  const Vector2 s = heading(angle);
  const double open = contact_.inverse_inertia(2, 2) - friction_ * coupling_.dot(s);
  if (!(open > 0)) return std::nullopt;
  const double pressing = rise_ / open;
  const Vector2 pushed = -friction_ * pressing * s, after = q_ + m_ * pushed;
  const double sized = q_.norm() + (m_ * pushed).norm();
  if (!(after.dot(s) >= -parallel * sized) || !(std::fabs(cross(s, after)) <= parallel * sized)) return std::nullopt;
  return Slip{{pushed.x(), pushed.y(), pressing}, std::max(after.dot(s), 0.0) * s};
}

ContactImpulse MoreauContact::result_of(const Vector3& impulse, const Vector2& slip, PathKind path) const {
  ContactImpulse result;
  result.impulse = impulse;
  result.velocity_after = {slip.x(), slip.y(), -restitution_ * contact_.velocity.z()};
  result.compression_impulse = impulse.z() / (1 + restitution_);
  result.slip_stop_impulse = std::numeric_limits<double>::quiet_NaN();
  result.least_slip = std::fmin(contact_.velocity.head<2>().norm(), slip.norm());
  result.path = path;
  return result;
}

/// Slip: P_t + μ P_n v′_t/|v′_t| = 0, changed by a change of v′ in its direction alone; stick: v′_t = 0.
void MoreauContact::derive(const ContactImpulse& result, ImpulseSlopes& slopes) const {
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

}  // namespace clatter::analytic::space
