// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/evidence/extremes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "validation/evidence/continuous_cases.hpp"
#include "validation/output/interrupt.hpp"

namespace clatter::validation {
namespace {

constexpr double digits_within_a_region = 1;

bool chosen(const ExtremesOptions& options, const std::string& axis) {
  if (options.axes.empty()) return axis != "long" || options.long_runs;
  return std::find(options.axes.begin(), options.axes.end(), axis) != options.axes.end();
}

std::vector<ExtremeCase> cases_of(const MapAxis& axis, const ExtremesOptions& options,
                                  const std::function<bool()>& goes_on) {
  if (axis.name == "long") return long_cases(options.runs, goes_on);
  if (axis.name == "turns") return turn_cases(axis);
  const char* const of_round[] = {"disc", "needle", "slenderness", "bounces", "hops"};
  if (std::ranges::find(of_round, axis.name) != std::end(of_round)) return rim_cases(axis);
  if (axis.name == "squares" || axis.name == "cubes") return measured_cases(axis);
  std::vector<ExtremeCase> cases = discrete_cases(axis);
  for (ExtremeCase& extreme : continuous_cases(axis)) cases.push_back(std::move(extreme));
  return cases;
}

/// A reason without its numbers, which differ from cell to cell.
std::string kind_of_reason(const ExtremeCell& cell) {
  std::string kind;
  for (const char c : cell.reason) {
    if (!std::isdigit(static_cast<unsigned char>(c)) && c != '.' && c != '-' && c != '+' && c != 'e') kind += c;
  }
  return kind;
}

bool same_kind(const ExtremeCell& a, const ExtremeCell& b) {
  return a.axis == b.axis && a.model == b.model && a.verdict == b.verdict && a.measure.outcome == b.measure.outcome &&
         (a.has_number() || kind_of_reason(a) == kind_of_reason(b)) && !a.long_run;
}

}  // namespace

std::vector<MapRegion> regions_of(const std::vector<ExtremeCell>& cells) {
  std::vector<MapRegion> regions;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const double digits = cells[i].digits();
    if (!regions.empty() && same_kind(cells[regions.back().last], cells[i])) {
      MapRegion& region = regions.back();
      const double fewest = std::min(region.fewest_digits, digits), most = std::max(region.most_digits, digits);
      if (most - fewest <= digits_within_a_region) {
        region = {region.first, i, fewest, most, std::max(region.slowest, cells[i].measure.seconds)};
        continue;
      }
    }
    regions.push_back({i, i, digits, digits, cells[i].measure.seconds});
  }
  return regions;
}

ExtremesMap measure_extremes(const ExtremesOptions& options) {
  ExtremesMap map{.cell_seconds = options.cell_seconds, .seed = options.runs.seed};
  std::vector<ExtremeCase> cases;
  const auto goes_on = [&] { return !options.progress || options.progress(map.cells.size(), cases.size()); };
  for (const MapAxis& axis : map_axes()) {
    if (!chosen(options, axis.name)) continue;
    for (ExtremeCase& extreme : cases_of(axis, options, goes_on)) cases.push_back(std::move(extreme));
  }
  for (const ExtremeCase& extreme : cases) {
    if (!goes_on()) {
      map.complete = false;
      break;
    }
    map.cells.push_back(fill_cell(extreme, options.cell_seconds));
  }
  map.complete = map.complete && goes_on();
  map.regions = regions_of(map.cells);
  return map;
}

std::vector<std::string> map_failures(const ExtremesMap& map) {
  std::vector<std::string> failures;
  for (const ExtremeCell& cell : map.cells) {
    const std::string why = cell_failure(cell, map.cell_seconds);
    if (!why.empty())
      failures.push_back(fmt::format("{} {}, {}: {}", cell.axis, cell.label, level_name(cell.model), why));
  }
  return failures;
}

int map_status(const ExtremesMap& map) {
  constexpr int check_failed = 1;
  if (!map.complete) return interrupted_status;
  return map_failures(map).empty() ? 0 : check_failed;
}

const ExtremeCell* slowest_cell(const ExtremesMap& map) {
  const ExtremeCell* slowest = nullptr;
  for (const ExtremeCell& cell : map.cells) {
    if (!cell.long_run && (!slowest || cell.seconds > slowest->seconds)) slowest = &cell;
  }
  return slowest;
}

}  // namespace clatter::validation
