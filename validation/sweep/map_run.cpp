// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/sweep/map_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <memory>

#include "analytic/batch/batch.hpp"
#include "validation/output/number.hpp"
#include "validation/scene/failure.hpp"

namespace clatter::validation {
namespace {

using analytic::BatchEnd;
using analytic::BatchOutcome;

/// What a pixel's drop did, by the batch or by a run.
struct PixelOutcome {
  BatchOutcome numbers;
  std::string last_end;
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
    if (!planar || planar->law.law == analytic::RestitutionLaw::viscoelastic || planar->gravity_along != 0)
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
      PixelOutcome outcome{outcomes_[k], {}};
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
    return failure ? PixelOutcome{{.end = end_of_failure(failure->kind)}, {}} : outcome;
  }

  template <class AnyDrop>
  PixelOutcome outcome_alone(const AnyDrop& drop) {
    const auto sequence = impact_sequence(drop, {.impacts = plan_.request.limit});
    const Run run = named_run(scene_, sequence, body_->discrete->centre());
    const Impact& last = run.impacts.back();
    PixelOutcome outcome{{.impacts = static_cast<int>(run.impacts.size()),
                          .end = analytic::batch_end(sequence.outcome, sequence.tail.has_value()),
                          .is_scalar = true,
                          .total = sequence.total_normal_impulse,
                          .last_start = last.value.start},
                         last.corners.empty() ? last.end : last.corners};
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
    return outcome;
  }

  /// Computes the drop of the values for a pixel, at once or with the batch.
  void add(std::size_t pixel) {
    BatchOutcome without;
    const std::optional<DiscreteDrop> drop = drop_of(without);
    if (!drop) return take(pixel, {without, {}});
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

Wilson::Wilson(long long hits, long long samples) {
  constexpr double z = 1.959963984540054;
  const double n = static_cast<double>(samples);
  part = static_cast<double>(hits) / n;
  const double middle = part + z * z / (2 * n), spread = z * std::sqrt(part * (1 - part) / n + z * z / (4 * n * n));
  low = hits == 0 ? 0 : (middle - spread) / (1 + z * z / n);
  high = hits == samples ? 1 : (middle + spread) / (1 + z * z / n);
}

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
