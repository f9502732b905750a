// SPDX-License-Identifier: GPL-3.0-or-later
// Derivatives of the state after each impact of a drop in space with respect to the numbers of the drop.
//
// The derivative of (t, θ, V, ω), θ the rotation vector of a small turn, goes through impacts and flights,
//     g ← J g + ∂(impact)/∂p,                                                                        (1)
// the second term for the parameters p of the law alone: J of an impact from impact.hpp, of a flight by
// its closed form.  What has no closed form, and every ∂(impact)/∂p, is the limit of differences of that
// one impact, extrapolated (Richardson).
#pragma once

#include <array>
#include <vector>

#include "analytic/plane/gradient.hpp"
#include "analytic/space/sequence/impact_rows.hpp"

namespace clatter::analytic::space {

/// What a derivative is taken with respect to.
enum class SpaceParameter : std::size_t {
  angle,        ///< turn of the body about −y at the first touch [rad]
  tilt,         ///< turn about its own x axis [rad]
  speed,        ///< −V_z at the first touch [m/s]
  restitution,  ///< e of the law
  friction,     ///< Coulomb's μ, or the impulse ratio as given; without friction Coulomb's, from above
};
inline constexpr std::size_t space_parameters = 5;

/// How the turn of `angle` or `tilt` moves the body: a rotation vector, world frame; zero of the others.
[[nodiscard]] Vector3 turn_of(const Drop& drop, SpaceParameter parameter);

/// Derivatives of an impact's numbers, each the number's unit over the parameter's; world frame.
struct SpaceImpactGradient {
  double time = 0;                     ///< of t since the first touch
  Vector3 attitude = Vector3::Zero();  ///< of the attitude at the impact: a rotation vector [rad]
  Vector3 velocity = Vector3::Zero();  ///< of the centre of mass after it
  Vector3 angular_velocity = Vector3::Zero();
  Vector3 impulse = Vector3::Zero();
};
/// Bounds on the errors of these, of a vector on the length of its error.
struct SpaceGradientError {
  double time = 0, attitude = 0, velocity = 0, angular_velocity = 0, impulse = 0;
};

/// One impact's derivatives, by SpaceParameter.
struct SpaceGradientRow {
  std::vector<Corner> corners;  ///< that strike
  std::array<SpaceImpactGradient, space_parameters> of{};
  std::array<SpaceGradientError, space_parameters> error{};
};

struct SpaceGradient {
  std::vector<SpaceGradientRow> rows;
  std::array<GradientRefusal, space_parameters> refused;
  Sequence sequence;  ///< the drop's own
};

/// The derivatives of the drop's sequence, up to `impacts` rows or the first whose sequence errors leave open.
///
/// Error of a derivative: 1e-10 of each term of (1) or what extrapolation leaves, carried on, and what an error of the
/// state changes in the Jacobians, by the derivatives of neighbouring drops.  A neighbour with other impacts or other
/// paths of slip refuses what it has not in common with the drop; so do corners that land together a turn.
/// @throws as impact_sequence()
[[nodiscard]] SpaceGradient sequence_gradient(const Drop& drop, int impacts);

}  // namespace clatter::analytic::space
