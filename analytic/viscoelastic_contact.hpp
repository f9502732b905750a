// Work of a viscoelastic contact along an impact in impulse space.
//
// The contact force (k_G + c_G δ̇) K(δ)/k_G of a ground with τ = c_G/k_G [s/m] drives the normal velocity u of the
// contact point (up; δ̇ = −u).  With dP = K (1 − τu) dt the elastic energy of the ground changes by
// K dδ = −u dP/(1 − τu), whatever the growth of K.
#pragma once

namespace clatter::analytic {

/// A stretch of an impact along which u is linear in the impulse.
struct ImpulseStretch {
  double from = 0;    ///< u at its start [m/s]
  double to = 0;      ///< u at its end [m/s]
  double length = 0;  ///< normal impulse, per unit mass [m/s]
};

/// W = ∫ −u/(1 − τu) dP: what the ground has stored after the stretch, per unit mass [m²/s²]; negative when it
/// has given.  τ = 0: −(from + to)/2 × length.
/// Accuracy: a few ulp of ∫ |u|/(1 − τu) dP.  Domain: τ >= 0, τu < 1 all along.
[[nodiscard]] double stored_work(double damping_per_stiffness, const ImpulseStretch& stretch);

/// Speed u > 0 at which the ground has given back `work` > 0, with du/dP = `slope` > 0 from the speed `from` on:
///     ψ(τu) = ψ(τ from) + slope τ² work,   ψ(x) = −x − ln(1−x).
/// Accuracy: a few ulp × condition number.
struct Unloading {
  double from = 0;  ///< [m/s]
  double slope = 1;
  double work = 0;  ///< [m²/s²]
};
[[nodiscard]] double separation_speed(double damping_per_stiffness, const Unloading& unloading);

}  // namespace clatter::analytic
