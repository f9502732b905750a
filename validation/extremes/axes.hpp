// SPDX-License-Identifier: GPL-3.0-or-later
// The quantities that the map sweeps, and their values up to both ends.
#pragma once

#include <string>
#include <vector>

namespace clatter::validation::inline extremes {

struct AxisValue {
  double value = 0;
  std::string label;  ///< for a reader, at most eight characters
};

struct MapAxis {
  std::string name;    ///< of --only, csv and json
  std::string symbol;  ///< in the table, at most six characters
  std::string what;    ///< one line, with the unit
  std::vector<AxisValue> values;
};

/// angle, stiffness, damping, restitution, ratio, friction, speed, gravity, size, mass, turns, impacts, squares, cubes;
/// long has no values of its own.
[[nodiscard]] const std::vector<MapAxis>& map_axes();
/// @throws std::out_of_range if there is none of that name.
[[nodiscard]] const MapAxis& map_axis(const std::string& name);

}  // namespace clatter::validation::inline extremes
