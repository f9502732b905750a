// SPDX-License-Identifier: GPL-3.0-or-later
// Contact angles of the first three impacts of the thin rod: β(θ) and γ(θ), Eq. 12 and its relatives.
#pragma once

#include "analytic/base/angle.hpp"

namespace clatter::analytic {

/// What the relations depend on besides θ; the rod has m = L = 1, v_n = −1, ω = 0, which is no
/// restriction: angles depend on G, e and μ_i only, impulses scale with m|v_n|, Ω with |v_n|/L.
struct RodParameters {
  double gravity_number = 0;  ///< G = g L/v_n² >= 0
  double restitution = 1;     ///< e in [0, 1]
  double impulse_ratio = 0;   ///< μ_i of Eq. 8 as given: P_t = μ_i P_n in the world frame, each impact

  /// @throws std::domain_error naming the field, its value and what is allowed.
  void validate() const;
};

/// What comes after an impact.
enum class NextImpact {
  other_end,       ///< the other end strikes at a contact angle of at most 90°
  beyond_upright,  ///< the other end strikes after the rod has turned past the vertical
  same_end,        ///< the end that struck strikes again first
  none,            ///< nothing strikes any more
  stays_touching,  ///< the end does not leave the ground (e = 0)
  not_reached,     ///< the impact before this one does not happen
};

/// One contact angle as a decision: whether it exists, by how much, and its value.
struct ContactAngle {
  NextImpact next = NextImpact::not_reached;
  double angle = 0;            ///< β or γ [rad]; defined if next == other_end
  double time = 0;             ///< T of the flight to it [L/|v_n|]; defined if a contact exists
  bool within_margin = false;  ///< so near a fold that rounding decides
  double clearance = 0;        ///< height by which a vertex missed the ground on the way [L]; infinite: none did
  double closest_angle = 0;    ///< contact angle at that closest approach [rad]
  int evaluations = 0;         ///< evaluations of the height functions
};

/// The first three impacts (index 0, 1, 2).  Entries of impacts that do not happen are NaN.
struct ContactAngles {
  Angle theta;
  ContactAngle beta;
  ContactAngle gamma;
  double impulse[3];                  ///< P₁, P₂, P₃ [m|v_n|]
  double velocity[3];                 ///< V₁, V₂, V₃ after each impact [|v_n|]
  double angular[3];                  ///< Ω₁, Ω₂, Ω₃ [|v_n|/L]
  double gamma_minus_theta;           ///< γ − θ without cancellation if e = 1, μ_i = 0, G = 0 [rad]
  double impulse_deficit;             ///< 2 − P₁ − P₂ − P₃ likewise; the flat landing's impulse is 2
  [[nodiscard]] int impacts() const;  ///< 1, 2 or 3
};

/// First three impacts of the rod that strikes at θ.
///     sin θ + K φ − G φ²/Ω₁² − sin(φ − θ) = 0,  φ = θ + β,  K = 2V₁/Ω₁                           (12)
/// and the same with (β, V₂, |Ω₂|) for γ, always the earliest contact of either end.  (With e = 1,
/// μ_i = 0: K = (1−3c²)/(6c), 1/Ω₁² = ((1+3c²)/(12c))²; the sign and factor of the G term are those of
/// erratum E2.)  θ = 0 gives the limit 2:1:2 of a point contact.
/// Accuracy, with κ the sum of the condition numbers with respect to θ, G, e and μ_i: for the elastic rod
/// (e = 1, μ_i = 0, G = 0) (2 + 2κ) ulp for angles, times, velocities and impulses, and the same for γ − θ
/// and 2 − ΣP, which are computed from expressions of their own; 4 times that with gravity, 12 times with
/// e < 1 or μ_i ≠ 0.
/// @throws std::domain_error unless 0 <= θ <= π/2; OutsideModelError if μ_i jams.
[[nodiscard]] ContactAngles contact_angles(const Angle& theta, const RodParameters& parameters);

/// β by the gravity term as the paper prints it, + (G/2) φ²/Ω₁²; G of either sign (the paper does not
/// say which sign its g has).  No impact in the first turn: next == none.
[[nodiscard]] ContactAngle contact_angle_as_printed(const Angle& theta, double signed_gravity_number);

/// Why the second or third impact ends where it does.
enum class BoundaryKind {
  fold,     ///< the end touches with zero speed: a double root; then none, or one much later
  upright,  ///< the contact angle reaches 90°
  order,    ///< another contact comes first from here on
  stop,     ///< the impact before leaves the rod at rest: with e = 0 it turns away beyond
  always,   ///< the impact happens up to 90°
  never,    ///< the impact does not happen for any θ
};

/// The largest θ up to which an impact happens.
struct RegimeBoundary {
  BoundaryKind kind = BoundaryKind::never;
  double theta = 0;  ///< [rad]
  double beta = 0;   ///< contact angles there [rad]; gamma NaN for the second impact
  double gamma = 0;
  double uncertainty = 0;  ///< bound on the error of theta [rad]
};

enum class ImpactNumber { second = 2, third = 3 };

/// θ up to which the second (third) impact happens as β (γ) <= 90°.  Known for G = 0, e = 1, μ_i = 0:
/// 58.488442288312° and 27.577809606636°, both folds.
/// Found by bisection on the decision of contact_angles() down to neighbouring doubles, so it is the
/// boundary of what the program prints; an impact that does not happen for small θ counts as never.
/// Accuracy: `uncertainty`, about 4 ulp for folds.
[[nodiscard]] RegimeBoundary regime_boundary(ImpactNumber impact, const RodParameters& parameters);

}  // namespace clatter::analytic
