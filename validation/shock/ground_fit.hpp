// SPDX-License-Identifier: GPL-3.0-or-later
// k_G and c_G of the simulator's ground, or E* and τ of a half-space, from what can be measured of a drop; k_G from the
// layer that the ground is.
#pragma once

#include <array>
#include <vector>

#include "numeric/simulate.hpp"

namespace clatter::validation {

/// What can be measured of the first impact of a drop, and of the body at rest.
enum class DropMeasure { restitution, contact_time, peak_force, indentation };
inline constexpr std::size_t measure_count = 4;
/// By DropMeasure: –, s, N, m.
using Measures = std::array<double, measure_count>;
[[nodiscard]] const char* measure_name(DropMeasure measure);

struct MeasuredNumber {
  DropMeasure measure;
  double value;
};

/// The drop that was measured.
struct MeasuredDrop {
  const numeric::Body* body = nullptr;
  numeric::World world;  ///< its k_G and c_G are sought, or E* and τ where it has a half-space
  numeric::MotionState start;
  double weight = 0;  ///< m g, under which the body indents the ground [N]
};

/// A ground that gives two measured numbers.
struct FittedGround {
  double stiffness = 0;                           ///< k_G [N/m³], or E* of a half-space [Pa]
  double damping = 0;                             ///< c_G [N·s/m⁴], or τ of a half-space [s/m]
  double stiffness_error = 0, damping_error = 0;  ///< of the solution, not of what was measured
  Measures predicted{};                           ///< by the model, all four
  /// ∂ ln k_G/∂ ln m and ∂ c_G/∂ ln m of the two measured numbers m, the other held.
  std::array<double, 2> stiffness_by{}, damping_by{};
};

struct GroundFit {
  std::vector<FittedGround> solutions;  ///< none, one, or several, by growing damping
  /// What of the second number can be had with the first, over all damping from 0 on: why there is no solution.
  double least = 0, largest = 0;
  long runs = 0;  ///< of the simulator
};

/// The world of the drop on a ground of this k_G and c_G, or E* and τ.
[[nodiscard]] numeric::World world_on(const MeasuredDrop& drop, double stiffness, double damping);

/// All four numbers by the model: the first impact of the drop, by the simulator, and the depth δ at which the body,
/// pressed straight down in the attitude of the drop, is carried, k_G ∫δ dA = m g or as a half-space does.
/// @throws numeric::NumericalError where the first impact is not one touch that lifts off.
[[nodiscard]] Measures measures_of(const MeasuredDrop& drop, double stiffness, double damping);

/// All grounds that give both numbers.  One number gives k_G, or E*, for each loss s = c_G v/k_G or τ v: the
/// indentation alone, contact time and peak force since they go like a power of it.  The other is then a function of s
/// alone, of which values on a coarse grid from s = 0 to 100 (e = 0.01) and its turns tell the brackets of all roots,
/// each then found to rounding.  Of two turns within one cell of the grid, a factor 1.8 of s, one may be missed.
/// @throws numeric::NumericalError as measures_of; std::domain_error for numbers that no ground gives: a restitution
/// outside (0, 1], the others not greater than 0.
[[nodiscard]] GroundFit fit_ground(const MeasuredDrop& drop, const MeasuredNumber& first, const MeasuredNumber& second);

/// k_G of a layer of thickness h on a rigid base that cannot bulge, wide beside h: E (1−ν)/((1+ν)(1−2ν) h) [N/m³].
/// @throws std::domain_error naming the number: E, h > 0, ν in [0, 0.5).
[[nodiscard]] double layer_stiffness(double modulus, double poisson, double thickness);

/// k_G of a half-space under a rigid flat footprint of area A, as under a disc of that area: the force 2 a E δ/(1−ν²)
/// shared out over it, 2 E/((1−ν²) π a), a = √(A/π) [N/m³].  The true pressure is least in the middle and infinite at
/// the rim.  @throws std::domain_error naming the number: E, A > 0, ν in [0, 0.5].
[[nodiscard]] double half_space_stiffness(double modulus, double poisson, double area);

}  // namespace clatter::validation
