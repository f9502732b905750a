#include "validation/cli/comparison_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "validation/cli/impact_records.hpp"
#include "validation/cli/options.hpp"
#include "validation/cli/swept_column.hpp"
#include "validation/cli/version.hpp"
#include "validation/output/estimated.hpp"
#include "validation/output/names.hpp"
#include "validation/output/number.hpp"
#include "validation/scene/body_properties.hpp"

namespace clatter::validation {
namespace {

const char* const what_it_is = "discrete and continuous model, impact by impact";

/// A number of an impact in both models.
struct NumberPair {
  const ComparedImpact& impact;
  std::size_t quantity;

  [[nodiscard]] double discrete() const { return (*impact.discrete)[quantity]; }
  [[nodiscard]] double continuous() const { return (*impact.continuous)[quantity]; }
  [[nodiscard]] double deviation() const { return continuous() - discrete(); }
  [[nodiscard]] Estimated discrete_number() const { return {discrete(), impact.discrete_error[quantity]}; }
  [[nodiscard]] Estimated continuous_number() const { return {continuous(), impact.continuous_error[quantity]}; }
  [[nodiscard]] Estimated deviation_number() const { return continuous_number() - discrete_number(); }
  /// Of the limit off the discrete value; its own error bar stands beside it.
  [[nodiscard]] Estimated miss_number() const { return {miss(), impact.discrete_error[quantity] + bar()}; }
  [[nodiscard]] double predicted() const { return impact.predicted.total()[quantity]; }
  [[nodiscard]] double miss() const { return impact.limit->value[quantity] - discrete(); }
  [[nodiscard]] double allowance() const { return impact.allowance[quantity]; }
  [[nodiscard]] double bar() const { return impact.limit->error[quantity]; }
};

/// Zero in both models and in the limit, by symmetry; a limit that misses is something.
bool is_nothing(const Comparison& comparison, const ComparedImpact& impact, std::size_t q) {
  if (impact.has_landing() && !(std::fabs(NumberPair{impact, q}.miss()) <= impact.allowance[q])) return false;
  const double tiny = 1e-12 * comparison.scales[q];
  return std::fabs((*impact.discrete)[q]) <= tiny && impact.continuous && std::fabs((*impact.continuous)[q]) <= tiny;
}

/// The impact's number, marked if its limit misses the discrete value.
Cell number_cell(const ComparedImpact& impact) {
  return Cell(std::to_string(impact.n) + (impact.has_landing() && !impact.lands() ? "!" : ""));
}

std::string landing_word(const ComparedImpact& impact) {
  return !impact.has_landing() ? "" : impact.lands() ? "agrees" : "DIFFERS";
}

/// A difference, to two digits at most.
Cell difference_cell(const Estimated& difference, double scale) {
  Cell cell = known_cell(difference, {6, scale});
  cell.digits = std::min(cell.digits, 2);
  return cell;
}

/// By how much the limit is off; 0 where the error bar, which stands beside it, leaves no digit.
Cell miss_cell(const Estimated& miss) {
  const int digits = known_digits(miss.value, miss.error);
  return digits > 0 || !miss.is_known() ? Cell(miss.value, std::min(digits, 2)) : Cell(0.0, 1);
}

void add_rows(const Comparison& comparison, const ComparedImpact& impact, Table& table) {
  bool first = true;
  for (std::size_t q = 0; q < quantity_count; ++q) {
    if (!impact.discrete || is_nothing(comparison, impact, q)) continue;
    const NumberPair pair{impact, q};
    const double scale = comparison.scales[q];
    const bool comparable = impact.reason.empty();
    std::vector<Cell> row{first ? number_cell(impact) : Cell(), first ? Cell(impact.discrete_end) : Cell(),
                          Cell(quantity_names[q].heading), known_cell(pair.discrete_number(), {6, scale})};
    if (comparable) {
      row.insert(row.end(), {known_cell(pair.continuous_number(), {6, scale}),
                             difference_cell(pair.deviation_number(), scale), Cell(pair.predicted(), 2)});
    } else {
      row.insert(row.end(), {Cell("–"), Cell(), Cell()});
    }
    if (impact.has_landing()) row.insert(row.end(), {miss_cell(pair.miss_number()), Cell(pair.bar(), 2)});
    row.resize(9);
    table.rows.push_back(std::move(row));
    first = false;
  }
}

/// Why impacts are not compared; those that follow one in one line.
std::vector<std::string> reasons(const Comparison& comparison) {
  std::vector<std::string> notes;
  for (const ComparedImpact& impact : comparison.impacts) {
    if (impact.reason.empty()) continue;
    const int last = static_cast<int>(comparison.impacts.size());
    std::string note = fmt::format("Impact {} is not compared: {}", impact.n, impact.reason);
    if (impact.has_landing()) note += fmt::format("; on stiffer ground it {}", impact.lands() ? "agrees" : "differs");
    if (impact.n < last) note += fmt::format("; nor are those that follow, up to {}", last);
    notes.push_back(note);
    break;
  }
  return notes;
}

std::string limit_words(const Comparison& comparison) {
  const StiffLimit& limit = comparison.limit;
  if (limit.rows.empty()) return "No limit: the impacts do not come apart on stiffer ground either.";
  return fmt::format(
      "limit off: by how much the limit k → ∞ is off the discrete value, ± its error bar; from {} runs up to k = {} "
      "N/m³, over the contact time, which falls like k^{}",
      limit.runs, significant(limit.stiffness, 2), significant(-limit.power, 3));
}

std::string verdict_words(const Comparison& comparison) {
  const auto landed = std::count_if(comparison.impacts.begin(), comparison.impacts.end(),
                                    [](const ComparedImpact& impact) { return impact.has_landing(); });
  if (!comparison.agrees()) return "The models DIFFER: a limit (!) misses the discrete value.";
  if (landed == 0) return "Nothing could be compared.";
  return fmt::format("The models agree: the limit is the discrete value for {} of {} impacts.", landed,
                     comparison.impacts.size());
}

std::vector<std::string> head_of(const Scene& scene) {
  std::vector<std::string> head{headline("compare", what_it_is)};
  for (const std::string& line : scene_head(scene)) head.push_back(line);
  head.push_back("discrete model: real corners and inertia, e from the damping at each impact's speed, Coulomb's μₖ");
  return head;
}

Json number_json(const NumberPair& pair) {
  const ComparedImpact& impact = pair.impact;
  const std::size_t q = pair.quantity;
  const PredictedSize& size = impact.predicted;
  Json json{{"discrete", impact.discrete ? number_or_null(pair.discrete()) : Json(nullptr)},
            {"continuous", impact.continuous ? number_or_null(pair.continuous()) : Json(nullptr)}};
  const bool comparable = impact.reason.empty();
  json["discrete_error"] = impact.discrete ? error_or_null(pair.discrete_number()) : Json(nullptr);
  json["continuous_error"] = impact.continuous ? error_or_null(pair.continuous_number()) : Json(nullptr);
  json["deviation"] = comparable ? number_or_null(pair.deviation()) : Json(nullptr);
  json["deviation_error"] = comparable ? error_or_null(pair.deviation_number()) : Json(nullptr);
  json["predicted"] = comparable ? number_or_null(pair.predicted()) : Json(nullptr);
  json["predicted_gravity"] = comparable ? number_or_null(size.gravity[q]) : Json(nullptr);
  json["predicted_turning"] = comparable ? number_or_null(size.turning[q]) : Json(nullptr);
  json["predicted_indentation"] = comparable ? number_or_null(size.indentation[q]) : Json(nullptr);
  json["predicted_delay"] = comparable ? number_or_null(size.delay[q]) : Json(nullptr);
  json["limit"] = impact.limit ? number_or_null(impact.limit->value[q]) : Json(nullptr);
  json["limit_error"] = impact.limit ? number_or_null(impact.limit->error[q]) : Json(nullptr);
  json["allowance"] = impact.limit ? number_or_null(pair.allowance()) : Json(nullptr);
  return json;
}

/// Whether every number of either model is known to its error.
bool is_predictable(const ComparedImpact& impact) {
  for (std::size_t q = 0; q < quantity_count; ++q) {
    if (impact.discrete && !std::isfinite(impact.discrete_error[q])) return false;
    if (impact.continuous && !std::isfinite(impact.continuous_error[q])) return false;
  }
  return true;
}

Json impact_json(const ComparedImpact& impact) {
  Json json{{"n", impact.n},
            {"comparable", impact.reason.empty()},
            {"predictable", is_predictable(impact)},
            {"reason", impact.reason.empty() ? Json(nullptr) : Json(impact.reason)},
            {"discrete_end", impact.discrete ? Json(impact.discrete_end) : Json(nullptr)},
            {"continuous_end", impact.continuous ? Json(impact.continuous_end) : Json(nullptr)},
            {"contact_time", impact.continuous ? number_or_null(impact.contact_time) : Json(nullptr)},
            {"limit_is_discrete", impact.has_landing() ? Json(impact.lands()) : Json(nullptr)}};
  for (std::size_t q = 0; q < quantity_count; ++q) json["numbers"][quantity_names[q].name] = number_json({impact, q});
  return json;
}

Json result_json(const Comparison& comparison) {
  Json json{{"impacts", Json::array()}};
  for (const ComparedImpact& impact : comparison.impacts) json["impacts"].push_back(impact_json(impact));
  json["limit"] = {{"stiffness", number_or_null(comparison.limit.stiffness)},
                   {"power", number_or_null(-comparison.limit.power)},
                   {"runs", comparison.limit.runs}};
  json["discrete_ended"] = comparison.sequence.message;
  json["continuous_ended"] = comparison.run.message;
  json["agrees"] = comparison.agrees();
  json["shortfall"] = comparison.shortfall.empty() ? Json(nullptr) : Json(comparison.shortfall);
  json["message"] = verdict_words(comparison);
  return json;
}

Json head_json(const Scene& scene) {
  return {{"clatter", version}, {"model", "comparison"}, {"scene", scene.json()}, {"body", body_json(scene)}};
}

/// Rows of the CSV for one comparison, with further cells in front.
void add_records(const Comparison& comparison, const std::vector<Cell>& front, Table& table) {
  for (const ComparedImpact& impact : comparison.impacts) {
    const Json json = impact_json(impact);
    for (const auto& [name, numbers] : json["numbers"].items()) {
      auto& row = table.rows.emplace_back(front);
      row.insert(row.end(), {Cell(impact.n, 17), Cell(name), Cell(is_predictable(impact) ? "true" : "false"),
                             Cell(impact.reason)});
      for (const auto& [key, value] : numbers.items()) row.push_back(json_cell(value));
    }
  }
}

Table records_table(const Scene& scene) {
  Table table{
      .head = {headline("compare", what_it_is), "scene: " + scene.json().dump(), "body: " + body_json(scene).dump()},
      .columns = {},
      .rows = {},
      .notes = {}};
  for (const char* name :
       {"n", "quantity", "predictable", "not_compared_because", "discrete", "continuous", "discrete_error",
        "continuous_error", "deviation", "deviation_error", "predicted", "predicted_gravity", "predicted_turning",
        "predicted_indentation", "predicted_delay", "limit", "limit_error", "allowance"}) {
    table.columns.push_back({name, name, ""});
  }
  return table;
}

/// How often first impacts are not compared (–), by reason.
void add_swept_reasons(const std::vector<SweptComparison>& swept, Table& table) {
  std::map<std::string, int> counts;
  for (const auto& [value, comparison] : swept) {
    if (!comparison.impacts.empty() && !comparison.impacts[0].reason.empty()) ++counts[comparison.impacts[0].reason];
  }
  for (const auto& [reason, count] : counts) {
    table.notes.push_back(
        fmt::format("–: not compared at this stiffness, {} of {} values: {}", count, swept.size(), reason));
  }
}

}  // namespace

WorstNumber worst_number(const Comparison& comparison, const ComparedImpact& impact) {
  WorstNumber worst;
  double largest = -1, largest_miss = -1;
  for (std::size_t q = 0; q < quantity_count; ++q) {
    const NumberPair pair{impact, q};
    const double scale = comparison.scales[q];
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

Table comparison_table(const Scene& scene, const Comparison& comparison) {
  Table table{.head = head_of(scene), .columns = {}, .rows = {}, .notes = {}};
  table.columns = {{"n", "n", ""},
                   {"end", "end", ""},
                   {"quantity", "", ""},
                   {"discrete", "discrete", ""},
                   {"continuous", "contin.", ""},
                   {"deviation", "deviation", ""},
                   {"predicted", "predicted", ""},
                   {"miss", "limit off", ""},
                   {"allowance", "±", ""}};
  for (const ComparedImpact& impact : comparison.impacts) add_rows(comparison, impact, table);
  table.notes = reasons(comparison);
  table.notes.push_back(
      "t in s, angles in °, P in N·s, V in m/s, Ω in rad/s; predicted: the size, no bound, of what gravity, turning "
      "and "
      "indentation do during contacts, carried on from impact to impact");
  if (!comparison.shortfall.empty()) table.notes.push_back(comparison.shortfall);
  table.notes.push_back(limit_words(comparison));
  table.notes.push_back(verdict_words(comparison));
  fit_columns(table, 6, {3});
  return table;
}

Json comparison_json(const Scene& scene, const Comparison& comparison) {
  Json json = head_json(scene);
  json.update(result_json(comparison));
  return json;
}

Table comparison_records(const Scene& scene, const Comparison& comparison) {
  Table table = records_table(scene);
  add_records(comparison, {}, table);
  if (!comparison.shortfall.empty()) table.notes.push_back(comparison.shortfall);
  table.notes.push_back(verdict_words(comparison));
  return table;
}

Table swept_comparison_table(const Scene& scene, const std::vector<SweptComparison>& swept) {
  Table table{.head = head_of(scene), .columns = {}, .rows = {}, .notes = {}};
  table.columns = {swept_column(*scene.sweep),
                   {"n", "n", ""},
                   {"end", "end", ""},
                   {"deviation", "deviation", "of all"},
                   {"predicted", "predicted", "of all"},
                   {"miss", "limit off", "of all"},
                   {"allowance", "±", "of all"},
                   {"verdict", "", ""}};
  for (const auto& [value, comparison] : swept) {
    for (const ComparedImpact& impact : comparison.impacts) {
      if (!impact.discrete) continue;
      const WorstNumber worst = worst_number(comparison, impact);
      std::vector<Cell> row{impact.n == 1 ? Cell(value, 6) : Cell(), Cell(std::to_string(impact.n)),
                            Cell(impact.discrete_end)};
      if (impact.reason.empty())
        row.insert(row.end(), {difference_cell({worst.deviation, worst.deviation_error}, 1), Cell(worst.predicted, 2)});
      else row.insert(row.end(), {Cell("–"), Cell()});
      if (impact.has_landing()) row.insert(row.end(), {miss_cell({worst.miss, worst.miss_error}), Cell(worst.bar, 2)});
      row.resize(7);
      row.emplace_back(landing_word(impact));
      table.rows.push_back(std::move(row));
    }
  }
  table.notes.push_back(
      "of all: of the largest time, speed or momentum of the sequence; the worst number of each impact");
  const auto agreeing =
      std::count_if(swept.begin(), swept.end(), [](const SweptComparison& one) { return one.comparison.agrees(); });
  table.notes.push_back(fmt::format("{} of {} values agree.", agreeing, swept.size()));
  add_swept_reasons(swept, table);
  add_interruption(*scene.sweep, swept.size(), table);
  return table;
}

Json swept_comparison_json(const Scene& scene, const std::vector<SweptComparison>& swept) {
  Json json = head_json(scene);
  json["runs"] = Json::array();
  for (const auto& [value, comparison] : swept) {
    Json one{{scene.sweep->name(), value}};
    one.update(result_json(comparison));
    json["runs"].push_back(one);
  }
  json["agrees"] =
      std::all_of(swept.begin(), swept.end(), [](const SweptComparison& one) { return one.comparison.agrees(); });
  return json;
}

Table swept_comparison_records(const Scene& scene, const std::vector<SweptComparison>& swept) {
  Table table = records_table(scene);
  table.columns.insert(table.columns.begin(), swept_record_column(*scene.sweep));
  for (const auto& [value, comparison] : swept) add_records(comparison, {Cell(value, 17)}, table);
  return table;
}

}  // namespace clatter::validation
