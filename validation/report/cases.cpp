// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/report/cases.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "validation/output/bad_input.hpp"
#include "validation/output/number.hpp"
#include "validation/sweep/points.hpp"

namespace clatter::validation {
namespace {

/// The flags whose texts may be several values of e, as those of a sweep: 0.3:0.7:0.1, or 0.3,0.5.
constexpr const char* ranged_flags[] = {"--restitution", "--floor-restitution"};

/// A row for each case, the worst first: by the least margin, or what else all are ranked by.
Grid cases_grid(const std::vector<const ReportCase*>& cases) {
  const auto differ = [&](auto&& value) {
    return std::ranges::any_of(cases, [&](const ReportCase* one) { return value(*one) != value(*cases.front()); });
  };
  Grid grid{case_columns(), {}, 3};
  for (Column& column : grid.columns) {
    if (column.name == "floor") column.shown = differ([](const ReportCase& one) { return one.floor(); });
    if (column.name == "restitution") column.shown = !cases.front()->restitution.empty();
    if (column.name == "probe") column.shown = cases.front()->found.run.probes.size() > 1;
    if (column.name == "part") column.shown = !cases.front()->input.parts.empty();
  }
  for (const ReportCase* one : cases) {
    const Value& answer = *one->found.report.fields.find("answer");
    const auto of = [&](const char* name) {
      const Value* const value = answer.find(name);
      const double* const number = value ? value->number() : nullptr;
      return !value ? Cell() : number ? Cell(*number, 3) : Cell(*value);
    };
    const auto part = one->input.part();
    double e = 0;
    grid.rows.push_back({Cell(one->floor()), read_number(one->restitution, e) ? Cell(e, one->restitution) : Cell(),
                         part ? Cell(part_text(*part)) : Cell(), of("margin"), of("attitude"), of("probe"),
                         of("impact"), of("peak_g"), of("delta_v"), of("decided_by"), of("failing"), of("drops")});
  }
  return grid;
}

}  // namespace

std::vector<ReportCase> cases_of(const ReportInput& given) {
  std::vector<ReportInput> inputs{given};
  const auto multiply = [&](std::size_t count, auto&& set) {
    std::vector<ReportInput> more;
    for (const ReportInput& input : inputs) {
      for (std::size_t i = 0; i < count; ++i) set(i, more.emplace_back(input));
    }
    if (count > 0) inputs = std::move(more);
  };
  multiply(given.scenes.size(), [&](std::size_t i, ReportInput& input) { input.scene.source = given.scenes[i]; });
  const char* ranged = nullptr;
  for (const char* const flag : ranged_flags) {
    const std::string& text = given.scene.texts.at(flag);
    if (text.find_first_of(":,") == std::string::npos) continue;
    if (ranged) throw BadInput(fmt::format("{} {}: {} has several values already", flag, text, ranged));
    ranged = flag;
    const SweepAxis axis = read_grid_axis(flag, text, false);
    if (axis.count > 100) throw BadInput(fmt::format("{} {}: more than 100 values", flag, text));
    multiply(static_cast<std::size_t>(axis.count), [&](std::size_t i, ReportInput& input) {
      input.scene.texts[flag] = shortest(axis.at(static_cast<long long>(i)));
    });
  }
  multiply(given.parts.size(), [&](std::size_t i, ReportInput& input) { input.parts = {given.parts[i]}; });
  std::vector<ReportCase> cases;
  for (ReportInput& input : inputs) {
    const bool is_turned = gives_attitude(input);
    if (!is_turned && looks_at_all(input)) input.scene.texts["--orientation"] = "1";  // some one: the sweep has its own
    const Scene scene = shock_scene(input);
    require_worst_attitudes(input, scene);
    if (!input.parts.empty() && probes_of(input).empty())
      throw BadInput("--part: needs --probe NAME:X,Y,Z, or [[probe]], where the part is");
    cases.push_back({input, ranged ? input.scene.texts.at(ranged) : "", view_of(input), is_turned, scene});
  }
  return cases;
}

std::vector<const ReportCase*> ranked(const std::vector<ReportCase>& cases) {
  std::vector<const ReportCase*> order;
  for (const ReportCase& one : cases) order.push_back(&one);
  const auto is_worse = [](const ReportCase* one, const ReportCase* other) {
    return one->found.ranking.is_worse(one->value(), other->value());
  };
  if (std::ranges::all_of(cases, [&](const ReportCase& one) {
        return one.found.ranking.by == cases.front().found.ranking.by && std::isfinite(one.value());
      }))
    std::ranges::stable_sort(order, is_worse);
  return order;
}

std::vector<const ReportCase*> worst_of_floors(const std::vector<const ReportCase*>& order) {
  std::vector<const ReportCase*> worst;
  for (const ReportCase* one : order) {
    if (std::ranges::none_of(worst, [&](const ReportCase* other) { return other->floor() == one->floor(); }))
      worst.push_back(one);
  }
  return worst;
}

Report joined_report(const std::vector<const ReportCase*>& order) {
  const Findings& worst = order.front()->found;
  Report report = worst.report;
  report.grid = cases_grid(order);
  std::string words;
  for (const ReportCase* one : worst_of_floors(order)) {
    words += fmt::format("{}{}: ", words.empty() ? "" : "; ", one->name());
    if (!one->found.answer.blow) words += one->found.answer.words;
    else if (one->input.parts.empty()) words += one->found.lead;
    else words += "least margin " + said(one->value());
  }
  report.notes = {fmt::format("Worst of {} cases: {}", order.size(), words), worst.lead};
  report.fields["message"] = report.notes.front();
  report.fields["cases"] = row_objects(report.grid);
  return report;
}

std::vector<Column> case_columns() {
  return {word_column("floor", "scene", "file whose drop it is"),
          {"restitution", "e", "", "that was given"},
          word_column("part", "part", "what bears it, as --part takes it"),
          {"margin", "margin", "", "the least of all drops: at 1 and below the part fails"},
          word_column("attitude", "down", "how the body is turned in that drop"),
          word_column("probe", "probe", "name of the point"),
          {"impact", "impact", "", "whose blow has it"},
          {"peak_g", "peak", "g", "largest specific force at the probe in that blow"},
          {"delta_v", "|ΔV|", "m/s", "change of the probe's velocity in it"},
          word_column("decided_by", "by", "what decides the margin: change of velocity, peak, or the blow's history"),
          {"failing", "failing", "", "drops that the part does not survive"},
          {"drops", "drops", "", "of the case"}};
}

}  // namespace clatter::validation
