// SPDX-License-Identifier: GPL-3.0-or-later
// Restitution and friction fitted to measured impacts, for each law.
#pragma once

#include <array>
#include <string>

#include "analytic/plane/impact.hpp"
#include "validation/measured/calibration.hpp"

namespace clatter::validation {

/// An impact law with numbers.  Restitution may depend on the effective mass of the corner,
///     e = e₀ + e₁ ν,   ν = 1/(m W_nn) in (0, 1]: 1 where the centre is above the corner,           (1)
/// as where a body yields in bending and shocks run through it (Stoianovici and Hurmuzlu 1996 saw such a dependence on
/// the angle in slender bars); e₁ = 0 is the pure law.
struct FittedLaw {
  analytic::RestitutionLaw law = analytic::RestitutionLaw::poisson;
  double restitution = 0;  ///< e₀
  double slope = 0;        ///< e₁
  double friction = 0;     ///< μ

  /// (1), no less than 0 and no more than 1.
  [[nodiscard]] double restitution_at(double effective_mass) const;
};

/// Motion after the impact of a corner; the state before where the corner does not approach, or the law gives no
/// impulse.
[[nodiscard]] analytic::space::State struck(const TrackedBody& body, const analytic::space::State& before, int corner,
                                            const FittedLaw& law);
/// ν of (1).
[[nodiscard]] double effective_mass(const TrackedBody& body, const analytic::space::State& state, int corner);

/// √(|ΔV|² + k² |ΔΩ|²) between two motions, k² = I/m.
[[nodiscard]] double motion_distance(const TrackedBody& body, const analytic::space::State& a,
                                     const analytic::space::State& b);
/// The same of one motion.
[[nodiscard]] double motion_size(const TrackedBody& body, const analytic::space::State& state);
/// Error of a predicted motion after an impact, over the size of the motion before.
[[nodiscard]] double relative_error(const TrackedBody& body, const TrackImpact& impact,
                                    const analytic::space::State& predicted);

/// Parameters with confidence.
struct LawFit {
  FittedLaw law;
  RobustFit fit;  ///< parameters e₀, μ, and e₁ if `slope`
  bool slope = false;
  std::size_t impacts = 0;
};

/// Fits e and μ (and e₁) to the point impacts among these by least pseudo-Huber loss of relative_error(), quadratic
/// below 5 %.
/// @throws NumericalError if there are fewer than 5 point impacts.
[[nodiscard]] LawFit fit_law(const TrackedBody& body, const std::vector<PartImpact>& impacts,
                             analytic::RestitutionLaw law, bool slope);

/// Error of the best impulse at the touching point with |P_t| <= μ P_n, P_n >= 0, for the largest μ seen useful: what
/// no law with one point can beat.
[[nodiscard]] double floor_error(const TrackedBody& body, const TrackImpact& impact, double friction);

[[nodiscard]] const std::array<analytic::RestitutionLaw, 3>& fitted_laws();
[[nodiscard]] const char* fitted_law_name(analytic::RestitutionLaw law);

}  // namespace clatter::validation
