// SPDX-License-Identifier: GPL-3.0-or-later
// What the numbers of the map are held against: the thin rod's first three impacts solved again in 50 digits, the laws
// of motion row by row in extended precision, torque-free rotation over very many turns from one turn integrated so.
#pragma once

#include <array>
#include <string>

#include "analytic/plane/contact_angles.hpp"
#include "analytic/plane/sequence.hpp"
#include "numeric/motion/motion_state.hpp"
#include "validation/oracles/free_top.hpp"

namespace clatter::validation {

/// What is held against the truth, and what it is called in the map.
inline constexpr const char* exact_rod_oracle = "momentum balances and flight in 50 digits";

/// The rod of contact_angles.hpp: m = L = 1, v_n = −1, ω = 0.
struct RodStart {
  double angle_deg = 0;
  analytic::RodParameters parameters{};
};

/// Impacts as a model has them; the unit is that of contact_angles.hpp.
struct RodImpacts {
  int count = 0;           ///< 1 to 3
  double angle[3] = {};    ///< contact angles, the first as given [rad]
  double time[3] = {};     ///< of the flight before
  double impulse[3] = {};  ///< normal
  double velocity[3] = {}, angular[3] = {};
};
[[nodiscard]] RodImpacts rod_impacts(const analytic::ContactAngles& angles);
/// Rows of a thin rod with m = L = 1, v_n = −1; ends at the first row that is not the other end's.
[[nodiscard]] RodImpacts rod_impacts(const analytic::Sequence& sequence);

struct RodError {
  double error = 0;      ///< the largest relative error of a number; velocities relative to those after impact 1
  double condition = 0;  ///< relative change of the worst number per relative change of θ, G, e and μ_i, summed
  /// Whether the other end really misses the ground in its first half turn after the last impact given; known for the
  /// elastic rod without friction and gravity only, and true where rounding decides.
  bool ends_rightly = true;
};

/// Impulses and flights of oracles/rod.hpp, started from the impacts given.  Nothing of the models' code is used.
[[nodiscard]] RodError rod_error(const RodStart& start, const RodImpacts& impacts);

/// e of the flat landing on a viscoelastic ground, s = c_G v/k_G >= 0 (oracles/impulse_path.hpp).
[[nodiscard]] long double exact_restitution(long double damping_number);

inline constexpr const char* retrace_oracle = "laws of motion, row by row at 64 bits";

struct Retrace {
  /// Largest residual of a law, relative to the sum of the magnitudes of its terms: parabola and turn of each flight,
  /// arriving vertices at height 0 and none below, both momentum balances, restitution, Coulomb's bound, energy.
  double residual = 0;
  /// Largest height of an arriving vertex, relative to the body's reach.
  double placement = 0;
  /// Largest |energy − (first energy − losses so far)| over the first energy.
  double energy_drift = 0;
  /// |Σ P − m (V − V₀ + g t)| over Σ P, up to the last row.
  double momentum_drift = 0;
  std::string worst;  ///< the law with the largest residual, and the row
};

/// Numbers that are not finite give residuals that are infinite.
[[nodiscard]] Retrace retrace(const analytic::Drop& drop, const analytic::Sequence& sequence);

/// A freely turning body whose momentum is not along an axis of inertia.
///
/// Its angular velocity is periodic, and over each period T the attitude turns about the fixed momentum by the same
/// angle ψ.  One period, integrated by Taylor series in long double, gives T and ψ to about 1e-18, and with them the
/// attitude after any number of periods.  Nothing of the models' code is used.
class PeriodicSpin {
 public:
  /// `moments` along the body's axes, `angular_velocity` with no component along axis 2 and some along 1 and 3.
  PeriodicSpin(const std::array<double, 3>& moments, const std::array<double, 3>& angular_velocity);

  [[nodiscard]] long double period() const { return period_; }
  /// Largest difference of a component of the attitude's Euler parameters and of ω/|ω| from the exact ones at `time`.
  [[nodiscard]] double error(const numeric::Rotation& rotation, double time) const;

 private:
  using Top = oracle::Top<long double>;
  [[nodiscard]] Top advance(Top top, long double time) const;
  void find_period();
  void find_angle();

  Top start_;
  std::array<long double, 3> axis_{};  ///< of the momentum, world
  long double longest_step_ = 0, period_ = 0, angle_ = 0;
};

}  // namespace clatter::validation
