// SPDX-License-Identifier: GPL-3.0-or-later
// The face of the body that comes to lie on the ground.
#pragma once

#include <optional>
#include <string>

#include "validation/output/report.hpp"
#include "validation/run/discrete_scene.hpp"
#include "validation/run/run.hpp"
#include "validation/scene/scene.hpp"

namespace clatter::validation {

/// The face on which a drop ends, where its sequence tells it.  It may slide or spin on there.
struct RestFace {
  /// The body's direction that points down: "-z" and such of a box, "(0, 0.894, -0.447)" of a mesh; of a rod "side",
  /// "end a" or "end b".
  std::string face{};
  Estimated time{};       ///< from when on it neither bounces nor rocks, since the first impact [s]
  bool is_known = false;  ///< whether no error of the numbers can lead to another face
};

[[nodiscard]] std::optional<RestFace> rest_face(const Scene& scene, const DiscreteDrop& drop,
                                                const DiscreteSequence& sequence);
[[nodiscard]] std::optional<RestFace> rest_face(const Scene& scene, const numeric::Simulation& simulation);
/// The impacts until that face is known, which is long before the body lies on it.  @throws as impact_sequence
[[nodiscard]] DiscreteSequence sequence_to_face(const Scene& scene, const DiscreteDrop& drop, bool with_errors);

/// As JSON has it: "face", "time", "time_error", "known".
[[nodiscard]] Value fields_of(const RestFace& rest);
/// The columns rest_face, rest_time and rest_known; their error stands apart.
[[nodiscard]] std::vector<Column> rest_columns();

}  // namespace clatter::validation
