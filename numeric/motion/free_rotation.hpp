// SPDX-License-Identifier: GPL-3.0-or-later
// Torque-free rotation of a rigid body in closed form.
#pragma once

#include <array>
#include <variant>

#include "numeric/base/linear_algebra.hpp"
#include "numeric/motion/motion_state.hpp"

namespace clatter::numeric {

// Jacobi's elliptic functions of one modulus, up to its very limit.

/// sn, cn, dn for a given complementary parameter k'² = 1 − k².
///
/// A double k cannot tell a body that turns almost about its intermediate axis from one that does so exactly:
/// there k'² falls to 1e-34 and below.  Everything here starts from k'² and keeps its relative accuracy.
class JacobiFunctions {
 public:
  /// @param complementary_parameter k'² in [1e-200, 1].
  explicit JacobiFunctions(double complementary_parameter);

  struct Values {
    double sn = 0, cn = 1, dn = 1;
  };
  /// Values at u in [-K, K].  By descending Gauss transformations, in a form without differences:
  ///     T_N = a_N cot(a_N u),  dn_N = 1,
  ///     z = T_{n+1}²/a_{n+1},  T_n = T_{n+1} dn_{n+1},  dn_n = (b_n + z)/(a_n + z),  T_0 = cn/sn
  /// with a_n, b_n the arithmetic and geometric means from 1 and k'.
  /// Accuracy: a few eps of each value, and what an error of eps K in u does to it.
  /// Source: Bulirsch, Numer. Math. 7 (1965) 78.
  [[nodiscard]] Values at(double u) const;

  /// K = F(π/2) = π / (2 a_N).
  [[nodiscard]] double quarter_period() const { return quarter_period_; }

  /// u with sn(u) = sine, cn(u) = cosine >= 0:  F = s R_F(c², c² + k'² s², 1), in [-K, K].
  struct Amplitude {
    double sine = 0, cosine = 1;
  };
  [[nodiscard]] double argument(const Amplitude& amplitude) const;

  /// ∫ cn²/(1 + h sn²) du from |u| to K, h >= 0, from the values at u in [-K, K]:
  ///     cn³/(3 (1 + h) k') R_J(sn², 1, dn²/k'², (1 + h sn²)/(1 + h)),
  /// measured from the end where the integrand is small.  Accuracy: a few eps of the result.
  [[nodiscard]] double remaining_integral(const Values& values, double h) const;

 private:
  static constexpr int most_means = 16;  // k'² = 1e-200 takes 12

  double complement_;
  int means_ = 0;
  std::array<double, most_means> arithmetic_{};
  std::array<double, most_means> geometric_{};
  double quarter_period_ = 0;
};

struct PrincipalAxes {
  Vector3 moments = Vector3::Ones();   ///< ascending, units of the tensor
  Matrix3 axes = Matrix3::Identity();  ///< columns: unit axes, right-handed
};

/// I = axes · diag(moments) · axesᵀ.  A diagonal tensor keeps its numbers and axes exactly.
/// Accuracy otherwise: a few eps of the largest moment, and of 1 in the axes.
/// @throws std::domain_error unless the tensor is finite, symmetric and positive definite, with c <= a + b
/// for its moments a <= b <= c; symmetry and the last up to 1e-10 of the largest moment.
[[nodiscard]] PrincipalAxes principal_axes(const Matrix3& inertia);

/// Torque-free rotation about a fixed axis, or of a body with two equal principal moments.
///     A(t)  = A₀ R(p, |p| t) R(s, σ t)          precession about the momentum, spin about the axis of symmetry
///     ω′(t) = R(s, −σ t) ω′₀,   p = ω′₀ − σ s = I ω′₀/I_t,   σ = (1 − I_s/I_t) s·ω′₀
/// with R(a, φ) the turn by φ about a; σ = 0 is a rotation about a fixed axis.
class SteadyPrecession {
 public:
  struct Rates {
    Vector3 precession = Vector3::Zero();  ///< p, body frame at the start [rad/s]
    Vector3 spin_axis = Vector3::UnitZ();  ///< s, unit, body frame
    double spin = 0;                       ///< σ [rad/s]
  };
  SteadyPrecession(const Rotation& start, const Rates& rates);
  /// About the fixed axis of the angular velocity.
  explicit SteadyPrecession(const Rotation& start) : SteadyPrecession(start, {.precession = start.angular_velocity}) {}

  [[nodiscard]] Rotation at(double time) const;
  [[nodiscard]] double largest_speed() const;
  [[nodiscard]] double largest_acceleration() const;

 private:
  Rotation start_;
  Vector3 precession_axis_ = Vector3::UnitZ();
  double precession_ = 0;
  Vector3 spin_axis_;
  double spin_;
};

/// Torque-free rotation that is neither about a fixed axis nor of a body with two equal moments.
///
/// Axis 3 is the one that the momentum circles: that of the largest moment if L² >= 2T I_middle, that of the
/// smallest otherwise; axis 2 has the middle moment.  With T, L energy and momentum, d_ij = |I_i − I_j| and
///     X = |2T I₃ − L²| = I₁ d₁₃ ω₁² + I₂ d₂₃ ω₂²,    Y = |L² − 2T I₁| = I₂ d₁₂ ω₂² + I₃ d₁₃ ω₃²          (1)
///     S = |L² − 2T I₂| = I₃ d₂₃ ω₃² − I₁ d₁₂ ω₁²                                                        (2)
///     ω₁ = W₁ cn u,  ω₂ = W₂ sn u,  ω₃ = W₃ dn u,    u = u₀ + λ t                                        (3)
///     W₁² = X/(I₁ d₁₃),  W₂² = X/(I₂ d₂₃),  W₃² = Y/(I₃ d₁₃),  λ² = d₂₃ Y/(I₁ I₂ I₃)
///     k² = d₁₂ X/(d₂₃ Y),    k'² = d₁₃ S/(d₂₃ Y)                                                         (4)
/// The attitude follows from the frame F = (e₁, e₂, e₃) of the momentum e₃ and the axis of the smallest moment,
/// e₂ ∥ axis × e₃, which only turns about e₃:
///     A(t) = A₀ F₀ R₃(ψ) Fᵀ                                                                             (5)
///     ψ = |L| [t/c + r′ (c − a)/c² (t − (J(u) − J(u₀))/λ)],   J = ∫ cn²/(1 + h sn²) du,   h = r a/c     (6)
/// with a < b < c the moments, r = X/Y for axis 3 of moment c, r = (c − b)/(b − a) for a, r′ = r/(1 + h).
/// Every term of (1) is positive, and ψ̇ lies between |L|/c and |L|/b <= 2|L|/c, so that nothing cancels
/// whatever the shape of the body.  (6) holds ψ̇ at its value for sn² = 1, near which a body with almost equal
/// moments or almost on the separatrix stays longest.
///
/// Accuracy: a few eps times the number of radians turned; a relative change of some eps in `start` has
/// the same effect.
class EllipticRotation {
 public:
  /// Moments and angular velocity must be of the order of 1, the moments different, and at least two
  /// components of the velocity along the principal axes above 1e-120.
  EllipticRotation(const PrincipalAxes& principal, const Rotation& start);

  [[nodiscard]] Rotation at(double time) const;
  [[nodiscard]] double largest_speed() const;
  [[nodiscard]] double largest_acceleration() const;

 private:
  /// What at() needs of (1) to (4); the names follow the equations.
  struct Constants {
    Vector3 moments;     ///< I₁, I₂, I₃
    Matrix3 axes;        ///< columns: axes 1, 2, 3 in the body frame, right-handed
    Vector3 amplitudes;  ///< W₁, W₂, W₃ with the signs that make λ, cn u₀ >= 0
    double rate;         ///< λ
    double complement;   ///< k'²
    double ratio;        ///< r
    JacobiFunctions::Amplitude start;
  };
  static Constants constants(const PrincipalAxes& principal, const Vector3& angular_velocity);
  EllipticRotation(const Constants& constants, const Eigen::Quaterniond& attitude);
  [[nodiscard]] Matrix3 momentum_frame(const Vector3& momentum) const;
  [[nodiscard]] double integral(const JacobiFunctions::Values& values) const;  ///< J(u), u in [-K, K]

  Constants c_;
  JacobiFunctions jacobi_;
  Eigen::Quaterniond start_attitude_;
  Matrix3 start_frame_;        ///< F₀, in the body frame
  int reference_;              ///< index of the axis with the smallest moment
  double start_argument_;      ///< u₀
  double modulation_;          ///< h
  double quarter_integral_;    ///< J(K)
  double start_integral_;      ///< J(u₀)
  double fastest_precession_;  ///< ψ̇ at sn² = 1
  double precession_swing_;    ///< |L| r′ (c − a)/(c² λ)
};

/// Solution of I ω̇′ + ω′ × I ω′ = 0 with β̇ = ½ β ω′ from the given start.
/// Elementary for rotation about a principal axis and for a body with two equal principal moments, in Jacobi's
/// elliptic functions and an elliptic integral of the third kind otherwise.
/// Accuracy: a few eps times the number of radians turned, in units of 1 and of |ω|.
class FreeRotation {
 public:
  /// `inertia` about the centre of mass, body frame, symmetric positive definite, principal moments satisfying the
  /// triangle inequality up to rounding [kg·m²].
  /// @throws std::domain_error if it is not, or a number is not finite, or the attitude is zero.
  FreeRotation(const Matrix3& inertia, const Rotation& start);

  /// The rotation after `time` [s], of either sign.  No allocation.  Beyond 2⁵³ turns the phase has no digit
  /// left, but the attitude is still unit and the energy right.
  /// @throws std::domain_error if `time` is not a number.
  [[nodiscard]] Rotation at(double time) const;

  /// Bounds over all times, from energy and momentum: |ω| [rad/s] and |ω̇| [rad/s²].
  [[nodiscard]] double largest_speed() const;
  [[nodiscard]] double largest_acceleration() const;

 private:
  double rate_;  ///< power of two by which times are multiplied and velocities divided [1/s]
  std::variant<SteadyPrecession, EllipticRotation> rotation_;
};

}  // namespace clatter::numeric
