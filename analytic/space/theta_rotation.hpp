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

#include "analytic/space/principal_axes.hpp"

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
  [[nodiscard]] double period() const { return static_cast<double>(4 * quarter_ / rate_); }
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

}  // namespace clatter::analytic::space
