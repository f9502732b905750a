// SPDX-License-Identifier: GPL-3.0-or-later
// Torque-free rotation of a body with different principal moments, by theta functions.
//
// Axes: 3 is the one that the momentum circles (largest moment if L² >= 2T I_middle, else smallest), 2 has the middle
// moment; signs such that ω₁, ω₃ >= 0 at t = 0.  With d_ij = |I_i − I_j|, σ = sign(I₃ − I₁),
//     X = I₁ d₁₃ ω₁² + I₂ d₂₃ ω₂²,   Y = I₂ d₁₂ ω₂² + I₃ d₁₃ ω₃²,   S = I₃ d₂₃ ω₃² − I₁ d₁₂ ω₁²,
//     λ² = d₂₃ Y/(I₁ I₂ I₃),   k² = d₁₂ X/(d₂₃ Y),   k′² = d₁₃ S/(d₂₃ Y),   u = u₀ + λ t,            (1)
// the unit momentum in principal axes is m = (M₁ cn u, σ M₂ sn u, M₃ dn u), Jacobi's solution of Euler's equations.
//
// Attitude: B(t) = R₃(Φ) Q(m) takes principal axes to a frame whose axis 3 is the momentum, Q(m) the shortest rotation
// from m to axis 3.  As m₃ > 0 always, Q never turns singular, and its angle obeys
//     Φ̇ = ω·(m + e₃)/(1 + m₃) = (2T/|L| + ω₃)/(1 + M₃ dn u),                                       (2)
// an elliptic function of u without a pole nearer to the real axis than K′ + b, sn(b, k′) = M₃.  Its integral is
//     Φ = c u − 2σ arg ϑ₄(πu/2K + iπ(K′ − b)/2K; nome e^{−2πK′/K})                                     (3)
// or, by Jacobi's imaginary transformation, with another c,
//     Φ = c u − 2σ arg ϑ₂(π(K′ − b)/4K′ − iπu/4K′; nome e^{−πK/2K′}),   |u| <= K.                      (4)
// (3) serves where k² <= 1/2 and (4) elsewhere, so that four to six terms of a series suffice, at the separatrix too.
// c follows from (2) at u = 0.
#pragma once

#include <array>
#include <optional>

#include "analytic/space/flight/body.hpp"

namespace clatter::analytic::space {

/// Components of an angular velocity along the principal axes, in their order [rad/s].
using PrincipalVelocity = std::array<long double, 3>;

/// The rotation above.  Phases are kept in long double, so that a thousand turns leave a double its digits.
class ThetaRotation {
 public:
  /// Whether this motion is one about a fixed axis, which (1) does not describe.
  [[nodiscard]] static bool is_steady(const PrincipalAxes& principal, const PrincipalVelocity& velocity);
  /// A motion that is_steady() does not hold for.
  ThetaRotation(const PrincipalAxes& principal, const PrincipalVelocity& velocity);

  /// Frame and motion at a time.
  struct Moment {
    Vector3 momentum;     ///< m, unit, axes 1 to 3
    double cosine, sine;  ///< of Φ but for a constant
  };
  [[nodiscard]] Moment at(double time) const;

  /// Columns: axes 1, 2, 3 in the body frame.
  [[nodiscard]] const PrincipalAxes::Matrix& axes() const { return axes_; }
  /// I₁, I₂, I₃, axes as above [kg·m²].
  [[nodiscard]] const Vector3& moments() const { return moments_; }
  /// |L| [kg·m²/s].
  [[nodiscard]] double momentum() const { return momentum_; }
  /// M₁, M₂, M₃: largest sizes of the components of m.
  [[nodiscard]] const Vector3& amplitudes() const { return amplitudes_; }
  /// k² of (1).
  [[nodiscard]] double modulus_square() const { return modulus_square_; }
  /// 4K/λ, after which ω in body axes repeats; infinite on the separatrix [s].
  [[nodiscard]] double period() const;
  /// σ of (1), 1 or −1.
  [[nodiscard]] double sense() const { return sense_; }
  /// λ of (1) [1/s].
  [[nodiscard]] double rate() const { return static_cast<double>(rate_); }
  /// ∫ sn² du from 0 to u at a time, by Carlson's R_D: sn³ R_D(cn², dn², 1)/3 for |u| <= K.
  [[nodiscard]] double square_integral(double time) const;
  /// k′ M₃: the least that m₃ becomes.
  [[nodiscard]] double least_third() const { return least_third_; }

 private:
  struct Constants;
  /// sn, cn, dn, and the theta function of (3) or (4).
  struct Functions {
    double sn = 0, cn = 0, dn = 0, real = 0, imaginary = 0;
  };
  static constexpr int terms = 6;
  using Series = std::array<double, terms>;

  void order(const PrincipalAxes& principal, const PrincipalVelocity& velocity, Constants& c);
  void set_direct(const Constants& c);
  void set_dual(const Constants& c);
  [[nodiscard]] Functions direct(double v) const;
  [[nodiscard]] Functions dual(double argument) const;

  PrincipalAxes::Matrix axes_;
  Vector3 moments_, amplitudes_;
  double momentum_ = 0, modulus_square_ = 0, least_third_ = 0, sense_ = 1;
  bool dual_ = false;
  long double rate_ = 0, start_ = 0, quarter_ = 0;  ///< λ, u₀, K
  long double precession_ = 0;                      ///< c λ of (3) or (4) [rad/s]
  long double half_turn_ = 0;                       ///< Φ(u + 2K) − Φ(u) − 2 c K
  double scale_ = 1;                                ///< π/2K, or π/2K′ in (4)
  double nome_ = 0;                                 ///< e^{−πK′/K}, or e^{−πK/2K′} in (4)
  double sn_ = 1, cn_ = 1, dn_ = 1;                 ///< their constant factors
  Series real_{}, imaginary_{};                     ///< coefficients of ϑ₄ or ϑ₂
};

// Torque-free rotation of a body in space, in closed form.

/// What heights above the ground need of a rotation: e = Aᵀ z, the vertical in body axes, and its rates.
/// A point at r in the body is e·r above the centre of mass.
struct Vertical {
  Vector3 direction = Vector3::UnitZ();  ///< e
  Vector3 rate = Vector3::Zero();        ///< ė = e × ω [1/s]
  Vector3 second = Vector3::Zero();      ///< ë = ė × ω + e × ω̇ [1/s²]
};

/// Rotation without torque: about a fixed axis (a sphere, a principal axis), or by ThetaRotation.
/// Accuracy: a few ulp of double, and of long double × the number of radians turned; near the separatrix a relative
/// error of the start grows by 1/k′² of free_flight.hpp (1), with which long double rounding counts too.
class FreeRotation {
 public:
  FreeRotation(const PrincipalAxes& principal, const Quaternion& attitude, const Vector3& angular_velocity);

  /// Body to world, unit.
  [[nodiscard]] Quaternion attitude(double time) const;
  /// Body axes [rad/s].
  [[nodiscard]] Vector3 angular_velocity(double time) const;
  [[nodiscard]] Vertical vertical(double time) const;

  /// Bound on |ω| at all times [rad/s].
  [[nodiscard]] double fastest() const { return fastest_; }
  /// About a fixed axis, or no rotation at all.
  [[nodiscard]] bool is_steady() const { return !theta_; }
  /// The rotation of different principal moments, unless it is steady.
  [[nodiscard]] const std::optional<ThetaRotation>& theta() const { return theta_; }
  /// Bound γ <= 1/√2 in |ω̇| <= γ |ω|²: from Euler's equations, whose coefficients are below 1 by the triangle
  /// inequality.
  [[nodiscard]] double acceleration_factor() const { return acceleration_factor_; }
  /// The axis that the momentum circles, or of a steady rotation; body frame, unit.
  [[nodiscard]] const Vector3& spin_axis() const { return axis_; }
  /// Bound on the speed at which spin_axis() turns, |ω| across that axis [rad/s].
  [[nodiscard]] double axis_speed() const { return axis_speed_; }
  /// Bound on how far the point `place` comes below the centre of mass at any time, from |r| and the angles that r and
  /// the vertical make with the momentum [m].
  [[nodiscard]] double depth(const Vector3& place) const;

 private:
  struct Spin {
    Vector3 vertical, velocity;  ///< e, ω in axes 1 to 3
  };
  [[nodiscard]] Spin spin(double time) const;
  [[nodiscard]] Vertical steady_vertical(double time) const;

  std::optional<ThetaRotation> theta_;
  Quaternion start_;                           ///< attitude at t = 0
  Vector3 start_vertical_ = Vector3::UnitZ();  ///< e at t = 0
  Vector3 axis_ = Vector3::UnitX();            ///< spin_axis()
  long double speed_ = 0;                      ///< of a steady rotation [rad/s]
  Matrix3 axes_ = Matrix3::Identity();         ///< columns: axes 1, 2, 3 in the body frame
  Quaternion axes_attitude_, frame_;           ///< as quaternions; frame of the momentum to world
  Vector3 frame_vertical_ = Vector3::UnitZ();  ///< world's vertical in the frame of the momentum
  Vector3 inverse_moments_ = Vector3::Ones();  ///< |L|/I_i
  Vector3 coefficients_ = Vector3::Zero();     ///< (I₂ − I₃)/I₁ and so on
  double fastest_ = 0, acceleration_factor_ = 0, axis_speed_ = 0;
};

// Free flight of a body in space: a parabola and a torque-free rotation.

/// Motion without contact from a state at t = 0.
class FreeFlight {
 public:
  /// @param gravity g >= 0, towards the ground; gravity_along along x [m/s²]
  FreeFlight(const PrincipalAxes& principal, const State& start, double gravity, double gravity_along = 0)
      : start_(start), gravity_(gravity), gravity_along_(gravity_along),
        rotation_(principal, start.attitude, start.angular_velocity) {}

  [[nodiscard]] State at(double time) const;
  /// Height of the centre of mass and its velocity at a time.
  [[nodiscard]] double centre_height(double t) const {
    return start_.position.z() + t * (start_.velocity.z() - gravity_ / 2 * t);
  }
  [[nodiscard]] double centre_velocity(double t) const { return start_.velocity.z() - gravity_ * t; }
  /// Last time at which the centre of mass is at this height on its way down; infinite if it never is, 0 if that lies
  /// in the past [s].
  [[nodiscard]] double falls_through(double height) const;
  /// First time at which the centre of mass is at this height on its way up; 0 if it starts above, infinite if never.
  [[nodiscard]] double rises_through(double height) const;

  [[nodiscard]] const State& start() const { return start_; }
  [[nodiscard]] double gravity() const { return gravity_; }
  [[nodiscard]] double gravity_along() const { return gravity_along_; }
  [[nodiscard]] const FreeRotation& rotation() const { return rotation_; }

 private:
  State start_;
  double gravity_, gravity_along_;
  FreeRotation rotation_;
};

}  // namespace clatter::analytic::space
