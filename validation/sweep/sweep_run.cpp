// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/sweep/sweep_run.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

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

}  // namespace clatter::validation::inline sweep
