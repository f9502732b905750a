// SPDX-License-Identifier: GPL-3.0-or-later
// The laws of an impact: restitution, and friction along the ground.
#pragma once

#include <Eigen/Core>

namespace clatter::analytic {

/// Which quantity the coefficient of restitution e relates after the end of compression.
enum class RestitutionLaw {
  newton,   ///< velocities: u_after = −e u_before
  poisson,  ///< impulses: P_restitution = e P_compression
  stronge,  ///< work of the normal force: W_restitution = −e² W_compression
  /// A ground that pushes with (k_G + c_G δ̇) K(δ), any growth K: e follows from `damping_per_stiffness` and each
  /// contact's own approach speed (viscoelastic.hpp), and from the work along the path if slip stops on the way
  /// (viscoelastic.hpp).  Without damping it is Stronge's law with e = 1.
  viscoelastic,
};

/// Whether an impact ends by the work of the normal force, along the path.
[[nodiscard]] constexpr bool is_energetic(RestitutionLaw law) {
  return law == RestitutionLaw::stronge || law == RestitutionLaw::viscoelastic;
}
/// Whether an impact with friction can leave more energy than it found.
[[nodiscard]] constexpr bool may_gain_energy(RestitutionLaw law) { return law == RestitutionLaw::newton; }

enum class FrictionKind {
  none,
  impulse_ratio,  ///< P_t = μ_i P_n with μ_i as given: Eq. 8 as it stands, admissible or not
  coulomb,        ///< |P_t| <= μ P_n at every instant, against the slip: Routh's construction
  /// |P_t| <= μ P_n of the impact as a whole, and P_t = −μ P_n s′/|s′| where the slip s′ after it is not zero, as
  /// time-stepping engines have it (Moreau 1988, without tangential restitution); with Newton's e.
  moreau,
};

struct ImpactLaw {
  double restitution = 1;  ///< e in [0, 1]; 1 for the viscoelastic law, which computes its own
  RestitutionLaw law = RestitutionLaw::newton;
  FrictionKind friction = FrictionKind::none;
  double friction_value = 0;         ///< μ_i (any finite value) or μ >= 0; 0 with FrictionKind::none
  double damping_per_stiffness = 0;  ///< τ = c_G/k_G >= 0 of the viscoelastic law [s/m]
  /// In space, the unit horizontal direction in which P_t of FrictionKind::impulse_ratio acts: P_t = μ_i P_n ·
  /// direction; in the plane it is x.
  Eigen::Vector2d ratio_direction = Eigen::Vector2d::UnitX();

  /// Whether friction lies in a cone about the normal, as Coulomb's and Moreau's does.
  [[nodiscard]] bool has_cone() const { return friction == FrictionKind::coulomb || friction == FrictionKind::moreau; }
  /// Coulomb's with μ > 0, along the path of the impact.
  [[nodiscard]] bool rubs() const { return friction == FrictionKind::coulomb && friction_value > 0; }
  /// Most that friction can be of the normal force, as a share.
  [[nodiscard]] double most_friction() const;
  /// @throws std::domain_error naming the field, its value and what is allowed.
  void validate() const;
};

/// How the contact point moved along the ground during the impact.
enum class ImpactMode {
  frictionless,  ///< no tangential impulse asked for
  slip,          ///< slips one way throughout (also: an impulse ratio as given)
  stick,         ///< no slip from the start
  slip_stick,    ///< slip stops, then sticks
  reverse_slip,  ///< slip stops, then goes the other way
};

// Which impulse ratios an impact can have: sticking, Brach's two limits, jamming.

/// The coefficients A, B, C of (b): inverse inertia seen at the contact point, times the mass.
struct ContactInertia {
  double normal = 1;      ///< A >= 1
  double coupling = 0;    ///< B; A C − B² >= 1 always
  double tangential = 1;  ///< C >= 1
};

/// Impulse ratio that keeps a contact point without slip from slipping: B/C.  For the unit rod
/// 3sc/(1+3s²): 0.6 at 45°, at most 0.75 at tan θ = 1/2.
[[nodiscard]] double sticking_ratio(const ContactInertia& inertia);

/// Impulse ratio A/B from which the denominator of Eq. 8 is no longer positive (jamming, Painlevé's
/// paradox), signed like B; ±infinity where B = 0.  For the unit rod (1+3c²)/(3sc), least 4/3 at
/// tan θ = 2.
[[nodiscard]] double jamming_ratio(const ContactInertia& inertia);

/// What the limits depend on besides the inertia.
struct LimitState {
  double approach_speed = 1;  ///< −u > 0 [m/s]
  double slip = 0;            ///< s before [m/s]
  double restitution = 1;     ///< e
};

/// μ_O: the ratio for which slip has just stopped at separation (s′ = 0):
///     μ_O = (A s + (1+e) u B)/(B s + (1+e) u C).
/// ±infinity if no finite ratio stops the slip.
[[nodiscard]] double slip_stopping_ratio(const ContactInertia& inertia, const LimitState& state);

/// The two ratios between which an impact creates no energy, solutions of zero total energy loss:
///     μ² (2ηB + (1+e)C) − 2μ (ηA + eB) − (1−e)A = 0,   η = s/u.
struct EnergyNeutralRatios {
  double lower = 0;
  double upper = 0;
};
[[nodiscard]] EnergyNeutralRatios energy_neutral_ratios(const ContactInertia& inertia, const LimitState& state);

/// μ_T: the energy-neutral ratio on the side of μ_O (the side that friction acts to).
[[nodiscard]] double energy_neutral_ratio(const ContactInertia& inertia, const LimitState& state);

/// Brach's bound min(|μ_O|, |μ_T|) on |μ_i|.
[[nodiscard]] double admissible_ratio(const ContactInertia& inertia, const LimitState& state);

}  // namespace clatter::analytic
