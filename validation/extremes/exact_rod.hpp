// SPDX-License-Identifier: GPL-3.0-or-later
// The thin rod's first three impacts, solved again in 50 digits.
#pragma once

#include "analytic/plane/contact_angles.hpp"
#include "analytic/plane/sequence.hpp"

namespace clatter::validation::inline extremes {

/// What is held against the truth, and what it is called in the map.
inline constexpr const char* exact_rod_oracle = "momentum balances and flight in 50 digits";

/// The rod of contact_angles.hpp: m = L = 1, v_n = −1, ω = 0.
struct RodStart {
  double angle_deg = 0;
  analytic::RodParameters parameters;
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

}  // namespace clatter::validation::inline extremes
