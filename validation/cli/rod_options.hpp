// Options of the commands that deal with the thin rod's contact angles.
#pragma once

#include <optional>
#include <string>

#include "analytic/contact_angles.hpp"
#include "validation/cli/command.hpp"
#include "validation/output/value.hpp"

namespace clatter::validation {

struct RodTexts {
  std::optional<std::string> gravity_number, gravity, length, speed, restitution, impulse_ratio;
};
void add_rod_options(Command& command, RodTexts& texts);
/// @throws BadInput as read_scene().
[[nodiscard]] analytic::RodParameters read_rod(const RodTexts& texts);
/// The parameters under their names in JSON.
[[nodiscard]] Value rod_fields(const analytic::RodParameters& parameters);
/// "thin rod, G = …, e = …, μᵢ = …".
[[nodiscard]] std::string rod_summary(const analytic::RodParameters& parameters);

}  // namespace clatter::validation
