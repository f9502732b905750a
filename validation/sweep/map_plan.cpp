// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/sweep/map_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "validation/output/bad_input.hpp"
#include "validation/output/number.hpp"
#include "validation/scene/option_values.hpp"

namespace clatter::validation {
namespace {

constexpr int most_pixels_across = 20'000, most_impacts = 1'000'000;
constexpr const char* impacts_key = "run.impacts";

bool names_key(const std::string& setting, const std::string& key) { return setting.starts_with(key + "="); }

/// The sweep's words for what --over gave.
[[noreturn]] void refuse_as_given(const MapRequest& request, const std::string& words) {
  for (const std::string& over : request.over) {
    const std::string key = over.substr(0, over.find('=')), swept = "--set " + key;
    if (words.starts_with(swept)) throw BadInput("--over " + key + words.substr(swept.size()));
  }
  throw BadInput(words);
}

void read_size(const std::string& option, const std::string& text, MapRequest& request) {
  const std::size_t cross = text.find('x');
  const bool is_size = cross != std::string::npos && read_integer(text.substr(0, cross), request.columns) &&
                       read_integer(text.substr(cross + 1), request.rows);
  const auto fits = [](long long side) { return side >= 1 && side <= most_pixels_across; };
  if (!is_size || !fits(request.columns) || !fits(request.rows)) {
    throw BadInput(
        fmt::format("{} '{}': must be WIDTHxHEIGHT in pixels, each from 1 to {}", option, text, most_pixels_across));
  }
}

/// Takes the count of a class of counts, such as 3 or >=3.
void read_count(const std::string& text, const MapRequest& request, MapPlan& plan) {
  long long number = 0;
  if (!read_integer(plan.wanted.substr(plan.wants_at_least() ? 2 : 0), number)) return;
  if (number >= most_impacts)
    throw BadInput(fmt::format("--quantity {}: must be a number less than {}", text, most_impacts));
  plan.wanted_count = static_cast<int>(number);
  for (const std::string& set : request.sets) {
    if (!names_key(set, impacts_key)) continue;
    throw BadInput(
        fmt::format("--set {}: changes nothing with --quantity {}, for which as many impacts are followed "
                    "as tell it",
                    set, text));
  }
}

/// A class that no drop can have is refused, or its probability would be told as 0.
void check_class(const std::string& text, const MapQuantity& quantity, const std::string& wanted) {
  using analytic::BatchEnd;
  const std::string name = quantity.name;
  if (name == "last_end") return;  // bodies name their ends
  std::vector<std::string> words{end_words(BatchEnd::refused), end_words(BatchEnd::outside),
                                 end_words(BatchEnd::not_computed)};
  if (name != "hardest") words.insert(words.begin(), end_words(BatchEnd::infinite));
  if (name == "outcome") {
    words.insert(words.begin(),
                 {end_words(BatchEnd::finished), end_words(BatchEnd::at_limit), end_words(BatchEnd::stays)});
  }
  long long number = 0;
  const bool counts = name != "outcome";
  const std::string_view count = std::string_view(wanted).substr(wanted.starts_with(">=") ? 2 : 0);
  if (counts && read_integer(count, number) && number >= 1) return;
  if (std::find(words.begin(), words.end(), wanted) != words.end()) return;
  throw BadInput(fmt::format("--quantity {}: must be {}{}; did you mean {}?", text, counts ? "a number from 1, " : "",
                             fmt::join(words, ", "), nearest_name(wanted, words)));
}

void read_quantity(const std::string& text, const MapRequest& request, MapPlan& plan) {
  const bool samples = request.samples.has_value();
  const std::size_t equal = text.find('=');
  std::vector<std::string> names;
  for (const MapQuantity& quantity : map_quantities()) names.emplace_back(quantity.name);
  const std::size_t index = read_name_option("--quantity", text.substr(0, equal), names);
  plan.quantity = &map_quantities()[index];
  if (equal != std::string::npos) plan.wanted = text.substr(equal + 1);
  if (samples && (plan.wanted.empty() || !plan.quantity->is_class())) {
    throw BadInput(fmt::format("--quantity {}: must be a class with --samples, such as impacts=2", text));
  }
  if (!samples && equal != std::string::npos) {
    throw BadInput(fmt::format("--quantity {}: a probability needs --samples N", text));
  }
  if (!samples) return;
  check_class(text, *plan.quantity, plan.wanted);
  if (std::string_view(plan.quantity->name) == "impacts") read_count(text, request, plan);
}

/// The hardest impact is one of those that are followed.
void check_hardest(const MapPlan& plan) {
  long long number = 0;
  const bool is_hardest = plan.counts() && std::string_view(plan.quantity->name) == "hardest";
  if (!is_hardest || !read_integer(plan.wanted, number) || number <= plan.request.limit) return;
  throw BadInput(
      fmt::format("--quantity hardest={}: {} impacts are followed, as run.impacts says", number, plan.request.limit));
}

void check_axes(const MapRequest& request, const MapPlan& plan) {
  const std::vector<SweepAxis>& axes = plan.sweep.points.axes();
  for (std::size_t i = 0; i < 2; ++i) {
    if (axes.size() <= i || !names_key(request.over[i], axes[i].key) || axes[i].any_attitude ||
        !(axes[i].first < axes[i].last)) {
      throw BadInput(
          fmt::format("--over {}: must be KEY=LOW:HIGH or KEY=LOW:HIGH:log, LOW less than HIGH", request.over[i]));
    }
  }
  if (axes.size() > 2 && plan.samples == 0) {
    throw BadInput(fmt::format("--set {}: a range is for --samples N", axes[2].key));
  }
  if (plan.samples > most_scenes / (plan.columns * plan.rows)) {
    throw BadInput(fmt::format("--samples {}: more than {} drops in all", plan.samples, most_scenes));
  }
}

bool is_capped(const MapRequest& request) {
  for (const std::string& set : request.sets) {
    if (names_key(set, impacts_key)) return true;
  }
  return !request.file.empty() && scene_values(request.file).has(impacts_key);
}

SweepRequest sweep_request(const MapRequest& request) {
  SweepRequest sweep;
  sweep.file = request.file.empty() ? "map" : request.file;
  sweep.sets = request.over;
  if (request.file.empty()) sweep.text = "";
  sweep.sets.insert(sweep.sets.end(), request.sets.begin(), request.sets.end());
  sweep.random = 1;
  sweep.seed = request.seed;
  sweep.model = Model::discrete;
  return sweep;
}

}  // namespace

const char* end_words(analytic::BatchEnd end) {
  switch (end) {
    case analytic::BatchEnd::finished: return "ends";
    case analytic::BatchEnd::at_limit: return "goes on";
    case analytic::BatchEnd::infinite: return "infinite";
    case analytic::BatchEnd::stays: return "stays";
    case analytic::BatchEnd::refused: return "refused";
    case analytic::BatchEnd::outside: return "outside-model";
    case analytic::BatchEnd::not_computed: break;
  }
  return "not-computed";
}

const std::vector<MapQuantity>& map_quantities() {
  using Outcome = analytic::BatchOutcome;
  static const std::vector<MapQuantity> all{
      {"impacts", "number of impacts", "", nullptr},
      {"last_end", "end that strikes last", "", nullptr},
      {"hardest", "hardest impact", "", nullptr},
      {"outcome", "how the sequence ends", "", nullptr},
      {"ratio", "second normal impulse over the first", "",
       [](const Outcome& outcome) { return outcome.impulse[1] / outcome.impulse[0]; }},
      {"largest", "largest normal impulse", "N·s", [](const Outcome& outcome) { return outcome.largest; }},
      {"total", "sum of the normal impulses", "N·s", [](const Outcome& outcome) { return outcome.total; }},
      {"loss", "energy lost in the impacts", "J", [](const Outcome& outcome) { return outcome.energy_loss; }},
      {"last_start", "time from the first impact to the last", "s",
       [](const Outcome& outcome) { return outcome.last_start; }}};
  return all;
}

std::vector<Column> map_columns() {
  const auto column = [](const char* name, const char* unit, const char* meaning) {
    return Column{.name = name, .heading = name, .unit = unit, .meaning = meaning};
  };
  std::vector<Column> columns;
  for (const MapQuantity& quantity : map_quantities()) {
    columns.push_back(column(quantity.name, quantity.unit, quantity.words));
    columns.back().words = quantity.is_class();
  }
  columns.push_back(column("open", "", "whether rounding or a fold leaves another outcome possible"));
  columns.push_back(column("probability", "1", "part of the samples that are of the class"));
  columns.push_back(column("low", "1", "lower end of Wilson's interval of the probability, 95 %"));
  columns.push_back(column("high", "1", "upper end of Wilson's interval of the probability, 95 %"));
  return columns;
}

double MapPlan::x(long long i) const {
  return across().drawn((static_cast<double>(i) + 0.5) / static_cast<double>(columns));
}

double MapPlan::y(long long j) const {
  return upward().drawn((static_cast<double>(j) + 0.5) / static_cast<double>(rows));
}

Report MapPlan::report() const {
  Report report = sweep.report();
  report.title = headline("map", fmt::format("{} of the discrete model, {}x{} pixels", quantity->words, columns, rows));
  report.remarks.push_back(fmt::format("quantity: {}{}{}", quantity->name, counts() ? "=" : "", wanted));
  report.remarks.push_back(fmt::format("impacts: {}", request.limit));
  if (counts()) report.remarks.push_back(fmt::format("samples: {} for each pixel", samples));
  const Column key{.name = {}, .heading = {}, .unit = {}, .meaning = "middle of the pixel"};
  report.grid.columns = {key, key};
  report.grid.columns[0].name = across().key;
  report.grid.columns[1].name = upward().key;
  for (const Column& column : map_columns()) {
    const bool is_part = column.name == "probability" || column.name == "low" || column.name == "high";
    if (counts() ? is_part : column.name == quantity->name || column.name == "open")
      report.grid.columns.push_back(column);
  }
  return report;
}

Arguments map_arguments(MapRequest& request) {
  std::vector<std::string> names;
  for (const MapQuantity& quantity : map_quantities()) names.emplace_back(quantity.name);
  return {{.name = "--quantity",
           .target = &request.quantity,
           .type = fmt::format("{}", fmt::join(names, "|")),
           .help = "what the colours show (impacts); with --samples NAME=CLASS"},
          {.name = "--size",
           .target = [&request](const auto& name, const auto& text) { read_size(name, text, request); },
           .type = "WIDTHxHEIGHT",
           .help = "pixels of the map (800x600)"},
          whole_argument("--samples", request.samples, 1, 1'000'000, "N",
                         "random drops for each pixel, of which the class's part is shown"),
          whole_argument("--seed", request.seed, 0, std::numeric_limits<int>::max(), "S", "of the random drops (1)")};
}

MapPlan read_map_plan(const MapRequest& request) {
  if (request.over.size() != 2)
    throw BadInput("--over: must be given twice, KEY=LOW:HIGH across and KEY=LOW:HIGH upward");
  MapPlan plan;
  plan.columns = request.columns;
  plan.rows = request.rows;
  plan.samples = request.samples.value_or(0);
  if (request.seed && !request.samples) throw BadInput(fmt::format("--seed {}: is for --samples N", *request.seed));
  read_quantity(request.quantity, request, plan);
  try {
    plan.sweep = read_sweep_plan(sweep_request(request));
  } catch (const BadInput& error) {
    refuse_as_given(request, error.what());
  }
  check_axes(request, plan);
  const SweepPoints& points = plan.sweep.points;
  const int seed = request.seed.value_or(1);
  plan.sweep.points = SweepPoints(points.axes(), std::max(1LL, plan.columns * plan.rows * plan.samples),
                                  static_cast<std::uint64_t>(seed));
  std::erase_if(plan.sweep.words, [](const std::string& words) {  // one random scene, and points that a map ignores
    return words.starts_with("scenes: ") || words.starts_with("probe: ");
  });
  if (plan.counts()) plan.sweep.words.push_back(fmt::format("seed: {}", seed));
  const std::string name = plan.quantity->name;
  plan.request = {.limit = is_capped(request) ? plan.sweep.scene.most_impacts() : uncapped_impacts,
                  .only_counts = !is_capped(request) && (name == "impacts" || name == "outcome")};
  if (plan.wanted_count)
    plan.request = {.limit = *plan.wanted_count + (plan.wants_at_least() ? 0 : 1), .only_counts = true};
  check_hardest(plan);
  return plan;
}

}  // namespace clatter::validation
