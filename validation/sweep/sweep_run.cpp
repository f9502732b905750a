// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/sweep/sweep_run.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <new>
#include <thread>
#include <vector>

#include "validation/plan/planned_run.hpp"
#include "validation/scene/failure.hpp"
#include "validation/scene/shortfall.hpp"

namespace clatter::validation::inline sweep {
namespace {

constexpr std::size_t most_waiting_bytes = 64 << 20;
constexpr std::chrono::milliseconds between_ticks{100};

/// The threads that compute, around one queue.
class Crew {
 public:
  Crew(RangeQueue& queue, const SweepHooks& hooks) : queue_(queue), hooks_(hooks) {}
  ~Crew() { dismiss(); }
  Crew(const Crew&) = delete;
  Crew& operator=(const Crew&) = delete;

  void start(int threads, const MakeCompute& make) {
    working_ = threads;
    for (int i = 0; i < threads; ++i) threads_.emplace_back([this, &make] { work(make); });
  }

  /// Writes rows as they come, until nobody works any more.
  void write() {
    std::unique_lock lock(mutex_);
    for (;;) {
      came_.wait_for(lock, between_ticks, [this] { return queue_.has_next() || working_ == 0; });
      const std::optional<RangeRows> rows = queue_.take();
      if (!rows && working_ == 0) break;
      lock.unlock();
      room_.notify_all();
      if (rows) hooks_.write(*rows);
      hooks_.tick();
      lock.lock();
    }
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  [[nodiscard]] bool stops() const { return dismissed_ || hooks_.stop(); }

  void work(const MakeCompute& make) {
    try {
      const ComputeRange compute = make([this] { return stops(); });
      while (const std::optional<SceneRange> range = next()) {
        RangeRows rows = compute(*range);
        const std::lock_guard lock(mutex_);
        queue_.add(*range, std::move(rows));
        came_.notify_one();
      }
    } catch (...) {
      const std::lock_guard lock(mutex_);
      failure_ = std::current_exception();
      dismissed_ = true;
    }
    const std::lock_guard lock(mutex_);
    --working_;
    came_.notify_one();
    room_.notify_all();
  }

  /// Waits while too many rows do.
  std::optional<SceneRange> next() {
    std::unique_lock lock(mutex_);
    std::optional<SceneRange> range;
    while (!stops() && !(range = queue_.hand_out()) && !queue_.all_handed_out()) room_.wait_for(lock, between_ticks);
    return range;
  }

  void dismiss() {
    dismissed_ = true;
    room_.notify_all();
    threads_.clear();
  }

  RangeQueue& queue_;
  const SweepHooks& hooks_;
  std::mutex mutex_;
  std::condition_variable came_, room_;
  int working_ = 0;
  std::atomic<bool> dismissed_ = false;
  std::exception_ptr failure_;
  std::vector<std::jthread> threads_;
};

const char* outcome_of(FailureKind kind) {
  switch (kind) {
    case FailureKind::bad_input: return "refused";
    case FailureKind::outside_model: return "outside-model";
    default: return "not-computed";
  }
}

}  // namespace

std::optional<SceneRange> RangeQueue::hand_out() {
  // The rows that the waiting ones wait for are on their way already.
  if (all_handed_out() || bytes_ > most_waiting_bytes) return std::nullopt;
  const SceneRange range{handed_out_, std::min(size_, all_.first + all_.count - handed_out_)};
  handed_out_ += range.count;
  return range;
}

void RangeQueue::add(const SceneRange& range, RangeRows rows) {
  bytes_ += rows.text.size();
  waiting_.try_emplace(range.first, range, std::move(rows));
}

std::optional<RangeRows> RangeQueue::take() {
  if (!has_next()) return std::nullopt;
  auto node = waiting_.extract(taken_);
  auto& [range, rows] = node.mapped();
  bytes_ -= rows.text.size();
  taken_ += rows.scenes;
  broken_ = rows.scenes < range.count;
  return std::move(rows);
}

void run_on_threads(RangeQueue& queue, int threads, const MakeCompute& make, const SweepHooks& hooks) {
  Crew crew(queue, hooks);
  crew.start(threads, make);
  crew.write();
}

SweepBody make_sweep_body(const SweepPlan& plan, const Scene& scene) {
  if (plan.layout.model == Model::discrete) return {DiscreteBody(scene), nullptr};
  return {{}, std::make_shared<const numeric::Body>(scene.make_body())};
}

SceneRunner::SceneRunner(const SweepPlan& plan, const SweepBody& body, std::function<bool()> stop)
    : plan_(plan), stop_(std::move(stop)), scene_(plan.scene), body_(body) {}

RangeRows SceneRunner::operator()(const SceneRange& range) {
  RangeRows rows;
  while (rows.scenes < range.count && !stop_() && append_scene(range.first + rows.scenes, rows.text)) ++rows.scenes;
  return rows;
}

void SceneRunner::renew_body() {
  bool same = !body_values_.empty();
  for (std::size_t i = 0; same && i < body_values_.size(); ++i) same = body_values_[i] == values_[plan_.body_values[i]];
  if (same || plan_.body_values.empty()) return;
  body_values_.clear();  // so that a body that cannot be made is tried again
  body_ = make_sweep_body(plan_, scene_);
  for (const std::size_t place : plan_.body_values) body_values_.push_back(values_[place]);
}

/// The sequence of the scene, in the plane or in space.
DiscreteSequence SceneRunner::sequence(bool with_errors) {
  const analytic::SequenceOptions options{
      .impacts = scene_.most_impacts(), .digits = scene_.accuracy.digits, .amplification = with_errors};
  const DiscreteDrop drop = body_.discrete->drop(scene_);
  return std::visit([&](const auto& one) -> DiscreteSequence { return impact_sequence(one, options); }, drop);
}

bool SceneRunner::append_result(RowForm& form) {
  renew_body();
  if (plan_.layout.model == Model::discrete) {
    const Run run = named_run(scene_, sequence(form.errors), body_.discrete->centre());
    form.reason = shortfall(scene_, run);
    append_rows(form, run);
    return true;
  }
  const PlannedRun planned = run_to_digits(*body_.solid, scene_.world, scene_.start(*body_.solid), scene_.request,
                                           scene_.accuracy, {.progress = [this](int, long) { return !stop_(); }});
  if (planned.run.outcome == numeric::Outcome::interrupted) return false;
  form.reason = shortfall(scene_, planned);
  append_rows(form, named_run(scene_, planned.run));
  return true;
}

RowForm SceneRunner::form_of(const std::string& prefix, std::string& out) const {
  const numeric::Request& request = scene_.request;
  const bool both = request.error_estimates && request.amplification;
  return {.out = out,
          .prefix = prefix,
          .layout = plan_.layout,
          .errors = plan_.layout.model == Model::discrete ? both : request.error_estimates,
          .predictions = plan_.layout.model == Model::discrete ? both : request.amplification,
          .reason = {}};
}

bool SceneRunner::append_scene(long long index, std::string& out) {
  plan_.points.at(index, values_);
  plan_.put_point(values_, scene_);
  const std::string prefix = row_prefix(index, values_);
  RowForm form = form_of(prefix, out);
  const char* outcome = nullptr;
  try {
    return append_result(form);
  } catch (const std::bad_alloc&) {
    throw;  // not the scene's fault, and another time it may have enough
  } catch (...) {
    const Failure failure = current_failure();
    if (failure.kind == FailureKind::defect) throw;
    outcome = outcome_of(failure.kind);
    form.reason = failure.message;
  }
  append_failure(form, outcome);
  return true;
}

MakeCompute runners_of(const SweepPlan& plan, const SweepBody& body) {
  return [&plan, &body](std::function<bool()> stop) -> ComputeRange {
    const auto runner = std::make_shared<SceneRunner>(plan, body, std::move(stop));
    return [runner](const SceneRange& range) { return (*runner)(range); };
  };
}

long long range_size(const SweepPlan& plan) {
  if (plan.layout.model == Model::continuous) return 1;
  return std::clamp(4096 / plan.scene.request.impacts, 1, 512);
}

}  // namespace clatter::validation::inline sweep
