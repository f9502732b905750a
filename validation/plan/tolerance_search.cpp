// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/plan/tolerance_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "validation/plan/cost_table.hpp"

namespace clatter::validation {
namespace {

using numeric::Method;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr Method methods[] = {Method::rkck, Method::rk8pd};
constexpr double guess_margin = 3;     // the table's medians are off by this on many scenes
constexpr double worth_trying = 2;     // a method predicted to cost this much more than the other is left
constexpr double decades_apart = 1.5;  // of tolerance, to see how an error falls with it
constexpr int finer_steps = 4;         // the reference is two decades of tolerance finer

std::size_t index_of(Method method) { return method == Method::rkck ? 0 : 1; }

}  // namespace

double half_decade(int index) { return std::max(1e-4 * std::pow(10.0, -0.5 * index), numeric::least_tolerance); }

PredictedSetting predicted_setting(Method method, double error_constant, double asked) {
  const CostTable& table = CostTable::measured();
  int index = 0;
  const auto error = [&](int i) { return error_constant * half_decade(i) * table.error(method, half_decade(i)); };
  while (index < tolerance_steps - 1 && !(guess_margin * error(index) <= asked)) ++index;
  return {method, index, table.evaluations(method, half_decade(index))};
}

PredictedSetting cheapest_by_table(double error_constant, double asked) {
  const PredictedSetting low = predicted_setting(methods[0], error_constant, asked);
  const PredictedSetting high = predicted_setting(methods[1], error_constant, asked);
  return high.evaluations < low.evaluations ? high : low;
}

ToleranceSearch::ToleranceSearch(const ModelHierarchy& hierarchy, ModelLevel level, int impacts,
                                 const MotionNumbers& sizes, double error_constant, double pilot_evaluations)
    : hierarchy_(hierarchy), level_(level), impacts_(impacts), sizes_(sizes), error_constant_(error_constant),
      pilot_evaluations_(pilot_evaluations) {}

/// The finer run; at least as fine as any trial.
void ToleranceSearch::find_reference(double asked, int index) {
  const int finest = tolerance_steps - 1;
  const PredictedSetting start = predicted_setting(Method::rk8pd, error_constant_, asked / 100);
  const LevelSetting setting{.level = level_,
                             .method = Method::rk8pd,
                             .tolerance = half_decade(std::min(finest, std::max(start.index, index + finer_steps)))};
  const LevelResult result = hierarchy_.run(setting, impacts_);
  spent_ += result.evaluations;
  reference_ = result.rows;
  reference_errors_.assign(reference_.size(), 0);
  if (setting.tolerance > half_decade(finest)) return;
  // There is none two decades finer than the finest trial, so the reference's own error counts too.
  LevelSetting coarser = setting;
  coarser.tolerance *= std::pow(10.0, decades_apart);
  const LevelResult other = hierarchy_.run(coarser, impacts_);
  spent_ += other.evaluations;
  for (std::size_t i = 0; i < reference_.size(); ++i) {
    const bool is_there = i < other.rows.size();
    const double apart = is_there ? row_distance(other.rows[i], reference_[i], sizes_) : infinity;
    reference_errors_[i] = guess_margin * apart / std::pow(10.0, decades_apart);
  }
}

ToleranceSearch::Trial& ToleranceSearch::trial(Method method, int index) {
  Trial& trial = trials_[index_of(method)][index];
  if (trial.known) return trial;
  trial.result = hierarchy_.run({.level = level_, .method = method, .tolerance = half_decade(index)}, impacts_);
  const std::vector<MotionNumbers>& rows = trial.result.rows;
  trial.error = reference_.size() < static_cast<std::size_t>(impacts_) ? infinity : 0;  // the reference ended early
  for (std::size_t i = 0; i < reference_.size(); ++i) {
    const double apart = i < rows.size() ? row_distance(rows[i], reference_[i], sizes_) : infinity;
    trial.errors.push_back(apart + reference_errors_[i]);
    trial.error = std::max(trial.error, trial.errors.back());
  }
  trial.known = true;
  spent_ += trial.result.evaluations;
  return trial;
}

void ToleranceSearch::take(Method method, int index, double asked, FoundSetting& best) {
  const Trial& found = trial(method, index);
  const bool serves = found.error <= asked;
  const bool better = serves ? !best.serves || found.result.evaluations < best.evaluations
                             : !best.serves && (best.evaluations == 0 || found.error < best.error);
  if (!better) return;
  best.setting = {.level = level_, .method = method, .tolerance = half_decade(index)};
  best.error = found.error;
  best.evaluations = found.result.evaluations;
  best.serves = serves;
  best.errors = found.errors;
}

/// From the predicted tolerance to tighter ones until it serves, or to looser ones as long as it does.
void ToleranceSearch::descend(const PredictedSetting& start, double asked, FoundSetting& best) {
  int index = start.index;
  while (!(trial(start.method, index).error <= asked) && index < tolerance_steps - 2) ++index;
  take(start.method, index, asked, best);
  while (index > 0 && trial(start.method, index - 1).error <= asked) take(start.method, --index, asked, best);
}

FoundSetting ToleranceSearch::cheapest(double asked) {
  PredictedSetting starts[] = {predicted_setting(methods[0], error_constant_, asked),
                               predicted_setting(methods[1], error_constant_, asked)};
  find_reference(asked, std::max(starts[0].index, starts[1].index));
  if (starts[1].evaluations < starts[0].evaluations) std::swap(starts[0], starts[1]);
  FoundSetting best;
  descend(starts[0], asked, best);
  if (!best.serves ||
      pilot_evaluations_ * starts[1].evaluations <= worth_trying * static_cast<double>(best.evaluations)) {
    descend(starts[1], asked, best);
  }
  best.reference = reference_;
  return best;
}

}  // namespace clatter::validation
