// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/evidence/extremes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>

#include "validation/evidence/extreme_cases.hpp"
#include "validation/output/html.hpp"
#include "validation/output/interrupt.hpp"
#include "validation/output/number.hpp"
#include "validation/output/version.hpp"
#include "validation/scene/failure.hpp"

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
  for (std::size_t i = 0; i < oracles.texts().size(); ++i)
    by += fmt::format("{} {} {}", i == 0 ? ":" : ";", letter(i + 1), oracles.texts()[i]);
  report.notes.push_back(by);
  for (const MapAxis& axis : map_axes()) {
    const bool shown =
        std::any_of(map.cells.begin(), map.cells.end(), [&](const auto& c) { return c.axis == axis.name; });
    if (shown) report.notes.push_back(fmt::format("{}: {}", axis.symbol, axis.what));
  }
  for (std::size_t i = 0; i < reasons.texts().size(); ++i)
    report.notes.push_back(fmt::format("({}) {}", i + 1, reasons.texts()[i]));
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

constexpr double left_margin = 150, strip = 780, right_margin = 20, row_height = 15, axis_gap = 36, top_margin = 118;

/// Viridis in eight steps, dark for few digits: told apart by every kind of colour vision, and by lightness alone.
const char* colour_of(double digits) {
  constexpr std::array colours{"#440154", "#46327e", "#365c8d", "#277f8e", "#1fa187", "#4ac16d", "#a0da39", "#fde725"};
  return colours[std::min<std::size_t>(static_cast<std::size_t>(digits / 2), colours.size() - 1)];
}

/// A pattern of its own for each kind of refusal.
const char* fill_of(const ExtremeCell& cell) {
  switch (cell.verdict) {
    case CellVerdict::number: return colour_of(cell.digits());
    case CellVerdict::bad_input: return "url(#bad-input)";
    case CellVerdict::outside_model: return "url(#outside-model)";
    case CellVerdict::not_computed: return "url(#not-computed)";
    case CellVerdict::ended_early:
    case CellVerdict::time_limit: return "url(#ended-early)";
    case CellVerdict::broken: return "#d00000";
  }
  return "none";
}

std::string tooltip(const ExtremeCell& cell) {
  const std::string what = cell.has_number()
                               ? fmt::format("{} digits, {}", significant(cell.digits(), 3), cell.measure.outcome)
                               : fmt::format("{}: {}", verdict_name(cell.verdict), cell.reason);
  return html_escaped(fmt::format("{} {}, {}: {}", cell.axis, cell.label, level_name(cell.model), what));
}

std::string text(double x, double y, const std::string& attributes, const std::string& words) {
  return fmt::format("<text x=\"{}\" y=\"{}\" {}>{}</text>\n", x, y, attributes, html_escaped(words));
}

std::string box(double x, double y, double width, double height, const std::string& fill) {
  return fmt::format("<rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\" fill=\"{}\"", x, y, width,
                     height, fill);
}

std::string definitions() {
  const auto pattern = [](const char* name, const char* marks) {
    return fmt::format(
        "<pattern id=\"{}\" width=\"6\" height=\"6\" patternUnits=\"userSpaceOnUse\">"
        "<rect width=\"6\" height=\"6\" fill=\"#f2f2f2\"/>{}</pattern>\n",
        name, marks);
  };
  return "<defs>\n" + pattern("bad-input", "<path d=\"M0 6L6 0\" stroke=\"#8a8a8a\" stroke-width=\"1\"/>") +
         pattern("outside-model", "<path d=\"M0 0L6 6M0 6L6 0\" stroke=\"#6a6a6a\" stroke-width=\"0.9\"/>") +
         pattern("not-computed", "<circle cx=\"3\" cy=\"3\" r=\"1.3\" fill=\"#6a6a6a\"/>") +
         pattern("ended-early", "<path d=\"M0 3H6\" stroke=\"#8a8a8a\" stroke-width=\"1.2\"/>") + "</defs>\n";
}

std::string legend() {
  std::string out = text(left_margin, 62, "font-size=\"12\"", "right digits:");
  double x = left_margin + 82;
  for (int digits = 0; digits < 16; digits += 2) {
    out += box(x, 50, 40, 16, colour_of(digits)) + "/>\n";
    out += text(x + 20, 62,
                fmt::format("text-anchor=\"middle\" font-size=\"11\" fill=\"{}\"", digits < 8 ? "#ffffff" : "#000000"),
                digits == 14 ? "14–16" : fmt::format("{}–{}", digits, digits + 2));
    x += 40;
  }
  out += text(left_margin, 86, "font-size=\"12\"", "no number:");
  x = left_margin + 82;
  for (const auto& [name, words] : {std::pair{"bad-input", "bad input"},
                                    {"outside-model", "outside the model"},
                                    {"not-computed", "not computed"},
                                    {"ended-early", "run ended early"}}) {
    out += box(x, 74, 40, 16, fmt::format("url(#{})", name)) + " stroke=\"#bbbbbb\"/>\n";
    out += text(x + 46, 86, "font-size=\"11\"", words);
    x += 160;
  }
  return out;
}

/// Cells of one axis and model, side by side.
std::string strip_of(const std::vector<const ExtremeCell*>& cells, double y) {
  std::string out;
  const double width = strip / static_cast<double>(cells.size());
  for (std::size_t i = 0; i < cells.size(); ++i) {
    out += box(left_margin + width * static_cast<double>(i), y, width + 0.3, row_height - 2, fill_of(*cells[i])) +
           "><title>" + tooltip(*cells[i]) + "</title></rect>\n";
  }
  return out;
}

/// Values under an axis, as many as there is room for, both ends included.
std::string scale_of(const std::vector<const ExtremeCell*>& cells, double y) {
  std::string out;
  const double width = strip / static_cast<double>(cells.size());
  const std::size_t step = std::max<std::size_t>(1, (cells.size() + 12) / 13);
  for (std::size_t i = 0; i < cells.size(); i += step) {
    const bool crowds_last = i + step >= cells.size() && i + 1 < cells.size() && cells.size() - 1 - i < (step + 1) / 2;
    const std::size_t at = crowds_last || i + step >= cells.size() ? cells.size() - 1 : i;
    out += text(left_margin + width * (static_cast<double>(at) + 0.5), y,
                "text-anchor=\"middle\" font-size=\"9.5\" fill=\"#444444\"", cells[at]->label);
  }
  return out;
}

std::vector<const ExtremeCell*> cells_of(const ExtremesMap& map, const std::string& axis, ModelLevel model) {
  std::vector<const ExtremeCell*> cells;
  for (const ExtremeCell& cell : map.cells) {
    if (cell.axis == axis && cell.model == model) cells.push_back(&cell);
  }
  return cells;
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

std::string extremes_picture(const ExtremesMap& map) {
  std::string body;
  double y = top_margin;
  for (const MapAxis& axis : map_axes()) {
    if (axis.name == "long") continue;
    std::vector<const ExtremeCell*> last;
    const double begin = y;
    for (const ModelLevel model : all_levels) {
      const auto cells = cells_of(map, axis.name, model);
      if (cells.empty()) continue;
      body += text(left_margin - 6, y + 10.5, "text-anchor=\"end\" font-size=\"11\"", level_name(model));
      body += strip_of(cells, y);
      last = cells;
      y += row_height;
    }
    if (last.empty()) continue;
    body += text(12, begin + 10.5, "font-size=\"12\" font-weight=\"bold\"", axis.symbol);
    body += text(left_margin, begin - 3, "font-size=\"9\" fill=\"#555555\"", axis.what);
    body += scale_of(last, y + 8);
    y += axis_gap;
  }
  const double width = left_margin + strip + right_margin;
  return fmt::format(
             "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\" "
             "font-family=\"sans-serif\">\n<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n",
             width, y) +
         definitions() +
         text(12, 26, "font-size=\"17\" font-weight=\"bold\"",
              "What holds at the extremes: digits of each model to both ends of each quantity") +
         legend() + body + "</svg>\n";
}

}  // namespace clatter::validation
