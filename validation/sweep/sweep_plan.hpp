// SPDX-License-Identifier: GPL-3.0-or-later
// What a sweep computes: scenes that differ in the values of a few keys.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "validation/output/report.hpp"
#include "validation/scene/keys.hpp"
#include "validation/scene/scene.hpp"
#include "validation/sweep/grid.hpp"

namespace clatter::validation::inline sweep {

/// What was typed, empty where not given.
struct SweepRequest {
  std::string file;
  std::optional<std::string> text;  ///< of the scene that `file` then only names in messages
  std::vector<std::string> sets;
  std::optional<std::string> random, seed, model, rows;
  bool no_errors = false;       ///< as --set run.errors=false
  bool require_digits = false;  ///< as --set run.require_digits=true
};

enum class RowKind { scene, impact };

struct SweepPlan {
  Scene scene;  ///< the swept keys have their first values
  Model model = Model::discrete;
  RowKind rows = RowKind::scene;
  /// Whether a scene may leave its plane: by the first scene, by a swept tilt or orientation, or a mesh.
  bool in_space = false;
  SweepPoints points;
  /// What puts the value of each axis into a scene.
  std::vector<std::function<void(Scene&, double)>> put;
  /// Axes that make the body another one.
  std::vector<std::size_t> body_axes;
  /// How it was asked for: the values set, and how many scenes there are.
  std::vector<std::string> words;

  /// The report without rows.  Equal for equal sweeps; a body's mesh is in it by a digest of its file.
  [[nodiscard]] Report report() const;
};

/// A scene with a ground is for the continuous model unless the other one is named.  As in scene files, one coefficient
/// of the ground's friction is both: a sliding one that is set replaces the file's static one too, unless both are set.
/// @throws BadInput with one line; both ends of every axis are checked like keys of the scene file.
[[nodiscard]] SweepPlan read_sweep_plan(const SweepRequest& request);

}  // namespace clatter::validation::inline sweep
