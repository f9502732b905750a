// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/sweep/map_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <memory>

#include "validation/output/bad_input.hpp"
#include "validation/output/number.hpp"
#include "validation/scene/failure.hpp"
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
  if (name == "last_end" || name == "rest_face") return;  // bodies name their ends and faces
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
  throw BadInput(fmt::format("--quantity {}: must be {}{}{}", text, counts ? "a number from 1, " : "",
                             fmt::join(words, ", "), suggestion(wanted, words, true)));
}

void read_quantity(const std::string& text, const MapRequest& request, MapPlan& plan) {
  const bool samples = request.samples.has_value();
  const std::size_t equal = text.find('=');
  std::vector<std::string> names;
  for (const MapQuantity& quantity : map_quantities()) names.emplace_back(quantity.name);
  const std::size_t index = read_name_option("--quantity", text.substr(0, equal), names);
  plan.quantity = &map_quantities()[index];
  if (equal != std::string::npos) plan.wanted = text.substr(equal + 1);
  if (samples && (plan.wanted.empty() || !plan.quantity->is_class()))
    throw BadInput(fmt::format("--quantity {}: must be a class with --samples, such as impacts=2", text));
  if (!samples && equal != std::string::npos)
    throw BadInput(fmt::format("--quantity {}: a probability needs --samples N", text));
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
  if (axes.size() > 2 && plan.samples == 0)
    throw BadInput(fmt::format("--set {}: a range is for --samples N", axes[2].key));
  if (plan.samples > most_scenes / (plan.columns * plan.rows))
    throw BadInput(fmt::format("--samples {}: more than {} drops in all", plan.samples, most_scenes));
}

bool is_capped(const MapRequest& request) {
  for (const std::string& set : request.sets) {
    if (names_key(set, impacts_key)) return true;
  }
  return !request.file.empty() && scene_values(request.file).has(impacts_key);
}

SweepRequest sweep_request(const MapRequest& request) {
  SweepRequest sweep;
  sweep.file = request.file;
  sweep.sets = request.over;
  sweep.sets.insert(sweep.sets.end(), request.sets.begin(), request.sets.end());
  sweep.random = 1;
  sweep.seed = request.seed;
  sweep.model = Model::discrete;
  sweep.takes_other_model = false;
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
      {"rest_face", "face on which it comes to lie", "", nullptr},
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
  return {
      {.name = "--quantity",
       .target = &request.quantity,
       .type = "NAME",
       .help = fmt::format(
           "what the colours show, one of {} (impacts); ratio is of the second impulse to the first; with --samples "
           "NAME=CLASS",
           fmt::join(names, ", "))},
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
  if (plan.quantity->tells_rest()) plan.sweep.scene.until_rest = true;
  const bool is_asked = is_capped(request) || plan.quantity->tells_rest();
  const int enough = name == "ratio" ? 2 : uncapped_impacts;  // later ones would leave pixels open in vain
  plan.request = {.limit = is_asked ? plan.sweep.scene.most_impacts() : enough,
                  .only_counts = !is_capped(request) && (name == "impacts" || name == "outcome")};
  if (plan.wanted_count)
    plan.request = {.limit = *plan.wanted_count + (plan.wants_at_least() ? 0 : 1), .only_counts = true};
  if (!plan.sweep.scene.until_rest) plan.sweep.scene.request.impacts = plan.request.limit;  // as its head says
  check_hardest(plan);
  return plan;
}

namespace {

using analytic::BatchEnd;
using analytic::BatchOutcome;

/// What a pixel's drop did, by the batch or by a run.
struct PixelOutcome {
  BatchOutcome numbers;
  std::string last_end, rest_face;
};

bool is_failure(BatchEnd end) {
  return end == BatchEnd::refused || end == BatchEnd::outside || end == BatchEnd::not_computed;
}

std::string count_words(const BatchOutcome& outcome) {
  if (outcome.end == BatchEnd::infinite) return "infinite";
  return fmt::format("{}{}", outcome.end == BatchEnd::at_limit ? ">=" : "", outcome.impacts);
}

std::string class_of(const MapQuantity& quantity, const PixelOutcome& outcome) {
  const BatchOutcome& numbers = outcome.numbers;
  const std::string name = quantity.name;
  if (is_failure(numbers.end) || name == "outcome") return end_words(numbers.end);
  if (name == "impacts") return count_words(numbers);
  if (name == "hardest") return fmt::format("{}", numbers.hardest);
  if (name == "rest_face") return outcome.rest_face.empty() ? "none" : outcome.rest_face;
  return outcome.last_end;
}

/// Whether a drop is of the class whose probability is asked for.
bool is_wanted(const MapPlan& plan, const PixelOutcome& outcome) {
  const BatchOutcome& numbers = outcome.numbers;
  if (!plan.wanted_count) return class_of(*plan.quantity, outcome) == plan.wanted;
  if (is_failure(numbers.end)) return false;
  if (plan.wants_at_least()) return numbers.end == BatchEnd::infinite || numbers.impacts >= *plan.wanted_count;
  return numbers.end != BatchEnd::infinite && numbers.impacts == *plan.wanted_count;
}

std::string text_of(const MapPlan& plan, const PixelOutcome& outcome) {
  if (plan.quantity->is_class()) return class_of(*plan.quantity, outcome);
  if (is_failure(outcome.numbers.end)) return "";
  const double number = plan.quantity->number(outcome.numbers);
  return std::isfinite(number) ? shortest(number) : "";
}

BatchEnd end_of_failure(FailureKind kind) {
  if (kind == FailureKind::bad_input) return BatchEnd::refused;
  return kind == FailureKind::outside_model ? BatchEnd::outside : BatchEnd::not_computed;
}

/// The drops of a row of the map; a thread has one.
class MapRunner {
 public:
  MapRunner(const MapPlan& plan, const SweepBody& body, MapForm form, std::function<bool()> stop)
      : plan_(plan), form_(form), stop_(std::move(stop)), scene_(plan.sweep.scene), body_(plan.sweep, body),
        pixels_(static_cast<std::size_t>(plan.columns)) {}

  RangeRows operator()(const SceneRange& range) {
    RangeRows rows;
    for (; rows.scenes < range.count && !stop_(); ++rows.scenes) {
      const long long j = range.first + rows.scenes;
      if (plan_.counts() ? !count_row(j) : !compute_row(j)) break;
      write_row(j, rows.text);
    }
    return rows;
  }

 private:
  /// The drop of the values, or the outcome that it has without one.
  std::optional<DiscreteDrop> drop_of(BatchOutcome& without) {
    std::optional<DiscreteDrop> drop;
    const std::optional<Failure> failure = failure_of_scene([&] {
      plan_.sweep.put_point(values_, scene_);
      if (body_.renew(scene_, values_)) ++bodies_;
      drop = body_->discrete->drop(scene_);
    });
    if (failure) without = {.end = end_of_failure(failure->kind)};
    return drop;
  }

  /// Takes a drop into the batch if it is one for it: frictionless or with an impulse ratio, and a constant e.
  bool join_batch(const DiscreteDrop& drop) {
    const auto* planar = std::get_if<analytic::Drop>(&drop);
    if (!planar || plan_.quantity->tells_rest() || planar->law.law == analytic::RestitutionLaw::viscoelastic ||
        planar->gravity_along != 0)
      return false;
    const bool no_slip = planar->law.friction_value == 0;
    const bool by_ratio = planar->law.friction == analytic::FrictionKind::impulse_ratio &&
                          planar->law.law == analytic::RestitutionLaw::newton;
    if (!no_slip && !by_ratio) return false;
    if (batch_bodies_ != bodies_) flush();
    if (batched_.empty()) {
      batch_.body = planar->body;
      batch_bodies_ = bodies_;
    }
    const double numbers[] = {planar->inclination.radians, planar->velocity.normal, planar->velocity.tangential,
                              planar->velocity.angular,    planar->gravity,         planar->law.restitution,
                              planar->law.friction_value};
    for (std::size_t k = 0; k < columns_.size(); ++k) columns_[k].push_back(numbers[k]);
    return true;
  }

  void flush() {
    if (batched_.empty()) return;
    batch_.inclination = columns_[0];
    batch_.normal = columns_[1];
    batch_.tangential = columns_[2];
    batch_.angular = columns_[3];
    batch_.gravity = columns_[4];
    batch_.restitution = columns_[5];
    batch_.impulse_ratio = columns_[6];
    outcomes_.resize(batched_.size());
    analytic::run_batch(batch_, plan_.request, 0, outcomes_);
    for (std::size_t k = 0; k < batched_.size(); ++k) {
      PixelOutcome outcome{outcomes_[k], {}, {}};
      if (needs_end_) outcome.last_end = analytic::PlanarBody::vertex_set_name(outcomes_[k].last_vertices);
      take(batched_[k], outcome);
    }
    batched_.clear();
    for (std::vector<double>& column : columns_) column.clear();
  }

  PixelOutcome run_alone(const DiscreteDrop& drop) {
    PixelOutcome outcome;
    const std::optional<Failure> failure =
        failure_of_scene([&] { outcome = std::visit([this](const auto& one) { return outcome_alone(one); }, drop); });
    return failure ? PixelOutcome{{.end = end_of_failure(failure->kind)}, {}, {}} : outcome;
  }

  template <class AnyDrop>
  PixelOutcome outcome_alone(const AnyDrop& drop) {
    const auto sequence = impact_sequence(
        drop,
        {.impacts = plan_.request.limit, .until_rest = scene_.until_rest, .until_face = plan_.quantity->tells_rest()});
    const Run run = named_run(scene_, sequence, body_->discrete->centre());
    const Impact& last = run.impacts.back();
    PixelOutcome outcome{{.impacts = static_cast<int>(run.impacts.size()),
                          .end = analytic::batch_end(sequence.outcome, sequence.tail.has_value()),
                          .is_scalar = true,
                          .total = sequence.total_normal_impulse,
                          .last_start = last.value.start},
                         last.corners.empty() ? last.end : last.corners,
                         {}};
    BatchOutcome& numbers = outcome.numbers;
    numbers.is_open = !sequence.end_predictable;
    numbers.impulse.fill(std::numeric_limits<double>::quiet_NaN());
    for (const Impact& impact : run.impacts) {
      const double normal = impact.value.impulse[2];
      numbers.energy_loss += impact.value.energy_loss;
      if (impact.n <= 3) numbers.impulse[static_cast<std::size_t>(impact.n - 1)] = normal;
      if (!(normal > numbers.largest)) continue;
      numbers.largest = normal;
      numbers.hardest = impact.n;
    }
    if (!plan_.quantity->tells_rest()) return outcome;
    const std::optional<RestFace> rest = rest_face(scene_, drop, sequence);
    if (rest) outcome.rest_face = rest->face;
    numbers.is_open = !rest || !rest->is_known;
    return outcome;
  }

  /// Computes the drop of the values for a pixel, at once or with the batch.
  void add(std::size_t pixel) {
    BatchOutcome without;
    const std::optional<DiscreteDrop> drop = drop_of(without);
    if (!drop) return take(pixel, {without, {}, {}});
    if (join_batch(*drop)) batched_.push_back(pixel);
    else take(pixel, run_alone(*drop));
  }

  void take(std::size_t pixel, const PixelOutcome& outcome) {
    if (plan_.counts()) {
      hits_[pixel] += is_wanted(plan_, outcome) ? 1 : 0;
      return;
    }
    pixels_[pixel] = {text_of(plan_, outcome), outcome.numbers.is_open};
  }

  /// False if it was stopped.
  bool compute_row(long long j) {
    values_.assign(2, plan_.y(j));
    for (std::size_t i = 0; i < pixels_.size(); ++i) {
      if (i % 64 == 0 && stop_()) return false;
      values_[0] = plan_.x(static_cast<long long>(i));
      add(i);
    }
    flush();
    return true;
  }

  bool count_row(long long j) {
    hits_.assign(pixels_.size(), 0);
    for (std::size_t i = 0; i < pixels_.size(); ++i) {
      if (stop_()) return false;
      for (long long k = 0; k < plan_.samples; ++k) {
        plan_.sweep.points.at((j * plan_.columns + static_cast<long long>(i)) * plan_.samples + k, values_);
        values_[0] = plan_.x(static_cast<long long>(i));
        values_[1] = plan_.y(j);
        add(i);
      }
    }
    flush();
    for (std::size_t i = 0; i < pixels_.size(); ++i) pixels_[i] = {fmt::format("{}", hits_[i]), false};
    return true;
  }

  void write_row(long long j, std::string& text) const {
    const auto out = std::back_inserter(text);
    for (std::size_t i = 0; i < pixels_.size(); ++i) {
      const MapPixel& pixel = pixels_[i];
      if (form_ == MapForm::compact) {
        fmt::format_to(out, "{}{}{}", i == 0 ? "" : ",", pixel.value, pixel.is_open ? "*" : "");
        continue;
      }
      fmt::format_to(out, "{},{},", shortest(plan_.x(static_cast<long long>(i))), shortest(plan_.y(j)));
      if (plan_.counts()) {
        const Wilson wilson(hits_[i], plan_.samples);
        fmt::format_to(out, "{},{},{}\n", shortest(wilson.part), shortest(wilson.low), shortest(wilson.high));
      } else {
        fmt::format_to(out, "{},{}\n", csv_text(pixel.value), pixel.is_open);
      }
    }
    if (form_ == MapForm::compact) text += '\n';
  }

  const MapPlan& plan_;
  MapForm form_;
  std::function<bool()> stop_;
  Scene scene_;
  SweptBody body_;
  std::vector<MapPixel> pixels_;
  std::vector<long long> hits_;
  std::vector<double> values_;
  analytic::BatchDrops batch_;
  std::array<std::vector<double>, 7> columns_;
  std::vector<std::size_t> batched_;  ///< pixels of the batch's drops
  std::vector<BatchOutcome> outcomes_;
  long bodies_ = 0, batch_bodies_ = 0;
  bool needs_end_ = std::string(plan_.quantity->name) == "last_end";
};

}  // namespace

MakeCompute map_runners(const MapPlan& plan, const SweepBody& body, MapForm form) {
  return [&plan, &body, form](std::function<bool()> stop) -> ComputeRange {
    const auto runner = std::make_shared<MapRunner>(plan, body, form, std::move(stop));
    return [runner](const SceneRange& range) { return (*runner)(range); };
  };
}

long long map_range(const MapPlan& plan) { return std::max(1LL, 4096 / (plan.columns * std::max(1LL, plan.samples))); }

std::vector<MapPixel> read_map_row(const std::string& line) {
  std::vector<MapPixel> pixels;
  for (std::size_t begin = 0; begin <= line.size();) {
    const std::size_t end = std::min(line.find_first_of(",\n", begin), line.size());
    const bool is_open = end > begin && line[end - 1] == '*';
    pixels.push_back({line.substr(begin, end - begin - (is_open ? 1 : 0)), is_open});
    if (end >= line.size() || line[end] == '\n') break;
    begin = end + 1;
  }
  return pixels;
}

}  // namespace clatter::validation
