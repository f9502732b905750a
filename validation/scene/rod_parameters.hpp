// SPDX-License-Identifier: GPL-3.0-or-later
// Parameters of the thin rod whose contact angles are asked for, as flags give them.
#pragma once

#include <optional>
#include <string>

#include "analytic/plane/contact_angles.hpp"
#include "validation/output/value.hpp"

namespace clatter::validation::inline scene {

struct RodTexts {
  std::optional<std::string> gravity_number, gravity, length, speed, restitution, impulse_ratio;
};
/// @throws BadInput as read_scene().
[[nodiscard]] analytic::RodParameters read_rod(const RodTexts& texts);
/// The parameters under their names in JSON.
[[nodiscard]] Value rod_fields(const analytic::RodParameters& parameters);
/// "thin rod, G = …, e = …, μᵢ = …".
[[nodiscard]] std::string rod_summary(const analytic::RodParameters& parameters);

}  // namespace clatter::validation::inline scene
