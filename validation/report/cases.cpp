// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/report/cases.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ranges>
#include <string_view>
#include <variant>

#include "validation/output/bad_input.hpp"
#include "validation/output/number.hpp"
#include "validation/sweep/points.hpp"

namespace clatter::validation {
namespace {

constexpr std::size_t most_cases = 100;

/// The values of a flag that has several: 0.3:0.7:0.1 or 0.3,0.5, as in a sweep, or names, concrete,wood.  Empty: one.
std::vector<std::string> several_values(const Key& key, const std::string& text) {
  std::vector<std::string> values;
  if (key.value.kind == KeyValue::Kind::name && text.find(',') != std::string::npos) {
    for (const auto part : std::views::split(text, ',')) values.emplace_back(part.begin(), part.end());
  } else if (key.is_number() && text.find_first_of(":,") != std::string::npos) {
    const SweepAxis axis = read_grid_axis(key.flag, text, key.is_whole());
    if (axis.count > static_cast<long long>(most_cases))
      throw BadInput(fmt::format("{} {}: more than {} values", key.flag, text, most_cases));
    for (long long i = 0; i < axis.count; ++i) values.push_back(shortest(axis.at(i)));
  }
  return values;
}

bool is_restitution(const Key& key) { return std::string_view(key.name).ends_with(".restitution"); }
bool is_floor(const Key& key) { return std::string_view(key.name) == "ground.floor"; }

bool differ(const std::vector<const ReportCase*>& cases, auto&& value) {
  return std::ranges::any_of(cases, [&](const ReportCase* one) { return value(*one) != value(*cases.front()); });
}

std::vector<Column> columns_of_case() {
  return {word_column("floor", "scene", "file whose drop it is, or its floor"),
          {"restitution", "e", "", "that was given, of the ground or, without one, of impacts"},
          word_column("given", "with", "its values of other flags that have several"),
          word_column("part", "part", "what bears it, as --part takes it")};
}

/// What tells a case from others, in these columns.
Row cells_of_case(const ReportCase& one) {
  const auto part = one.input.part();
  const auto e = one.given_restitution();
  const std::string words = one.varied_words();
  return {Cell(one.floor()), e ? Cell(*e, shortest(*e)) : Cell(), words.empty() ? Cell() : Cell(words),
          part ? Cell(part_text(*part)) : Cell()};
}

void show_columns_of_case(const std::vector<const ReportCase*>& cases, Grid& grid) {
  for (Column& column : grid.columns) {
    if (column.name == "floor") column.shown = differ(cases, [](const ReportCase& one) { return one.floor(); });
    if (column.name == "restitution")
      column.shown = differ(cases, [](const ReportCase& one) { return one.given_restitution(); });
    if (column.name == "given") column.shown = differ(cases, [](const ReportCase& one) { return one.varied_words(); });
    if (column.name == "part")
      column.shown =
          differ(cases, [](const ReportCase& one) { return one.input.part() ? part_text(*one.input.part()) : ""; });
  }
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
  std::vector<const Key*> varied;
  for (const SceneOverride& flag : overrides_of(given.scene)) {
    const Key& key = key_named(flag.key);
    const std::vector<std::string> values = several_values(key, flag.text);
    if (values.empty()) continue;
    varied.push_back(&key);
    multiply(values.size(), [&](std::size_t i, ReportInput& input) { input.scene.texts[key.flag] = values[i]; });
  }
  std::vector<ReportInput> of_parts;
  for (const ReportInput& input : inputs) {
    const std::vector<FragilePart> parts = parts_of(input.parts, probes_of(input));
    if (parts.empty()) of_parts.push_back(input);
    for (const FragilePart& part : parts) of_parts.emplace_back(input).parts = {part};
  }
  if (of_parts.size() > most_cases)
    throw BadInput(fmt::format("{} cases of scenes, values and parts: more than {}", of_parts.size(), most_cases));
  const bool names_floor =
      given.scenes.size() > 1 || std::ranges::any_of(varied, [](const Key* key) { return is_floor(*key); });
  std::vector<ReportCase> cases;
  for (ReportInput& input : of_parts) {
    const bool is_turned = gives_attitude(input);
    if (!is_turned && looks_at_all(input)) input.scene.texts["--orientation"] = "1";  // some one: the sweep has its own
    const Scene scene = shock_scene(input);
    require_worst_attitudes(input, scene);
    if (!input.parts.empty() && probes_of(input).empty())
      throw BadInput("--part: needs --probe NAME:X,Y,Z, or [[probe]], where the part is");
    ReportCase& one = cases.emplace_back(ReportCase{input, {}, view_of(input), is_turned, scene, names_floor});
    for (const Key* key : varied) one.varied.emplace_back(key, input.scene.texts.at(key->flag));
  }
  return cases;
}

std::string ReportCase::floor() const {
  const std::string& source = input.scene.source;
  std::string words = source.substr(0, source.size() - (source.ends_with(".toml") ? 5 : 0));
  for (const auto& [key, value] : varied) {
    if (is_floor(*key)) words += (words.empty() ? "" : ", ") + value;
  }
  return words.empty() ? "the drop" : words;
}

std::string ReportCase::varied_words() const {
  std::string words;
  for (const auto& [key, value] : varied) {
    if (is_restitution(*key) || is_floor(*key)) continue;
    std::string name = key->argument();
    std::ranges::replace(name, '_', ' ');
    words += fmt::format("{}{} {}", words.empty() ? "" : ", ", name, value);
  }
  return words;
}

std::string ReportCase::name(const std::string& of_part, const char* between) const {
  std::string words = names_floor ? floor() : "";
  const auto add = [&](const std::string& more) { words += (words.empty() || more.empty() ? "" : ", ") + more; };
  for (const auto& [key, value] : varied) {
    if (is_restitution(*key)) add("e = " + value);
  }
  add(varied_words());
  return words + (words.empty() || of_part.empty() ? "" : between) + of_part;
}

std::string ReportCase::name() const { return name(input.part() ? part_text(*input.part()) : "", ", "); }

std::string ReportCase::heading() const {
  const auto part = input.part();
  if (!part) return name();
  std::string words = name(words_of(*part), ": ");
  const std::optional<Blow>& blow = found.answer.blow;
  if (blow && blow->margin) words += fmt::format(" {}", blow->margin->verdict());
  if (words.starts_with("a part")) words.front() = 'A';
  return words;
}

std::optional<double> ReportCase::given_restitution() const {
  return model_of(input) == Model::continuous ? given.ground_restitution : given.impact.restitution;
}

Grid cases_grid(const std::vector<const ReportCase*>& cases) {
  Grid grid{case_columns(), {}, 3};
  show_columns_of_case(cases, grid);
  for (const ReportCase* one : cases) {
    const Value& answer = *one->found.report.fields.find("answer");
    const auto of = [&](const char* name, double unit = 1) {
      const Value* const value = answer.find(name);
      const double* const number = value ? value->number() : nullptr;
      return !value ? Cell() : number ? Cell(unit * *number, 3) : Cell(*value);
    };
    const auto& pad = one->found.scene.pad.thickness;
    Row row = cells_of_case(*one);
    for (const char* name : {"verdict", "margin", "attitude", "probe", "impact", "peak_g", "delta_v"})
      row.push_back(of(name));
    row.push_back(of("pulse_duration", 1e3));
    row.push_back(of("depth", 1e3));
    row.push_back(pad ? of("depth", 100 / *pad) : Cell());
    const auto& blow = one->found.answer.blow;
    row.push_back(blow && blow->margin ? deciding_cell(blow->margin->by) : Cell());
    row.push_back(of("failing"));
    row.push_back(of("drops"));
    grid.rows.push_back(std::move(row));
  }
  const auto any = [&](auto&& holds) {
    return std::ranges::any_of(cases, [&](const ReportCase* one) { return holds(*one); });
  };
  const bool has_part = any([](const ReportCase& one) { return one.input.part().has_value(); });
  for (Column& column : grid.columns) {
    if (column.name == "part") column.shown = has_part;
    if (column.name == "verdict" || column.name == "margin" || column.name == "decided_by" || column.name == "failing")
      column.shown = has_part;
    if (column.name == pulse_column().name)
      column.shown = any([](const ReportCase& one) { return one.found.ranking.has_peaks; });
    if (column.name == "probe")
      column.shown = any([](const ReportCase& one) { return one.found.run.probes.size() > 1; });
    if (column.name == "depth_mm")
      column.shown = any(
          [](const ReportCase& one) { return one.found.scene.world.ground.is_pad() || one.found.scene.pad.thickness; });
    if (column.name == "depth_percent")
      column.shown = any([](const ReportCase& one) { return one.found.scene.pad.thickness.has_value(); });
  }
  return grid;
}

std::vector<const ReportCase*> ranked(const std::vector<ReportCase>& cases) {
  std::vector<const ReportCase*> order;
  for (const ReportCase& one : cases) order.push_back(&one);
  std::ranges::stable_sort(order, [](const ReportCase* one, const ReportCase* other) {
    const Ranking &mine = one->found.ranking, &theirs = other->found.ranking;
    if (mine.by != theirs.by) return mine.by < theirs.by;
    const bool is_known = std::isfinite(one->value());
    return is_known && std::isfinite(other->value()) ? mine.is_worse(one->value(), other->value())
                                                     : is_known && !std::isfinite(other->value());
  });
  return order;
}

std::vector<const ReportCase*> worst_cases(const std::vector<const ReportCase*>& order) {
  std::vector<const ReportCase*> worst;
  const auto part = [](const ReportCase* one) { return one->input.part() ? part_text(*one->input.part()) : ""; };
  for (const ReportCase* one : order) {
    const bool is_known_floor =
        std::ranges::any_of(worst, [&](const ReportCase* other) { return other->floor() == one->floor(); });
    const bool is_known_part =
        std::ranges::any_of(worst, [&](const ReportCase* other) { return part(other) == part(one); });
    if (!is_known_floor || !is_known_part) worst.push_back(one);
  }
  return worst;
}

Report joined_report(const std::vector<const ReportCase*>& order) {
  const Findings& worst = order.front()->found;
  const Grid cases = cases_grid(order);
  Report report = worst.report;
  report.grid = cases;
  report.head.insert(report.head.begin(), "The worst case:");
  std::string words;
  for (const ReportCase* one : worst_cases(order)) {
    const std::optional<Blow>& blow = one->found.answer.blow;
    words += (words.empty() ? "" : "; ") + one->name();
    if (blow && blow->margin)
      words += fmt::format(" {}, {} margin {}", blow->margin->verdict(),
                           one->found.ranking.by == Ranking::By::margin ? "least" : "with", said(blow->margin->value));
    else words += ": " + (blow ? one->found.lead : one->found.answer.words);
  }
  if (const ReportCase& last = *order.back(); last.found.ranking.by == Ranking::By::margin &&
                                              std::isfinite(last.value()) &&
                                              said(last.value()) != said(order.front()->value()))
    words += fmt::format("; from case to case the least margin goes from {} to {} ({})", said(order.front()->value()),
                         said(last.value()), last.name());
  report.notes = {fmt::format("Worst of {} cases: {}", order.size(), words), worst.lead};
  if (const std::string fixed = fixed_words(order); !fixed.empty()) report.notes.push_back(fixed);
  report.fields["message"] = report.notes.front();
  report.fields["cases"] = row_objects(cases);
  return report;
}

std::string fixed_words(const std::vector<const ReportCase*>& cases) {
  const auto is_of_springs = [](const ReportCase* one) {
    const numeric::Ground& ground = one->given.world.ground;
    return std::ranges::any_of(one->varied, [](const auto& of) { return is_restitution(*of.first); }) &&
           one->given.ground_restitution && !ground.is_half_space() && !ground.is_pad();
  };
  if (std::ranges::none_of(cases, is_of_springs)) return "";
  return "k_G is the same at each e: where it was found from a contact time, that time is kept only at the e that was "
         "measured with it (clatter shock --ground --measured-e E gives k_G at another)";
}

std::vector<Column> case_attitude_columns() { return with_more(columns_of_case(), attitude_columns()); }

Grid attitudes_of_cases(const std::vector<const ReportCase*>& cases) {
  Grid grid{case_attitude_columns(), {}, columns_of_case().size() + 1};
  show_columns_of_case(cases, grid);
  const std::size_t first = columns_of_case().size();
  for (std::size_t i = first; i < grid.columns.size(); ++i) grid.columns[i].shown = false;
  for (const ReportCase* one : cases) {
    if (!one->found.all)
      throw BadInput("--rows attitude: is for a box, whose worst attitudes are looked for, and not with --drops 0");
    const Grid own = attitudes_grid(*one->found.all);
    for (std::size_t i = 0; i < own.columns.size(); ++i) {
      if (own.columns[i].shown) grid.columns[first + i] = own.columns[i];
    }
    for (const Row& attitude : own.rows) {
      Row row = cells_of_case(*one);
      row.insert(row.end(), attitude.begin(), attitude.end());
      grid.rows.push_back(std::move(row));
    }
  }
  return grid;
}

std::vector<Column> case_columns() {
  return with_more(
      columns_of_case(),
      {word_column("verdict", "verdict", "whether the part survives all drops, or fails in one: by the margin"),
       {"margin", "margin", "", "the least of all drops: at 1 and below the part fails"},
       word_column("attitude", "down", "how the body is turned in that drop"),
       word_column("probe", "at", "name of the point"),
       {"impact", "impact", "", "whose blow has it"},
       {"peak_g", "peak", "g", "largest specific force at the probe in that blow"},
       {"delta_v", "|ΔV|", "m/s", "change of the probe's velocity in it"},
       pulse_column(),
       {"depth_mm", "depth", "mm", "of the body's deepest point in it"},
       {"depth_percent", "of pad", "%", "the same in parts of the pad's thickness"},
       word_column("decided_by", "by",
                   "what decides the margin: change of velocity, peak, or the humps of its history"),
       {"failing", "failing", "", "drops that the part does not survive"},
       {"drops", "drops", "", "of the case"}});
}

}  // namespace clatter::validation
