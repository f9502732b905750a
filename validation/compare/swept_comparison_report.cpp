// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/compare/swept_comparison_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "validation/compare/number_pair.hpp"
#include "validation/output/number.hpp"
#include "validation/run/swept_column.hpp"

namespace clatter::validation {
namespace {

/// How often first impacts are not compared (–), by reason.
void add_swept_reasons(const std::vector<SweptComparison>& swept, Report& report) {
  std::map<std::string, int> counts;
  for (const auto& [value, comparison] : swept) {
    if (!comparison.impacts.empty() && !comparison.impacts[0].reason.empty()) ++counts[comparison.impacts[0].reason];
  }
  for (const auto& [reason, count] : counts) {
    report.notes.push_back(
        fmt::format("–: not compared at this stiffness, {} of {} values: {}", count, swept.size(), reason));
  }
}

/// How far the mesh's corners are from the body's at most, where they are not the same.
void add_swept_corners(const std::vector<SweptComparison>& swept, Report& report) {
  const auto off = [](const SweptComparison& one) {
    return one.comparison.as_given ? one.comparison.corners_apart().largest : -1;
  };
  const auto worst = std::ranges::max_element(swept, {}, off);
  if (worst == swept.end() || off(*worst) < 0) return;
  report.notes.push_back(fmt::format("corners, at {} {}: {}", report.grid.columns.front().name, shortest(worst->value),
                                     corners_words(worst->comparison).substr(std::string("corners: ").size())));
}

std::string landing_word(const ComparedImpact& impact) {
  return !impact.has_landing() ? "" : impact.lands() ? "agrees" : "DIFFERS";
}

Row worst_row(double value, const Comparison& comparison, const ComparedImpact& impact) {
  const WorstNumber worst = worst_number(comparison, impact);
  Row row{impact.n == 1 ? Cell(value, 6) : Cell(), Cell(impact.n), Cell(impact.discrete_end)};
  if (impact.reason.empty()) {
    row.insert(row.end(), {difference_cell({worst.deviation, worst.deviation_error}, 1), Cell(worst.predicted, 2)});
  } else {
    row.insert(row.end(), {Cell("–"), Cell()});
  }
  if (impact.has_landing()) row.insert(row.end(), {miss_cell({worst.miss, worst.miss_error}), Cell(worst.bar, 2)});
  row.resize(7);
  row.emplace_back(landing_word(impact));
  return row;
}

}  // namespace

WorstNumber worst_number(const Comparison& comparison, const ComparedImpact& impact) {
  WorstNumber worst;
  double largest = -1, largest_miss = -1;
  for (const auto& [name, heading, q] : comparison.discrete.quantities) {
    const NumberPair pair{impact, q};
    const double scale = comparison.discrete.scales[q];
    if (impact.reason.empty() && std::fabs(pair.deviation()) / scale > largest) {
      largest = std::fabs(pair.deviation()) / scale;
      worst.deviation = largest;
      worst.deviation_error = pair.deviation_number().error / scale;
      worst.predicted = pair.predicted() / scale;
    }
    if (impact.has_landing() && std::fabs(pair.miss()) / pair.allowance() > largest_miss) {
      largest_miss = std::fabs(pair.miss()) / pair.allowance();
      worst.miss = std::fabs(pair.miss()) / scale;
      worst.miss_error = pair.miss_number().error / scale;
      worst.bar = pair.bar() / scale;
    }
  }
  return worst;
}

Report swept_comparison_report(const Scene& scene, const std::vector<SweptComparison>& swept) {
  Report report = begun_comparison(scene, {});
  const Column value_column = swept_column(*scene.sweep);
  report.grid.columns.insert(report.grid.columns.begin(), value_column);
  report.digest->columns = {value_column,
                            {"n", "n", ""},
                            {"end", "end", ""},
                            {"deviation", "deviation", "of all"},
                            {"predicted", "predicted", "of all"},
                            {"miss", "limit off", "of all"},
                            {"allowance", "±", "of all"},
                            {"verdict", "", ""}};
  report.fields["runs"] = Value::List{};
  for (const auto& [value, comparison] : swept) {
    Value run(Value::Fields{{scene.sweep->name(), value}});
    add_comparison(comparison, {Cell(value, 6)}, run, report.grid);
    report.fields["runs"].push_back(std::move(run));
    for (const ComparedImpact& impact : comparison.impacts) {
      if (impact.discrete) report.digest->rows.push_back(worst_row(value, comparison, impact));
    }
  }
  report.notes.emplace_back(
      "of all: of the largest time, speed or momentum of the sequence; the worst number of each impact");
  const auto agreeing =
      std::count_if(swept.begin(), swept.end(), [](const SweptComparison& one) { return one.comparison.agrees(); });
  report.fields["agrees"] = agreeing == static_cast<std::ptrdiff_t>(swept.size());
  report.notes.push_back(fmt::format("{} of {} values agree.", agreeing, swept.size()));
  add_swept_reasons(swept, report);
  add_swept_corners(swept, report);
  add_interruption(*scene.sweep, swept.size(), report);
  return report;
}

}  // namespace clatter::validation
