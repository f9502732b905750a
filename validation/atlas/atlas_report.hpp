// SPDX-License-Identifier: GPL-3.0-or-later
// What `clatter atlas` says: strikes close to flat, over all directions of the tilt, in words and as a picture.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "validation/atlas/flat_body.hpp"
#include "validation/output/picture.hpp"
#include "validation/output/report.hpp"

namespace clatter::validation {

/// A body with its strikes.
struct Atlas {
  FlatBody body;
  std::string name;                                                     ///< as given, for heads
  std::optional<Scene> scene;                                           ///< that the body is of
  std::vector<analytic::near_flat::PlanarStrike> first_a{}, first_b{};  ///< in the plane, 10 000 at most
  std::optional<long long> count_a{}, count_b{};                        ///< nothing: infinitely many
  analytic::near_flat::TiltSectors tilts{};                             ///< in space
  std::optional<analytic::near_flat::CriticalRestitution> critical{};

  [[nodiscard]] bool in_plane() const { return body.contacts.index() == 0; }
};

[[nodiscard]] Atlas make_atlas(FlatBody body, const std::string& name, const std::optional<Scene>& scene);

/// In the plane a row per strike, for either end first; in space a row per sector of the tilts.
[[nodiscard]] Report atlas_report(const Atlas& atlas);
[[nodiscard]] std::vector<Column> atlas_plane_columns();
[[nodiscard]] std::vector<Column> atlas_space_columns();

/// Strikes over the directions of the tilt, and over shape: over the radii of gyration, from half to twice the body's.
[[nodiscard]] Picture atlas_picture(const Atlas& atlas);

/// "121/49" of a number that is a fraction with a denominator up to 200 to 1e-11, "½"; else empty.
[[nodiscard]] std::string as_fraction(double number);

}  // namespace clatter::validation
