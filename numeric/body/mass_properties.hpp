// SPDX-License-Identifier: GPL-3.0-or-later
// Mass, centre of mass and inertia of a body.
#pragma once

#include "numeric/base/linear_algebra.hpp"
#include "numeric/mesh/mesh.hpp"
#include "numeric/surface/surface.hpp"

namespace clatter::numeric {

struct MassProperties {
  double mass = 0;                    ///< [kg]
  Vector3 centre = Vector3::Zero();   ///< centre of mass in the mesh's frame [m]
  Matrix3 inertia = Matrix3::Zero();  ///< ∫ρ (u·u 1 − u uᵀ) dV about the centre, axes of the mesh [kg·m²]
};

/// By Gauss quadrature over the elements, of a degree that is exact for straight-sided tetrahedra, prisms and
/// hexahedra (also with warped faces).  Accuracy: a few ulp of the sum of the elements' contributions.
/// @throws MeshError naming the first inverted or degenerate element (Jacobian not positive at a corner or at
/// a quadrature point), or an element with a density that is not a positive finite number; if there is no
/// element.
/// @throws NumericalError if a result overflows.
[[nodiscard]] MassProperties mass_properties(const Mesh& mesh);

/// The same of the uniform body that a closed surface of triangles encloses: sums over the tetrahedra between the
/// triangles and one point, signed, of
///     V = a·(b × c)/6,   ∫u dV = V (a + b + c)/4,   ∫u uᵀ dV = V (s sᵀ + a aᵀ + b bᵀ + c cᵀ)/20,   s = a + b + c.
/// Accuracy: a few ulp of the sum of the tetrahedra's sizes.
/// @param density of the body [kg/m³], > 0
/// @throws MeshError as check_closed: open, non-manifold or facing inward.  std::domain_error for the density or for an
///         element with four corners.  NumericalError if a result overflows or vanishes.
[[nodiscard]] MassProperties mass_properties(const Surface& surface, double density);

/// Principal moments of a real body are positive and none exceeds the sum of the others.
/// @throws std::domain_error naming the moment that breaks this, or an inertia that is not finite.
void check_inertia(const Matrix3& inertia);

/// I⁻¹ [1/(kg·m²)] of a checked inertia, symmetric [kg·m²].  Accuracy: some eps times the ratio of the largest to the
/// smallest moment.
[[nodiscard]] Matrix3 inverse_inertia(const Matrix3& inertia);

}  // namespace clatter::numeric
