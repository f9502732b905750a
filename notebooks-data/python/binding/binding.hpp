// SPDX-License-Identifier: GPL-3.0-or-later
// The functions of the Python module's compiled part, and what they return: the program's own reports.
#pragma once

#include <pybind11/pybind11.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "interruptible.hpp"
#include "validation/output/report.hpp"
#include "validation/scene/argument.hpp"
#include "validation/scene/keys.hpp"
#include "validation/scene/scene.hpp"

namespace clatter::python {

/// What a run came to.  Both functions hold all that they read.
struct Report {
  std::function<validation::Report()> made;  ///< when something of it is first asked for
  /// The text where the program prints another one than the report's.
  std::function<std::string(const validation::TextStyle&)> text = nullptr;
  std::shared_ptr<const validation::Report> known = nullptr;  ///< once it is made

  /// All of it, kept for the next question.
  const validation::Report& whole() {
    if (!known) {
      known =
          run_interruptible([make = made](const Watch&) { return std::make_shared<const validation::Report>(make()); });
    }
    return *known;
  }
};

/// A report that is made already.
[[nodiscard]] inline Report kept(validation::Report report) {
  return {.made = nullptr, .known = std::make_shared<const validation::Report>(std::move(report))};
}

/// A scene as Python hands it over: keys by the names of arguments take the place of what a file or a text says.
struct SceneSource {
  std::string name;                 ///< of a file, or what messages call the text; "" without both
  std::optional<std::string> text;  ///< content of a scene file
  validation::NamedTexts changes;

  [[nodiscard]] validation::SceneValues values() const {
    return text ? validation::SceneValues(name, *text, validation::scene_keys()) : validation::scene_values(name);
  }
  /// @throws BadInput as read_scene.
  [[nodiscard]] validation::Scene read(validation::Model model) const {
    return read_scene(values(), validation::scene_overrides(changes), model);
  }
};

/// The option of that name, if it is given.
[[nodiscard]] inline std::optional<std::string> given(const validation::NamedTexts& options, const char* name) {
  const auto found = options.find(name);
  return found == options.end() ? std::nullopt : std::optional(found->second);
}

/// The class Report, keys.
void add_reports(pybind11::module_& module);
/// sequence, explain; regimes, angles, angle_arrays.
void add_discrete_functions(pybind11::module_& module);
/// simulate, compare, plan, tradeoff, sweep; cases.
void add_scene_functions(pybind11::module_& module);
/// run_command: atlas, ground, map, report, shock; command_options.
void add_commands(pybind11::module_& module);
/// verify, measured, benchmark_*, compare_against, extremes, figure.
void add_evidence_functions(pybind11::module_& module);

}  // namespace clatter::python
