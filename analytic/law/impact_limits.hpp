// SPDX-License-Identifier: GPL-3.0-or-later
// Which impulse ratios an impact can have: sticking, Brach's two limits, jamming.
#pragma once

namespace clatter::analytic {

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
