// SPDX-License-Identifier: GPL-3.0-or-later
// What `clatter ground` says.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "validation/output/report.hpp"
#include "validation/scene/scene.hpp"
#include "validation/shock/ground_fit.hpp"

namespace clatter::validation {

/// A row for each ground.
[[nodiscard]] std::vector<Column> ground_columns();

/// The report on the ground that a drop and two measured numbers give.
[[nodiscard]] Report ground_report(const Scene& scene, const MeasuredNumber& first, const MeasuredNumber& second,
                                   const GroundFit& fit);

/// k_G of a material under a layer's or a half-space's approximation.
struct MaterialGround {
  double modulus = 0, poisson = 0, stiffness = 0;
};
/// A restitution that was measured beside the material, which says nothing of damping.
struct MaterialLoss {
  double restitution = 1, approach_speed = 0;  ///< of the first contact [m/s]
};
/// A row for each material or end of a floor's range; the last column with a measured restitution alone.
[[nodiscard]] std::vector<Column> material_columns();
/// A row for each; a named floor has two, the ends of its range.
[[nodiscard]] Report material_report(const std::vector<MaterialGround>& grounds, const std::string& approximation,
                                     const std::string& source, const std::optional<MaterialLoss>& loss);

}  // namespace clatter::validation
