// SPDX-License-Identifier: GPL-3.0-or-later
// Derivatives of the state after each impact with respect to the numbers of the drop.
//
// The derivative of the state (t, α, u, s, Ω, ΣP) goes through impacts and flights by the Jacobians J
// of each,
//     g ← J g + ∂(impact)/∂p                                                                       (1)
// for each parameter p, the second term for the parameters of the law alone.  At a fold, where an impact grazes, the
// derivatives of all later impacts are infinite; where another impact, or another branch of the law, begins next to the
// drop, there is none.  Both are refused.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "analytic/plane/impact_rows.hpp"

namespace clatter::analytic {

/// What a derivative is taken with respect to.
enum class DropParameter : std::size_t {
  angle,        ///< inclination at the first touch, a lower: positive [rad]
  speed,        ///< −V_n at the first touch [m/s]
  restitution,  ///< e of the law
  friction,     ///< Coulomb's μ, or the impulse ratio as given; without friction Coulomb's, from above
};
inline constexpr std::size_t drop_parameters = 4;

/// Derivatives of an impact's numbers, each the number's unit over the parameter's.
struct ImpactGradient {
  double time = 0;         ///< of t since the first touch
  double inclination = 0;  ///< of α at the impact [rad]
  double normal = 0;       ///< of V_n after it
  double tangential = 0;   ///< of V_t after it
  double angular = 0;      ///< of Ω after it
  double normal_impulse = 0;
  double tangential_impulse = 0;
};

/// One impact's derivatives.
struct GradientRow {
  VertexSet vertices = 0;                                   ///< which strike
  std::array<ImpactGradient, drop_parameters> of{}, error;  ///< by DropParameter; of no meaning once refused
};

/// Why a parameter has no derivative from some impact on.
struct GradientRefusal {
  std::size_t from = 0;  ///< index of the first row without it; the number of rows: of none
  std::string reason{};  ///< empty: none
};

/// Reasons that the plane and space have in common.
namespace refusals {
inline constexpr const char* const ground_gives_restitution = "the ground's damping gives e";
inline constexpr const char* const contact_stays = "a contact that stays bounces on for e > 0";
inline constexpr const char* const slip_from_rest =
    "the contact begins to slip from rest: each way has a derivative of its own";
inline constexpr const char* const other_neighbour = "a drop next to it has other impacts, or slips otherwise";
}  // namespace refusals

struct SequenceGradient {
  std::vector<GradientRow> rows;
  std::array<GradientRefusal, drop_parameters> refused;
  Sequence sequence;  ///< the drop's own
};

/// The derivatives of the drop's sequence, up to `impacts` rows or the first whose sequence errors leave open.
///
/// Error of a derivative: what rounding adds in (1), and what an error of the state changes in the Jacobians, by the
/// derivatives of four neighbouring drops.  A neighbour with other impacts or another branch of the law refuses what it
/// has not in common with the drop.
/// @throws as impact_sequence()
[[nodiscard]] SequenceGradient sequence_gradient(const Drop& drop, int impacts);

}  // namespace clatter::analytic
