// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/shock/shock_history.hpp"

#include <fmt/format.h>

#include <cmath>

#include "validation/scene/body_properties.hpp"
#include "validation/shock/uniform_history.hpp"

namespace clatter::validation {
namespace {

constexpr const char* axes[] = {"x", "y", "z"};

void add_vector(Row& row, const Vector3& vector) {
  for (int i = 0; i < 3; ++i) row.emplace_back(vector[i], 6);
}

void add_known(Row& row, double number) { row.push_back(std::isfinite(number) ? Cell(number, 6) : Cell()); }

}  // namespace

std::vector<Column> shock_history_columns(const std::vector<std::string>& probes) {
  std::vector<Column> columns{{"time", "t", "s", "after the first touch-down"},
                              {"impact", "n", "", "number of the impact; in flight that of the one before"},
                              word_column("mark", "mark", "peak of PROBE: an instant beside those of the rate")};
  const auto add = [&](const std::string& name, const std::string& symbol, const char* unit, const char* meaning,
                       bool shown) {
    for (const char* axis : axes) {
      columns.push_back({fmt::format("{}_{}", name, axis), fmt::format("{}_{}", symbol, axis), unit, meaning, shown});
    }
  };
  add("force", "F", "N", "contact force, world", false);
  columns.back().shown = true;
  columns.push_back({"action_x", "", "m", "where the force's line of action meets the ground, world", false});
  columns.push_back({"action_y", "", "m", "where the force's line of action meets the ground, world", false});
  add("torque", "", "N·m", "of the contact force about the centre of mass, world", false);
  add("angular_acceleration", "", "rad/s²", "of the body, world", false);
  columns.push_back({"indentation", "δ", "m", "of the deepest point; negative above the ground"});
  columns.push_back({"pressure", "p", "Pa", "largest, (k_G + c_G δ̇) δ"});
  for (const std::string& probe : probes) {
    add(probe, "a", "m/s²", "specific force at the probe, body axes", false);
    columns.push_back({probe, probe, "m/s²", "its size"});
  }
  return columns;
}

Grid shock_history_grid(const ShockRun& run, double rate) {
  const numeric::Body body = run.scene.make_body();
  const Vector3 centre = body_properties(run.scene, Model::continuous).centre;
  std::vector<Vector3> places;
  std::vector<std::string> names;
  for (const Probe& probe : run.probes) {
    places.push_back(probe.place - centre);
    names.push_back(probe.name);
  }
  Grid grid{shock_history_columns(names), {}, 2};
  for (const HistoryInstant& at : uniform_history(*run.continuous, body, run.scene.world.ground, places, rate)) {
    Row row{Cell(at.time, 9), Cell(at.impact)};
    row.emplace_back(at.peak_of < 0 ? "" : "peak of " + names[static_cast<std::size_t>(at.peak_of)]);
    add_vector(row, at.force);
    add_known(row, at.action_x);
    add_known(row, at.action_y);
    add_vector(row, at.torque);
    add_vector(row, at.angular_acceleration);
    row.emplace_back(at.indentation, 6);
    row.emplace_back(at.pressure, 6);
    for (const Vector3& force : at.specific_forces) {
      add_vector(row, force);
      row.emplace_back(force.norm(), 6);
    }
    grid.rows.push_back(std::move(row));
  }
  return grid;
}

}  // namespace clatter::validation
