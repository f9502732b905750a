// SPDX-License-Identifier: GPL-3.0-or-later
// Inertia tensors.
#pragma once

#include "numeric/base/linear_algebra.hpp"

namespace clatter::numeric {

/// Principal moments of a real body are positive and none exceeds the sum of the others.
/// @throws std::domain_error naming the moment that breaks this, or an inertia that is not finite.
void check_inertia(const Matrix3& inertia);

/// I⁻¹ [1/(kg·m²)] of a checked inertia, symmetric [kg·m²].  Accuracy: some eps times the ratio of the largest to the
/// smallest moment.
[[nodiscard]] Matrix3 inverse_inertia(const Matrix3& inertia);

}  // namespace clatter::numeric
