// SPDX-License-Identifier: GPL-3.0-or-later
// Restitution and friction fitted to measured impacts, for each law.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "analytic/plane/impact.hpp"
#include "validation/measured/meetings.hpp"

namespace clatter::validation {

// Parameters that make the sum of bounded or slowly growing losses least, with confidence from the items' scatter.

struct RobustFit {
  Eigen::VectorXd value;
  /// The jackknife's covariance: without item i the parameters move by (Σ H − H_i)⁻¹ g_i to first order, g and H an
  /// item's first and second derivatives by central differences; NaN where Σ H is not positive definite.
  Eigen::MatrixXd covariance;
  Eigen::VectorXd losses;  ///< of each item at `value`

  [[nodiscard]] double loss() const { return losses.mean(); }
  /// Half the width of a parameter's 95 % interval, by Student's distribution.
  [[nodiscard]] double half_width(int parameter) const;
};

/// Mean of a − b, item by item, and its standard error: whether one model beats another on the same items.
struct PairedDifference {
  double mean = 0;
  double error = 0;
  [[nodiscard]] bool is_clear() const { return std::abs(mean) > 1.96 * error; }
};
[[nodiscard]] PairedDifference paired_difference(const Eigen::VectorXd& a, const Eigen::VectorXd& b);

// What a file says of its body before any impact law is asked: axes, ground, inertia, rounded corners.

/// Indices of tracks in a file: those to fit on, or those to score.
using TrackPart = std::vector<std::size_t>;

struct CalibrationResult {
  Calibration calibration;
  double ground_spread = 0;        ///< of the touches' heights, standard deviation [m]
  std::size_t resting = 0;         ///< tracks that end on a face, at rest
  std::size_t touches = 0;         ///< impacts that gave the ground's height
  double inertia_half_width = 0;   ///< of the 95 % interval
  double rounding_half_width = 0;  ///< likewise [m]
  double turn_error = 0;           ///< standard error [rad]
  double lever_before = 0;         ///< middle turning that point impacts leave unexplained, uniform and sharp
  double lever_after = 0;
};

/// The parts of a calibration that are fitted; the ground's height always is.
struct CalibrationParts {
  bool axes = true;     ///< of the body, from resting poses: a face lies flat
  bool inertia = true;  ///< and of a box rounding, from the momentum about the touching point of first impacts
};

/// Calibrates on a part of a file.  Losses are capped, so that impacts on more than a point do not count.
[[nodiscard]] CalibrationResult calibrate(const MeasuredFile& file, const TrackPart& part,
                                          const CalibrationParts& parts);

/// Impact `number` of each track of a part that has one.
struct PartImpact {
  std::size_t track = 0;
  TrackImpact impact;
};
[[nodiscard]] std::vector<PartImpact> impacts_of(const MeasuredFile& file, const TrackPart& part,
                                                 const TrackedBody& body, double ground_error, int number);

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

/// √(|V|² + k² |Ω|²), k² = I/m.
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
/// below 5 %.  Where a friction half as large again does not raise the loss by a thousandth, μ is not settled, and its
/// covariance NaN.
/// @throws NumericalError if there are fewer than 5 point impacts.
[[nodiscard]] LawFit fit_law(const TrackedBody& body, const std::vector<PartImpact>& impacts,
                             analytic::RestitutionLaw law, bool slope);

/// Error of the best impulse at the touching point with |P_t| <= μ P_n, P_n >= 0, for the largest μ seen useful: what
/// no law with one point can beat.
[[nodiscard]] double floor_error(const TrackedBody& body, const TrackImpact& impact, double friction);

inline constexpr std::array fitted_laws{analytic::RestitutionLaw::newton, analytic::RestitutionLaw::poisson,
                                        analytic::RestitutionLaw::stronge};

}  // namespace clatter::validation
