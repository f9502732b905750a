// The keys of scene files whose values are numbers, with the sides of a box as body.size.length, body.size.width and
// body.size.thickness, and how they enter a scene that was read already.
#pragma once

#include <string>

#include "validation/scene/simulation_scene.hpp"

namespace clatter::validation {

struct NumberKey {
  const char* name;  ///< as in "drop.angle_deg"
  bool whole;        ///< only whole numbers
  /// Puts the value in its place; whether it is in range is for the reader of scenes to say.
  void (*put)(SimulationScene& scene, double value);

  /// Whether the body is another one then.
  [[nodiscard]] bool is_of_body() const;
};

/// The key of that name, or none if its value is no number, as "body.shape".
[[nodiscard]] const NumberKey* find_number_key(const std::string& name);

}  // namespace clatter::validation
