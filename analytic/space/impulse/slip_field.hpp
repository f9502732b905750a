// SPDX-License-Identifier: GPL-3.0-or-later
// How slip grows and turns along the path of an impact in impulse space, as functions of its direction alone.
//
// With A = W_tt, b = W_tn, c = W_nn of the inverse contact inertia, slip σ in direction s = (cos φ, sin φ), t ⟂ s:
//     dσ/dp = f(φ) = s·(b − μ A s),   σ dφ/dp = g(φ) = t·(b − μ A s),   dv_n/dp = h(φ) = c − μ b·s.      (1)
// In the principal axes of A = diag(a₁, a₂), a₁ >= a₂, with signs so that b₁, b₂ >= 0, and D = μ (a₁ − a₂):
//     g = b₂ cos φ − b₁ sin φ + D sin φ cos φ.                                                              (2)
// Divided by sin φ cos φ, g is monotone in the first and in the third quadrant and convex in the fourth, so that slip
// has one invariant direction g = 0 in each of the former (attracting, repelling), none in the second and, if
//     D > (b₁^⅔ + b₂^⅔)^{3/2}   (the astroid),                                                            (3)
// an attracting and a repelling one in the fourth.  f < 0 in the third and fourth: slip along those stops.
// Source: Bhatt and Koechling (1995) for invariant directions; (2), (3) follow from (1).
#pragma once

#include <array>

#include "analytic/space/flight/body.hpp"

namespace clatter::analytic::space {

/// An angle with its cosine and sine.
struct Direction {
  double angle = 0;
  double cosine = 1;
  double sine = 0;
};
[[nodiscard]] Direction direction_at(double angle);

/// A zero of g, in the frame of SlipField.
struct InvariantAngle {
  Direction at;
  bool attracts = true;  ///< g falls through zero
};

/// Whether friction acts on the normal velocity: h = c − μ b·s, or c for a face (impulse_path.hpp).
enum class NormalCoupling { of_friction, none };

/// f, g and h of (1) in units of W_nn, in the frame of (2).
class SlipField {
 public:
  /// @param inverse_contact_inertia W, symmetric positive definite (A at least, without normal coupling)
  /// @param friction μ >= 0
  SlipField(const Matrix3& inverse_contact_inertia, double friction,
            NormalCoupling coupling = NormalCoupling::of_friction);

  [[nodiscard]] Vector2 to_frame(const Vector2& world) const { return axes_.transpose() * world; }
  [[nodiscard]] Vector2 to_world(const Vector2& frame) const { return axes_ * frame; }

  /// f: how slip grows.
  [[nodiscard]] double slip_rate(const Direction& s) const {
    return b1_ * s.cosine + b2_ * s.sine - friction_ * (a1_ * s.cosine * s.cosine + a2_ * s.sine * s.sine);
  }
  /// h: how the normal velocity grows.
  [[nodiscard]] double normal_rate(const Direction& s) const {
    return 1 - normal_coupling_ * friction_ * (b1_ * s.cosine + b2_ * s.sine);
  }
  /// Bound on |g| and |f′|.
  [[nodiscard]] double turning_bound() const { return b1_ + b2_ + anisotropy_; }
  /// Rounding errors of g from those of W are below a few ε × this.
  [[nodiscard]] double rounding_scale() const { return (1 + friction_) * (1 + a1_); }
  /// g stays below the rounding of W in every direction: slip keeps its direction.
  [[nodiscard]] bool is_straight() const;

  /// −A⁻¹b: the ratio P_t/p that keeps a point without slip from slipping.
  [[nodiscard]] Vector2 stick_ratio() const { return {-b1_ / a1_, -b2_ / a2_}; }
  /// k of a sticking point: 1/(W⁻¹)_nn.
  [[nodiscard]] double stick_rate() const { return 1 - normal_coupling_ * (b1_ * (b1_ / a1_) + b2_ * (b2_ / a2_)); }
  [[nodiscard]] bool can_stick() const { return stick_ratio().norm() <= friction_; }
  /// Direction in which slip that has stopped goes on where the point cannot stick: (μA + f)⁻¹ b.
  [[nodiscard]] const Direction& outgoing() const { return zeros_[count_ - 1].at; }

  /// Zeros of g by rising angle over one turn; the last, in the first quadrant, lies in [2π, 5π/2].
  [[nodiscard]] int zero_count() const { return static_cast<int>(count_); }
  [[nodiscard]] const InvariantAngle& zero(int i) const { return zeros_[i]; }
  /// D over the right-hand side of (3), less 1; > 0: four invariant directions; near 0: slip nearly stops.
  [[nodiscard]] double astroid_excess() const;

  [[nodiscard]] double friction() const { return friction_; }
  [[nodiscard]] double b1() const { return b1_; }
  [[nodiscard]] double b2() const { return b2_; }
  /// 1, or 0 where friction does not act on the normal velocity.
  [[nodiscard]] double normal_coupling() const { return normal_coupling_; }
  [[nodiscard]] double a1() const { return a1_; }
  [[nodiscard]] double a2() const { return a2_; }
  [[nodiscard]] double anisotropy() const { return anisotropy_; }
  /// Derivatives of f, g and h by the angle.
  [[nodiscard]] double slip_rate_slope(const Direction& s) const {
    return b2_ * s.cosine - b1_ * s.sine + 2 * anisotropy_ * s.sine * s.cosine;
  }
  [[nodiscard]] double turning_slope(const Direction& s) const {
    return -b1_ * s.cosine - b2_ * s.sine + anisotropy_ * (s.cosine - s.sine) * (s.cosine + s.sine);
  }
  [[nodiscard]] double normal_rate_slope(const Direction& s) const {
    return normal_coupling_ * friction_ * (b1_ * s.sine - b2_ * s.cosine);
  }

 private:
  void find_zeros();
  Matrix2 axes_;
  double normal_coupling_, friction_, a1_ = 0, a2_ = 0, b1_ = 0, b2_ = 0, anisotropy_ = 0;
  std::array<InvariantAngle, 4> zeros_;
  std::size_t count_ = 0;
};

/// How the field changes with W, to first order, in its frame, which stays: by turns of the body about x and y.
class SlipFieldSlopes {
 public:
  using Row = Eigen::Array<double, 1, 2>;
  /// @param inverse_contact_inertia, turns  W, and δW for the two turns
  SlipFieldSlopes(const SlipField& field, const Matrix3& inverse_contact_inertia, const std::array<Matrix3, 3>& turns);

  /// Rates f, g and h for a direction that stays.
  [[nodiscard]] Row slip_rate(const Direction& s) const {
    return push(s) - friction_ * (a11 * s.cosine * s.cosine + 2 * a12 * s.cosine * s.sine + a22 * s.sine * s.sine);
  }
  [[nodiscard]] Row turning(const Direction& s) const {
    return b2 * s.cosine - b1 * s.sine +
           friction_ * ((a11 - a22) * s.sine * s.cosine - a12 * (s.cosine - s.sine) * (s.cosine + s.sine));
  }
  [[nodiscard]] Row normal_rate(const Direction& s) const { return -friction_ * push(s); }

  Row b1, b2, a11, a12, a22;  ///< δb and δA over W_nn
  Row unit;                   ///< δW_nn/W_nn

 private:
  [[nodiscard]] Row push(const Direction& s) const { return b1 * s.cosine + b2 * s.sine; }
  double friction_;
};

/// An invariant direction of slip, as `explain` lists it.
struct InvariantDirection {
  Vector2 direction = Vector2::UnitX();  ///< unit, world frame
  double slip_rate = 0;                  ///< f [1/kg]; < 0: slip along it stops
  double normal_rate = 0;                ///< h [1/kg]
  bool attracts = true;                  ///< slip beside it turns towards it
};
struct InvariantDirections {
  std::array<InvariantDirection, 4> list;
  int count = 0;  ///< 2 or 4
};
/// The invariant directions at W with Coulomb's μ >= 0.
[[nodiscard]] InvariantDirections invariant_directions(const Matrix3& inverse_contact_inertia, double friction);

}  // namespace clatter::analytic::space
