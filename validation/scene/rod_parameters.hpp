// SPDX-License-Identifier: GPL-3.0-or-later
// Parameters of the thin rod whose contact angles are asked for, as flags give them.
#pragma once

#include <optional>
#include <string>

#include "analytic/plane/contact_angles.hpp"
#include "validation/output/value.hpp"
#include "validation/scene/argument.hpp"

namespace clatter::validation {

struct RodRequest {
  std::optional<double> gravity_number;
  std::optional<double> gravity;  ///< [m/s²], with the next two in place of the gravity number
  double length = 1, speed = 1;   ///< [m], [m/s]
  double restitution = 1, impulse_ratio = 0;
};
[[nodiscard]] Arguments rod_arguments(RodRequest& request);
/// @throws BadInput where gravity is given twice, or the gravity number overflows
[[nodiscard]] analytic::RodParameters rod_parameters(const RodRequest& request);
/// The parameters under their names in JSON.
[[nodiscard]] Value rod_fields(const analytic::RodParameters& parameters);
/// "thin rod, G = …, e = …, μᵢ = …".
[[nodiscard]] std::string rod_summary(const analytic::RodParameters& parameters);

}  // namespace clatter::validation
