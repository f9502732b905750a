// SPDX-License-Identifier: GPL-3.0-or-later
// Exact map between the damping of a viscoelastic ground and the coefficient of restitution.
//
// For a contact force (k_G + c_G δ̇) K(δ) with any growth K and s = (c_G/k_G) v, v the approach speed,
//     ln[(1+s)/(1−s e)] = s (1+e),   so   e = [1 + W₀(−(1+s) e^{−(1+s)})]/s.
// Exact for one frictionless contact whose depth is set by one number (flat or upright landing).
#pragma once

#include "analytic/base/dual.hpp"

namespace clatter::analytic {

/// e(s) for s = (c_G/k_G) v >= 0: 1 at s = 0, falls like 1 − 2s/3 and, for large s, like 1/s.
/// Accuracy: 4 ulp for all s, since 1 − e and 1 − s e are solved for without cancellation.
/// @throws std::domain_error unless s >= 0 (infinity gives 0).
[[nodiscard]] double restitution_of_damping(double damping_number);

/// 1 − e(s), with its relative accuracy for small s as well.  Accuracy: 8 ulp.
[[nodiscard]] double restitution_loss_of_damping(double damping_number);

/// de/ds; −2/3 at s = 0.  Accuracy: 1e-12 relative.
[[nodiscard]] double restitution_slope_of_damping(double damping_number);

/// The inverse s(e): 0 at e = 1, infinite at e = 0.  Accuracy: (4 + 2 × condition number) ulp.
/// @throws std::domain_error unless 0 <= e <= 1.
[[nodiscard]] double damping_of_restitution(double restitution);

// Work of a viscoelastic contact along an impact in impulse space.
//
// The contact force (k_G + c_G δ̇) K(δ)/k_G of a ground with τ = c_G/k_G [s/m] drives the normal
// velocity u of the contact point (up; δ̇ = −u).  With dP = K (1 − τu) dt the elastic energy of the
// ground changes by K dδ = −u dP/(1 − τu), whatever the growth of K.

/// A stretch of an impact along which u is linear in the impulse.
template <class Number = double>
struct ImpulseStretch {
  Number from{};    ///< u at its start [m/s]
  Number to{};      ///< u at its end [m/s]
  Number length{};  ///< normal impulse, per unit mass [m/s]
};

/// W = ∫ −u/(1 − τu) dP: what the ground has stored after the stretch, per unit mass [m²/s²];
/// negative when it has given.  τ = 0: −(from + to)/2 × length.
/// Accuracy: a few ulp of ∫ |u|/(1 − τu) dP.  Domain: τ >= 0, τu < 1 all along.
[[nodiscard]] double stored_work(double damping_per_stiffness, const ImpulseStretch<>& stretch);

/// Speed u > 0 at which the ground has given back `work` > 0, with du/dP = `slope` > 0 from the
/// speed `from` on:
///     ψ(τu) = ψ(τ from) + slope τ² work,   ψ(x) = −x − ln(1−x).
/// Accuracy: a few ulp × condition number.
template <class Number = double>
struct Unloading {
  Number from{};  ///< [m/s]
  Number slope{};
  Number work{};  ///< [m²/s²]
};
[[nodiscard]] double separation_speed(double damping_per_stiffness, const Unloading<>& unloading);

/// The same with derivatives, from g(u) = u/(1 − τu): W is −length × the mean of g, and
///     g(u) du = g(from) dfrom + work dslope + slope dwork.
/// Relative accuracy of derivatives: 1e-9.
template <std::size_t size>
[[nodiscard]] detail::Dual<size> stored_work(double damping_per_stiffness,
                                             const ImpulseStretch<detail::Dual<size>>& stretch) {
  const auto& [from, to, length] = stretch;
  const double work = stored_work(damping_per_stiffness, {from.value, to.value, length.value});
  const auto g = [&](double u) { return u / (1 - damping_per_stiffness * u); };
  const double mean = length.value == 0 ? g(from.value) : -work / length.value;
  const double rise = to.value - from.value;
  const double middle = 1 - damping_per_stiffness * (from.value + to.value) / 2;
  const double half = 0.5 / (middle * middle);  // of g′, where differences would cancel
  const bool short_rise = std::fabs(rise) <= 1e-6 * (std::fabs(from.value) + std::fabs(to.value));
  const double of_from = short_rise ? half : (mean - g(from.value)) / rise;
  const double of_to = short_rise ? half : (g(to.value) - mean) / rise;
  using Number = detail::Dual<size>;
  const Number of_ends = Number::combined(work, from, -length.value * of_from, to, -length.value * of_to);
  return Number::combined(work, of_ends, 1, length, -mean);
}
template <std::size_t size>
[[nodiscard]] detail::Dual<size> separation_speed(double damping_per_stiffness,
                                                  const Unloading<detail::Dual<size>>& unloading) {
  const auto& [from, slope, work] = unloading;
  const double speed = separation_speed(damping_per_stiffness, {from.value, slope.value, work.value});
  const auto g = [&](double u) { return u / (1 - damping_per_stiffness * u); };
  using Number = detail::Dual<size>;
  const Number of_work = Number::combined(speed, slope, work.value / g(speed), work, slope.value / g(speed));
  return Number::combined(speed, of_work, 1, from, g(from.value) / g(speed));
}

}  // namespace clatter::analytic

namespace clatter::analytic::detail {

// A logarithmic difference that keeps its relative accuracy for small arguments.

/// ln(1+x) − x for x > −1: by Boost's series where the difference would cancel.  Accuracy: 2 ulp.
[[nodiscard]] double log1p_minus(double x);

}  // namespace clatter::analytic::detail
