// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/reports/extremes_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "validation/output/number.hpp"

namespace clatter::validation::inline reports {
namespace {

const char* const extremes_summary = "the map of what holds, to both ends of every quantity";

/// Numbers texts in the order in which they first come.
class Legend {
 public:
  std::size_t number(const std::string& text) {
    const auto found = std::find(texts_.begin(), texts_.end(), text);
    if (found != texts_.end()) return static_cast<std::size_t>(found - texts_.begin()) + 1;
    texts_.push_back(text);
    return texts_.size();
  }
  [[nodiscard]] const std::vector<std::string>& texts() const { return texts_; }

 private:
  std::vector<std::string> texts_;
};

std::string letter(std::size_t number) { return std::string(1, static_cast<char>('a' + static_cast<int>(number) - 1)); }

std::string digits_words(const ExtremeCell& cell, const MapRegion& region) {
  if (!cell.has_digits()) return "";
  const int low = static_cast<int>(region.fewest_digits), high = static_cast<int>(region.most_digits);
  return low == high ? std::to_string(low) : fmt::format("{}–{}", low, high);
}

/// Milliseconds in at most five characters.
std::string cost_words(double seconds) {
  const double ms = 1e3 * seconds;
  if (!(ms > 0)) return "";
  if (ms < 0.01) return "<0.01";
  return ms < 9.95 ? fmt::format("{:.2g}", ms) : fmt::format("{:.0f}", ms);
}

std::string model_word(ModelLevel model) { return model == ModelLevel::closed_form ? "closed" : level_name(model); }

/// "number" is left out: the outcome says more.
std::string what_happened(const ExtremeCell& cell) {
  if (cell.verdict == CellVerdict::broken) return verdict_name(cell.verdict);
  if (cell.long_run && cell.has_number()) return "see note";
  if (cell.has_number()) return cell.measure.outcome;
  return cell.measure.outcome.empty() ? verdict_name(cell.verdict) : cell.measure.outcome;
}

std::string outcome_words(const ExtremeCell& cell, Legend& reasons) {
  if (cell.has_number() && !cell.long_run) return what_happened(cell);
  const std::string why = cell.has_number() ? cell.measure.outcome : cell.reason;
  return fmt::format("{} ({})", what_happened(cell), reasons.number(why));
}

std::vector<std::string> head_of(const ExtremesMap& map) {
  const bool has_long = std::any_of(map.cells.begin(), map.cells.end(), [](const auto& c) { return c.long_run; });
  return {fmt::format("{} cells in {} regions; at most {} s for a cell{}", map.cells.size(), map.regions.size(),
                      shortest(map.cell_seconds),
                      has_long ? fmt::format("; random scenes of family {}", map.seed) : "")};
}

std::string counts_words(const ExtremesMap& map) {
  std::size_t numbers = 0, refusals = 0;
  for (const ExtremeCell& cell : map.cells) {
    if (cell.has_number()) ++numbers;
    else if (cell.verdict != CellVerdict::broken) ++refusals;
  }
  const std::size_t failures = map_failures(map).size();
  std::string text =
      fmt::format("{} cells ended with a number and its error, {} with a typed refusal", numbers, refusals);
  text += failures == 0 ? "; every error is within its bound" : fmt::format("; {} BREAK THEIR PROMISE", failures);
  return text + (map.complete ? "" : "; interrupted, the rest was not run");
}

std::string slowest_words(const ExtremesMap& map) {
  const ExtremeCell* slowest = slowest_cell(map);
  if (!slowest) return "";
  return fmt::format("slowest cell: {} {}, {}: {} s, its oracle included", slowest->axis, slowest->label,
                     level_name(slowest->model), significant(slowest->seconds, 2));
}

void add_notes(const ExtremesMap& map, const Legend& reasons, const Legend& oracles, Report& report) {
  for (const std::string& failure : map_failures(map)) report.notes.push_back("FAILED: " + failure);
  report.notes.push_back(counts_words(map));
  if (const std::string words = slowest_words(map); !words.empty()) report.notes.push_back(words);
  report.notes.push_back("digits: right ones, fewest and most of the region; cost: of the model in its slowest cell");
  std::string by = "by: what the number was held against";
  for (std::size_t i = 0; i < oracles.texts().size(); ++i) {
    by += fmt::format("{} {} {}", i == 0 ? ":" : ";", letter(i + 1), oracles.texts()[i]);
  }
  report.notes.push_back(by);
  for (const MapAxis& axis : map_axes()) {
    const bool shown =
        std::any_of(map.cells.begin(), map.cells.end(), [&](const auto& c) { return c.axis == axis.name; });
    if (shown) report.notes.push_back(fmt::format("{}: {}", axis.symbol, axis.what));
  }
  for (std::size_t i = 0; i < reasons.texts().size(); ++i) {
    report.notes.push_back(fmt::format("({}) {}", i + 1, reasons.texts()[i]));
  }
}

Row cell_row(const ExtremeCell& cell) {
  const CellMeasure& m = cell.measure;
  const auto where = [](bool known, double number) { return Cell(known ? Value(number) : Value()); };
  return {Cell(cell.axis),
          Cell(level_name(cell.model)),
          Cell(Value(cell.value)),
          Cell(cell.label),
          Cell(verdict_name(cell.verdict)),
          Cell(text_or_nothing(m.outcome)),
          where(cell.has_digits(), cell.has_digits() ? cell.digits() : 0),
          where(cell.has_number(), m.error),
          where(cell.has_number(), m.bound),
          Cell(text_or_nothing(cell.has_number() ? m.oracle : "")),
          Cell(text_or_nothing(cell.reason)),
          where(m.seconds > 0, m.seconds),
          Cell(m.evaluations > 0 ? Value(m.evaluations) : Value()),
          Cell(Value(cell.seconds))};
}

Value region_fields(const ExtremesMap& map, const MapRegion& region) {
  const ExtremeCell &first = map.cells[region.first], &last = map.cells[region.last];
  return Value::Fields{{"axis", first.axis},
                       {"model", level_name(first.model)},
                       {"from", first.value},
                       {"to", last.value},
                       {"labels", std::vector<std::string>{first.label, last.label}},
                       {"verdict", verdict_name(first.verdict)},
                       {"outcome", text_or_nothing(first.measure.outcome)},
                       {"reason", text_or_nothing(first.reason)},
                       {"fewest_digits", first.has_digits() ? Value(region.fewest_digits) : Value()},
                       {"most_digits", first.has_digits() ? Value(region.most_digits) : Value()},
                       {"seconds", region.slowest}};
}

/// One row for each region, and what its letters stand for.
void add_regions(const ExtremesMap& map, Report& report) {
  report.digest = Grid{{word_column("axis", "of", ""),
                        word_column("model", "model", ""),
                        {"from", "from", ""},
                        {"to", "to", ""},
                        {"digits", "digits", ""},
                        word_column("oracle", "by", ""),
                        {"seconds", "cost", "ms"},
                        word_column("outcome", "outcome", "")},
                       {}};
  Legend reasons, oracles;
  for (const MapRegion& region : map.regions) {
    const ExtremeCell &first = map.cells[region.first], &last = map.cells[region.last];
    const std::string by = first.has_number() ? letter(oracles.number(first.measure.oracle)) : "";
    report.digest->rows.push_back({Cell(map_axis(first.axis).symbol), Cell(model_word(first.model)), Cell(first.label),
                                   Cell(last.label), Cell(digits_words(first, region)), Cell(by),
                                   Cell(cost_words(region.slowest)), Cell(outcome_words(first, reasons))});
  }
  add_notes(map, reasons, oracles, report);
}

}  // namespace

std::vector<Column> extremes_columns() {
  return {{"axis", "", "", "the quantity that goes to its ends"},
          {"model", "", "", "a model of the hierarchy"},
          {"value", "", "", "of the quantity"},
          {"label", "", "", "the value in words"},
          {"verdict", "", "", "number, refused or broken"},
          {"outcome", "", "", "how the run ended"},
          {"digits", "", "", "right ones"},
          {"error", "", "", "relative, against the oracle"},
          {"bound", "", "", "on the error, by the program's own account"},
          {"oracle", "", "", "what the number was held against"},
          {"reason", "", "", "of a refusal"},
          {"seconds", "", "s", "that the model took"},
          {"evaluations", "", "", "of the force"},
          {"cell_seconds", "", "s", "that the cell took, its oracle included"}};
}

Report extremes_report(const ExtremesMap& map) {
  Report report = begun_report("extremes", extremes_summary);
  report.head = head_of(map);
  report.grid.columns = extremes_columns();
  for (const ExtremeCell& cell : map.cells) report.grid.rows.push_back(cell_row(cell));
  add_regions(map, report);
  report.fields["model"] = "extremes";
  report.fields["seed"] = map.seed;
  report.fields["cell_limit"] = map.cell_seconds;
  report.fields["cells"] = row_objects(report.grid);
  report.fields["regions"] = Value::List{};
  for (const MapRegion& region : map.regions) report.fields["regions"].push_back(region_fields(map, region));
  const ExtremeCell* slowest = slowest_cell(map);
  report.fields["slowest_cell"] = slowest ? Value(slowest->seconds) : Value();
  report.fields["failures"] = map_failures(map);
  report.fields["message"] = counts_words(map);
  return report;
}

}  // namespace clatter::validation::inline reports
