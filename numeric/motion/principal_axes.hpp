// SPDX-License-Identifier: GPL-3.0-or-later
// Principal moments and axes of an inertia tensor.
#pragma once

#include "numeric/base/linear_algebra.hpp"

namespace clatter::numeric {

struct PrincipalAxes {
  Vector3 moments = Vector3::Ones();   ///< ascending, units of the tensor
  Matrix3 axes = Matrix3::Identity();  ///< columns: unit axes, right-handed
};

/// I = axes · diag(moments) · axesᵀ.  A diagonal tensor keeps its numbers and axes exactly.
/// Accuracy otherwise: a few eps of the largest moment, and of 1 in the axes.
/// @throws std::domain_error unless the tensor is finite, symmetric and positive definite, with c <= a + b
/// for its moments a <= b <= c; symmetry and the last up to 1e-10 of the largest moment.
[[nodiscard]] PrincipalAxes principal_axes(const Matrix3& inertia);

}  // namespace clatter::numeric
