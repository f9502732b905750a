#include "validation/cli/extremes_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "validation/cli/impact_records.hpp"
#include "validation/cli/options.hpp"
#include "validation/cli/version.hpp"
#include "validation/output/number.hpp"

namespace clatter::validation {
namespace {

const char* const what_it_is = "the map of what holds, to both ends of every quantity";

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

std::string model_word(Rung model) { return model == Rung::closed_form ? "closed" : rung_name(model); }

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
  std::vector<std::string> head{headline("extremes", what_it_is)};
  head.push_back(fmt::format("{} cells in {} regions; at most {} s for a cell{}", map.cells.size(), map.regions.size(),
                             shortest(map.cell_seconds),
                             has_long ? fmt::format("; random scenes of family {}", map.seed) : ""));
  return head;
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
                     rung_name(slowest->model), significant(slowest->seconds, 2));
}

void add_notes(const ExtremesMap& map, const Legend& reasons, const Legend& oracles, Table& table) {
  for (const std::string& failure : map_failures(map)) table.notes.push_back("FAILED: " + failure);
  table.notes.push_back(counts_words(map));
  if (const std::string words = slowest_words(map); !words.empty()) table.notes.push_back(words);
  table.notes.push_back("digits: right ones, fewest and most of the region; cost: of the model in its slowest cell");
  std::string by = "by: what the number was held against";
  for (std::size_t i = 0; i < oracles.texts().size(); ++i) {
    by += fmt::format("{} {} {}", i == 0 ? ":" : ";", letter(i + 1), oracles.texts()[i]);
  }
  table.notes.push_back(by);
  for (const MapAxis& axis : map_axes()) {
    const bool shown =
        std::any_of(map.cells.begin(), map.cells.end(), [&](const auto& c) { return c.axis == axis.name; });
    if (shown) table.notes.push_back(fmt::format("{}: {}", axis.symbol, axis.what));
  }
  for (std::size_t i = 0; i < reasons.texts().size(); ++i) {
    table.notes.push_back(fmt::format("({}) {}", i + 1, reasons.texts()[i]));
  }
}

Json cell_json(const ExtremeCell& cell) {
  const CellMeasure& m = cell.measure;
  const auto text = [](const std::string& words) { return words.empty() ? Json(nullptr) : Json(words); };
  return {{"axis", cell.axis},
          {"model", rung_name(cell.model)},
          {"value", cell.value},
          {"label", cell.label},
          {"verdict", verdict_name(cell.verdict)},
          {"outcome", text(m.outcome)},
          {"digits", cell.has_digits() ? number_or_null(cell.digits()) : Json(nullptr)},
          {"error", cell.has_number() ? number_or_null(m.error) : Json(nullptr)},
          {"bound", cell.has_number() ? number_or_null(m.bound) : Json(nullptr)},
          {"oracle", text(cell.has_number() ? m.oracle : "")},
          {"reason", text(cell.reason)},
          {"seconds", m.seconds > 0 ? Json(m.seconds) : Json(nullptr)},
          {"evaluations", m.evaluations > 0 ? Json(m.evaluations) : Json(nullptr)},
          {"cell_seconds", cell.seconds}};
}

}  // namespace

Table extremes_table(const ExtremesMap& map, Format) {
  Table table{.head = head_of(map), .columns = {}, .rows = {}, .notes = {}};
  table.columns = {{.name = "axis", .heading = "of", .unit = "", .words = true},
                   {.name = "model", .heading = "model", .unit = "", .words = true},
                   {"from", "from", ""},
                   {"to", "to", ""},
                   {"digits", "digits", ""},
                   {.name = "oracle", .heading = "by", .unit = "", .words = true},
                   {"seconds", "cost", "ms"},
                   {.name = "outcome", .heading = "outcome", .unit = "", .words = true}};
  Legend reasons, oracles;
  for (const MapRegion& region : map.regions) {
    const ExtremeCell &first = map.cells[region.first], &last = map.cells[region.last];
    const std::string by = first.has_number() ? letter(oracles.number(first.measure.oracle)) : "";
    table.rows.push_back({Cell(map_axis(first.axis).symbol), Cell(model_word(first.model)), Cell(first.label),
                          Cell(last.label), Cell(digits_words(first, region)), Cell(by),
                          Cell(cost_words(region.slowest)), Cell(outcome_words(first, reasons))});
  }
  add_notes(map, reasons, oracles, table);
  return table;
}

Table extremes_records(const ExtremesMap& map) {
  Table table{.head = head_of(map), .columns = {}, .rows = {}, .notes = {counts_words(map)}};
  Json cells = Json::array();
  for (const ExtremeCell& cell : map.cells) cells.push_back(cell_json(cell));
  add_impact_records(table, cells);
  return table;
}

Json extremes_json(const ExtremesMap& map) {
  Json json{{"clatter", version},     {"model", "extremes"},     {"seed", map.seed}, {"cell_limit", map.cell_seconds},
            {"cells", Json::array()}, {"regions", Json::array()}};
  for (const ExtremeCell& cell : map.cells) json["cells"].push_back(cell_json(cell));
  for (const MapRegion& region : map.regions) {
    const ExtremeCell &first = map.cells[region.first], &last = map.cells[region.last];
    json["regions"].push_back({{"axis", first.axis},
                               {"model", rung_name(first.model)},
                               {"from", first.value},
                               {"to", last.value},
                               {"labels", {first.label, last.label}},
                               {"verdict", verdict_name(first.verdict)},
                               {"outcome", first.measure.outcome.empty() ? Json(nullptr) : Json(first.measure.outcome)},
                               {"reason", first.reason.empty() ? Json(nullptr) : Json(first.reason)},
                               {"fewest_digits", first.has_digits() ? Json(region.fewest_digits) : Json(nullptr)},
                               {"most_digits", first.has_digits() ? Json(region.most_digits) : Json(nullptr)},
                               {"seconds", region.slowest}});
  }
  const ExtremeCell* slowest = slowest_cell(map);
  json["slowest_cell"] = slowest ? Json(slowest->seconds) : Json(nullptr);
  json["failures"] = map_failures(map);
  json["message"] = counts_words(map);
  return json;
}

}  // namespace clatter::validation
